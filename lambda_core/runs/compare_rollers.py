"""Compare one roller bearing by every method."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from lambda_core.results.roller_quasistatic import SolvedRollers, headline_of
from lambda_core.runs.comparison import ComparedMethod, Comparison, compared
from lambda_core.views.method import Method, RollerMethodInputs, evaluate_methods

if TYPE_CHECKING:
    from lambda_core.model.roller_case import RollerModel


def compare_rollers(
    model: RollerModel,
    solved: SolvedRollers,
    methods: Iterable[Method],
    clean: tuple[float, bool],
    simulated: Iterable[ComparedMethod] = (),
) -> Comparison:
    """Ask every method about a solved roller bearing.

    Parameters
    ----------
    clean : (float, bool)
        e_C of ISO 281 for modified lives, and whether case or caller gives it.
    simulated : iterable of ComparedMethod
        Columns of simulations of the same case, before those of the methods.
    """
    radial, axial = solved.state.carried
    inputs = RollerMethodInputs(
        title=model.title,
        bearing=model.bearing,
        oil=model.oil,
        base_type=model.base_type,
        radial_load=radial,
        axial_load=axial,
        inner_speed=model.speeds[0],
        outer_speed=model.speeds[1],
        lubrication=model.lubrication,
        oil_height=model.friction.oil_height,
        state=solved.state,
        friction=solved.friction,
        contamination=clean[0],
    )
    return Comparison(
        case=model.name,
        title=model.title,
        headline=headline_of(model, radial, axial),
        methods=[*simulated, *map(compared, evaluate_methods(methods, inputs))],
        assumptions=list(model.assumptions),
        contamination=clean[0],
        contamination_given=clean[1],
    )
