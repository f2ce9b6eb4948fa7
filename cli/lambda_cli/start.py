"""Begin the program: nothing is imported yet, so that Ctrl+C ends it in one line at once."""

from __future__ import annotations

import sys

_INTERRUPTED = 130


def main() -> int:
    """Import the commands and run the one that is asked for; return the exit code."""
    try:
        from lambda_cli.main import main as run

        return run()
    except KeyboardInterrupt:  # before or behind the reach of the one that answers it
        sys.stderr.write("interrupted\n")
        return _INTERRUPTED
