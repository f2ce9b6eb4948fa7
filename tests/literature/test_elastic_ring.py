"""Test a ring as Fourier modes.

Pinched by two forces, ratios of frequencies, Bryan's lag of a turning ring, bedding.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lambda_core.formulas.elastic.ring import ElasticRing

# a section of 4 by 18 mm on 38 mm: about the outer ring of a 6208
RING = ElasticRing(0.038, 4e-3 * 18e-3, 18e-3 * (4e-3) ** 3 / 12.0, 210e9, 7850.0)
UNIT = RING.radius**3 / (RING.youngs_modulus * RING.second_moment)


def test_a_ring_pinched_by_two_forces() -> None:
    """Compare widening and closing with Timoshenko, exactly.

    Closing (pi/4 - 2/pi) F R^3/(E I), widening (2/pi - 1/2) (Strength of Materials).

    With ten orders 0.11 % and 0.2 % are missing.
    """
    pinch = np.array([1.0, 0.0, 1.0, 0.0])
    places = np.array([0.0, 0.5 * math.pi, math.pi, 1.5 * math.pi])
    for orders, slack in ((10, 3e-3), (400, 1e-6)):
        moved = RING.flexibility(places, orders) @ -pinch / UNIT
        assert -(moved[0] + moved[2]) == pytest.approx(math.pi / 4.0 - 2.0 / math.pi, rel=slack)
        assert moved[1] + moved[3] == pytest.approx(2.0 / math.pi - 0.5, rel=slack)


def test_ratios_of_natural_frequencies() -> None:
    """Compare frequencies with Love 1927, art. 293.

    f_3/f_2 = 2.8284, f_4/f_2 = 5.4233 of any free thin ring, exact.
    """
    two, three, four = (RING.frequency(n) for n in (2, 3, 4))
    assert three / two == pytest.approx(2.8284, abs=1e-4)
    assert four / two == pytest.approx(5.4233, abs=1e-4)
    assert two / (2.0 * math.pi) == pytest.approx(
        6.0 / math.sqrt(5.0) / (2.0 * math.pi) / math.sqrt(UNIT * RING.density * RING.area * RING.radius), rel=1e-12
    )


@pytest.mark.parametrize(("order", "lag"), [(2, 0.400), (3, 0.200)])
def test_the_pattern_of_a_turning_ring_lags(order: int, lag: float) -> None:
    """Compare the lag with Bryan 1890 to 1 %.

    A standing pattern turns back by 2/(n^2 + 1) of the ring's spin, seen from the ring.

    The motion of both amplitudes is integrated with their Coriolis coupling, and the pattern's place is followed.
    """
    spin = 1e-3 * RING.frequency(order)
    against, along = RING.whirl_frequencies(order, spin)
    assert (against - along) / (2.0 * order) / spin == pytest.approx(lag, rel=1e-12)
    coupling, square = 4.0 * order * spin / (order**2 + 1), RING.frequency(order) ** 2

    def rates(_: float, q: np.ndarray) -> list[float]:
        c, s, dc, ds = q
        return [dc, ds, -square * c + coupling * ds, -square * s - coupling * dc]

    end = 60.0 * 2.0 * math.pi / RING.frequency(order)
    path = solve_ivp(rates, (0.0, end), [1.0, 0.0, 0.0, 0.0], rtol=1e-9, atol=1e-12, max_step=end / 2000.0)
    last = path.t > 0.5 * end
    sizes = np.hypot(path.y[0], path.y[1])[last]
    swing = path.y[:2, last][:, np.argmax(sizes)]
    turned = math.atan2(swing[1], swing[0])
    turned -= math.pi * round(turned / math.pi)
    at = float(path.t[last][np.argmax(sizes)])
    assert abs(turned) / order / at / spin == pytest.approx(lag, rel=0.01)


def test_a_stiff_bedding_is_a_rigid_ring() -> None:
    """Keep a ring's shape in a stiff bedding.

    The bedding has 1e6 times the ring's stiffness; the shape stays to 1e-6.
    """
    stiff = dataclasses.replace(RING, bedding=1e6 * RING.stiffness(2) / (math.pi * RING.radius))
    places = np.array([0.0, 1.0])
    assert np.abs(stiff.flexibility(places)).max() * RING.stiffness(2) < 1e-5
    assert np.abs(stiff.flexibility(places)).max() < 1e-5 * np.abs(RING.flexibility(places)).max()
