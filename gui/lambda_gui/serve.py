"""Serve the builder in a browser."""

from __future__ import annotations

import contextlib
import ipaddress
import sys
from collections.abc import Callable

from lambda_core.domain.errors import UsageError
from lambda_core.domain.processes import command_line

LOOPBACK = "localhost"


def is_loopback(host: str) -> bool:
    """Tell whether only this machine can reach an address."""
    if host == LOOPBACK:
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def warning(host: str) -> str:
    """Return the warning about other machines.

    It is for users who let them in; "" for an address of this machine alone.
    """
    if is_loopback(host):
        return ""
    return (
        f"everybody who can reach {host} and learns the address can read and write files as you and start programs: "
        "there is no password and no encryption. Put a proxy with both in front of it, or use an ssh tunnel to "
        "localhost instead."
    )


def serve(case: str | None, host: str, port: int, announce: Callable[[str], None]) -> None:
    """Serve the builder until Ctrl+C.

    Every browser tab is a builder of its own.

    `announce` is called with the address once it can be opened: it has a secret in it.

    Raises
    ------
    UsageError
        When textual-serve is not installed, or the port is taken.
    """
    try:
        from lambda_gui.auth import LockedServer
    except ImportError:
        raise UsageError('serving needs another package: pip install "lambda-bearing[serve]"') from None
    names = {host, LOOPBACK, "127.0.0.1", "::1"} if is_loopback(host) else set()
    command = [sys.executable, "-P", "-m", "lambda_cli", "gui", *([case] if case else [])]
    try:
        with contextlib.redirect_stdout(sys.stderr):  # the server talks; stdout is for data
            LockedServer(command_line(command), host, port, "lambda-bearing", names, announce).serve()
    except OSError as error:
        raise UsageError(f"cannot serve at {host}:{port}: {error.strerror}") from None
