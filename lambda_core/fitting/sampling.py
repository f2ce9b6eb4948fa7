"""Sample the posterior of fitted parameters.

A fit takes the model as linear around its values. Where the data say little, or a value lies near the end of its range,
the posterior is not normal; samples show it as it is. They need thousands of predictions: these come from an
interpolation of the model over the region where the posterior lies, whose error is measured at further points.

References
----------
Affine-invariant ensembles: Goodman and Weare 2010, Commun. Appl. Math. Comput. Sci. 5, 65; emcee: Foreman-Mackey et al.
2013, Publ. Astron. Soc. Pac. 125, 306. Interpolation of costly models: Sacks et al. 1989, Statist. Sci. 4, 409.
Robust loss as density: Huber 1964, Ann. Math. Statist. 35, 73; how much it counts: Lyddon, Holmes and Walker 2019,
Biometrika 106, 465.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError
from lambda_core.fitting.least_squares import Fit
from lambda_core.fitting.model_calls import Model
from lambda_core.fitting.parameters import bounds

MOST = 100_000  # samples
_REGION = 6.0  # standard deviations around the fitted value that the interpolation reaches, within the range
_PER_PARAMETER = 12  # computed points of the interpolation
_CHECKED = 4  # further points at which its error is measured
_WALKERS = 32
_SETTLE, _APART = 400, 15  # steps before the first sample, and between two of a walker: several correlation times
_SEED = 1


@dataclass(frozen=True)
class Posterior:
    """Samples of the parameters.

    Attributes
    ----------
    samples : float64[:, :], shape (n, p)
    effective : float
        Number of independent samples that they are worth.
    interpolation_error : float
        Largest error of an interpolated prediction over the error of the measured value.
    """

    samples: FloatArray
    effective: float
    interpolation_error: float


def sampler_package() -> Any:
    """Return the package that samples.

    UsageError with what to install where it is missing.
    """
    try:
        import emcee
    except ImportError:
        raise UsageError(
            'samples of a posterior need another package: pip install "lambda-bearing[sampling]"'
        ) from None
    return emcee


def check_count(count: int) -> None:
    """Refuse a wrong number of samples.

    A number that is too small or too large raises a UsageError.
    """
    if not 1 <= count <= MOST:
        raise UsageError(f"--sample {count}: must be a number from 1 to {MOST}")
    sampler_package()


def sample(model: Model, found: Fit, count: int) -> Posterior:
    """Sample the posterior of all parameters.

    It includes parameters that the data do not determine.

    Before the measurements each parameter is uniform over its range. Residuals count as in the fit: the density of the
    measured values is exp(-c rho), with Huber's loss rho over the same errors, see :func:`loss_share` for c.

    Parameters
    ----------
    model : callable
        Returns the predicted values for values of the parameters.
    found : Fit
        What the fit found.
    count : int
        Number of samples.
    """
    emcee = sampler_package()
    low, high = _region(found)
    predict, error = _interpolation(model, found, low, high)
    share = loss_share(found)

    def logarithm(points: FloatArray) -> FloatArray:
        inside = np.all((points >= low) & (points <= high), axis=1)
        standardised = (predict(np.clip(points, low, high)) - found.data.values) / (found.errors * found.scale)
        standardised = found.shared.apart(standardised.T).T
        pull = np.minimum(np.abs(standardised), found.limit)
        loss = pull * (np.abs(standardised) - 0.5 * pull)
        return np.where(inside, -share * loss.sum(axis=1), -math.inf)

    random = np.random.RandomState(_SEED)  # the kind that the package takes
    walkers = max(_WALKERS, 4 * low.size)
    start = low + (high - low) * (0.01 + 0.98 * random.random_sample((walkers, low.size)))
    sampler = emcee.EnsembleSampler(walkers, low.size, logarithm, vectorize=True)
    sampler.random_state = random.get_state()
    steps = _APART * math.ceil(count / walkers)
    sampler.run_mcmc(start, _SETTLE + steps)
    chains = sampler.get_chain(discard=_SETTLE)
    time = float(np.max(emcee.autocorr.integrated_time(chains, tol=0)))
    kept = chains[::_APART].reshape(-1, low.size)[:count]
    return Posterior(kept, min(float(len(kept)), steps * walkers / max(time, 1.0)), error)


def loss_share(found: Fit) -> float:
    """Return how much Huber's loss counts in the posterior.

    Well-determined parameters then have the covariance V = factor (J^T J)^-1 of the fit (Lyddon, Holmes and Walker
    2019): the loss alone has the curvature mean(psi') J^T J, so it counts 1/(factor mean(psi')). Where few residuals
    lie within the limit, their share says little about psi'; it is then at least rms(psi)/rms(z), with which Huber's
    factor mean(psi^2)/mean(psi')^2 is that of least squares, which bounds the factor of the fit.
    """
    residuals = found.independent
    psi = np.clip(residuals, -found.limit, found.limit)
    ratio = math.sqrt(float(np.sum(psi**2)) / max(float(np.sum(residuals**2)), 1e-300))
    return 1.0 / (found.factor * max(float(np.mean(np.abs(residuals) < found.limit)), ratio))


def _region(found: Fit) -> tuple[FloatArray, FloatArray]:
    """Return the limits of the samples.

    They are the range, and not too far from the fitted value.
    """
    low, high = bounds(found.parameters)
    reach = _REGION * np.sqrt(np.diag(found.posterior))
    return np.maximum(low, found.values - reach), np.minimum(high, found.values + reach)


def _corners(count: int) -> FloatArray:
    """Return corners of a unit cube.

    It returns all corners for up to three sides.

    Of more, twice the power of two above their number: a Hadamard matrix and its mirror image, in which effects of
    single parameters and of pairs stay apart (Plackett and Burman 1946, Biometrika 33, 305; Box and Wilson 1951).
    """
    from scipy.linalg import hadamard

    signs = hadamard(2 ** count.bit_length())[:, 1 : count + 1]
    found: FloatArray = np.unique(np.vstack([signs, -signs]), axis=0) / 2.0 + 0.5
    return found


def _interpolation(
    model: Model, found: Fit, low: FloatArray, high: FloatArray
) -> tuple[Callable[[FloatArray], FloatArray], float]:
    """Return an interpolation of the model.

    It holds in the region. Also return its largest error over those of the measured values.
    """
    from scipy.interpolate import RBFInterpolator
    from scipy.stats import qmc

    computed = _PER_PARAMETER * low.size
    sequence = qmc.Halton(low.size, scramble=False).random(computed + _CHECKED + 1)[1:]  # the first is a corner
    shares = np.vstack([_corners(low.size), sequence])
    values = np.array([model(low + (high - low) * share) for share in shares])
    known = len(shares) - _CHECKED
    found_at = RBFInterpolator(shares[:known], values[:known], kernel="cubic", degree=2)
    missed = np.abs(found_at(shares[known:]) - values[known:]) / (found.errors * found.scale)

    def predict(points: FloatArray) -> FloatArray:
        result: FloatArray = found_at((points - low) / (high - low))
        return result

    return predict, float(missed.max())
