"""Make small networks with films that a test sets."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

import numpy as np

from lambda_core.analysis.electric import circuit_integrator
from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.circuit_integrator import BearingSolution, Circuit, Films, Strength, Surroundings
from lambda_core.analysis.electric.film_laws import FilmLaw, film_laws
from lambda_core.discovery.manager import registry
from lambda_core.domain.arrays import FloatArray
from lambda_core.laws.probe import trial_context
from lambda_core.model.bearing_model import ChosenLaw

AREA = 2.7e-6  # 27 000 spots of 10 um [m2]


@cache
def _laws(breakdown: str, breaks: str, discharge: str, arcs: str) -> tuple[FilmLaw, FilmLaw]:
    chosen = {}
    for role, name, values in (("breakdown", breakdown, breaks), ("discharge", discharge, arcs)):
        law = registry().model(role, name)
        chosen[role] = ChosenLaw(law, law.parameters.model_validate(json.loads(values)), {})
    return film_laws(chosen, (trial_context("film_inner"), trial_context("film_outer")))


def strength(
    breakdown: str = "statistical", discharge: str = "resistance", *, roughness: float = 0.1e-6,
    breaks: dict[str, Any] | None = None, **arcs: Any,
) -> Strength:  # fmt: skip
    """Return laws of the films by name.

    With parameters as a case has them.
    """
    laws = _laws(breakdown, json.dumps(breaks or {}), discharge, json.dumps(arcs))
    return Strength(*laws, roughness, 0.5)


def one_bearing(
    winding: float, rotor: float, rings: float = 0.0, *, brush: float = 0.0, twins: float = 0.0, **around: float
) -> Circuit:
    """Return the circuit of one bearing."""
    return Circuit(winding, rotor, (Surroundings(rings, **around),), brush, twins)


def integrate(films: Films, circuit: Circuit, law: Strength, source: Any, **options: Any) -> BearingSolution:
    """Integrate the circuit of one bearing."""
    return circuit_integrator.integrate([films], circuit, [law], source, **options).of(0)


SMOOTH, ROUGH = strength("field"), strength()


def steady(
    inner: float, outer: float, *, balls: int = 1, film: float = 0.0, leak: float = 0.0, stop: float = 2e-3
) -> Films:
    """Return films that do not change.

    Of an area of 27 000 spots.
    """
    time = np.linspace(0.0, stop, 3)
    each = np.ones((3, balls, 2))
    capacitance = each * np.array([inner, outer])
    return Films(time, capacitance, leak * each, film * each, film * each, AREA * each, 0.0 * each)


def turning(stop: float = 0.02, samples: int = 41, film: float = 0.0, leak: float = 1e-10) -> Films:
    """Return nine balls through a load zone.

    Their surfaces are new every 45 us.
    """
    time = np.linspace(0.0, stop, samples)
    phase = 2.0 * np.pi * (np.arange(9) / 9)[None, :, None] + 2.0 * np.pi * 20.0 * time[:, None, None]
    capacitance = 40e-12 + 25e-12 * np.cos(phase) + np.array([0.0, 5e-12])
    each = np.ones_like(capacitance)
    rolled = each * (time / 45e-6)[:, None, None]
    return Films(time, capacitance, leak * each, film * each, film * each, AREA * each, rolled)


def switching(
    stop: float, link: float = 800.0, frequency: float = 1e4, rise: float = 50e-9
) -> tuple[FloatArray, FloatArray]:
    """Return the corners of a six-step common-mode voltage."""
    levels = np.array([-3.0, -1.0, 1.0, 3.0, 1.0, -1.0]) * link / 6.0
    edges = (np.arange(int(stop * frequency * 6)) + 1.0) / (6.0 * frequency)
    times = np.append(0.0, np.column_stack([edges, edges + rise]).ravel())
    after = levels[(np.arange(edges.size) + 1) % 6]
    before = levels[np.arange(edges.size) % 6]
    return times, np.append(levels[0], np.column_stack([before, after]).ravel())


def residuals(found: BearingSolution, circuit: Circuit, source: tuple[FloatArray, FloatArray]) -> tuple[float, float]:
    """Return relative residuals of energy and charge.

    Relative to what flowed.
    """
    t = found.total
    stored = t[L.T_STORED] - t[L.T_STORED_0]
    rest = t[L.T_SOURCE] + t[L.T_MOTION] - t[L.T_OHMIC] - t[L.T_ARC] - stored
    flowed = np.abs(t[[L.T_SOURCE, L.T_MOTION, L.T_OHMIC, L.T_ARC]]).sum() + abs(stored)
    begin, end = np.interp([0.0, t[L.T_TIME]], *source)
    brought = circuit.winding * (end - begin)
    lost = brought - t[L.T_LEAK] - t[L.T_ARC_CHARGE] - (t[L.T_CHARGE] - t[L.T_CHARGE_0])
    moved = circuit.winding * (np.abs(np.diff(source[1])).sum() + abs(begin))
    return float(rest / flowed), float(lost / moved)
