"""Compare laws of film breakdown with closed forms."""

from __future__ import annotations

import math

import pytest
from electric.rough_film import breakdown_voltage

from lambda_core.testing import evaluate

from .published import Published

FILM = {"h": 0.8e-6, "h_min": 0.5e-6, "sigma": 0.1e-6, "area": 2.75e-6}
ROUNDING = "rounding of the inverse normal distribution"


def test_field_of_a_smooth_film() -> None:
    found = evaluate("breakdown/field", {"strength": "15 V/um"}, u_1=0.5, u_2=0.5, **FILM)
    source = "Busse et al. 1997, IEEE Trans. Ind. Appl. 33, 567: 15 V/um, here over 0.5 um"
    Published(7.5, source, "exact", rel=1e-12).check(float(found[0]))


@pytest.mark.parametrize("u", [0.01, 0.3, 0.5, 0.9, 0.999])
def test_statistics_of_the_lowest_spot(u: float) -> None:
    """Compare the weakest of N spots with scipy.

    breakdown/statistical: not broken down with probability u.
    """
    changes = {"strength": "30 V/um", "correlation_length": "10 um"}
    found = evaluate("breakdown/statistical", changes, u_1=u, u_2=0.5, **FILM)
    expected = breakdown_voltage(1.0 - u, FILM["h"], FILM["sigma"], 30e6, FILM["area"] / 1e-10)
    Published(float(expected), "weakest link, Phi^N", ROUNDING, rel=1e-6).check(float(found[0]))


def test_particles_bridge_the_film_as_often_as_poisson_says() -> None:
    """Compare bridges with a Poisson law.

    breakdown/particles: below u_2 = 1 - exp(-n A h) one of 0.7 um leaves E_b (h - d), else there is none.
    """
    changes = {"strength": "30 V/um", "particle_size": "0.7 um", "particle_density": "100 1/mm3"}
    chance = -math.expm1(-1e11 * FILM["area"] * FILM["h"])
    without = evaluate("breakdown/statistical", {"strength": "30 V/um"}, u_1=0.9, u_2=0.5, **FILM)
    for u_2, expected in ((0.999 * chance, 30e6 * 0.1e-6), (1.001 * chance, float(without[0]))):
        found = evaluate("breakdown/particles", changes, u_1=0.9, u_2=u_2, **FILM)
        Published(expected, "Poisson statistics, one size of particle", "exact", rel=1e-9).check(float(found[0]))


def test_arcs_after_ohm() -> None:
    """Compare arcs with i = (V - U)/R.

    discharge/resistance and discharge/arc-voltage return their given values, down to a least.
    """
    given = {"V": 12.0, "h": 0.8e-6, "area": 2.75e-6}
    channel = {"resistance": "4 Ohm", "least_current": "20 mA"}
    assert tuple(evaluate("discharge/resistance", channel, **given)) == (4.0, 0.0, 0.02)
    assert tuple(evaluate("discharge/arc-voltage", channel | {"voltage": "2.5 V"}, **given)) == (4.0, 2.5, 0.02)
