"""Compute how far uncertain parameters and laws move results."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from pydantic import ValidationError

from lambda_core.analysis.band.changed import as_loaded, is_of_laws, resolved_anew, with_laws, with_value
from lambda_core.analysis.band.graded import Exchange, Graded, Resolver, exchanges, graded_parameters, named
from lambda_core.analysis.band.readings import POSITIONS, READ, read_values
from lambda_core.analysis.thermal.losses import model_at
from lambda_core.case.fitted import finished_fit
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, LambdaError, Problem, SolverError, UsageError
from lambda_core.model.bearing_model import BearingModel
from lambda_core.results.model_band import LAW_OF
from lambda_core.solver.drivers.compiled_laws import Kernels
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.drivers.near_equilibrium import solve_near

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.fitted import FitOrigin, FittedValue

_MOST_LOST = 2  # changes without an equilibrium; each takes a second or two, and a band without them says little
_SAME = 1e-6  # of a fitted value, which a case has to ten digits
SEEN_STEPS = (0.5, 0.5e-6)  # of the temperature at the inlets [K] and of the clearance [m], for slopes


@dataclass(frozen=True)
class Effect:
    """Logarithms of results over those of the case.

    There is one for each of some equally likely alternatives.

    Attributes
    ----------
    alternatives : float64[:, :], shape (alternatives, quantities)
    is_range : bool
        Whether they are the two ends of a uniform distribution; otherwise they are all there is.
    """

    name: str
    source: str
    alternatives: FloatArray
    is_range: bool

    @property
    def mean(self) -> FloatArray:
        """Mean of the alternatives."""
        found: FloatArray = self.alternatives.mean(axis=0)
        return found

    @property
    def variance(self) -> FloatArray:
        """Variance of the distribution."""
        if self.is_range:
            found: FloatArray = np.ptp(self.alternatives, axis=0) ** 2 / 12.0
            return found
        return np.asarray(self.alternatives.var(axis=0))


class Effects:
    """Effects of ranges and exchanges on a model's results.

    Each range of a parameter and each exchange of a law has its effect.

    Parameters
    ----------
    model : BearingModel
        Resolved, at known temperatures.
    quantities : sequence of str
        Keys of `READ`; results that the model does not have are left out.
    without : collection of str
        Paths of parameters that are not varied. Laws are exchanged none the less, but those of a fitted case.

    Attributes
    ----------
    case : str
        Name of the case.
    names : tuple of str
        Results that there are.
    left_out : list of str
        What could not be varied, and why; after the effects were asked for.
    """

    def __init__(
        self,
        model: BearingModel,
        quantities: Sequence[str],
        without: Iterable[str] = (),
    ) -> None:
        self._model, self.case = model, model.name
        self._kernels = Kernels(model)
        self._base = solve(model, self._kernels, phase=POSITIONS[0])
        self.names = tuple(name for name in quantities if self._has(name))
        self._values = self._read(self._base)
        self._fit = finished_fit(model.case.fit)
        fitted = [row.path for row in self._fit.parameters] if self._fit is not None else []
        self._without = {*without, *fitted}
        self._kept = {path.split(".")[1] for path in fitted if path.startswith("parameters.")}  # laws of fitted values
        self.left_out: list[str] = []
        self._lost = 0

    def values_at_all_positions(self) -> FloatArray:
        """Return the results, averaged over the ball positions."""

        def solved(phase: float) -> Equilibrium:
            if phase == self._base.phase:
                return self._base
            try:
                near = self._base if self._model.rollers is None else None
                return solve(self._model, self._kernels, by_warmer_oil=False, phase=phase, near=near)
            except SolverError:
                raise SolverError("there is no equilibrium with friction at other positions of the balls") from None

        found: FloatArray = read_values(solved, [READ[name] for name in self.names]).mean(axis=0)
        return found

    def by_seen(self) -> FloatArray:
        """Return slopes of the logarithms, shape (2, n).

        The slopes are by the temperature of the oil [1/K] and by the clearance [1/m].
        """
        inlet, clearance = self._model.oil.temperature, self._model.geometry.clearance
        moved = (
            model_at(self._model, inlet + SEEN_STEPS[0], clearance),
            model_at(self._model, inlet, clearance + SEEN_STEPS[1]),
        )
        changes = [self._logarithms(one, near=False) for one in moved]
        return np.asarray(np.array(changes) / np.array(SEEN_STEPS)[:, np.newaxis])

    def all(self) -> Iterator[Effect]:
        """Yield the effects of all parameters and laws.

        Changes without a solution are left out and named.
        """
        from lambda_core.discovery.api import registry
        from lambda_core.model.resolve import resolve

        models = registry()
        with closing(models.catalogue()) as catalogue:

            def resolver(case: Case) -> BearingModel:
                return resolve(case, models, catalogue, is_static=True)

            if self._fit is not None:
                yield from self._fitted(self._fit, resolver)
            yield from self._ranges(resolver)
            yield from self._exchanges(resolver)

    def _ranges(self, resolver: Resolver) -> Iterator[Effect]:
        for graded in graded_parameters(self._model, resolver):
            if graded.path in self._without or not graded.low < graded.high:
                continue
            self._check_lost()

            def ends(graded: Graded = graded) -> list[FloatArray]:
                return [self._at_end(graded, number, resolver) for number in (0, 1)]

            yield from range_effect(graded, ends, self.left_out)

    def _at_end(self, graded: Graded, number: int, resolver: Resolver) -> FloatArray:
        """Return ln of relative results at a range's end."""
        end = (graded.low, graded.high)[number]
        if end == graded.value:
            return np.zeros(len(self.names))
        moved = graded.models[number] if graded.models else with_value(self._model, graded, end, resolver)
        return self._logarithms(as_loaded(moved, self._model), near=is_of_laws(graded))

    def _exchanges(self, resolver: Resolver) -> Iterator[Effect]:
        wanted = [exchange for exchange in exchanges(self._model) if exchange.role not in self._kept]
        found: dict[str, list[FloatArray]] = {exchange.role: [np.zeros(len(self.names))] for exchange in wanted}
        for role, law, other in self._others(wanted, resolver):
            self._check_lost()
            try:
                # Laws that carry normal force need the whole search; those of oil and friction do not.
                found[role].append(self._logarithms(with_laws(self._model, role, other), near=True, other=True))
            except (CaseError, SolverError) as error:
                self.left_out.append(f"{role} {law} is left out: {_first(error)}")
        for exchange in wanted:
            yield Effect(f"{LAW_OF}{exchange.role}", exchange.source, np.array(found[exchange.role]), is_range=False)

    def _others(self, wanted: Sequence[Exchange], resolver: Resolver) -> Iterator[tuple[str, str, BearingModel]]:
        """Yield role, name and model of each other law.

        Each model replaces the law of one role by another one.
        """
        for number in range(max((len(exchange.laws) for exchange in wanted), default=0)):
            pairs = [(exchange.role, exchange.laws[number]) for exchange in wanted if number < len(exchange.laws)]
            try:
                together = self._with_laws(pairs, resolver)
            except CaseError:
                together = None
            for role, law in pairs:
                try:
                    yield role, law, together or self._with_laws([(role, law)], resolver)
                except CaseError as error:
                    self.left_out.append(f"{role} {law} is left out: {_first(error)}")

    def _with_laws(self, pairs: Sequence[tuple[str, str]], resolver: Resolver) -> BearingModel:
        """Return the model with other laws.

        The parameters of its own laws do not stay.
        """
        case = self._model.case
        return resolver(case.with_(models=dict(pairs), parameters={role: None for role, _ in pairs}))

    def _fitted(self, fit: FitOrigin, resolver: Resolver) -> Iterator[Effect]:
        """Yield the effects of fitted and held values.

        They follow from the errors of fitted values and from the ranges of values that were held.

        Over the range of a held value the fitted ones follow their regression on it: the data hold for each of its
        values.
        """
        rows = fit.parameters
        graded = self._fitted_parameters(rows)
        deviation = np.array([row.standard_error for row in rows])
        matrix = np.array(fit.correlation) * np.outer(deviation, deviation)
        values = np.array([row.value for row in rows])
        held = np.array([bool(row.range) for row in rows])

        def logarithms(moved: FloatArray) -> FloatArray:
            model = self._model
            options = [
                change
                for entry, number in zip(graded, moved.tolist(), strict=True)
                if not entry.law
                for change in entry.changes(number)
            ]
            if options:
                model = resolved_anew(model, options, resolver)
            for entry, number in zip(graded, moved.tolist(), strict=True):
                if entry.law:
                    model = with_value(model, entry, number, resolver)
            return self._logarithms(model, near=not options)

        self.left_out += [
            f"{entry.short} is {_text(entry.value, row.unit)} in the case and {_text(row.value, row.unit)} in the fit: "
            "the band takes the error of the fit"
            for entry, row in zip(graded, rows, strict=True)
            if not math.isclose(entry.value, row.value, rel_tol=_SAME)
        ]
        follow = np.zeros((len(rows), len(rows)))
        if held.any():
            follow[:, held] = matrix[:, held] @ np.linalg.inv(matrix[np.ix_(held, held)])
        for index in np.flatnonzero(held):
            ends = [logarithms(values + follow[:, index] * (end - values[index])) for end in rows[index].range]
            yield Effect(f"{graded[index].short} (not fitted)", graded[index].source, np.array(ends), is_range=True)
        if held.all():
            return
        rest = matrix - follow @ matrix
        sizes, vectors = np.linalg.eigh(rest[np.ix_(~held, ~held)])
        parts = []
        for size, vector in zip(sizes, vectors.T, strict=True):
            step = np.zeros(len(rows))
            step[~held] = math.sqrt(max(float(size), 0.0)) * vector
            parts.append(_change(logarithms, values, step))
        # As two alternatives with the variance of all components together.
        total = np.sqrt(np.sum(np.square(parts), axis=0))
        yield Effect("fitted values", f"fitted to {fit.file}", np.array([total, -total]), is_range=False)

    def _fitted_parameters(self, rows: Sequence[FittedValue]) -> list[Graded]:
        """Return the parameters of a fit.

        An unknown one raises a CaseError with the nearest valid path.
        """
        found, problems = [], []
        for number, row in enumerate(rows):
            try:
                found.append(named(self._model, row.path, row.unit))
            except UsageError as error:
                problems.append(Problem(f"fit.parameters.{number}.path", str(error).removeprefix("--vary: ")))
        if problems:
            raise CaseError(self._model.name, problems)
        return found

    def _check_lost(self) -> None:
        """End the search where many changes have no equilibrium."""
        if self._lost > _MOST_LOST:
            raise SolverError(
                f"{self._lost} of the first changes within the ranges have no equilibrium with friction: "
                "a small change of temperature, parameters or laws may end the steady motion"
            )

    def _has(self, name: str) -> bool:
        """Tell whether a result exists.

        At rest there is no torque, and without load no film.
        """
        try:
            value = READ[name](self._base)
        except (LambdaError, ValueError, ArithmeticError):
            return False
        return math.isfinite(value) and value != 0.0

    def _read(self, found: Equilibrium) -> FloatArray:
        return np.array([READ[name](found) for name in self.names])

    def _logarithms(self, model: BearingModel, *, near: bool, other: bool = False) -> FloatArray:
        """Return ln of relative results at one position.

        They are results of a model over those of the case, for one position of the balls.

        With `near` only laws differ; with `other` they are other laws, which have kernels of their own.
        """
        kernels = Kernels(model, near=self._kernels) if other else self._kernels
        try:
            found = solve_near(model, self._base, kernels, is_of_laws=near, by_warmer_oil=False)
        except SolverError:
            self._lost += 1
            raise
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.log(self._read(found) / self._values)
        return np.where(np.isfinite(ratio), ratio, 0.0)


def _change(logarithms: Callable[[FloatArray], FloatArray], values: FloatArray, step: FloatArray) -> FloatArray:
    """Return what a step of parameters changes.

    It is half of the difference of both directions; from a value near the end of what its law allows, that of one.
    """
    sides: list[FloatArray] = []
    for sign in (1.0, -1.0):
        try:
            sides.append(sign * logarithms(values + sign * step))
        except (CaseError, SolverError, ValidationError) as error:
            if sign < 0.0 and not sides:
                why = error.errors()[0]["msg"] if isinstance(error, ValidationError) else _first(error)
                raise SolverError(f"fitted values, changed by their errors, have no results: {why}") from None
    found: FloatArray = np.mean(sides, axis=0)
    return found


def range_effect(graded: Graded, ends: Callable[[], Sequence[FloatArray]], left_out: list[str]) -> Iterator[Effect]:
    """Yield the effect of the range of a parameter.

    An end without a solution is left out and named.

    Parameters
    ----------
    ends : callable
        Returns the logarithms of the results at both ends.
    """
    try:
        alternatives = np.array(ends())
    except (CaseError, SolverError) as error:
        left_out.append(f"{graded.short} is left out: {_first(error)}")
        return
    yield Effect(graded.short, graded.source, alternatives, is_range=True)


def _text(value: float, unit: str) -> str:
    return f"{value:.4g} {unit}".rstrip()


def _first(error: Exception) -> str:
    return " ".join(str(error).split())[:160]
