"""Read an elastic housing, reduced to its outer rings."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.elastic.body import ElasticBody
from lambda_core.model.bodies.reduced_file import ReducedFile
from lambda_core.model.ledger import Ledger
from lambda_core.model.machine_model import GROUND, PLACES, MountedBearing

_WHERE = "housing.reduced"
_LOOSE = 1e-9  # of the largest eigenvalue: below, the housing moves without force


def elastic_housing(
    path: Path, bearings: Sequence[MountedBearing], ledger: Ledger
) -> tuple[FloatArray, FloatArray] | tuple[None, None]:
    """Return stiffness and damping between outer rings.

    The shape is (5 bearings, 5 bearings); None follows a problem.

    What the rings do not hold, further nodes and modes, follows without force: K_kk - K_ko K_oo^-1 K_ok.

    Parameters
    ----------
    bearings : sequence of MountedBearing
        The housing has a node at each of their places; it holds them in their locked degrees of freedom. Without any
        the file alone is looked at.
    """
    file = ReducedFile(_WHERE, path, ledger)
    body = file.read()
    if body is None or not bearings:
        return None, None
    _say_left_out(body, ledger)
    rows: list[int] = []
    own: list[int] = []
    for i, bearing in enumerate(bearings):
        if bearing.carrier != GROUND:
            continue
        try:
            first = body.rows(bearing.position).start
        except ValueError as error:
            nodes = ", ".join(f"{1e3 * x:.6g}" for x in body.positions)
            file.problem(f"{bearing.name}: {error}; nodes are at {nodes} mm")
            continue
        held = [d for d, k in enumerate(bearing.seating.stiffness) if math.isinf(k)]
        rows += [first + PLACES[d] for d in held]
        own += [len(PLACES) * i + d for d in held]
    if not rows:
        file.problem("it holds no outer ring: all are free, or sit on springs or in bodies")
    if ledger.problems:
        return None, None
    kept, places = np.array(rows), np.array(own)
    others = np.setdiff1d(np.arange(body.stiffness.shape[0]), kept)
    k = body.stiffness
    try:
        follows = np.linalg.solve(k[np.ix_(others, others)], k[np.ix_(others, kept)])
        condensed: FloatArray = k[np.ix_(kept, kept)] - k[np.ix_(kept, others)] @ follows
    except np.linalg.LinAlgError:
        file.problem("part of the housing is unconstrained: its stiffness is singular apart from the bearing seats")
        return None, None
    scale = np.sqrt(np.abs(np.diag(condensed)))
    stretch = np.linalg.eigvalsh(condensed / np.outer(scale, scale))
    if stretch[0] < _LOOSE * stretch[-1]:
        file.problem("the housing is held by nothing: fix it to the ground before it is reduced")
        return None, None
    stiffness, damping = np.zeros((2, *(len(PLACES) * len(bearings),) * 2))
    stiffness[np.ix_(places, places)] = 0.5 * (condensed + condensed.T)
    if body.damping is not None:
        moves = np.zeros((k.shape[0], kept.size))
        moves[kept, np.arange(kept.size)] = 1.0
        moves[others] = -follows
        damping[np.ix_(places, places)] = moves.T @ body.damping @ moves
    return stiffness, damping


def _say_left_out(body: ElasticBody, ledger: Ledger) -> None:
    """Say what of the file does not count."""
    if np.any(body.mass):
        ledger.assume("the mass of the elastic housing is left out: in motion, in critical speeds and under gravity")
    if np.any(body.gyroscopic):
        ledger.assume("the gyroscopic matrix of the elastic housing is left out: it does not turn")
    if body.lumps:
        ledger.assume("the lumps of the elastic housing are left out: it has no mass in motion")
