"""Test assemblies of several bearings.

Every entry of the tables at its final place.
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import SolverError
from lambda_core.solver.arrays.fault_roles import ROLES
from lambda_core.solver.drivers.assembly import AssembledBearing, Assembly, assembly_of
from lambda_core.solver.drivers.compiled_laws import Kernels, derive_oils
from lambda_core.solver.drivers.equilibrium import fault_sentence
from lambda_core.solver.drivers.first_state import first_frame
from lambda_core.solver.drivers.solver_context import context_of
from lambda_core.solver.drivers.tables import Tables, build

CASES = ("6208-axial-700", "6319-cp10-500")


@pytest.fixture(scope="module")
def alone() -> list[Assembly]:
    """Return two bearings, each for itself."""
    found = []
    for name in CASES:
        model = api.check(name)
        kernels, frame = Kernels(model), first_frame(model)
        found.append(assembly_of(model, kernels, frame, derive_oils(model, kernels, frame)))
    return found


def together(alone: list[Assembly]) -> Assembly:
    """Return both as one assembly.

    The bodies of one are behind those of the other.
    """
    bearings = [
        replace(one.bearings[0], name=f"number {i}", members=(3 * i, 3 * i + 1, 3 * i + 2))
        for i, one in enumerate(alone)
    ]
    members = (*alone[0].members, *alone[1].members)
    return Assembly(members, tuple(bearings), alone[0].gravity)


def parameters(tables: Tables, table: str, field: str) -> list[np.ndarray]:
    """Return what the laws of each entry read."""
    return [tables.par[begin:end] for begin, end in getattr(tables, table)[field]]


def test_each_bearing_has_the_entries_that_it_has_alone(alone: list[Assembly]) -> None:
    """Compare entries with those of one bearing.

    Numbers of balls, raceways, rows and bodies go on behind those of the first; parameters have the same bits.
    """
    ones, both = [build(one) for one in alone], build(together(alone))
    first, second = ones
    balls = int(first.system[0]["balls"])
    assert both.system[0]["balls"] == sum(int(one.system[0]["balls"]) for one in ones)
    assert both.raceways["number"].tolist() == list(range(first.raceways.size + second.raceways.size))
    assert both.raceways["body"].tolist() == [*first.raceways["body"], *(second.raceways["body"] + 3)]
    assert both.rows["first_ball"].tolist() == [0, balls]
    assert both.rows["bearing"].tolist() == both.bodies["bearing"][::3].tolist() == [0, 1]
    assert both.lands["ring"].tolist() == [*first.lands["ring"], *(second.lands["ring"] + 3)]
    assert both.laws.guides.tolist() == [*first.laws.guides.tolist(), *second.laws.guides.tolist()]
    for field in ("pocket", "drag"):
        for got, (own,) in zip(
            parameters(both, "rows", field), (parameters(one, "rows", field) for one in ones), strict=True
        ):
            assert got.tobytes() == own.tobytes()
    for role in both.raceways["parameters"].dtype.names:
        spans = both.raceways["parameters"][role]
        expected = [one.par[b:e] for one in ones for b, e in one.raceways["parameters"][role]]
        assert [both.par[b:e].tobytes() for b, e in spans] == [own.tobytes() for own in expected]


def test_other_cells_in_another_bearing_are_refused(alone: list[Assembly]) -> None:
    """Name bearings that divide their contacts otherwise.

    Compiled code has one grid of cells.
    """
    both = together(alone)
    other: AssembledBearing = both.bearings[1]
    depth = replace(other.model.depth, strips=other.model.depth.strips + 2)
    changed = replace(both, bearings=(both.bearings[0], replace(other, model=replace(other.model, depth=depth))))
    with pytest.raises(SolverError, match=r"number 0 divides .* number 1 .* same depth\.strips"):
        build(changed)


FAULTS = {  # role, ball and place as compiled code leaves them -> the message
    "inner land": ("cage_contact", 3, 2, r"^number 1: cage_contact/.* \(cage - inner, t = "),
    "outer land": ("cage_contact", 3, 1, r"^number 0: cage_contact/.* \(cage - outer, t = "),
    "pocket": ("cage_contact", 10, -1, r"^number 1: cage_contact/.* \(ball 2, ball - cage, t = "),
    "drag": ("fluid_drag", 8, -1, r"^number 0: fluid_drag/.* \(ball 9, fluid - drag, t = "),
    "raceway": ("traction", 9, 3, r"^number 1: traction/.* \(ball 1, ball - outer, t = "),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_law_that_refuses_is_named_with_its_bearing(alone: list[Assembly], name: str) -> None:
    """Name the bearing of a land, not a ball.

    The last ball in work does not count.
    """
    role, ball, place, expected = FAULTS[name]
    context = context_of(together(alone))
    fault = context.bundle.scratch[0].fault
    fault.role, fault.status, fault.ball, fault.place = ROLES.index(role), 1, ball, place
    assert re.search(expected, fault_sentence(context, 0.0)), fault_sentence(context, 0.0)
