"""Test the builder in a browser.

A case is built from nothing and run; the program states who may reach it.
"""

from __future__ import annotations

import asyncio
import os
import re
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from lambda_gui.serve import is_loopback, warning

from lambda_core import api

pytest.importorskip("textual_serve")
pytest.importorskip("aiohttp")
pytest.importorskip("playwright")

import aiohttp
from browsing import CHROMIUM, Browser, chromium, client
from lambda_gui.auth import MOST_SOCKETS


def test_only_this_machine_unless_told_otherwise() -> None:
    for host in ("localhost", "127.0.0.1", "::1"):
        assert is_loopback(host)
        assert not warning(host)
    for host in ("0.0.0.0", "192.168.1.5", "example.org"):
        assert "no password" in warning(host)


@pytest.fixture
def served(work_folder: Path) -> Iterator[str]:
    """Serve the builder without a case.

    Return the address that it prints.
    """
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        port = int(found.getsockname()[1])
    command = [sys.executable, "-m", "lambda_cli", "gui", "--serve", "--port", str(port)]
    server = subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, env=os.environ, text=True)
    assert server.stderr is not None
    try:
        said = server.stderr.readline()
        found_address = re.search(r"http://\S+/", said)
        assert found_address is not None, said
        yield found_address[0]
    finally:
        server.terminate()
        server.wait(60)


def test_nobody_else_is_served_and_a_port_in_use_is_said(served: str) -> None:
    port = urlsplit(served).port
    with socket.socket() as line:
        line.settimeout(1.0)
        other = socket.gethostbyname(socket.gethostname())
        if not other.startswith("127."):
            assert line.connect_ex((other, port)) != 0
    command = [sys.executable, "-m", "lambda_cli", "gui", "--serve", "--port", str(port)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 2
    assert "cannot serve" in done.stderr


_LET_IN: tuple[tuple[str, dict[str, str], int], ...] = (
    ("", {}, 200),
    ("static/js/textual.js", {}, 200),
    ("static/", {}, 403),  # no listing
    ("../", {}, 404),  # without the secret there is nothing
    ("../ws", {}, 404),
    ("", {"Host": "evil.example"}, 403),
    ("ws", {"Host": "evil.example", "Origin": "https://evil.example"}, 403),
    ("ws", {"Origin": "http://localhost:9001"}, 403),
    ("ws", {"Origin": "https://evil.example"}, 403),
    ("ws", {"Origin": "null"}, 403),
)


async def test_c2_2_another_page_cannot_drive_the_builder(served: str) -> None:
    async with aiohttp.ClientSession() as session:
        for path, headers, status in _LET_IN:
            async with session.get(served + path, headers=headers) as answer:
                assert answer.status == status, (path, headers)
                page = await answer.text()
                if not path and status == 200:
                    assert "https://" not in page
                    assert f'href="{served}static/css/xterm.css"' in page
                    assert "connect-src 'self' ws://localhost" in answer.headers["Content-Security-Policy"]
        lines = [await session.ws_connect(f"{served}ws") for _ in range(MOST_SOCKETS)]
        with pytest.raises(aiohttp.WSServerHandshakeError, match="503"):
            await session.ws_connect(f"{served}ws")
        for line in lines:
            await line.close()


async def build_and_run(browser: Browser) -> None:
    """Build, save and run a bearing.

    The 6208 of the paper under 1300 N from nothing, for 5 ms.
    """
    await browser.until("which case?")
    await browser.press("enter")
    await browser.until("4 mistakes", without="which case?")
    await browser.press("f8")
    await browser.until("designation  catalogue designation")
    await browser.write("6208")
    await browser.until("choose one: ")
    await browser.press("down")
    await browser.until("maker  whose design")
    await browser.write("Syla2026")
    await browser.until("3 mistakes")
    oil = (
        ("oil or grease  catalogue name", "bode-mineral", "2 mistakes"),
        ("temperature  temperature", "40", "1 mistake "),
    )
    for about, text, left in oil:
        await browser.press("f8")
        await browser.until(about)
        await browser.write(text)
        await browser.until(left)
    await browser.press("f8")
    await browser.until("speed  speed of the inner ring")
    await browser.write("2750 rpm")
    await browser.until("ready")
    for place, label, about, text in (
        ("loads.axial", "axial load", "axial load on the inner ring", "1300 N"),
        ("solver.duration", "simulated time", "simulated time", "5 ms"),
    ):
        await browser.press("ctrl+p")
        await browser.until("Search for commands")
        await browser.write(place)
        await browser.until(about)
        await browser.press("enter")
        await browser.until(f"{label}  {about}")  # the help next to the form
        await browser.write(text)
        await browser.until(text)
    await browser.until("ready")
    await browser.press("ctrl+s")
    await browser.until("Save the case as")
    await browser.press("enter")
    await browser.until("untitled.toml", without="unsaved")
    await browser.press("f5")
    await browser.until("✔  untitled")
    await browser.press("enter")
    await browser.until("power loss")  # the summary
    await browser.press("down")
    await browser.until("over azimuth")  # the first view
    await browser.write("t")
    await browser.until("report into the file")
    await browser.press("enter")
    await browser.until("untitled.html")


def saw_to_it(folder: Path) -> None:
    """Check what is on the disk."""
    case = api.case(folder / "untitled.toml")
    assert (case.bearing.designation, case.bearing.maker) == ("6208", "Syla2026")
    assert (case.lubricant.name, case.loads.axial) == ("bode-mineral", 1300.0)
    assert api.summary(folder / "untitled.h5").simulated_s == pytest.approx(0.005, rel=0.05)


@pytest.mark.skipif(CHROMIUM is not None, reason="Chromium does the same")
@pytest.mark.full  # by keyboard without a server: tests/gui/test_runs.py
async def test_a_case_is_built_and_run_through_the_web_socket(served: str, work_folder: Path) -> None:
    async with client(served) as browser:
        await build_and_run(browser)
    await asyncio.to_thread(saw_to_it, work_folder)


@pytest.mark.skipif(CHROMIUM is None, reason="needs chromium on PATH")
@pytest.mark.full
async def test_a_case_is_built_and_run_in_chromium(served: str, work_folder: Path, tmp_path: Path) -> None:
    async with chromium(served, tmp_path / "profile") as browser:
        await build_and_run(browser)
    await asyncio.to_thread(saw_to_it, work_folder)
