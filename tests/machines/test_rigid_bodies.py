"""Test markers, rigid bodies and springs between them."""

from __future__ import annotations

import math
import tomllib
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.rotor.machine_equilibrium import BodyMoved
from lambda_core.analysis.rotor.vibration import criticals, damped, masses, modes_at, supported
from lambda_core.domain.errors import SolverError
from lambda_core.formulas.elastic.whirl import natural_frequencies
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.machine_assembly import member_numbers
from lambda_core.solver.drivers.machine_motion import MachineEngine, machine_engine
from lambda_core.solver.drivers.machine_statics import SharedKernels, solve_machine
from lambda_core.solver.drivers.structure import static_rows, stretch
from lambda_core.solver.drivers.tables import STATES

KERNELS = SharedKernels()
MOUNT = {
    "x": "20 N/um",
    "y": {"stiffness": "30 N/um", "damping": "2000 N s/m"},
    "z": {"stiffness": "40 N/um", "damping": "2000 N s/m"},
}


def tables(**changes: Any) -> dict[str, Any]:
    """Return the template in a housing.

    Of 12 kg on four mounts, the left bearing's seat damped.
    """
    found = tomllib.loads(shaft_text("geared-shaft", "box"))
    found["bodies"] = {"box": {"x": "85 mm", "z": "-40 mm", "length": "160 mm", "width": "120 mm", "height": "80 mm"}}
    feet = {f"{a}{b}": (x, y) for a, x in (("l", 10), ("r", 160)) for b, y in (("f", -60), ("b", 60))}
    found["markers"] = {
        f"foot-{name}": {"body": "box", "x": f"{x} mm", "y": f"{y} mm", "z": "-80 mm"}
        for name, (x, y) in feet.items()
    }  # fmt: skip
    found["connections"] = {f"mount-{name}": {"at": f"foot-{name}", **MOUNT} for name in feet}
    for name in ("left", "right"):
        found["bearings"][name]["outer"] = "box"
    found["bearings"]["left"]["support"] = {"y": {"stiffness": "300 N/um", "damping": "1000 N s/m"}}
    return found | changes


@pytest.fixture(scope="module")
def model() -> MachineModel:
    return resolve_machine(tables())


def test_a_housing_on_mounts_in_equilibrium(model: MachineModel) -> None:
    """Balance mounts with gear and weights to 1e-6.

    In force and moment about the housing's centre.
    """
    state, rows = solve_machine(model, kernels=KERNELS), static_rows(model)
    (box,) = model.bodies
    assert box.mass == pytest.approx(model.body.elements[0].material.density * 0.16 * 0.12 * 0.08)
    assert box.polar_inertia == pytest.approx(box.mass * (0.12**2 + 0.08**2) / 12.0)
    assert box.transverse_inertia == pytest.approx(box.mass * (0.16**2 / 12.0 + (0.12**2 + 0.08**2) / 24.0))
    force, moment = np.zeros(3), np.zeros(3)
    for spring in model.springs:
        wrench = -spring.stiffness @ stretch(model, rows, spring) @ state.motions
        force += wrench[:3]
        moment += wrench[3:] + np.cross(np.subtract(spring.place.point, box.centre), wrench[:3])
    acting = (model.loads + model.weight)[: model.body.mass.shape[0]].reshape(-1, 6)
    rings = [(one.position, one.model.inner_ring.mass + one.model.outer_ring.mass) for one in model.bearings]
    total = acting[:, :3].sum(axis=0) - [0.0, 0.0, 9.80665 * (box.mass + sum(mass for _, mass in rings))]
    assert force + total == pytest.approx(np.zeros(3), abs=1e-6 * np.abs(total).max())
    arms = np.array([[x, 0.0, 0.0] for x in model.body.positions]) - box.centre
    turned = acting[:, 3:].sum(axis=0) + np.cross(arms, acting[:, :3]).sum(axis=0)
    turned[0] += state.drive_torque  # the coupling holds the shaft, not the housing
    for place, mass in rings:
        turned += np.cross([place, 0.0, 0.0] - np.array(box.centre), [0.0, 0.0, -9.80665 * mass])
    assert moment + turned == pytest.approx(np.zeros(3), abs=1e-5 * np.abs(turned).max())
    assert state.residual < 1e-9


def test_a_stiff_housing_is_the_ground(model: MachineModel) -> None:
    """Compare stiff mounts with the ground.

    10^4 times as stiff, and held: reactions to 1e-3 of the seats' displacement.
    """
    ground = tables()
    for bearing in ground["bearings"].values():
        bearing["outer"] = "ground"
    held = tables(connections={})
    held["bodies"]["box"]["support"] = dict.fromkeys(("x", "y", "z", "tilt_x", "tilt_y", "tilt_z"), "locked")
    one, two = (
        solve_machine(resolve_machine(case), kernels=KERNELS)
        for case in (ground | {"connections": {}, "bodies": {}, "markers": {}}, held)
    )
    assert two.reactions == pytest.approx(one.reactions, rel=1e-3, abs=1e-3 * np.abs(one.reactions).max())
    assert np.array_equal(two.bodies, np.zeros((1, 6)))


def test_no_body_turns_heavier_about_x_than_about_y_and_z_together() -> None:
    """Require I_x <= I_y + I_z.

    It holds for any masses; a thin disc, where both are equal, is a body.
    """
    case = tables()
    case["bodies"]["box"] |= {"polar_inertia": "0.2 kg m2", "transverse_inertia": "0.1 kg m2"}
    assert resolve_machine(case).bodies[0].polar_inertia == 0.2
    case["bodies"]["box"] |= {"polar_inertia": "0.21 kg m2"}
    with pytest.raises(api.CaseError, match=r"bodies\.box\.polar_inertia +no body has a polar inertia, 0\.21 kg m2"):
        resolve_machine(case)


def test_modes_of_a_housing_on_its_mounts(model: MachineModel) -> None:
    """Compare six frequencies with a textbook's rigid body.

    A body on mounts with a shaft a thousand times lighter (1e-2).

    K of the mounts about the centre of mass, M of the body; the shaft adds its mass, which is put into M.
    """
    case = tables()
    case["bodies"]["box"] |= {"mass": "12000 kg", "polar_inertia": "30 kg m2", "transverse_inertia": "40 kg m2"}
    heavy = resolve_machine(case)
    state = solve_machine(heavy, kernels=KERNELS)
    stiffness = supported(heavy, state)
    found = sorted(m.frequency for m in modes_at(heavy, stiffness, 0.0) if m.kind == "body")[:6]
    k = np.zeros((6, 6))
    for spring in heavy.springs:
        x, y, z = np.subtract(spring.place.point, heavy.bodies[0].centre)
        reach = np.array([[1, 0, 0, 0, z, -y], [0, 1, 0, -z, 0, x], [0, 0, 1, y, -x, 0]], dtype=float)
        k += reach.T @ np.diag([20e6, 30e6, 40e6]) @ reach
    expected = natural_frequencies(k, np.diag([12000.0] * 3 + [30.0, 40.0, 40.0]))[0]
    assert [f for f in found if f > 1.0] == pytest.approx(sorted(expected)[: len(found)], rel=2e-2)
    assert masses(heavy)[0].shape == stiffness.shape == damped(heavy, state, np.zeros((2, 6, 6))).shape


def test_a_shaft_that_swings_with_its_housing_has_its_critical_speed(model: MachineModel) -> None:
    """Find the critical speed of shaft and housing.

    Mounts of 20 to 40 N/um under 16 kg shake the shaft far below its own bending (m w^2 = k, 10 %).
    """
    box = model.bodies[0]
    found = criticals(model, supported(model, solve_machine(model, kernels=KERNELS)))
    first = min(mode.frequency for mode in found if mode.bodies_share > 0.5)
    mass = box.mass + model.body.total_mass
    assert found[0].frequency <= first < 1.1 * math.sqrt(4 * 40e6 / mass)
    assert all(mode.lateral > 0.1 for mode in found)


def test_what_nothing_holds_is_said() -> None:
    """Report free bearings and a box on one mount.

    The bearings are free along x; the box takes the shaft with it.
    """
    case = tables(connections={}, bodies={}, markers={})
    for name in ("left", "right"):
        case["bearings"][name] |= {"outer": "ground", "support": {"x": "free"}}
    with pytest.raises(SolverError, match="nothing holds it along x"):
        solve_machine(resolve_machine(case), kernels=KERNELS)
    alone = tables(connections={"foot": {"at": "foot-lf", "z": "20 N/um"}})
    with pytest.raises(SolverError, match="nothing holds it"):
        solve_machine(resolve_machine(alone), kernels=KERNELS)


def test_a_housing_in_motion(model: MachineModel) -> None:
    """Start a housing in equilibrium and balance energy.

    To 1e-3 with the energy of mounts and seats; columns of the Jacobian are right.
    """
    engine = machine_engine(model)
    bundle, y = engine.context.bundle, engine._memory.y
    number = int(member_numbers(model, engine.start.shaft).bodies[0])
    dydt, rates = np.zeros(y.size), np.zeros(L.power_count(bundle))
    assert core().evaluate(0.0, y, bundle, dydt, rates, 1) == 1
    force = bundle.body_wrenches["force"][number] + [0.0, 0.0, -9.80665 * model.bodies[0].mass]
    assert np.abs(force).max() < 2.0  # of 900 N: the weight of the outer rings, which the equilibrium leaves out
    check_columns(engine, number)
    assert engine.advance(3e-3).ok
    for row in engine.integrals():
        losses = sum(value for name, value in row.items() if name.startswith("loss"))
        assert abs(row["input"] - losses - row["stored"]) < 1e-3 * row["input_abs"]
    samples = engine.samples()
    moved = samples.machine["body_position"][:, 0] - engine.start.state.bodies[0, :3]
    assert 0.0 < np.abs(moved).max() < 5e-6  # the ball passage shakes it, no more


def check_columns(engine: MachineEngine, number: int) -> None:
    """Check the accelerations' slopes of a body.

    With its own motion, against differences (3e-4, the tilts).
    """
    bundle, y = engine.context.bundle, engine._memory.y.copy()
    base = L.NB * int(bundle.system["balls"][0])
    dydt, rates = np.zeros(y.size), np.zeros(L.power_count(bundle))
    assert core().evaluate(0.0, y, bundle, dydt, rates, 1) == 1
    assert core().jacobian(0.0, y, bundle, engine.context.blocks) == 1
    slots = L.NS * number + np.array([*STATES, L.SVX, L.SVY, L.SVZ, L.SWY, L.SWZ])
    own = [int(np.flatnonzero(bundle.active == slot)[0]) for slot in slots]
    for column, slot in zip(own, slots, strict=True):
        step = 1e-9 if slot % L.NS < L.SVX else 1e-4
        found = []
        for sign in (1.0, -1.0):
            near = y.copy()
            near[base + column] += sign * step
            assert core().evaluate(0.0, near, bundle, dydt, rates, 1) == 1
            found.append(dydt[base:].copy())
        slope = ((found[0] - found[1]) / (2.0 * step))[own]
        off = np.abs(engine.context.blocks.d[np.ix_(own, [column])].ravel() - slope).max()
        assert off < 3e-4 * np.abs(slope).max() + 1e-3, slot


def test_a_spring_along_turned_axes() -> None:
    """Turn a spring by 30 degrees about x.

    k along y gives k cos^2, k sin cos, k sin^2 (exact); a load there turns, too.
    """
    case = tables(markers={"felt": {"x": "110 mm", "about_x": "30 deg"}}, bodies={})
    case["connections"] = {"felt": {"at": "felt", "y": "10 N/um"}}
    wave = {"kind": "harmonic", "amplitude": "100 N", "frequency": "50 Hz", "phase": "90 deg"}
    case["loads"] = {"pull": {"at": "felt", "force_y": wave}}
    for bearing in case["bearings"].values():
        bearing.pop("outer")
    model = resolve_machine(case)
    c, s = math.cos(math.pi / 6.0), math.sin(math.pi / 6.0)
    assert model.springs[0].stiffness[1:3, 1:3] == pytest.approx(1e7 * np.array([[c * c, c * s], [c * s, s * s]]))
    row = model.body.rows(0.11).start
    varying = dict(model.varying)
    assert [varying[row + i].terms[0].values[0] for i in (1, 2)] == pytest.approx([100.0 * c, 100.0 * s])
    assert model.loads[row + 1 : row + 3] == pytest.approx([100.0 * c, 100.0 * s])


def test_a_torque_over_time() -> None:
    """Answer moment_x at once by the coupling.

    The shaft does not twist.
    """
    wave = {"kind": "harmonic", "amplitude": "20 N m", "frequency": "100 Hz", "phase": "90 deg"}
    case = tomllib.loads(shaft_text("geared-shaft", "box")) | {"loads": {"fan": {"at": "160 mm", "moment_x": wave}}}
    model = resolve_machine(case)
    assert model.loads[model.body.rows(0.16).start + 3] == pytest.approx(20.0)
    assert dict(model.varying)[model.body.rows(0.16).start + 3].terms[0].kind == "harmonic"
    state = solve_machine(model, kernels=KERNELS)
    assert state.drive_torque == pytest.approx(-20.0 - model.gears["wheel"].moment[0], rel=1e-6)


def test_mistakes_with_their_paths() -> None:
    case = tables()
    case["bearings"]["left"]["outer"] = "bos"
    case["bearings"]["right"]["at"] = "nowhere"
    case["markers"]["loose"] = {"body": "boks", "x": "10 mm"}
    case["connections"]["own"] = {"at": "foot-lf", "to": "box", "z": "1 N/um"}
    case["connections"]["far"] = {"at": "110 mm", "to": "foot-lf", "z": "1 N/um"}
    with pytest.raises(api.CaseError) as found:
        resolve_machine(case)
    told = {problem.where: problem.message for problem in found.value.problems}
    assert "box" in told["bearings.left.outer"]
    assert {"bearings.right.at", "markers.loose.body", "connections.own.to", "connections.far.to"} <= set(told)
    case = tables()
    case["bearings"]["left"]["support"] = {"y": {"mode": "locked", "damping": "10 N s/m"}}
    case["bearings"]["left"]["outer"] = "ground"
    case["connections"]["grip"] = {"at": "110 mm", "tilt_x": "1 N m/mrad"}
    with pytest.raises(api.CaseError, match=r"connections\.grip\.tilt_x +would prevent rotation"):
        resolve_machine(case)
    del case["connections"]["grip"]
    with pytest.raises(api.CaseError, match=r"bearings\.left\.support\.y\.damping +has no effect"):
        resolve_machine(case)
    case = tables()
    case["bodies"]["box"]["bore"] = "1 mm"
    case["bodies"]["box"]["height"] = "0 mm"
    with pytest.raises(api.CaseError, match=r"bodies\.box\.height"):
        resolve_machine(case)


def test_names_have_paths() -> None:
    """Refuse impossible and existing names with their paths."""
    case = tables()
    case["bearings"]["shaft"] = case["bearings"].pop("left")
    case["discs"]["a b"] = case["discs"].pop("wheel")
    case["bodies"]["ground"] = {"x": "0 mm"}
    with pytest.raises(api.CaseError) as found:
        resolve_machine(case)
    assert {"bearings.shaft", "discs.a b", "bodies.ground"} <= {problem.where for problem in found.value.problems}


def test_markers_in_the_report(model: MachineModel) -> None:
    """Move markers with the shaft and bodies."""
    from lambda_core.analysis.rotor.machine_equilibrium import _at

    case = tables()
    case["markers"] |= {"seat": {"x": "21 mm"}, "floor": {"body": "ground", "x": "0 mm", "z": "-200 mm"}}
    marked = resolve_machine(case)
    state = solve_machine(marked, kernels=KERNELS)
    places = dict(marked.markers)
    assert _at(marked, state, places["seat"]) == pytest.approx(state.displacement[marked.body.rows(0.021)])
    assert _at(marked, state, places["floor"]).tolist() == [0.0] * 6
    foot, arm = places["foot-rb"], np.subtract(places["foot-rb"].point, marked.bodies[0].centre)
    expected = state.bodies[0, :3] + np.cross(state.bodies[0, 3:], arm)
    assert _at(marked, state, foot)[:3] == pytest.approx(expected)
    assert api.MachineEquilibrium.model_fields["markers"].annotation == dict[str, BodyMoved]
