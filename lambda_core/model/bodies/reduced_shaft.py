"""Read a reduced shaft and check that it turns freely."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.formulas.elastic.body import ElasticBody
from lambda_core.model.bodies.reduced_file import ReducedFile
from lambda_core.model.ledger import Ledger

_WHERE = "shaft.reduced"
_MOTIONS = ("along x", "along y", "along z", "about x", "about y", "about z")
_FREE = 1e-6  # of the energy of its rows moving one by one: what a motion as a rigid body may take
_LOOSE = 1e-9  # of the largest eigenvalue: below, a motion takes no force
_ALIKE = 1e-6  # relative difference of what has to be equal


def reduced_shaft(path: Path, ledger: Ledger) -> ElasticBody | None:
    """Return a shaft's model from a file.

    The result is None after a problem; each problem names its remedy.
    """
    file = ReducedFile(_WHERE, path, ledger)
    body = file.read()
    if body is None:
        return None
    before = len(ledger.problems)
    if body.positions.size < 2:
        file.problem("nodes: a shaft needs two at least")
        return None
    if body.positions[0] < 0.0:
        file.problem("nodes: x counts from the left end of the shaft, none is below 0")
    if body.damping is not None:
        file.problem("damping: a turning shaft with damping is not supported: remove the damping")
    rigid = _rigid_motions(body)
    _check_stiffness(body, rigid, file)
    _check_mass(body, rigid, file)
    if len(ledger.problems) > before:
        return None
    return _with_gyroscopic(body, rigid, ledger)


def _rigid_motions(body: ElasticBody) -> FloatArray:
    """Return the six rigid motions.

    The rotations are about the left end; the array has shape (rows, 6).
    """
    found: FloatArray = np.zeros((body.mass.shape[0], NODE))
    for n, x in enumerate(body.positions):
        found[NODE * n : NODE * (n + 1)] = np.eye(NODE)
        found[NODE * n + 1, 5], found[NODE * n + 2, 4] = x, -x
    return found


def _check_stiffness(body: ElasticBody, rigid: FloatArray, file: ReducedFile) -> None:
    k = body.stiffness
    for name, motion in zip(_MOTIONS, rigid.T, strict=True):
        alone = float(np.diag(k) @ motion**2)
        if abs(motion @ k @ motion) > _FREE * alone:
            file.problem(
                f"stiffness: moving all nodes as one {name} takes force: a shaft must be free of supports; otherwise "
                "the order of rows, units or places of nodes do not fit"
            )
            return
    scale = 1.0 / np.sqrt(np.maximum(np.diag(k), np.finfo(float).tiny))
    stretch = np.linalg.eigvalsh(k * np.outer(scale, scale))
    loose = int((stretch <= _LOOSE * stretch[-1]).sum())
    if loose != NODE:
        file.problem(f"stiffness: {loose} motions have no stiffness, a free shaft has six: join its parts")
        return
    held = _of_nodes(body, k)
    if np.abs(_turned(held) - held).max() > _ALIKE * np.abs(held).max():
        file.problem("stiffness: must be the same in y and z, because the shaft turns")


def _of_nodes(body: ElasticBody, stiffness: FloatArray) -> FloatArray:
    """Return the stiffness between the nodes.

    Further coordinates follow without force: they take some (checked).
    """
    n = NODE * body.positions.size
    follows = np.linalg.solve(stiffness[n:, n:], stiffness[n:, :n])
    found: FloatArray = stiffness[:n, :n] - stiffness[:n, n:] @ follows
    return found


def _turned(matrix: FloatArray) -> FloatArray:
    """Return a matrix of nodes after a turn.

    The body turns by 90 degrees.
    """
    quarter = np.zeros((NODE, NODE))
    quarter[0, 0] = quarter[3, 3] = 1.0
    quarter[2, 1] = quarter[5, 4] = 1.0  # y goes to z
    quarter[1, 2] = quarter[4, 5] = -1.0
    turn = np.kron(np.eye(matrix.shape[0] // NODE), quarter)
    found: FloatArray = turn.T @ matrix @ turn
    return found


def _check_mass(body: ElasticBody, rigid: FloatArray, file: ReducedFile) -> None:
    rigid_mass = rigid.T @ body.mass @ rigid
    masses = np.diag(rigid_mass)[:3]
    if masses.min() <= 0.0 or np.ptp(masses) > _ALIKE * masses.max():
        told = ", ".join(f"{m:.6g} kg" for m in masses)
        file.problem(f"mass: moved along x, y and z it has {told}: a body has one mass")
        return
    if rigid_mass[3, 3] <= 0.0 or abs(rigid_mass[4, 4] - rigid_mass[5, 5]) > _ALIKE * rigid_mass[5, 5]:
        file.problem("mass: needs a moment of inertia about x, and the same about y and z")
        return
    scale = 1.0 / np.sqrt(np.maximum(np.diag(body.mass), np.finfo(float).tiny))
    if np.linalg.eigvalsh(body.mass * np.outer(scale, scale))[0] < 1e-14:
        file.problem("mass: some coordinates move without mass: reduce stiffness and mass by the same matrix")


def _with_gyroscopic(body: ElasticBody, rigid: FloatArray, ledger: Ledger) -> ElasticBody:
    """Return the body with gyroscopic terms.

    The terms come from the file, otherwise from the polar inertia of its nodes.
    """
    if np.any(body.gyroscopic):
        return body
    found = np.zeros_like(body.mass)
    for n in range(body.positions.size):
        about = 3 + NODE * n
        inertia = float(body.mass[about] @ rigid[:, 3])
        found[about + 1, about + 2], found[about + 2, about + 1] = inertia, -inertia
    ledger.assume("gyroscopic moments of the shaft from outside are those of its polar inertia, node by node")
    return replace(body, gyroscopic=found)
