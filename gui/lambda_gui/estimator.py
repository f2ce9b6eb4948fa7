"""The process that solves equilibria for the numbers beside the form.

It is a process of its own because compiled code takes seconds to load and holds the
interpreter meanwhile: ``python -m lambda_gui.estimator`` reads one JSON object per line
(``id``, ``tables``, ``folder``) and answers with lines of ``id`` and ``say`` (what it is
doing), ``error`` (a sentence), or ``estimate``.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any


def answer(question: dict[str, Any], reply: Callable[..., None]) -> None:
    """Answer one question."""
    from lambda_core import api

    number = question["id"]
    folder = Path(question["folder"]) if question["folder"] else None
    try:
        model = api.check(question["tables"], folder=folder)
        found = api.estimate(model, announce=lambda text: reply(id=number, say=text))
    except api.LambdaError as error:
        reply(id=number, error=str(error))
        return
    reply(id=number, estimate=found.model_dump(mode="json"))


def main() -> None:
    """Answer until the other side closes the line."""
    out = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # nothing else may write between the answers

    def reply(**data: Any) -> None:
        print(json.dumps(data), file=out, flush=True)

    if hasattr(os, "nice"):
        os.nice(5)
    for line in sys.stdin:
        answer(json.loads(line), reply)


if __name__ == "__main__":
    main()
