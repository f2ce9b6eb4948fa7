"""End the program at the second request to stop.

The first Ctrl+C or request to terminate lets it finish properly: all are heard as Ctrl+C.

Python hears signals only between two instructions of its own: inside a law that never returns it hears none. A thread
of its own does, for compiled code lets other threads work meanwhile.
"""

from __future__ import annotations

import _thread
import contextlib
import os
import signal
import socket
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from lambda_core.domain.processes import STOP_SIGNALS, heard_signals

_SOON = 0.02  # [s]
_GRACE = 0.5  # [s] for the program's own way out, which is the better one


@contextmanager
def second_signal_ends(code: int) -> Iterator[Callable[[], bool]]:
    """End the process soon after a second signal.

    The process gets this exit code `_GRACE` after the second signal, if it is still in here then.

    Nothing is lost that was written: result files are good at any moment. Inside, a function tells whether a first
    signal came.
    """
    first = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield first.is_set
        return
    ours, theirs = socket.socketpair()
    theirs.setblocking(False)
    left = threading.Event()
    reported = sys.unraisablehook

    def interrupt() -> None:
        if not left.is_set():  # what has ended needs none: it would change its exit code
            _thread.interrupt_main()

    def hear_again(lost: sys.UnraisableHookArgs) -> None:
        """Raise an interruption that Python dropped.

        It came while a destructor or a callback ran.
        """
        if lost.exc_type is KeyboardInterrupt:
            again = threading.Timer(_SOON, interrupt)  # in here it would be dropped, too
            again.daemon = True
            again.start()
        else:
            reported(lost)

    sys.unraisablehook = hear_again
    silent = [number for number in heard_signals() if signal.getsignal(number) == signal.SIG_DFL]
    for number in silent:
        signal.signal(number, signal.default_int_handler)
    before = signal.set_wakeup_fd(theirs.fileno(), warn_on_full_buffer=False)
    threading.Thread(target=_watch, args=(ours, left, code, first), name="signals", daemon=True).start()
    try:
        yield lambda: first.wait(_SOON)  # the thread hears it a moment later
    finally:
        left.set()
        sys.unraisablehook = reported
        for number in silent:
            signal.signal(number, signal.SIG_DFL)
        if signal.set_wakeup_fd(before) not in (theirs.fileno(), -1):  # an event loop of a face came and went
            signal.set_wakeup_fd(-1)
        theirs.close()


def _watch(ours: socket.socket, left: threading.Event, code: int, first: threading.Event) -> None:
    heard = 0
    with ours:
        while heard < 2:
            numbers = ours.recv(64)
            if not numbers:
                return
            heard += sum(number in STOP_SIGNALS for number in numbers)
            if heard:
                first.set()
    if not left.wait(_GRACE):
        with contextlib.suppress(OSError):
            os.write(2, b"interrupted: what was written is kept\n")
        os._exit(code)
