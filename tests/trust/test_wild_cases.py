"""Test cases that validation lets through and no bearing is.

Refused in a sentence that names the option.
"""

from __future__ import annotations

import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError

CASE = "6208-axial-1300"


@pytest.mark.parametrize(
    ("settings", "where"),
    [
        (["bearing.clearance=1e9 mm"], "bearing.clearance"),
        (["bearing.clearance=-1e9 mm"], "bearing.clearance"),
        (["bearing.geometry.shoulder_diameter_inner=1 nm"], "bearing.geometry.shoulder_diameter_inner"),
        (["bearing.geometry.shoulder_diameter_inner=93 m"], "bearing.geometry.shoulder_diameter_inner"),
        (["bearing.geometry.shoulder_diameter_outer=0.2 um"], "bearing.geometry.shoulder_diameter_outer"),
        (["bearing.geometry.groove_radius_outer=0.8 mm"], "bearing.geometry.groove_radius_outer"),
        (["bearing.geometry.ball_diameter=1e9 mm", "bearing.fits.shaft=k5"], "bearing.geometry.ball_diameter"),
        (["bearing.geometry.outside_diameter=1e300 m"], "bearing.geometry.outside_diameter"),
        (["bearing.geometry.width=1 mm"], "bearing.geometry.width"),
        (["bearing.temperatures.balls=7e12 K"], "bearing.clearance"),
        (["bearing.fits.shaft=1e300 mm"], "bearing.clearance"),
        (["bodies.cage.radial_thickness=1e300 m"], "bodies.cage.radial_thickness"),
        (["bodies.cage.width=1e200 m"], "bodies.cage.width"),
        (["bodies.inner_ring.mass=1e300 kg"], "bodies.inner_ring.mass"),
        (["bodies.inner_ring.shaft_mass=1e300 kg"], "bodies.inner_ring.shaft_mass"),
    ],
)
def test_c4_wild_geometry_is_refused_by_its_option(settings: list[str], where: str) -> None:
    with pytest.raises(CaseError) as caught:
        api.check(CASE, settings)
    assert where in [problem.where for problem in caught.value.problems]


@pytest.mark.parametrize(
    ("settings", "where"),
    [
        (["operation.speed=7e14 rpm"], "operation.speed"),
        (["bodies.cage.spin.mode=prescribed", "bodies.cage.spin.motion=7e14 rpm"], "bodies.cage.spin.motion"),
    ],
)
def test_a_spin_that_bursts_steel_is_refused(settings: list[str], where: str) -> None:
    """Refuse a spin that bursts steel.

    Records of 1e9 turns in a fifth of a millisecond had filled the memory.
    """
    with pytest.raises(CaseError, match="too fast") as caught:
        api.check(CASE, settings)
    assert where in [problem.where for problem in caught.value.problems]
    assert api.check(CASE, ["operation.speed=100000 rpm"])


@pytest.mark.parametrize("temperature", ["1e6 degC", "1 K"])
def test_c4_an_oil_that_is_no_liquid_is_refused(temperature: str) -> None:
    with pytest.raises(CaseError, match="no oil is liquid there"):
        api.check(CASE, [f"lubricant.temperature={temperature}"])


@pytest.mark.parametrize("value", ["inf", "nan"])
def test_a_parameter_without_end_is_refused(value: str) -> None:
    """Refuse an infinite parameter.

    It had ended as a bug where the case was written into the result.
    """
    with pytest.raises(CaseError, match="not a finite number"):
        api.check(CASE, [f"parameters.rolling_resistance.thermal_coefficient={value}"])
