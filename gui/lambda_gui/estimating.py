"""Asks the estimator's process; only the newest question counts."""

from __future__ import annotations

import asyncio
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lambda_core.simulate.estimate import Estimate

_STARTS = 3  # a process that keeps dying is not started for ever
_LINE = 1 << 22  # longest answer [bytes]


class Estimator:
    """One process that is started when first asked.

    Parameters
    ----------
    tell : callable
        ``tell(estimate, sentence)``: an estimate, or what is being done or what went wrong.
    """

    def __init__(self, tell: Callable[[Estimate | None, str], None]) -> None:
        self._tell = tell
        self._process: asyncio.subprocess.Process | None = None
        self._reader: asyncio.Task[None] | None = None
        self._number = 0
        self._busy = False
        self._waiting: dict[str, Any] | None = None
        self._starts = 0

    async def ask(self, tables: dict[str, Any], folder: Path | None) -> None:
        """Ask about a case without mistakes; the answer comes through `tell`."""
        self._number += 1
        self._waiting = {"id": self._number, "tables": tables, "folder": str(folder) if folder else None}
        if not self._busy:
            await self._send()

    async def _send(self) -> None:
        question, self._waiting = self._waiting, None
        if question is None or not await self._alive():
            return
        assert self._process is not None
        assert self._process.stdin is not None
        self._busy = True
        try:
            self._process.stdin.write(json.dumps(question).encode() + b"\n")
            await self._process.stdin.drain()
        except (BrokenPipeError, ConnectionResetError):
            self._busy = False

    async def _alive(self) -> bool:
        if self._process is not None and self._process.returncode is None:
            return True
        if self._starts == _STARTS:
            self._tell(None, "estimates are off: their process has ended several times")
            return False
        self._starts += 1
        pipe, null = asyncio.subprocess.PIPE, asyncio.subprocess.DEVNULL
        try:
            self._process = await asyncio.create_subprocess_exec(
                sys.executable, "-m", "lambda_gui.estimator", stdin=pipe, stdout=pipe, stderr=null, limit=_LINE
            )
        except OSError as error:
            self._tell(None, f"no estimates: {error.strerror}")
            return False
        self._reader = asyncio.create_task(self._listen(self._process))
        return True

    async def _listen(self, process: asyncio.subprocess.Process) -> None:
        assert process.stdout is not None
        async for line in process.stdout:
            found = json.loads(line)
            if "say" in found:
                self._tell(None, found["say"])
                continue
            self._busy = False
            if found["id"] == self._number:
                self._hand_over(found)
            await self._send()
        self._busy = False

    def _hand_over(self, found: dict[str, Any]) -> None:
        from lambda_core.simulate.estimate import Estimate

        if "estimate" in found:
            self._starts = 0
            self._tell(Estimate.model_validate(found["estimate"]), "")
        else:
            self._tell(None, found["error"])

    async def close(self) -> None:
        """End the process."""
        if self._reader is not None:
            self._reader.cancel()
        process = self._process
        if process is not None and process.returncode is None:
            process.kill()
            await process.wait()
