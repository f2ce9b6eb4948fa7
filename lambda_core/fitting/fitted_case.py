"""Write the case with its fitted values."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.domain.units import show
from lambda_core.domain.written_values import DIGITS
from lambda_core.fitting.report_text import compact

if TYPE_CHECKING:
    from typing import TypeVar

    from lambda_core.case.case_io import Source
    from lambda_core.case.written import Written
    from lambda_core.fitting.report import FitReport, FittedPoint

    C = TypeVar("C", bound=Written)

_OF_A_FIT = re.compile(r": (fitted|best before an interrupted fit) to \d+ values of ")


def write_fitted(
    source: Source,
    report: FitReport,
    path: str | Path,
    overrides: Iterable[str] = (),
    *,
    overwrite: bool = False,
    rows: bool = False,
) -> Path:
    """Write a case file with the fitted values, see :func:`lambda_core.fitting.api.fitted_case`."""
    from lambda_core.case.builtin import builtin_text, is_builtin
    from lambda_core.case.case_io import case_text, read_case
    from lambda_core.case.case_writer import save_case
    from lambda_core.domain.files import check_new

    target = check_new(Path(path), overwrite)
    original = None
    if isinstance(source, str | Path):
        is_file = Path(source).is_file()
        original = (
            case_text(Path(source)) if is_file else builtin_text(str(source)) if is_builtin(str(source)) else None
        )
    case = with_fit(read_case(source, overrides), report, rows=rows)
    save_case(case, target, original)
    return target


def with_fit(case: C, report: FitReport, *, rows: bool = False) -> C:
    """Return the case with the fitted values.

    It has an assumption for each, and the section `fit`.

    A parameter that the data do not determine keeps its value; the section has its range as a standard deviation, and
    how the fitted values go with it. With `rows` the section also has the measured values.
    """
    changes: dict[str, Any] = {}
    values: list[dict[str, Any]] = []
    sentences = []
    for parameter in report.parameters:
        number = float(f"{parameter.value:.{DIGITS}g}")
        values.append(
            {
                "path": parameter.path,
                "value": number,
                "standard_error": float(f"{parameter.posterior_error:.4g}"),
                "unit": parameter.unit,
            }
        )
        if parameter.standard_error is None:
            values[-1]["range"] = [parameter.low, parameter.high]
            continue
        _set(changes, parameter.path, f"{number:.{DIGITS}g} {parameter.unit}" if parameter.unit else number)
        shown = f"{compact(parameter.value, parameter.standard_error)} {parameter.unit}".rstrip()
        how = "best before an interrupted fit" if report.is_interrupted else "fitted"
        sentences.append(f"{parameter.path} {shown}: {how} to {len(report.points)} values of {report.file}")
    fitted = tuple(f"{parameter.path} " for parameter in report.parameters)  # now by this fit, not by an earlier one
    earlier = [text for text in case.assumptions if not (text.startswith(fitted) and _OF_A_FIT.search(text))]
    changes["assumptions"] = [*earlier, *sentences]
    changes["fit"] = {
        "file": report.file,
        "sha256": report.sha256,
        "date": report.date,
        "count": len(report.points),
        "parameters": values,
        "correlation": [[float(f"{value:.6g}") for value in row] for row in report.posterior_correlation],
    }
    if report.is_interrupted:
        changes["fit"]["complete"] = False
    if rows:
        changes["fit"]["measured"] = [_row(point, report.condition_quantities) for point in report.points]
    return case.with_(**changes)


def _row(point: FittedPoint, quantities: Mapping[str, str]) -> dict[str, Any]:
    """Return one measured value as it stands in a case."""
    conditions = (f"{name} {show(value, quantities[name], 6)}" for name, value in point.conditions.items())
    return {
        "line": point.line,
        "conditions": ", ".join(conditions),
        "quantity": point.quantity,
        "value": float(f"{point.measured:.{DIGITS}g}"),
        "error": float(f"{point.error:.4g}"),
        "unit": point.unit,
    }


def _set(tables: dict[str, Any], path: str, value: Any) -> None:
    """Put a value at a dotted path."""
    *tables_of, name = path.split(".")
    for part in tables_of:
        tables = tables.setdefault(part, {})
    tables[name] = value
