"""Test a shaft from outside.

The program's own beam as a file gives the same answers; files that cannot be a shaft.
"""

from __future__ import annotations

import json
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.rotor.vibration import criticals, modes_at, supported
from lambda_core.formulas.elastic.body import ElasticBody, internal_forces
from lambda_core.formulas.elastic.reduced import FORMAT, read_reduced, write_reduced
from lambda_core.formulas.elastic.whirl import craig_bampton
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.drivers.lumps import lump
from lambda_core.solver.drivers.machine_motion import machine_engine
from lambda_core.solver.drivers.machine_statics import solve_machine


def tables(**changes: Any) -> dict[str, Any]:
    """Return the case that init writes, warm, with an unbalance."""
    found = tomllib.loads(shaft_text("geared-shaft", "box")) | changes
    found["discs"]["wheel"]["unbalance"] = "50 g mm"
    return found


@pytest.fixture(scope="module")
def beam() -> MachineModel:
    """Return the shaft of init as pieces."""
    written = tables()
    return resolve_machine(tables(shaft={**written["shaft"], "temperature": "50 degC"}))


def alone(model: MachineModel) -> ElasticBody:
    """Return the beam without the disc.

    The case has the disc; with its lumps.
    """
    disc = model.body.discs[0]
    rows, mass, gyroscopic = model.body.rows(disc.position), model.body.mass.copy(), model.body.gyroscopic.copy()
    mass[rows, rows] -= np.diag([disc.mass] * 3 + [disc.polar_inertia] + [disc.transverse_inertia] * 2)
    gyroscopic[rows.start + 4, rows.start + 5] -= disc.polar_inertia
    gyroscopic[rows.start + 5, rows.start + 4] += disc.polar_inertia
    lumps = tuple(model.body.node(float(x)) for x in lump(model).positions)
    names = tuple(f"n{i}" for i in range(model.body.positions.size))
    return replace(
        model.body, mass=mass, gyroscopic=gyroscopic, elements=(), discs=(), names=names, lumps=lumps
    )  # fmt: skip


def of_file(model: MachineModel, path: Path) -> MachineModel:
    """Return the case with a shaft file.

    The gear by the name of its node.
    """
    write_reduced(alone(model), path)
    found = tables(shaft={"reduced": path.name, "temperature": "50 degC"})
    found["gears"]["wheel"]["at"] = f"n{model.body.node(0.085)}"
    return resolve_machine(found, folder=path.parent)


def test_the_own_beam_from_a_file_stands_and_swings_as_itself(beam: MachineModel, tmp_path: Path) -> None:
    """Compare a beam of a file to 1e-9.

    Statics, natural frequencies and critical speeds; section forces as far as nodes carry the weight.
    """
    other = of_file(beam, tmp_path / "shaft.npz")
    one, two = solve_machine(beam), solve_machine(other)
    assert two.displacement == pytest.approx(one.displacement, rel=1e-9, abs=1e-9 * np.abs(one.displacement).max())
    assert two.reactions == pytest.approx(one.reactions, rel=1e-9, abs=1e-9 * np.abs(one.reactions).max())
    k_1, k_2 = supported(beam, one), supported(other, two)
    for stiff, soft in zip(modes_at(beam, k_1, 314.0), modes_at(other, k_2, 314.0), strict=True):
        assert soft.frequency == pytest.approx(stiff.frequency, rel=1e-9, abs=1e-3)
    assert [m.frequency for m in criticals(other, k_2)[:6]] == pytest.approx(
        [m.frequency for m in criticals(beam, k_1)[:6]], rel=1e-9
    )
    (places, bent), (nodes, told) = (
        internal_forces(m.body, s.displacement, m.gravity) for m, s in ((beam, one), (other, two))
    )
    right = {float(x): i for i, x in enumerate(nodes)}  # the last of both sides of a node
    at = [right[float(x)] for x in places[::2]]
    assert told[at, 1:3] == pytest.approx(bent[::2, 1:3], abs=1.0)  # N: a node carries its share of the weight
    assert told[at, 3:] == pytest.approx(bent[::2, 3:], abs=0.01)


def test_the_own_beam_from_a_file_runs_as_itself(beam: MachineModel, tmp_path: Path) -> None:
    """Run a beam of a file for a millisecond.

    Lumps, forces and displacements to 1e-9 of the largest.
    """
    other = of_file(beam, tmp_path / "shaft.json")
    for name in ("positions", "mass", "polar_inertia", "transverse_inertia", "stiffness"):
        one, two = getattr(lump(beam), name), getattr(lump(other), name)
        assert two == pytest.approx(one, rel=1e-9, abs=1e-9 * np.abs(one).max()), name
    found = []
    for model in (beam, other):
        engine = machine_engine(model)
        engine.sample_interval = 1e-4
        assert engine.advance(1e-3).ok
        samples = engine.samples()
        found.append(samples.machine)
    for name in ("time", "shaft_position", "shaft_tilt", "reaction_force", "power_loss"):
        assert found[1][name] == pytest.approx(found[0][name], abs=1e-9 * np.abs(found[0][name]).max()), name


def test_a_craig_bampton_reduction_of_the_shaft(beam: MachineModel, tmp_path: Path) -> None:
    """Compare five nodes and twelve modes.

    The equilibrium of the complete beam to 1e-7, its first five frequencies to 1e-3.
    """
    kept = [0.0, 0.021, 0.085, 0.148, 0.17]
    write_reduced(craig_bampton(alone(beam), kept, 12), tmp_path / "shaft.json")
    other = resolve_machine(tables(shaft={"reduced": "shaft.json", "temperature": "50 degC"}), folder=tmp_path)
    one, two = solve_machine(beam), solve_machine(other)
    assert two.reactions == pytest.approx(one.reactions, rel=1e-7, abs=1e-4)
    first = [mode.frequency for mode in modes_at(beam, supported(beam, one), 314.0)[:6]]
    second = [mode.frequency for mode in modes_at(other, supported(other, two), 314.0)[:6]]
    assert second[:5] == pytest.approx(first[:5], rel=1e-3, abs=1e-3)
    shaft = lump(other)
    assert shaft.positions == pytest.approx(kept)
    assert shaft.mass.sum() == pytest.approx(beam.body.total_mass, rel=1e-9)


def test_every_kind_of_file_says_the_same(beam: MachineModel, tmp_path: Path) -> None:
    """Read JSON, npz, HDF5, and TOML with CSV.

    Units are millimetres and tonnes.
    """
    body = craig_bampton(alone(beam), [0.0, 0.085, 0.17], 2)
    data: dict[str, Any] = {"nodes": body.positions, "stiffness": body.stiffness, "mass": body.mass}
    write_reduced(body, tmp_path / "a.json")
    np.savez(tmp_path / "b.npz", names=np.array(["l", "m", "r"]), lumps=np.array([0, 2]), **data)
    with h5py.File(tmp_path / "c.h5", "w") as file:
        for name, values in data.items():
            file[name] = values
        file["names"] = ["l", "m", "r"]
    length = np.ones(20)
    length[:18].reshape(-1, 6)[:, :3] = 1e-3  # metres in a millimetre; energies in N mm
    for name in ("stiffness", "mass"):
        values = 1e3 * data[name] * np.outer(length, length)
        np.savetxt(tmp_path / f"{name}.csv", values, delimiter=",", fmt="%.17g")
    (tmp_path / "d.toml").write_text(
        'units = "mm t N"\nnodes = [[0, 0, 0], [85, 0, 0], [170, 0, 0]]\n'
        'stiffness = "stiffness.csv"\nmass = "mass.csv"\nlumps = ["r"]\nnames = ["l", "m", "r"]\n'
    )
    for name in ("b.npz", "c.h5", "d.toml"):
        read = read_reduced(tmp_path / name)
        assert read.names == ("l", "m", "r")
        for part in ("positions", "stiffness", "mass"):
            values = getattr(body, part)
            assert getattr(read, part) == pytest.approx(values, rel=1e-12, abs=1e-12 * np.abs(values).max())
    assert read_reduced(tmp_path / "b.npz").lumps == (0, 2)
    assert read_reduced(tmp_path / "d.toml").lumps == (2,)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda d: d["stiffness"].__setitem__((1, 1), 2.0 * d["stiffness"][1, 1]), "moving all nodes as one along y"),
        (lambda d: d.__setitem__("mass", d["mass"] + np.diag([1.0] + [0.0] * 19)), "moved along x, y and z it has"),
        (lambda d: d.__setitem__("nodes", np.array([0.0, 85.0, 170.0])), "moving all nodes as one about"),
        (lambda d: d.__setitem__("stiffness", 0.0 * d["stiffness"]), "20 motions have no stiffness"),
        (lambda d: d.__setitem__("nodes", np.array([0.17, 0.085, 0.0])), "must rise along x"),
        (lambda d: d.__setitem__("nodes", np.array([[0.0, 0, 0], [0.085, 0.01, 0], [0.17, 0, 0]])), "off the axis"),
        (lambda d: d.__setitem__("damping", d["mass"]), "a turning shaft with damping"),
        (lambda d: d.__setitem__("units", "inch"), 'must be "m kg N"'),
        (lambda d: d.__setitem__("stifness", d.pop("stiffness")), "stiffness"),
        (lambda d: d.__setitem__("names", ["a", "a", "b"]), "all different"),
    ],
)
def test_files_that_are_no_shaft(change: Any, words: str, beam: MachineModel, tmp_path: Path) -> None:
    body = craig_bampton(alone(beam), [0.0, 0.085, 0.17], 2)
    data: dict[str, Any] = {"nodes": body.positions, "stiffness": body.stiffness.copy(), "mass": body.mass.copy()}
    change(data)
    plain = {key: np.asarray(value).tolist() for key, value in data.items()}
    (tmp_path / "shaft.json").write_text(json.dumps({"format": FORMAT, **plain}))
    with pytest.raises(api.CaseError, match=r"shaft\.reduced") as found:
        resolve_machine(tables(shaft={"reduced": "shaft.json"}), folder=tmp_path)
    assert words in str(found.value)


def test_what_does_not_stand_at_a_node_is_said(beam: MachineModel, tmp_path: Path) -> None:
    write_reduced(craig_bampton(alone(beam), [0.0, 0.085, 0.17], 0), tmp_path / "shaft.json")
    with pytest.raises(api.CaseError, match=r"bearings\.left\.at +there is no node at 21 mm"):
        resolve_machine(tables(shaft={"reduced": "shaft.json"}), folder=tmp_path)
    with pytest.raises(api.CaseError, match=r"shaft\.sections +must have at least one entry"):
        resolve_machine(tables(shaft={"material": "100Cr6"}))
