"""The model band: how far results may be off because parameters and laws are known within ranges only."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import CaseError, SolverError
from lambda_core.fit.graded import exchanges, graded_parameters, varied
from lambda_core.fit.operating_points import UNITS_OF, point_values
from lambda_core.fit.quantities import MEASURED
from lambda_core.fit.scores import COVERAGE, rounded
from lambda_core.results.record import INTERFACE, Record

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.fitted import FitOrigin

QUANTITIES = ("friction torque", "power loss", "minimum film", "maximum pressure", "capacitance")
_FIELDS = {
    **{name: measured.response for name, measured in MEASURED.items()},
    "maximum pressure": "max_pressure_GPa",
}
_NORMAL = 1.6448536269514722  # standard deviations of a normal distribution within which 90 % lie
_NAMED = 3  # largest contributors
_LEAST_SHARE = 0.02  # of the variance of a contributor that is named


class Contributor(Record):
    """One source of the band."""

    name: str
    share: float = Field(description="of the variance of the band")
    low: float = Field(description="result at one end of the range, or the smallest of all laws")
    high: float
    source: str


class Band(Record):
    """The band of one result."""

    quantity: str
    unit: str
    value: float
    low: float
    high: float
    contributors: list[Contributor]

    @property
    def half_width_pct(self) -> float:
        """Half of the width over the value [%]."""
        return 50.0 * (self.high - self.low) / abs(self.value) if self.value else math.nan

    def text(self) -> str:
        """Return the band in one line, rounded to what it leaves a meaning."""
        half = 0.5 * (self.high - self.low)
        shown = [rounded(number, half) for number in (self.value, self.low, self.high)]
        names = ", ".join(f"{c.name} {100.0 * c.share:.0f} %" for c in self.contributors[:_NAMED])
        why = f"; mostly {names}" if names else ""
        return f"{self.quantity} {shown[0]} {self.unit}, 90 % model band {shown[1]}..{shown[2]} {self.unit}{why}"


class ModelBand(Record):
    """The bands of the results of a case."""

    interface: int = INTERFACE
    case: str
    coverage: float
    bands: list[Band]
    left_out: list[str] = Field(description="what could not be varied, and why")

    def band(self, quantity: str) -> Band:
        """Return the band of one result."""
        return next(band for band in self.bands if band.quantity == quantity)

    def fields(self) -> dict[str, list[float]]:
        """Return the ends of each band under the name of its number in the machine interface, with ``_band``."""
        return {f"{_FIELDS[band.quantity]}_band": [band.low, band.high] for band in self.bands}

    def text(self) -> str:
        """Return a heading and one line per result."""
        head = "model band, quasi-static, mean over the positions of the balls:"
        return "\n".join([head, *(band.text() for band in self.bands), *self.left_out])


@dataclass(frozen=True)
class _Effect:
    """Logarithms of the results over those of the case, at each of some equally likely alternatives."""

    name: str
    source: str
    alternatives: FloatArray  # shape (alternatives, quantities)
    is_range: bool  # two ends of a uniform distribution; otherwise the alternatives are all there is

    @property
    def mean(self) -> FloatArray:
        found: FloatArray = self.alternatives.mean(axis=0)
        return found

    @property
    def variance(self) -> FloatArray:
        if self.is_range:
            found: FloatArray = np.ptp(self.alternatives, axis=0) ** 2 / 12.0
            return found
        return np.asarray(self.alternatives.var(axis=0))


@one_blas_thread()
def model_band(
    source: str | Path | Mapping[str, Any] | Case,
    overrides: Iterable[str] = (),
    *,
    quantities: Sequence[str] = QUANTITIES,
    announce: Callable[[str], None] | None = None,
) -> ModelBand:
    """Return the 90 % band of quasi-static results of a case.

    Each parameter is taken as uniformly distributed over its range, each law of a role as equally likely, all
    independent of each other; their effects on the logarithm of a result are added (first order). The values of a
    fitted case have the errors and correlations of the fit in place of their ranges, and their laws are kept.

    Parameters
    ----------
    source, overrides
        As for :func:`check`.
    quantities : sequence of str
        Results: "friction torque", "power loss", "minimum film", "maximum pressure", "capacitance".
    announce : callable, optional
        Called with a sentence before something takes longer.

    Returns
    -------
    ModelBand
        ``text()`` has a line per result.

    Raises
    ------
    CaseError, SolverError
        With a sentence about the case.

    References
    ----------
    First-order propagation with uniform distributions: JCGM 100:2008, sections 4.3.7 and 5.1.2.
    """
    from lambda_core.case.case_io import apply_overrides
    from lambda_core.case.case_writer import standalone_toml
    from lambda_core.model.cases import case_of

    case = apply_overrides(case_of(source), overrides)
    text, names = standalone_toml(case), tuple(quantities)
    base = point_values(text, (), names).mean(axis=0)
    one = point_values(text, (), names, one=True)[0]
    left_out: list[str] = []
    if announce is not None:
        announce("computing the model band from the ranges of parameters and laws")
    effects = list(_effects(case, text, names, one, left_out))
    return ModelBand(
        case=case.name,
        coverage=COVERAGE,
        bands=[_band(name, i, float(base[i]), effects) for i, name in enumerate(names)],
        left_out=left_out,
    )


def _effects(case: Case, text: str, names: tuple[str, ...], base: FloatArray, left_out: list[str]) -> Iterator[_Effect]:
    """Yield the effects of all parameters and laws; what has no solution is left out and named."""
    from lambda_core.study.job import resolve_point

    model = resolve_point(text, ())
    fitted = {} if case.fit is None else {row.path: row for row in case.fit.parameters}
    if case.fit is not None:
        yield from _fitted(case.fit, text, names, base)
    for graded in graded_parameters(model):
        if graded.path in fitted or not graded.low < graded.high:
            continue
        try:
            ends = [_logarithms(text, graded.changes(end), names, base) for end in (graded.low, graded.high)]
        except (CaseError, SolverError) as error:
            left_out.append(f"{graded.short} is left out: {_first(error)}")
            continue
        yield _Effect(graded.short, graded.source, np.array(ends), is_range=True)
    for exchange in exchanges(model):
        if any(path.startswith(f"parameters.{exchange.role}.") for path in fitted):
            continue
        found = [np.zeros(len(names))]
        for law in exchange.laws:
            try:
                found.append(_logarithms(_with_law(case, exchange.role, law), (), names, base))
            except (CaseError, SolverError) as error:
                left_out.append(f"{exchange.role} {law} is left out: {_first(error)}")
        yield _Effect(f"law of {exchange.role}", exchange.source, np.array(found), is_range=False)


def _with_law(case: Case, role: str, law: str) -> str:
    """Return a case with another law, without the parameters of its own one."""
    from lambda_core.case.case_writer import standalone_toml

    return standalone_toml(case.with_(models={role: law}, parameters={role: None}))


def _fitted(fit: FitOrigin, text: str, names: tuple[str, ...], base: FloatArray) -> Iterator[_Effect]:
    """Yield the effect of the errors of the fitted values, and of the ranges of values that were held.

    Over the range of a held value the fitted ones follow their regression on it: the data hold for each of its values.
    """
    from lambda_core.study.job import resolve_point

    rows, model = fit.parameters, resolve_point(text, ())
    graded = [varied(model, f"{row.path}={_ends(row)}") for row in rows]
    deviation = np.array([row.standard_error for row in rows])
    matrix = np.array(fit.correlation) * np.outer(deviation, deviation)
    values = np.array([row.value for row in rows])
    held = np.array([bool(row.range) for row in rows])

    def logarithms(moved: FloatArray) -> FloatArray:
        changes = [
            change for entry, number in zip(graded, moved.tolist(), strict=True) for change in entry.changes(number)
        ]
        return _logarithms(text, tuple(changes), names, base)

    follow = np.zeros((len(rows), len(rows)))
    if held.any():
        follow[:, held] = matrix[:, held] @ np.linalg.inv(matrix[np.ix_(held, held)])
    for index in np.flatnonzero(held):
        ends = [logarithms(values + follow[:, index] * (end - values[index])) for end in rows[index].range]
        yield _Effect(f"{graded[index].short} (not fitted)", graded[index].source, np.array(ends), is_range=True)
    if held.all():
        return
    rest = matrix - follow @ matrix
    sizes, vectors = np.linalg.eigh(rest[np.ix_(~held, ~held)])
    parts = []
    for size, vector in zip(sizes, vectors.T, strict=True):
        step = np.zeros(len(rows))
        step[~held] = math.sqrt(max(float(size), 0.0)) * vector
        parts.append(0.5 * (logarithms(values + step) - logarithms(values - step)))
    # As two alternatives with the variance of all components together.
    total = np.sqrt(np.sum(np.square(parts), axis=0))
    yield _Effect("fitted values", f"fitted to {fit.file}", np.array([total, -total]), is_range=False)


def _ends(row: Any) -> str:
    ends = (row.value - row.standard_error, row.value + row.standard_error)
    return "..".join(f"{end!r} {row.unit}".rstrip() for end in ends)


def _logarithms(text: str, changes: tuple[str, ...], names: tuple[str, ...], base: FloatArray) -> FloatArray:
    """Return ln of the results over those of the case, at one position of the balls."""
    values = point_values(text, changes, names, one=True)[0]
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.log(values / base)
    return np.where(np.isfinite(ratio), ratio, 0.0)


def _band(name: str, index: int, value: float, effects: Sequence[_Effect]) -> Band:
    means = np.array([effect.mean[index] for effect in effects])
    variances = np.array([effect.variance[index] for effect in effects])
    total, shift = float(variances.sum()), float(means.sum())
    half = _NORMAL * math.sqrt(total)
    order = np.argsort(-variances)
    contributors = [
        Contributor(
            name=effects[i].name,
            share=float(variances[i]) / total,
            low=value * math.exp(float(effects[i].alternatives[:, index].min())),
            high=value * math.exp(float(effects[i].alternatives[:, index].max())),
            source=effects[i].source,
        )
        for i in order
        if total > 0.0 and variances[i] >= _LEAST_SHARE * total
    ]
    return Band(
        quantity=name,
        unit=UNITS_OF[name],
        value=value,
        low=value * math.exp(shift - half),
        high=value * math.exp(shift + half),
        contributors=contributors,
    )


def _first(error: Exception) -> str:
    return " ".join(str(error).split())[:160]
