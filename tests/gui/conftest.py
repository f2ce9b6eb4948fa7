"""Share fixtures among the tests of the builder.

Each has folders of its own, and no helper process unless a test needs one.
"""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from lambda_gui import runs
from lambda_gui.helper import Estimator

sys.path.insert(0, str(Path(__file__).parent))

from driving import HAND_WRITTEN, hear_every_key
from warm import Warm


@pytest.fixture(scope="session", autouse=True)
def keys_are_heard() -> Iterator[None]:
    """Go on once a key was heard.

    However slow the machine.
    """
    with pytest.MonkeyPatch.context() as patch:
        hear_every_key(patch)
        yield


@pytest.fixture(autouse=True)
def work_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in an empty folder, with own data."""
    monkeypatch.setenv("LAMBDA_BEARING_DATA", str(tmp_path / "data"))
    work = tmp_path / "work"
    work.mkdir()
    monkeypatch.chdir(work)
    return work


@pytest.fixture(autouse=True)
def quiet_estimator(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave the estimator out: it loads compiled code for seconds."""
    if "estimates" in request.fixturenames:
        return

    async def ask(self: Estimator, tables: dict[str, Any], folder: Path | None) -> None:
        return

    monkeypatch.setattr(Estimator, "ask", ask)


HELPER = ("-P", "-m", "lambda_gui.helper_process")


@pytest.fixture(autouse=True)
def no_process_is_left(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch, warm: Warm) -> Iterator[None]:
    """Find processes that a test leaves.

    The collector would find them in some later test.

    Helper processes begin with everything imported, unless a test says `fresh_helper`.
    """
    begun, begin = [], asyncio.base_events.BaseEventLoop.subprocess_exec
    is_warm = "fresh_helper" not in request.fixturenames

    async def remember(
        self: asyncio.base_events.BaseEventLoop, protocol: Any, program: str, *words: str, **options: Any
    ) -> Any:
        if words == HELPER and is_warm:
            program = (await asyncio.to_thread(warm.ready)).python
        transport, protocol = await begin(self, protocol, program, *words, **options)
        begun.append(transport)
        return transport, protocol

    monkeypatch.setattr(asyncio.base_events.BaseEventLoop, "subprocess_exec", remember)
    yield
    assert [transport for transport in begun if not transport.is_closing()] == []


@pytest.fixture
def fresh_helper() -> None:
    """Let the helper process start as for a user."""


@pytest.fixture
def warm_program(monkeypatch: pytest.MonkeyPatch, warm: Warm) -> None:
    """Let runs and studies begin with everything imported."""
    monkeypatch.setattr(runs, "_PROGRAM", (warm.ready().python, "-P", "-m", "lambda_cli.queued"))


@pytest.fixture
def estimates() -> None:
    """Let the estimator work in this test."""


@pytest.fixture
def hand_written(work_folder: Path) -> Path:
    """Write a case by hand."""
    path = work_folder / "drive-end.toml"
    path.write_text(HAND_WRITTEN, encoding="utf-8")
    return path
