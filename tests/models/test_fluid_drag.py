"""Test drag on the balls.

Immersion, the catalogue's power recovered ball by ball, signs and limits.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from lambda_plugins.immersion import OilBath, immersion, kinematic_speeds
from lambda_plugins.methods.skf_chart import drag_loss_factor

from lambda_core.discovery.manager import registry
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.laws.context import Context
from lambda_core.laws.par import make_par
from lambda_core.laws.probe import trial_context
from lambda_core.testing import assert_symmetric, evaluate

CONTEXT = dataclasses.replace(trial_context("fluid_drag"), oil_level=0.0)
NU, RHO = 40e-6, 860.0
LAWS = ["skf-catalogue", "schaeffler-catalogue", "sphere-drag"]  # of a bath


def losses(name: str, context: Context, speed: float, turn: float = 0.0, **parameters: Any) -> Any:
    """Return force and moment on each ball.

    At kinematic speeds, shape (balls, 2).
    """
    v, omega = kinematic_speeds(context, speed)
    azimuths = turn + np.arange(context.ball_count) * 2.0 * math.pi / context.ball_count
    given: dict[str, Any] = {"v_orbit": v, "omega_spin": omega, "nu": NU, "rho": RHO}
    label = f"fluid_drag/{name}"
    return np.array([evaluate(label, parameters or None, context, azimuth=each, **given) for each in azimuths])


def torque(name: str, context: Context, speed: float, **parameters: Any) -> float:
    """Return the bearing's loss over speed [N m].

    Averaged over the position of the balls.
    """
    v, omega = kinematic_speeds(context, speed)
    turns = np.arange(24) / 24 * 2.0 * math.pi / context.ball_count
    power = [(losses(name, context, speed, turn, **parameters) @ [v, omega]).sum() for turn in turns]
    return float(np.mean(power)) / speed


def test_immersion_is_the_volume_of_the_cap() -> None:
    R = 6e-3
    for level in (-R, -0.3 * R, 0.0, 0.5 * R, R):
        cap = math.pi * (level + R) ** 2 * (3.0 * R - (level + R)) / 3.0
        assert immersion(-0.5 * math.pi, OilBath(level, 0.03, R)) == pytest.approx(cap / (4.0 / 3.0 * math.pi * R**3))
    assert immersion(0.5 * math.pi, OilBath(0.0, 0.03, R)) == 0.0
    assert immersion(0.5 * math.pi, OilBath(0.06 + R, 0.03, R)) == 1.0


@pytest.mark.parametrize("name", LAWS)
class TestEveryLaw:
    def test_only_immersed_balls_lose(self, name: str) -> None:
        found = losses(name, CONTEXT, 300.0, turn=-0.5 * math.pi)
        assert np.all(found[0] > 0.0)
        assert np.all(found[2:-1] == 0.0)

    def test_unknown_oil_level_means_every_ball_alike(self, name: str) -> None:
        found = losses(name, dataclasses.replace(CONTEXT, oil_level=math.nan), 300.0)
        assert np.all(found > 0.0)
        assert found == pytest.approx(np.tile(found[0], (9, 1)))

    def test_dry_bearing_has_no_loss(self, name: str) -> None:
        assert np.all(losses(name, dataclasses.replace(CONTEXT, oil_level=-0.02), 300.0) == 0.0)

    def test_odd_in_the_orbital_speed_and_zero_at_rest(self, name: str) -> None:
        given = {"omega_spin": 100.0, "azimuth": -1.5, "nu": NU, "rho": RHO}
        assert_symmetric(f"fluid_drag/{name}", "v_orbit", [0.0, 1e-6, 0.1, 5.0], odd=True, **given)
        at_rest = evaluate(f"fluid_drag/{name}", v_orbit=0.0, omega_spin=0.0, azimuth=-1.5, nu=NU, rho=RHO)
        assert np.all(at_rest == 0.0)

    @pytest.mark.parametrize("nu", [1e-9, 1e-6, 1e-1])
    def test_finite_for_any_oil_and_speed(self, name: str, nu: float) -> None:
        for v, omega in ((1e-12, 1e-12), (100.0, 1e4)):
            found = evaluate(f"fluid_drag/{name}", v_orbit=v, omega_spin=omega, azimuth=-1.5, nu=nu, rho=RHO)
            assert np.all(np.isfinite(found))
            assert np.all(found >= 0.0)

    def test_continuous_through_rest(self, name: str) -> None:
        given = {"omega_spin": 0.0, "azimuth": -1.5, "nu": NU, "rho": RHO}
        slope = [evaluate(f"fluid_drag/{name}", v_orbit=v, **given)[0] / v for v in (1e-9, 1e-7)]
        assert slope[0] == pytest.approx(slope[1], rel=0.01, abs=1e-6)


@pytest.mark.parametrize("level", [-0.003, 0.0, 0.02, 0.1])
@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_power_of_the_balls_is_the_catalogues(level: float, share: float) -> None:
    """Compare power with SKF 2008 to 1e-4.

    V_M K_ball d_m^5 n^2 in N mm; averaged over 24 positions of the balls.
    """
    context = dataclasses.replace(CONTEXT, oil_level=level)
    n = 3000.0
    expected = 3e-5 * 3.1 * (80.0 + 40.0) / (80.0 - 40.0) * 1e-12 * 60.0**5 * n**2 * 1e-3
    found = torque("skf-catalogue", context, n * math.pi / 30.0, v_m=3e-5, edition="2008", drag_share=share)
    assert found == pytest.approx(expected, rel=1e-4)


def test_split_between_force_and_moment() -> None:
    v, omega = kinematic_speeds(CONTEXT, 300.0)
    for name in ("skf-catalogue", "schaeffler-catalogue"):
        force, moment = losses(name, CONTEXT, 300.0, -0.5 * math.pi, drag_share=0.7)[0]
        assert force * v / (force * v + moment * omega) == pytest.approx(0.7)


def test_viscous_term_of_the_later_edition() -> None:
    """Compute the viscous term by hand.

    The 6208 of the trial context, oil to the centre of the lowest ball, all in mm, 1/min, mm2/s.
    """
    n, d_m, H = 3000.0, 60.0, 0.5 * 11.906
    ratio = 3.1 * (80.0 + 40.0) / (80.0 - 40.0)
    t = 2.0 * math.acos((0.6 * d_m - H) / (0.6 * d_m))
    R_s = 0.36 * d_m**2 * (t - math.sin(t)) * 0.05 * ratio
    viscous = 1.093e-7 * n**2 * d_m**3 * (n * d_m**2 * math.sin(t / 2.0) / 40.0) ** -1.379 * R_s
    square = 0.4 * 3e-5 * ratio * 1e-12 * d_m**5 * n**2
    found = torque("skf-catalogue", CONTEXT, n * math.pi / 30.0, v_m=3e-5, edition="2018")
    assert found == pytest.approx(1e-3 * (square + viscous), rel=1e-4)


# Oil level over mean diameter: V_M of the chart's two digitised parts, and the 6319 of Syla et al. 2026.
@pytest.mark.parametrize(("level", "factor"), [(0.0, 0.0), (0.1017, 7.55e-5), (0.1087, 7.97e-5), (1.3, 1.25e-3)])
def test_drag_loss_factor_of_the_chart(level: float, factor: float) -> None:
    """Compare V_M with readings of SKF's diagram.

    The two parts of the chart, 7.35e-5 and 8.58e-5 at 0.1087, are 15 % apart.
    """
    assert drag_loss_factor(level) == pytest.approx(factor, rel=0.08)


@pytest.mark.parametrize("edition", ["2018", 2018])
def test_edition_is_a_year_as_number_or_text(edition: Any) -> None:
    absent = torque("skf-catalogue", CONTEXT, 300.0, edition=edition)
    level = 0.5 * 11.906 / 60.0
    assert absent == pytest.approx(
        torque("skf-catalogue", CONTEXT, 300.0, edition="2018", v_m=drag_loss_factor(level)), rel=0.01
    )
    assert absent != pytest.approx(torque("skf-catalogue", CONTEXT, 300.0, edition="2008"), rel=0.01)


@pytest.mark.parametrize("n", [20.0, 3000.0])
def test_schaeffler_torque_and_its_share(n: float) -> None:
    """Compare Schaeffler's torque below and above 2000.

    Series 62: f0 = 2; below nu n = 2000 the constant 160, above (nu n)^(2/3).
    """
    number = max(160.0, (40.0 * n) ** (2.0 / 3.0))
    expected = 0.35 * 2.0 * 1e-7 * 60.0**3 * number * 1e-3
    assert torque("schaeffler-catalogue", CONTEXT, n * math.pi / 30.0) == pytest.approx(expected, rel=0.002)


def test_schaeffler_needs_a_known_series_or_f0() -> None:
    law = registry().model("fluid_drag", "schaeffler-catalogue")
    odd = dataclasses.replace(CONTEXT, series="")
    with pytest.raises(PluginError, match="give the parameter f0"):
        make_par(law, law.parameters(), odd)
    assert torque("schaeffler-catalogue", odd, 300.0, f0=2.0) == pytest.approx(
        torque("schaeffler-catalogue", CONTEXT, 300.0)
    )


def test_oil_that_turns_with_the_balls_does_not_drag() -> None:
    force, moment = losses("sphere-drag", CONTEXT, 300.0, -0.5 * math.pi, entrainment=1.0)[0]
    assert force == 0.0
    assert moment > 0.0
