"""Compare angular contact pairs with equations derived here.

A ball between two grooves without friction and centrifugal force: the distance A of the groove centres is stretched by
both contacts, Q = K s^(3/2) (Harris and Kotzalas 2006, ch. 7), for every ball at its azimuth, five degrees of freedom.
K is Hertz's by elliptic integrals. The program finds the same by the places of the balls, at 1 1/min. Tolerance 0.1 %.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.formulas.hertz import ball_raceway_radii, stiffness_constant
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.drivers.bearing_reaction import BearingReaction
from lambda_core.solver.drivers.machine_statics import MachineState, SharedKernels, solve_machine

from .statics import STEEL

COUNT, BALL, PITCH, INNER, OUTER = 12, 12.7e-3, 60e-3, 0.515, 0.525
DISTANCE, FREE = (INNER + OUTER - 1.0) * BALL, math.radians(25.0)
# Radius of the circle of the inner groove's centres: what tilts moves.
ARM = 0.5 * (PITCH - BALL) - 0.5 * DISTANCE * (1.0 - math.cos(FREE)) + INNER * BALL
GEOMETRY = {
    "ball_count": COUNT, "ball_diameter": "12.7 mm", "pitch_diameter": "60 mm", "conformity_inner": INNER,
    "conformity_outer": OUTER, "bore_diameter": "40 mm", "outside_diameter": "80 mm", "width": "18 mm",
}  # fmt: skip
GROWTH = 12e-6  # [1/K]
PAIR: dict[str, Any] = {
    "name": "pair",
    "shaft": {
        "sections": [{"length": "60 mm", "diameter": "40 mm"}],
        # a thousand times as stiff as steel: what gives way is the bearings
        "material": {
            "youngs_modulus": "210000 GPa", "poisson_ratio": 0.3, "density": "7850 kg/m3",
            "thermal_conductivity": "45 W/(m K)", "specific_heat": "460 J/(kg K)", "thermal_expansion": "12e-6 1/K",
        },
    },
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "operation": {"speed": "1 rpm"},
    "gravity": {"z": "0 m/s2"},
    "models": {"normal_contact": "hertz-exact"},
}  # fmt: skip

KERNELS = SharedKernels()


def pair(force_x: float = 0.0, preload: float = 0.0, arrangement: str = "O", **shaft: Any) -> dict[str, Any]:
    """Return two preloaded bearings.

    20 mm apart with a preload [m] of each, and an axial force [N] on the shaft.
    """
    left, right = {"O": ("+x", "-x"), "X": ("-x", "+x"), "T": ("+x", "+x")}[arrangement]
    more = {"preload": f"{1e6 * preload:.9g} um"} if preload else {}
    bearings = {
        name: {"at": place, "takes": takes, "contact_angle": "25 deg", "geometry": GEOMETRY, **more}
        for name, place, takes in (("left", "20 mm", left), ("right", "40 mm", right))
    }
    loads = {"axial": {"at": "30 mm", "force_x": f"{force_x:.9g} N"}}
    return {**PAIR, "shaft": {**PAIR["shaft"], **shaft}, "bearings": bearings, "loads": loads}


@cache
def constant(angle: float) -> float:
    """Return K of both contacts [N/m^1.5].

    Of a ball in series, Hertz's radii at a contact angle.
    """
    each = [
        stiffness_constant(*ball_raceway_radii(BALL, PITCH, f * BALL, angle, inner=inner), STEEL)
        for f, inner in ((INNER, True), (OUTER, False))
    ]
    return float(sum(k ** (-2.0 / 3.0) for k in each) ** -1.5)


def reaction(pose: FloatArray, angle: float) -> FloatArray:
    """Return force and moment at a pose.

    On the inner ring against the outer one: x, y, z, about y, about z.
    """
    x, y, z, tilt_y, tilt_z = pose
    total = np.zeros(5)
    for j in range(COUNT):
        psi = -0.5 * math.pi + 2.0 * math.pi * j / COUNT
        c, s = math.cos(psi), math.sin(psi)
        lean = ARM * (tilt_y * s - tilt_z * c)  # of the groove's centre along x; it comes nearer to the axis, too
        along, across = x + lean, DISTANCE * math.cos(FREE) + y * c + z * s - 0.5 * lean**2 / ARM
        length = math.hypot(along, across)
        load = constant(angle) * max(length - DISTANCE, 0.0) ** 1.5
        axial, radial = -load * along / length, -load * across / length
        moment = ARM * axial - lean * radial
        total += [axial, radial * c, radial * s, s * moment, -c * moment]
    return total


def of_touching(closed: float) -> FloatArray:
    """Return the pose of pressed rings [m].

    Together along x by a displacement from where they touch.
    """
    return np.array([DISTANCE * math.sin(FREE) + closed, 0.0, 0.0, 0.0, 0.0])


def thrust(closed: float) -> float:
    """Return a bearing's axial force [N].

    Hertz's radii at the contact angle that it has.
    """
    pose = of_touching(closed)
    return -float(reaction(pose, math.atan2(pose[0], DISTANCE * math.cos(FREE)))[0])


def solved(case: dict[str, Any]) -> tuple[MachineModel, MachineState]:
    model = resolve_machine(case)
    return model, solve_machine(model, kernels=KERNELS)


@cache
def alone() -> BearingModel:
    return resolve_machine(pair()).bearings[0].model


@pytest.mark.parametrize(
    "pose",
    [
        [10e-6, 0.0, 0.0, 0.0, 0.0],
        [8e-6, 0.0, -15e-6, 0.0, 0.0],
        [12e-6, 5e-6, -9e-6, 3e-4, -2e-4],
    ],
    ids=["axial", "combined", "with tilt"],
)
def test_loads_and_stiffness_of_one_bearing(pose: list[float]) -> None:
    """Compare force, moment, stiffness and angles to 0.1 %.

    The 5 x 5 stiffness at a pose, and the contact angles of the balls.
    """
    ring = BearingReaction(alone(), FREE, 500.0, KERNELS.of(alone()))
    at = of_touching(pose[0]) + np.array([0.0, *pose[1:]])
    found = ring.reaction(at)
    while ring.refresh():
        found = ring.reaction(at)
    angle = float(np.mean(ring.frame.angles))
    expected = reaction(at, angle)
    force = float(np.abs(expected[:3]).max())
    arms = np.array([1.0, 1.0, 1.0, ARM, ARM])
    np.testing.assert_allclose(found / arms, expected / arms, atol=1e-3 * force)
    steps = np.array([1e-8, 1e-8, 1e-8, 1e-6, 1e-6])
    slope = np.array([
        -(reaction(at + d, angle) - reaction(at - d, angle)) / (2.0 * d.max()) for d in np.diag(steps)
    ]).T  # fmt: skip
    scale = np.sqrt(np.outer(np.diag(slope), np.diag(slope)))
    np.testing.assert_allclose(ring.stiffness() / scale, slope / scale, atol=1e-3)


def test_a_rigid_preload() -> None:
    """Press two bearings in X by 8 um.

    Equal bearings; each carries the force of that displacement.
    """
    _, state = solved(pair(preload=8e-6, arrangement="X"))
    assert state.reactions[:, 0] == pytest.approx([thrust(8e-6), -thrust(8e-6)], rel=1e-3)


def test_displacement_of_a_preloaded_pair() -> None:
    """Close one bearing and open the other.

    F = F(d + x) - F(d - x), for x and both loads.
    """
    preload, force = 8e-6, 1000.0
    x = brentq(lambda x: thrust(preload + x) - thrust(preload - x) - force, 0.0, preload)
    model, state = solved(pair(force, preload))
    assert state.displacement[model.body.rows(0.03).start] == pytest.approx(x, rel=1e-3)
    assert state.reactions[:, 0] == pytest.approx([-thrust(preload + x), thrust(preload - x)], rel=1e-3)


def test_the_unloading_point_of_a_pair() -> None:
    """Unload one bearing of a pair at F(2 d).

    2^1.5 of the preload and a little more, as the angle grows.
    """
    preload = 5e-6
    free = thrust(2.0 * preload)
    assert 2.83 < free / thrust(preload) < 3.1
    (_, below), (_, above) = solved(pair(0.98 * free, preload)), solved(pair(1.02 * free, preload))
    assert below.reactions[1, 0] > 0.0
    assert above.reactions[1, 0] == pytest.approx(0.0, abs=1e-3)
    assert above.reactions[0, 0] == pytest.approx(-1.02 * free, rel=1e-6)


def test_tandem_shares_the_force() -> None:
    model, state = solved(pair(2000.0, arrangement="T"))
    closed = brentq(lambda x: thrust(x) - 1000.0, 1e-7, 1e-4)
    assert state.reactions[:, 0] == pytest.approx([-1000.0, -1000.0], rel=1e-3)
    assert state.displacement[model.body.rows(0.03).start] == pytest.approx(closed, rel=1e-3)


@pytest.mark.parametrize("arrangement", ["O", "X"])
def test_preload_changes_with_temperature(arrangement: str) -> None:
    """Warm the shaft by 20 K against its housing.

    O loses preload and X gains: half of the growth each.
    """
    growth = GROWTH * 20.0 * 0.02
    closed = 8e-6 + (-0.5 if arrangement == "O" else 0.5) * growth
    _, state = solved(pair(preload=8e-6, arrangement=arrangement, temperature="40 degC"))
    assert np.abs(state.reactions[:, 0]) == pytest.approx([thrust(closed)] * 2, rel=1e-3)


def test_a_spring_keeps_the_preload() -> None:
    """Keep 300 N by a spring on a sliding ring.

    Both bearings carry it, with 20 K between shaft and housing too.
    """
    case = pair(temperature="40 degC")
    case["bearings"]["right"]["preload_force"] = "300 N"
    _, state = solved(case)
    assert state.reactions[:, 0] == pytest.approx([-300.0, 300.0], rel=1e-6)


def test_the_wrong_side_is_said() -> None:
    """Push a tandem pair along -x.

    It takes +x only.
    """
    with pytest.raises(SolverError):
        solved(pair(-500.0, arrangement="T"))
