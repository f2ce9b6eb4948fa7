"""Attack the builder that is served to a browser.

One server is visited by all trials of a campaign. A trial sends a burst of requests: without the word of the address,
in another's name, from another page, with a method, a path, a header or bytes that no browser sends; frames that are
no messages; more sockets than there may be. Afterwards the page is asked for as its owner would.
"""

from __future__ import annotations

import base64
import contextlib
import os
import random
import re
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from tests.attacks.trial import MEMORY, Outcome

_BURST = 20  # requests of a trial
_WAIT = 20.0  # [s] for an answer
_STARTS = 120.0  # [s] until it answers at all
_OPENED = ("HTTP/1.1 200", "HTTP/1.1 101")
Said = tuple[Outcome, str, dict[str, Any]]


class _Server:
    """The process, and where it is."""

    def __init__(self) -> None:
        with socket.socket() as found:
            found.bind(("127.0.0.1", 0))
            self.port = int(found.getsockname()[1])
        command = [sys.executable, "-P", "-m", "lambda_cli", "gui", "--serve", "--port", str(self.port)]
        self.said = tempfile.TemporaryFile("w+", encoding="utf-8")  # noqa: SIM115
        # A pipe that nobody reads would fill up and stop it.
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=self.said)
        self.path = urlsplit(self._address()).path

    def _address(self) -> str:
        """Wait until it says where it is."""
        end = time.monotonic() + _STARTS
        while time.monotonic() < end and self.process.poll() is None:
            if address := re.search(r"http://\S+/", self.words()):
                return address[0]
            time.sleep(0.05)
        raise RuntimeError(self.words())

    def words(self) -> str:
        """Return what it has said so far."""
        return os.pread(self.said.fileno(), 1 << 20, 0).decode(errors="replace")

    def send(self, data: bytes, keep: bool = False) -> str | socket.socket:
        """Send bytes and return the answer.

        Its first line ("" without one), or the socket when it is kept open.
        """
        line = socket.create_connection(("127.0.0.1", self.port), _WAIT)
        with contextlib.suppress(OSError):
            line.sendall(data)
        if keep:
            return line
        with line, contextlib.suppress(OSError):
            return line.recv(4096).decode("latin-1").split("\r\n", 1)[0]
        return ""

    def memory(self) -> int:
        """Return the server's resident memory [byte].

        With that of all builders that it has started.
        """
        total, family = 0, {self.process.pid}
        for place in sorted(Path("/proc").glob("[0-9]*"), key=lambda path: int(path.name)):
            with contextlib.suppress(OSError, IndexError, ValueError):
                parent = int((place / "stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()[1])
                if parent in family or int(place.name) in family:
                    family.add(int(place.name))
                    total += int((place / "statm").read_text(encoding="ascii").split()[1]) * 4096
        return total


@cache
def _server() -> _Server:
    """Return the one server of this process, ended with it."""
    import atexit

    made = _Server()
    atexit.register(made.process.terminate)
    return made


def visit(seed: int, number: int, folder: Path) -> Said:
    """Visit the server as attacker, then owner.

    The attack is a burst of hostile requests.
    """
    pick = random.Random(seed * 1_000_003 + number)
    server = _server()
    requests = [pick.choice(_KINDS)(server, pick) for _ in range(_BURST)]
    kept = [server.send(_socket(server), keep=True) for _ in range(pick.choice((0,) * 9 + (8,)))]
    opened = [data for data in requests if str(server.send(data)).startswith(_OPENED)]
    for line in kept:
        assert isinstance(line, socket.socket)
        with line, contextlib.suppress(OSError):
            line.sendall(pick.randbytes(4096))
    memory = server.memory()
    owner = str(server.send(_get(server.path, f"localhost:{server.port}")))
    command = "lambda-bearing gui --serve"
    if server.process.poll() is not None:
        return Outcome("killed", said=f"the server ended with {server.process.returncode}"), command, {}
    if "Traceback" in server.words() or "GET /" in server.words():  # the address is a secret
        return Outcome("traceback", memory=memory, said=server.words()[:2000]), command, {}
    if opened:
        (folder / "request").write_bytes(opened[0])
        return Outcome("opened", memory=memory, said=repr(opened[0][:500])), command, {}
    if not owner.startswith("HTTP/1.1 200"):
        return Outcome("closed", memory=memory, said=f"its owner is answered {owner!r}"), command, {}
    if memory > 2 * MEMORY:  # of up to four builders with two processes each
        return Outcome("greedy", memory=memory), command, {}
    return Outcome("fine", memory=memory), command, {}


def _get(path: str, host: str, *headers: str, method: str = "GET") -> bytes:
    lines = [f"{method} {path} HTTP/1.1", f"Host: {host}", *headers, "Connection: close"]
    return ("\r\n".join(lines) + "\r\n\r\n").encode("utf-8", "surrogateescape")


def _socket(server: _Server) -> bytes:
    """Return a socket's request.

    As the page sends it.
    """
    key = base64.b64encode(b"0123456789abcdef").decode()
    host = f"localhost:{server.port}"
    lines = [f"GET {server.path}ws HTTP/1.1", f"Host: {host}", f"Origin: http://{host}", "Upgrade: websocket"]
    lines += ["Connection: Upgrade", "Sec-WebSocket-Version: 13", f"Sec-WebSocket-Key: {key}"]
    return ("\r\n".join(lines) + "\r\n\r\n").encode()


def _without_word(server: _Server, pick: random.Random) -> bytes:
    wrong = server.path[:-2] + pick.choice("aZ0_-") * 2 + "/"
    path = pick.choice(("/", "/ws", "/static/", "/download/x", wrong, f"{wrong}ws", "//", server.path.upper()))
    return _get(path, f"localhost:{server.port}")


def _of_another_name(server: _Server, pick: random.Random) -> bytes:
    host = pick.choice(("evil.example", "evil.example:80", "localhost.evil.example", "127.0.0.1.nip.io", "[::2]", "@"))
    return _get(server.path + pick.choice(("", "ws", "static/js/textual.js")), host)


def _from_another_page(server: _Server, pick: random.Random) -> bytes:
    origin = pick.choice(("https://evil.example", "null", "http://localhost:1", "http://localhost", "file://", ""))
    request = _socket(server).decode()
    return request.replace(f"Origin: http://localhost:{server.port}", f"Origin: {origin}").encode()


def _out_of_the_folder(server: _Server, pick: random.Random) -> bytes:
    up = pick.choice(("../", "..%2f", "%2e%2e/", "....//", "..\\", "%c0%ae%c0%ae/")) * pick.randrange(1, 9)
    return _get(f"{server.path}static/{up}etc/passwd", f"localhost:{server.port}")


def _of_no_browser(server: _Server, pick: random.Random) -> bytes:
    host = f"localhost:{server.port}"
    return pick.choice(
        (
            pick.randbytes(pick.choice((1, 100, 5000))),
            _get(server.path, host, method=pick.choice(("POST", "PUT", "DELETE", "TRACE", "A" * 9000))),
            _get(server.path + "a" * 20000, host),
            _get("/", host, "X: " + "y" * 70000),
            _get("/", host, "Content-Length: -1"),
            _get("/", host, "Transfer-Encoding: chunked") + b"ffffffffffffffff\r\n",
            _get("http://evil.example/", "evil.example"),
            b"GET / HTTP/9.9\r\n\r\n",
            b"\r\n" * 500,
        )
    )


_KINDS: tuple[Callable[[_Server, random.Random], bytes], ...] = (
    _without_word, _of_another_name, _from_another_page, _out_of_the_folder, _of_no_browser,
)  # fmt: skip
