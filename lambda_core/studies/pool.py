"""Run tasks in local processes, dask workers or detached programs.

A director needs nothing but :class:`concurrent.futures.Executor`; any other one can be handed to it.
"""

from __future__ import annotations

import atexit
import gc
import multiprocessing
import os
import signal
import subprocess
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager
from importlib import import_module
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any

from lambda_core.domain.errors import UsageError
from lambda_core.domain.processes import APART

HERE = "here"  # in this process
_PATIENCE = 20.0  # with a scheduler that does not answer [s]
_WORKERS_SET = (
    *("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"),
    "PYTHONSAFEPATH",  # nothing is imported from where the study stands
)


class Pool:
    """An executor that can be opened again after it broke."""

    ahead = 3  # tasks per worker that are handed out

    def __init__(self, workers: int) -> None:
        self.workers = workers

    @property
    def room(self) -> int:
        """Number of tasks at a time."""
        return self.ahead * self.workers

    def open(self) -> Executor:
        """Return a working executor."""
        raise NotImplementedError

    def close(self, *, stop: bool = False) -> None:
        """Give the workers back.

        With `stop` it does not wait for their tasks.
        """
        raise NotImplementedError

    def watch(self) -> None:
        """Look after what nobody tells of by itself."""


class Processes(Pool):
    """Processes of this machine, each with one thread."""

    def __init__(self, workers: int) -> None:
        super().__init__(workers)
        self._executor: ProcessPoolExecutor | None = None

    def open(self) -> Executor:
        """Start new processes."""
        self.close(stop=True)
        context = multiprocessing.get_context("spawn")
        self._executor = ProcessPoolExecutor(self.workers, context, _begin)
        with _workers_variables():
            # A process starts when a task finds no idle one, and reads the variables then: as many tasks as processes.
            for _ in range(self.workers):
                self._executor.submit(_nothing)
        return self._executor

    def close(self, *, stop: bool = False) -> None:
        """Wait for the processes, or stop them.

        Runs save what they have.
        """
        if self._executor is None:
            return
        executor, self._executor = self._executor, None
        processes = list((getattr(executor, "_processes", None) or {}).values())
        executor.shutdown(wait=not stop, cancel_futures=stop)
        if stop:
            for process in processes:
                process.terminate()
            for process in processes:
                process.join()


def _nothing() -> None:
    """Do nothing.

    It is the first task of a process, which only starts it.
    """


def _begin() -> None:
    """Prepare a worker process.

    Ctrl+C and the end of a terminal are for the director, a worker does not outlive it, and ends at once when it is
    done.
    """
    for name in {"SIGINT", "SIGHUP"} & {one.name for one in signal.Signals}:
        signal.signal(signal.Signals[name], signal.SIG_IGN)
    atexit.register(gc.freeze)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(sentinel: int) -> None:
    wait([sentinel])
    os._exit(1)


@contextmanager
def _workers_variables() -> Iterator[None]:
    """Set the variables of worker processes.

    Processes that start meanwhile get one thread each for Numba and linear algebra, and a safe path.
    """
    before = {name: os.environ.get(name) for name in _WORKERS_SET}
    os.environ.update(dict.fromkeys(_WORKERS_SET, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def start_apart(command: Sequence[str], folder: Path, said: Path, answer: Path) -> subprocess.Popen[bytes]:
    """Start a program that outlives this process.

    Errors and answers go to files. OSError when it cannot be started.
    """
    with said.open("wb") as errors, answer.open("wb") as output:
        return subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=output, stderr=errors, **APART)


class Dask(Pool):
    """Workers of dask.distributed.

    They belong to a scheduler at an address, or to a cluster on this machine.

    Parameters
    ----------
    workers : int
        Processes to start on this machine; not used with an address.
    address : str
        "tcp://host:8786", the path of a scheduler file (.json), or "" for a cluster of one's own.

    Raises
    ------
    UsageError
        When the extra ``cluster`` is not installed, or the scheduler does not answer.
    """

    def __init__(self, workers: int, address: str = "") -> None:
        super().__init__(workers)
        try:
            distributed: Any = import_module("distributed")
        except ImportError:
            raise UsageError('dask is not installed: pip install "lambda-bearing[cluster]"') from None
        self._cluster: Any = None
        options: dict[str, Any] = {"set_as_default": False}
        try:
            if address.endswith(".json"):
                self._client: Any = distributed.Client(scheduler_file=address, timeout=_PATIENCE, **options)
            elif address:
                self._client = distributed.Client(address, timeout=_PATIENCE, **options)
            else:
                self._cluster = distributed.LocalCluster(
                    n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=40
                )
                self._client = distributed.Client(self._cluster, **options)
        except (OSError, ValueError) as error:
            raise UsageError(f'no dask scheduler answers at "{address}": {error}') from None
        if address:
            self.workers = max(sum(self._client.nthreads().values()), 1)

    def open(self) -> Executor:
        """Return an executor over the scheduler's workers.

        Others do the tasks of lost workers.
        """
        executor: Executor = self._client.get_executor(pure=False, retries=2)
        return executor

    def close(self, *, stop: bool = False) -> None:
        """Leave the scheduler; end a cluster of one's own."""
        self._client.close()
        if self._cluster is not None:
            self._cluster.close()


class Inline(Executor):
    """Pool that works in this process.

    It does each task when it is submitted.
    """

    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Do it now."""
        future: Future[Any] = Future()
        try:
            future.set_result(function(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


class Given(Pool):
    """An executor that somebody else made and will shut down."""

    def __init__(self, executor: Executor, workers: int) -> None:
        super().__init__(workers)
        self._executor = executor

    def open(self) -> Executor:
        """Return it."""
        return self._executor

    def close(self, *, stop: bool = False) -> None:
        """Leave it to its owner."""


def pool(where: str | Executor, workers: int) -> Pool:
    """Return the pool of `where`.

    It is ``processes``, ``here``, ``dask``, a scheduler's address, or an executor.

    Raises
    ------
    UsageError
        For anything else.
    """
    if isinstance(where, Executor):
        return Given(where, workers)
    if where == "processes":
        return Processes(workers)
    if where == HERE:
        return Given(Inline(), 1)
    if where == "dask":
        return Dask(workers)
    if "://" in where or where.endswith(".json"):
        return Dask(workers, where)
    raise UsageError(
        f'"{where}" is not a place to work; there are: processes, here, dask, the address of a dask scheduler '
        "(tcp://host:8786) or its file (scheduler.json)"
    )


def usable_cores() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
