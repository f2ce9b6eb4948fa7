"""Compute how far uncertain parameters and laws move results."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.band.changed import as_loaded, is_of_laws, resolved_anew, with_laws, with_value
from lambda_core.analysis.band.graded import Exchange, Graded, Resolver, exchanges, graded_parameters, varied
from lambda_core.analysis.band.readings import POSITIONS, READ, UNITS_OF, read_values
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import CaseError, LambdaError, Problem, SolverError, UsageError, unknown_name
from lambda_core.model.bearing_model import BearingModel
from lambda_core.results.model_band import COVERAGE, QUANTITIES, Band, Contributor, MachineBand, ModelBand
from lambda_core.solver.drivers.compiled_laws import Kernels
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.drivers.near_equilibrium import solve_near
from lambda_core.solver.drivers.roller_reaction import RollerReaction

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.case_io import Source
    from lambda_core.case.fitted import FitOrigin, FittedValue
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.solver.drivers.shaft_equilibrium import ShaftState

_NORMAL = 1.6448536269514722  # standard deviations of a normal distribution within which 90 % lie
_LEAST_SHARE = 0.02  # of the variance of a contributor that is named
Reader = Callable[[Equilibrium], float]


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


@one_blas_thread()
def model_band(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    *,
    quantities: Sequence[str] = QUANTITIES,
    bearing: str | None = None,
    announce: Callable[[str], None] | None = None,
) -> ModelBand | MachineBand:
    """Return the 90 % band of quasi-static results.

    Each parameter is taken as uniformly distributed over its range, each law of a role as equally likely, all
    independent of each other; their effects on the logarithm of a result are added (first order). The values of a
    fitted case have the errors and correlations of the fit in place of their ranges, and their laws are kept.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    quantities : sequence of str
        Results: "friction torque", "power loss", "minimum film", "maximum pressure", "capacitance", "rating life".
    bearing : str, optional
        One of a machine's; by default all of them, each under its loads in the machine.
    announce : callable, optional
        Called with a sentence before something takes longer.

    Returns
    -------
    ModelBand or MachineBand
        Of one bearing, or of all of a machine. ``text()`` has a line per result.

    Raises
    ------
    CaseError, SolverError
        With a sentence about the case.
    UsageError
        For a quantity that has no band.

    References
    ----------
    First-order propagation with uniform distributions: JCGM 100:2008, sections 4.3.7 and 5.1.2.
    """
    from lambda_core.case.case_io import is_machine

    for name in quantities:
        if name not in READ:
            raise UsageError(unknown_name("quantity of the model band", name, READ))
    if announce is not None:
        announce("computing the model band from the ranges of parameters and laws")
    if is_machine(source):
        from lambda_core.analysis.thermal.machine_temperatures import ready_machine_of

        machine = ready_machine_of(source, overrides, announce)  # type: ignore[arg-type]
        return _of_machine(machine, quantities, bearing, announce)
    from lambda_core.analysis.thermal.temperatures import ready_model

    return band_alone(ready_model(source, overrides, announce, is_static=True), quantities)  # type: ignore[arg-type]


def _of_machine(
    machine: MachineModel, quantities: Sequence[str], bearing: str | None, announce: Callable[[str], None] | None
) -> ModelBand | MachineBand:
    from lambda_core.analysis.rotor.bearing_alone import bearing_number
    from lambda_core.solver.drivers.shaft_equilibrium import solve_shaft

    number = None if bearing is None else bearing_number(machine, bearing)
    bands = bands_of_machine(machine, solve_shaft(machine, announce), quantities, number)
    return bands if bearing is None else bands.bearings[bearing]


def bands_of_machine(
    machine: MachineModel, state: ShaftState, quantities: Sequence[str] = QUANTITIES, number: int | None = None
) -> MachineBand:
    """Return the bands of a solved machine's bearings.

    Or the band of one of them.

    The loads that shaft and gears put on a bearing count as known.
    """
    from lambda_core.analysis.rotor.bearing_alone import alone_under_load

    def band(i: int) -> ModelBand:
        ring = state.rings[i]
        if isinstance(ring, RollerReaction):
            from lambda_core.analysis.band.roller_band import roller_band
            from lambda_core.analysis.rotor.rollers_on_shaft import taken_out

            return roller_band(machine.bearings[i].model, taken_out(ring), quantities)
        return band_of(alone_under_load(machine, state, i), quantities)

    chosen = range(len(machine.bearings)) if number is None else (number,)
    return MachineBand(case=machine.name, bearings={machine.bearings[i].name: band(i) for i in chosen})


def band_alone(model: BearingModel, quantities: Sequence[str] = QUANTITIES) -> ModelBand:
    """Return the band of a bearing that is alone.

    For rollers it is the band of their quasi-static answer.
    """
    if model.rollers is None:
        return band_of(model, quantities)
    from lambda_core.analysis.band.roller_band import roller_band
    from lambda_core.case.case_io import parse_case
    from lambda_core.model.roller_case import roller_model

    rollers = roller_model(parse_case(model.case_toml, model.name))
    assert rollers is not None  # the model has them from this case
    return roller_band(model, rollers, quantities)


def band_of(
    model: BearingModel,
    quantities: Sequence[str] = QUANTITIES,
    *,
    readers: Mapping[str, Reader] = READ,
    units: Mapping[str, str] = UNITS_OF,
) -> ModelBand:
    """Return the band of a resolved model.

    Its temperatures are known; it is alone or under its loads in a machine.

    Parameters
    ----------
    readers, units : mapping
        How each quantity is read from an equilibrium, and its unit.
    """
    found = Effects(model, quantities, readers)
    effects, value = list(found.all()), found.values_at_all_positions()
    return ModelBand(
        case=model.name,
        coverage=COVERAGE,
        bands=[band_around(name, units[name], i, float(value[i]), effects) for i, name in enumerate(found.names)],
        left_out=found.left_out,
    )


class Effects:
    """Effects of ranges and exchanges on a model's results.

    Each range of a parameter and each exchange of a law has its effect.

    Parameters
    ----------
    model : BearingModel
        Resolved, at known temperatures.
    quantities : sequence of str
        Keys of `readers`; results that the model does not have are left out.
    without : collection of str
        Paths of parameters that are not varied. Laws are exchanged none the less, but those of a fitted case.

    Attributes
    ----------
    names : tuple of str
        Results that there are.
    left_out : list of str
        What could not be varied, and why; after the effects were asked for.
    """

    def __init__(
        self,
        model: BearingModel,
        quantities: Sequence[str],
        readers: Mapping[str, Reader] = READ,
        without: Iterable[str] = (),
    ) -> None:
        from lambda_core.case.case_io import parse_case

        self._model, self._readers = model, readers
        self._kernels = Kernels(model)
        self._base = solve(model, self._kernels, phase=POSITIONS[0])
        self.names = tuple(name for name in quantities if self._has(name))
        self._values = self._read(self._base)
        self._fit = parse_case(model.case_toml, model.name).fit
        fitted = [row.path for row in self._fit.parameters] if self._fit is not None else []
        self._without = {*without, *fitted}
        self._kept = {path.split(".")[1] for path in fitted if path.startswith("parameters.")}  # laws of fitted values
        self.left_out: list[str] = []

    def values_at_all_positions(self) -> FloatArray:
        """Return the results, averaged over the ball positions."""

        def solved(phase: float) -> Equilibrium:
            return self._base if phase == self._base.phase else solve(self._model, self._kernels, phase=phase)

        found: FloatArray = read_values(solved, [self._readers[name] for name in self.names]).mean(axis=0)
        return found

    def all(self) -> Iterator[Effect]:
        """Yield the effects of all parameters and laws.

        Changes without a solution are left out and named.
        """
        from lambda_core.discovery.manager import registry
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
            try:
                moved = graded.models or [
                    with_value(self._model, graded, end, resolver) for end in (graded.low, graded.high)
                ]
                ends = [self._logarithms(as_loaded(one, self._model), near=is_of_laws(graded)) for one in moved]
            except (CaseError, SolverError) as error:
                self.left_out.append(f"{graded.short} is left out: {_first(error)}")
                continue
            yield Effect(graded.short, graded.source, np.array(ends), is_range=True)

    def _exchanges(self, resolver: Resolver) -> Iterator[Effect]:
        wanted = [exchange for exchange in exchanges(self._model) if exchange.role not in self._kept]
        found: dict[str, list[FloatArray]] = {exchange.role: [np.zeros(len(self.names))] for exchange in wanted}
        for role, law, other in self._others(wanted, resolver):
            try:
                # Laws that carry normal force need the whole search; those of oil and friction do not.
                found[role].append(self._logarithms(with_laws(self._model, role, other), near=True, other=True))
            except (CaseError, SolverError) as error:
                self.left_out.append(f"{role} {law} is left out: {_first(error)}")
        for exchange in wanted:
            yield Effect(f"law of {exchange.role}", exchange.source, np.array(found[exchange.role]), is_range=False)

    def _others(self, wanted: Sequence[Exchange], resolver: Resolver) -> Iterator[tuple[str, str, BearingModel]]:
        """Yield role, name and model of each other law.

        One model has one other law of every role.
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
        from lambda_core.case.case_io import parse_case

        case = parse_case(self._model.case_toml, self._model.name)
        return resolver(case.with_(models=dict(pairs), parameters={role: None for role, _ in pairs}))

    def _fitted(self, fit: FitOrigin, resolver: Resolver) -> Iterator[Effect]:
        """Yield the effects of fitted and held values.

        Of the errors of the fitted values, and of the ranges of values that were held.

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
            parts.append(0.5 * (logarithms(values + step) - logarithms(values - step)))
        # As two alternatives with the variance of all components together.
        total = np.sqrt(np.sum(np.square(parts), axis=0))
        yield Effect("fitted values", f"fitted to {fit.file}", np.array([total, -total]), is_range=False)

    def _fitted_parameters(self, rows: Sequence[FittedValue]) -> list[Graded]:
        """Return the parameters of a fit.

        CaseError with the nearest valid path for an unknown one.
        """
        found, problems = [], []
        for number, row in enumerate(rows):
            try:
                found.append(varied(self._model, f"{row.path}={_ends(row)}"))
            except UsageError as error:
                problems.append(Problem(f"fit.parameters.{number}.path", str(error).removeprefix("--vary: ")))
        if problems:
            raise CaseError(self._model.name, problems)
        return found

    def _has(self, name: str) -> bool:
        """Tell whether a result exists.

        At rest there is no torque, and without load no film.
        """
        try:
            value = self._readers[name](self._base)
        except (LambdaError, ValueError, ArithmeticError):
            return False
        return math.isfinite(value) and value != 0.0

    def _read(self, found: Equilibrium) -> FloatArray:
        return np.array([self._readers[name](found) for name in self.names])

    def _logarithms(self, model: BearingModel, *, near: bool, other: bool = False) -> FloatArray:
        """Return ln of relative results at one position.

        Results of a model over those of the case, for one position of the balls.

        With `near` only laws differ; with `other` they are other laws, which have kernels of their own.
        """
        kernels = Kernels(model) if other else self._kernels
        found = solve_near(model, self._base, kernels, is_of_laws=near)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.log(self._read(found) / self._values)
        return np.where(np.isfinite(ratio), ratio, 0.0)


def _ends(row: FittedValue) -> str:
    ends = (row.value - row.standard_error, row.value + row.standard_error)
    return "..".join(f"{end!r} {row.unit}".rstrip() for end in ends)


def band_around(name: str, unit: str, index: int, value: float, effects: Sequence[Effect]) -> Band:
    """Return the band of a printed value.

    The band includes the value, because the value is no correction.

    Alternatives that lie mostly on one side shift the band, and the case keeps its value. The band of a value that is
    not corrected for a known shift ends at the value where it would otherwise leave it out; it then holds at least the
    coverage (Phillips, Eberhardt and Parry 1997, J. Res. NIST 102, 577).
    """
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
        unit=unit,
        value=value,
        low=value * math.exp(min(shift - half, 0.0)),
        high=value * math.exp(max(shift + half, 0.0)),
        contributors=contributors,
    )


def _first(error: Exception) -> str:
    return " ".join(str(error).split())[:160]
