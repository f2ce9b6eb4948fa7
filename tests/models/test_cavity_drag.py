"""Test drag in a mixture of oil and air.

Share of oil, limits of pure oil and of air, catalogue's jet.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from lambda_plugins.cavity_drag import cavity_share
from lambda_plugins.immersion import kinematic_speeds

from lambda_core.discovery.manager import registry
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.laws.par import make_par
from lambda_core.laws.probe import trial_context
from lambda_core.testing import evaluate

CONTEXT = dataclasses.replace(trial_context("fluid_drag"), lubrication="oil jet", oil_flow=1e-5)
NU, RHO = 20e-6, 850.0
GIVEN: dict[str, Any] = {"azimuth": 0.3, "nu": NU, "rho": RHO}


def mixture(v: float = 20.0, omega: float = 3000.0, **parameters: Any) -> Any:
    return evaluate("fluid_drag/cavity-mixture", parameters, CONTEXT, v_orbit=v, omega_spin=omega, **GIVEN)


def test_share_of_oil_by_parkers_correlation() -> None:
    """Compare the share with Parker's 2.4 %.

    6 l/min through a bearing of 155 mm at 20 000 1/min: 10^5 6000^0.37/(20 000 155^1.7).
    """
    share = 1e5 * 6000.0**0.37 / (20000.0 * 155.0**1.7)
    assert cavity_share(1e-4, 20000.0, 0.155) == pytest.approx(share, rel=1e-12)
    assert 0.023 < share < 0.025


def test_the_share_follows_flow_and_speed() -> None:
    per_rpm, _ = kinematic_speeds(CONTEXT, math.pi / 30.0)
    for rpm in (10000.0, 20000.0):
        share = cavity_share(1e-5, rpm, CONTEXT.pitch_diameter)
        assert mixture(per_rpm * rpm) == pytest.approx(mixture(per_rpm * rpm, oil_share=share), rel=1e-9)
    # slow bearings are full of oil, no fuller
    assert mixture(per_rpm) == pytest.approx(mixture(per_rpm, oil_share=1.0), rel=1e-12)


def test_a_cavity_full_of_oil_is_a_flooded_bearing() -> None:
    flooded = dataclasses.replace(CONTEXT, lubrication="oil bath", oil_level=math.nan)
    sphere = evaluate("fluid_drag/sphere-drag", None, flooded, v_orbit=20.0, omega_spin=3000.0, **GIVEN)
    assert mixture(oil_share=1.0) == pytest.approx(sphere, rel=1e-12)


def test_air_alone_drags_by_its_density() -> None:
    """Compare C_D with 0.41 to 0.49.

    At Re of 10^4 to 10^5 (Clift, Grace and Weber 1978, table 5.1), of a sphere.
    """
    force, _ = mixture(60.0, oil_share=1e-9)
    area = 0.25 * math.pi * CONTEXT.ball_diameter**2
    assert 0.41 < force / (0.5 * 1.2 * 60.0**2 * area) < 0.49


def test_the_place_of_a_ball_does_not_matter() -> None:
    found = [
        evaluate("fluid_drag/cavity-mixture", None, CONTEXT, **{**GIVEN, "azimuth": each}, v_orbit=20.0, omega_spin=9.0)
        for each in np.linspace(-3.0, 3.0, 7)
    ]
    assert np.ptp(found, axis=0).max() == 0.0


def test_skfs_jet_is_twice_its_usual_bath_on_all_balls_alike() -> None:
    v, omega = kinematic_speeds(CONTEXT, 300.0)

    def power(lubrication: str) -> float:
        context = dataclasses.replace(CONTEXT, lubrication=lubrication, oil_level=0.0)
        total = 0.0
        for azimuth in np.linspace(-np.pi, np.pi, 9 * 48, endpoint=False):
            given = {**GIVEN, "azimuth": float(azimuth)}
            force, moment = evaluate("fluid_drag/skf-catalogue", None, context, v_orbit=v, omega_spin=omega, **given)
            total += float(force * v + moment * omega)
        return total

    assert power("oil jet") == pytest.approx(2.0 * power("oil bath"), rel=1e-3)


def test_without_a_flow_the_share_is_asked_for() -> None:
    law = registry().model("fluid_drag", "cavity-mixture")
    with pytest.raises(PluginError, match=r"thermal\.oil_flow"):
        make_par(law, law.parameters(), dataclasses.replace(CONTEXT, oil_flow=0.0))
