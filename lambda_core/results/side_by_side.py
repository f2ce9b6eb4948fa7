"""Compare several results by their cases and key numbers."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from pydantic import Field

from lambda_core.domain.errors import UsageError
from lambda_core.domain.number_text import NONE, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.results.bearing_summary import BearingSummary
from lambda_core.results.quantity import quantities
from lambda_core.results.rating import Rating
from lambda_core.results.record import INTERFACE, Record
from lambda_core.results.summary import Summary

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

_SILENT = ("name", "description", "assumptions")  # of a case: they decide nothing
_LARGE = 1e4  # numbers above are rounded to three digits
_WIDEST = 28  # of a column of values


class Differing(Record):
    """One option that the cases do not share."""

    option: str
    values: list[str | None] = Field(description="as written, null where it is left open; in the order of the results")


class Number(Record):
    """One number of every result."""

    name: str
    unit: str
    values: list[float | None]


class SideBySide(Record):
    """Several results: differing inputs, key numbers."""

    interface: int = INTERFACE
    files: list[str]
    names: list[str] = Field(description="of the cases, or of the files where cases repeat")
    inputs: list[Differing]
    numbers: list[Number]

    def text(self, units: UnitSystem = SI) -> str:
        """Return two tables for people, a column per result."""
        rows = [("", *self.names)]
        rows += [
            (row.option, *("-" if value is None else _cut(units.sentence(value)) for value in row.values))
            for row in self.inputs
        ]
        if not self.inputs:
            rows.append(("the same inputs", *[""] * len(self.names)))
        rows.append(("", *[""] * len(self.names)))
        for row in self.numbers:
            unit = units.unit(row.unit)
            values = (NONE if v is None else _short(units.value(v, row.unit)) for v in row.values)
            rows.append((f"{row.name} [{unit}]" if unit else row.name, *values))
        first = max(len(row[0]) for row in rows)
        widths = [max(len(row[i]) for row in rows) for i in range(1, len(rows[0]))]
        return "\n".join(
            "  ".join([row[0].ljust(first), *(cell.rjust(w) for cell, w in zip(row[1:], widths, strict=True))]).rstrip()
            for row in rows
        )


def run_names(runs: Sequence[Any]) -> tuple[str, ...]:
    """Return a short name for each run.

    The name is that of its case, or that of its file where cases repeat.
    """
    cases = [run.case for run in runs]
    return tuple(cases) if len(set(cases)) == len(cases) else tuple(run.path.stem for run in runs)


def differing_inputs(runs: Sequence[Any]) -> list[Differing]:
    """Return the options that differ among runs.

    They are written as in the cases.

    Parameters
    ----------
    runs : sequence of Result
        Two or more.

    Returns
    -------
    list of Differing
        In the order of the first case.
    """
    cases = [dict(_leaves("", tomllib.loads(run.case_toml))) for run in runs]
    options = dict.fromkeys(option for case in cases for option in case if option not in _SILENT)
    found = [Differing(option=option, values=[case.get(option) for case in cases]) for option in options]
    return [row for row in found if len(set(row.values)) > 1]


def side_by_side(runs: Sequence[Result]) -> SideBySide:
    """Compare several results.

    Raises
    ------
    UsageError
        For fewer than two.
    """
    if len(runs) < 2:
        raise UsageError("a comparison needs at least two results")
    summaries = [run.summary() for run in runs]
    files = [str(run.path) for run in runs]
    return SideBySide(
        files=files, names=list(run_names(runs)), inputs=differing_inputs(runs), numbers=list(_numbers(summaries))
    )


def _numbers(summaries: Sequence[Summary]) -> Iterator[Number]:
    """Yield the key numbers.

    Single bearings compare with each other whatever their names; with a machine, bearings of one name compare.
    """
    each = [summary.bearings for summary in summaries]
    if all(len(bearings) == 1 for bearings in each):
        yield from _of_bearings([next(iter(bearings.values())) for bearings in each])
        return
    yield from _declared(Summary, _OF_MACHINE, summaries)
    for name in dict.fromkeys(name for bearings in each for name in bearings):
        yield from _of_bearings([bearings.get(name) for bearings in each], f"{name}: ")


def _of_bearings(bearings: Sequence[BearingSummary | None], before: str = "") -> Iterator[Number]:
    """Yield the numbers of a bearing of each result."""
    yield from _declared(BearingSummary, _OF_BEARING, bearings, before)
    yield from _declared(Rating, _RATED, [None if one is None else one.rating for one in bearings], before)


def _declared(
    record: type[Record], fields: Sequence[str], values: Sequence[Record | None], before: str = ""
) -> Iterator[Number]:
    """Yield declared numbers under their own names."""
    for one in (quantities(record)[field] for field in fields):
        yield Number(
            name=f"{before}{one.label}", unit=one.unit, values=[getattr(value, one.name, None) for value in values]
        )


_OF_MACHINE = ("friction_torque_Nmm", "friction_torque_ci_Nmm", "power_loss_W", "system_life_h")
_OF_BEARING = (
    "friction_torque_Nmm",
    "friction_torque_ci_Nmm",
    "power_loss_W",
    "min_film_um",
    "max_pressure_GPa",
    "cage_speed_over_epicyclic",
    "bearing_capacitance_nF",
)
_RATED = (
    "reference_life_h",
    "basic_life_h",
    "static_safety",
    "viscosity_ratio",
    "skf_torque_Nmm",
    "schaeffler_torque_Nmm",
)


def _cut(text: str) -> str:
    return text if len(text) <= _WIDEST else f"{text[: _WIDEST - 3]}..."


def _short(value: float) -> str:
    return f"{value:.4g}" if abs(value) < _LARGE else number(float(f"{value:.3g}"), 0)


def _leaves(path: str, value: Any) -> Iterator[tuple[str, str]]:
    if isinstance(value, Mapping):
        for key, item in value.items():
            yield from _leaves(f"{path}.{key}" if path else key, item)
    else:
        yield path, value if isinstance(value, str) else str(value).lower() if isinstance(value, bool) else str(value)
