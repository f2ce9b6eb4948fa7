"""Start the program before any other import.

Ctrl+C therefore ends it at once with one line.
"""

from __future__ import annotations

import sys

_INTERRUPTED = 130


def main() -> int:
    """Run the requested command and return its code.

    It imports the commands first.
    """
    try:
        from lambda_cli.main import main as run

        return run()
    except KeyboardInterrupt:  # before or behind the reach of the one that answers it
        sys.stderr.write("interrupted\n")
        return _INTERRUPTED
