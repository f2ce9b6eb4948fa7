"""Read rows of comparison methods as responses of a study."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from lambda_core.analysis.rating.compare_methods import comparison_inputs
from lambda_core.discovery.api import registry
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.model.settings.contamination import known_contamination
from lambda_core.views.method import evaluate_methods

if TYPE_CHECKING:
    from lambda_core.analysis.static_point import BearingPoint, StaticPoint

Columns = dict[str, tuple[float | None, str, str]]  # value, unit and meaning by name


def method_columns(point: StaticPoint, names: Sequence[str]) -> Columns:
    """Return the rows of comparison methods among names.

    The value is None where a method does not apply. In a machine names and meanings begin with the bearing's name.

    Raises
    ------
    UsageError
        For a row that does not exist.
    """
    columns: Columns = {}
    for bearing, one in point.bearings.items():
        own, of = (f"{bearing}.", f"{bearing}: ") if bearing else ("", "")
        rows = [name.removeprefix(own) for name in names if "/" in name and name.startswith(own)]
        found = _of_bearing(one, rows) if rows else {}
        columns |= {f"{own}{name}": (value, unit, f"{of}{words}") for name, (value, unit, words) in found.items()}
    return columns


def _of_bearing(point: BearingPoint, wanted: Sequence[str]) -> Columns:
    """Return rows of methods by their names."""
    model = point.model
    clean = known_contamination(model.contamination, model.geometry.pitch_diameter)
    inputs = comparison_inputs(point.equilibrium, contamination=clean, loads=point.loads)
    columns: Columns = {}
    for name in wanted:
        label, _, row = name.partition("/")
        group, _, item = row.partition("/")
        method = registry().method(label)
        (answer,) = evaluate_methods([method], inputs)
        table = answer.table
        if table is None:
            why = "fails" if answer.failed else "does not apply"
            columns[name] = (None, "", f"{label}: {item} ({why})")
            continue
        rows = {f"{r.group}/{r.name}": r for r in table.rows}
        if row not in rows:
            raise UsageError(unknown_name(f"row of {label}", row, rows))
        unit = rows[row].unit
        columns[name] = (rows[row].value, "" if unit == "-" else unit, f"{label}: {group} {item}")
    return columns
