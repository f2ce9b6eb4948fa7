"""Start the program before any other import.

Ctrl+C therefore ends it at once with one line.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

_INTERRUPTED = 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the requested command and return its code.

    It imports the commands first. Without `arguments` they are those of the process.
    """
    try:
        from lambda_cli.main import main as run

        return run(arguments)
    except KeyboardInterrupt:  # before or behind the reach of the one that answers it
        sys.stderr.write("interrupted\n")
        return _INTERRUPTED
