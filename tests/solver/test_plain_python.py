"""Test the core without a compiler.

The same sources run as plain Python give the same numbers.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from lambda_core.domain.arrays import FloatArray

from .support import Machine
from .test_power import MODELS, machine, random_state

# Runs in a process without Numba's compiler. Everything that only data decides comes from the file; the functions are
# the plain ones of the core and of the laws.
PLAIN = """
import sys
import numpy as np
from lambda_core import api
from lambda_core.laws.par import batched_kernel
from lambda_core.solver.motion import forces
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.contact import raceway

given, found = np.load(sys.argv.pop(1)), sys.argv.pop(1)
model = api.check(str(given["case"]), [str(text) for text in given["overrides"]])

def law(element, role):
    return batched_kernel(model.laws[element][role].model)

def raceway_laws(element):
    return L.RacewayLaws(*(law(element, role) for role in R.RACEWAY_ROLES))

laws = L.Laws(
    (raceway_laws("ball_inner"), raceway_laws("ball_outer")),
    [
        law("ball_cage" if model.depth.cage else "ball_ball", "cage_contact"),
        law("cage_inner", "cage_contact"),
        law("cage_outer", "cage_contact"),
    ],
    [law("fluid_drag", "fluid_drag")],
    [law(f"elements.{name}", "force_element") for name in model.links],
    [law(element, "time_function") for element in model.laws if element.startswith("time.")],
)
kinds = {
    "system": R.SYSTEM, "bodies": R.BODY, "rows": R.ROW, "raceways": R.RACEWAY, "lands": R.LAND, "links": R.LINK,
    "slots": R.SLOT, "waves": R.WAVE,
    "terms": R.TERM, "inputs": R.INPUTS, "scratch": R.SCRATCH, "bodies_now": R.BODY_STATE, "body_rates": R.BODY_STATE,
    "ground": R.BODY_STATE, "body_wrenches": R.WRENCH, "contact_wrenches": R.WRENCH, "ball_wrenches": R.WRENCH,
    "bearing_powers": R.RUNNING,
}
arrays = {name: given[name] for name in given["arrays"]}
arrays |= {name: np.frombuffer(given[name].tobytes(), kind).copy() for name, kind in kinds.items()}
arrays["signals"] = arrays["inputs"].view(R.SIGNAL)
arrays["shared"] = arrays["bodies_now"].view(np.float64)
arrays["shared_rates"] = arrays["body_rates"].view(np.float64)
bundle = L.Bundle(laws=laws, wrench=raceway.raceway_wrenches, tangent=None, **arrays)
rows, powers = [], []
for y in given["trials"]:
    dydt, rates = np.zeros(y.size), np.zeros(L.power_count(bundle))
    assert forces.evaluate(float(given["time"]), y, bundle, dydt, rates, 1) == 1
    rows.append(dydt)
    powers.append(rates)
np.savez(found, dydt=rows, rates=powers)
"""
TIME = 2e-3  # [s]
NAMES = (
    "every body free", "no cage", "ring-guided cage", "elastic ring-guided cage", "other laws", "cells",
    "wavy raceways", "force elements",
)  # fmt: skip


def states_of(m: Machine) -> FloatArray:
    """Return two states of a model."""
    return np.array([random_state(m, seed, mode) for seed, mode in enumerate(("rolling", "sliding"))])


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Evaluate every model without a compiler.

    In one process: return the folder of its results.
    """
    folder = tmp_path_factory.mktemp("plain")
    for name in NAMES:
        give(name, folder / f"{name} given.npz")
    files = [word for name in NAMES for word in (f"{name} given.npz", f"{name}.npz")]
    loop = f"import sys\nwhile len(sys.argv) > 1:\n    exec({PLAIN!r})\n"
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", loop, *files],
        cwd=folder,
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return folder


def give(name: str, file: Path) -> None:
    """Write what data decide about a model."""
    m = machine(*MODELS[name])
    bundle = m.context.bundle
    arrays = {
        name: values if values.dtype.names is None else np.frombuffer(values.tobytes(), np.uint8)
        for name, values in bundle._asdict().items()
        if name not in ("laws", "wrench", "tangent")
    }
    np.savez(
        file,
        case="6319-cp10-1500",
        overrides=np.array(MODELS[name]),
        time=TIME,
        trials=states_of(m),
        arrays=np.array([name for name, values in arrays.items() if values.dtype != np.uint8]),
        **arrays,
    )


@pytest.mark.parametrize("name", NAMES)
def test_right_hand_side(name: str, plain: Path) -> None:
    """Compare compiled and plain code to rounding.

    Sums over cells are taken in another order when they are compiled.
    """
    m, found = machine(*MODELS[name]), np.load(plain / f"{name}.npz")
    for y, dydt, rates in zip(states_of(m), found["dydt"], found["rates"], strict=True):
        ours = m.evaluate(y, TIME)
        # per kind of state: accelerations of balls and of bodies differ by orders of magnitude
        scale = np.abs(ours.dydt) + 1e-6 * m.context.scale * np.abs(ours.dydt / m.context.scale).max()
        assert np.all(np.abs(dydt - ours.dydt) <= 1e-9 * scale)
        assert rates[: len(ours.losses)] == pytest.approx(list(ours.losses.values()), rel=1e-9, abs=1e-12)
