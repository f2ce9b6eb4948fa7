"""Test files of reduced models that are at fault.

One sentence with the file, the matrix and what is wrong, never a bug.
"""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from lambda_core.domain.errors import CaseError
from lambda_core.formulas.elastic import reduced_files
from lambda_core.formulas.elastic.body import ElasticBody, shaft_body
from lambda_core.formulas.elastic.reduced import FORMAT, read_reduced, write_reduced
from lambda_core.formulas.elastic.sections import BodyMaterial, RoundSection
from lambda_core.formulas.elastic.whirl import craig_bampton
from lambda_core.model.bodies.reduced_shaft import reduced_shaft
from lambda_core.model.ledger import Ledger

STEEL = BodyMaterial(210e9, 0.3, 7850.0)
ENDS = [0.0, 0.1, 0.2]


@pytest.fixture(scope="module")
def body() -> ElasticBody:
    """Return a bar with its ends and its middle."""
    return craig_bampton(shaft_body([(0.2, RoundSection(0.03, 0.0, STEEL))], places=[0.1]), ENDS, 0)


def plain(body: ElasticBody) -> dict[str, Any]:
    """Return what a file says of a body."""
    return {"nodes": body.positions, "stiffness": body.stiffness, "mass": body.mass}


def problems(path: Path) -> list[str]:
    """Return the messages for a shaft file.

    The shaft of the case is the file.
    """
    ledger = Ledger()
    assert (reduced_shaft(path, ledger) is None) == bool(ledger.problems)
    assert {problem.where for problem in ledger.problems} <= {"shaft.reduced"}
    return [problem.message for problem in ledger.problems]


def _flipped(path: Path, body: ElasticBody) -> None:
    np.savez_compressed(path, **plain(body))
    damaged = bytearray(path.read_bytes())
    for i in range(600, 800):
        damaged[i] ^= 0x5A
    path.write_bytes(damaged)


def _cut(path: Path, body: ElasticBody) -> None:
    np.savez(path, **plain(body))
    path.write_bytes(path.read_bytes()[:2000])


def _of_npy(path: Path, body: ElasticBody) -> None:
    with path.open("wb") as file:
        np.save(file, body.mass)


def _huge(path: Path, body: ElasticBody) -> None:
    with h5py.File(path, "w") as file:
        file["nodes"], file["mass"] = body.positions, body.mass
        file.create_dataset("stiffness", shape=(10**6, 10**6), dtype="f8", chunks=(100, 100))


def _as_json(path: Path, body: ElasticBody, **changes: Any) -> None:
    data = {key: np.asarray(value).tolist() for key, value in plain(body).items()}
    path.write_text(json.dumps({"format": FORMAT, **data, **changes}))


def _as_npz(path: Path, body: ElasticBody, **changes: Any) -> None:
    np.savez(path, **{**plain(body), **changes})


def _next_to(path: Path, matrix: Callable[[Path], object]) -> None:
    matrix(path.with_name("k.csv"))
    path.write_text('nodes = [0.0, 0.1, 0.2]\nstiffness = "k.csv"\nmass = "k.csv"\n')


@pytest.mark.parametrize(
    ("name", "write", "words"),
    [
        ("a.npz", lambda p, b: p.write_bytes(b"PK\x03\x04garbage" * 10), "is not a file of np.savez, or damaged"),
        ("a.npz", _cut, "is not a file of np.savez, or damaged"),
        ("a.npz", _of_npy, "is not a file of np.savez, or damaged"),
        ("a.npz", _flipped, "damaged"),
        ("a.npz", lambda p, b: _as_npz(p, b, names=np.array(["l", "m", "r"], dtype=object)), "names: is damaged, or"),
        ("a.npz", lambda p, b: p.mkdir(), "cannot be read: it is a folder"),
        ("a.npz", lambda p, b: os.mkfifo(p), "cannot be read: it is a pipe"),
        ("a.h5", _huge, "stiffness: has 1000000000000 numbers, at most"),
        ("a.h5", lambda p, b: p.mkdir(), "cannot be read: it is a folder"),
        ("a.json", lambda p, b: _as_json(p, b, nodes=[10**400, 0.1, 0.2]), "nodes: is not a list of numbers"),
        ("a.json", lambda p, b: _as_json(p, b, lumps=[True]), "lumps: must be names of nodes, or numbers from 0 to 2"),
        ("a.json", lambda p, b: _as_json(p, b, mass=[["1"]]), "mass: is not a list of rows of numbers"),
        ("a.json", lambda p, b: None, "cannot be read: no such file"),
        ("a.txt", lambda p, b: p.write_text("x"), "must have a name that ends in .json, .npz"),
        ("a.toml", lambda p, b: _next_to(p, os.mkfifo), 'stiffness: "k.csv" cannot be read: it is a pipe'),
        ("a.toml", lambda p, b: _next_to(p, Path.mkdir), 'stiffness: "k.csv" cannot be read: it is a folder'),
        ("a.toml", lambda p, b: _next_to(p, lambda k: k.write_text("1" * 200000)), 'stiffness: "k.csv" line 1: field'),
        ("a.toml", lambda p, b: _next_to(p, lambda k: k.write_text("1\na")), 'stiffness: "k.csv" line 2: could not'),
        ("a.toml", lambda p, b: _next_to(p, lambda k: k.write_bytes(b"\xff")), 'stiffness: "k.csv" is not text'),
    ],
)  # fmt: skip
def test_files_at_fault(
    name: str, write: Callable[[Path, ElasticBody], object], words: str, body: ElasticBody, tmp_path: Path
) -> None:
    path = tmp_path / name
    write(path, body)
    (found,) = problems(path)
    assert found.startswith(f"{name}: {words}") or (words == "damaged" and words in found)
    with pytest.raises(CaseError) as caught:
        read_reduced(path)
    assert caught.value.exit_code == 3
    assert caught.value.source == name


def test_a_large_array_is_refused_before_it_is_read(
    body: ElasticBody, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reduced_files, "_MOST", 20000)
    _as_npz(tmp_path / "a.npz", body, stiffness=np.zeros((200, 200)))
    (found,) = problems(tmp_path / "a.npz")
    assert found.startswith("a.npz: stiffness: has ")


def test_the_same_fault_of_two_matrices_is_said_of_both(body: ElasticBody, tmp_path: Path) -> None:
    aside = np.zeros_like(body.mass)
    aside[0, 1] = 1e9
    _as_npz(tmp_path / "a.npz", body, stiffness=body.stiffness + aside, mass=body.mass + aside)
    assert problems(tmp_path / "a.npz") == [f"a.npz: {name}: must be symmetric" for name in ("stiffness", "mass")]


def test_complex_stiffness_is_refused_without_a_warning(body: ElasticBody, tmp_path: Path) -> None:
    _as_npz(tmp_path / "a.npz", body, stiffness=body.stiffness * (1.0 + 0.02j))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        (found,) = problems(tmp_path / "a.npz")
    assert found == "a.npz: stiffness: is complex: structural damping is not taken, give the real matrix"


def test_modes_do_not_hide_a_shaft_that_is_stiffer_along_z(tmp_path: Path) -> None:
    bar = shaft_body([(0.2, RoundSection(0.03, 0.0, STEEL))], places=[0.1])
    write_reduced(craig_bampton(bar, ENDS, 4), tmp_path / "a.npz")
    assert problems(tmp_path / "a.npz") == []
    upright = np.flatnonzero(np.isin(np.arange(bar.mass.shape[0]) % 6, (2, 4)))  # z and tilts about y
    stiffness = bar.stiffness.copy()
    stiffness[np.ix_(upright, upright)] *= 1.3
    write_reduced(craig_bampton(replace(bar, stiffness=stiffness), ENDS, 4), tmp_path / "a.npz")
    assert problems(tmp_path / "a.npz") == ["a.npz: stiffness: must be the same in y and z, because the shaft turns"]


def test_the_sign_of_gyroscopic_terms_is_that_of_the_page(body: ElasticBody, tmp_path: Path) -> None:
    """Compare G[tilt_y, tilt_z] with +I_p.

    The program's own shafts, and the polar inertia of a round bar where a file has none.
    """
    write_reduced(replace(body, gyroscopic=np.zeros_like(body.mass)), tmp_path / "a.npz")
    added = reduced_shaft(tmp_path / "a.npz", Ledger())
    assert added is not None
    mass = STEEL.density * np.pi * 0.015**2 * 0.2
    for found in (body, added):
        tilted: np.ndarray[Any, np.dtype[np.float64]] = np.zeros((body.mass.shape[0], 2))
        for n, x in enumerate(body.positions):
            tilted[6 * n + 4, 0], tilted[6 * n + 2, 0] = 1.0, -x  # as one about y
            tilted[6 * n + 5, 1], tilted[6 * n + 1, 1] = 1.0, x  # as one about z
        turned = tilted.T @ found.gyroscopic @ tilted
        assert turned[0, 1] == pytest.approx(0.5 * mass * 0.015**2, rel=1e-6)
        assert turned[1, 0] == pytest.approx(-turned[0, 1], rel=1e-12)
