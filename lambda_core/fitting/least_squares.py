"""Solve robust weighted least squares with errors in both variables."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.number_text import counted
from lambda_core.fitting import uncertainty as U
from lambda_core.fitting.data import Data
from lambda_core.fitting.model_calls import Model, ModelCalls
from lambda_core.fitting.parameters import Parameter, bounds, spreads, starts
from lambda_core.fitting.residual_tests import ResidualTest, residual_tests
from lambda_core.fitting.shared_errors import SharedErrors, errors_of

_ROUNDS = 6  # of weights from the residuals of the round before
_SETTLED = 0.02  # of a standard deviation, and of the scatter: change that ends the rounds
_COSTLY_TOLERANCE = 1e-4  # relative change of the cost that ends a round of a costly model
_NORMAL_MAD = 1.482602218505602  # standard deviation over median absolute deviation of a normal distribution
_STEP = 1e-6  # of a parameter, for slopes where no Jacobian is given
_OUTLIER = 3.5  # standardised residual (Iglewicz and Hoaglin 1993)
_AT_LIMIT = 1e-3  # of the distance between the bounds
CONFIDENCE = 0.95


@dataclass(frozen=True)
class Fit:
    """Result of a fit.

    Attributes
    ----------
    parameters : tuple of Parameter
        All that were to be varied.
    values : float64[:], shape (p,)
        At the solution; a parameter that is held has its start value.
    covariance : float64[:, :], shape (p, p)
        Of the values; zero rows for held ones.
    held : tuple of int
        Parameters that the data do not determine.
    at_limit : tuple of int
        Parameters at one of their bounds.
    predicted, errors : float64[:], shape (n,)
        Predicted values; standard deviations of the measured ones with those of the operating conditions.
    shared : SharedErrors
        Which of these the values of one operating point, or all, have in common.
    jacobian : float64[:, :], shape (n, p)
        Derivatives of the predicted values by all parameters.
    directions : list of Direction
        Combinations of all parameters, best determined first.
    scale : float
        Scatter of the residuals over `errors`, 1 where the errors are known.
    factor : float
        On (J^T J)^-1 of the covariance, above 1 where residuals are larger than their errors.
    tests : list of ResidualTest
        Whether residuals show a pattern.
    evaluations : int
        Of the model.
    is_interrupted : bool
        Whether it was stopped before it ended: the values are the best so far.
    """

    parameters: tuple[Parameter, ...]
    data: Data
    values: FloatArray
    covariance: FloatArray
    held: tuple[int, ...]
    at_limit: tuple[int, ...]
    predicted: FloatArray
    errors: FloatArray
    shared: SharedErrors
    jacobian: FloatArray
    directions: list[U.Direction]
    scale: float
    factor: float
    limit: float
    tests: list[ResidualTest]
    evaluations: int
    is_interrupted: bool = False

    @property
    def free(self) -> list[int]:
        """Parameters that were fitted."""
        return [index for index in range(len(self.parameters)) if index not in self.held]

    @property
    def degrees(self) -> int:
        """Degrees of freedom of the residuals."""
        return self.data.values.size - len(self.free)

    @property
    def standard_errors(self) -> FloatArray:
        """Standard deviations of the values; NaN for held ones."""
        found = np.sqrt(np.diag(self.covariance))
        found[list(self.held)] = math.nan
        return found

    @property
    def correlations(self) -> FloatArray:
        """Correlations of the fitted parameters, shape (f, f)."""
        return U.correlations(self.covariance[np.ix_(self.free, self.free)])

    @property
    def standardised(self) -> FloatArray:
        """Measured less predicted values over their errors."""
        found: FloatArray = (self.data.values - self.predicted) / (self.errors * self.scale)
        return found

    @property
    def independent(self) -> FloatArray:
        """Residuals with independent errors of size one.

        They are the standardised ones where each point has one value.
        """
        return self.shared.apart(self.standardised)

    @property
    def slopes(self) -> FloatArray:
        """Derivatives of the independent residuals' predictions."""
        return self.shared.apart(self.jacobian / (self.errors * self.scale)[:, None])

    @property
    def weights(self) -> FloatArray:
        """Share with which each independent residual counts."""
        return U.huber_weights(self.independent, self.limit)

    @property
    def information(self) -> FloatArray:
        """Derivatives whose square is the information.

        It counts the weights of the residuals, not yet their factor; shape (min(n, p), p).
        """
        return U.counted(self.slopes, self.weights)

    @property
    def _basis(self) -> FloatArray:
        """Orthonormal basis of what the parameters change."""
        if not self.jacobian[:, self.free].any():  # all are held, or the search was stopped before it had slopes
            return np.zeros((self.data.values.size, 0))
        found: FloatArray = np.linalg.qr(self.slopes[:, self.free] * np.sqrt(self.weights)[:, None])[0]
        return found

    @property
    def outliers(self) -> list[int]:
        """Values whose residual, alone or among others, is too large."""
        size = np.maximum(np.abs(self.standardised), np.abs(self.independent))
        if math.isinf(self.limit):
            size = size / np.sqrt(1.0 - U.leverages(self._basis))
        return [int(index) for index in np.flatnonzero(size > _OUTLIER)]

    @property
    def left_out(self) -> FloatArray:
        """Error of each point's prediction from the others.

        It is the predicted less the measured value.
        """
        roots = np.sqrt(self.weights)
        apart = self.shared.apart(np.eye(roots.size)) * roots[:, None]
        found = U.left_out_residuals(-self.independent * roots, self._basis, apart, self.data.groups)
        return found * self.errors * self.scale

    def quantile(self, confidence: float = CONFIDENCE) -> float:
        """Return the quantile of Student's distribution for degrees of freedom.

        It is two-sided.
        """
        from scipy.stats import t

        return float(t.ppf(0.5 + 0.5 * confidence, max(self.degrees, 1)))

    def interval(self, index: int) -> tuple[float, float]:
        """Return a parameter's confidence interval."""
        value, half = float(self.values[index]), self.quantile() * float(self.standard_errors[index])
        return value - half, value + half

    @property
    def posterior(self) -> FloatArray:
        """Covariance of all parameters, with what their ranges say.

        Without a range that is nothing for fitted ones.
        """
        spread = spreads(self.parameters)
        information = self.information.T @ self.information / self.factor
        low, high = bounds(self.parameters)
        known = np.isfinite(high - low)
        known[list(self.held)] = True
        information[known, known] += 1.0 / spread[known] ** 2
        scaled = np.linalg.inv(information * np.outer(spread, spread))
        found: FloatArray = scaled * np.outer(spread, spread)
        return found

    def prediction_deviation(self, gradients: FloatArray, errors: FloatArray | float = 0.0) -> FloatArray:
        """Return the standard deviation of predicted values.

        It includes that of new measurements where given.
        """
        variance = U.prediction_variance(gradients, self.posterior)
        found: FloatArray = np.sqrt(variance + (np.asarray(errors) * self.scale) ** 2)
        return found

    def contains(self, truth: FloatArray, confidence: float = CONFIDENCE) -> bool:
        """Tell whether values lie in the confidence region.

        It is the joint region of the fitted parameters.
        """
        from scipy.stats import f

        free = self.free
        away = (np.asarray(truth) - self.values)[free]
        distance = float(away @ np.linalg.solve(self.covariance[np.ix_(free, free)], away))
        return distance <= len(free) * float(f.ppf(confidence, len(free), max(self.degrees, 1)))


def fit(
    model: Model,
    parameters: Sequence[Parameter],
    data: Data,
    *,
    jacobian: Model | None = None,
    input_slopes: Model | None = None,
    limit: float = U.HUBER,
    is_costly: bool = False,
) -> Fit:
    """Fit parameters to measured values.

    Parameters
    ----------
    model : callable
        Returns the predicted values for values of the parameters.
    parameters : sequence of Parameter
        What is varied; those that the data cannot determine are held and reported.
    data : Data
        What was measured.
    jacobian : callable, optional
        Derivatives by the parameters, shape (n, p); central differences without it.
    input_slopes : callable, optional
        Derivatives by the operating conditions that have errors, shape (n, k).
    limit : float
        Residual in units of its error from which it counts less (Huber's loss); infinite for plain least squares.
    is_costly : bool
        Update the Jacobian between steps where that is accurate enough; the last one is always computed.

    Returns
    -------
    Fit
        Also after an interruption (Ctrl+C): then with the best values so far; KeyboardInterrupt where there are none.

    Raises
    ------
    ValueError
        When there are no more points than parameters.

    References
    ----------
    Errors of the operating conditions by effective variances: Orear 1982, Am. J. Phys. 50, 912. Robust loss: Huber
    1964, Ann. Math. Statist. 35, 73. Scatter by the median absolute deviation: Huber and Ronchetti 2009, section 5.1.
    """
    if data.values.size <= len(parameters):
        raise ValueError(
            f"{counted(data.values.size, 'measured value')} for {counted(len(parameters), 'parameter')}: too few, "
            "vary fewer parameters or add operating points"
        )
    step = _STEP * np.maximum(np.abs(starts(parameters)), spreads(parameters) * 1e-3)
    recorder = ModelCalls(model, jacobian, step)
    search = _Search(recorder, tuple(parameters), data, input_slopes, limit, is_costly)
    try:
        search.run([])
        held = search.inseparable()
        if held:
            search.run(held)
        return search.outcome()
    except KeyboardInterrupt:
        if not search.stop():
            raise
    return search.outcome()


class _Search:
    """Rounds of least squares with weights from the round before."""

    def __init__(
        self,
        recorder: ModelCalls,
        parameters: tuple[Parameter, ...],
        data: Data,
        input_slopes: Model | None,
        limit: float,
        is_costly: bool,
    ) -> None:
        self._costly = is_costly
        self._recorder, self._parameters, self._data = recorder, parameters, data
        self._input_slopes, self._limit = input_slopes, limit
        self._point = starts(parameters)
        self._errors, self._shared, self._scale = data.errors, SharedErrors(), 1.0  # of the first round
        self._held: list[int] = []
        self._interrupted = False

    def run(self, held: list[int]) -> None:
        """Minimise over the free parameters.

        It ends when weights and values settle; held parameters stay.
        """
        self._held = held
        self._point = np.where(np.isin(np.arange(self._point.size), held), starts(self._parameters), self._point)
        if len(held) == len(self._parameters):
            self._take_errors()
            return
        for number in range(_ROUNDS):
            before, scale = self._point, self._scale
            self._take_errors()
            self._point = self._minimised()
            if not self._needs_rounds():
                break
            moved = np.abs(self._point - before) / np.maximum(self._deviations(), 1e-300)
            if number and float(moved.max()) < _SETTLED and abs(self._scale / scale - 1.0) < _SETTLED:
                break

    def _needs_rounds(self) -> bool:
        """Tell whether the search needs further rounds.

        Errors, scatter or an updated Jacobian may depend on the solution.
        """
        data = self._data
        is_moved = bool(data.input_errors.size or data.value_shares.size)
        return not data.is_error_known or is_moved or data.is_proportional or self._costly

    def inseparable(self) -> list[int]:
        """Return the parameters that the data do not determine."""
        spread = spreads(self._parameters)
        kept = U.separable(self._weighted(range(len(self._parameters))), spread, U.NORMAL_FACTOR)
        return [index for index in range(len(self._parameters)) if index not in kept]

    def stop(self) -> bool:
        """Take the best point so far, if any."""
        self._interrupted = True
        cost, point = self._recorder.best
        if math.isfinite(cost):
            self._point = point
        return self._recorder.knows(self._point)

    def outcome(self) -> Fit:
        """Put together what was found."""
        data, parameters, count = self._data, self._parameters, len(self._parameters)
        free = [index for index in range(count) if index not in self._held]
        matrix, factor = np.zeros((count, count)), self._factor()
        if self._interrupted:
            matrix = self._known_so_far(factor)
        elif free:
            matrix[np.ix_(free, free)] = U.covariance(self._counted(free), factor)
        weighted = self._weighted_slopes()
        names = [parameter.name for parameter in parameters]
        low, high = bounds(parameters)
        margin = _AT_LIMIT * np.where(np.isfinite(high - low), high - low, 0.0)
        at_limit = (self._point - low < margin) | (high - self._point < margin)
        parts = U.directions(weighted, names, spreads(parameters), U.NORMAL_FACTOR) if weighted.any() else []
        found = Fit(
            parameters, data, self._point, matrix, tuple(self._held),
            tuple(index for index in free if at_limit[index]), self._predicted(), self._errors, self._shared,
            self._slopes(), parts, self._scale, factor, self._limit, [], self._recorder.evaluations, self._interrupted,
        )  # fmt: skip
        if self._interrupted or found.degrees < 1:
            return found
        clipped = np.clip(found.independent, -self._limit, self._limit)
        tests = residual_tests(clipped, weighted[:, free], data.columns, is_error_known=data.is_error_known)
        return replace(found, tests=tests)

    def _known_so_far(self, factor: float) -> FloatArray:
        """Return the covariance after an interruption.

        The data may not have told anything yet: then it is that of the ranges.
        """
        slopes = self._weighted_slopes()
        free = np.isin(np.arange(slopes.shape[1]), self._held, invert=True)
        information = slopes.T @ slopes / (factor if factor > 0.0 else 1.0)
        information[np.diag_indices_from(information)] += 1.0 / spreads(self._parameters) ** 2
        size = 1.0 / np.sqrt(np.diag(information))
        matrix: FloatArray = np.linalg.pinv(information * np.outer(size, size)) * np.outer(size, size)
        return matrix * np.outer(free, free)

    def _predicted(self) -> FloatArray:
        return self._recorder.values(self._point)

    def _slopes(self) -> FloatArray:
        if self._interrupted:
            return self._recorder.last_slopes(self._point, self._data.values.size)
        return self._recorder.slopes(self._point)

    def _weighted_slopes(self) -> FloatArray:
        """Return derivatives of the independent residuals."""
        return self._shared.apart(self._slopes() / (self._errors * self._scale)[:, None])

    def _weighted(self, columns: Sequence[int] | range) -> FloatArray:
        """Return derivatives over errors, with a row for every prior."""
        return self._with_priors(self._weighted_slopes(), columns)

    def _counted(self, columns: Sequence[int]) -> FloatArray:
        """Return the same with the weights of the residuals."""
        slopes = np.zeros((self._data.values.size, len(self._parameters)))
        slopes[:, columns] = self._weighted_slopes()[:, columns]
        weights = U.huber_weights(self._standardised() / self._scale, self._limit)
        return self._with_priors(U.counted(slopes, weights), columns)

    def _with_priors(self, slopes: FloatArray, columns: Sequence[int] | range) -> FloatArray:
        """Return columns of derivatives, with a row for every prior."""
        eye = np.eye(len(self._parameters))
        priors = [eye[index] / prior.spread for index, prior in enumerate(self._parameters) if prior.is_prior]
        found: FloatArray = np.vstack([slopes, *priors])[:, list(columns)]
        return found

    def _standardised(self) -> FloatArray:
        return self._shared.apart((self._data.values - self._predicted()) / self._errors)

    def _take_errors(self) -> None:
        """Take errors of measured values at the present point.

        They include those of the operating conditions and of instruments, which several values share.
        """
        slopes = None
        if self._input_slopes is not None and self._data.input_errors.size:
            slopes = np.asarray(self._input_slopes(self._point))
        self._errors, self._shared = errors_of(self._data, self._predicted(), slopes)
        self._scale = self._scatter()

    def _scatter(self) -> float:
        """Return the residuals' scatter over their errors.

        1 where the errors are known.
        """
        if self._data.is_error_known:
            return 1.0
        residuals, free = self._standardised(), len(self._parameters) - len(self._held)
        ratio = residuals.size / (residuals.size - free)
        if math.isinf(self._limit):
            return math.sqrt(float(np.mean(residuals**2)) * ratio)
        return max(_NORMAL_MAD * float(np.median(np.abs(residuals))) * math.sqrt(ratio), 1e-12)

    def _factor(self) -> float:
        """Return the factor on (J^T J)^-1.

        Residuals larger than their known errors widen it (Birge 1932).
        """
        residuals, free = self._standardised() / self._scale, len(self._parameters) - len(self._held)
        if math.isinf(self._limit):
            own = float(np.sum(residuals**2)) / (residuals.size - free)
            return max(1.0, own) if self._data.is_error_known else own
        own = U.robust_factor(residuals, free, self._limit)
        # Where few points are left inside the limit, the robust formula overstates what the residuals show.
        own = min(own, float(np.sum(residuals**2)) / (residuals.size - free))
        return max(U.NORMAL_FACTOR, own)

    def _deviations(self) -> FloatArray:
        free = [index for index in range(len(self._parameters)) if index not in self._held]
        found = np.full(len(self._parameters), math.inf)
        found[free] = np.sqrt(np.diag(U.covariance(self._counted(free), self._factor())))
        return found

    def _minimised(self) -> FloatArray:
        """Minimise with the present errors and scatter."""
        from scipy.optimize import least_squares

        free = [index for index in range(len(self._parameters)) if index not in self._held]
        spread = spreads(self._parameters)
        low, high = (side[free] for side in bounds(self._parameters))
        errors = self._errors * self._scale

        def all_parameters(part: FloatArray) -> FloatArray:
            point = self._point.copy()
            point[free] = part
            return point

        def residuals(part: FloatArray) -> FloatArray:
            point = all_parameters(part)
            own = self._shared.apart((self._recorder.values(point) - self._data.values) / errors)
            priors = [(point[i] - p.start) / p.spread for i, p in enumerate(self._parameters) if p.is_prior]
            found = np.concatenate([own, priors])
            cost = float(np.sum(np.abs(found)))
            if cost < self._recorder.best[0]:
                self._recorder.best = (cost, point)
            return found

        def slopes(part: FloatArray) -> FloatArray:
            point = all_parameters(part)
            own = self._recorder.near_slopes(point, spread) if self._costly else self._recorder.slopes(point)
            return self._with_priors(self._shared.apart(own / errors[:, None]), free)

        self._recorder.best = (math.inf, self._point)
        self._recorder.slopes(self._point)  # each round begins with computed derivatives
        inside = np.clip(self._point[free], low, high)
        robust = math.isfinite(self._limit)
        solved = least_squares(
            residuals, inside, slopes, bounds=(low, high), x_scale=spread[free],
            loss="huber" if robust else "linear", f_scale=self._limit if robust else 1.0,
            xtol=1e-12, gtol=1e-14, ftol=_COSTLY_TOLERANCE if self._costly else 1e-8 if robust else 1e-14,
        )  # fmt: skip
        return all_parameters(solved.x)
