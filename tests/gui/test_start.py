"""How fast the builder comes up, that it stands a broken plugin, and that it can be served."""

from __future__ import annotations

import asyncio
import json
import os
import re
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from driving import LARGE, SMALL, builder, checked, screen_text
from lambda_gui.app import BuilderApp
from lambda_gui.serve import is_loopback, warning

from lambda_core.registry import manager

FIRST_PAINT = """
import time
from lambda_gui.app import BuilderApp
class Timed(BuilderApp):
    async def _timed(self):
        print(time.process_time(), flush=True)
        self.exit()
    def on_ready(self):
        self.run_worker(self._timed())
Timed("6208-axial-1300").run(headless=True, size=(80, 24))
"""


def test_the_first_picture_stands_within_a_second_and_a_half() -> None:
    taken = []
    for _ in range(3):
        done = subprocess.run([sys.executable, "-c", FIRST_PAINT], capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        taken.append(float(done.stdout.split()[0]))
    assert min(taken) < 1.5  # seconds of the processor: other programs of the machine do not count


def test_starting_loads_nothing_heavy() -> None:
    code = (
        "import sys, lambda_gui.app; print([m for m in ('numba', 'h5py', 'scipy', 'matplotlib') if m in sys.modules])"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "[]"


async def test_a_broken_plugin_is_left_out(hand_written: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def load() -> object:
        raise RuntimeError("this plugin is broken")

    sources = [*manager.installed(), manager.Source("broken-plugin", "0.1", "broken", load)]
    monkeypatch.setattr(manager, "installed", lambda group=manager.GROUP: sources)
    manager.registry.cache_clear()
    try:
        async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
            await checked(pilot)
            assert not builder(pilot).check.problems
            assert "ready" in screen_text(pilot.app)
    finally:
        manager.registry.cache_clear()


async def test_a_catalogue_that_cannot_be_opened_is_said(hand_written: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(manager.OFF_VARIABLE, "catalogue")
    manager.registry.cache_clear()
    try:
        async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
            await checked(pilot)
            assert "no plugin provides a catalogue" in builder(pilot).check.problems[0].message
            await pilot.press("f2")
            await pilot.pause(0.2)
            assert pilot.app.is_running
    finally:
        manager.registry.cache_clear()


def test_only_this_machine_unless_told_otherwise() -> None:
    for host in ("localhost", "127.0.0.1", "::1"):
        assert is_loopback(host)
        assert not warning(host)
    for host in ("0.0.0.0", "192.168.1.5", "example.org"):
        assert "no password" in warning(host)


def free_port() -> int:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return int(found.getsockname()[1])


async def test_the_served_builder_starts_a_run(work_folder: Path, shared_compiled_code: None) -> None:
    """A browser's part is played by a client of the page's WebSocket."""
    pytest.importorskip("textual_serve")
    aiohttp = pytest.importorskip("aiohttp")
    (work_folder / "short.toml").write_text(SHORT, encoding="utf-8")
    port = free_port()
    server = subprocess.Popen(
        [sys.executable, "-m", "lambda_cli", "gui", "short.toml", "--serve", "--port", str(port)],
        stderr=subprocess.DEVNULL,
        env=os.environ,
    )
    try:
        async with aiohttp.ClientSession() as session:
            page = await _page(session, port)
            assert "lambda-bearing" in page
            address = f"http://localhost:{port}/ws?width=100&height=30"
            async with session.ws_connect(address) as line:
                seen = await _read_until(line, "ready", 60.0)
                assert "short.toml" in seen
                await line.send_str(json.dumps(["stdin", "\x1b[15~"]))  # F5
                await _read_until(line, "short.h5", 200.0)
    finally:
        server.terminate()
        server.wait(20)
    for _ in range(200):
        if (work_folder / "short.h5").exists():
            break
        await asyncio.sleep(0.1)
    assert (work_folder / "short.h5").exists()


async def _page(session: object, port: int) -> str:
    import aiohttp

    assert isinstance(session, aiohttp.ClientSession)
    end = time.monotonic() + 40.0
    while True:
        try:
            async with session.get(f"http://localhost:{port}/") as answer:
                return await answer.text()
        except aiohttp.ClientConnectorError:
            assert time.monotonic() < end
            await asyncio.sleep(0.2)


async def _read_until(line: object, words: str, seconds: float) -> str:
    """Return what the terminal was sent until some words were among it."""
    import aiohttp

    assert isinstance(line, aiohttp.ClientWebSocketResponse)
    seen, end = "", time.monotonic() + seconds
    while words not in seen:
        message = await line.receive(timeout=max(0.1, end - time.monotonic()))
        assert message.type in (aiohttp.WSMsgType.BINARY, aiohttp.WSMsgType.TEXT), message
        data = message.data.decode("utf-8", "replace") if isinstance(message.data, bytes) else message.data
        seen += re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", data)
    return seen


SHORT = """\
name = "short"

[bearing]
designation = "6208"
maker = "Syla2026"

[lubricant]
name = "bode-mineral"
temperature = "40 degC"

[loads]
axial = "1300 N"

[operation]
speed = "2750 rpm"

[solver]
duration = "5 ms"
"""


def test_without_a_terminal_it_says_what_to_do_instead() -> None:
    """Its screen would go into a file or a pipe, and no key would ever come."""
    answer = subprocess.run(
        [sys.executable, "-m", "lambda_cli", "gui"],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert (answer.returncode, answer.stdout) == (2, "")
    assert answer.stderr == "the builder needs a terminal; lambda-bearing gui --serve shows it in a browser\n"
