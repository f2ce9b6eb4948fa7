"""Test tuples that compiled code takes by their address.

The same values, the layout of Numba, nothing of another type.
"""

from __future__ import annotations

import copy
import pickle
from typing import Any, NamedTuple

import numpy as np
import pytest
from numba import njit, types

from lambda_core.laws.jit.portable import words_of as words_of_abi
from lambda_core.laws.jit.references import reference_t
from lambda_core.laws.jit.words import by_reference, words_of
from lambda_core.solver import layout as L
from lambda_core.solver.arrays.bundle import ARRAY1, ARRAY3, INTEGERS, Bundle
from lambda_core.solver.arrays.integrator_memory import Handle, Memory
from lambda_core.solver.integrator import handle, memory

from .test_power import MODELS, machine


@by_reference(INTEGERS)
class Inner(NamedTuple):
    """A tuple within a tuple."""

    counts: Any


@by_reference(ARRAY1, inner=Inner, cube=ARRAY3)
class Outer(NamedTuple):
    """Arrays of one and more dimensions, and a tuple."""

    line: Any
    inner: Any
    cube: Any


@by_reference(ARRAY1, inner=Inner, cube=ARRAY3)
class Other(NamedTuple):
    """Another tuple with the same fields."""

    line: Any
    inner: Any
    cube: Any


outer_t, other_t = reference_t(Outer), reference_t(Other)


def added_up(outer: Any) -> float:
    """Add up everything, through views and shapes."""
    cube, found = outer.cube, 0.0
    for i in range(cube.shape[0]):
        for j in range(cube.shape[1]):
            found += cube[i, j].sum() * cube.strides[1]
    outer.line[0] = found
    return found + outer.inner.counts.sum() + outer.line[1:].size


@pytest.fixture(scope="module")
def total() -> Any:
    """Compile it in the one process that needs it."""
    return njit(types.float64(outer_t))(added_up)


def made(kind: Any = Outer, **changes: Any) -> Any:
    """Return a tuple with numbers in it."""
    parts = {"line": np.zeros(4), "inner": Inner(np.arange(5)), "cube": np.arange(24.0).reshape(2, 3, 4)}
    return kind(**(parts | changes))


def test_compiled_code_reads_and_writes_what_python_has(total: Any) -> None:
    """Compare arrays, nested tuples and views."""
    outer = made()
    assert total(outer) == 276.0 * 32 + 10 + 3
    assert outer.line[0] == 276.0 * 32


def test_a_replaced_field_has_an_address_of_its_own(total: Any) -> None:
    """Give a replaced field its own address.

    The words belong to the present tuple, not to the one that it was made from.
    """
    outer = made()
    before = total(outer)
    assert total(outer._replace(inner=Inner(np.zeros(2, dtype=np.int64)))) == before - 10
    assert total(outer) == before


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda outer: pickle.loads(pickle.dumps(outer))])
def test_a_copy_has_addresses_of_its_own(copied: Any, total: Any) -> None:
    """Give a copy its own addresses.

    Copied words would point to the arrays of the original, or to freed memory.
    """
    outer = made()
    before = total(outer)
    other = copied(outer)
    other.cube[:] *= 1.0 if other.cube is outer.cube else 2.0
    assert total(other) == (before if other.cube is outer.cube else 2.0 * before - 13.0)
    assert total(outer) == before


@pytest.mark.parametrize(
    "changes",
    [
        {"line": np.zeros(4, dtype=np.float32)},
        {"line": np.zeros(4, dtype=np.int64)},
        {"cube": np.zeros((2, 2))},
        {"cube": np.zeros((4, 3, 2)).transpose()},
    ],
    ids=["another size", "another kind", "another shape", "another order"],
)
def test_an_array_of_another_type_is_refused(changes: dict[str, Any], total: Any) -> None:
    """Refuse an array of another type.

    Compiled code would read past its end, or other numbers than there are.
    """
    with pytest.raises(TypeError, match="where compiled code takes"):
        total(made(**changes))


def test_another_tuple_is_refused(total: Any) -> None:
    """Refuse a tuple of another type.

    It has the same fields; another case is no tuple at all. Runs look at no types before.
    """
    entry = total.get_compile_result(types.float64(outer_t)).entry_point
    for wrong in (made(Other), (np.zeros(4), Inner(np.arange(5)), np.zeros((2, 3, 4))), None):
        with pytest.raises(AttributeError, match="address_Outer"):
            entry(wrong)


@pytest.mark.parametrize(
    ("named", "kind"),
    [(Bundle, L.bundle_t), (Handle, handle.handle_t), (Memory, memory.memory_t)],
    ids=["bundle", "handle", "memory"],
)
def test_words_are_laid_out_as_numba_lays_out_values(named: Any, kind: Any) -> None:
    """Compare words with Numba's layout.

    Arrays and functions of an image are loaded as Numba's values; a field takes as many words.
    """
    for field, of_field in kind.fields.items():
        assert words_of(named.KINDS[field]) == words_of_abi(of_field), field


def test_the_bundle_of_a_model_is_taken() -> None:
    """Accept every array of a real model."""
    m = machine(*MODELS["default"])
    assert getattr(m.context.bundle, L.bundle_t.attribute) > 0
    assert m.context.blocks.address_Blocks > 0
