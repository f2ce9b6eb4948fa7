"""Run or resume the real engine to be killed."""

from __future__ import annotations

import sys
from pathlib import Path

from lambda_core import api
from lambda_core.solver.core import core

CASE = "6208-axial-700"
DURATION = 0.8  # [s]
CHANGES = (f"solver.duration={DURATION} s", "output.checkpoint_interval=0.02 s", "electric.seed=1")


def main(verb: str, path: Path) -> None:
    """Do what is asked once everything is loaded."""
    core()
    print("ready", flush=True)
    if verb == "run":
        api.run(CASE, CHANGES, out=path)
    else:
        api.resume(path)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
