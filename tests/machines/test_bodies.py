"""Test discs, springs and dampers on a shaft."""

from __future__ import annotations

import math
import tomllib
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.rotor.vibration import damped, supported
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.solver.drivers.machine_motion import machine_engine
from lambda_core.solver.drivers.machine_statics import solve_machine

SEAL = {
    "at": "110 mm",
    "y": "10 N/um",
    "z": {"stiffness": "20 N/um", "damping": "500 N s/m"},
    "tilt_y": "1 N m/mrad",
}


def tables(**changes: Any) -> dict[str, Any]:
    """Return the template's tables with changes.

    With a spring.
    """
    return tomllib.loads(shaft_text("geared-shaft", "box")) | {"connections": {"seal": SEAL}} | changes


def test_a_disc_by_its_shape() -> None:
    """Compare a disc with a hollow cylinder.

    m = rho pi/4 (D^2 - d^2) b, J_p = m (D^2 + d^2)/8, J_t = J_p/2 + m b^2/12.
    """
    shape = {"at": "85 mm", "diameter": "120 mm", "width": "25 mm", "bore": "48 mm"}
    model = resolve_machine(tables(discs={"wheel": shape}))
    (disc,) = model.body.discs
    density = model.body.elements[0].material.density
    mass = density * math.pi / 4.0 * (0.12**2 - 0.048**2) * 0.025
    assert disc.mass == pytest.approx(mass, rel=1e-12)
    assert disc.polar_inertia == pytest.approx(mass * (0.12**2 + 0.048**2) / 8.0, rel=1e-12)
    assert disc.transverse_inertia == pytest.approx(0.5 * disc.polar_inertia + mass * 0.025**2 / 12.0, rel=1e-12)


def test_a_spring_takes_its_part() -> None:
    """Compare a spring's force with its deflection.

    Stiffness times deflection there; all forces on the shaft add up to 1e-6.
    """
    model = resolve_machine(tables())
    state = solve_machine(model)
    (spring,) = model.springs
    moved = state.displacement[model.body.rows(spring.place.point[0])][:3]
    held = -np.diag(spring.stiffness)[:3] * moved
    total = state.reactions[:, :3].sum(axis=0) + held + (model.loads + model.weight).reshape(-1, 6)[:, :3].sum(axis=0)
    total[2] -= 9.80665 * sum(one.model.inner_ring.mass for one in model.bearings)
    assert np.abs(total).max() < 1e-6 * 1000.0
    assert abs(held[2]) > 1.0
    without = resolve_machine(tables(connections={"seal": {"at": SEAL["at"]}}))
    added = supported(model, state) - supported(without, state)
    assert np.diag(added)[np.flatnonzero(np.diag(added))] == pytest.approx([10e6, 20e6, 1e3], rel=1e-6)
    assert damped(model, state, np.zeros((2, 6, 6))).sum() == pytest.approx(500.0, rel=1e-12)
    assert api.MachineEquilibrium.model_fields["springs"].description


def test_a_damper_in_motion() -> None:
    """Start a damper from the equilibrium.

    The equilibrium has the spring; the energy that the damper takes is in the balance (1e-3).
    """
    damped_by = {dof: {"stiffness": k, "damping": "5000 N s/m"} for dof, k in (("y", "10 N/um"), ("z", "20 N/um"))}
    changed = tables(connections={"seal": {**SEAL, "at": "85 mm", **damped_by}})
    changed["discs"]["wheel"]["unbalance"] = "500 g mm"
    engine = machine_engine(resolve_machine(changed))
    assert engine.advance(2e-3).ok
    rows = engine.integrals()
    for row in rows:
        losses = sum(value for name, value in row.items() if name.startswith("loss"))
        assert abs(row["input"] - losses - row["stored"]) < 1e-3 * row["input_abs"]


def test_mistakes_with_their_paths() -> None:
    wrong = tables(connections={"seal": {**SEAL, "at": "900 mm"}, "felt": {"at": "10 mm", "z": "soft"}})
    wrong["discs"]["wheel"] |= {"diameter": "50 mm"}
    with pytest.raises(api.CaseError) as found:
        resolve_machine(wrong)
    where = {problem.where for problem in found.value.problems}
    assert {"connections.felt.z", "discs.wheel"} <= where
    with pytest.raises(api.CaseError, match=r"connections\.seal\.at") as found:
        resolve_machine(tables(connections={"seal": {**SEAL, "at": "900 mm"}}))
    law = {"kind": "law", "law": "chip", "amplitude": "10 N"}
    with pytest.raises(api.CaseError, match=r"loads\.push\.force_z\.law"):
        resolve_machine(tables(loads={"push": {"at": "110 mm", "force_z": law}}))
