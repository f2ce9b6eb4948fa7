"""Time integrations in the interpreter of one version.

Reads its tasks line by line and prints processor times.

A question is one line of JSON on stdin (case, overrides, duration), the answer one on stdout. Uses nothing but
``lambda_core.api`` and the engine, wherever the version keeps it, so that versions with other packages work.
"""

from __future__ import annotations

import importlib
import json
import sys
import time
from typing import Any

_ENGINES = ("lambda_core.solver.drivers.dynamics", "lambda_core.physics.dynamics", "lambda_core.simulate.dynamics")


def engine_type() -> Any:
    """Return the class of the engine of this version."""
    for name in _ENGINES:
        try:
            return importlib.import_module(name).BearingEngine
        except ImportError:
            continue
    raise SystemExit("this version keeps its engine where nobody looks for it")


def passage(case: str, overrides: dict[str, Any], duration: float) -> dict[str, float]:
    """Integrate a case from its equilibrium.

    Returns processor time [s], evaluations, steps, energy residual.
    """
    from lambda_core import api

    engine = engine_type()(api.check(api.case(case).with_(**overrides)))
    began = time.thread_time()
    done = engine.advance(duration)
    seconds = time.thread_time() - began
    if not done.ok:
        raise RuntimeError(done.message)
    sums, counts = engine.integrals(), engine.statistics()
    lost = sum(value for name, value in sums.items() if name.startswith("loss."))
    residual = (sums["input"] - lost - sums["stored"]) / max(sums["input_abs"], lost)
    simulated = float(engine.time)
    return {
        "seconds": seconds / simulated,
        "evaluations": counts["rhs_calls"] / simulated,
        "steps": counts["steps"] / simulated,
        "residual": residual,
        "loss": lost / simulated,
    }


def answer(line: str) -> dict[str, Any]:
    """Return the answer to one question.

    {"error": ...} where there is none.
    """
    try:
        return passage(**json.loads(line))
    except Exception as error:  # whatever a version of long ago says, the other one goes on
        return {"error": f"{type(error).__name__}: {error}"}


if __name__ == "__main__":
    for question in sys.stdin:
        print(json.dumps(answer(question)), flush=True)
