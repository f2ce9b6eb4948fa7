"""Test supply of oil.

Exact limits of every law and the numbers of the published relations.
"""

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
    """Keep a factor of 1 without starvation.

    Film and rolling resistance, exactly: no starvation, an endless layer, an endless inlet, no speed.
    """
    given = FILM | {"h_cen": film, "h_min": 0.8 * film}
    for label, parameters in (
        ("supply/constant", {"film_factor": 1.0}),
        ("supply/oil-layer", {"layer": "1e15 um"}),
        ("supply/side-flow", {"layer": "1e15 um", "time": "0 s"}),
        ("supply/inlet-distance", {"distance": 1e12}),
        ("supply/skf-replenishment", {"k_rs": 0.0}),
    ):
        assert tuple(evaluate(label, parameters, u_mean=3.0, **given)) == (1.0, 1.0), label


def test_no_oil_leaves_neither_film_nor_resistance() -> None:
    for label, parameters in (
        ("supply/constant", {"film_factor": 1e-9}),
        ("supply/oil-layer", {"layer": "1e-12 um"}),
        ("supply/side-flow", {"layer": "1 um", "time": "1e20 s"}),
    ):
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
    """Compute F/F* at three inlet films by hand.

    1, 10 and 100 times the minimum film, from the printed ratio of polynomials.
    """
    from lambda_plugins.starved_inlet import starved_rolling

    source = "Biboulet and Houpert 2010, Proc. IMechE J 224, Part 1, eq. 44"
    Published(share, source, "rounding", abs=1e-6).check(starved_rolling(thickness))


def test_half_the_film_costs_rolling_resistance_too() -> None:
    """Lower rolling resistance with half the film.

    lubricant.starvation = 0.5: the inlet of half the flooded film has much less than half the resistance.

    Every law has the same rolling resistance at the same film, by whatever it is starved; a slow contact with SKF's
    replenishment has that of the prescribed film.
    """
    film, rolling = evaluate("supply/constant", {"film_factor": 0.5}, u_mean=3.0, **FILM)
    layer = evaluate("supply/oil-layer", {"layer": f"{0.5 / (1 - 0.5**3.5) ** (1 / 3.5) * 0.9} um"}, u_mean=3.0, **FILM)
    slow = evaluate("supply/skf-replenishment", {"film_factor": 0.5}, u_mean=1e-3, **FILM)
    assert film == 0.5
    assert (film, rolling) == pytest.approx(tuple(layer), rel=1e-9)
    assert (film, rolling) == tuple(slow)
    assert rolling < 0.2


def test_meniscus_of_a_starved_film() -> None:
    """Integrate Grubin's inlet of a starved film.

    By quadrature, from a film of a thousandth to one of 0.9999, and both ends.
    """
    from lambda_plugins.starved_inlet import meniscus
    from scipy.special import betaincinv

    source = "Wolveridge, Baglin and Archard 1971, Proc. IMechE 185, 1159: Grubin's inlet, by quadrature"
    for film in (1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999, 0.9999):
        part = betaincinv(5 / 3, 4 / 3, film ** (4 / 3))  # J(T)/J(inf) is a beta integral of T^1.5/(1 + T^1.5)
        gap = film / (1.0 - part)
        Published(gap, source, "numerical form of the integral", rel=0.0034).check(meniscus(film))
    assert meniscus(0.0) == 0.0
    assert meniscus(1.0) > 1e200


@pytest.mark.parametrize("distance", [1.5, 2.0])
def test_meniscus_against_hamrock_and_dowson(distance: float) -> None:
    """Compare a meniscus with Hamrock and Dowson.

    The film that Grubin's inlet leaves at a meniscus, against the fit to solved point contacts.
    """
    from lambda_plugins.starved_inlet import meniscus

    film = evaluate("supply/inlet-distance", {"distance": distance}, u_mean=3.0, **FILM)[0]
    root = math.sqrt(distance**2 - 1.0)
    neighbour = 0.5 * FILM["semi_b"] ** 2 / FILM["R_x"] * (distance * root - math.log(distance + root))
    low, high = 0.0, 1.0
    for _ in range(60):  # the film whose meniscus stands where Hertz's gap is that of this distance
        middle = 0.5 * (low + high)
        low, high = (middle, high) if meniscus(middle) - middle < neighbour / FILM["h_cen"] else (low, middle)
    Published(
        float(film), "Hamrock and Dowson 1977, J. Lubr. Technol. 99, 15", "line and point contacts", rel=0.08
    ).check(low)


def test_decay_on_a_measured_track() -> None:
    """Compare the decay with a measured track.

    Ball on disc, tracks of 40 and 9.53 mm radius, lithium grease of 0.38 Pa s and 30 1/GPa, 0.48 GPa, 141 um.

    From 90 nm to 0.04 of the 500 nm of a flooded contact in 17 minutes; the sharpest passage, as the model has none.
    """
    context = trial_context("ball_inner")
    oil = replace(context.oil, viscosity=0.38, alpha_p=30e-9)
    context = replace(context, oil=oil, ball_count=1, race_diameter=0.080, ball_diameter=4.0 * 0.00953)
    load = 2.0 / 3.0 * math.pi * 141e-6**2 * 0.48e9
    contact = FILM | {"load": load, "semi_a": 141e-6, "semi_b": 141e-6, "h_cen": 500e-9, "h_min": 400e-9}
    laid = {"layer": f"{90.0 * (5.9e8 + 1.34 * 0.48e9) / (5.9e8 + 0.48e9)} nm", "gamma": 20.0}
    start, end = (
        evaluate("supply/side-flow", laid | {"time": time}, context=context, u_mean=0.2, **contact)
        for time in ("0 s", "17 min")
    )
    source = "Gao et al. 2026, Tribol. Int., as transcribed by others: h/h_ff from 0.18 to 0.04 in 17 min"
    Published(0.18, source, "two digits", abs=0.005).check(float(start[0]))
    Published(0.04, source, "one digit", abs=0.006).check(float(end[0]))
    assert end[1] < start[1] < 0.05


def test_side_flow_derived_again() -> None:
    """Integrate the side flow a second time.

    The printed bracket against the integral of exp(-alpha p)/sqrt(1 - x^2) over the middle of Hertz's ellipse.

    13 % short at alpha p of 1, next to nothing at those of bearings; the layer goes with the root of it.
    """
    from lambda_plugins.supply_layers import side_flow
    from scipy.special import iv, modstruve

    for thick in (0.1, 1.0, 5.0, 20.0, 30.0):  # alpha p_h, the last two those of bearings
        exact = math.pi * (iv(0, thick) - modstruve(0, thick))
        found = math.pi * side_flow(1.0, 1e9, 1.0, 1.0, thick * 1e-9) / 1e9
        source = "Side flow of Hertz's pressure through a film of Barus' viscosity, derived anew"
        Published(float(exact), source, "approximation of van Zoelen et al. 2009", rel=0.14).check(found)


def test_limits_of_a_layer_that_flows_aside() -> None:
    """Compare limits of a layer that flows aside.

    No time gives the fresh layer, a long time none; a fed layer ends without memory of its beginning.
    """
    from lambda_plugins.supply_layers import layer_after
    from scipy.integrate import solve_ivp

    flow, feed = 1e11, 1e-11
    assert layer_after(2e-6, 0.0, flow, 0.0) == pytest.approx(2e-6, rel=1e-12)
    assert layer_after(2e-6, 1e14, flow, 0.0) < 1e-12
    assert layer_after(2e-6, 100.0, flow, 0.0) == pytest.approx((flow * 100.0 / 6.0 + 2e-6**-2) ** -0.5, rel=1e-12)
    steady = 2.0 * (3.0 * feed / flow) ** (1.0 / 3.0)
    for fresh in (0.1 * steady, 10.0 * steady):
        assert layer_after(fresh, 1e9, flow, feed) == pytest.approx(steady, rel=1e-9)
        time = 0.2 * steady / feed
        way = solve_ivp(lambda _, h: 2 * feed - flow * h**3 / 12, (0.0, time), [fresh], rtol=1e-9, atol=1e-18)
        assert layer_after(fresh, time, flow, feed) == pytest.approx(way.y[0, -1], rel=1e-6)


@pytest.mark.parametrize("feed", [1e-200, 1e-24, 1e-16, 1e-13])
@pytest.mark.parametrize("time", [0.0, 1.0, 3600.0])
def test_layer_that_is_hardly_fed(feed: float, time: float) -> None:
    """Keep a layer that is hardly fed.

    It begins at 1e3 to 1e65 times the layer that is kept up; a small feed must not remove it.

    Below h the feed matters by (h_eq/h)^3; the exact layer lies between the one without feed and that plus 2 R t.
    """
    from lambda_plugins.supply_layers import layer_after

    fresh, flow = 1e-4, 1e13
    bare = layer_after(fresh, time, flow, 0.0)
    fed = layer_after(fresh, time, flow, feed)
    assert bare * (1.0 - 1e-12) <= fed <= (bare + 2.0 * feed * time) * (1.0 + 1e-12)


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
