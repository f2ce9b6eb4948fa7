"""Check imported reduced models.

Any finite-element program may give mass, stiffness and nodes in one file.

docs/shaft-reference.md describes the file. Units are SI, or millimetres, tonnes and newtons.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, Problem, unknown_name
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.formulas.elastic.body import ElasticBody
from lambda_core.formulas.elastic.reduced_files import MATRICES, contents

FORMAT = "lambda-bearing reduced body 1"
UNITS = {"m kg N": 1.0, "mm t N": 1e-3}  # metres in the file's unit of length
_KEYS = ("format", "units", "nodes", "names", "lumps", *MATRICES)
_SYMMETRY = 1e-6  # of the largest entry
_BEYOND = 1e100  # no number of a model: squares of it are infinite


def write_reduced(body: ElasticBody, path: str | Path) -> None:
    """Write a body in the format of `read_reduced`.

    The name of the file gives .json or .npz; anything else raises a UsageError.
    """
    target = Path(path)
    data: dict[str, Any] = {"format": FORMAT, "nodes": body.positions, "stiffness": body.stiffness, "mass": body.mass}
    data |= {"gyroscopic": body.gyroscopic}
    data |= {"names": list(body.names)} if body.names else {}
    data |= {"lumps": list(body.lumps)} if body.lumps else {}
    data |= {"damping": body.damping} if body.damping is not None else {}
    if target.suffix == ".npz":
        np.savez(target, **data)
        return
    plain = {key: value.tolist() if isinstance(value, np.ndarray) else value for key, value in data.items()}
    target.write_text(json.dumps(plain) + "\n", encoding="utf-8")


def read_reduced(path: str | Path) -> ElasticBody:
    """Read a reduced body.

    It says ``nodes`` (places along x, or rows of x, y, z), ``stiffness`` and ``mass`` (square; six rows per node, x, y,
    z and tilts about x, y, z, then those of further coordinates, as a Craig-Bampton reduction has them), and perhaps
    ``gyroscopic`` (times the spin), ``damping``, ``names`` (of the nodes), ``lumps`` (numbers of the nodes that carry
    the mass in motion), ``units`` ("m kg N" or "mm t N"), ``format``.

    Raises
    ------
    CaseError
        With everything that is wrong with the file.
    """
    source = Path(path)
    data, found = contents(source), list[Problem]()
    if str(data.get("format", FORMAT)) != FORMAT or ("format" not in data and source.suffix.lower() == ".json"):
        raise CaseError(source.name, [Problem("format", f'must be "{FORMAT}"')])
    for key in data:
        if key not in _KEYS:
            found.append(Problem(str(key), unknown_name("entry of a reduced body", str(key), _KEYS)))
    units = str(data.get("units", "m kg N"))
    if units not in UNITS:
        found.append(Problem("units", 'must be "m kg N" (the default) or "mm t N"'))
    nodes = _nodes(data, found)
    matrices = {
        name: _numbers(data, name, (2,), found) for name in MATRICES if name in data or name in ("stiffness", "mass")
    }
    if not found:
        _check(nodes, matrices, found)
    names = tuple(map(str, np.ravel(np.asarray(data.get("names", []), dtype=object))))
    lumps = _lumps(data, names, nodes.size, found) if nodes.size else ()
    if names and nodes.size and (len(names) != nodes.size or len(set(names)) != len(names)):
        found.append(Problem("names", f"must be one for each of the {nodes.size} nodes, all different"))
    if found:
        raise CaseError(source.name, found)
    length, rows = UNITS[units], matrices["mass"].shape[0]
    # Forces are newtons in both systems: energies scale as lengths do, translations as lengths, all else has no unit.
    scale = np.ones(rows)
    scale[: NODE * nodes.size].reshape(-1, NODE)[:, :3] = 1.0 / length
    matrices = {name: length * matrix * np.outer(scale, scale) for name, matrix in matrices.items()}
    return ElasticBody(
        length * nodes, matrices["stiffness"], matrices["mass"], matrices.get("gyroscopic", np.zeros((rows, rows))),
        names=names, lumps=lumps, damping=matrices.get("damping"),
    )  # fmt: skip


def _numbers(data: dict[str, Any], name: str, dimensions: tuple[int, ...], found: list[Problem]) -> FloatArray:
    """Return an array of numbers.

    Without one, return an empty array and note a problem.
    """
    message = "is required"
    if name in data:
        try:
            given = np.asarray(data[name])
            if given.dtype.kind == "c":
                message = "is complex: structural damping is not taken, give the real matrix"
            elif given.dtype.kind not in "iufO":
                raise TypeError("no numbers")
            else:
                values: FloatArray = given.astype(float)
                if values.ndim in dimensions and values.size and np.all(np.abs(values) < _BEYOND):
                    return values
                message = f"must be {' or '.join(map(str, dimensions))}-dimensional, finite and not empty"
        except (TypeError, ValueError, OverflowError):
            message = f"is not a list of {'rows of ' * (dimensions == (2,))}numbers"
    found.append(Problem(name, message))
    return np.zeros((0,) * dimensions[0])


def _nodes(data: dict[str, Any], found: list[Problem]) -> FloatArray:
    """Return the places of the nodes along x."""
    nodes = _numbers(data, "nodes", (1, 2), found)
    if nodes.ndim == 2:
        if nodes.shape[1] != 3:
            found.append(Problem("nodes", f"has rows of {nodes.shape[1]}: write x, or x, y, z of every node"))
        elif np.abs(nodes[:, 1:]).max() > _SYMMETRY * max(float(np.ptp(nodes)), 1e-12):
            found.append(
                Problem("nodes", "are off the axis (y, z): join each bore to a node on the axis before the reduction")
            )
        nodes = np.ascontiguousarray(nodes[:, 0])
    if nodes.size > 1 and np.diff(nodes).min() <= 0.0:
        found.append(
            Problem("nodes", "must rise along x, no two at one place; sort the rows of the matrices in the same order")
        )
    return nodes


def _lumps(data: dict[str, Any], names: tuple[str, ...], count: int, found: list[Problem]) -> tuple[int, ...]:
    """Return the nodes that carry the moving mass.

    They are numbers, given by number from 0 on, or by name.
    """
    given = np.ravel(np.asarray(data.get("lumps", []), dtype=object)).tolist()
    numbers = [names.index(str(one)) if str(one) in names else one for one in given]
    if all(isinstance(n, int | np.integer) and not isinstance(n, bool) and 0 <= n < count for n in numbers):
        return tuple(int(n) for n in numbers)
    found.append(Problem("lumps", f"must be names of nodes, or numbers from 0 to {count - 1}"))
    return ()


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
