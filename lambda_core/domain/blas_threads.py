"""Limit linear algebra to one thread.

Matrices have tens to hundreds of rows; threads would wait for each other.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Compute with one BLAS thread meanwhile, also as a decorator.

    The threads belong to the process: those of the caller are there again behind it. Of Python threads that overlap
    threadpoolctl lets the first one set them.
    """
    import numpy.linalg  # noqa: F401 - what is not loaded yet cannot be limited
    from threadpoolctl import threadpool_limits

    with threadpool_limits(1, user_api="blas"):
        yield
