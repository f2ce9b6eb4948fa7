"""Open the served builder in Chromium or a WebSocket client."""

from __future__ import annotations

import asyncio
import codecs
import json
import re
import shutil
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from pathlib import Path

import aiohttp
from playwright.async_api import Page, async_playwright
from rich.cells import cell_len

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
# Name -> what a terminal sends, and what the key is called in a browser
KEYS = {
    "enter": ("\r", "Enter"),
    "down": ("\x1b[B", "ArrowDown"),
    "f5": ("\x1b[15~", "F5"),
    "f8": ("\x1b[19~", "F8"),
    "ctrl+p": ("\x10", "Control+p"),
    "ctrl+s": ("\x13", "Control+s"),
}
_HEIGHT = 1000  # of the window
_OPTIONS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)


class Terminal:
    """Contents of the terminal.

    Understands what the builder sends: moves of the cursor and text.
    """

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
    """Base of both browsers.

    It waits until words are on the terminal.
    """

    def __init__(self) -> None:
        self.terminal = Terminal()

    async def press(self, key: str) -> None:
        """Press a key."""
        raise NotImplementedError

    async def write(self, text: str) -> None:
        """Type a text."""
        raise NotImplementedError

    async def until(self, words: str, *, without: str = "\0", seconds: float = 200.0) -> None:
        """Read until words appear.

        And others do not.
        """
        end = time.monotonic() + seconds
        while words not in (shown := self.terminal.text()) or without in shown:
            left = end - time.monotonic()
            assert left > 0.0, f"waited {seconds} s in vain for {words!r}; on the terminal:\n{shown}"
            await self._read(left)

    async def _read(self, seconds: float) -> None:
        """Wait for a change of the terminal.

        At most so long.
        """
        raise NotImplementedError


class Client(Browser):
    """A client of the page's WebSocket."""

    def __init__(self, line: aiohttp.ClientWebSocketResponse) -> None:
        super().__init__()
        self._line = line

    async def press(self, key: str) -> None:
        """Press a key."""
        await self.write(KEYS[key][0])

    async def write(self, text: str) -> None:
        """Type a text."""
        await self._line.send_str(json.dumps(["stdin", text]))

    async def _read(self, seconds: float) -> None:
        with suppress(TimeoutError):
            async with asyncio.timeout(seconds):
                message = await self._line.receive()
            assert message.type in (aiohttp.WSMsgType.BINARY, aiohttp.WSMsgType.TEXT), message
            if message.type == aiohttp.WSMsgType.BINARY:
                self.terminal.take(message.data)


class Chromium(Browser):
    """A page of headless Chromium."""

    def __init__(self, page: Page) -> None:
        super().__init__()
        self._page = page
        page.on("websocket", lambda line: line.on("framereceived", self._take))

    def _take(self, frame: bytes | str) -> None:
        if isinstance(frame, bytes):
            self.terminal.take(frame)

    async def open(self, address: str) -> None:
        """Open an address.

        Wait until keys go to the terminal of its page without a click.

        Raises
        ------
        AssertionError
            When the terminal is not wholly in the window: the style of the page has not come.
        """
        await self._page.goto(address)
        await self.until("start from nothing")
        await self._page.wait_for_function("document.activeElement.tagName === 'TEXTAREA'")
        box = await self._page.locator(".xterm-screen").bounding_box()
        assert box is not None
        assert box["y"] >= 0.0, box
        assert box["y"] + box["height"] <= _HEIGHT, box

    async def press(self, key: str) -> None:
        """Press a key."""
        await self._page.keyboard.press(KEYS[key][1])

    async def write(self, text: str) -> None:
        """Type a text, key by key."""
        await self._page.keyboard.type(text)

    async def _read(self, seconds: float) -> None:
        await asyncio.sleep(min(seconds, 0.05))


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
    """Open the page in headless Chromium.

    With a profile of its own in `folder`.
    """
    async with aiohttp.ClientSession() as session:
        await _page(session, address)
    async with async_playwright() as playwright:
        context = await playwright.chromium.launch_persistent_context(
            folder, executable_path=CHROMIUM, args=_OPTIONS, viewport={"width": 1700, "height": _HEIGHT}
        )
        try:
            browser = Chromium(await context.new_page())
            await browser.open(address)
            yield browser
        finally:
            await context.close()


async def _page(session: aiohttp.ClientSession, address: str) -> str:
    """Return the page once the server answers."""
    end = time.monotonic() + 200.0
    while True:
        try:
            async with session.get(address) as answer:
                return await answer.text()
        except aiohttp.ClientConnectorError:
            assert time.monotonic() < end, "the server does not answer"
            await asyncio.sleep(0.2)
