"""Test that rollers have one equilibrium.

The convex one of lambda_core.elements.roller is what an operating point and a shaft ask and what a run starts from;
compiled code has the same contacts. It follows the rings' places exactly, the convex one to first order: 37 um over a
radius of 25 mm are 1e-3 of an approach.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.elements.roller.roller_friction import friction
from lambda_core.formulas.loading import CARRYING
from lambda_core.model.roller_case import rollers_at_rest
from lambda_core.results.quasistatic import QuasiStatic, quasistatic_of
from lambda_core.results.roller_quasistatic import solve_rollers
from lambda_core.solver.core import core
from lambda_core.solver.drivers.compiled_laws import Kernels, derive_oils
from lambda_core.solver.drivers.equilibrium import contact_channels, solve, without_friction
from lambda_core.solver.drivers.first_state import first_frame, first_state
from lambda_core.solver.drivers.solver_context import assemble
from lambda_core.solver.records import CONTACT_CHANNELS

from .support import FloatArray

# Designation, radial and axial load [N], speed [1/min], oil [degC]; how far the loads of frictionless contacts agree.
POINTS = {
    "NU 208 ECP": (6e3, 0.0, 3000, 60, 1e-3),
    "32216": (6.5e3, 6e3, 2000, 50, 4e-4),
    "NJ 208 ECP": (5e3, 1e3, 3000, 70, 4e-3),  # rollers tilted by 1 mrad
    "NCF 3008 CV": (5e3, 0.0, 1000, 70, 1e-3),
    "NA 4905": (2e3, 0.0, 1000, 70, 1e-3),
}


def case(name: str) -> dict[str, Any]:
    radial, axial, speed, celsius, _ = POINTS[name]
    return {
        "name": name.replace(" ", "-"),
        "bearing": {"designation": f"SKF {name}"},
        "lubricant": {"name": "FVA3", "temperature": f"{celsius} degC"},
        "loads": {"radial": f"{radial} N", "axial": f"{axial} N"},
        "operation": {"speed": f"{speed} rpm"},
    }


def frictionless(name: str) -> FloatArray:
    """Return the loads of compiled contacts without friction, (Z, contacts)."""
    model = api.check(case(name))
    kernels, frame = Kernels(model), first_frame(model)
    context = assemble(model, kernels, frame, derive_oils(model, kernels, frame))
    state = first_state(context)
    without_friction(core(), context, state)
    contacts, _ = contact_channels(core(), context, state)
    return np.asarray(contacts[..., CONTACT_CHANNELS.index("load")])


@pytest.mark.parametrize("name", POINTS)
def test_compiled_contacts_carry_the_same_loads(name: str) -> None:
    """Compare loads of all contacts without friction.

    They differed by 0.4 % in the steel, and by the ring's weight and the number of slices.
    """
    loads, state = frictionless(name), solve_rollers(rollers_at_rest(api.check(case(name))), (0.0,)).state
    largest, close = state.outer.sum(axis=1).max(), POINTS[name][-1]
    for column, ring in enumerate((state.inner, state.outer)):
        assert loads[:, column] == pytest.approx(ring.sum(axis=1), abs=close * largest)
    assert loads[:, 2:].max(initial=0.0) == pytest.approx(state.ribs.max(initial=0.0), rel=0.02)


@pytest.mark.parametrize("name", POINTS)
def test_a_run_starts_from_the_numbers_of_the_operating_point(name: str) -> None:
    """Compare both answers with friction.

    Pressure differed by 1.4 %, the film by 4 %, the torque of tapered bearings by 5 %. What friction moves is left, and
    that the torque of the operating point is the mean over one pitch.
    """
    model = api.check(case(name))
    found, answer = solve(model), api.quasistatic(case(name))
    start = quasistatic_of(found)
    assert isinstance(answer, QuasiStatic)
    assert answer.rollers is not None
    assert start.max_load_N == pytest.approx(answer.max_load_N, rel=3e-3)
    assert start.max_pressure_GPa == pytest.approx(answer.max_pressure_GPa, rel=4e-3)
    assert start.film_um[0] == pytest.approx(answer.film_um[0], rel=1e-3)
    load, film = (found.contacts[..., CONTACT_CHANNELS.index(channel)] for channel in ("load", "film_minimum"))
    thinnest = 1e6 * film[load > CARRYING * load.max()].min()
    assert thinnest == pytest.approx(answer.rollers.min_film_um, rel=2e-3)  # it was the smallest central film
    assert thinnest < 0.8 * answer.film_um[0]
    assert start.friction_torque_Nmm == pytest.approx(answer.friction_torque_Nmm, rel=0.02)


def test_rollers_of_ceramic_press_alike_in_both_answers() -> None:
    """Count the materials of a case at its operating point.

    Rollers at rest were of steel whatever the case said: 1.64 GPa.
    """
    ceramic = case("NU 208 ECP") | {"materials": {"balls": "Si3N4"}}
    answer, start = api.quasistatic(ceramic), quasistatic_of(solve(api.check(ceramic)))
    assert start.max_pressure_GPa == pytest.approx(answer.max_pressure_GPa, rel=1e-3)
    assert answer.max_pressure_GPa > 1.05 * api.quasistatic(case("NU 208 ECP")).max_pressure_GPa


def test_losses_of_slices_add_up_in_motion() -> None:
    """Compare hysteresis and rolling of rollers that all carry alike.

    Those of the widest slice made 8 % more hysteresis, a mean length 4 % less rolling resistance.
    """
    axial = case("32216") | {"loads": {"axial": "6 kN"}}
    model = api.check(axial)
    rollers, found = rollers_at_rest(model), solve(model)
    solved = solve_rollers(rollers)
    parts = friction(rollers.bearing, solved.state, solved.motion, rollers.oil, rollers.friction)
    torque = quasistatic_of(found).friction_breakdown_Nmm
    for ring in ("inner", "outer"):
        assert torque[f"rolling_{ring}"] == pytest.approx(1e3 * parts.rolling[ring], rel=4e-3)
        assert torque[f"hysteresis_{ring}"] == pytest.approx(1e3 * parts.hysteresis[ring], rel=4e-3)
