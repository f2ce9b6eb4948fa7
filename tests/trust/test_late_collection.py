"""Test when garbage of a call is collected."""

from __future__ import annotations

import gc
from collections.abc import Iterator

import pytest

from lambda_core.domain.late_collection import late_collection
from lambda_core.domain.public_call import public

_USUAL = (700, 10, 10)


@pytest.fixture(autouse=True)
def _usual() -> Iterator[None]:
    """Collect as Python does, and let nobody else listen."""
    before, others = gc.get_threshold(), list(gc.callbacks)
    gc.callbacks.clear()
    gc.set_threshold(*_USUAL)
    yield
    gc.set_threshold(*before)
    gc.callbacks.extend(others)


def _asked() -> tuple[int, int, int]:
    """Return the thresholds inside a call."""
    return gc.get_threshold()


def test_a_call_from_python_imports_before_it_collects() -> None:
    inside = public(_asked, __name__)()
    assert inside[0] > 100_000
    assert gc.get_threshold() == _USUAL


def test_a_long_call_collects_as_usual_behind_its_first_collection() -> None:
    with late_collection():
        gc.collect()
        assert gc.get_threshold() == _USUAL
    assert gc.get_threshold() == _USUAL


def test_calls_inside_each_other_and_a_switched_off_collector_stay() -> None:
    with late_collection():
        with late_collection():
            pass
        assert gc.get_threshold()[0] > 100_000
    gc.set_threshold(0)
    with late_collection():
        assert gc.get_threshold()[0] == 0
    assert gc.get_threshold()[0] == 0
