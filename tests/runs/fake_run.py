"""Run or resume the fake engine in its own process.

``fake_run.py run|resume FILE JSON``

JSON: ``truth`` (fields of Truth), ``solver`` (changed settings), ``limit`` (RLIMIT_FSIZE in
bytes), ``checkpoint_interval``. Ends like the program does: message on stderr, exit code.
"""

from __future__ import annotations

import json
import resource
import sys
from dataclasses import replace
from pathlib import Path

from fake_engine import FakeEngine, Truth

from lambda_core import api
from lambda_core.domain.errors import LambdaError
from lambda_core.results.provenance import Provenance
from lambda_core.runs.loop import resume, run


def main() -> int:
    verb, path, text = sys.argv[1:4]
    wanted = json.loads(text)
    model = api.check("6319-cp10-1500")
    output = replace(model.output, checkpoint_interval=wanted.get("checkpoint_interval", 0.0))
    model = replace(model, solver=replace(model.solver, **wanted.get("solver", {})), output=output)
    engine = FakeEngine(Truth(**wanted.get("truth", {})))
    if "limit" in wanted:
        resource.setrlimit(resource.RLIMIT_FSIZE, (wanted["limit"], wanted["limit"]))
    print("ready", flush=True)
    try:
        (run if verb == "run" else resume)(engine, Provenance.alone(model, {"core": "abc"}), Path(path))
    except LambdaError as error:
        print(error, file=sys.stderr)
        return error.exit_code
    return 0


if __name__ == "__main__":
    sys.exit(main())
