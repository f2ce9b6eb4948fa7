"""Test fluid losses and cage friction against catalogues."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from lambda_plugins.immersion import kinematic_speeds

from lambda_core.laws.context import Context
from lambda_core.laws.probe import trial_context
from lambda_core.testing import evaluate

from .published import Published

NU, RHO = 36.6e-6, 858.0


def flooded_6319() -> Context:
    """Return the flooded 6319.

    Syla et al. 2026, Table 3, every ball immersed: the sum over balls does not depend on their position.
    """
    return dataclasses.replace(
        trial_context("fluid_drag"),
        ball_count=9,
        ball_diameter=30.0e-3,
        pitch_diameter=147.5e-3,
        bore_diameter=95.0e-3,
        outside_diameter=200.0e-3,
        width=45.0e-3,
        series="63",
        oil_level=math.nan,
    )


def torque(name: str, rpm: float, **parameters: float | str) -> float:
    """Return the balls' loss over speed [N mm].

    At kinematic speeds.
    """
    context, speed = flooded_6319(), rpm * math.pi / 30.0
    v, omega = kinematic_speeds(context, speed)
    given = {"v_orbit": v, "omega_spin": omega, "azimuth": 0.3, "nu": NU, "rho": RHO}
    force, moment = evaluate(f"fluid_drag/{name}", parameters, context, **given)
    return 1e3 * 9.0 * float(force * v + moment * omega) / speed


@pytest.mark.parametrize(("rpm", "expected"), [(500.0, 6.841), (1500.0, 61.57), (3000.0, 246.3)])
def test_skf_drag_of_the_6319(rpm: float, expected: float) -> None:
    """Compute drag of the 6319 by hand.

    V_M 4.5e-5, K_ball = 3.1 x 295/105 x 1e-12, d_m 147.5 mm.
    """
    source = "SKF 2008; Syla et al. 2026, eq. 40"
    Published(expected, source, "digits", rel=1e-3).check(torque("skf-catalogue", rpm, v_m=4.5e-5, edition="2008"))


@pytest.mark.parametrize(("rpm", "expected"), [(500.0, 512.6), (1500.0, 1066.1), (3000.0, 1692.4)])
def test_schaeffler_idle_torque_of_the_6319(rpm: float, expected: float) -> None:
    """Compute Schaeffler's M0 of the 6319 by hand.

    M0 = f0 1e-7 d_m^3 (nu n)^(2/3) with f0 2.3 (oil bath, series 63), 36.6 mm2/s.
    """
    source = "Schaeffler; Syla et al. 2026, eq. 38"
    Published(expected, source, "digits", rel=5e-4).check(torque("schaeffler-catalogue", rpm, fluid_share=1.0))


def test_two_catalogues_agree_on_the_order_of_the_fluid_loss() -> None:
    """Compare fluid losses of two catalogues.

    At 3000 1/min the fluid share of Schaeffler's M0 (f0 bath less mist) is 1..5 times SKF's drag with V_M 4.5e-5.

    Table 4 of Syla et al. 2026 has 1380 N mm for everything at C/P = 10: a drag above half of it would be absurd.
    """
    share = torque("schaeffler-catalogue", 3000.0)
    assert 1.0 < share / torque("skf-catalogue", 3000.0, v_m=4.5e-5) < 5.0
    assert share < 0.5 * 1380.0


def sphere(v: float, omega: float, nu: float) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    given = {"v_orbit": v, "omega_spin": omega, "azimuth": 0.3, "nu": nu, "rho": RHO}
    return np.asarray(evaluate("fluid_drag/sphere-drag", None, flooded_6319(), **given))


def test_stokes_and_kirchhoff_at_small_reynolds_numbers() -> None:
    """Compare with Stokes 1851 and Kirchhoff 1876.

    F = 6 pi mu R v and M = 8 pi mu R^3 omega; 0.5 % at Re = 6e-4 and 2e-4.
    """
    nu, R = 1e-2, 15e-3
    force, moment = sphere(2e-4, 1e-2, nu)
    assert force == pytest.approx(6.0 * math.pi * RHO * nu * R * 2e-4, rel=5e-3)
    assert moment == pytest.approx(8.0 * math.pi * RHO * nu * R**3 * 1e-2, rel=5e-3)


# Standard drag curve: Clift, Grace and Weber 1978, Bubbles, Drops and Particles, table 5.2 (recommended correlations).
DRAG = [(1.0, 27.2), (10.0, 4.26), (100.0, 1.09), (1e3, 0.47), (1e4, 0.42), (1e5, 0.48)]


@pytest.mark.parametrize(("Re", "C_D"), DRAG)
def test_standard_drag_curve(Re: float, C_D: float) -> None:
    nu, R = 1e-5, 15e-3
    v = Re * nu / (2.0 * R)
    force = sphere(v, 0.0, nu)[0]
    found = force / (0.5 * RHO * v * v * math.pi * R * R)
    Published(C_D, "standard drag curve", "Clift and Gauvin's correlation: -4 to +6 %; reading", rel=0.12).check(found)


@pytest.mark.parametrize(("Re", "C_D"), DRAG)
def test_standard_drag_curve_in_a_mixture(Re: float, C_D: float) -> None:
    """Compare drag in 2 % of oil, rest air.

    The curve holds with density and viscosity of the mixture.
    """
    context, nu, share, air, R = flooded_6319(), 1e-5, 0.02, 1.2, 15e-3
    density = share * RHO + (1.0 - share) * air
    v = Re * (share * RHO * nu + (1.0 - share) * 1.8e-5) / density / (2.0 * R)
    given = {"v_orbit": v, "omega_spin": 0.0, "azimuth": 0.3, "nu": nu, "rho": RHO}
    force = float(evaluate("fluid_drag/cavity-mixture", {"oil_share": share}, context, **given)[0])
    found = force / (0.5 * density * v * v * math.pi * R * R)
    Published(C_D, "standard drag curve", "Clift and Gauvin's correlation: -4 to +6 %; reading", rel=0.12).check(found)


# Dennis, Singh and Ingham 1980, J. Fluid Mech. 101, 257: M = (rho omega^2 R^5/2) C_M, computed.
SPIN = [(20.0, 3.05), (100.0, 0.966), (1000.0, 0.236)]


@pytest.mark.parametrize(("Re", "C_M"), SPIN)
def test_moment_of_a_spinning_sphere(Re: float, C_M: float) -> None:
    nu, R = 1e-5, 15e-3
    omega = Re * nu / (R * R)
    found = sphere(0.0, omega, nu)[1] / (0.5 * RHO * omega**2 * R**5)
    Published(C_M, "6.45/sqrt(Re) + 32.1/Re", "joined to Kirchhoff's law below Re = 8", rel=0.02).check(found)


def test_share_of_drag_is_that_of_a_free_sphere() -> None:
    """Compare the default share with a free sphere.

    0.8 is a little below: powers of a free sphere at the speeds of a 6319, 500 to 3000 1/min.
    """
    for rpm in (500.0, 1500.0, 3000.0):
        v, omega = kinematic_speeds(flooded_6319(), rpm * math.pi / 30.0)
        force, moment = sphere(v, omega, NU)
        Published(0.87, "Clift et al. 1978 and Sawatzki 1970", "0.82 to 0.92 over the speeds", abs=0.055).check(
            force * v / (force * v + moment * omega)
        )


def test_kinematic_speeds_of_the_6319() -> None:
    """Compare speeds of the 6319 with Harris.

    Harris and Kotzalas 2006, eq. 10.12 and 10.14: cage 0.3983, ball 2.3566 of the ring's speed against the cage.

    Against the oil, which is at rest, the ball turns slower by the cage's own speed: it rolls on the outer ring.
    """
    context = flooded_6319()
    v, omega = kinematic_speeds(context, 1.0)
    assert v / (0.5 * context.pitch_diameter) == pytest.approx(0.39831, rel=1e-4)
    assert omega == pytest.approx(2.35664 - 0.39831, rel=1e-4)
    assert omega * 0.5 * context.ball_diameter == pytest.approx(v, rel=1e-12)
