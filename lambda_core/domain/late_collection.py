"""Import and compile before garbage is collected.

What a program imports and compiles stays: to look for cycles among it takes a tenth of a short call's processor time.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_START = 400_000  # objects of a program that has imported all and loaded what is compiled, and some more


def postpone_collection(then: Callable[[], None] | None = None) -> Callable[[], None]:
    """Collect garbage only behind the start.

    The first collection, or the returned function, brings the usual thresholds back: a long run needs no more memory.

    Parameters
    ----------
    then : callable, optional
        Called behind the first collection.
    """
    usual = gc.get_threshold()
    if not 0 < usual[0] < _START:  # whoever called us does it, or wants no collection
        return lambda: None

    def restore() -> None:
        if heard in gc.callbacks:
            gc.callbacks.remove(heard)
            if gc.get_threshold()[0] == _START:  # nobody has set others meanwhile
                gc.set_threshold(*usual)

    def heard(phase: str, _: dict[str, int]) -> None:
        if phase == "stop":
            restore()
            if then is not None:
                then()

    gc.callbacks.append(heard)
    gc.set_threshold(_START, *usual[1:])
    return restore


@contextmanager
def late_collection() -> Iterator[None]:
    """Postpone the first collection of a call."""
    restore = postpone_collection()
    try:
        yield
    finally:
        restore()
