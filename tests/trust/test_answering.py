"""Test that Ctrl+C is answered within a second."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest
from trust.answering import STATES, measure

INTERRUPTED = 130


@pytest.mark.clock
@pytest.mark.parametrize("state", [state.name for state in STATES])
def test_c2_4_ctrl_c_is_answered_within_a_second(state: str, tmp_path: Path) -> None:
    (found,) = measure(tmp_path, (state,), signal.SIGINT).values()
    # Where the signal met code that Python made from text, it ends the process by the signal itself: 130 in a shell.
    assert found.code in (INTERRUPTED, -signal.SIGINT), found.said
    assert found.wall < 1.0


@pytest.mark.parametrize("begin", ["import lambda_cli.main", "from lambda_core.studies.pool import _begin; _begin()"])
def test_c2_4_an_end_does_not_look_for_cycles_in_all_that_was_compiled(begin: str) -> None:
    """Skip the search for cycles at the end.

    It took half a second each for command line and workers of studies.
    """
    code = f"import atexit, gc; atexit.register(lambda: print(gc.get_freeze_count() > 1000)); {begin}"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300, check=True)
    assert done.stdout.strip() == "True"


@pytest.mark.full
def test_d11_a_bearing_at_rest_stops_when_asked(tmp_path: Path) -> None:
    """Stop a bearing at rest on request.

    Standstill with smoothed friction takes thousands of seconds a simulated second: in the time of the processor.
    """
    (found,) = measure(tmp_path, ("standstill",), signal.SIGTERM).values()
    assert found.code == INTERRUPTED, found.said
    assert found.processor < 20.0
