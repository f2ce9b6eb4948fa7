"""Bring one bearing into equilibrium for comparison methods."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from lambda_core.analysis.rotor.bearing_alone import bearing_number
from lambda_core.analysis.static_point import static_point
from lambda_core.analysis.thermal.temperatures import ready, ready_rollers
from lambda_core.domain.errors import CaseError, SolverError
from lambda_core.views.method import MethodInputs, RollerMethodInputs

if TYPE_CHECKING:
    from lambda_core.analysis.static_point import BearingPoint
    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.model.roller_case import RollerModel
    from lambda_core.results.roller_quasistatic import SolvedRollers


@dataclass(frozen=True)
class ComparedBearing:
    """One bearing at the start of its case.

    It is alone, or in a machine under the load that it carries there.

    Attributes
    ----------
    bearing : str
        Its name in a machine; empty where it is alone.
    case, title, headline, assumptions
        As in a :class:`~lambda_core.runs.comparison.Comparison`.
    inputs : MethodInputs or RollerMethodInputs
        What methods are asked about.
    contamination : float
        e_C of ISO 281 for modified lives.
    contamination_given : bool
        Whether case or caller gives it.
    """

    bearing: str
    case: str
    title: str
    headline: str
    assumptions: tuple[str, ...]
    inputs: MethodInputs | RollerMethodInputs
    contamination: float
    contamination_given: bool

    @property
    def has_rollers(self) -> bool:
        """Choice of methods: those for rollers, or for balls."""
        return isinstance(self.inputs, RollerMethodInputs)


def compared_bearing(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str],
    bearing: str | None,
    contamination: float | None,
    announce: Callable[[str], None] | None,
) -> ComparedBearing:
    """Return the bearing that a comparison is about.

    The arguments and errors are those of :func:`~lambda_core.runs.compare.compare`.
    """
    from lambda_core.results.roller_quasistatic import solve_rollers

    try:
        model = ready(source, overrides, announce, is_static=True)
    except CaseError as refused:  # as for an operating point
        if bearing is not None or (found := ready_rollers(source, overrides, announce, refused=refused)) is None:
            raise
        return _of_rollers("", found[0], solve_rollers(found[0]), contamination)
    number = bearing_number(model, bearing)
    point = list(static_point(model, announce).bearings.values())[number]
    case = f"{model.name}, {point.name}" if point.name else model.name
    try:
        if point.rollers is None:
            return _of_balls(point, case, contamination)
        return _of_rollers(point.name, replace(point.rollers, name=case), point.solved_rollers, contamination)
    except SolverError as error:  # without loads per ball the comparison would be of different cases
        raise SolverError(f"{model.name}: nothing to compare: {error}") from error


def _of_balls(point: BearingPoint, case: str, contamination: float | None) -> ComparedBearing:
    """Return a bearing with balls."""
    from lambda_core.analysis.rating.compare_methods import comparison_inputs
    from lambda_core.model.checks.describe import headline

    model = point.alone
    clean, is_given = _clean(contamination, model.contamination, model.geometry.pitch_diameter)
    return ComparedBearing(
        bearing=point.name,
        case=case,
        title=model.title,
        headline="\n".join(headline(model)),
        assumptions=model.assumptions,
        inputs=comparison_inputs(point.equilibrium, contamination=clean, loads=point.loads),
        contamination=clean,
        contamination_given=is_given,
    )


def _of_rollers(name: str, model: RollerModel, solved: SolvedRollers, contamination: float | None) -> ComparedBearing:
    """Return a bearing with rollers."""
    from lambda_core.results.roller_catalogues import roller_inputs
    from lambda_core.results.roller_quasistatic import headline_of

    clean, is_given = _clean(contamination, model.contamination, model.bearing.pitch_diameter)
    return ComparedBearing(
        bearing=name,
        case=model.name,
        title=model.title,
        headline=headline_of(model, solved.state),
        assumptions=model.assumptions,
        inputs=roller_inputs(model, solved.state, solved.friction, clean),
        contamination=clean,
        contamination_given=is_given,
    )


def _clean(asked: float | None, given: float | None, pitch_diameter: float) -> tuple[float, bool]:
    """Return the decisive e_C and its origin.

    Caller or case gives it: otherwise it is that of normal cleanliness.
    """
    from lambda_core.model.settings.contamination import known_contamination

    known = given if asked is None else asked
    return known_contamination(known, pitch_diameter), known is not None
