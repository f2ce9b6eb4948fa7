"""Supply of oil: exact limits of every law and the numbers of the published relations."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from lambda_core.laws.probe import trial_context
from lambda_core.testing import evaluate

from .published import Published

FILM = {"load": 500.0, "semi_a": 1.2e-3, "semi_b": 132e-6, "R_x": 5e-3, "h_cen": 0.9e-6, "h_min": 0.7e-6}
DIGITS = "digits of the table"


@pytest.mark.parametrize("film", [1e-8, 1e-6, 1e-5])
def test_a_flooded_contact_loses_nothing(film: float) -> None:
    """Exactly 1 for film and rolling resistance: no starvation, an endless layer, an endless inlet, no speed."""
    given = FILM | {"h_cen": film, "h_min": 0.8 * film}
    for label, parameters in (
        ("supply/constant", {"film_factor": 1.0}),
        ("supply/oil-layer", {"layer": "1e15 um"}),
        ("supply/inlet-distance", {"distance": 1e12}),
        ("supply/skf-replenishment", {"k_rs": 0.0}),
    ):
        assert tuple(evaluate(label, parameters, u_mean=3.0, **given)) == (1.0, 1.0), label


def test_no_oil_leaves_neither_film_nor_resistance() -> None:
    for label, parameters in (("supply/constant", {"film_factor": 1e-9}), ("supply/oil-layer", {"layer": "1e-12 um"})):
        film, rolling = evaluate(label, parameters, u_mean=3.0, **FILM)
        assert 0.0 < film < 1e-8, label
        assert 0.0 < rolling < 1e-8, label


# Layer over flooded film, and the film by an exponent of 2 and of 5, by hand from r/(1 + r^g)^(1/g).
CHEVALIER = [(0.2, 0.196, 0.200), (0.5, 0.447, 0.497), (1.0, 0.707, 0.871), (2.0, 0.894, 0.994), (5.0, 0.981, 1.0)]


@pytest.mark.parametrize(("layer", "soft", "sharp"), CHEVALIER)
def test_film_of_a_layer(layer: float, soft: float, sharp: float) -> None:
    source = "Chevalier et al. 1998, J. Tribol. 120, 126, g = 2 and 5"
    for gamma, film in ((2.0, soft), (5.0, sharp)):
        parameters = {"layer": f"{layer * 0.9} um", "gamma": gamma}
        found = evaluate("supply/oil-layer", parameters, u_mean=3.0, **FILM)[0]
        Published(film, source, DIGITS, abs=5.1e-4).check(float(found))


# m* = 2.36: 6208, inner contact, b = 132 um, R_x = 5 mm, film 0.9 um.
@pytest.mark.parametrize(("distance", "film"), [(1.5, 0.749), (2.0, 0.915), (3.0, 1.0)])
def test_film_of_a_near_inlet(distance: float, film: float) -> None:
    source = "Hamrock and Dowson 1977, J. Lubr. Technol. 99, 15"
    found = evaluate("supply/inlet-distance", {"distance": distance}, u_mean=3.0, **FILM)[0]
    Published(film, source, "R_x of the published m* is rounded", rel=0.01).check(float(found))


@pytest.mark.parametrize(("thickness", "share"), [(0.0, 0.0), (1.0, 0.112880), (10.0, 0.525547), (100.0, 0.859751)])
def test_starved_rolling_resistance(thickness: float, share: float) -> None:
    """F/F* at inlet films of 1, 10 and 100 times the minimum film, by hand from the printed ratio of polynomials."""
    from lambda_plugins.supply import starved_rolling

    source = "Biboulet and Houpert 2010, Proc. IMechE J 224, Part 1, eq. 44"
    Published(share, source, "rounding", abs=1e-6).check(starved_rolling(thickness))


def test_half_the_film_costs_rolling_resistance_too() -> None:
    """lubricant.starvation = 0.5: the layer of half the flooded film feeds much less than half the resistance."""
    film, rolling = evaluate("supply/constant", {"film_factor": 0.5}, u_mean=3.0, **FILM)
    layer = evaluate("supply/oil-layer", {"layer": f"{0.5 / (1 - 0.5**3.5) ** (1 / 3.5) * 0.9} um"}, u_mean=3.0, **FILM)
    assert film == 0.5
    assert (film, rolling) == pytest.approx(tuple(layer), rel=1e-9)
    assert rolling < 0.2


# 6319 at 38 mm2/s: speed [1/min] and phi_rs.
@pytest.mark.parametrize(("rpm", "share"), [(500.0, 0.980), (1500.0, 0.941), (3000.0, 0.885)])
def test_replenishment_of_the_6319(rpm: float, share: float) -> None:
    context = trial_context("ball_inner")
    oil = replace(context.oil, viscosity=38e-6 * 860.0, density=860.0)
    sizes = {"bore_diameter": 0.095, "outside_diameter": 0.2, "ball_diameter": 0.03, "pitch_diameter": 0.1475}
    context = replace(context, oil=oil, **sizes)
    gamma = 0.03 / 0.1475
    speed = 0.25 * 0.1475 * (1.0 - gamma**2) * rpm * math.pi / 30.0
    film, rolling = evaluate("supply/skf-replenishment", context=context, u_mean=speed, **FILM)
    assert film == 1.0
    source = "SKF, Rolling bearings, catalogue 17000 EN (2018), phi_rs by hand"
    Published(share, source, DIGITS, abs=1e-3).check(float(rolling))
