"""Share fixtures among the tests of the catalogue."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

import pytest
from sqlalchemy import Engine, event

Meanwhile = Callable[[str, Callable[[], object]], AbstractContextManager[None]]


@pytest.fixture
def meanwhile() -> Meanwhile:
    """Return an action between statements.

    It acts each time before a statement with given words, as another process would.
    """

    @contextmanager
    def acting(words: str, act: Callable[[], object]) -> Iterator[None]:
        is_acting = False

        def before(connection: object, cursor: object, statement: str, *_: object) -> None:
            nonlocal is_acting
            if words in statement and not is_acting:  # not before its own statements
                is_acting = True
                act()
                is_acting = False

        event.listen(Engine, "before_cursor_execute", before)
        try:
            yield
        finally:
            event.remove(Engine, "before_cursor_execute", before)

    return acting
