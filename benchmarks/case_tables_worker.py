"""Print hashes of the solver tables as JSON.

Runs in the interpreter of either version.
"""

from __future__ import annotations

import hashlib
import json
import sys
from typing import Any

import numpy as np

from lambda_core import api
from lambda_core.solver.drivers.compiled_laws import Kernels, derive_oils
from lambda_core.solver.drivers.first_state import first_frame
from lambda_core.solver.drivers.solver_context import assemble

_ADDRESSES = ("laws", "wrench", "tangent")  # differ from process to process; the laws count by their content


def tables_of(case: dict[str, Any]) -> dict[str, str]:
    """Return the hash of a case's tables.

    Every solver table, its scales and its laws.
    """
    model = api.check(case)
    kernels, frame = Kernels(model), first_frame(model)
    context = assemble(model, kernels, frame, derive_oils(model, kernels, frame))
    found = {name: table for name, table in context.bundle._asdict().items() if name not in _ADDRESSES}
    hashes = {name: _hash(np.ascontiguousarray(table).tobytes()) for name, table in found.items()}
    laws = {element: {role: law.model.label for role, law in roles.items()} for element, roles in model.laws.items()}
    return hashes | {
        "scale": _hash(context.scale.tobytes()),
        "laws": _hash(json.dumps(laws, sort_keys=True).encode()),
    }


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:16]


if __name__ == "__main__":
    json.dump({case["name"]: tables_of(case) for case in json.load(sys.stdin)}, sys.stdout)
