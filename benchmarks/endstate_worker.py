"""End states of cases as one JSON object on stdout: run by the interpreter of the version that is asked.

Uses nothing but ``lambda_core.api``, so that versions with other rooms can be asked too.
"""

from __future__ import annotations

import hashlib
import json
import sys
from typing import Any

import numpy as np

from lambda_core import api


def end_state(case: str, overrides: dict[str, Any], duration: float) -> dict[str, str]:
    """Return the hash of every channel of `case` at the first step past `duration` [s]."""
    changed = api.case(case).with_(**overrides, solver={"duration": f"{duration!r} s"})
    last = None
    for step in api.iterate(changed):
        last = step
    if last is None:
        raise SystemExit(f"{case}: no step was taken")
    found = {name: np.ascontiguousarray(values, dtype=np.float64) for name, values in last.channels.items()}
    found["time"] = np.array([last.time_s])
    return {name: hashlib.sha256(values.tobytes()).hexdigest()[:16] for name, values in found.items()}


if __name__ == "__main__":
    question = json.load(sys.stdin)
    states = {name: end_state(name, question["overrides"], question["duration"]) for name in question["cases"]}
    json.dump(states, sys.stdout)
