"""Ask the helper process for estimates."""

from __future__ import annotations

import asyncio
import json
import os
import pickle
import signal
import sys
from asyncio.subprocess import DEVNULL, PIPE, Process, SubprocessStreamProtocol
from collections.abc import Callable
from pathlib import Path
from typing import Any

from lambda_core.domain.errors import LambdaError

# The matrices are small: threads that wait for each other on them take ten times the processor time of one.
_ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
_AHEAD = 1 << 16  # of an answer, what is read before it is asked for [bytes]
_STARTS = 3  # a process that keeps dying is not started for ever


class Helper:
    """One helper process.

    It starts at the first request and does one thing at a time.

    Parameters
    ----------
    say : callable
        Called with a sentence about what is being done.
    is_wanted : callable, optional
        Tells whether a screen is left to report to; one that is being taken down gets no answer.
    """

    def __init__(self, say: Callable[[str], None], is_wanted: Callable[[], bool] = lambda: True) -> None:
        self._say, self._is_wanted = say, is_wanted
        self._process: Process | None = None
        self._transport: asyncio.SubprocessTransport | None = None
        self._turn = asyncio.Lock()
        self._deaths = 0
        self._is_closed = False

    async def ask(self, work: str, **arguments: Any) -> Any:
        """Have something done and return it.

        An absent caller is cancelled instead.

        Raises
        ------
        LambdaError
            With a sentence: of the work itself, or about the process.
        """
        try:
            found = await self._answer(work, **arguments)
        except LambdaError:
            if self._is_closed or not self._is_wanted():
                raise asyncio.CancelledError from None
            raise
        if self._is_closed or not self._is_wanted():
            raise asyncio.CancelledError
        return found

    async def _answer(self, work: str, **arguments: Any) -> Any:
        async with self._turn:
            if self._is_closed:  # while it waited for its turn
                raise asyncio.CancelledError
            process = await self._started()
            if self._is_closed:  # while it was being started
                await self._stop()
                raise asyncio.CancelledError
            assert process.stdin is not None
            assert process.stdout is not None
            try:
                process.stdin.write(json.dumps({"work": work, **arguments}).encode() + b"\n")
                await process.stdin.drain()
                while True:
                    size = int.from_bytes(await process.stdout.readexactly(8), "big")
                    kind, content = pickle.loads(await process.stdout.readexactly(size))
                    if kind != "say":
                        break
                    if self._is_wanted():
                        self._say(content)
            except (OSError, asyncio.IncompleteReadError):
                self._deaths += 1
                raise LambdaError(f"the helper process ended unexpectedly while it did this: {work}") from None
            except asyncio.CancelledError:
                await self._stop()  # the answer to a question that nobody waits for must not meet the next one
                raise
        if kind == "error":
            raise LambdaError(content)
        self._deaths = 0
        return content

    async def _started(self) -> Process:
        if self._process is not None and self._process.returncode is None:
            return self._process
        if self._deaths == _STARTS:
            raise LambdaError("the helper process ended several times: close the builder and open it again")
        loop = asyncio.get_running_loop()
        command = (sys.executable, "-P", "-m", "lambda_gui.helper_process")
        try:
            self._transport, protocol = await loop.subprocess_exec(
                lambda: SubprocessStreamProtocol(limit=_AHEAD, loop=loop),
                *command,
                stdin=PIPE,
                stdout=PIPE,
                stderr=DEVNULL,
                env=os.environ | _ONE_THREAD,
            )
        except OSError as error:
            raise LambdaError(f"the helper process cannot be started: {error.strerror}") from None
        self._process = Process(self._transport, protocol, loop)
        return self._process

    def interrupt(self) -> None:
        """Stop the present work early.

        It works as Ctrl+C in a shell.
        """
        if self._process is not None and self._process.returncode is None:
            self._process.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM)

    async def close(self) -> None:
        """End the process for good.

        Waiting callers are cancelled.
        """
        self._is_closed = True
        await self._stop()

    async def _stop(self) -> None:
        transport, self._transport = self._transport, None
        process, self._process = self._process, None
        if transport is not None and process is not None:
            transport.close()  # at once: it also kills, and who waits below may be cancelled before the program's end
            await process.wait()


class Estimator:
    """Estimates of the edited case.

    Only the newest question counts.

    Parameters
    ----------
    tell : callable
        ``tell(estimate, sentence)``: an estimate, or what is being done or what went wrong.
    """

    def __init__(self, tell: Callable[[Any, str], None]) -> None:
        self._tell = tell
        self._helper = Helper(lambda text: tell(None, text))
        self._waiting: tuple[dict[str, Any], Path | None] | None = None
        self._is_busy = False
        self._is_closed = False

    async def ask(self, tables: dict[str, Any], folder: Path | None) -> None:
        """Ask about a case without mistakes.

        The answer comes through `tell`.
        """
        self._waiting = (tables, folder)
        if self._is_busy:
            return
        self._is_busy = True
        try:
            while self._waiting is not None:
                (tables, folder), self._waiting = self._waiting, None
                await self._answer(tables, folder)
        finally:
            self._is_busy = False

    async def _answer(self, tables: dict[str, Any], folder: Path | None) -> None:
        try:
            found = await self._helper.ask("estimate", tables=tables, folder=str(folder) if folder else None)
        except LambdaError as error:
            found, words = None, str(error)
        else:
            words = ""
        if self._waiting is None and not self._is_closed:
            self._tell(found, words)

    async def close(self) -> None:
        """End the helper.

        Waiting callers get no more answers.
        """
        self._is_closed = True
        self._waiting = None
        await self._helper.close()
