"""Test loads, markers and connections on rings and cages."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.case.written import merged
from lambda_core.model.machine_model import BearingPart
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.drivers.machine_motion import machine_engine
from lambda_core.solver.drivers.machine_statics import SharedKernels, solve_machine
from lambda_core.solver.drivers.structure import static_rows, structure

KERNELS = SharedKernels()
SEAT = {"y": "80 N/um", "z": "50 N/um"}


def tables(**changes: Any) -> dict[str, Any]:
    """Return the case of init with changes."""
    return merged(tomllib.loads(shaft_text("geared-shaft", "box")), changes)


def on_springs(**changes: Any) -> dict[str, Any]:
    """Return it with a ring on springs.

    The left outer ring, on those of a connection.
    """
    seat = {"bearings": {"left": {"support": {"y": "free", "z": "free"}}}}
    return tables(**merged({**seat, "connections": {"seat": {"at": "left.outer_ring", **SEAT}}}, changes))


def test_springs_at_an_outer_ring_are_those_of_its_support() -> None:
    """Compare a connection with an elastic support.

    Both connect the ring to the ground: the same matrices and the same equilibrium.
    """
    by_connection = resolve_machine(on_springs())
    by_support = resolve_machine(tables(bearings={"left": {"support": SEAT}}))
    rows = static_rows(by_support)
    np.testing.assert_array_equal(structure(by_connection, rows)[0], structure(by_support, rows)[0])
    one, other = (solve_machine(model, kernels=KERNELS) for model in (by_connection, by_support))
    np.testing.assert_allclose(one.motions, other.motions, rtol=1e-9, atol=1e-15)


def test_a_load_on_an_outer_ring_is_carried_by_its_springs() -> None:
    """Carry a ring's load by its springs.

    The ring moves by F/k more; the bearing carries as much as before, as nothing else changes.
    """
    loaded = on_springs(loads={"pull": {"at": "left.outer_ring", "force_z": "-500 N"}})
    models = [resolve_machine(on_springs()), resolve_machine(loaded)]
    free, pulled = (solve_machine(model, kernels=KERNELS) for model in models)
    total = np.sum(pulled.reactions[:, 2]) - np.sum(free.reactions[:, 2])
    assert total == pytest.approx(0.0, abs=1e-3)  # on the shaft act the same loads
    left = models[1].index(BearingPart("left", "outer_ring"))
    spring = 50e6 * (pulled.outer[left, 2] - free.outer[left, 2])
    assert spring == pytest.approx(-500.0 - (pulled.reactions[left, 2] - free.reactions[left, 2]), abs=1e-3)


def test_a_marker_on_a_ring_moves_with_it_and_one_on_a_cage_only_in_motion() -> None:
    markers = {
        "rim": {"body": "left.outer_ring", "x": "21 mm", "z": "40 mm"},
        "bar": {"body": "left.cage", "x": "21 mm"},
    }
    model = resolve_machine(on_springs(markers=markers))
    found = api.quasistatic(model)
    assert "bar" not in found.markers
    state = solve_machine(model, kernels=KERNELS)
    left = model.index(BearingPart("left", "outer_ring"))
    assert found.markers["rim"].displacement_um[1:] == pytest.approx(
        [1e6 * (state.outer[left, 1]), 1e6 * state.outer[left, 2]], abs=1e-6
    )
    engine = machine_engine(model)
    engine.advance(2e-4, None)
    names = list(dict(model.markers))
    positions = engine.samples().machine["marker_position"][-1]
    assert np.isfinite(positions).all()
    assert positions[names.index("rim"), 2] == pytest.approx(state.outer[left, 2], abs=2e-6)


@pytest.mark.parametrize(
    ("changes", "where", "words"),
    [
        ({"loads": {"pull": {"at": "left.outer_rng", "force_z": "1 N"}}}, "loads.pull.at", "left.outer_ring"),
        ({"loads": {"pull": {"at": "left.outer_ring", "force_z": "1 N"}}}, "bearings.left.support.z", "does nothing"),
        (
            {"loads": {"p": {"at": "left.cage", "force_z": "1 N"}}, "bearings": {"left": {"cage": {"z": "locked"}}}},
            "bearings.left.cage.z", "does nothing",
        ),
        ({"loads": {"p": {"at": "left.cage", "force_z": "1 N"}}, "depth": {"cage": False}}, "loads.p.at", "no cage"),
        ({"markers": {"m": {"body": "left.cage", "x": "0 mm"}}, "depth": {"cage": False}}, "markers.m.body", "no cage"),
        ({"connections": {"c": {"at": "left.cage", "z": "1 N/um"}}}, "connections.c", "give a law by `parameters`"),
        ({"connections": {"c": {"at": "left.outer_ring", "tilt_x": "1 N m/mrad"}}}, "connections.c.tilt_x", "rotation"),
        (
            {"connections": {"c": {"at": "left.outer_ring", "to": "left.outer_ring", "z": "1 N/um"}}},
            "connections.c.to", "same body",
        ),
        ({"bearings": {"left": {"outer": "right.cage"}}}, "bearings.left.outer", "ground or in one of"),
        ({"markers": {"left.cage": {"x": "1 mm"}}}, "markers.left.cage", "use letters, digits, dash"),
        (
            {"bearings": {"left.cage": {"designation": "SKF 6208", "at": "85 mm"}}},
            "bearings.left.cage", "use letters, digits, dash",
        ),
        ({"discs": {"d": {"at": "left.cage", "mass": "1 kg"}}}, "discs.d.at", "marker or bearing"),
    ],
)  # fmt: skip
def test_mistakes_name_the_part(changes: dict[str, Any], where: str, words: str) -> None:
    with pytest.raises(api.CaseError) as error:
        resolve_machine(tables(**changes))
    assert [(problem.where, words in problem.message) for problem in error.value.problems] == [(where, True)]


def test_a_cage_is_dragged_in_motion_and_the_result_says_so(tmp_path: Path) -> None:
    load = {"pull": {"at": "left.cage", "force_y": "3 N"}}
    band = {"band": {"at": "left.cage", "to": "left.outer_ring", "parameters": {"stiffness_z": "1 N/mm"}}}
    changes = tables(loads=load, connections=band, solver={"duration": "3 ms"})
    result = api.run(changes, out=tmp_path / "dragged.h5")
    free = api.run(tables(solver={"duration": "3 ms"}), out=tmp_path / "free.h5")
    pulled, left = (float(one.bearings["left"]["body_position"][-1, 2, 1]) for one in (result, free))
    assert pulled > left + 1e-5
    assert abs(result.summary().energy_residual) < 1e-3
    assert any("loads on the cage act in motion" in sentence for sentence in result.summary().assumptions)
