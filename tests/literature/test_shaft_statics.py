"""Compare shafts with statics, gears and lives with textbooks."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core.analysis.rotor.vibration import supported
from lambda_core.domain.errors import CaseError, SolverError
from lambda_core.formulas.elastic.body import shaft_body
from lambda_core.formulas.elastic.reduced import write_reduced
from lambda_core.formulas.elastic.sections import BodyMaterial, RoundSection
from lambda_core.formulas.elastic.whirl import craig_bampton
from lambda_core.formulas.gear_forces import gear_forces
from lambda_core.formulas.life import dynamic_equivalent_load, static_equivalent_load, system_life
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.drivers.machine_statics import MachineState, SharedKernels, solve_machine

PINNED = {"tilt_y": "free", "tilt_z": "free"}  # outer rings that follow, so that no bearing bears a moment
SHARED: dict[str, Any] = {
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "operation": {"speed": "1500 rpm"},
}
GRAVITY = 9.80665

KERNELS = SharedKernels()


def bearing(position: str, designation: str = "SKF 6206", **more: Any) -> dict[str, Any]:
    """Return a bearing that leaves the shaft to tilt."""
    return {"at": position, "designation": designation, "support": PINNED, **more}


def solved(case: dict[str, Any]) -> tuple[MachineModel, MachineState]:
    model = resolve_machine({"name": "shaft", **SHARED, **case})
    return model, solve_machine(model, kernels=KERNELS)


@cache
def overhung() -> tuple[MachineModel, MachineState]:
    """Return an overhung shaft.

    Bearings at 30 and 150 mm, a force beyond the second one at 200 mm; the left one locates.
    """
    return solved(
        {
            "shaft": {
                "sections": [{"length": "120 mm", "diameter": "30 mm"}, {"length": "90 mm", "diameter": "28 mm"}]
            },
            "bearings": {
                "left": bearing("30 mm"),
                "right": bearing("150 mm", support={**PINNED, "x": "free"}),
            },
            "loads": {"gear": {"at": "200 mm", "force_z": "-1200 N", "force_y": "300 N", "force_x": "150 N"}},
        }
    )


def test_reactions_of_a_statically_determinate_shaft() -> None:
    """Compare reactions with levers to 1e-6.

    F l/a on the far bearing, F (l + a)/a on the near one, weight by its pieces, of the load.

    Each bearing carries its own inner ring.
    """
    model, state = overhung()
    rings = np.array([GRAVITY * one.model.inner_ring.mass for one in model.bearings])
    pieces = [(7800.0 * math.pi / 4.0 * d**2 * b, x) for d, b, x in ((0.03, 0.12, 0.06), (0.028, 0.09, 0.165))]
    density = model.body.total_mass / sum(m / 7800.0 for m, _ in pieces)
    span, overhang = 0.12, 0.05
    for axis, force in ((1, 300.0), (2, -1200.0)):
        weights = [(-m / 7800.0 * density * GRAVITY, x) for m, x in pieces] if axis == 2 else []
        right = -sum(w * (x - 0.03) for w, x in weights) / span - force * (span + overhang) / span
        left = -force - right - sum(w for w, _ in weights)
        carried = np.array([left, right]) + (rings if axis == 2 else 0.0)
        assert state.reactions[:, axis] == pytest.approx(carried, abs=1e-6 * 1200.0)
    assert state.reactions[:, 0] == pytest.approx([-150.0, 0.0], abs=1e-6 * 1200.0)
    assert np.abs(state.reactions[:, 3:]).max() < 1e-6 * 1200.0 * span


def test_the_overhung_gear_without_weight() -> None:
    """Compare an overhung gear with levers to 1e-6.

    F l/a on the far bearing, F (a + l)/a on the near one.
    """
    _, state = solved(
        {
            "shaft": {"sections": [{"length": "210 mm", "diameter": "30 mm"}]},
            "bearings": {"left": bearing("30 mm"), "right": bearing("150 mm", support={**PINNED, "x": "free"})},
            "loads": {"gear": {"at": "200 mm", "force_z": "-1200 N"}},
            "gravity": {"z": "0 m/s2"},
        }
    )
    assert state.reactions[:, 2] == pytest.approx([-1200.0 * 50 / 120, 1200.0 * 170 / 120], abs=1e-6 * 1200.0)
    assert state.drive_torque == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("axial", [0.0, 150.0])
def test_self_aligning_bearings_bear_no_moment(axial: float) -> None:
    """Compare two 1208 E with levers to 1e-6.

    Locked seats; their forces go through the centres of the outer rings' spheres.

    Under thrust an inner ring stands 0.1 mm off its sphere's centre, by which its force has a lever that no beam on
    points has (6e-5 of the load); about the centre nothing is left. Tilts differ by what a beam on two points has, F a
    l/(6 E I) at the far bearing and -F a l/(3 E I) at the near one (Timoshenko, Strength of Materials); shear takes one
    percent of a shaft this slender.
    """
    model, state = solved(
        {
            "shaft": {"sections": [{"length": "1000 mm", "diameter": "40 mm"}]},
            "bearings": {
                "left": {"at": "100 mm", "designation": "1208E"},
                "right": {"at": "700 mm", "designation": "1208E", "support": {"x": "free"}},
            },
            "loads": {"gear": {"at": "900 mm", "force_z": "-1500 N", "force_x": f"{axial} N"}},
            "gravity": {"z": "0 m/s2"},
        }
    )
    force, moment = state.reactions[:, :3], np.zeros((2, 3))
    moment[:, 1:] = state.reactions[:, 3:]
    neighbour = np.array([state.pose(model, i)[:3] for i in range(2)])
    about_sphere = (moment + np.cross(neighbour, force))[:, 1:]
    assert np.abs(about_sphere).max() < 1e-6 * 1500.0 * 0.6
    assert force[:, 0] == pytest.approx([-axial, 0.0], abs=1e-6 * 1500.0)
    assert force.sum(axis=0) == pytest.approx([-axial, 0.0, 1500.0], abs=1e-6 * 1500.0)
    levers = -(1500.0 * 0.2 + moment[:, 1].sum()) / 0.6  # of all about y at the right bearing
    assert force[0, 2] == pytest.approx(levers, abs=1e-6 * 1500.0)
    assert force[0, 2] == pytest.approx(-500.0, abs=1500.0 * (1e-6 if axial == 0.0 else 1e-4))
    tilts = [state.pose(model, i)[3] for i in range(2)]
    unit = 1500.0 * 0.2 * 0.6 / (6.0 * model.body.elements[0].material.youngs_modulus * math.pi / 64.0 * 0.04**4)
    assert abs(tilts[1] - tilts[0]) == pytest.approx(3.0 * unit, rel=0.01)
    told = " ".join(model.assumptions)
    assert "does not tilt" not in told
    assert "left: a self-aligning bearing follows every tilt of the shaft without resistance" in told


@pytest.mark.full
def test_three_bearings_with_loads_at_midspan() -> None:
    """Compare with 5/16, 22/16, 5/16 of each load.

    Roark, continuous beam of two equal spans, stiff supports.

    The bearings have no clearance and are a thousand times as stiff as the spans of a metre (0.2 %); shear of a bar 50
    diameters long moves the numbers by less.
    """
    load = 200.0
    _, state = solved(
        {
            "shaft": {"sections": [{"length": "2000 mm", "diameter": "20 mm"}]},
            "bearings": {
                name: bearing(place, "SKF 6204", clearance="0 um", support={**PINNED, **more})
                for name, place, more in (
                    ("a", "0 mm", {}),
                    ("b", "1000 mm", {"x": "free"}),
                    ("c", "2000 mm", {"x": "free"}),
                )
            },
            "loads": {
                "one": {"at": "500 mm", "force_z": f"-{load} N"},
                "two": {"at": "1500 mm", "force_z": f"-{load} N"},
            },
            "gravity": {"z": "0 m/s2"},
        }
    )
    assert state.reactions[:, 2] / load == pytest.approx([5 / 16, 22 / 16, 5 / 16], rel=5e-3)
    assert state.reactions[:, 2].sum() == pytest.approx(2.0 * load, rel=1e-6)


def test_six_bearings() -> None:
    """Share loads of one shaft between six bearings.

    Mirrored as the loads are (1e-6).
    """
    places = (10, 60, 110, 190, 240, 290)
    _, state = solved(
        {
            "shaft": {"sections": [{"length": "300 mm", "diameter": "30 mm"}]},
            "bearings": {
                f"b{i}": {"at": f"{x} mm", "designation": "SKF 6206", "support": {} if i == 2 else {"x": "free"}}
                for i, x in enumerate(places)
            },
            "loads": {"belt": {"at": "150 mm", "force_z": "-6 kN"}},
            "gravity": {"z": "0 m/s2"},
        }
    )
    up = state.reactions[:, 2]
    assert up.sum() == pytest.approx(6000.0, rel=1e-6)
    assert up == pytest.approx(up[::-1], abs=2.0)  # one of them locates, and its balls sit a little aside
    assert up[2] > up[1]
    assert state.residual < 1e-6


def test_the_limit_of_a_rigid_shaft() -> None:
    """Compare reactions with a rigid shaft to 1e-6.

    The shaft is ten million times stiffer; the rigid one is solved here in five unknowns.

    Both tilt in their bearings; forces differ by the steel shaft's deflection over that ratio.
    """
    steel: dict[str, Any] = {
        "poisson_ratio": 0.3, "density": "7800 kg/m3", "thermal_expansion": "12e-6 1/K",
        "thermal_conductivity": "45 W/(m K)", "specific_heat": "460 J/(kg K)",
    }  # fmt: skip
    found = {}
    for ratio in (1.0, 1e7):
        model, found[ratio] = solved(
            {
                "shaft": {
                    "sections": [{"length": "200 mm", "diameter": "30 mm"}],
                    "material": {**steel, "youngs_modulus": f"{210 * ratio:.17g} GPa"},
                },
                "bearings": {
                    "left": {"at": "30 mm", "designation": "SKF 6206"},
                    "right": {"at": "150 mm", "designation": "SKF 6206", "support": {"x": "free"}},
                },
                "loads": {"gear": {"at": "80 mm", "force_z": "-2 kN", "force_y": "500 N", "force_x": "300 N"}},
            }
        )
    state = found[1e7]
    frames, loads = [], np.zeros(5)  # of the shaft's pose x, y, z and tilts about y and z at x = 0
    for place in model.body.positions:
        frame = np.eye(5)
        frame[1, 4], frame[2, 3] = place, -place
        loads += frame.T @ (model.loads + model.weight)[model.body.rows(place)][[0, 1, 2, 4, 5]]
        rings = [b.model.inner_ring.mass for b in model.bearings if place == pytest.approx(b.position)]
        loads += frame.T @ [0.0, 0.0, -GRAVITY * sum(rings), 0.0, 0.0]
        if any(place == pytest.approx(b.position) for b in model.bearings):
            frames.append(frame)
    pose = np.linalg.solve(frames[0], state.pose(model, 0))
    float_along = np.array([state.outer[1, 0], 0.0, 0.0, 0.0, 0.0])  # the right outer ring floats
    for _ in range(5):
        poses = [frames[0] @ pose, frames[1] @ pose - float_along]
        reactions = [ring.reaction(p) for ring, p in zip(state.rings, poses, strict=True)]
        stiffness = [f.T @ ring.stiffness() @ f for f, ring in zip(frames, state.rings, strict=True)]
        pose += np.linalg.solve(sum(stiffness), loads + sum(f.T @ r for f, r in zip(frames, reactions, strict=True)))
    scale = np.abs(reactions).max(axis=0)
    assert np.abs((state.reactions - reactions) / np.maximum(scale, 1.0)).max() < 1e-6
    assert np.abs((found[1.0].reactions - reactions) / np.maximum(scale, 1.0)).max() > 1e-4


def test_what_nothing_holds_is_said() -> None:
    """Report an axial force that nothing holds.

    Both outer rings float.
    """
    with pytest.raises(SolverError, match="nothing holds it along x"):
        solved(
            {
                "shaft": {"sections": [{"length": "200 mm", "diameter": "30 mm"}]},
                "bearings": {
                    "left": bearing("30 mm", support={"x": "free"}),
                    "right": bearing("150 mm", support={"x": "free"}),
                },
                "loads": {"gear": {"at": "100 mm", "force_x": "200 N", "force_z": "-500 N"}},
            }
        )


def test_housing_in_series() -> None:
    """Compare an outer ring on springs exactly.

    It moves by its reaction and its weight over their stiffness.
    """
    model, state = solved(
        {
            "shaft": {"sections": [{"length": "200 mm", "diameter": "30 mm"}]},
            "bearings": {
                "left": bearing("30 mm", support={**PINNED, "z": "50 N/um", "y": "20 N/um"}),
                "right": bearing("150 mm", support={**PINNED, "x": "free"}),
            },
            "loads": {"gear": {"at": "100 mm", "force_z": "-2 kN", "force_y": "500 N"}},
        }
    )
    carried = state.reactions[0, 1:3] + [0.0, GRAVITY * model.bearings[0].model.outer_ring.mass]
    assert -state.outer[0, 1:3] * [20e6, 50e6] == pytest.approx(carried, rel=1e-6)


def test_an_elastic_housing_from_a_file(tmp_path: Path) -> None:
    """Move the seats as a beam of a file.

    The beam joins both seats, on two springs to the ground, as a reduced model.

    Against the beam's own flexibility under reactions and the weight of rings (1e-6); a housing that floats is refused.
    """
    material = BodyMaterial(210e9, 0.3, 7850.0)
    beam = shaft_body([(0.2, RoundSection(0.05, 0.0, material))], places=[0.03, 0.15])
    ground = np.diag([5e7, 5e7, 5e7, 1e4, 1e4, 1e4])
    stiffness = beam.stiffness.copy()
    for end in (0.0, 0.2):
        stiffness[beam.rows(end), beam.rows(end)] += ground
    held = craig_bampton(replace(beam, stiffness=stiffness), [0.03, 0.15], 2)
    write_reduced(held, tmp_path / "housing.json")
    case = {
        "shaft": {"sections": [{"length": "200 mm", "diameter": "30 mm"}]},
        "bearings": {
            "left": bearing("30 mm", support={}),
            "right": bearing("150 mm", support={"x": "free"}),
        },
        "loads": {"gear": {"at": "100 mm", "force_z": "-2 kN", "force_y": "500 N", "force_x": "300 N"}},
        "housing": {"reduced": str(tmp_path / "housing.json")},
    }
    model, state = solved(case)
    pushed = np.zeros(stiffness.shape[0])
    rows = [beam.rows(place).start + np.array([0, 1, 2, 4, 5]) for place in (0.03, 0.15)]
    for place, force, one in zip(rows, state.reactions, model.bearings, strict=True):
        pushed[place] -= force
        pushed[place[2]] -= GRAVITY * one.model.outer_ring.mass
    moved = np.linalg.solve(stiffness, pushed)
    assert state.outer[0] == pytest.approx(moved[rows[0]], rel=1e-6, abs=1e-12)
    assert state.outer[1, 1:] == pytest.approx(moved[rows[1]][1:], rel=1e-6, abs=1e-12)
    assert np.linalg.eigvalsh(supported(model, state))[1] > 0.0  # only turning is free
    write_reduced(craig_bampton(beam, [0.03, 0.15], 2), tmp_path / "housing.json")
    with pytest.raises(CaseError, match=r"housing\.json: the housing is held by nothing"):
        solved(case)
    write_reduced(craig_bampton(replace(beam, stiffness=stiffness), [0.03], 2), tmp_path / "housing.json")
    with pytest.raises(CaseError, match=r"right: there is no node at 0\.15 m; nodes are at 30 mm"):
        solved(case)


def test_helical_gear_forces() -> None:
    """Compare with Shigley, example 13-9.

    Budynas and Nisbett: 18-tooth pinion, P_n = 12, 20 degrees, helix 30, 1 hp at 1750 1/min.

    d = 18/(12 cos(30)) = 1.732 in, V = 793.5 ft/min, W_t = 41.6 lbf, W_r = 17.5 lbf, W_a = 24.0 lbf (last digit).
    """
    inch, pound = 0.0254, 4.4482216
    speed = 1750.0 * math.pi / 30.0
    found = gear_forces(
        745.7 / speed, 1.732 * inch, mesh=0.0, role="driving", spin=speed,
        pressure_angle=math.radians(20.0), helix_angle=math.radians(30.0),
    )  # fmt: skip
    assert found.tangential / pound == pytest.approx(41.6, abs=0.06)
    assert found.radial / pound == pytest.approx(17.5, abs=0.06)
    assert found.axial / pound == pytest.approx(24.0, abs=0.06)


def test_directions_of_gear_forces() -> None:
    """Compare directions of gear forces.

    Mesh on top, spin about +x: a driven gear is pushed to -y; a right-hand driving pinion is thrust along +x.
    """
    angles = {"pressure_angle": math.radians(20.0), "helix_angle": math.radians(15.0), "hand": "right"}
    driven = gear_forces(100.0, 0.1, mesh=0.5 * math.pi, role="driven", spin=100.0, **angles)
    assert driven.force[1] == pytest.approx(-2000.0)
    assert driven.force[2] == pytest.approx(-driven.radial)
    assert driven.moment[0] == pytest.approx(100.0)
    driving = gear_forces(100.0, 0.1, mesh=0.5 * math.pi, role="driving", spin=100.0, **angles)
    assert driving.force[0] == pytest.approx(2000.0 * math.tan(math.radians(15.0)))
    assert driving.moment[0] == pytest.approx(-100.0)
    assert driving.moment[1] == pytest.approx(0.05 * driving.force[0])


@pytest.mark.parametrize(
    ("angle", "limit", "x", "y", "y_0"),
    [
        (15, 0.38, 0.44, 1.47, 0.46),
        (25, 0.68, 0.41, 0.87, 0.38),
        (30, 0.80, 0.39, 0.76, 0.33),
        (40, 1.14, 0.35, 0.57, 0.26),
    ],
)
def test_factors_of_angular_contact(angle: int, limit: float, x: float, y: float, y_0: float) -> None:
    """Compare factors at and near the limit e.

    ISO 281:2007, table 3 (15 degrees: f_0 F_a/C_0r = 0.178), ISO 76:2006, table 2.
    """
    radians, static = math.radians(angle), 10e3
    axial = 0.178 * static / 14.0
    found = dynamic_equivalent_load(0.1 * axial, axial, static, 14.0, radians)
    assert (found.limit, found.radial_factor, found.axial_factor) == pytest.approx((limit, x, y))
    assert dynamic_equivalent_load(axial / limit * 1.01, axial, static, 14.0, radians).load == axial / limit * 1.01
    assert static_equivalent_load(100.0, 1000.0, radians) == pytest.approx(50.0 + 1000.0 * y_0)


def test_life_of_a_system() -> None:
    """Compare life of two bearings with 2^(-0.9).

    Weibull slopes 10/9 of balls and 9/8 of rollers; a much longer life does not count.
    """
    balls, rollers = 10.0 / 9.0, 9.0 / 8.0
    assert system_life([1000.0, 1000.0], [balls, balls]) == pytest.approx(1000.0 * 2.0**-0.9)
    assert system_life([1000.0, 1e9], [balls, balls]) == pytest.approx(1000.0, rel=1e-5)
    assert system_life([1000.0, 1000.0], [rollers, rollers]) == pytest.approx(1000.0 * 2.0 ** (-8.0 / 9.0))
    mixed = system_life([1000.0, 2000.0], [balls, rollers])
    assert (mixed / 1000.0) ** balls + (mixed / 2000.0) ** rollers == pytest.approx(1.0)  # survivals multiply
    assert system_life([0.0, 2000.0], [balls, rollers]) == 0.0


def test_warm_rings_in_the_equilibrium_of_the_machine() -> None:
    """Warm an inner ring by 30 K.

    It takes alpha dT d of the clearance; the machine equals one with such clearance.

    Growth at the raceway, 12e-6/K times the raceway's diameter (docs/theory); reactions and poses to 1e-9.
    """
    warm = {"inner_ring": "80 degC", "outer_ring": "50 degC", "balls": "50 degC"}
    found = []
    for more in ({"temperatures": warm}, {}):
        case: dict[str, Any] = {
            "shaft": {"sections": [{"length": "200 mm", "diameter": "30 mm"}]},
            "bearings": {
                "left": bearing("30 mm", **more),
                "right": bearing("150 mm", **more, support={**PINNED, "x": "free"}),
            },
            "loads": {"gear": {"at": "80 mm", "force_z": "-2 kN", "force_y": "500 N", "force_x": "300 N"}},
        }
        if not more:
            for one in case["bearings"].values():
                one["clearance"] = f"{1e6 * found[0][0].bearings[0].model.geometry.clearance:.15g} um"
        found.append(solved(case))
    (hot, one), (tight, two) = found
    loose = resolve_machine({"name": "shaft", **SHARED, **case, "bearings": {"left": bearing("30 mm")}})
    lost = loose.bearings[0].model.geometry.clearance - hot.bearings[0].model.geometry.clearance
    assert lost == pytest.approx(12e-6 * 30.0 * hot.bearings[0].model.geometry.race_diameter_inner, rel=0.15)
    assert tight.bearings[0].model.geometry.clearance == pytest.approx(hot.bearings[0].model.geometry.clearance)
    assert two.reactions == pytest.approx(one.reactions, rel=1e-6, abs=1e-3)
    assert two.pose(tight, 0) == pytest.approx(one.pose(hot, 0), rel=1e-3, abs=1e-9)


def test_misalignment_of_the_rings() -> None:
    """Compare misalignment with the shaft's slope.

    Against the outer ring: all of it where the seat is locked.
    """
    _, overhung_state = overhung()
    model = overhung()[0]
    slope = overhung_state.displacement[model.body.rows(0.15)][4:]
    tilt = overhung_state.pose(model, 1)[3:]
    assert np.abs(tilt + overhung_state.outer[1, 3:] - slope).max() < 1e-15
    assert np.abs(slope).max() > 1e-4
    case: dict[str, Any] = {
        "shaft": {"sections": [{"length": "200 mm", "diameter": "30 mm"}]},
        "bearings": {"left": bearing("30 mm", support={}), "right": bearing("150 mm", support={"x": "free"})},
        "loads": {"gear": {"at": "195 mm", "force_z": "-1 kN"}},
    }
    model, state = solved(case)
    assert state.pose(model, 1)[3:] == pytest.approx(state.displacement[model.body.rows(0.15)][4:], abs=1e-15)
    assert np.abs(state.pose(model, 1)[3:]).max() > 1e-4
