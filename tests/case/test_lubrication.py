"""Test lubrication of the balls.

What a case may say, the law of drag that it chooses, and what that takes away.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError, LambdaError
from lambda_core.model.bearing_model import BearingModel
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.equilibrium import solve

# A bearing of NASA's tests of 120 mm bearings: 15 balls of 20.64 mm.
FAST: dict[str, Any] = {
    "name": "fast",
    "bearing": {
        "contact_angle": "24 deg",
        "geometry": {
            "ball_count": 15, "ball_diameter": "20.6375 mm", "pitch_diameter": "155 mm", "conformity_inner": 0.54,
            "conformity_outer": 0.52, "bore_diameter": "120 mm", "outside_diameter": "190 mm", "width": "35 mm",
            "series": "70",
        },
    },
    "lubricant": {"name": "FVA3", "temperature": "100 degC"},
    "loads": {"axial": "22.24 kN"},
    "operation": {"speed": "25000 rpm"},
    "bodies": {"cage": {"type": "brass-machined"}},
    "gravity": {"z": "0 m/s2"},
}  # fmt: skip


def drag_law(model: BearingModel) -> str:
    return model.laws["fluid_drag"]["fluid_drag"].model.name


def with_lubrication(kind: str, *changes: str) -> BearingModel:
    return api.check(FAST, [f"lubricant.lubrication={kind}", *changes])


def test_the_lubrication_chooses_the_law_of_drag() -> None:
    assert drag_law(api.check(FAST)) == "skf-catalogue"
    assert drag_law(with_lubrication("oil bath")) == "skf-catalogue"
    for kind in ("oil jet", "under-race", "oil-air"):
        assert drag_law(with_lubrication(kind, "thermal.oil_flow=6 l/min")) == "cavity-mixture"
    assert drag_law(with_lubrication("oil jet", "models.fluid_drag=skf-catalogue")) == "skf-catalogue"


def test_the_flow_of_oil_or_its_share_is_needed() -> None:
    with pytest.raises(LambdaError, match=r"thermal\.oil_flow.*parameters\.fluid_drag\.oil_share"):
        with_lubrication("oil jet")
    assert with_lubrication("oil jet", "parameters.fluid_drag.oil_share=0.02")


def test_a_missing_flow_of_oil_is_asked_for_with_the_lubrication_that_needs_it_and_an_example() -> None:
    with pytest.raises(LambdaError, match='is required with lubrication oil jet, such as "1 l/min"'):
        with_lubrication("oil jet")
    with pytest.raises(LambdaError, match="is required with fluid_drag cavity-mixture, such as"):
        api.check(FAST, ["models.fluid_drag=cavity-mixture"])


def test_what_contradicts_the_lubrication_is_an_error() -> None:
    with pytest.raises(LambdaError, match='"oil jet" has no bath: leave the line out'):
        with_lubrication("oil jet", "thermal.oil_flow=6 l/min", "lubricant.oil_level=0 mm")
    with pytest.raises(LambdaError, match="is an oil, not a grease"):
        with_lubrication("grease")
    with pytest.raises(LambdaError, match="oil bath"):
        with_lubrication("jet", "thermal.oil_flow=6 l/min")
    with pytest.raises(LambdaError, match="needs an oil bath"):
        solve(with_lubrication("oil jet", "models.fluid_drag=sphere-drag"))


def power_of_drag(model: BearingModel) -> float:
    """Return the balls' oil loss [W].

    In the quasi-static equilibrium, tangential force alone.
    """
    found = solve(model)
    context, balls = found.context, found.state[: L.NB * 15].reshape(15, L.NB)
    law = model.laws["fluid_drag"]["fluid_drag"].model
    from lambda_core.laws.par import flat_kernel

    oil, par = context.bundle.rows[0]["oil"], context.bundle.par
    begin, end = context.bundle.rows[0]["drag"]
    out, total = np.zeros(2), 0.0
    for ball in balls:
        spin = float(np.linalg.norm(ball[L.BWX : L.BWX + 3]))
        nu, rho = float(oil["viscosity"] / oil["density"]), float(oil["density"])
        mean = 0.0
        for azimuth in np.linspace(-np.pi, np.pi, 36, endpoint=False):
            assert flat_kernel(law)(float(ball[L.BVT]), spin, float(azimuth), nu, rho, par[begin:end], out) == 1
            mean += float(out[0]) / 36.0
        total += mean * float(ball[L.BVT])
    return total


def test_a_jet_drags_less_than_a_bath_and_the_cage_keeps_its_speed() -> None:
    """Compare with bearings that lost at most 6 %.

    NASA TN D-7870 measured the cages of bearings of this kind under jets.
    """
    jet = with_lubrication("oil jet", "thermal.oil_flow=6 l/min")
    assert power_of_drag(jet) < 0.5 * power_of_drag(api.check(FAST))
    free, slowed = (solve(model).orbit for model in (api.check(FAST, ["models.fluid_drag=none"]), jet))
    assert 0.94 < slowed / free <= 1.0


def test_an_oil_has_its_viscosities_once() -> None:
    """Take parameters that a law requires from properties.

    They have the same name; what the case gives a law comes before them.
    """
    properties = {
        "rheology": "roelands", "thermal_conductivity": "0.14 W/(m K)", "specific_heat": "1900 J/(kg K)",
        "kinematic_viscosity_40": "68 mm2/s", "kinematic_viscosity_100": "8.7 mm2/s", "density_15": "880 kg/m3",
    }  # fmt: skip
    case = {
        "name": "own", "bearing": {"designation": "SKF 6208"}, "loads": {"radial": "1 kN"},
        "operation": {"speed": "1500 rpm"},
        "lubricant": {"name": "mine", "temperature": "60 degC", "properties": properties},
        "parameters": {"rheology": {"alpha_p": "20 1/GPa", "density_slope": -0.65}},
    }  # fmt: skip
    law = api.check(case, is_static=True).laws["ball_inner"]["rheology"]
    assert law.parameters.kinematic_viscosity_40 == 68e-6
    assert law.parameters.density_15 == 880.0
    assert law.origins["kinematic_viscosity_40"] == "case"
    law = api.check(case, ["parameters.rheology.density_15=870 kg/m3"], is_static=True).laws["ball_inner"]["rheology"]
    assert law.parameters.density_15 == 870.0
    del properties["density_15"]
    with pytest.raises(CaseError, match=r"parameters\.rheology\.density_15.*needs it, and the lubricant mine has no"):
        api.check(case, is_static=True)
