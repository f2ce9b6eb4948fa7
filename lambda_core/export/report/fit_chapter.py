"""Build the chapter of a report about a fit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lambda_core.discovery.api import Registry
from lambda_core.domain.unit_systems import UnitSystem
from lambda_core.export.report.chapters import Chapter, Picture
from lambda_core.export.report.key_tables import Table, rounded
from lambda_core.export.report.page import Cover, svg
from lambda_core.fitting.report_text import compact
from lambda_core.views.other_units import in_units

if TYPE_CHECKING:
    from lambda_core.fitting.report import FitReport, FittedParameter


def fit_chapter(registry: Registry, report: FitReport, cover: Cover) -> Chapter:
    """Return the chapter of one fit.

    The objections follow its state.
    """
    units = cover.units
    tables = (
        _parameters(report),
        _correlations(report),
        _points(report, units),
        _unseen(report, units),
        _tests(report),
    )
    state = "interrupted" if report.is_interrupted else "fitted with reservations" if report.warnings else "fitted"
    return Chapter(
        kind="fit",
        title=f"{report.title}: fit to {report.file}",
        subtitle=f"{report.case}   {report.date}   SHA-256 of the file {report.sha256[:16]}",
        state=state,
        good=not report.warnings,
        lines=(report.sentence,),
        reasons=tuple(map(units.sentence, report.warnings)),
        figures=_figures(report),
        overview=tuple(table for table in tables if table.rows),
        shown=tuple(Picture(one.view, svg(registry, in_units(one, units))) for one in report.pictures()),
    )


def _figures(report: FitReport) -> list[tuple[str, str, str]]:
    found = [
        ("measured values", f"{len(report.points)}", ""),
        ("error of the fit", rounded(report.rms_error_pct, 2), "%"),
        ("each point from all others", rounded(report.left_out_rms_error_pct, 2), "%"),
    ]
    if report.chi_square_per_degree is not None:
        found.append(("chi-square per degree", f"{report.chi_square_per_degree:.2g}", ""))
    if report.scatter_pct is not None:
        found.append(("scatter of the residuals", rounded(report.scatter_pct, 2), "%"))
    return found


def _parameters(report: FitReport) -> Table:
    head = ("parameter", "value", "95 % interval", "range", "unit", "source of the range")
    return Table("fitted values", head, tuple(_row(one) for one in report.parameters))


def _row(one: FittedParameter) -> tuple[str, ...]:
    value, interval = f"{one.value:.4g} (held)", "not determined"
    if one.standard_error is not None:
        low, high = one.interval_95
        value, interval = compact(one.value, one.standard_error), f"{low:.4g} .. {high:.4g}"
    numbers = map(_in_one_line, (value, interval, f"{one.low:.4g} .. {one.high:.4g}", one.unit))
    return (one.name, *numbers, one.range_source)


def _in_one_line(text: str) -> str:
    """Return a number with its error or unit, unbroken."""
    return text.replace(" ", "\u00a0")


def _correlations(report: FitReport) -> Table:
    names = [one.name for one in report.parameters if one.state != "held"]
    rows = [(name, *(f"{value:+.2f}" for value in row)) for name, row in zip(names, report.correlation, strict=True)]
    return Table("correlations", ("", *names), tuple(rows) if len(names) > 1 else ())


def _points(report: FitReport, units: UnitSystem) -> Table:
    band = "95 % band with errors of laws"
    head = ("line", "quantity", "measured", "predicted", band, "unit", "residual over error", "from all others")
    rows = [
        (
            str(p.line), p.quantity, *(f"{units.value(value, p.unit):.4g}" for value in (p.measured, p.predicted)),
            " .. ".join(f"{units.value(end, p.unit):.4g}" for end in p.new_measurement_band),
            _in_one_line(units.unit(p.unit)),
            f"{p.standardised_residual:+.1f}{' outlier' if p.is_outlier else ''}",
            f"{100.0 * p.left_out_error / p.measured:+.2g} %",
        )
        for p in report.points
    ]  # fmt: skip
    return Table("measured and predicted values", head, tuple(rows))


def _unseen(report: FitReport, units: UnitSystem) -> Table:
    head = ("line", "quantity", "measured", "predicted", "95 % band with errors of laws", "unit", "")
    rows = [
        (
            str(p.line), p.quantity, *(f"{units.value(value, p.unit):.4g}" for value in (p.measured, p.predicted)),
            " .. ".join(f"{units.value(end, p.unit):.4g}" for end in p.band), _in_one_line(units.unit(p.unit)),
            "inside" if p.is_inside else "outside",
        )
        for p in report.predictions
    ]  # fmt: skip
    return Table("points that the fit has not seen", head, tuple(rows))


def _tests(report: FitReport) -> Table:
    rows = [(t.name, f"{t.adjusted_p_value:.2g}", "yes" if t.is_significant else "no") for t in report.tests]
    return Table("patterns of the residuals", ("pattern", "p, adjusted", "more than chance"), tuple(rows))
