"""A browser in front of the served builder: headless Chromium, or a client of the page's WebSocket."""

from __future__ import annotations

import asyncio
import base64
import codecs
import json
import re
import shutil
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from itertools import count
from pathlib import Path
from typing import Any

import aiohttp
from rich.cells import cell_len

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
# Name -> what a terminal sends, and what a browser's key event carries
KEYS: dict[str, tuple[str, dict[str, Any]]] = {
    "enter": ("\r", {"key": "Enter", "windowsVirtualKeyCode": 13, "text": "\r"}),
    "tab": ("\t", {"key": "Tab", "windowsVirtualKeyCode": 9}),
    "down": ("\x1b[B", {"key": "ArrowDown", "windowsVirtualKeyCode": 40}),
    "f5": ("\x1b[15~", {"key": "F5", "windowsVirtualKeyCode": 116}),
    "f8": ("\x1b[19~", {"key": "F8", "windowsVirtualKeyCode": 119}),
    "ctrl+p": ("\x10", {"key": "p", "windowsVirtualKeyCode": 80, "modifiers": 2}),
    "ctrl+s": ("\x13", {"key": "s", "windowsVirtualKeyCode": 83, "modifiers": 2}),
}


class Terminal:
    """What stands on the terminal: understands as much as the builder sends, moves of the cursor and text."""

    _SEQUENCE = re.compile(
        r"\x1b\[(?P<place>\d+;\d+)H|\x1b\[[0-9;?=><]*[ -/]*[@-~]|\x1b[^\[]|(?P<text>[^\x1b\x00-\x1f]+)"
    )
    _CUT = re.compile(r"\x1b(\[[0-9;?=><]*)?$")

    def __init__(self) -> None:
        self._cells: dict[tuple[int, int], str] = {}
        self._decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self._rest = ""
        self._line = self._column = 1

    def take(self, data: bytes) -> None:
        """Take in what is sent; it may be cut anywhere."""
        text = self._rest + self._decoder.decode(data)
        cut = self._CUT.search(text)
        text, self._rest = (text[: cut.start()], text[cut.start() :]) if cut else (text, "")
        for found in self._SEQUENCE.finditer(text):
            if found["place"]:
                self._line, self._column = (int(part) for part in found["place"].split(";"))
            for letter in found["text"] or "":
                self._cells[self._line, self._column] = letter
                self._column += cell_len(letter)

    def text(self) -> str:
        """Return the lines."""
        height, width = (max((cell[side] for cell in self._cells), default=0) + 1 for side in (0, 1))
        return "\n".join(
            "".join(self._cells.get((line, column), " ") for column in range(width)) for line in range(height)
        )


class Browser:
    """What both ways have in common: waiting until words stand on the terminal."""

    def __init__(self, line: aiohttp.ClientWebSocketResponse) -> None:
        self._line = line
        self._terminal = Terminal()

    async def press(self, key: str) -> None:
        """Press a key."""
        raise NotImplementedError

    async def write(self, text: str) -> None:
        """Type a text."""
        raise NotImplementedError

    async def until(self, words: str, *, without: str = "\0", seconds: float = 30.0) -> None:
        """Read until words stand on the terminal, and others do not."""
        end = time.monotonic() + seconds
        while words not in (shown := self._terminal.text()) or without in shown:
            left = end - time.monotonic()
            assert left > 0.0, f"waited {seconds} s in vain for {words!r}; on the terminal:\n{shown}"
            try:
                await self._read(left)
            except TimeoutError:
                continue

    async def _read(self, seconds: float) -> dict[str, Any]:
        raise NotImplementedError


class Client(Browser):
    """A client of the page's WebSocket."""

    async def press(self, key: str) -> None:
        """Press a key."""
        await self.write(KEYS[key][0])

    async def write(self, text: str) -> None:
        """Type a text."""
        await self._line.send_str(json.dumps(["stdin", text]))

    async def _read(self, seconds: float) -> dict[str, Any]:
        async with asyncio.timeout(seconds):
            message = await self._line.receive()
        assert message.type in (aiohttp.WSMsgType.BINARY, aiohttp.WSMsgType.TEXT), message
        if message.type == aiohttp.WSMsgType.BINARY:
            self._terminal.take(message.data)
        return {}


class Chromium(Browser):
    """A page of headless Chromium, driven by its own protocol."""

    _numbers = count(1)

    async def ask(self, method: str, **parameters: Any) -> dict[str, Any]:
        """Have the browser do something."""
        number = next(self._numbers)
        await self._line.send_json({"id": number, "method": method, "params": parameters})
        while True:
            answer = await self._read(30.0)
            if answer.get("id") == number:
                assert "error" not in answer, answer
                return dict(answer["result"])

    async def until_it_has_the_keyboard(self, seconds: float = 20.0) -> None:
        """Wait until keys go to the terminal of the page, of its own accord."""
        async with asyncio.timeout(seconds):
            while True:
                found = await self.ask("Runtime.evaluate", expression="document.activeElement.tagName")
                if found["result"]["value"] == "TEXTAREA":
                    return
                await asyncio.sleep(0.1)

    async def press(self, key: str) -> None:
        """Press a key."""
        event = KEYS[key][1]
        await self.ask("Input.dispatchKeyEvent", type="keyDown" if "text" in event else "rawKeyDown", **event)
        await self.ask("Input.dispatchKeyEvent", type="keyUp", **{k: v for k, v in event.items() if k != "text"})

    async def write(self, text: str) -> None:
        """Type a text."""
        await self.ask("Input.insertText", text=text)

    async def _read(self, seconds: float) -> dict[str, Any]:
        async with asyncio.timeout(seconds):
            answer: dict[str, Any] = await self._line.receive_json()
        if answer.get("method") == "Network.webSocketFrameReceived":
            frame = answer["params"]["response"]
            if frame["opcode"] == 2:
                self._terminal.take(base64.b64decode(frame["payloadData"]))
        return answer


@asynccontextmanager
async def client(address: str) -> AsyncIterator[Browser]:
    """Open the page's WebSocket, as its script does."""
    async with aiohttp.ClientSession() as session:
        assert "lambda-bearing" in await _page(session, address)
        async with session.ws_connect(f"{address}ws?width=160&height=48") as line:
            browser = Client(line)
            await browser.until("which case?")
            await line.send_str(json.dumps(["focus"]))  # the page says so when it has the keyboard
            yield browser


@asynccontextmanager
async def chromium(address: str, folder: Path) -> AsyncIterator[Browser]:
    """Open the page in headless Chromium with a profile of its own in `folder`."""
    assert CHROMIUM is not None
    options = ("--headless", "--no-sandbox", "--disable-gpu", "--window-size=1700,1000", "--remote-debugging-port=0")
    process = await asyncio.create_subprocess_exec(
        CHROMIUM, *options, f"--user-data-dir={folder}", "about:blank", stderr=asyncio.subprocess.PIPE
    )
    try:
        assert process.stderr is not None
        debug = ""
        async with asyncio.timeout(60.0):
            while "DevTools listening" not in debug:
                debug = (await process.stderr.readline()).decode()
        listening = re.search(r"ws://([^/]+)/", debug)
        assert listening is not None
        drain = asyncio.create_task(process.stderr.read())  # what it says later must not fill the pipe
        async with aiohttp.ClientSession() as session:
            await _page(session, address)
            async with session.get(f"http://{listening[1]}/json/list") as answer:
                pages = [page for page in await answer.json(content_type=None) if page["type"] == "page"]
            async with session.ws_connect(pages[0]["webSocketDebuggerUrl"], max_msg_size=0) as line:
                browser = Chromium(line)
                await browser.ask("Network.enable")
                await browser.ask("Page.navigate", url=address)
                await browser.until("which case?")
                await browser.until_it_has_the_keyboard()
                yield browser
        drain.cancel()
    finally:
        process.terminate()
        await process.wait()


async def _page(session: aiohttp.ClientSession, address: str) -> str:
    """Return the page once the server answers."""
    end = time.monotonic() + 40.0
    while True:
        try:
            async with session.get(address) as answer:
                return await answer.text()
        except aiohttp.ClientConnectorError:
            assert time.monotonic() < end, "the server does not answer"
            await asyncio.sleep(0.2)
