"""Compare laws of line contacts with closed forms."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from lambda_plugins import line_contact, roller_drag, roller_pocket
from lambda_plugins.damping import SqueezeFilm
from lambda_plugins.elastic_hysteresis import LossFactor
from lambda_plugins.film_thickness import FilmFloors
from lambda_plugins.roller_pocket import Neighbours, RollerPocket
from lambda_plugins.rolling_resistance import InletShear
from scipy.integrate import quad

from lambda_core.domain.roles import DEFAULT_LINE_MODELS
from lambda_core.elements.roller import line_contact as theory
from lambda_core.elements.roller.roller_drag import drag_volume
from lambda_core.elements.roller.roller_friction import ROLLING_LAWS
from lambda_core.laws.law import Law, law_of
from lambda_core.laws.probe import trial_context

from .published import Published

MODULUS, RADIUS, LENGTH = 226.37e9, 7e-3, 20e-3
FLOORS = FilmFloors(1e-6, 1e-6, 1e-12, 1e-12)
INLET = InletShear(thermal_coefficient=0.0)


def outputs(count: int = 4) -> np.ndarray:
    return np.full(count, np.nan)


@pytest.mark.parametrize("name", ["iso_line", "hertz_line_contact"])
def test_the_pressure_across_carries_the_load(name: str) -> None:
    out = outputs()
    getattr(line_contact, name)(5e-6, RADIUS, LENGTH, MODULUS, None, out)
    load, half, width, peak = out
    assert half == 0.5 * LENGTH
    assert 0.5 * math.pi * width * peak * LENGTH == pytest.approx(load)
    assert width == pytest.approx(float(theory.half_width(load / LENGTH, RADIUS, MODULUS)))


def test_two_raceways_in_series_are_iso_16281() -> None:
    """Compare `normal_contact`, `iso-line` with two raceways."""
    out = outputs()
    line_contact.iso_line(4e-6, RADIUS, LENGTH, MODULUS, None, out)
    both = float(theory.iso_load(8e-6, LENGTH))
    Published(both, "ISO 16281:2025, c_L = 35948 L^(8/9)", "E' of 206 GPa and 0.3", rel=1e-4).check(out[0])


@pytest.mark.parametrize("load", [50.0, 2e3, 5e4])
def test_the_logarithm_is_lundbergs(load: float) -> None:
    """Compare `normal_contact`, `hertz-line` with Lundberg."""
    out = outputs()
    approach = theory.finite_line_approach(load, LENGTH, RADIUS, MODULUS)
    line_contact.hertz_line_contact(approach, RADIUS, LENGTH, MODULUS, None, out)
    Published(load, "Lundberg 1939, inverted", "Newton's method to rounding", rel=1e-9).check(out[0])


@pytest.mark.parametrize("name", ["iso_line", "hertz_line_contact"])
def test_open_lines_carry_nothing_and_loads_grow(name: str) -> None:
    loads = []
    for delta in (-1e-6, 0.0, 1e-12, 1e-9, 1e-6, 2e-6, 5e-5):
        out = outputs()
        assert getattr(line_contact, name)(delta, RADIUS, LENGTH, MODULUS, None, out) == 1
        loads.append(float(out[0]))
    assert loads[:2] == [0.0, 0.0]
    assert np.all(np.diff(loads[1:]) > 0.0)


def test_films_of_lines() -> None:
    """Compare `film_thickness`, `moes-line` and `dowson-toyoda`, by hand.

    A roller of the 32216: 70 N/mm, 5.5 m/s, 0.05 Pa s; Dowson and Toyoda by hand.
    """
    moes, toyoda = outputs(2), outputs(2)
    given = (5.5, 1.0, 70e3 * LENGTH, RADIUS, LENGTH, MODULUS, 0.05, 20e-9)
    line_contact.moes_line(*given, FLOORS, moes)
    line_contact.dowson_toyoda(*given, FLOORS, toyoda)
    u, g, w = 0.05 * 5.5 / (MODULUS * RADIUS), 20e-9 * MODULUS, 70e3 / (MODULUS * RADIUS)
    Published(3.06 * RADIUS * u**0.69 * g**0.56 * w**-0.10, "Dowson and Toyoda 1979", "floors", rel=1e-6).check(
        toyoda[0]
    )
    Published(2.65 * RADIUS * u**0.70 * g**0.54 * w**-0.13, "Dowson 1968", "floors", rel=1e-6).check(toyoda[1])
    Published(float(toyoda[0]), "Dowson and Toyoda 1979", "two fits to solved contacts", rel=0.15).check(moes[0])
    assert 0.7 < moes[1] / moes[0] < 1.0
    along = outputs(2)
    line_contact.moes_line(5.5, 0.0, *given[2:], FLOORS, along)
    assert along[0] < 1e-3 * moes[0]  # entrainment along the line makes no film


def test_rolling_resistance_of_a_light_line_is_dowson_and_higginsons() -> None:
    """Compare `rolling_resistance`, `biboulet-houpert-line` with Dowson and Higginson."""
    # 4.58 eta u sqrt(R/h) on each surface with Martin's h = 4.9 eta u R/w (Dowson and Higginson 1966)
    out, load, speed, eta = outputs(1), 5.0, 3.0, 0.05
    line_contact.biboulet_houpert_line(
        speed, load, 0.5 * LENGTH, 1e-6, RADIUS, LENGTH, MODULUS, eta, 20e-9, 0.04, 0.13, INLET, out
    )
    film = 4.9 * eta * speed * RADIUS / (load / LENGTH)
    by_hand = 4.58 * eta * speed * math.sqrt(RADIUS / film) * LENGTH
    Published(by_hand, "Dowson and Higginson 1966", "the fit joins three regimes", rel=0.05).check(out[0])


@pytest.mark.parametrize(
    ("law", "factor", "scale", "flow", "material", "load", "source"),
    [
        ("matsuyama-line", 7.1, 1.0, 0.75, -0.04, 0.08, "Manjunath et al. 2023, Machines 11, 801, table 1"),
        ("zhou-hoeprich-line", 29.2, 0.0, 0.648, 0.648, 0.246, "Zhou and Hoeprich 1991, J. Tribol. 113, 590, eq. 17"),
        ("aihara-line", 88.0, 0.0, 0.658, 0.658, 0.31, "Aihara 1987, J. Tribol. 109, 471, second-hand"),
    ],
)
def test_rolling_resistance_of_a_line_by_published_fits(
    law: str, factor: float, scale: float, flow: float, material: float, load: float, source: str
) -> None:
    """Compute `rolling_resistance` of lines by hand.

    The laws of the quasi-static answer are the same.

    c U^a G^b W^m in E' R, or in R/alpha where `scale` is 0.
    """
    out, force, speed, eta, alpha = outputs(1), 4e3, 5.0, 0.05, 20e-9
    evaluated = getattr(line_contact, law.replace("-", "_"))
    evaluated(speed, force, 0.5 * LENGTH, 1e-4, RADIUS, LENGTH, MODULUS, eta, alpha, 0.04, 0.13, INLET, out)
    U, W, G = eta * speed / (MODULUS * RADIUS), force / LENGTH / (MODULUS * RADIUS), alpha * MODULUS
    by_hand = factor * (MODULUS if scale else 1.0 / alpha) * RADIUS * U**flow * G**material * W**load * LENGTH
    Published(by_hand, source, "digits; the floor of the speed", rel=1e-6).check(out[0])
    given = (force / LENGTH, RADIUS, speed, eta, alpha, MODULUS)
    assert out[0] == pytest.approx(float(ROLLING_LAWS[law](*given)) * LENGTH, rel=1e-6)  # as at rest
    assert 0.5 < out[0] / (float(ROLLING_LAWS["biboulet-houpert-line"](*given)) * LENGTH) < 1.1


def test_hysteresis_is_the_work_on_the_front_half() -> None:
    """Compare `elastic_hysteresis`, `johnson-line` with its work."""
    # the pressure of the front half about the middle: int_0^b x p dx
    out, width = outputs(1), 1e-4
    line_contact.johnson_line(1e3, 0.5 * LENGTH, width, RADIUS, LENGTH, 8e-3, LossFactor(loss_factor=0.02), out)
    peak = 2.0 * 1e3 / (math.pi * width)
    moment = quad(lambda x: x * peak * math.sqrt(1.0 - (x / width) ** 2), 0.0, width)[0]
    Published(0.02 * moment, "Johnson 1985, section 9.2", "quadrature", rel=1e-6).check(out[0])


def test_squeezed_film_of_a_cylinder() -> None:
    """Compare `damping`, `squeeze-line` with a cylinder's film."""
    context = replace(trial_context("ball_inner"), radius_x=RADIUS, radius_y=LENGTH)
    par = line_contact.prepare_line_film(SqueezeFilm(), context)
    out, eta, speed, gap = outputs(1), 0.05, 1e-3, 3e-6
    line_contact.squeeze_line(-gap, speed, 0.0, 0.0, RADIUS, LENGTH, eta, 20e-9, par, out)

    def pressure(x: float, rest: float) -> float:
        return 6.0 * eta * speed * RADIUS / (rest + 0.5 * x * x / RADIUS) ** 2

    film, room = par.touch + gap, par.touch + par.reach
    force = [quad(pressure, -0.05, 0.05, args=(rest,), points=(0.0,), limit=200)[0] for rest in (film, room)]
    reason = "the integral to 50 mm"
    Published((force[0] - force[1]) * LENGTH, "Reynolds' equation, integrated", reason, rel=0.01).check(out[0])
    pulled = outputs(1)
    line_contact.squeeze_line(1e-6, -10.0, 5.0, 1e-5, RADIUS, LENGTH, eta, 20e-9, par, pulled)
    assert pulled[0] == -5.0  # a film does not pull


def test_bars_and_ends_of_a_pocket() -> None:
    """Compare `cage_contact`, `roller-pocket` at bars and ends.

    k (e - e_0/2) beyond the play, at the roller's radius; ends at its axis.
    """
    context = trial_context("ball_cage")
    par = roller_pocket.prepare_roller(
        RollerPocket(film_width=0.0, end_clearance="0.4 mm", mu_s=0.0, mu_d=0.0), context
    )
    still, out = np.zeros(3), outputs(6)
    play, over, radius = 0.5 * context.pocket_clearance, 3e-6, 0.5 * context.ball_diameter
    push = 5e6 * (over - 0.25e-6)
    roller_pocket.roller_pocket(np.array([0.0, 0.0, -play - over]), still, still, 0.05, par, out)
    assert out[:3] == pytest.approx([0.0, 0.0, push])
    assert out[3:] == pytest.approx([0.0, 0.0, -play - over - radius])
    roller_pocket.roller_pocket(np.array([0.2e-3 + over, 0.0, 0.0]), still, still, 0.05, par, out)
    assert out == pytest.approx([-push, 0.0, 0.0, 0.2e-3 + over, 0.0, 0.0])
    both = outputs(6)
    roller_pocket.roller_pocket(np.array([0.2e-3 + over, 0.0, play + over]), still, still, 0.05, par, both)
    assert both[:3] == pytest.approx([-push, 0.0, -push])
    assert play + over < both[5] < play + over + radius
    aside = outputs(6)  # bars are round: they hold the cage along the radius, too
    way = (play + over) / math.sqrt(2.0)
    roller_pocket.roller_pocket(np.array([0.0, way, way]), still, still, 0.05, par, aside)
    assert aside[:3] == pytest.approx([0.0, -push / math.sqrt(2.0), -push / math.sqrt(2.0)])
    assert math.hypot(aside[4], aside[5]) == pytest.approx(play + over + radius)


def test_a_bar_squeezes_oil_as_a_cylinder_does() -> None:
    context = trial_context("ball_cage")
    par = roller_pocket.prepare_roller(RollerPocket(), context)
    radius, play, gap, speed = 0.5 * context.ball_diameter, 0.5 * context.pocket_clearance, 20e-6, 0.01
    reduced = 1.0 / (1.0 / radius - 1.0 / (radius + play))  # a cylinder in a round bar

    def pressure(x: float) -> float:
        h = gap + par.touch + 0.5 * x * x / reduced
        return 6.0 * 0.05 * speed * reduced * (h**-2 - end**-2)

    width = 0.2 * context.ball_diameter
    end = gap + par.touch + 0.5 * width * width / reduced
    total = quad(pressure, -width, width, points=(0.0,))[0] * context.cage_width
    found = roller_pocket.squeezed_line(par, gap, speed, 0.05)
    Published(total, "Reynolds' equation, integrated", "closed form", rel=1e-6).check(found)
    assert roller_pocket.squeezed_line(par, gap, -speed, 0.05) == 0.0


def test_two_rollers_push_rub_and_squeeze() -> None:
    """Compare `cage_contact`, `roller-roller` by hand.

    k (e - e_0/2) once the axes are a diameter apart, mu times it, and a film before.
    """
    context = replace(trial_context("ball_ball"), radius_y=LENGTH)
    par = roller_pocket.prepare_pair(Neighbours(mu_s=0.08, mu_d=0.05), context)
    diameter, over, still, out = context.ball_diameter, 3e-6, np.zeros(3), outputs(6)
    push, spin = 5e6 * (over - 0.25e-6), np.array([200.0, 0.0, 0.0])
    place = np.array([0.0, 0.0, over - diameter])
    # the surface of the other moves as fast the other way: twice the spin against the frame that turns with it
    roller_pocket.roller_roller(place, np.cross(-spin, place), 0.0 * spin, 0.05, par, out)
    assert out == pytest.approx([0.0, 0.05 * push, -push, 0.0, 0.0, over - 0.5 * diameter])
    roller_pocket.roller_roller(np.array([1e-3, -diameter - 1e-6, 0.0]), still, spin, 0.05, par, out)
    assert not out.any()
    gap, speed = 20e-6, 0.01
    apart, closing = np.array([0.0, diameter + gap, 0.0]), np.array([0.0, -speed, 0.0])
    roller_pocket.roller_roller(apart, closing, still, 0.05, par, out)
    width = 0.2 * diameter

    def pressure(x: float) -> float:
        end, h = (gap + par.touch + 2.0 * at * at / diameter for at in (width, x))
        return 6.0 * 0.05 * speed * 0.25 * diameter * (h**-2 - end**-2)

    total = quad(pressure, -width, width, points=(0.0,))[0] * LENGTH
    Published(total, "Reynolds' equation, integrated", "closed form", rel=1e-6).check(out[1])


@pytest.mark.parametrize("film", [2e-8, 0.5e-6])
@pytest.mark.parametrize("width", [0.0, 1e-8, 1e-7, 5e-6, 5e-5, 2e-4])
def test_capacitance_of_the_gap(width: float, film: float) -> None:
    """Compare `capacitance`, `line-gap` with Hertz's gap.

    Its integral is continuous from no load on; the flat is given.
    """
    out, vacuum = outputs(1), 8.8541878128e-12
    line_contact.line_gap(1e-10, film, 0.5 * LENGTH, width, RADIUS, LENGTH, 0.0, 0.0, 0.0, 2.2, None, out)

    def gap(x: float) -> float:
        if width == 0.0:
            return film + x * x / (2.0 * RADIUS)
        xi = x / width
        return film + width**2 / (2.0 * RADIUS) * (xi * math.sqrt(xi * xi - 1.0) - math.acosh(xi))

    places = [width, *(width + step for step in (1e-6, 1e-5, 1e-4, 1e-3)), RADIUS]
    side = sum(quad(lambda x: 1.0 / gap(x), *ends, limit=400)[0] for ends in itertools.pairwise(places))
    Published(1e-10 + 2.0 * vacuum * 2.2 * LENGTH * side, "quadrature", "Simpson's rule", rel=1e-4).check(out[0])


@pytest.mark.parametrize(("rpm", "level"), [(500.0, 0.0), (3000.0, 4e-3), (6000.0, -2e-3)])
def test_drag_of_rollers_is_that_of_the_catalogue(rpm: float, level: float) -> None:
    """Compare `fluid_drag`, `skf-rollers` with the catalogue.

    At kinematic speeds the rollers lose SKF's torque times the speed, on average.

    The torque by hand for H = level + D/2 of an NU 208, d 40, D 80, B 18 mm; the catalogue's V_M from the chart.
    """
    context = replace(
        trial_context("fluid_drag"), ball_count=14, ball_diameter=11e-3, pitch_diameter=60.5e-3, bore_diameter=40e-3,
        outside_diameter=80e-3, width=18e-3, lubrication="oil bath", oil_level=level,
    )  # fmt: skip
    par = roller_drag.prepare(roller_drag.SkfRollers(), context)
    speed, nu, out = rpm * math.pi / 30.0, 30e-6, np.zeros(2)
    gamma = 11.0 / 60.5
    orbit, spin = 0.25 * (1.0 - gamma) * speed * 60.5e-3, 0.5 * speed * (1.0 - gamma) / gamma
    azimuths, power = np.linspace(-math.pi, math.pi, 2000, endpoint=False), 0.0
    for azimuth in azimuths:
        roller_drag.skf_rollers(orbit, spin, float(azimuth), nu, 870.0, par, out)
        power += (out[0] * orbit + out[1] * spin) * 14.0 / azimuths.size
    height = 1e3 * level + 5.5
    slim = 5.0 * 0.65 * 18.0 / 60.0
    width_factor = 2.789e-10 * slim**3 - 2.786e-4 * slim**2 + 0.0195 * slim + 0.6439
    square = 4.0 * drag_volume(height / 60.0) * 0.65 * 5.1 * 3.0 * 1e-12 * width_factor * 18.0 * 60.0**4 * rpm**2
    t = 2.0 * math.acos((36.0 - height) / 36.0)
    reynolds = rpm * 3600.0 * math.sin(0.5 * t) / (1e6 * nu)
    churned = 1.093e-7 * rpm**2 * 60.0**3 * reynolds**-1.379 * 0.36 * 3600.0 * (t - math.sin(t)) * 0.05 * 5.1 * 3.0
    Published(1e-3 * (square + churned), "SKF 2018, Friction", "formula by hand", rel=2e-3).check(power / speed)


def test_each_role_has_a_line_default() -> None:
    from lambda_core.discovery.manager import registry

    for role, name in DEFAULT_LINE_MODELS.items():
        found: Law = registry().model(role, name)
        assert found.contact == "line"
    assert law_of(line_contact.iso_line).contact == "line"  # type: ignore[union-attr]
