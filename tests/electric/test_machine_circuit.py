"""Test several bearings of a shaft in one circuit.

Parallel combination, an independent solution, energy and charge.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from electric.networks import ROUGH, SMOOTH, residuals, steady, strength, switching, turning
from scipy.integrate import solve_ivp

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.circuit import impedance, rotor_capacitance, voltage_ratio
from lambda_core.analysis.electric.circuit_integrator import Circuit, Films, Surroundings, integrate, joined
from lambda_core.analysis.electric.simulation import at_common_times
from lambda_core.domain.arrays import FloatArray

BARE, COATED = Surroundings(5e-12), Surroundings(8e-12, coating=600e-12, bridge=1e-8)


@pytest.mark.parametrize("count", [1, 2, 5])
def test_equal_bearings_are_capacitances_in_parallel(count: int) -> None:
    """Compare with U/V = C_w/(C_w + C_rf + n C_b).

    Nothing leaks and nothing breaks down; every bearing has the same ratio.
    """
    circuit = Circuit(50e-12, 800e-12, (BARE,) * count)
    films, source = steady(300e-12, 500e-12, balls=4), switching(2e-3)
    found = integrate([films] * count, circuit, [SMOOTH] * count, source, window=(0.0, 1.0))
    each = 4 * 300e-12 * 500e-12 / 800e-12 + 5e-12
    expected = 50e-12 / (850e-12 + count * each) * found.trace[:, 1]
    for column in range(L.N_TRACE, L.N_TRACE + count + 1):
        np.testing.assert_allclose(found.trace[:, column], expected, rtol=1e-9, atol=1e-9)
    ratio = voltage_ratio(circuit, [each - 5e-12] * count, count - 1)
    assert ratio == pytest.approx(50e-12 / rotor_capacitance(circuit, [each - 5e-12] * count), rel=1e-12)
    assert expected[-1] == pytest.approx(ratio * found.trace[-1, 1], rel=1e-9)


def test_a_second_bearing_that_moves_alike_is_a_twin() -> None:
    """Compare two bearings with one that has `twins`.

    They are equal while films do not leak and hold.
    """
    films, source = turning(leak=0.0), switching(0.02)
    twin = integrate([films], Circuit(50e-12, 800e-12, (BARE,), twins=1.0), [SMOOTH], source)
    both = integrate([films, films], Circuit(50e-12, 800e-12, (BARE, BARE)), [SMOOTH] * 2, source)
    np.testing.assert_allclose(both.extremes[:, 0], twin.extremes[:, 0], rtol=1e-9)
    np.testing.assert_allclose(both.extremes[:, 0], both.extremes[:, 1], rtol=1e-9)


def _nodes(films: list[Films], circuit: Circuit) -> tuple[FloatArray, FloatArray]:
    """Return C and G of all nodes.

    Rotor, insulated outer rings and balls, branch by branch, for films that do not change.
    """
    rings = {b: 1 + k for k, b in enumerate(b for b, s in enumerate(circuit.bearings) if s.insulated)}
    n = 1 + len(rings) + sum(each.film.shape[1] for each in films)
    c, g = np.zeros((n, n)), np.zeros((n, n))

    def branch(one: int, other: int | None, capacitance: float, conductance: float) -> None:
        for matrix, value in ((c, capacitance), (g, conductance)):
            matrix[one, one] += value
            if other is not None:
                matrix[other, other] += value
                matrix[one, other] -= value
                matrix[other, one] -= value

    branch(0, None, circuit.winding + circuit.rotor, circuit.brush)
    ball = 1 + len(rings)
    for b, (each, around) in enumerate(zip(films, circuit.bearings, strict=True)):
        outer = rings.get(b)
        branch(0, outer, around.rings, 0.0)
        if outer is not None:
            branch(outer, None, around.coating, around.bridge)
        for j in range(each.film.shape[1]):
            for side, ring in enumerate((0, outer)):
                branch(ball, ring, each.capacitance[0, j, side], each.conductance[0, j, side])
            ball += 1
    return c, g


@pytest.mark.parametrize("second", [BARE, COATED], ids=["bare", "insulated"])
def test_two_unequal_bearings_against_an_independent_solution(second: Surroundings) -> None:
    """Solve the circuit by scipy's DOP853 for comparison.

    The comparison goes branch by branch, at every corner of the source.
    """
    films = [steady(200e-12, 300e-12, balls=3, leak=4e-7), steady(80e-12, 120e-12, balls=2, leak=1e-7)]
    circuit = Circuit(50e-12, 800e-12, (BARE, second), brush=1e-6)
    times, volts = switching(1e-3, rise=2e-6)
    found = integrate(films, circuit, [SMOOTH] * 2, (times, volts), window=(0.0, 1.0))
    c, g = _nodes(films, circuit)
    fed = np.zeros(len(c))
    fed[0] = circuit.winding
    state, expected = np.linalg.solve(c, fed * volts[0]), {0.0: 0.0}
    expected[0.0] = float(state[0])
    rows = found.trace[found.trace[:, 0] <= times[-1]]
    at = rows[:, 0]
    voltages = [[state[0], state[0] - (state[1] if second.insulated else 0.0)]]
    for begin, end in pairwise(at):
        if end > begin:
            slope = float(np.diff(np.interp([begin, end], times, volts))[0] / (end - begin))
            drive, inverse = np.linalg.solve(c, fed * slope), np.linalg.solve(c, g)
            solved = solve_ivp(
                lambda _, v, drive=drive, inverse=inverse: drive - inverse @ v,
                (begin, end), state, method="DOP853", rtol=1e-11, atol=1e-11,
            )  # fmt: skip
            state = solved.y[:, -1]
        voltages.append([state[0], state[0] - (state[1] if second.insulated else 0.0)])
    got = rows[:, [L.N_TRACE, L.N_TRACE + 1]]
    scale = np.abs(got).max()
    assert scale > 1.0
    assert np.abs(got - np.array(voltages)).max() < 1e-8 * scale
    np.testing.assert_array_equal(rows[:, L.N_TRACE], rows[:, -1])  # the shaft stands on the bare bearing


@pytest.mark.parametrize("second", [BARE, COATED, Surroundings(5e-12, 1e-9, 1e-9, 4e-12, 2e-12, 3e-12)])
def test_energy_and_charge_balance_through_discharges(second: Surroundings) -> None:
    """Break films of both bearings down.

    One bearing is insulated or has a metal cage.
    """
    films = [turning(film=0.4e-6), turning(film=0.3e-6)]
    circuit, source = Circuit(50e-12, 900e-12, (BARE, second), brush=1e-8), switching(0.02)
    found = integrate(films, circuit, [ROUGH, strength(roughness=0.05e-6)], source, seed=5)
    first, other = found.of(0), found.of(1)
    assert len(first.events) > 50
    assert len(first.events) + len(other.events) == len(found.events)
    assert max(map(abs, residuals(first, circuit, source))) < 1e-9
    assert first.arc_energy + other.arc_energy == pytest.approx(found.total[L.T_ARC], rel=1e-9)
    assert set(other.events[:, L.E_BALL]) <= set(range(9))


def test_the_thinner_film_takes_the_discharges() -> None:
    """Double the voltage that one bearing's films hold.

    That bearing never sees this voltage: the other one has discharged the shaft before.
    """
    films = [turning(film=0.2e-6), turning(film=0.8e-6)]
    circuit, source = Circuit(50e-12, 900e-12, (BARE, BARE)), switching(0.02)
    found = integrate(films, circuit, [SMOOTH] * 2, source)
    assert len(found.of(0).events) > 20
    assert len(found.of(1).events) == 0
    swapped = integrate(films[::-1], circuit, [SMOOTH] * 2, source)
    assert len(swapped.of(1).events) == len(found.of(0).events)


def test_an_insulated_bearing_leaves_the_voltage_to_the_other() -> None:
    """Break equal films down in the bare bearing only.

    The coating takes most of the voltage.
    """
    films = [turning(film=0.3e-6)] * 2
    circuit = Circuit(50e-12, 900e-12, (BARE, Surroundings(5e-12, coating=30e-12, bridge=1e-12)))
    found = integrate(films, circuit, [SMOOTH] * 2, switching(0.02))
    assert len(found.of(0).events) > 20
    assert len(found.of(1).events) == 0
    ratio = [voltage_ratio(circuit, [180e-12, 180e-12], b) for b in (0, 1)]
    assert ratio[1] < 0.2 * ratio[0]


def test_first_bearing_is_drawn_as_if_it_were_alone() -> None:
    """Add a second bearing behind a tiny capacitance.

    Random numbers are keyed by ball, so that nothing changes in the first bearing.
    """
    films, source = turning(film=0.4e-6), switching(0.02)
    far = Surroundings(0.0, coating=1e-20, bridge=1e-20)
    tiny = replace(steady(1e-20, 1e-20, stop=0.02), time=films.time[[0, 20, 40]])
    alone = integrate([films], Circuit(50e-12, 900e-12, (BARE,)), [ROUGH], source, seed=2)
    pair = integrate(at_common_times([films, tiny]), Circuit(50e-12, 900e-12, (BARE, far)), [ROUGH] * 2, source, seed=2)
    assert len(alone.events) == len(pair.of(0).events)
    np.testing.assert_allclose(pair.of(0).events[:, L.E_ENERGY], alone.events[:, L.E_ENERGY], rtol=1e-6)


def test_films_at_common_times() -> None:
    """Interpolate films linearly between samples.

    Where a film is missing at one end, there is none between.
    """
    one, other = steady(1e-12, 2e-12, film=0.4e-6), steady(3e-12, 4e-12, film=0.4e-6)
    one.film[2], one.capacitance[1] = 0.0, 5e-12
    other = replace(other, time=other.time * 0.75)
    found, _ = at_common_times([one, other])
    np.testing.assert_allclose(found.time, [0.0, 0.75e-3, 1e-3, 1.5e-3])
    np.testing.assert_allclose(found.film[:, 0, 0], [0.4e-6, 0.4e-6, 0.4e-6, 0.0])
    np.testing.assert_allclose(found.capacitance[:, 0, 0], [1e-12, 4e-12, 5e-12, 3e-12])
    assert joined([found, found]).film.shape == (4, 2, 2)


def test_impedance_is_that_of_one_bearing() -> None:
    films = steady(200e-12, 300e-12, balls=3)
    value = impedance(films, BARE, np.array([1e5]))[0, 0]
    assert abs(value) == pytest.approx(1.0 / (2e5 * np.pi * (3 * 120e-12 + 5e-12)), rel=1e-12)
