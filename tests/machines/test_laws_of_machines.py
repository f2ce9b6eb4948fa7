"""Test force laws between bodies and loads over time."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.rotor.vibration import damped, supported
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.machine_templates import shaft_text
from lambda_core.solver.drivers.machine_motion import machine_engine
from lambda_core.solver.drivers.machine_statics import solve_machine

STANDS = dict.fromkeys("xyz", "50 N/um") | dict.fromkeys(("tilt_x", "tilt_y", "tilt_z"), "1 N m/mrad")
BOX = {"x": "85 mm", "mass": "20 kg", "polar_inertia": "0.2 kg m2", "transverse_inertia": "0.2 kg m2"}
SPRINGS = {
    "x": "5 N/um",
    "y": "10 N/um",
    "z": {"stiffness": "20 N/um", "damping": "500 N s/m"},
    "tilt_y": "1 N m/mrad",
    "tilt_z": "1 N m/mrad",
}
PARAMETERS = {
    "stiffness_x": "5 N/um",
    "stiffness_y": "10 N/um",
    "stiffness_z": "20 N/um",
    "damping_z": "500 N s/m",
    "tilt_stiffness": "1 N m/mrad",
}


def machine(**changes: Any) -> MachineModel:
    """Return the machine that init writes with another body, changed."""
    found = api.check(
        tomllib.loads(shaft_text("geared-shaft", "box")) | {"bodies": {"box": {**BOX, "support": STANDS}}} | changes
    )
    assert isinstance(found, MachineModel)
    return found


@pytest.mark.parametrize("to", ["ground", "box"])
def test_a_bushing_by_its_law_is_springs_and_dampers(to: str) -> None:
    """Compare a bushing with springs and dampers.

    Equilibrium to 1e-9, stiffness and damping of modes to 1e-6, force in the report to 1e-6.
    """
    springs = machine(connections={"seal": {"at": "110 mm", "to": to, **SPRINGS}})
    law = machine(connections={"seal": {"at": "110 mm", "to": to, "parameters": PARAMETERS}})
    assert law.links
    assert not law.springs
    one, two = solve_machine(springs), solve_machine(law)
    size = np.abs(one.displacement).max()
    assert two.displacement == pytest.approx(one.displacement, abs=1e-9 * size)
    assert two.bodies == pytest.approx(one.bodies, abs=1e-9 * size)
    k, k_law = supported(springs, one), supported(law, two)
    assert k_law == pytest.approx(k, abs=1e-9 * np.abs(k).max())
    none = np.zeros((2, 6, 6))
    assert damped(law, two, none) == pytest.approx(damped(springs, one, none), abs=1e-6 * 500.0)
    forces = [api.quasistatic(model).springs["seal"] for model in (springs, law)]
    assert forces[1] == pytest.approx(forces[0], rel=1e-6)


def test_a_law_moves_as_springs_do() -> None:
    """Compare motion with springs to 1 %.

    Same equilibrium, same force over time: where the shaft is after 3 ms, of its swing.
    """
    push = {"push": {"at": "110 mm", "force_y": {"kind": "harmonic", "amplitude": "500 N", "frequency": "80 Hz"}}}
    found = []
    for connection in (SPRINGS, {"parameters": PARAMETERS}):
        engine = machine_engine(machine(connections={"seal": {"at": "110 mm", "to": "box", **connection}}, loads=push))
        assert engine.advance(3e-3).ok
        found.append(engine.samples().machine["shaft_position"])
    swing, last = float(np.ptp(found[0][:, :, 1], axis=0).max()), min(map(len, found)) - 1
    assert found[1][last] == pytest.approx(found[0][last], abs=0.01 * swing)


def test_a_load_by_a_law_is_that_over_time() -> None:
    """Compare a chirp at 60 Hz with a harmonic.

    The same force at every time, and motion to 1 % of its swing.
    """
    law = {"kind": "law", "law": "chirp", "amplitude": "500 N", "parameters": {"start": "60 Hz", "end": "60 Hz"}}
    found = []
    for force in ({"kind": "harmonic", "amplitude": "500 N", "frequency": "60 Hz"}, law):
        engine = machine_engine(machine(loads={"belt": {"at": "110 mm", "force_y": force}}))
        assert engine.advance(3e-3).ok
        found.append(engine.samples().machine["shaft_position"])
    swing = float(np.ptp(found[0][:, :, 1], axis=0).max())
    assert swing > 1e-7
    assert found[1][-1] == pytest.approx(found[0][-1], abs=0.01 * swing)


def test_a_radial_load_is_its_components() -> None:
    radial = machine(loads={"belt": {"at": "110 mm", "radial": "1 kN", "radial_direction": "180 deg"}})
    plain = machine(loads={"belt": {"at": "110 mm", "force_y": "-1 kN"}})
    assert np.array_equal(radial.loads, plain.loads)


def test_mistakes_of_laws() -> None:
    for connection, where in (
        ({"at": "110 mm", "law": "bush", "parameters": {}}, "connections.seal.law"),
        ({"at": "110 mm", "parameters": {"stiffness_q": "1 N/m"}}, "connections.seal.parameters.stiffness_q"),
        ({"at": "110 mm", "x": "1 N/um", "parameters": {"stiffness_x": "1 N/m"}}, "connections.seal"),
        ({"at": "foot", "to": "shaft", "parameters": {"stiffness_x": "1 N/m"}}, "connections.seal.at"),
    ):
        with pytest.raises(api.CaseError) as found:
            machine(connections={"seal": connection}, markers={"foot": {"body": "ground", "x": "110 mm"}})
        assert [problem.where for problem in found.value.problems] == [where]


def test_each_bearing_has_laws_and_surfaces_of_its_own() -> None:
    """Give one bearing its own laws and surfaces.

    The other has those of the machine; a message names a wrong value with its place.
    """
    own = {"surface": {"roughness": "0.3 um"}, "materials": {"balls": "Si3N4"}, "models": {"cage_contact": "none"}}
    tables = tomllib.loads(shaft_text("geared-shaft", "box"))
    tables["bearings"]["left"] |= own
    left, right = api.check(tables).bearings
    assert (left.model.roughness, left.model.ball_material.name) == (0.3e-6, "Si3N4")
    assert right.model.roughness != left.model.roughness
    assert right.model.ball_material.name == "100Cr6"
    assert left.model.laws["ball_cage"]["cage_contact"].model.name == "none"
    assert right.model.laws["ball_cage"]["cage_contact"].model.name != "none"
    tables["bearings"]["left"] |= {"materials": {"balls": "glass"}, "depth": {"strips": 11}}
    with pytest.raises(api.CaseError) as found:
        api.check(tables)
    assert "bearings.left.materials.balls" in [problem.where for problem in found.value.problems]
