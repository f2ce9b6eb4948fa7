"""Test the inputs of comparison methods."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from lambda_db.catalogue import SqlCatalogue

from lambda_core.case.case_io import bearing_case
from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import SolverError
from lambda_core.laws.context import Context, Material, Oil
from lambda_core.laws.law import Law, law_of
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.method_inputs import carried_load, method_inputs, permittivity_over_pressure
from lambda_core.model.resolve import resolve
from lambda_core.views.method import ContactLoad, EquilibriumState, MethodInputs, evaluate_methods


def test_carried_load_of_an_axially_loaded_bearing() -> None:
    angle = math.radians(15.0)
    contacts = tuple(ContactLoad(2 * math.pi * i / 9, 500.0, 500.0, angle, angle) for i in range(9))
    radial, axial = carried_load(EquilibriumState(contacts, (0.0,) * 5))
    assert axial == pytest.approx(9 * 500.0 * math.sin(angle))
    assert radial == pytest.approx(0.0, abs=1e-9)


def test_carried_load_of_one_ball() -> None:
    contact = ContactLoad(-math.pi / 2, 1000.0, 1010.0, -0.1, -0.1)
    radial, axial = carried_load(EquilibriumState((contact,), (0.0,) * 5))
    assert radial == pytest.approx(1000.0 * math.cos(0.1))
    assert axial == pytest.approx(1000.0 * math.sin(0.1))


def _oil(resolved: BearingModel) -> Oil:
    """Return the model's oil.

    By its own rheology kernel, in plain Python.
    """
    law = resolved.laws["ball_inner"]["rheology"]
    prepare = law.model.prepare
    assert prepare is not None
    par = prepare(law.parameters, _context(resolved))
    t = resolved.oil.temperature
    ln_eta, rho = np.empty(2), np.empty(2)
    assert law.model.kernel(np.array([0.0, 1e6]), np.array([t, t]), par, ln_eta, rho) == 1
    alpha = float(ln_eta[1] - ln_eta[0]) / 1e6
    return dataclasses.replace(
        resolved.oil, viscosity=math.exp(ln_eta[0]), density=float(rho[0]), alpha_p=alpha, beta=0.04
    )


def _context(resolved: BearingModel) -> Context:
    g = resolved.geometry
    return Context(
        "ball_inner",
        g.ball_count,
        g.ball_diameter,
        g.pitch_diameter,
        g.bore_diameter,
        g.outside_diameter,
        g.width,
        g.series,
        100.0,
        1000.0,
        resolved.ball_material,
        resolved.inner_material,
        resolved.oil,
    )


@pytest.fixture
def resolved(catalogue: SqlCatalogue) -> BearingModel:
    return resolve(bearing_case("6319-cp10-1500"), registry(), catalogue)


def test_inputs_of_the_6319(resolved: BearingModel) -> None:
    inputs = method_inputs(resolved, _oil(resolved))
    assert inputs.series == "63"
    assert inputs.ball_diameter == pytest.approx(0.03)
    assert inputs.radial_load == pytest.approx(16e3)
    assert inputs.axial_load == 0.0
    assert inputs.relative_speed == pytest.approx(1500 * math.pi / 30)
    # FVA3 at 62.5 degC: 36.6 mm2/s by Vogel and its density
    assert inputs.kinematic_viscosity * 1e6 == pytest.approx(36.57, abs=0.05)
    answers = {answer.method.name: answer for answer in evaluate_methods(registry().methods.values(), inputs)}
    skf = answers["skf"].table
    assert skf is not None
    # the SKF row of Syla et al. 2026, table 4, prints 1190 N mm
    assert skf.value("friction", "total") == pytest.approx(1190.0, rel=0.07)
    assert answers["quasi-static"].table is None


def test_loads_are_applied_along_free_axes_and_carried_along_held_ones(resolved: BearingModel) -> None:
    contacts = (ContactLoad(-math.pi / 2, 15e3, 15e3, math.radians(2.0), 0.0),)
    state = EquilibriumState(contacts, (0.0,) * 5)
    inputs: MethodInputs = method_inputs(resolved, _oil(resolved), state=state)
    weight = -resolved.gravity[2] * resolved.inner_ring.mass
    assert inputs.radial_load == pytest.approx(16e3 + weight)
    assert inputs.axial_load == 0.0
    assert inputs.state is state
    ring = resolved.inner_ring
    held = {name: dataclasses.replace(ring.dofs[name], mode="locked") for name in ("x", "z")}
    locked = dataclasses.replace(ring, dofs={**ring.dofs, **held})
    inputs = method_inputs(dataclasses.replace(resolved, inner_ring=locked), _oil(resolved), state=state)
    assert inputs.radial_load == pytest.approx(15e3 * math.cos(math.radians(2.0)))
    assert inputs.axial_load == pytest.approx(15e3 * math.sin(math.radians(2.0)))


def test_the_load_of_catalogue_methods_does_not_change_with_speed() -> None:
    """Compare P from 100 to 15 000 1/min.

    A 6206 under 2000 and 600 N: P of the contact forces alone fell by 1 %.
    """
    from lambda_core import api

    case = ("bearing.designation=6206", "bearing.maker=SKF", "loads.radial=2 kN", "loads.axial=600 N")
    loads = []
    for rpm in (100, 15000):
        found = api.compare("6208-axial-700", (*case, f"operation.speed={rpm} rpm"), methods=["iso-281"])
        loads.append(found.value("iso-281", "life", "equivalent load"))
    assert loads[0] == pytest.approx(loads[1], rel=1e-9)


def test_permittivity_uses_the_chosen_laws() -> None:
    from lambda_plugins.bode import constant

    def thin(p: np.ndarray, T: np.ndarray, par: np.ndarray, ln_eta: np.ndarray, rho: np.ndarray) -> int:
        rho[0] = 870.0
        return 2 if p[0] > 1e9 else 1

    rheology = Law("rheology", "thin", thin, role_api=3, reference="test", errors={2: "beyond the measured pressures"})
    permittivity = law_of(constant)
    assert permittivity is not None
    value = permittivity_over_pressure(permittivity, np.array([2.3]), rheology, np.zeros(1), 313.15)
    assert value(0.5e9) == 2.3
    with pytest.raises(SolverError, match="beyond the measured pressures"):
        value(2e9)


def test_material_of_the_balls_is_handed_on(resolved: BearingModel) -> None:
    ceramic = Material("silicon nitride", 310e9, 0.27, 3200.0, 25.0, 700.0)
    changed = dataclasses.replace(resolved, ball_material=ceramic)
    assert method_inputs(changed, _oil(resolved)).ball == ceramic
