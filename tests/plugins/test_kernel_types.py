"""Test types of kernels.

Those of the roles, and what a type checker sees of a law that names other arguments.
"""

from __future__ import annotations

import inspect
import subprocess
import sys
from pathlib import Path

import pytest

from lambda_core.domain.roles import ROLES
from lambda_core.laws import kernel_types

WRONG = '''
from typing import Protocol

from lambda_core.plugins import OK, FloatArray, law


@law("mixing", "short", role_api=3, reference="own work")
def short(psi: float, out: FloatArray) -> int:
    return OK


class Worn(Protocol):
    """What the kernel reads: parameters and states by name."""

    wear_depth: float


@law("boundary_friction", "reader", role_api=3, reference="own work", reads={"wear_depth": 1e-6})
def reader(slip: FloatArray, p: FloatArray, u_mean: float, par: Worn, mu: FloatArray) -> int:
    mu[0] = par.wear_depth
    return OK
'''


@pytest.mark.parametrize("role", [name for name, role in ROLES.items() if not any(a.optional for a in role.arguments)])
def test_the_type_of_a_kernel_is_that_of_its_role(role: str) -> None:
    name = "".join(word.capitalize() for word in role.split("_")) + "Kernel"
    found = inspect.signature(getattr(kernel_types, name).__call__).parameters
    wanted = {
        a.name: "Any" if a.name == "par" else "float" if a.kind == "f" else "FloatArray" for a in ROLES[role].arguments
    }
    assert {key: each.annotation for key, each in found.items() if key != "self"} == wanted
    assert list(found)[1:] == list(wanted)


@pytest.mark.full
def test_a_type_checker_sees_wrong_arguments_and_accepts_readers_of_states(tmp_path: Path) -> None:
    file = tmp_path / "wrong.py"
    file.write_text(WRONG)
    root = Path(__file__).parents[2]
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(root / ".mypy_cache"), str(file)],
        cwd=root, capture_output=True, text=True, check=False,
    )  # fmt: skip
    errors = [line for line in done.stdout.splitlines() if ": error:" in line]
    assert len(errors) == 1, done.stdout
    assert "_MixingKernel" in errors[0]
