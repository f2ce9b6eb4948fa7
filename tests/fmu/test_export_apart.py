"""Test the process that exports for another processor."""

from __future__ import annotations

import os
import signal

import psutil
import pytest

from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.export.fmu import unit_file


def test_what_it_says_is_announced(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(unit_file, "_SERVING", "import sys; print('one'); print(sys.stdin.read())")
    heard: list[str] = []
    unit_file._write_apart({"name": "two"}, "x86-64-v3", heard.append)
    assert heard == ["one", '{"name": "two"}']


@pytest.mark.parametrize(("code", "kind"), [(UsageError.exit_code, UsageError), (SolverError.exit_code, SolverError)])
def test_what_is_wrong_is_raised(code: int, kind: type[Exception], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(unit_file, "_SERVING", f"import sys; print('no oil', file=sys.stderr); sys.exit({code})")
    with pytest.raises(kind, match=r"^no oil$"):
        unit_file._write_apart({}, "native", None)


def test_a_request_to_stop_ends_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Interrupt an export that would compile for ever."""
    monkeypatch.setattr(unit_file, "_SERVING", "import time; print('compiling', flush=True); time.sleep(1e6)")

    def stop(sentence: str) -> None:
        os.kill(os.getpid(), signal.SIGINT)

    before, handler = set(psutil.Process().children()), signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            unit_file._write_apart({}, "native", stop)
    finally:
        signal.signal(signal.SIGINT, handler)
    _, alive = psutil.wait_procs(set(psutil.Process().children()) - before, timeout=30.0)
    assert not alive
