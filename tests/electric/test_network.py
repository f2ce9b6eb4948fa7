"""Test the network against closed forms and its balances."""

from __future__ import annotations

import dataclasses
import math
from itertools import pairwise

import numpy as np
import pytest
from electric.networks import ROUGH, SMOOTH, integrate, one_bearing, residuals, steady, strength, switching, turning

from lambda_core import api
from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.circuit import bearing_capacitance, impedance, surroundings, voltage_ratio
from lambda_core.analysis.electric.circuit_integrator import Circuit, Network, Surroundings
from lambda_core.analysis.electric.contacts import ball_capacitance, contacts_of_equilibria, equilibria, films
from lambda_core.analysis.electric.voltage_sources import corners
from lambda_core.case.electric import Electric, Sine
from lambda_core.domain.errors import SolverError


@pytest.mark.parametrize(("link", "peak"), [(800.0, 16.0), (400.0, 8.0)])
def test_voltage_divider_at_every_edge(link: float, peak: float) -> None:
    """Compare with a bearing voltage ratio of exactly 0.04.

    C_wr 50, C_rf 800, two bearings of 200 pF (Muetze and Binder 2007, definition of BVR).
    """
    circuit = one_bearing(winding=50e-12, rotor=1000e-12)
    source = switching(2e-3, link)
    found = integrate(steady(400e-12, 400e-12), circuit, SMOOTH, source, window=(0.0, 1.0))
    assert voltage_ratio(circuit, [200e-12]) == pytest.approx(0.04, rel=1e-12)
    assert found.trace.shape[0] > 200
    np.testing.assert_allclose(found.trace[:, 2], 0.04 * found.trace[:, 1], rtol=1e-9)
    assert np.abs(found.trace[:, 2]).max() == pytest.approx(peak, rel=1e-9)


def test_discharge_of_the_rotor() -> None:
    """Discharge 1.25 nF at 20 V through 10 Ohm.

    0.25 uJ, 2 A, time constant 12.5 ns.

    Films of next to no capacitance share the voltage and break down at 10 V; two arcs of 5 Ohm in series.
    """
    circuit = one_bearing(winding=50e-12, rotor=1200e-12)
    arcs = strength("field", resistance="5 Ohm", least_current="0.1 uA")
    source = (np.array([0.0, 1.0]), np.array([500.0, 500.0]) * (1.0 + 1e-9))
    found = integrate(steady(1e-20, 1e-20, film=10.0 / 30e6), circuit, arcs, source, window=(0.0, 1.0))
    energy, charge, peak = (found.events[:, c] for c in (L.E_ENERGY, L.E_CHARGE, L.E_PEAK))
    assert energy.sum() == pytest.approx(0.25e-6, rel=1e-6)
    assert charge.max() == pytest.approx(25e-9, rel=1e-6)
    assert peak.max() == pytest.approx(2.0, rel=1e-6)
    burning = found.trace[(found.trace[:, 3] > 0.5) & (found.trace[:, 3] < 1.9)]
    decay = np.diff(burning[:, 0]) / -np.diff(np.log(burning[:, 3]))
    np.testing.assert_allclose(decay, 12.5e-9, rtol=1e-6)
    assert max(map(abs, residuals(found, circuit, source))) < 1e-6


def test_isolated_rotor_keeps_its_charge() -> None:
    """Halve the capacitance and double the voltage.

    The surfaces do the work U Q/2.
    """
    films = steady(400e-12, 400e-12)
    films = dataclasses.replace(films, capacitance=films.capacitance * np.array([1.0, 0.5, 0.5])[:, None, None])
    circuit = one_bearing(winding=1e-21, rotor=0.0)  # brings the charge, and is too small to be seen
    charge = 2e-9
    source = (np.array([0.0, 1.0]), np.full(2, charge / circuit.winding))
    found = integrate(films, circuit, SMOOTH, source, window=(0.0, 1.0))
    first, last = found.trace[0, 2], found.trace[-1, 2]
    assert first == pytest.approx(charge / 200e-12, rel=0.3)  # half an interval after the start
    assert last == pytest.approx(charge / 100e-12, rel=1e-9)
    work = 0.5 * charge * (last - first)
    assert found.total[L.T_MOTION] == pytest.approx(work, rel=1e-9)


def test_full_step_doubles_the_voltage() -> None:
    """Put the step inside one interval.

    Start and end are on either side of it.
    """
    films = steady(400e-12, 400e-12)
    time = np.array([0.0, 1e-3, 1e-3 + 1e-12, 2e-3])
    films = dataclasses.replace(films, time=time, **{
        f.name: np.ones((4, 1, 2)) * getattr(films, f.name)[0] for f in dataclasses.fields(films) if f.name != "time"
    })  # fmt: skip
    films = dataclasses.replace(films, capacitance=films.capacitance * np.array([1.0, 1.0, 0.5, 0.5])[:, None, None])
    source = (np.array([0.0, 1.0]), np.full(2, 2e-9 / 1e-21))
    found = integrate(films, one_bearing(1e-21, 0.0), SMOOTH, source, window=(0.0, 1.0))
    assert found.trace[-1, 2] / found.trace[0, 2] == pytest.approx(2.0, rel=1e-9)
    assert found.total[L.T_MOTION] == pytest.approx(0.5 * found.trace[0, 2] * 2e-9, rel=1e-9)


def test_leak_makes_a_high_pass() -> None:
    """Compare with a high-pass at its corner frequency.

    A resistance across C_tot: |U/V| = BVR w RC/sqrt(1 + (w RC)^2).

    4000 corners per period stand for the sine; their error is (2 pi/4000)^2/12 = 2e-7.
    """
    total, resistance = 1.25e-9, 1e5
    frequency = 1.0 / (2.0 * math.pi * resistance * total)
    periods, points = 6, 4000
    stop = periods / frequency
    circuit = one_bearing(winding=50e-12, rotor=1000e-12, brush=1.0 / resistance)
    source = corners(Sine(amplitude="100 V", frequency=f"{frequency!r} Hz", points=points), 0.0, stop, np.zeros_like)
    begin = (periods - 1) / frequency
    found = integrate(steady(400e-12, 400e-12, stop=stop), circuit, SMOOTH, source, window=(begin, stop))
    time, _, bearing, _ = np.unique(found.trace, axis=0).T
    at = np.isclose(time * frequency * points, np.round(time * frequency * points), rtol=0.0, atol=1e-6)
    time, bearing = time[at][-points:], bearing[at][-points:]
    amplitude = 2.0 * abs(np.mean(bearing * np.exp(-2j * math.pi * frequency * time)))
    assert amplitude == pytest.approx(100.0 * 0.04 / math.sqrt(2.0), rel=1e-6)


CIRCUITS = [
    one_bearing(50e-12, 1000e-12, 5e-12),
    one_bearing(50e-12, 1000e-12, 5e-12, brush=1e-7),
    one_bearing(50e-12, 1000e-12, 5e-12, brush=0.1),
    one_bearing(50e-12, 1000e-12, 5e-12, coating=3e-9, bridge=1e-9),
    one_bearing(50e-12, 1000e-12, 5e-12, coating=3e-9, bridge=1.0),
]


@pytest.mark.parametrize("circuit", CIRCUITS)
@pytest.mark.parametrize("metal", [False, True])
def test_balance_without_arcs(circuit: Circuit, metal: bool) -> None:
    """Balance energy and charge to 1e-9.

    Balls pass, oil leaks, and metal bridges a film at times.
    """
    films = turning()
    if metal:
        films.conductance[10:15, 3, 0] = 1.0
    source = switching(0.02)
    found = integrate(films, circuit, SMOOTH, source)
    assert found.events.shape[0] == 0
    assert max(map(abs, residuals(found, circuit, source))) < 1e-9


@pytest.mark.parametrize("circuit", CIRCUITS)
@pytest.mark.parametrize("fall", [0.0, 0.3])
def test_balance_with_arcs(circuit: Circuit, fall: float) -> None:
    """Balance energy and charge to 1e-8.

    Hundreds of discharges; the requirement is 1e-6.
    """
    films = turning(film=0.55e-6)
    films.conductance[10:15, 3, 0] = 1.0
    films.film[10:15, 3, 0] = 0.0
    source = switching(0.02)
    found = integrate(films, circuit, strength(discharge="arc-voltage", voltage=f"{fall} V"), source, seed=5)
    assert found.events.shape[0] > 100
    assert max(map(abs, residuals(found, circuit, source))) < 1e-8


def test_brush_keeps_the_bearing_quiet() -> None:
    """Ground the shaft by 10 Ohm.

    Only during edges does C_wr dV/dt drive a voltage, at most R C_wr dV/dt.
    """
    source = switching(2e-3)
    found = integrate(
        steady(400e-12, 400e-12), one_bearing(50e-12, 1000e-12, brush=0.1), SMOOTH, source, window=(0.0, 1.0)
    )
    steepest = 800.0 / 3.0 / 50e-9
    assert 0.9 < np.abs(found.trace[2:, 2]).max() / (10.0 * 50e-12 * steepest) <= 1.0


def test_insulation_takes_the_voltage() -> None:
    """Leave C_c/(C_c + C_b) of the voltage to the bearing.

    The coating is in series.
    """
    circuit = one_bearing(50e-12, 1000e-12, coating=50e-12, bridge=1e-15)
    found = integrate(steady(400e-12, 400e-12), circuit, SMOOTH, switching(2e-3), window=(0.0, 1.0))
    expected = voltage_ratio(circuit, [200e-12]) * found.trace[:, 1]
    np.testing.assert_allclose(found.trace[:, 2], expected, rtol=1e-6)
    rotor = 50e-12 / (50e-12 + 1000e-12 + 40e-12)
    assert voltage_ratio(circuit, [200e-12]) == pytest.approx(rotor * 0.2, rel=1e-12)


def test_impedance() -> None:
    """Compare the impedance of one ball and the rings.

    Each film has capacitance and conductance.
    """
    films = steady(100e-12, 50e-12, leak=1e-8)
    omega = 2.0 * math.pi * np.array([1.0, 50.0, 1e6])
    each = [1.0 / (1e-8 + 1j * omega * c) for c in (100e-12, 50e-12)]
    expected = 1.0 / (1.0 / (each[0] + each[1]) + 1j * omega * 5e-12)
    np.testing.assert_allclose(impedance(films, Surroundings(5e-12), omega / (2.0 * math.pi))[0], expected, rtol=1e-12)


def test_same_seed_same_events() -> None:
    """Compare events bit by bit and for another seed."""
    circuit, source = CIRCUITS[0], switching(0.02)
    films = turning(film=0.55e-6)
    first, again, other = (integrate(films, circuit, ROUGH, source, seed=s).events for s in (1, 1, 2))
    assert first.tobytes() == again.tobytes()
    assert first.tobytes() != other.tobytes()


def test_stretches_make_no_difference() -> None:
    """Cut the samples into different stretches.

    Events, extremes and the end have the same bits.
    """
    source, films = switching(0.021), turning(film=0.55e-6)
    for circuit in CIRCUITS[1:4:2]:
        complete = integrate(films, circuit, ROUGH, source, seed=1)
        for cuts in ([0, 1, 2, 40], [0, 13, 40], [0, *range(5, 41, 5)]):
            network = Network(circuit, [ROUGH], [9], seed=1)
            parts = [network.advance(films.part(slice(a, b + 1)), source).of(0) for a, b in pairwise(cuts)]
            events = np.concatenate([part.events for part in parts])
            count = L.E_SAMPLE  # counts from the start of a stretch
            assert events[:, :count].tobytes() == complete.events[:, :count].tobytes()
            assert np.concatenate([part.extremes for part in parts]).tobytes() == complete.extremes.tobytes()
            assert parts[-1].total[L.T_STORED] == complete.total[L.T_STORED]
            assert sum(part.total[L.T_ARC] for part in parts) == pytest.approx(complete.total[L.T_ARC], rel=1e-9)


def test_laws_that_refuse_are_named() -> None:
    """Name an arc that needs more than the film's voltage."""
    law = strength("field", least_current="2 A")
    source = np.array([0.0, 1e-4, 2e-4]), np.array([0.0, 0.0, 800.0])
    with pytest.raises(SolverError, match=r"discharge/resistance.*least current needs more voltage"):
        integrate(steady(100e-12, 200e-12, film=0.4e-6), one_bearing(50e-12, 1000e-12), law, source)


def test_twin_bearing() -> None:
    """Count a twin as one more capacitance.

    This also holds while the capacitance changes.
    """
    films, source = turning(leak=0.0), switching(0.02)
    twin = integrate(films, one_bearing(50e-12, 800e-12, 5e-12, twins=1.0), SMOOTH, source)
    each = films.capacitance[:, :, 0] * films.capacitance[:, :, 1] / films.capacitance.sum(axis=2)
    assert np.ptp(each.sum(axis=1)) < 1e-3 * each.sum(axis=1).mean()  # nine balls pass, their sum hardly changes
    fixed = integrate(films, one_bearing(50e-12, 805e-12 + each.sum(axis=1).mean(), 5e-12), SMOOTH, source)
    np.testing.assert_allclose(twin.extremes, fixed.extremes, rtol=1e-3)
    assert max(map(abs, residuals(twin, one_bearing(50e-12, 800e-12), source))) < 1e-9


def test_cage_between_balls() -> None:
    """Compare potentials with charge balances by hand.

    Two unlike balls at a step of 1 V on the rotor.
    """
    films = steady(100e-12, 50e-12, balls=2)
    films.capacitance[:, 1] = 20e-12, 80e-12
    circuit = one_bearing(1e-6, 1e-15, 0.0, pocket=10e-12, cage_inner=2e-12, cage_outer=3e-12)
    matrix = np.array([[160.0, 0.0, -10.0], [0.0, 110.0, -10.0], [-10.0, -10.0, 25.0]])  # balls, cage
    first, second, cage = np.linalg.solve(matrix, [100.0, 20.0, 2.0])
    complete = 100.0 * (1.0 - first) + 20.0 * (1.0 - second) + 2.0 * (1.0 - cage)
    measured = impedance(films, circuit.bearings[0], np.array([1e5]))[0, 0]
    assert 1e12 / (2.0 * math.pi * 1e5 * abs(measured)) == pytest.approx(complete, rel=1e-12)
    step = np.array([0.0, 1e-4, 1.001e-4, 1.0]), np.array([0.0, 0.0, 1.0, 1.0])
    found = integrate(films, circuit, SMOOTH, step, window=(0.0, 1.0))
    assert found.trace[-1, 2] == pytest.approx(1e6 / (1e6 + 1e-3 + complete), rel=1e-12)
    # A ramp of 1 V into a capacitance takes half of what its charge carries.
    assert found.total[L.T_SOURCE] == pytest.approx(0.5e-12 * complete, rel=1e-3)


def test_cage_balances_with_arcs() -> None:
    circuit = one_bearing(50e-12, 1000e-12, 5e-12, pocket=6e-12, cage_outer=10e-12)
    films, source = turning(stop=0.005, samples=11, film=0.55e-6), switching(0.005)
    found = integrate(films, circuit, ROUGH, source, seed=5)
    assert found.events.shape[0] > 20
    assert max(map(abs, residuals(found, circuit, source))) < 1e-6


def test_balls_that_insulate() -> None:
    """Spread a contact's flux with 4 eps_0 eps_r a.

    A ball of endless permittivity conducts.
    """
    contacts = contacts_of_equilibria(equilibria(api.check("6208-axial-1300"), 1), 1e-3)
    wide = np.maximum(contacts.semi_a, contacts.semi_b)
    circles = dataclasses.replace(contacts, semi_a=wide, semi_b=wide)
    found = ball_capacitance(circles, 8.0)
    np.testing.assert_allclose(found, 4.0 * 8.8541878128e-12 * 8.0 * wide, rtol=1e-12)
    steel = films(contacts, Electric())
    endless = films(contacts, Electric(film={"ball_permittivity": 1e12}))
    ceramic = films(contacts, Electric(film={"ball_permittivity": 8.0}))
    np.testing.assert_allclose(endless.capacitance, steel.capacitance, rtol=1e-6)
    assert ceramic.film.max() == ceramic.conductance.max() == 0.0
    through = ball_capacitance(contacts, 8.0)
    expected = 1.0 / (1.0 / steel.capacitance + 1.0 / through)
    np.testing.assert_allclose(ceramic.capacitance, expected, rtol=1e-12)
    assert bearing_capacitance(ceramic)[0] < 0.02 * bearing_capacitance(steel)[0]


def test_seals_stand_next_to_the_rings() -> None:
    geometry = {"shoulder_diameter_inner": 0.05, "shoulder_diameter_outer": 0.07, "width": 0.018}
    bare = surroundings(Electric(), geometry).rings
    assert bare == pytest.approx(2.0 * math.pi * 8.8541878128e-12 * 0.018 / math.log(1.4), rel=1e-12)
    assert surroundings(Electric(film={"seals": "6 pF"}), geometry).rings == pytest.approx(bare + 6e-12, rel=1e-12)
