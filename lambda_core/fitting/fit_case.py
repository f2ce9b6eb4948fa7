"""Fit parameters of a case to measured operating points."""

from __future__ import annotations

import datetime
import math
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.domain.lists import listed
from lambda_core.domain.units import show
from lambda_core.fitting.discrepancy import Prediction
from lambda_core.fitting.least_squares import Fit
from lambda_core.fitting.least_squares import fit as fit_values
from lambda_core.fitting.left_out import left_out_sentences, with_solvable_rows
from lambda_core.fitting.measurements import Measurements, read_measurements
from lambda_core.fitting.model_calls import Model
from lambda_core.fitting.next_point import next_point
from lambda_core.fitting.predictions import discrepancy_sizes, predicted
from lambda_core.fitting.problem import CaseProblem, Entry
from lambda_core.fitting.report import (
    FitReport,
    FittedParameter,
    FittedPoint,
    ParameterCombination,
    PatternTest,
    PredictedPoint,
    SampledParameter,
    SampledPosterior,
    SuggestedPoint,
    known,
)
from lambda_core.fitting.residual_tests import misfit
from lambda_core.fitting.rows import FitProgress, Rows, Watch
from lambda_core.fitting.sampling import check_count
from lambda_core.fitting.sampling import sample as sample_posterior
from lambda_core.fitting.scores import relative
from lambda_core.fitting.sentence import sentence
from lambda_core.fitting.subjects import Subject, subject_of
from lambda_core.fitting.uncertainty import correlations
from lambda_core.studies.pool import usable_cores

if TYPE_CHECKING:
    from lambda_core.case.case_io import Source

_MOST_EQUAL = 5  # groups of equal lines that are named
Announce = Callable[[str], None]
Progress = Callable[[FitProgress], None]


def fit_report(
    source: Source,
    measured: str | Path | Measurements,
    vary: Sequence[str],
    overrides: Iterable[str] = (),
    *,
    bearing: str | None = None,
    predict: str | Path | Measurements | None = None,
    suggest: bool = True,
    sample: int = 0,
    workers: int | None = 1,
    progress: Progress | None = None,
    announce: Announce | None = None,
) -> FitReport:
    """Return what a fit of a case found, see :func:`lambda_core.fitting.api.fit`."""
    begin = time.perf_counter()
    if sample:
        check_count(sample)
    if not listed(vary, "vary"):
        raise UsageError("nothing to fit: name a parameter, for example loss_factor")
    subject = subject_of(source, overrides, bearing)
    data = _read(measured, subject)
    unseen = None if predict is None else _read(predict, subject)
    rows = Rows(subject, workers or usable_cores())
    try:
        report = _fitted(subject, data, unseen, vary, rows, suggest, sample, progress, announce)
    finally:
        rows.close()
    return report.model_copy(update={"seconds": time.perf_counter() - begin})


def _fitted(
    subject: Subject,
    data: Measurements,
    unseen: Measurements | None,
    vary: Sequence[str],
    rows: Rows,
    suggest: bool,
    sample: int,
    progress: Progress | None,
    announce: Announce | None,
) -> FitReport:
    """Return the report, without its time."""
    problem = CaseProblem(subject, data, [subject.varied(text) for text in vary], rows)
    if announce is not None:
        announce(f"fitting to {len(problem.entries)} measured values; parameters: {len(problem.parameters)}")

    def search(problem: CaseProblem) -> Fit:
        return fit_values(
            problem.predict if progress is None else _reporting(problem, rows, progress),
            problem.parameters,
            problem.data,
            jacobian=problem.jacobian,
            input_slopes=problem.input_slopes if data.uncertain else None,
            is_costly=True,
        )

    try:
        problem, found, reasons = with_solvable_rows(problem, search, 1 + len(vary), announce)
    except ValueError as error:
        raise UsageError(f"{data.name}: {error}") from None
    doubts = left_out_sentences(data.name, reasons, len(problem.entries))
    # what an interruption leaves out: the values are known
    rest: dict[str, Any] = {"sizes": {}, "suggestion": None, "predictions": [], "posterior": None}
    try:
        for name, part in _rest(subject, problem, found, suggest, unseen, sample, announce, doubts):
            rest[name] = part
    except KeyboardInterrupt:
        found = replace(found, is_interrupted=True)
    report = _report(subject, problem, found, rest.pop("suggestion"), rest.pop("sizes"), doubts)
    return report.model_copy(update={"unsolved_lines": sorted(reasons), **rest})


def _read(source: str | Path | Measurements, subject: Subject) -> Measurements:
    return source if isinstance(source, Measurements) else read_measurements(source, subject.words)


def _rest(
    subject: Subject,
    problem: CaseProblem,
    found: Fit,
    suggest: bool,
    unseen: Measurements | None,
    sample: int,
    announce: Announce | None,
    doubts: list[str],
) -> Iterator[tuple[str, Any]]:
    """Yield what follows from fitted values, by name.

    What has no solution adds a sentence to `doubts`.
    """
    if found.is_interrupted:
        return
    sizes = discrepancy_sizes(problem, found.values, found.predicted)
    yield "sizes", sizes
    if suggest:
        yield "suggestion", _suggestion(problem, found)
    if unseen is not None:
        try:
            yield "predictions", _unseen(subject, problem, found, sizes, unseen, doubts)
        except SolverError as error:  # none of them has a solution
            doubts.append(f"no points were predicted: {error}")
    if sample:
        if announce is not None:
            announce("sampling the posterior")
        try:
            yield "posterior", _posterior(problem, found, sample)
        except SolverError as error:
            doubts.append(f"no samples were drawn: {error}")


def _reporting(problem: CaseProblem, rows: Rows, progress: Progress) -> Model:
    """Return a predictor that reports its progress."""
    measured = problem.data.values
    watch = Watch(problem.rows, len(problem.parameters), progress)
    rows.heard = watch.heard

    def predict(values: FloatArray) -> FloatArray:
        found = problem.predict(values)
        error = 100.0 * _rms(relative(found - measured, measured))
        watch.error_pct = error if watch.error_pct is None else min(watch.error_pct, error)
        return found

    return predict


def _posterior(problem: CaseProblem, found: Fit, count: int) -> SampledPosterior:
    """Return posterior samples with their parameters' statistics."""
    drawn = sample_posterior(problem.predict, found, count)
    ends = np.quantile(drawn.samples, [0.025, 0.5, 0.975], axis=0)
    return SampledPosterior(
        parameters=[
            SampledParameter(
                path=graded.path,
                name=graded.short,
                unit=graded.scale.unit,
                median=float(ends[1, i]),
                interval_95=[float(ends[0, i]), float(ends[2, i])],
                samples=drawn.samples[:, i].tolist(),
            )
            for i, graded in enumerate(problem.varied)
        ],
        effective=drawn.effective,
        interpolation_error=drawn.interpolation_error,
    )


def _unseen(
    subject: Subject,
    problem: CaseProblem,
    found: Fit,
    sizes: dict[str, float],
    data: Measurements,
    doubts: list[str],
) -> list[PredictedPoint]:
    """Return unseen measured points with predictions.

    The fit has not used them.
    """

    def predict(asked: CaseProblem) -> tuple[FloatArray, Prediction]:
        return predicted(problem, found, sizes, asked)

    asked, (values, new), reasons = with_solvable_rows(problem.elsewhere(data), predict, 1)
    doubts += left_out_sentences(data.name, reasons, len(asked.entries))
    if found.data.is_error_known and not asked.data.is_error_known:
        doubts.append(f"{data.name} has no errors of measurement: its bands are for exact measurements.")
    return [
        PredictedPoint(
            **_where(subject, asked, entry),
            measured=float(asked.data.values[i]),
            predicted=float(values[i]),
            band=[float(low), float(high)],
            is_inside=bool(low <= asked.data.values[i] <= high),
        )
        for i, (entry, (low, high)) in enumerate(zip(asked.entries, new.band(), strict=True))
    ]


def _where(subject: Subject, problem: CaseProblem, entry: Entry) -> dict[str, Any]:
    """Return line, label, conditions and quantity of a measured value."""
    data = problem.measurements
    return {
        "line": data.lines[entry.row],
        "label": data.labels[entry.row],
        "conditions": {name: float(column[entry.row]) for name, column in data.conditions.items()},
        "quantity": entry.quantity,
        "unit": subject.words.measured[entry.quantity].unit,
    }


def _suggestion(problem: CaseProblem, found: Fit) -> SuggestedPoint | None:
    """Return the most informative operating point.

    None where no candidate has a solution.
    """
    points = problem.candidates()
    table = problem.candidate_slopes(found.values, points)
    solved = np.flatnonzero(np.isfinite(table).all(axis=1))
    if not solved.size or not points[0]:
        return None
    relative = float(np.median(found.errors * found.scale / np.abs(found.predicted)))
    slopes = table[solved, 1:] / (relative * np.abs(table[solved, :1]))
    best = next_point(found.information, slopes, found.parameters, found.factor)
    conditions = points[int(solved[best.index])]
    return SuggestedPoint(
        conditions={name: show(value, problem.quantities[name], 4) for name, value in conditions.items()},
        combination=best.worst.weights,
        spread_before=best.before,
        spread_after=best.after,
    )


def _report(
    subject: Subject,
    problem: CaseProblem,
    found: Fit,
    suggestion: SuggestedPoint | None,
    sizes: dict[str, float],
    doubts: Sequence[str],
) -> FitReport:
    share = relative(found.predicted - found.data.values, found.data.values)
    left_out = relative(found.left_out, found.data.values)
    is_known, degrees = found.data.is_error_known, found.degrees
    chi_square = float(np.sum(found.independent**2)) / degrees if is_known and degrees > 0 else None
    return FitReport(
        case=subject.name,
        title=subject.title,
        file=problem.measurements.name,
        sha256=problem.measurements.sha256,
        date=datetime.date.today().isoformat(),
        sentence=sentence(found),
        warnings=[*doubts, *_warnings(problem, found)],
        parameters=_parameters(problem, found),
        tests=[
            PatternTest(
                name=test.name, p_value=test.p_value, adjusted_p_value=test.adjusted, is_significant=test.is_significant
            )
            for test in found.tests
        ],
        correlation=found.correlations.tolist() if found.free else [],
        posterior_correlation=correlations(found.posterior).tolist(),
        combinations=[
            ParameterCombination(weights=d.weights, spread=known(d.spread), is_determined=d.is_determined)
            for d in found.directions
        ],
        condition_quantities=problem.quantities,
        points=_points(subject, problem, found, sizes),
        predictions=[],
        discrepancy_pct={name: 100.0 * size for name, size in sizes.items()},
        next_point=suggestion,
        scatter_pct=None if is_known else 100.0 * found.scale,
        chi_square_per_degree=chi_square,
        rms_error_pct=100.0 * _rms(share),
        left_out_rms_error_pct=100.0 * _rms(left_out),
        degrees_of_freedom=degrees,
        evaluations=problem.solved,
        seconds=0.0,
        is_interrupted=found.is_interrupted,
    )


def _rms(values: FloatArray) -> float:
    return math.sqrt(float(np.mean(values**2))) if values.size else 0.0


def _parameters(problem: CaseProblem, found: Fit) -> list[FittedParameter]:
    rows = []
    posterior = np.sqrt(np.diag(found.posterior)).tolist()
    for index, graded in enumerate(problem.varied):
        value, error = float(found.values[index]), float(found.standard_errors[index])
        is_held = index in found.held
        rows.append(
            FittedParameter(
                path=graded.path,
                name=graded.short,
                unit=graded.scale.unit,
                value=value,
                standard_error=known(error),
                posterior_error=posterior[index],
                interval_95=[] if is_held else list(found.interval(index)),
                start=found.parameters[index].start,
                low=graded.low,
                high=graded.high,
                range_source=graded.source,
                state="held" if is_held else "at limit" if index in found.at_limit else "fitted",
            )
        )
    return rows


def _points(subject: Subject, problem: CaseProblem, found: Fit, sizes: dict[str, float]) -> list[FittedPoint]:
    quantile = found.quantile()
    own = quantile * found.prediction_deviation(found.jacobian)
    new = quantile * found.prediction_deviation(found.jacobian, found.errors)
    ends = np.column_stack([found.predicted - new, found.predicted + new])
    if sizes:
        ends = predicted(problem, found, sizes)[1].band()
    standardised, left_out, outliers = found.standardised, found.left_out, found.outliers
    independent = found.independent
    return [
        FittedPoint(
            **_where(subject, problem, entry),
            measured=float(found.data.values[i]),
            error=float(found.errors[i] * found.scale),
            predicted=float(found.predicted[i]),
            band=[float(found.predicted[i] - own[i]), float(found.predicted[i] + own[i])],
            new_measurement_band=ends[i].tolist(),
            standardised_residual=float(standardised[i]),
            independent_residual=float(independent[i]),
            left_out_error=float(left_out[i]),
            is_outlier=i in outliers,
        )
        for i, entry in enumerate(problem.entries)
    ]


def _warnings(problem: CaseProblem, found: Fit) -> list[str]:
    warnings = []
    if found.is_interrupted:
        warnings.append(
            "The fit was interrupted: errors count what is known so far, at most the ranges; other results are missing."
        )
    patterns = [test for test in found.tests if test.is_significant]
    if patterns:
        first = patterns[0]
        what = "are larger than the errors given" if first.name == "scatter" else f"show a {first.name}"
        warnings.append(
            f"The residuals {what} (p = {first.adjusted:.2g}): a law or a condition is wrong or missing, and fitted "
            "values only compensate for it."
        )
    larger = misfit(found.independent, len(found.free)) if found.data.is_error_known else 0.0
    if larger and not any(test.name == "scatter" for test in patterns):
        warnings.append(
            f"Typical residuals are {larger:.2g} times the errors given: an error, a condition or a law is wrong."
        )
    for index in found.at_limit:
        graded = problem.varied[index]
        warnings.append(
            f"{graded.short} ends at a limit of its range ({graded.low:.4g}..{graded.high:.4g}): a value beyond would "
            "fit better, so another term may be wrong."
        )
    return [*warnings, *_equal(problem.measurements), *_doubts(problem, found)]


def _equal(data: Measurements) -> list[str]:
    """Return a sentence about lines that agree in every column."""
    return [
        f"Lines {', '.join(map(str, lines))} of {data.name} agree in every column, and each counts as a measurement: "
        "remove copies."
        for lines in data.equal_lines()[:_MOST_EQUAL]
    ]


def _doubts(problem: CaseProblem, found: Fit) -> list[str]:
    """Return what the solver said about the points."""
    doubts = problem.doubts(found.values)
    if not doubts:
        return []
    line, said = next(iter(doubts.items()))
    others = [str(one) for one in doubts][1:]
    more = f" The same holds for line{'s' if others[1:] else ''} {', '.join(others)}." if others else ""
    return [f"{problem.measurements.name} line {line}: {'; '.join(said)}.{more}"]
