"""Write a table with a column for each bearing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lambda_core.domain.number_text import NONE
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.domain.wrapping import lines_under
from lambda_core.results.band_text import MOSTLY, ends, named_sources
from lambda_core.results.model_band import ModelBand

HEAD, COLUMN = 24, 14  # least widths


def bearing_table(names: Sequence[str], rows: Sequence[tuple[str, Sequence[str]]]) -> list[str]:
    """Return the lines of a table.

    The first has the names of the bearings; a row has its head and a cell for each bearing.
    """
    every = [("", names), *rows]
    wide = max(COLUMN, *(2 + len(cell) for _, cells in every for cell in cells))
    return [f"{head:<{HEAD}}" + "".join(f"{cell:>{wide}}" for cell in cells) for head, cells in every]


def digits(value: float | None, count: int = 4) -> str:
    """Write a number with some significant digits for a cell."""
    return NONE if value is None else f"{0.0 if abs(value) < 5e-5 else value:.{count}g}"


def band_lines(band: Sequence[float], bearings: Mapping[str, ModelBand | None], units: UnitSystem = SI) -> list[str]:
    """Return the lines of a machine's model band.

    They give the torque of all bearings, the causes of the bands of each, and why there is none.
    """
    sources = named_sources(bearings, units)
    if not band:
        return lines_under("model band", sources)
    both = f"{ends(band, 'N mm', units, named=True)} of all bearings (90 %, {MOSTLY})"
    return lines_under("model band", [both, *sources])
