"""Reduced models from outside: mass, stiffness and nodes of any finite-element program, in one file of JSON."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, Problem
from lambda_core.elastic.beam import NODE
from lambda_core.elastic.body import ElasticBody

FORMAT = "lambda-bearing reduced body 1"
_SYMMETRY = 1e-6  # of the largest entry


def write_reduced(body: ElasticBody, path: str | Path) -> None:
    """Write a body as `read_reduced` reads it."""
    text = json.dumps(
        {
            "format": FORMAT,
            "nodes": body.positions.tolist(),
            "stiffness": body.stiffness.tolist(),
            "mass": body.mass.tolist(),
            "gyroscopic": body.gyroscopic.tolist(),
        }
    )
    Path(path).write_text(text + "\n", encoding="utf-8")


def read_reduced(path: str | Path) -> ElasticBody:
    """Read a reduced body.

    The file is an object with ``format``, ``nodes`` (places along x [m]), ``stiffness`` and ``mass`` (lists of rows,
    SI; six rows per node, x, y, z and tilts about x, y, z, then those of further coordinates, as a Craig-Bampton
    reduction has them), and perhaps ``gyroscopic`` (times the spin).

    Raises
    ------
    CaseError
        With everything that is wrong with the file.
    """
    source = Path(path).name
    try:
        data = json.loads(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise CaseError(source, [Problem("", f"cannot be read: {error.strerror}")]) from None
    except (ValueError, RecursionError):
        raise CaseError(source, [Problem("", "is not JSON")]) from None
    found: list[Problem] = []
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise CaseError(source, [Problem("format", f'must be "{FORMAT}"')])
    nodes = _numbers(data, "nodes", 1, found)
    matrices = {name: _numbers(data, name, 2, found) for name in ("stiffness", "mass")}
    matrices["gyroscopic"] = (
        _numbers(data, "gyroscopic", 2, found) if "gyroscopic" in data else np.zeros_like(matrices["mass"])
    )
    if not found:
        _check(nodes, matrices, found)
    if found:
        raise CaseError(source, found)
    return ElasticBody(nodes, matrices["stiffness"], matrices["mass"], matrices["gyroscopic"])


def _numbers(data: dict[str, Any], name: str, dimensions: int, found: list[Problem]) -> FloatArray:
    """Return an array of numbers; an empty one and a problem where there is none."""
    try:
        values = np.array(data[name], dtype=float)
    except KeyError:
        found.append(Problem(name, "is required"))
    except (TypeError, ValueError):
        found.append(Problem(name, f"is not a list of {'numbers' if dimensions == 1 else 'rows of numbers'}"))
    else:
        if values.ndim == dimensions and values.size and np.all(np.isfinite(values)):
            return values
        found.append(Problem(name, f"must be {dimensions}-dimensional, finite and not empty"))
    return np.zeros((0,) * dimensions)


def _check(nodes: FloatArray, matrices: dict[str, FloatArray], found: list[Problem]) -> None:
    least = NODE * nodes.size
    size = matrices["stiffness"].shape[0]
    for name, matrix in matrices.items():
        if matrix.shape != (size, size) or size < least:
            shape = " by ".join(str(n) for n in matrix.shape)
            found.append(
                Problem(name, f"is {shape}: square, all of one size, six rows for each of the {nodes.size} nodes")
            )
            continue
        sign = -1.0 if name == "gyroscopic" else 1.0
        if np.abs(matrix - sign * matrix.T).max() > _SYMMETRY * np.abs(matrix).max():
            found.append(Problem(name, "must be " + ("antisymmetric" if sign < 0.0 else "symmetric")))
        elif sign > 0.0 and np.linalg.eigvalsh(matrix)[0] < -_SYMMETRY * np.abs(matrix).max():
            found.append(Problem(name, "has a negative eigenvalue: signs or units are wrong"))
