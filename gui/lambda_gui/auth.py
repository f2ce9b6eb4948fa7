"""Protect the builder in a browser by a password.

Who drives the builder has the rights of the user.

Any page that is open in a browser may send requests to this machine. What it cannot do is know a secret, or say that
it came from elsewhere than it did: every path begins with a random word, Origin and Host must be those of the address.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import re
import secrets
from collections.abc import Awaitable, Callable
from typing import Any

from aiohttp import web
from aiohttp_jinja2 import setup
from jinja2 import FileSystemLoader
from textual_serve.server import Server

MOST_SOCKETS = 4  # builders at once, two processes each
_FROM_OUTSIDE = r"<link[^>]*\"https?://(?!{host}/)[^>]*>"  # fonts; the page's own style has a full address, too
# The keyboard belongs to the builder from the start, and again when its tab comes to the front: keys would do what the
# browser does with them, F5 load the page anew.
_KEYBOARD = """<script>
const keys = () => document.querySelector("textarea");
const waiting = setInterval(() => {
  if (keys() && document.body.classList.contains("-first-byte")) { keys().focus(); clearInterval(waiting); }
}, 100);
addEventListener("focus", () => keys()?.focus());
</script></body>"""
Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class LockedServer(Server):  # type: ignore[misc, unused-ignore]
    """Textual's server behind a secret path.

    Parameters
    ----------
    command : str
        What runs in every tab.
    names : set of str
        Hosts that a request may name; empty when any may, because other machines are let in under names of their own.
    announce : callable
        Called with the address of the builder once it can be opened.
    """

    def __init__(
        self, command: str, host: str, port: int, title: str, names: set[str], announce: Callable[[str], None]
    ) -> None:
        super().__init__(command, host=host, port=port, title=title)
        self._word = secrets.token_urlsafe(24)
        self._names = names
        self._announce = announce
        self._sockets = 0

    def initialize_logging(self) -> None:
        """Log no requests.

        Their paths hold the secret, and those of strangers would fill the terminal.
        """
        logging.getLogger("aiohttp").setLevel(logging.CRITICAL)

    async def _make_app(self) -> web.Application:
        @web.middleware
        async def check(request: web.Request, handler: Handler) -> web.StreamResponse:
            return await self._check(request, handler)

        app = web.Application(middlewares=[check])
        setup(app, loader=FileSystemLoader(self.templates_path), autoescape=True)
        app.add_routes(
            [
                web.get(f"/{self._word}/", self.handle_index, name="index"),
                web.get(f"/{self._word}/ws", self.handle_websocket, name="websocket"),
                web.get(f"/{self._word}/download/{{key}}", self.handle_download, name="download"),
                web.static(f"/{self._word}/static", self.statics_path, name="static"),
            ]
        )
        app.on_startup.append(self.on_startup)
        return app

    async def on_startup(self, app: web.Application) -> None:
        """Say where the builder is, as soon as it answers."""
        self._waiting = asyncio.create_task(self._open())

    async def _open(self) -> None:
        while True:
            await asyncio.sleep(0.05)
            with contextlib.suppress(OSError):
                _, line = await asyncio.open_connection(self.host, self.port)
                line.close()
                break
        host = f"[{self.host}]" if ":" in self.host else self.host
        self._announce(f"http://{host}:{self.port}/{self._word}/")

    async def _check(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Refuse foreign requests.

        They came from another page or under another name; browsers get the order to load nothing else.
        """
        if self._names and request.url.host not in self._names:
            raise web.HTTPForbidden(text=f"the builder is not at {request.host}: open the address that it printed")
        if request.headers.get("Origin") not in (None, f"{request.scheme}://{request.host}"):
            raise web.HTTPForbidden(text="another page may not drive the builder")
        answer = await handler(request)
        if not answer.prepared:
            answer.headers.update(
                {
                    "Content-Security-Policy": "default-src 'self' data: blob:; script-src 'self' 'unsafe-inline'; "
                    f"style-src 'self' 'unsafe-inline'; connect-src 'self' ws://{request.host}; frame-ancestors 'none'",
                    "Referrer-Policy": "no-referrer",
                    "X-Content-Type-Options": "nosniff",
                }
            )
        return answer

    async def handle_index(self, request: web.Request) -> Any:
        """Serve the page.

        Its addresses are under the name that the browser asked for; nothing comes from other places.
        """
        self.public_url = f"{request.scheme}://{request.host}"
        page: Any = await super().handle_index(request)
        outside = re.compile(_FROM_OUTSIDE.format(host=re.escape(request.host)))
        page.text = outside.sub("", page.text).replace("</body>", _KEYBOARD)
        return page

    async def handle_websocket(self, request: web.Request) -> web.WebSocketResponse:
        """Start a builder, unless there are enough."""
        if self._sockets >= MOST_SOCKETS:
            raise web.HTTPServiceUnavailable(text=f"{MOST_SOCKETS} builders are open: close one of them")
        self._sockets += 1
        try:
            answer: web.WebSocketResponse = await super().handle_websocket(request)
            return answer
        finally:
            self._sockets -= 1
