"""Limit linear algebra to one thread.

Matrices have tens to hundreds of rows; threads would wait for each other.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from typing import Any


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Compute with one BLAS thread meanwhile, also as a decorator.

    The threads belong to the process: those of the caller are there again behind it. Of Python threads that overlap
    threadpoolctl lets the first one set them.
    """
    import numpy.linalg  # noqa: F401 - what is not loaded yet cannot be limited

    with _libraries(len(sys.modules)).limit(limits=1, user_api="blas"):
        yield


@lru_cache(maxsize=1)
def _libraries(modules: int) -> Any:
    """Return the BLAS libraries of this process.

    Looking through all that is loaded takes milliseconds; another library comes with another Python module.
    """
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()
