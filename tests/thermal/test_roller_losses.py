"""Test heat of rollers against their operating point."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.static_point import static_point
from lambda_core.analysis.thermal.conductances import effusivity, resting_line, rolling_line
from lambda_core.analysis.thermal.losses import Losses
from lambda_core.analysis.thermal.pillow_block import bearing_network
from lambda_core.domain.channels import LOSSES
from lambda_core.domain.errors import CaseError
from lambda_core.model.laws.time_functions import initial
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.solver.records import CONTACT_CHANNELS


def case(designation: str, radial: str = "5 kN", axial: str = "0 N", **bearing: Any) -> dict[str, Any]:
    return {
        "name": "warm",
        "bearing": {"designation": designation, **bearing},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "loads": {"radial": radial, "axial": axial},
        "operation": {"speed": "3000 rpm"},
    }


@pytest.mark.parametrize(
    ("designation", "radial", "axial"),
    [("SKF NU 208 ECP", "0 N", "0 N"), ("SKF NJ 208", "5 kN", "1 kN"), ("SKF 32208", "3 kN", "2 kN")],
)
def test_the_torque_is_that_of_the_operating_point_at_these_temperatures(
    designation: str, radial: str, axial: str
) -> None:
    """Compare both pages.

    Without a radial load one had 7.7 N mm, of rollers that stand, the other 44, of rollers that roll.
    """
    source = case(designation, radial, axial)
    (warm,) = api.thermal(source).bearings.values()
    there = api.quasistatic(source, ["operation.temperatures=computed"], band=False)
    assert warm.state.friction_torque_Nmm == pytest.approx(there.friction_torque_Nmm, rel=1e-4)
    assert sum(warm.losses_W.values()) == pytest.approx(there.power_loss_W, rel=1e-4)
    assert warm.state.max_pressure_GPa == pytest.approx(there.max_pressure_GPa, rel=1e-4)


def test_losses_are_those_of_the_laws_in_motion() -> None:
    """Compare with the equilibrium that a run starts from."""
    model = api.check(case("SKF NU 208 ECP"), is_static=True)
    found = solve(model)
    point = Losses(model).at(model.oil.temperature, model.geometry.clearance)
    assert point.power == pytest.approx(float(found.losses.sum()), rel=0.03)
    for name in ("rolling_inner", "rolling_outer", "hysteresis_inner", "hysteresis_outer"):
        assert point.losses[name] == pytest.approx(float(found.losses[LOSSES.index(name)]), rel=0.05), name
    assert point["orbit"] == pytest.approx(found.orbit, rel=0.01)


def test_conductances_are_those_of_contacts_in_motion() -> None:
    """Compare rollers that carry along their length with one width."""
    model = api.check(case("SKF NU 208 ECP", rollers={"profile": "none"}), is_static=True)
    found = solve(model)
    point = Losses(model).at(model.oil.temperature, model.geometry.clearance)
    for ring, name in enumerate(("inner", "outer")):
        assert point[f"contact_{name}"] == pytest.approx(_conductance(found, ring), rel=0.003)


def _conductance(found: Any, ring: int) -> float:
    """Return the conductance of full lines at a ring [W/K]."""
    model, oil, total = found.context.model, found.context.oil, 0.0
    own = (model.inner_material, model.outer_material)[ring]
    mean = 2.0 / (1.0 / model.ball_material.thermal_conductivity + 1.0 / own.thermal_conductivity)
    for contact in found.contacts[:, ring]:
        one = dict(zip(CONTACT_CHANNELS, contact.tolist(), strict=True))
        if one["load"] > 0.0:
            length, half, film = 2.0 * one["semi_axis_a"], one["semi_axis_b"], one["film_central"]
            through = oil.thermal_conductivity / film, effusivity(model.ball_material), effusivity(own)
            rolling = rolling_line(length, half, abs(one["entrainment"]), *through)
            total += max(rolling, resting_line(length, half, mean))
    return total


def test_friction_of_ribs_heats_the_rings_that_have_them() -> None:
    """Give all of a cone's rib to the inner ring.

    All mechanisms together are the power of the operating point.
    """
    model = api.check(case("SKF 32208", "3 kN", "2 kN"), is_static=True)
    point, still = Losses(model).at(model.oil.temperature, 0.0), static_point(model).answer
    parts, speed = still.friction_breakdown_Nmm, initial(model.inner_ring.dofs["spin"].motion)
    expected = 1e-3 * speed * (parts["sliding_inner"] + parts["rib"])
    assert parts["rib"] > 2.0 * parts["sliding_inner"]
    assert point.losses["sliding_inner"] == pytest.approx(expected, rel=1e-4)
    assert point.losses["sliding_outer"] == pytest.approx(1e-3 * speed * parts["sliding_outer"], rel=1e-4)
    assert point.power == pytest.approx(still.power_loss_W, rel=1e-4)


def test_a_tight_bearing_of_rollers_has_temperatures_without_a_search_for_motion(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Find them at 90 um of interference.

    The equilibrium with friction of such rollers took minutes, and no other part of the answer needs it.
    """

    def searched(*given: object, **more: object) -> None:
        raise AssertionError("rollers roll at an operating point")

    monkeypatch.setattr("lambda_core.analysis.thermal.losses.solve", searched)
    found = api.thermal(case("SKF NU 208 ECP", clearance="-90 um"))
    (bearing,) = found.bearings.values()
    assert abs(found.energy_residual) < 1e-9
    assert bearing.state.clearance_um == pytest.approx(-90.0, abs=0.5)
    assert np.isfinite(bearing.state.friction_torque_Nmm)


@pytest.mark.parametrize("seat", ["60 um", "k5"])
def test_seats_take_clearance_of_rollers_at_an_operating_point(seat: str) -> None:
    """Compare with the clearance that a run has.

    Fits and temperatures of a bearing alone counted in motion only: the page had the clearance as bought.
    """
    source = case("SKF NU 208 ECP", fits={"shaft": seat, "housing": "H7"}, temperatures={"inner_ring": "75 degC"})
    mounted = api.check(source, is_static=True).geometry.clearance
    found, free = api.quasistatic(source, band=False), api.quasistatic(case("SKF NU 208 ECP"), band=False)
    given = api.quasistatic(case("SKF NU 208 ECP", clearance=f"{mounted!r} m"), band=False)
    assert found.max_load_N == pytest.approx(given.max_load_N, rel=1e-9)
    assert found.max_load_N < 0.98 * free.max_load_N  # more rollers carry
    assert any(one.startswith("clearance in operation") for one in found.assumptions)


def test_the_sentence_of_temperatures_names_rollers() -> None:
    found = api.quasistatic(case("SKF NU 208 ECP"), ["operation.temperatures=computed"], band=False)
    (sentence,) = (one for one in found.assumptions if one.startswith("temperatures found"))
    assert ", rollers " in sentence
    assert "balls" not in sentence


@pytest.mark.parametrize("designation", ["SKF NCF 3008", "SKF NU 208 ECP"])
def test_only_a_cage_that_is_there_stores_heat(designation: str) -> None:
    """Compare a full complement with a caged bearing.

    An absent cage of 7.9 g took part in the warm-up.
    """
    source = case(designation)
    model = api.check({**source, "operation": {"speed": "3000 rpm", "temperatures": "computed"}}, is_static=True)
    assert model.thermal is not None
    network, point = bearing_network(model, model.thermal), Losses(model).at(model.oil.temperature, 30e-6)
    is_caged = not model.full_complement
    assert is_caged == ("NU" in designation)
    assert ("cage" in network.names) == is_caged
    assert ("cage" in network.bearings[0].capacities(point["density"])) == is_caged
    assert (("cage", "oil") in network.bearings[0].inside(point)) == is_caged


@pytest.mark.parametrize("as_machine", [False, True])
def test_nobody_heats_the_cage_of_a_full_complement(*, as_machine: bool) -> None:
    """Refuse heat in a node that is not there."""
    heated = {"nodes": {"cage": {"heat": "5 W"}}}
    source: dict[str, Any] = {**case("SKF NCF 3008"), "thermal": heated}
    if as_machine:
        bearing = {**source.pop("bearing"), "thermal": source.pop("thermal")}
        source = {**source, "bearings": {"only": bearing}}
        source["loads"] = {"pull": {"on": "shaft", "at": "0 mm", "force_z": "-5 kN"}}
    with pytest.raises(CaseError, match=r"thermal\.nodes\.cage .*full complement have no cage"):
        api.check(source)
