"""Test breakdown voltages.

Closed form, random numbers, and what an integration draws.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from electric.networks import AREA, ROUGH, SMOOTH, integrate, one_bearing, residuals, steady, strength
from electric.rough_film import breakdown_probability, breakdown_voltage
from lambda_plugins.normal_tail import upper_quantile
from scipy.special import ndtri

from lambda_core.analysis.electric import columns as L

CIRCUIT = one_bearing(50e-12, 1000e-12)


@pytest.mark.parametrize(
    ("film", "roughness", "expected"),
    [
        (0.5e-6, 0.10e-6, (1.59, 2.85, 3.72)),
        (0.6e-6, 0.10e-6, (4.59, 5.85, 6.72)),
        (0.5e-6, 0.05e-6, (8.29, 8.93, 9.36)),
    ],
)
def test_quantiles(film: float, roughness: float, expected: tuple[float, ...]) -> None:
    """Compare quantiles with values of another program.

    A rough film of 2.7 mm2, correlation length 10 um, 30 V/um, to the printed digits.
    """
    found = breakdown_voltage(np.array([0.1, 0.5, 0.9]), film, roughness, 30e6, 2.7e-6 / 1e-10)
    np.testing.assert_allclose(found, expected, rtol=5e-3)
    back = breakdown_probability(found, film, roughness, 30e6, 2.7e-6 / 1e-10)
    np.testing.assert_allclose(back, [0.1, 0.5, 0.9], rtol=1e-9)


@pytest.mark.parametrize("p", [1e-300, 1e-20, 1e-11, 1e-5, 0.01, 0.3, 0.5, 0.8, 0.999])
def test_normal_quantile(p: float) -> None:
    """Compare with scipy, which takes the lower tail."""
    assert upper_quantile(p) == pytest.approx(-ndtri(p), rel=1e-14, abs=1e-14)


def test_drawn_voltages_follow_the_law() -> None:
    """Compare first breakdowns on a slow ramp with the law.

    Many seeds; Kolmogorov and Smirnov's test at 1 in 1000.

    Only the weakest of the four films is seen: the law is that of 4 N spots.
    """
    films = steady(100e-12, 100e-12, balls=2, film=0.5e-6)
    source = np.array([0.0, 2e-3]), np.array([0.0, 800.0])
    events = [integrate(films, CIRCUIT, ROUGH, source, seed=seed).events[0] for seed in range(300)]
    drawn = np.sort([abs(event[L.E_CONTACT_VOLTAGE]) for event in events])
    law = breakdown_probability(drawn, 0.5e-6, 0.1e-6, 30e6, 4 * AREA / 1e-10)
    apart = np.abs(law - (np.arange(drawn.size) + 0.5) / drawn.size)
    distance = apart[drawn > 0.5].max()  # what would break down below does so there
    assert distance < 1.95 / math.sqrt(drawn.size)


def test_deterministic_field() -> None:
    """Break a smooth film at E_b h exactly.

    Both contacts of a ball break down, one after the other.
    """
    source = np.array([0.0, 1e-4, 2e-4]), np.array([0.0, 0.0, 800.0])
    found = integrate(steady(100e-12, 200e-12, film=0.4e-6), CIRCUIT, SMOOTH, source).events
    assert abs(found[0, L.E_CONTACT_VOLTAGE]) == pytest.approx(12.0, rel=1e-12)
    assert abs(found[0, L.E_BEARING_VOLTAGE]) == pytest.approx(18.0, rel=1e-9)
    assert found[:2, L.E_RACEWAY].tolist() == [0.0, 1.0]  # the smaller capacitance takes the larger voltage
    assert found[:2, L.E_DISCHARGE].tolist() == [0.0, 0.0]


def test_strong_film_holds() -> None:
    """Break one film down while the other holds.

    The other film takes the full voltage: the ball is charged, the rotor is not discharged.
    """
    films = steady(100e-12, 200e-12, film=0.4e-6)
    films.film[:, :, 1] = films.thinnest[:, :, 1] = 4e-6
    source = np.array([0.0, 1e-4, 2e-4, 2e-3]), np.array([0.0, 0.0, 500.0, 500.0])
    found = integrate(films, CIRCUIT, SMOOTH, source, window=(0.0, 1.0))
    assert set(found.events[:, L.E_RACEWAY]) == {0.0}
    assert found.trace[-1, 2] > 15.0


def test_particles_lower_the_threshold() -> None:
    """Compare breakdown with and without a particle.

    A particle of 0.3 um in a film of 0.5 um leaves 0.2 um; without one the smooth film holds 15 V.
    """
    source = np.array([0.0, 1e-4, 2e-4, 2e-3]), np.array([0.0, 0.0, 400.0, 400.0])
    clean = steady(100e-12, 100e-12, film=0.5e-6)
    law = strength("particles", roughness=1e-9, breaks={"particle_density": "40000 1/mm3"})  # 54 in each film
    assert integrate(clean, CIRCUIT, strength(roughness=1e-9), source).events.shape[0] == 0
    first = integrate(clean, CIRCUIT, law, source).events[0]
    assert abs(first[L.E_CONTACT_VOLTAGE]) == pytest.approx(6.0, rel=1e-12)


def test_no_film_between_touching_and_parting() -> None:
    """Unload a contact between two samples.

    It must not break down on half a film.
    """
    films = steady(100e-12, 100e-12, film=0.6e-6)
    films.film[1:] = films.thinnest[1:] = 0.0
    source = np.array([0.0, 1e-4, 2e-4, 2e-3]), np.array([0.0, 0.0, 300.0, 300.0])
    assert integrate(films, CIRCUIT, SMOOTH, source).events.shape[0] == 0


def test_other_films_break_down_while_an_edge_feeds_an_arc() -> None:
    """Feed an arc from an edge of 200 V.

    The arc burns in one film of a ball whose other film holds: 100 pF at 0.2 V/ns are 20 mA.

    The films of the second ball stand 1 V each, 2 V in series. They break down in time, not after the edge.
    """
    films = steady(100e-12, 100e-12, balls=2)
    films.film[:, 0] = films.thinnest[:, 0] = 0.01e-6, 5e-6
    films.film[:, 1] = films.thinnest[:, 1] = 1.0 / 30.0 * 1e-6
    source = np.array([0.0, 1e-4, 1e-4 + 50e-9, 1.0]), np.array([0.0, 0.0, 200.0, 200.0])
    circuit = one_bearing(50e-12, 800e-12)
    found = integrate(films, circuit, SMOOTH, source, window=(0.0, 1.0))
    assert set(found.events[:, L.E_BALL]) == {0.0, 1.0}
    assert np.abs(found.events[:, L.E_BEARING_VOLTAGE]).max() < 2.5
    assert np.abs(found.trace[:, 2]).max() < 4.1  # 0.2 A of the edge through two arcs of 10 Ohm
    assert max(map(abs, residuals(found, circuit, source))) < 1e-6
    films.film[:, 1] = films.thinnest[:, 1] = 5e-6
    alone = integrate(films, circuit, SMOOTH, source, window=(0.0, 1.0))
    assert set(alone.events[:, L.E_BALL]) == {0.0}
    assert np.abs(alone.trace[:, 2]).max() > 9.0
