"""Test rollers on a shaft.

Against statics, a bearing that is alone, and the compiled contacts.
"""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.rotor.bearing_alone import at_speed, bearing_alone
from lambda_core.domain.errors import CaseError, SolverError
from lambda_core.elements.roller.roller_equilibrium import balance
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.bearing_reaction import BearingReaction
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.solver.drivers.machine_statics import MachineState, SharedKernels, solve_machine
from lambda_core.solver.drivers.roller_reaction import RollerReaction
from lambda_core.solver.records import CONTACT_CHANNELS

PINNED = {"tilt_y": "free", "tilt_z": "free"}  # outer rings that follow, so that no bearing bears a moment
SHARED: dict[str, Any] = {
    "name": "shaft",
    "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    "operation": {"speed": "1500 rpm"},
    "gravity": {"z": "0 m/s2"},
}
MOTOR = Path(__file__).parents[2] / "examples" / "roller-shafts" / "motor.toml"
THICK = {"sections": [{"length": "60 mm", "diameter": "400 mm"}]}  # hardly bends, hardly presses together

KERNELS = SharedKernels()


def solved(case: dict[str, Any]) -> tuple[MachineModel, MachineState]:
    model = resolve_machine({**SHARED, **case})
    return model, solve_machine(model, kernels=KERNELS)


def motor(**more: Any) -> dict[str, Any]:
    """Return the case of a motor shaft.

    NU 208 floats, 6308 locates.
    """
    return {
        "shaft": {"sections": [{"length": "380 mm", "diameter": "40 mm"}]},
        "bearings": {
            "floating": {"designation": "SKF NU 208 ECP", "at": "20 mm", **more},
            "located": {"designation": "SKF 6308", "at": "360 mm", **more},
        },
        "loads": {"rotor": {"at": "150 mm", "force_y": "800 N", "force_z": "-3 kN", "force_x": "250 N"}},
    }


def pair(preload: str, force: str = "0 N", at: str = "30 mm", across: str = "0 N") -> dict[str, Any]:
    """Return two 32208 in X arrangement.

    On a short thick shaft, both as near to its middle as they can.
    """
    return {
        "shaft": THICK,
        "bearings": {
            "left": {"designation": "32208", "at": "29 mm", "takes": "-x", "preload": preload},
            "right": {"designation": "32208", "at": "31 mm", "takes": "+x", "preload": preload},
        },
        "loads": {"push": {"at": at, "force_x": force, "force_y": across}},
    }


@cache
def compiled(takes: str) -> BearingReaction:
    """Return a 32208 in compiled code."""
    model = of("32208", takes).model
    return BearingReaction(model, 0.0, 1000.0, KERNELS.of(model))


@cache
def of(designation: str, takes: str | None = None) -> RollerReaction:
    own: dict[str, Any] = {"designation": designation, "at": "30 mm"} | ({"takes": takes} if takes else {})
    model = resolve_machine({**SHARED, "shaft": THICK, "bearings": {"one": own}}).bearings[0].model
    assert model.rollers is not None
    return RollerReaction(model, model.rollers, KERNELS.of(model))


def test_levers_share_the_load() -> None:
    """Compare loads with F b/l and F a/l.

    Outer rings follow the shaft's tilt; the ball bearing has all thrust.
    """
    _, state = solved(motor(support=PINNED))
    for axis, force in ((1, 800.0), (2, -3000.0)):
        wanted = [-force * 210.0 / 340.0, -force * 130.0 / 340.0]
        assert state.reactions[:, axis] == pytest.approx(wanted, abs=1e-6 * 3000.0)
    assert state.reactions[:, 0] == pytest.approx([0.0, -250.0], abs=1e-6 * 3000.0)
    assert np.abs(state.reactions[:, 3:]).max() < 1e-6 * 3000.0 * 0.34


def test_forces_and_moments_on_a_tilted_shaft_add_up() -> None:
    """Sum forces and moments about the left end.

    With the moments of tilted rings on the shaft; 1e-6 of the load.
    """
    model, state = solved(motor())
    place = np.array([bearing.position for bearing in model.bearings])
    assert state.reactions[:, :3].sum(axis=0) == pytest.approx([-250.0, -800.0, 3000.0], abs=3e-3)
    about_y = -place @ state.reactions[:, 2] + 0.15 * 3000.0 + state.reactions[:, 3].sum()
    about_z = place @ state.reactions[:, 1] + 0.15 * 800.0 + state.reactions[:, 4].sum()
    assert [about_y, about_z] == pytest.approx([0.0, 0.0], abs=1e-3)
    assert abs(float(state.reactions[0, 3])) > 0.05  # rollers that are tilted push back
    assert float(state.stiffness[0][0, 0]) == 0.0


@pytest.mark.parametrize(("elastic", "life"), [
    ({}, {"contamination": 0.4}), ({"outer_ring": {"housing_stiffness": "100 N/um"}}, {}),
], ids=["rigid", "elastic, e_C not given"])  # fmt: skip
def test_one_bearing_on_a_short_shaft_is_the_bearing_alone(elastic: dict[str, Any], life: dict[str, float]) -> None:
    """Compare one bearing with itself to 0.1 %.

    Loads, pressure, lives, film and friction, under a load in any direction.
    """
    case = {
        **SHARED,
        "shaft": {**THICK, "support": {"at": "30 mm", "x": "locked"}},
        "bearings": {"one": {"designation": "SKF NU 208 ECP", "at": "30 mm", "elastic": elastic}},
        "loads": {"oblique": {"at": "30 mm", "force_y": "3 kN", "force_z": "-4 kN"}},
        "life": life,
    }
    found = api.quasistatic(case).bearing("one")
    alone = api.quasistatic(
        {
            "name": "alone",
            "bearing": {"designation": "SKF NU 208 ECP"},
            "lubricant": SHARED["lubricant"],
            "operation": SHARED["operation"],
            "gravity": SHARED["gravity"],
            "loads": {"radial": "5 kN", "radial_direction": "0 deg"},
            "elastic": elastic,
            "life": life,
        }
    )
    assert found.loaded_elements == alone.loaded_elements
    pairs = [
        (found.max_load_N, alone.max_load_N),
        (found.max_pressure_GPa, alone.max_pressure_GPa),
        (found.rating.basic_life_h, alone.rating.basic_life_h),
        (found.rating.reference_life_h, alone.rating.reference_life_h),
        (found.rating.modified_life_h, alone.rating.modified_life_h),
        (found.rating.modified_reference_life_h, alone.rating.modified_reference_life_h),
        (found.rating.static_safety, alone.rating.static_safety),
        (found.rating.viscosity_ratio, alone.rating.viscosity_ratio),
        (found.film_um[0], alone.film_um[0]),
        (found.friction_torque_Nmm, alone.friction_torque_Nmm),
    ]
    for here, there in pairs:
        assert here == pytest.approx(there, rel=1e-3)
    # the shaft was solved with a roller below, between the places of the answer
    assert math.hypot(*found.displacement_um[1:3]) == pytest.approx(alone.inner_ring_displacement_um[1], rel=1e-2)


def test_unloaded_rollers_of_a_tilted_ring_stay_in_their_pockets() -> None:
    """Keep unloaded rollers in their pockets.

    Friction moved and skewed them between their ribs, so that no equilibrium was found at low speed.
    """
    model = api.check(MOTOR, ("loads.belt.force_z=-12 kN",))
    assert isinstance(model, MachineModel)
    found = solve(at_speed(bearing_alone(model, "belt"), 300.0 * math.pi / 30.0))  # raises where there is none
    free = found.contacts[:, :, CONTACT_CHANNELS.index("load")].max(axis=1) < 1.0
    assert 0 < free.sum() < free.size
    rollers = L.elements_in(found.context.bundle, found.state)
    assert np.all(rollers["velocity"][free, 0] == 0.0)


@pytest.mark.parametrize(
    ("designation", "takes", "pose"),
    [
        ("SKF NU 208 ECP", None, (0.0, 10e-6, -40e-6, 3e-4, 0.0)),
        ("32208", "+x", (12e-6, 2e-6, -3e-6, 1e-4, -5e-5)),
        ("32208", "-x", (-12e-6, 2e-6, -3e-6, 1e-4, -5e-5)),
    ],
)
def test_the_stiffness_is_the_slope_of_the_reaction(
    designation: str, takes: str | None, pose: tuple[float, ...]
) -> None:
    """Compare stiffness with central differences.

    Against the eliminated Hessian, relative to the largest entry of its kind; symmetric.
    """
    ring, steps, at = of(designation, takes), (1e-9, 1e-9, 1e-9, 1e-8, 1e-8), np.array(pose)
    slope = np.zeros((5, 5))
    for i, step in enumerate(steps):
        move = np.eye(5)[i] * step
        slope[:, i] = (ring.reaction(at - move) - ring.reaction(at + move)) / (2.0 * step)
    ring.reaction(at)
    arms = np.array([1.0, 1.0, 1.0, 0.03, 0.03])
    sizes = np.outer(arms, arms)
    found = ring.stiffness() / sizes
    assert np.abs(slope / sizes - found).max() < 1e-4 * np.abs(found).max()
    assert np.abs(found - found.T).max() < 1e-9 * np.abs(found).max()


def test_a_cone_that_faces_the_other_way_is_the_mirror_image() -> None:
    """Mirror a cone in the plane x = 0.

    x and turns about y and z change sign, of poses and of reactions.
    """
    mirror = np.array([-1.0, 1.0, 1.0, -1.0, -1.0])
    pose = np.array([12e-6, 2e-6, -3e-6, 1e-4, -5e-5])
    right, left = of("32208", "+x").reaction(pose), of("32208", "-x").reaction(mirror * pose)
    assert left == pytest.approx(mirror * right, rel=1e-9)
    assert right[0] < 0.0 < left[0]
    far = 5.0 * pose
    right, left = compiled("+x").reaction(far), compiled("-x").reaction(mirror * far)
    assert left == pytest.approx(mirror * right, rel=1e-5, abs=1e-5 * np.abs(right[:3]).max())
    right, left = compiled("+x").equilibrium(), compiled("-x").equilibrium()
    assert left.losses.sum() == pytest.approx(right.losses.sum(), rel=1e-3)
    assert left.orbit == pytest.approx(right.orbit, rel=1e-6)
    assert left.contacts[:, :, 0] == pytest.approx(right.contacts[:, :, 0], rel=1e-4, abs=1e-3)


def test_the_compiled_contacts_answer_the_same() -> None:
    """Compare compiled contacts with `iso-line`.

    Both follow ISO 16281 in proportion to E' of the case; 0.2 % for places that count to first order.
    """
    ring = of("SKF NU 208 ECP")
    kernels = BearingReaction(ring.model, 0.0, 1000.0, KERNELS.of(ring.model))
    for pose in ((0.0, 0.0, -40e-6, 0.0, 0.0), (0.0, 10e-6, -40e-6, 3e-4, 0.0)):
        assert kernels.reaction(pose)[1:3] == pytest.approx(ring.reaction(pose)[1:3], rel=2e-3, abs=1.0)


def test_a_preload_makes_the_force_that_presses_a_bearing_as_far() -> None:
    """Compare a preload with the bearing's force.

    A bearing alone, whose cone moves by the preload: 0.5 %, as the shaft gives way a little.
    """
    ring = of("32208", "+x")
    thrust = np.array([2000.0, 0.0, 0.0, 0.0, 0.0])
    alone = balance(ring.rollers, thrust, inertial=ring.motion.inertial(ring.rollers), first_angle=-0.5 * math.pi)
    _, state = solved(pair(f"{float(alone.ring[0])!r} m"))
    assert state.reactions[:, 0] == pytest.approx([2000.0, -2000.0], rel=5e-3)


def test_thrust_goes_to_the_bearing_that_takes_it() -> None:
    """Sum forces along x and relieve the other bearing.

    By less than the thrust while it is preloaded.
    """
    _, resting = solved(pair("8 um"))
    _, pushed = solved(pair("8 um", "1500 N"))
    assert float(pushed.reactions[:, 0].sum()) == pytest.approx(-1500.0, abs=1e-3)
    assert float(pushed.reactions[1, 0]) < float(resting.reactions[1, 0]) < 0.0  # right takes +x
    assert 0.0 < float(pushed.reactions[0, 0]) < float(resting.reactions[0, 0])


def test_radial_load_on_cones_in_play_makes_thrust() -> None:
    """Compare F_a with F_r/(2 Y) to 10 %.

    Two cones with play under a radial load: F_r/(2 Y) = F_r tan(alpha)/0.8.

    ISO 281: Y = 0.4 cot(alpha), half of the rollers loaded at F_a = F_r tan(alpha)/(2 x 0.4).
    """
    model, state = solved({**pair("0 um", across="6 kN")})
    radial, axial = np.hypot(state.reactions[:, 1], state.reactions[:, 2]), np.abs(state.reactions[:, 0])
    rollers = model.bearings[0].model.rollers
    assert rollers is not None
    assert axial == pytest.approx(radial * math.tan(rollers.contact_angle) / 0.8, rel=0.1)


def test_fits_take_clearance_from_rollers() -> None:
    fits = {"fits": {"shaft": "m5", "housing": "H7"}}
    loose, tight = (resolve_machine({**SHARED, **motor(**more)}).bearings[0].model for more in ({}, fits))
    assert loose.rollers is not None
    assert tight.rollers is not None
    assert tight.rollers.clearance < loose.rollers.clearance - 3e-6
    assert tight.rollers.clearance == pytest.approx(tight.geometry.clearance, rel=1e-12)


def test_a_shaft_in_floating_bearings_cannot_take_thrust() -> None:
    case = motor()
    case["bearings"]["located"] = {"designation": "SKF NU 208 ECP", "at": "360 mm"}
    with pytest.raises(SolverError, match="nothing holds it along x"):
        solved(case)
    del case["loads"]["rotor"]["force_x"]
    _, state = solved(case)
    assert state.reactions[:, 0] == pytest.approx([0.0, 0.0], abs=1e-6)


@pytest.mark.parametrize(
    ("designation", "more", "where", "what"),
    [
        ("32208", {}, "bearings.one.takes", "is required: a roller bearing of kind tapered"),
        ("SKF NJ 208 ECP", {}, "bearings.one.takes", "is required: a roller bearing of kind NJ"),
        ("SKF NU 208 ECP", {"takes": "+x"}, "bearings.one.takes", "leave it out: this bearing takes no thrust"),
        ("SKF NUP 208 ECP", {"takes": "+x"}, "bearings.one.takes", "leave it out: this bearing takes thrust from both"),
        ("SKF NU 999", {}, "bearings.one.designation", ""),
    ],
)
def test_what_is_wrong_with_a_roller_bearing_is_said_where_it_stands(
    designation: str, more: dict[str, Any], where: str, what: str
) -> None:
    case = {**SHARED, "shaft": THICK, "bearings": {"one": {"designation": designation, "at": "30 mm", **more}}}
    with pytest.raises(CaseError) as caught:
        resolve_machine(case)
    assert [(one.where, what in one.message) for one in caught.value.problems] == [(where, True)]


def test_rollers_between_ribs_take_thrust_one_way() -> None:
    """Put all thrust on ribs that face it.

    An NJ 208 at either end with play; the other one has none.
    """
    bearings = {
        "left": {"designation": "SKF NJ 208 ECP", "at": "20 mm", "takes": "-x", "preload": "-20 um"},
        "right": {"designation": "SKF NJ 208 ECP", "at": "360 mm", "takes": "+x", "preload": "-20 um"},
    }
    _, state = solved({**motor(), "bearings": bearings})
    assert state.reactions[:, 0] == pytest.approx([0.0, -250.0], abs=3e-3)
