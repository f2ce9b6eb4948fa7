"""Fork a loaded interpreter for tests that start programs.

Every process is one of its own all the same: with its own number, folder, environment, streams, signals and exit code.
Tests of the start itself (what is imported, how long it takes, other caches) start Python afresh.

``python warm.py SOCKET`` is the server; :class:`Warm` starts it and asks it. The processes of a session share one: it
ends when the last of them has left.
"""

from __future__ import annotations

import atexit
import contextlib
import gc
import importlib
import json
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import types
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from made_once import alone

PROGRAM = "from lambda_cli.main import main; raise SystemExit(main())"
# The workers of a command, too, begin with everything imported; tests/studies/test_workers.py has them as users do.
_FORKING = "import multiprocessing as m; get = m.get_context; m.get_context = lambda _: get('fork'); "
_LOADED = """
numba numpy scipy.integrate scipy.optimize h5py sqlalchemy.orm typer rich.progress
matplotlib.figure matplotlib.backends.backend_svg matplotlib.backends.backend_agg
lambda_cli.commands lambda_core.model.checking lambda_core.runs.api
lambda_core.runs.loop lambda_core.results.reader lambda_db.catalogue
"""
_HAS_FORK = sys.platform == "linux"
_STAY = (0).to_bytes(8, "big")  # in place of the length of a request: of who may ask later
# Stands in for the installed command, for `python -c` and `python -P -m`: hands everything that makes a process to the
# server, and on to that process the signal by which it is asked to end. Who ends the stand-in ends both.
_SHIM = """#!{python} -IS
import json, os, signal, socket, sys
name, *words = os.path.basename(sys.argv[0]), *sys.argv[1:]
if name != "python":
    code, argv = {program!r}, [name, *words]
elif words[:1] == ["-c"]:
    code, argv = words[1], ["-c", *words[2:]]
elif words[:2] == ["-P", "-m"]:
    code, argv = f"import runpy; runpy.run_module({{words[2]!r}}, run_name='__main__', alter_sys=True)", words[2:]
else:
    os.execv({python!r}, ["python", *words])
request = dict(code=code, argv=argv, cwd=os.getcwd(), env=dict(os.environ))
with socket.socket(socket.AF_UNIX) as server:
    server.connect({address!r})
    text = json.dumps(request).encode()
    socket.send_fds(server, [len(text).to_bytes(8, "big")], [0, 1, 2])
    server.sendall(text)
    answers = server.makefile("r")
    pid = int(answers.readline())
    signal.signal(signal.SIGINT, lambda number, _: os.kill(pid, number))
    code = int(answers.readline() or 1)
sys.exit(code if code >= 0 else 128 - code)
"""


class Started:
    """Process of the server.

    As :class:`subprocess.Popen` has them: output in a pipe, errors in a file.
    """

    def __init__(self, connection: socket.socket, stdout: int, errors: Any) -> None:
        self._answers = connection.makefile("r")
        self._connection, self._errors = connection, errors
        self.stdout = os.fdopen(stdout, "r", encoding="utf-8")
        self.pid = int(self._answers.readline())
        self.returncode: int | None = None

    def poll(self) -> int | None:
        """Return the exit code, None while it runs."""
        return self.wait(0.0) if self.returncode is None else self.returncode

    def wait(self, timeout: float | None = None) -> int | None:
        """Wait for the end.

        Return the exit code, negative for a signal, None when it still runs.
        """
        if self.returncode is None and select.select([self._connection], [], [], timeout)[0]:
            self.returncode = int(self._answers.readline())
        return self.returncode

    def kill(self) -> None:
        """End it without a word."""
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, signal.SIGKILL)

    def communicate(self) -> tuple[str, str]:
        """Wait for the end.

        Return the remaining output.
        """
        with self.stdout:
            out = self.stdout.read()
        self.wait()
        self._connection.close()
        with self._errors:
            self._errors.seek(0)
            return out, self._errors.read()


class Warm:
    """Server and its requests.

    `path` is a folder of commands to put in front of PATH.
    """

    def __init__(self, folder: Path) -> None:
        self._address = str(folder / "warm")
        self._environment = dict(os.environ)  # of the session; that of a test may be its own
        self.path = folder / "bin"
        self._stays: socket.socket | None = None  # connected as long as this process may ask
        self._server: subprocess.Popen[str] | None = None  # that this process has started

    def ready(self) -> Warm:
        """Start the server if it does not run yet."""
        if _HAS_FORK and self._stays is None:
            with alone(Path(f"{self._address}.lock")):
                self._stays = self._connected() or self._started()
                self._stays.sendall(_STAY)
        return self

    def _connected(self) -> socket.socket | None:
        connection = socket.socket(socket.AF_UNIX)
        try:
            connection.connect(self._address)
        except OSError:  # there is none, or it has ended
            connection.close()
            return None
        return connection

    def _started(self) -> socket.socket:
        self.path.mkdir(exist_ok=True)
        for name in ("lambda-bearing", "python"):
            shim = self.path / name
            shim.write_text(_SHIM.format(python=sys.executable, address=self._address, program=_FORKING + PROGRAM))
            shim.chmod(0o755)
        # A test that called the program in this process may have left PYTHONSAFEPATH: with it the first place of
        # sys.path, which each process gives up for its own folder, would be the first of PYTHONPATH.
        self._server = subprocess.Popen(
            [sys.executable, __file__, self._address],
            env=self._environment | {"OPENBLAS_NUM_THREADS": "1", "PYTHONSAFEPATH": ""},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            text=True,
        )
        assert self._server.stdout is not None
        assert self._server.stdout.readline() == "ready\n"
        self._server.stdout.close()
        found = self._connected()
        assert found is not None
        return found

    @property
    def python(self) -> str:
        """Command in place of Python, with ``-c`` or ``-P -m``."""
        return str(self.path / "python") if _HAS_FORK else sys.executable

    def start(
        self,
        code: str,
        *arguments: str,
        cwd: Path | None = None,
        env: Mapping[str, str] | None = None,
        stderr: int | None = None,
    ) -> Any:
        """Execute Python code in its own process.

        As ``python -c CODE ARGUMENTS`` would.

        `stderr` is an open file; without one the errors come back from ``communicate``.
        """
        environment = os.environ | dict(env or {})
        if not _HAS_FORK:
            return subprocess.Popen(
                [sys.executable, "-c", code, *arguments], cwd=cwd, env=environment, text=True,
                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE if stderr is None else stderr,
            )  # fmt: skip
        self.ready()
        connection = socket.socket(socket.AF_UNIX)
        connection.connect(self._address)
        request = {"code": code, "argv": ["-c", *arguments], "cwd": str(cwd or Path.cwd()), "env": environment}
        text = json.dumps(request).encode()
        reading, writing = os.pipe()
        errors = tempfile.TemporaryFile("w+", encoding="utf-8")  # noqa: SIM115 - closed by whoever reads it
        with open(os.devnull) as nothing:
            fds = [nothing.fileno(), writing, errors.fileno() if stderr is None else stderr]
            socket.send_fds(connection, [len(text).to_bytes(8, "big")], fds)
        connection.sendall(text)
        os.close(writing)
        return Started(connection, reading, errors)

    def close(self) -> None:
        """Leave the server; it ends when nobody stays."""
        if self._stays is not None:
            self._stays.close()


def _first_run() -> None:
    """Load what a first run loads.

    Laws, tables, modules; each request looks up anew what is installed.
    """
    from lambda_core import api
    from lambda_core.case import builtin
    from lambda_core.discovery.manager import registry

    with tempfile.TemporaryDirectory() as folder:
        api.run("6208-axial-1300", ["solver.duration=20 us"], out=Path(folder) / "first.h5").summary()
    registry.cache_clear()
    builtin._files.cache_clear()


def serve(address: str) -> None:
    """Fork a process for every request.

    Until nobody stays who may ask.
    """
    for name in _LOADED.split():
        importlib.import_module(name)
    from lambda_core.solver.core import core

    core()
    _first_run()
    gc.freeze()
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(address)
    listener.listen()
    waking, wake = os.pipe()
    os.set_blocking(wake, False)
    os.set_blocking(waking, False)
    signal.set_wakeup_fd(wake)
    signal.signal(signal.SIGCHLD, lambda *_: None)
    children: dict[int, socket.socket] = {}
    staying: list[socket.socket] = []
    is_wanted = True
    print("ready", flush=True)
    while True:
        known, _, _ = select.select([listener, waking, *staying, *children.values()], [], [])
        if waking in known:
            with contextlib.suppress(BlockingIOError):
                os.read(waking, 4096)
        if listener in known:
            connection = listener.accept()[0]
            if pid := _fork(connection, [listener, *staying, *children.values()]):
                children[pid] = connection
            else:
                staying.append(connection)
        for pid, asking in children.items():
            if asking in known:  # who asked is gone, and waits for nothing any more
                os.kill(pid, signal.SIGKILL)
        _bury(children)
        left = [one for one in staying if one in known]  # it has nothing more to say
        for one in left:
            staying.remove(one)
            one.close()
        if left and is_wanted and not staying:
            os.unlink(address)  # who comes from now on starts another one
            is_wanted = False
        if not (is_wanted or staying or select.select([listener], [], [], 0.0)[0]):
            return


def _fork(connection: socket.socket, others: list[socket.socket]) -> int:
    """Return the process that a connection asks for.

    0 where it only stays.
    """
    size, fds, _, _ = socket.recv_fds(connection, 8, 3)
    if size in (_STAY, b""):
        return 0
    with connection.makefile("rb") as stream:
        request = json.loads(stream.read(int.from_bytes(size, "big")))
    pid = os.fork()
    if pid == 0:
        for other in (connection, *others):
            other.close()
        _become(request, fds)
    for fd in fds:
        os.close(fd)
    connection.sendall(f"{pid}\n".encode())
    return pid


def _bury(children: dict[int, socket.socket]) -> None:
    """Tell of every process that has ended how it did."""
    for pid in list(children):
        ended, status = os.waitpid(pid, os.WNOHANG)
        if ended:
            with contextlib.suppress(OSError), children.pop(pid) as connection:
                connection.sendall(f"{os.waitstatus_to_exitcode(status)}\n".encode())


def _become(request: dict[str, Any], fds: list[int]) -> None:
    """Be the process that was asked for."""
    signal.set_wakeup_fd(-1)
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    for target, fd in enumerate(fds):
        os.dup2(fd, target)
        os.close(fd)
    sys.stdin, sys.stdout, sys.stderr = open(0), open(1, "w"), open(2, "w", buffering=1)  # noqa: SIM115
    os.environ.clear()
    os.environ.update(request["env"])
    os.chdir(request["cwd"])
    sys.argv = request["argv"]
    paths = request["env"].get("PYTHONPATH", "").split(os.pathsep)
    sys.path[:1] = ["", *(path for path in paths if path and path not in sys.path)]
    main = sys.modules["__main__"] = types.ModuleType("__main__")
    code = 0
    try:
        exec(compile(request["code"], "<string>", "exec"), main.__dict__)
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        sys.excepthook(*sys.exc_info())
        code = 1
    # The end of an interpreter, without taking apart all that is loaded.
    threading._shutdown()  # type: ignore[attr-defined]
    atexit._run_exitfuncs()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


if __name__ == "__main__":
    serve(*sys.argv[1:])
