"""The builder in a browser."""

from __future__ import annotations

import contextlib
import ipaddress
import shlex
import sys

from lambda_core.errors import UsageError

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
    """Return what somebody should know who lets other machines in, "" for an address of this machine alone."""
    if is_loopback(host):
        return ""
    return (
        f"everybody who can reach {host} can read and write files as you and start programs: there is no password and "
        "no encryption. Put a proxy with both in front of it, or use an ssh tunnel to localhost instead."
    )


def serve(case: str | None, host: str, port: int) -> None:
    """Serve the builder until Ctrl+C; every browser tab is a builder of its own.

    Raises
    ------
    UsageError
        When textual-serve is not installed, or the port is taken.
    """
    try:
        from textual_serve.server import Server
    except ImportError:
        raise UsageError('serving needs another package: pip install "lambda-bearing[serve]"') from None
    command = [sys.executable, "-m", "lambda_cli", "gui", *([case] if case else [])]
    try:
        with contextlib.redirect_stdout(sys.stderr):  # the server talks; stdout is for data
            Server(shlex.join(command), host=host, port=port, title="lambda-bearing").serve()
    except OSError as error:
        raise UsageError(f"cannot serve at {host}:{port}: {error.strerror}") from None
