"""Write the answer of a fit."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pydantic import Field

from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.results.record import INTERFACE, Record

if TYPE_CHECKING:
    from lambda_core.views.chart import ViewData


class FittedParameter(Record):
    """One parameter of a fit."""

    path: str = Field(description="option of the case")
    name: str
    unit: str
    value: float
    standard_error: float | None = Field(description="null for a parameter that is held")
    posterior_error: float = Field(description="standard deviation, with what the range says")
    interval_95: list[float] = Field(description="95 % confidence interval; empty for a parameter that is held")
    start: float
    low: float = Field(description="lower end of its range")
    high: float
    range_source: str
    state: str = Field(description="fitted, at limit, or held: the data do not determine it")


class FittedPoint(Record):
    """One measured value and its prediction."""

    line: int = Field(description="of the file of measurements")
    label: str
    conditions: dict[str, float] = Field(description="operating conditions in SI")
    quantity: str
    unit: str
    measured: float
    error: float = Field(description="standard deviation, with that of the operating conditions")
    predicted: float
    band: list[float] = Field(description="95 % confidence band of the prediction, the laws taken as exact")
    new_measurement_band: list[float] = Field(
        description="95 % band of one more measurement, with what the laws may be wrong by"
    )
    standardised_residual: float
    independent_residual: float = Field(description="the same without what errors in common explain")
    left_out_error: float = Field(description="prediction from all other points, less the measured value")
    is_outlier: bool


class PredictedPoint(Record):
    """Unseen measured value with its prediction."""

    line: int = Field(description="of its file")
    label: str
    conditions: dict[str, float] = Field(description="operating conditions in SI")
    quantity: str
    unit: str
    measured: float
    predicted: float = Field(description="by the fitted values")
    band: list[float] = Field(description="95 % band of the measurement: errors of fit, laws, conditions and its own")
    is_inside: bool


class ParameterCombination(Record):
    """Combination of parameters with its uncertainty.

    It shows how well the data determine it.
    """

    weights: dict[str, float]
    spread: float | None = Field(description="standard deviation over that before the fit; null without information")
    is_determined: bool


class PatternTest(Record):
    """A test whether residuals show a pattern."""

    name: str
    p_value: float
    adjusted_p_value: float = Field(description="with all tests of the fit taken into account")
    is_significant: bool


class SuggestedPoint(Record):
    """Most informative further operating point."""

    conditions: dict[str, str]
    combination: dict[str, float] = Field(description="the combination that is determined worst")
    spread_before: float
    spread_after: float


class SampledParameter(Record):
    """Posterior samples of one parameter."""

    path: str
    name: str
    unit: str
    median: float
    interval_95: list[float] = Field(description="between which 95 % of the samples lie")
    samples: list[float]


class SampledPosterior(Record):
    """Samples of the posterior.

    The range of each parameter before the fit, and the measured values.
    """

    parameters: list[SampledParameter] = Field(description="all, those that the data do not determine included")
    effective: float = Field(description="number of independent samples that they are worth")
    interpolation_error: float = Field(
        description="largest error of an interpolated prediction over the error of the measured value"
    )


class FitReport(Record):
    """Result of a fit to measurements."""

    interface: int = INTERFACE
    case: str
    title: str
    file: str
    sha256: str = Field(description="hash of the file of measurements")
    date: str = Field(description="when the fit was made")
    sentence: str = Field(description="what the data determine")
    warnings: list[str] = Field(description="reasons to doubt the fitted values")
    parameters: list[FittedParameter] = Field(description="in the order in which they were named")
    correlation: list[list[float]] = Field(description="of the parameters that are not held, in their order")
    posterior_correlation: list[list[float]] = Field(description="of all parameters, with what their ranges say")
    combinations: list[ParameterCombination] = Field(description="best determined first")
    tests: list[PatternTest] = Field(description="clearest pattern first")
    condition_quantities: dict[str, str] = Field(description="physical quantity of each operating condition")
    points: list[FittedPoint] = Field(description="measured values, in the order of the file")
    unsolved_lines: list[int] = Field(default=[], description="lines without a solution, which are left out")
    predictions: list[PredictedPoint] = Field(description="points of a second file that the fit has not seen")
    discrepancy_pct: dict[str, float] = Field(
        description="standard deviation of what the laws may be wrong by, by quantity: the ranges that are not fitted"
    )
    posterior: SampledPosterior | None = Field(default=None, description="samples; null unless requested")
    next_point: SuggestedPoint | None = Field(description="to measure next; null where none was looked for")
    scatter_pct: float | None = Field(description="standard deviation of the residuals; null where errors are known")
    chi_square_per_degree: float | None = Field(description="null where errors are not known")
    rms_error_pct: float = Field(description="root mean square of predicted over measured value less one")
    left_out_rms_error_pct: float = Field(description="the same where each point is predicted from all others")
    degrees_of_freedom: int = Field(description="measured values less fitted parameters")
    evaluations: int = Field(description="equilibria solved")
    seconds: float = Field(description="wall time")
    is_interrupted: bool = Field(description="whether the values are the best before an interruption")

    def text(self, width: int | None = None, units: UnitSystem = SI) -> str:
        """Return the lines for people."""
        from lambda_core.fitting.report_text import report_text

        return report_text(self, width, units)

    def pictures(self) -> list[ViewData]:
        """Return measured and predicted values, and the residuals, for :func:`lambda_core.api.draw`."""
        from lambda_core.fitting.pictures import fit_pictures

        return fit_pictures(self)


def known(value: float) -> float | None:
    """Return a number for JSON.

    None for what is not finite.
    """
    return value if math.isfinite(value) else None
