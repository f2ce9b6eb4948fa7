"""Run the commands of a queue's work.

``python -m lambda_cli.queued KIND begin|resume RESULT``.

A queue knows kinds of work, the folder that it starts them in and their results. The words of the command line stand
here.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

# Of each kind: to begin with the case or study of this folder, and to continue a result.
WORDS: dict[tuple[str, str], list[str]] = {
    ("run", "begin"): ["run", "case.toml", "--out"],
    ("run", "resume"): ["resume"],
    ("study", "begin"): ["study", "run", "study.toml", "--out"],
    ("study", "resume"): ["study", "resume"],
}


def main(asked: Sequence[str]) -> int:
    """Run the command of the work, with reports in JSON."""
    from lambda_cli.start import main as start

    kind, step, result = asked
    return start([*WORDS[kind, step], result, "--progress", "json", "--json"])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
