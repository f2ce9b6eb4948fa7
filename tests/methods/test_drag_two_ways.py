"""Test the catalogues' fluid losses, written twice.

As a comparison method and as a law on each ball.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from lambda_plugins.fluid_drag import Schaeffler, Skf, prepare_schaeffler, skf_torque
from lambda_plugins.immersion import kinematic_speeds
from lambda_plugins.methods.schaeffler import SERIES, idle_torque
from lambda_plugins.methods.skf_drag import drag_torque, drag_torque_2008

from lambda_core.laws.context import Context, Material, Oil
from lambda_core.testing import evaluate

RPM = math.pi / 30.0
STEEL = Material("steel", 210e9, 0.3, 7850.0, 46.0, 460.0)
OIL = Oil("oil", "mineral", 335.65, 0.134, 2000.0)


def _context(series: str = "63") -> Context:
    """Return the 6319 of Syla et al. 2026.

    Its pitch diameter is the mean of bore and outside diameter.
    """
    return Context(
        "fluid_drag", 9, 0.03, 0.1475, 0.095, 0.2, 0.045, series, 157.0, 4e3, STEEL, STEEL, OIL, oil_level=0.0
    )


@pytest.mark.parametrize("rpm", [500.0, 1500.0, 3000.0])
def test_skf(rpm: float) -> None:
    nu, v_m = 36.6e-6, 3e-5
    for edition, method in (
        ("2008", drag_torque_2008(0.095, 0.2, rpm * RPM, v_m)),
        ("2018", drag_torque(0.095, 0.2, rpm * RPM, nu, 0.015, v_m)),
    ):
        square, viscous = skf_torque(Skf(v_m=v_m, edition=edition), _context())
        law = square * rpm**2 + viscous * rpm**0.621 * (nu * 1e6) ** 1.379
        assert law == pytest.approx(sum(method) * 1e3, rel=1e-9)


@pytest.mark.parametrize("series", SERIES)
def test_schaeffler_factors(series: str) -> None:
    share = prepare_schaeffler(Schaeffler(fluid_share=1.0), _context(series))
    reference = prepare_schaeffler(Schaeffler(fluid_share=1.0, f0=1.0), _context(series))
    assert share.force / reference.force == pytest.approx(SERIES[series].f0_bath)
    per_factor = idle_torque(1.0, 0.1475, 1500 * RPM, 36.6e-6)
    assert idle_torque(SERIES[series].f0_bath, 0.1475, 1500 * RPM, 36.6e-6) == pytest.approx(
        per_factor * share.force / reference.force
    )


@pytest.mark.parametrize("level", [-0.004, 0.0, 0.015, 0.3])
@pytest.mark.parametrize("law", ["skf 2008", "skf 2018", "schaeffler"])
def test_all_balls_together_lose_the_catalogues_number(law: str, level: float) -> None:
    """Compare the mean over 48 positions to 1e-4.

    The catalogues' d_m is (d + D)/2; here the pitch circle is 3 mm larger, as in many real bearings.

    Mean over 48 positions of the balls of the power of every ball over the speed, 1e-4 for the mean.
    """
    context = dataclasses.replace(_context(), pitch_diameter=0.1505, oil_level=level)
    nu, rpm, v_m = 36.6e-6, 1500.0, 3e-5
    speed = rpm * RPM
    expected = {
        "skf 2008": sum(drag_torque_2008(0.095, 0.2, speed, v_m)),
        "skf 2018": sum(drag_torque(0.095, 0.2, speed, nu, level + 0.015, v_m)),
        "schaeffler": idle_torque(SERIES["63"].f0_bath, 0.1475, speed, nu),
    }[law]
    name, _, edition = law.partition(" ")
    options = {"v_m": v_m, "edition": edition} if edition else {"fluid_share": 1.0}
    v, omega = kinematic_speeds(context, speed)
    power = 0.0
    for azimuth in (np.arange(48 * 9) + 0.5) * 2.0 * math.pi / (48 * 9):
        force, moment = evaluate(
            f"fluid_drag/{name}-catalogue", options, context,
            v_orbit=v, omega_spin=omega, azimuth=azimuth, nu=nu, rho=860.0,
        )  # fmt: skip
        power += float(force * v + moment * omega) / 48.0
    assert power / speed == pytest.approx(expected, rel=1e-4)
