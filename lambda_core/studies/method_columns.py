"""Read rows of comparison methods as responses of a study."""

from __future__ import annotations

from collections.abc import Sequence

from lambda_core.analysis.rating.compare_methods import comparison_inputs
from lambda_core.discovery.api import registry
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.model.settings.contamination import known_contamination
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.views.method import evaluate_methods

Columns = dict[str, tuple[float | None, str, str]]  # value, unit and meaning by name


def method_columns(found: Equilibrium, names: Sequence[str], loads: tuple[float, float] | None = None) -> Columns:
    """Return the rows of comparison methods among names.

    The value is None where a method does not apply.

    Parameters
    ----------
    loads : (float, float), optional
        Radial and axial [N]; default: those of the bearing's case.

    Raises
    ------
    UsageError
        For a row that does not exist.
    """
    wanted = [name for name in names if "/" in name]
    if not wanted:
        return {}
    model = found.context.model
    clean = known_contamination(model.contamination, model.geometry.pitch_diameter)
    inputs = comparison_inputs(found, contamination=clean, loads=loads)
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
