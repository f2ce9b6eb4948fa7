"""Compare solver tables of 200 cases with another version.

``python -m benchmarks.case_tables --against PYTHON``.

case_tables.jsonl holds 200 single-bearing cases, one JSON object a line, drawn at random in November 2026: five kinds
of bearings from the catalogue and of own geometry, every kind of time function, support and load, laws of every role,
elastic parts, force elements. All were valid at 8b1ff10. A change that only moves code assembles the same tables byte
by byte. Tables over time count as a change since then: their default is another interpolation.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from benchmarks.endstates import States, tell

HERE = Path(__file__).parent


def cases() -> list[dict[str, Any]]:
    """Return the 200 cases."""
    return [json.loads(line) for line in (HERE / "case_tables.jsonl").read_text(encoding="utf-8").splitlines()]


def ask(python: str, chosen: Sequence[dict[str, Any]]) -> States:
    """Return table -> hash of each case.

    As the version of that interpreter assembles them.

    Raises
    ------
    RuntimeError
        With the error output of the version when it failed.
    """
    done = subprocess.run(
        [python, "-P", str(HERE / "case_tables_worker.py")], input=json.dumps(chosen), capture_output=True, text=True
    )
    if done.returncode != 0:
        raise RuntimeError(f"{python} could not assemble the cases:\n{done.stderr}")
    answer: States = json.loads(done.stdout)
    return answer


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare the tables of all cases.

    Print a line per case: return 1 when any byte differs.
    """
    parser = argparse.ArgumentParser(prog="python -m benchmarks.case_tables", description=__doc__)
    parser.add_argument("--against", metavar="PYTHON", required=True, help="interpreter of the other version")
    options = parser.parse_args(arguments)
    chosen = cases()
    return 1 if tell(ask(sys.executable, chosen), ask(options.against, chosen)) else 0


if __name__ == "__main__":
    sys.exit(main())
