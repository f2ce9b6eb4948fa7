"""Repeat one bearing on a shared shaft.

A case describes one bearing; compiled code works on tables of any length. The shaft is body 0; bearing i brings an
outer ring, body 1 + 2 i, and a cage, body 2 + 2 i.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.solver_context import SolverContext

SHAFT = 0
_OWN = 2  # bodies of a bearing without the shaft
_SIGNALS = 12  # of a body


def on_a_shaft(single: SolverContext, places: Sequence[float]) -> SolverContext:
    """Return equal bearings on a shaft.

    Tables of one bearing at each axial place [m]; inertia, loads and supports of the shaft add up.

    The cages' and outer rings' states begin and end at the places, as the balls' do.
    """
    old, count = single.bundle, len(places)
    tables = {"bodies": _bodies(old, count), "rows": _rows(old, count), "raceways": _raceways(old, places)}
    tables |= {"lands": _lands(old, count), "terms": _terms(old, count)}
    bodies, balls = tables["bodies"].size, count * int(old.system["balls"][0])
    system = old.system.copy()
    system["balls"], system["tail"] = balls, L.NB * balls
    active = [old.active, *(old.active[old.active >= L.NS] + L.NS * _OWN * i for i in range(1, count))]
    inputs, now, rates = np.zeros(bodies, R.INPUTS), np.zeros(bodies, R.BODY_STATE), np.zeros(bodies, R.BODY_STATE)
    bundle = old._replace(
        system=system, **tables, active=np.concatenate(active), inputs=inputs, signals=inputs.view(R.SIGNAL),
        scratch=np.zeros(1, R.SCRATCH), shared=now.view(np.float64), bodies_now=now,
        shared_rates=rates.view(np.float64), body_rates=rates, body_wrenches=np.zeros(bodies, R.WRENCH),
        contact_wrenches=np.zeros(bodies, R.WRENCH), ball_wrenches=np.zeros(balls, R.WRENCH),
    )  # fmt: skip
    return replace(single, bundle=bundle, scale=together(single, [single.scale] * count))


def together(single: SolverContext, states: Sequence[FloatArray]) -> FloatArray:
    """Return the state of bearings together.

    From those of single ones; the shaft's is the first one's.
    """
    n, active = L.NB * int(single.bundle.system["balls"][0]), single.bundle.active
    shaft = states[0][n:][active < L.NS]
    return np.concatenate([*(state[:n] for state in states), shaft, *(state[n:][active >= L.NS] for state in states)])


def _moved(body: int, i: int) -> int:
    """Return a body's number.

    Of the bearing at place i.
    """
    return body if body == SHAFT else body + _OWN * i


def _bodies(old: L.Bundle, count: int) -> FloatArray:
    bodies = np.concatenate([old.bodies, *[old.bodies[1:]] * (count - 1)])
    for name in ("mass", "transverse_inertia", "polar_inertia", "unbalance", "stiffness", "damping"):
        bodies[name][SHAFT] *= count
    return bodies


def _rows(old: L.Bundle, count: int) -> FloatArray:
    rows = np.tile(old.rows, count)
    for i, row in enumerate(rows):
        row["number"], row["first_ball"], row["first_raceway"] = i, i * row["balls"], i * row["raceways"]
        row["first_state"] = L.NB * row["first_ball"]
        row["cage"] = _moved(int(row["cage"]), i)
    return rows


def _raceways(old: L.Bundle, places: Sequence[float]) -> FloatArray:
    raceways, each = np.tile(old.raceways, len(places)), old.raceways.size
    for number, raceway in enumerate(raceways):
        i = number // each
        raceway["number"], raceway["body"] = number, _moved(int(raceway["body"]), i)
        if raceway["body"] == SHAFT:
            raceway["axial_offset"] = places[i]
    return raceways


def _lands(old: L.Bundle, count: int) -> FloatArray:
    lands = np.tile(old.lands, count)
    for number, land in enumerate(lands):
        i = number // old.lands.size
        land["cage"], land["ring"] = _moved(int(land["cage"]), i), _moved(int(land["ring"]), i)
        land["row"] += i * old.rows.size
    return lands


def _terms(old: L.Bundle, count: int) -> FloatArray:
    others = old.terms[old.terms["signal"] >= _SIGNALS]
    terms = np.concatenate([old.terms, *[others] * (count - 1)])
    for i in range(1, count):
        terms["signal"][old.terms.size + (i - 1) * others.size :] += _SIGNALS * _OWN
    on_shaft = (terms["signal"] >= 6) & (terms["signal"] < _SIGNALS)  # forces and moments
    for name in ("value", "before", "after", "amplitude"):
        terms[name][on_shaft] *= count
    return terms
