"""Compare mixed friction from rest to full film."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lambda_core.laws.probe import trial_context
from lambda_core.testing import evaluate

from .published import Published

MU, SPEED = 0.12, 2.0
ROUNDING = "rounding; the slip of full friction at rest, 1 um/s, against 1 mm/s and more"


def carter(stuck: float) -> float:
    """Return Carter's relative traction.

    Shear force over mu times load, a stuck strip of the share `stuck` at the inlet.

    q = mu p_0/b [sqrt(b^2 - x^2) - sqrt(c^2 - (x + b - c)^2)], the second root in the stuck strip alone, integrated
    over the contact (Johnson, Contact Mechanics, eq. 8.15 and Fig. 8.4).
    """
    x = np.linspace(-1.0, 1.0, 200_001)
    inside = np.maximum(stuck**2 - (x + 1.0 - stuck) ** 2, 0.0)
    return float(np.trapezoid(np.sqrt(1.0 - x**2) - np.sqrt(inside), x)) / (0.5 * math.pi)


@pytest.mark.parametrize("stuck", [0.95, 0.8, 0.5, 0.2, 0.0])
def test_carters_creep_curve(stuck: float) -> None:
    """Compare force with Carter's stuck share.

    At the creep mu b/R (1 - c/b) the share c/b of the strip sticks.
    """
    context = trial_context("ball_inner")
    half_width_over_radius = 0.03
    largest = 0.25 * context.e_eff * half_width_over_radius  # p_0 = E' b/(4 R), E' = 2 E*
    creep = MU * half_width_over_radius * (1.0 - stuck)
    found = evaluate(
        "boundary_friction/micro-slip", {"mu": MU}, slip=creep * SPEED, p=0.25 * math.pi * largest, u_mean=SPEED
    )
    source = "Carter 1926, Proc. R. Soc. A 112, 151; Johnson, Contact Mechanics (1985), section 8.3"
    Published(MU * carter(stuck), source, ROUNDING, rel=2e-3).check(float(found[0]))


def test_micro_slip_scales_with_the_rolling_speed() -> None:
    """Scale creep with the rolling speed.

    The same creep gives the same friction at any speed, so that nothing is smoothed away in a slow bearing.
    """
    slow, fast = (
        evaluate("boundary_friction/micro-slip", {"v_rest": "1e-9 mm/s"}, slip=1e-3 * u, p=1e9, u_mean=u)[0]
        for u in (1e-3, 10.0)
    )
    assert slow == pytest.approx(fast, rel=1e-5)  # 1e-12 m/s of slip at rest against 2.6e-6 m/s
    assert 0.3 * MU < fast < MU


@pytest.mark.parametrize(("film", "share"), [(0.0, 1.0), (0.5, 0.4444444), (1.0, 0.25), (2.0, 0.1111111), (9.0, 0.01)])
def test_transition_of_spikes_and_olver(film: float, share: float) -> None:
    found = evaluate("asperity_load/spikes-olver", Lambda=film)
    source = "Spikes and Olver 2003, Lubr. Sci. 16(1), 3, with m = 2"
    Published(share, source, "rounding of the printed share", rel=1e-6).check(float(found[0]))


@pytest.mark.parametrize("share", [0.0, 0.25, 1.0])
def test_friction_by_shares_of_the_load(share: float) -> None:
    """Share friction between film and boundary.

    The transition is the one that Spikes and Olver fitted.
    """
    film, solid = evaluate("mixing/load-share", **_press(200.0), psi=share, Lambda=1.0)
    source = "Spikes and Olver 2003, Lubr. Sci. 16(1), 3: mu = mu_film + (mu_bl - mu_film) psi; mu 0.04 and 0.12"
    Published(0.04 + 0.08 * share, source, "rounding", rel=1e-12).check(0.04 * float(film) + 0.12 * float(solid))


@pytest.mark.parametrize(("load", "ratio"), [(500.0, 400.0), (100.0, 2000.0), (20.0, 10_000.0), (5.0, 40_000.0)])
def test_real_area_of_plates_of_steel(load: float, ratio: float) -> None:
    """Compare real areas of steel plates.

    Nominal over real area, 20 cm2, yield at 100 kgf/mm2, under loads in kgf.
    """
    side = math.sqrt(20e-4 / math.pi)
    press = {"load": load * 9.80665, "p_max": 1e6, "semi_a": side, "semi_b": side}
    film, solid = evaluate("mixing/contact-area", {"hardness": "980.665 MPa"}, **press, psi=1.0, Lambda=0.0)
    assert solid == 1.0
    source = "Bowden and Tabor 1939, Proc. R. Soc. A 169, 391; The Friction and Lubrication of Solids (1950), table I"
    Published(1.0 / ratio, source, "ratios printed to one digit or two", rel=0.05).check(1.0 - float(film))


def _press(load: float) -> dict[str, float]:
    return {"load": load, "p_max": 1.5e9, "semi_a": 1e-3, "semi_b": 2e-4}
