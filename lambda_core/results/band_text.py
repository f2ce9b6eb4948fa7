"""Write results with their model bands."""

from __future__ import annotations

from collections.abc import Sequence

from lambda_core.domain.number_text import LONG_LIFE, NONE, hours_alone, rounded
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.results.model_band import LEAST_SHARE, NARROW, TEMPERATURES, ModelBand


def banded(value: float | None, ends: Sequence[float], unit: str, plain: str, units: UnitSystem = SI) -> str:
    """Return a number with its model band.

    It is rounded to the meaningful digits; `plain` without a band.
    """
    if value is None or not ends:
        return plain
    if is_narrow(ends):
        return f"{plain} (model {NARROW})"
    low, high = (units.value(number, unit) for number in ends)
    half, name = 0.5 * abs(high - low), units.unit(unit)
    texts = [rounded(number, half) for number in (units.value(value, unit), low, high)]
    return f"{texts[0]} {name} (model {texts[1]} .. {texts[2]})"


def in_digits_of(value: float | None, ends: Sequence[float], unit: str, plain: str, units: UnitSystem = SI) -> str:
    """Return a number in the digits of another one's band.

    `plain` without a band.
    """
    if value is None or not ends or is_narrow(ends):
        return plain
    low, high = (units.value(number, unit) for number in ends)
    return f"{rounded(units.value(value, unit), 0.5 * abs(high - low))} {units.unit(unit)}"


def is_narrow(found: Sequence[float]) -> bool:
    """Tell whether a band is narrow.

    The ends and causes of a narrow band do not matter.
    """
    low, high = found
    return 100.0 * abs(high - low) < LEAST_SHARE * abs(low + high)


def ends(found: Sequence[float], unit: str, units: UnitSystem = SI, *, named: bool = False) -> str:
    """Return the ends of a model band.

    They are rounded to the meaningful digits; a dash stands for none.

    The unit follows where it is to be `named` and the ends are numbers.
    """
    if not found:
        return NONE
    if is_narrow(found):
        return NARROW
    low, high = (units.value(number, unit) for number in found)
    half = 0.5 * abs(high - low)
    if unit == "h" and high >= LONG_LIFE:
        text = " .. ".join(dict.fromkeys(map(hours_alone, found)))
    else:
        text = f"{rounded(low, half)} .. {rounded(high, half)}"
    return f"{text} {units.unit(unit)}" if named else text


def band_text(band: ModelBand | None, quantity: str, units: UnitSystem = SI) -> str:
    """Return a quasi-static result with its band.

    Empty where there is none.
    """
    for one in band.bands if band is not None else ():
        if one.quantity == quantity:
            return banded(one.value, (one.low, one.high), one.unit, units.text(one.value, one.unit, 3), units)
    return ""


def temperature_text(band: ModelBand | None, units: UnitSystem = SI) -> str:
    """Return computed temperatures with their bands.

    Empty where they are given.
    """
    known = [one for one in (band.bands if band is not None else ()) if one.quantity in TEMPERATURES]
    texts = [banded(one.value, (one.low, one.high), "degC", units.text(one.value, "degC", 1), units) for one in known]
    return ", ".join(f"{TEMPERATURES[one.quantity]} {text}" for one, text in zip(known, texts, strict=True))


def source_lines(band: ModelBand | None) -> list[str]:
    """Return the sources of the bands.

    Once for those of one origin, and what was left out.
    """
    if band is None:
        return []
    if not band.bands:
        return list(band.left_out)
    share = f"{100.0 * band.coverage:.0f} %"
    return [
        f"{share}, ranges of parameters and laws exchanged; mostly from",
        *_reasons(band),
        *band.left_out,
    ]


def _reasons(band: ModelBand) -> list[str]:
    """Return the sources of bands, each once."""
    reasons: dict[str, list[str]] = {}
    for one in (wide for wide in band.bands if not is_narrow((wide.low, wide.high))):
        reasons.setdefault(one.why(), []).append(one.title)
    return [f"{' and '.join(names)}: {why}" for why, names in reasons.items() if why]
