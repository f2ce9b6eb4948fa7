"""Test films that are squeezed before bodies touch.

Reynolds' equation solved on a grid, limits in print, blows.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from lambda_plugins.damping import SqueezeFilm, prepare_film
from scipy.sparse import csr_matrix, diags_array
from scipy.sparse.linalg import spsolve

from lambda_core.export.fmu.curves import constants
from lambda_core.export.fmu.varied import Varied
from lambda_core.laws.probe import trial_context
from lambda_core.testing import evaluate

from .published import Published

R_X, R_Y, ETA, SPEED = 3e-3, 4.8e-2, 0.03, 0.02
LAYER, TOUCH = 8e-6, 1e-6
RACEWAY = {"layer": "8 um", "thinnest_film": "1 um", "time_constant": "0 s"}


def raceway_force(gap: float, *, layer: str = "8 um", radii: tuple[float, float] = (R_X, R_Y), **given: float) -> float:
    """Return the film's force on a ball [N].

    A slow bearing, so that the film at first touch is the roughness.
    """
    context = dataclasses.replace(trial_context("ball_inner"), speed=1e-6, radius_x=radii[0], radius_y=radii[1])
    inputs: dict[str, Any] = {"delta": -gap, "delta_dot": SPEED, "load": 0.0, "semi_a": 0.0, "semi_b": 0.0}
    inputs |= {"eta0": ETA, "alpha_p": 2e-8, "R_x": radii[0], "R_y": radii[1], **given}
    return float(evaluate("damping/squeeze-film", RACEWAY | {"layer": layer}, context, **inputs)[0])


def reynolds(h0: float, edge: float, r_x: float, r_y: float) -> float:
    """Return a film's force by finite volumes [N].

    Between paraboloids; it ends where the gap is `edge`.
    """
    n = 160
    a, b = math.sqrt(2.0 * r_x * (edge - h0)), math.sqrt(2.0 * r_y * (edge - h0))
    x, dx = np.linspace(-a, a, n, retstep=True)
    y, dy = np.linspace(-b, b, n, retstep=True)

    def gap(p: Any, q: Any) -> Any:
        return h0 + p[:, None] ** 2 / (2.0 * r_x) + q[None, :] ** 2 / (2.0 * r_y)

    inside = gap(x, y) < edge
    number = -np.ones((n, n), dtype=int)
    number[inside] = np.arange(inside.sum())
    rows, columns, values = [], [], []
    for along, (step, shift) in enumerate(((dx, (1, 0)), (dy, (0, 1)))):
        for sign in (1, -1):
            half = 0.5 * sign * step
            flow = (gap(x + half, y) if along == 0 else gap(x, y + half)) ** 3 / step**2
            neighbour = np.roll(number, (-sign * shift[0], -sign * shift[1]), axis=(0, 1))
            here = number[inside]
            rows += [here, here[neighbour[inside] >= 0]]
            columns += [here, neighbour[inside][neighbour[inside] >= 0]]
            values += [-flow[inside], flow[inside][neighbour[inside] >= 0]]
    matrix = csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))))
    pressure = spsolve(matrix.tocsc(), np.full(int(inside.sum()), -12.0 * ETA * SPEED))
    return float(pressure.sum() * dx * dy)


@pytest.mark.parametrize("gap", [0.0, 2e-6])
def test_film_of_a_raceway_against_reynolds_equation(gap: float) -> None:
    """Compare a film with Reynolds' equation to 3 %.

    A grid of 160 x 160 on an ellipse whose edge goes through its cells.
    """
    expected = reynolds(TOUCH + gap, TOUCH + LAYER, R_X, R_Y)
    Published(expected, "Reynolds 1886, finite volumes", "grid", rel=0.03).check(raceway_force(gap))


def test_a_sphere_near_a_flooded_plane() -> None:
    """Compare with 6 pi eta R^2 v/h.

    The oil reaches far (Taylor; Cox and Brenner 1967); the edge takes 2 h/H = 2e-3.
    """
    found = raceway_force(0.0, layer="1 mm", radii=(R_X, R_X))
    expected = 6.0 * math.pi * ETA * R_X**2 * SPEED / TOUCH
    Published(expected, "Cox and Brenner 1967, Chem. Eng. Sci. 22, 1753, leading term", "edge", rel=3e-3).check(found)


def test_a_film_pushes_only_and_flows_no_more_under_pressure() -> None:
    assert raceway_force(1e-6, delta_dot=-SPEED) == 0.0
    assert raceway_force(1.01 * LAYER - 1e-9) == pytest.approx(0.0, abs=1e-3 * raceway_force(0.0))
    loaded = {"load": 10.0, "semi_a": 1e-4, "semi_b": 5e-5}
    share = raceway_force(-1e-9, **loaded) / raceway_force(0.0)
    assert share == pytest.approx(math.exp(-2e-8 * 1.5 * 10.0 / (math.pi * 5e-9)), rel=1e-6)


def pocket_out(gap: float, width: float, name: str, context: Any = None, *, eta: float = ETA, slip: Any = 0.0) -> Any:
    """Return the force on a closing ball.

    Along the tangent, `gap` from the pocket's wall.
    """
    context, n = context or trial_context("ball_cage"), np.array([0.0, 0.0, 1.0])
    place: Any = (0.5 * context.pocket_clearance - gap) * n
    return evaluate(
        f"cage_contact/{name}", {"film_width": width, "thinnest_film": "1 um"}, context, r=place,
        v_rel=SPEED * n + slip, omega_rel=np.zeros(3), eta0=eta,
    )  # fmt: skip


def pocket_force(gap: float, width: float, name: str = "spherical-pocket", context: Any = None) -> float:
    return float(-pocket_out(gap, width, name, context)[2])


@pytest.mark.parametrize("rpm", [100.0, 500.0, 1000.0, 2750.0])
def test_a_film_follows_the_oils_temperature_without_a_bend(rpm: float) -> None:
    """Follow the oil's temperature without a bend.

    From a thick film to one below the roughness, ISO VG 68 by Vogel: curves of an FMU reach 1e-8.
    """
    oil = Varied("lubricant.temperature", "temperature", 293.15, 313.15, 363.15)
    context = dataclasses.replace(trial_context("ball_inner"), speed=rpm * math.pi / 30.0, mean_load=550.0)

    def sample(values: Mapping[str, float]) -> Any:
        viscosity = 6.3e-5 * math.exp(879.0 / (values.get(oil.path, oil.start) - 178.15))
        return np.array(prepare_film(SqueezeFilm(), at(viscosity)))

    def at(viscosity: float) -> Any:
        return dataclasses.replace(context, oil=dataclasses.replace(context.oil, viscosity=viscosity))

    assert [c.word for c in constants([oil], sample({}), sample)] == [3]


def pocket_reynolds(ball: float, play: float, h0: float, half_wall: float) -> float:
    """Return the relative force of a bore [m].

    Force over viscosity and speed of a ball, with a wall of `half_wall` on either side.

    Finite volumes on a quarter of the ball, a circular bore unrolled to a quarter turn, cells finer to the middle.
    """
    n = (40, 30)
    s, x = 0.5 * math.pi * ball * np.linspace(0.0, 1.0, n[0] + 1) ** 2, half_wall * np.linspace(0.0, 1.0, n[1] + 1) ** 3
    ds, dx, p, q = np.diff(s), np.diff(x), 0.5 * (s[1:] + s[:-1]), 0.5 * (x[1:] + x[:-1])

    def cubed(arc: Any, place: Any) -> Any:
        return (h0 + play * (1.0 - np.cos(arc[:, None] / ball)) + place[None, :] ** 2 / (2.0 * ball)) ** 3

    round_it = cubed(s[1:], q) * dx / np.append(np.diff(p), s[-1] - p[-1])[:, None]  # the last to the edge, p = 0
    along = cubed(p, x[1:]) * ds[:, None] / np.append(np.diff(q), x[-1] - q[-1])
    own = round_it + along
    own[1:] += round_it[:-1]
    own[:, 1:] += along[:, :-1]
    along[:, -1] = 0.0  # no neighbour beyond the row's end
    across, neighbour = round_it[:-1].ravel(), along.ravel()[:-1]
    matrix = diags_array([own.ravel(), -across, -across, -neighbour, -neighbour], offsets=[0, n[1], -n[1], 1, -1])
    closing = np.cos(p / ball)[:, None] * ds[:, None] * dx
    return float(4.0 * closing.ravel() @ spsolve(matrix.tocsc(), 12.0 * closing.ravel()))


@pytest.mark.parametrize(("play", "gap", "most"), [(100e-6, 0.0, 1.05), (100e-6, 2e-6, 1.10), (200e-6, 20e-6, 1.20)])
def test_film_of_a_cylindrical_pocket_against_reynolds_equation(play: float, gap: float, most: float) -> None:
    """Compare a cylindrical pocket with Reynolds' equation.

    Above by 4, 9 and 18 %: the bore closes round the ball by play (1 - cos), less than the parabola opens it.

    The paraboloid's force comes from further round the ball the wider the gap, where the bore meets it obliquely. With
    the sphere's radius along the axis the law would be 200, 140 and 20 times as much.
    """
    context = dataclasses.replace(trial_context("ball_cage"), ball_diameter=11.9e-3, pocket_clearance=2.0 * play)
    expected = ETA * SPEED * pocket_reynolds(5.95e-3, play, gap + 1e-6, 0.2 * 11.9e-3)
    assert 1.0 < pocket_force(gap, 0.2, "cylindrical-pocket", context) / expected < most


def test_film_of_a_spherical_pocket_against_its_pressure() -> None:
    """Integrate the pressure of a spherical pocket.

    p = 3 eta v R (1/h^2 - 1/h_e^2) over the film's width, 2000 rings.
    """
    context, gap, width = trial_context("ball_cage"), 3e-6, 0.2
    ball, play = 0.5 * context.ball_diameter, 0.5 * context.pocket_clearance
    radius, edge = ball * (ball + play) / play, width * context.ball_diameter
    r = (np.arange(2000) + 0.5) * edge / 2000
    h, h_edge = gap + 1e-6 + r**2 / (2.0 * radius), gap + 1e-6 + edge**2 / (2.0 * radius)
    pressure = 3.0 * ETA * SPEED * radius * (1.0 / h**2 - 1.0 / h_edge**2)
    expected = float((pressure * 2.0 * math.pi * r).sum() * edge / 2000)
    Published(expected, "Reynolds 1886 between sphere and plane", "quadrature", rel=1e-4).check(
        pocket_force(gap, width)
    )


def test_a_narrow_film_is_that_of_parallel_discs() -> None:
    """Compare with discs: 3 pi eta v b^4/(2 h^3).

    The gap grows by 1 % up to the film's edge.
    """
    context = trial_context("ball_cage")
    ball, play = 0.5 * context.ball_diameter, 0.5 * context.pocket_clearance
    radius, h = ball * (ball + play) / play, 11e-6
    edge = math.sqrt(2.0 * radius * 0.01 * h)
    expected = 1.5 * math.pi * ETA * SPEED * edge**4 / h**3
    found = pocket_force(h - 1e-6, edge / context.ball_diameter)
    Published(expected, "Stefan 1874, parallel discs", "curvature", rel=0.03).check(found)


@pytest.mark.parametrize(("law", "least", "most"), [("squeeze-film", -0.05, 0.05), ("cubic", 0.8, 1.0)])
def test_an_oiled_ball_does_not_rebound(law: str, least: float, most: float) -> None:
    """Compare rebounds with Gondret et al. 2002.

    Balls rebound from a wetted wall above a Stokes number of 10, from a dry one at any speed.

    A ball of 0.7 g meets a raceway at 20 mm/s from 5 um: m v/(6 pi eta R^2) is 3 of a plane, 0.3 of the groove.
    """
    mass, stiffness, step = 0.7e-3, 1.1e10, 2e-7
    context = dataclasses.replace(trial_context("ball_outer"), speed=100.0, radius_x=R_X, radius_y=R_Y, mean_load=36.0)
    delta, velocity = -5e-6, SPEED
    for _ in range(4000):
        load = stiffness * max(delta, 0.0) ** 1.5
        size = math.sqrt(max(delta, 0.0))
        inputs = {"delta": delta, "delta_dot": velocity, "load": load, "eta0": ETA, "alpha_p": 2e-8}
        inputs |= {"semi_a": 0.3 * size, "semi_b": 0.08 * size}
        velocity -= step * (load + float(evaluate(f"damping/{law}", None, context, **inputs)[0])) / mass
        delta += step * velocity
        if velocity < 0.0 and delta < 0.0:
            break
    assert least <= -velocity / SPEED <= most
