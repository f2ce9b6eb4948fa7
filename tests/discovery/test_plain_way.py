"""Test hashing and numbers without internals of Numba and Python."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

ASK = """
import hashlib, json
import numpy as np
from numba import njit, types
from lambda_core.discovery.manager import registry
from lambda_core.domain.roles import ROLES
from lambda_core.laws.check import parameters_of
from lambda_core.laws.jit import plain
from lambda_core.laws.calls import handed_over
from lambda_core.laws.jit.machine_code import OPTIONS
from lambda_core.laws.kernels import compile_kernel, kernel_reach, signature
from lambda_core.laws.par import make_par
from lambda_core.laws.probe import draw, trial_context

models = registry()
keys = {f"{role}/{name}": kernel_reach(models.model(role, name)).key for role in ROLES for name in models.names(role)}
numbers = {}
for label in ("traction/ree-eyring", "film_thickness/chittenden", "surface/waviness"):
    law = models.model(*label.split("/"))
    role = ROLES[law.role]
    par = make_par(law, parameters_of(law, None), trial_context(role.elements[0]))
    arguments = draw(role, par, 9, np.random.default_rng(3))
    compiled = compile_kernel(law)
    assert compiled.dispatcher(*handed_over(role, arguments)) == 1
    numbers[label] = [value.tolist() for spec, value in zip(role.arguments, arguments) if spec.output]

law = compile_kernel(models.model("asperity_load", "zhou-hoeprich"))
pointer = types.FunctionType(signature("asperity_load"))

@njit(types.float64(pointer, types.float64[::1], types.float64[::1]), error_model="numpy")
def share(law, par, out):
    ratio = out[1:]
    ratio[0] = 1.5
    law(ratio, par, out[:1])
    return out[0]

numbers["by pointer"] = share(law.pointer, np.array([2.32, 0.97]), np.zeros(2))
print(json.dumps(dict(plain=plain.is_plain(), keys=keys, numbers=numbers, cached=law.cached)))
"""


def ask(**environment: str) -> dict[str, object]:
    done = subprocess.run(
        [sys.executable, "-c", ASK], env=os.environ | environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    answer: dict[str, object] = json.loads(done.stdout)
    return answer


@pytest.mark.full
@pytest.mark.timeout(300)
def test_the_plain_way_has_the_same_keys_and_numbers() -> None:
    usual, plain = ask(), ask(LAMBDA_BEARING_PLAIN_JIT="1")
    assert (usual["plain"], plain["plain"]) == (False, True)
    assert plain["cached"] is False
    assert len(dict(usual["keys"])) > 40  # type: ignore[call-overload]
    assert plain["keys"] == usual["keys"]
    assert plain["numbers"] == usual["numbers"]
