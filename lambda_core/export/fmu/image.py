"""Store a model's arrays and pointers as bytes.

They belong to an instance, a saved state or a checkpoint.

At its beginning stand the arguments of the solver's compiled functions, as words of eight bytes: an array is its number
and size of items, where its bytes are, shape and strides; a pointer to a function is an address; a named tuple is its
fields one after another, also where compiled code takes it by its address. Behind them stand the bytes of the arrays.
Wherever a host puts a copy, it adds the place of the copy to some words and writes the addresses of functions into
others.
"""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from lambda_core.laws.jit.machine_code import Pointer
from lambda_core.laws.jit.portable import is_array, is_function, symbol, words_of
from lambda_core.laws.jit.references import Reference

_LINE = 64  # [bytes] arrays begin at lines of the processor's cache


class Image:
    """Bytes of an image and a host's operations.

    The host works on a copy of them.

    Parameters
    ----------
    sections : sequence of (str, numba type, value)
        Arguments of compiled functions by name.
    tables : sequence of int64[:, :]
        Arrays among them that hold addresses of functions.
    pointers : sequence of Pointer
        The functions that these addresses are of.
    workspaces : sequence of array
        Arrays whose numbers are forgotten: they stand at the end, behind what a saved state is.

    Attributes
    ----------
    size, kept : int
        Of the image, and of what a state has of it [bytes].
    sections : dict of str to int
        Place of each argument [bytes].
    relocations : list of (int, int)
        Places of words, and the places that their addresses are of [bytes].
    functions : list of Pointer
        What the image points to.
    fixes : list of (int, int)
        Places of words [bytes], and which function's address each is.
    """

    def __init__(
        self,
        sections: Sequence[tuple[str, Any, Any]],
        tables: Sequence[Any],
        pointers: Sequence[Pointer],
        workspaces: Sequence[Any] = (),
    ) -> None:
        self._words: list[int] = []
        self._arrays: list[tuple[int, Any]] = []  # word that holds its address, array
        self.sections: dict[str, int] = {}
        self.functions: list[Pointer] = []
        self.fixes: list[tuple[int, int]] = []
        self._known: dict[str, int] = {}
        for name, kind, value in sections:
            self.sections[name] = 8 * len(self._words)
            self._flatten(kind, value)
        self._places, self.kept, self.size = self._laid_out({_address(array) for array in workspaces})
        self.relocations = [(8 * word, self.place(array)) for word, array in self._arrays]
        by_address = {pointer.__wrapper_address__(): pointer for pointer in pointers}
        for table in tables:
            begin = self.place(table)
            for i, address in enumerate(table.ravel().tolist()):
                self.fixes.append((begin + 8 * i, self._function(by_address[address])))

    def place(self, array: Any, index: int = 0) -> int:
        """Return the start of an array [bytes].

        With an index, it is the start of that eight-byte item.
        """
        address = _address(array)
        for begin, end, place in self._places:
            if begin <= address < end:
                return place + address - begin + 8 * index
        raise KeyError("the array is not in the image")

    def bytes(self) -> bytes:
        """Return the image with places for addresses.

        It has the present values.
        """
        data = bytearray(self.size)
        struct.pack_into(f"<{len(self._words)}q", data, 0, *self._words)
        for begin, end, place in self._places:
            data[place : place + end - begin] = ctypes.string_at(begin, end - begin)
        for place, target in self.relocations:
            struct.pack_into("<q", data, place, target)
        for place, function in self.fixes:
            struct.pack_into("<q", data, place, function)
        return bytes(data)

    def _function(self, pointer: Pointer) -> int:
        name = symbol(pointer)
        if name not in self._known:
            self._known[name] = len(self.functions)
            self.functions.append(pointer)
        return self._known[name]

    def _flatten(self, kind: Any, value: Any) -> None:
        """Append the words of a value."""
        begin = len(self._words)
        if is_function(kind):
            self.fixes.append((8 * begin, self._function(value)))
            self._words += [0] * words_of(kind)
        elif is_array(kind):
            self._words += [0, 0, value.size, value.itemsize]
            self._arrays.append((len(self._words), value))
            self._words += [0, *value.shape, *value.strides]
        else:
            kinds = kind.fields.values() if isinstance(kind, Reference) else kind.types
            for each, part in zip(kinds, value, strict=True):
                self._flatten(each, part)
        if len(self._words) - begin != words_of(kind):
            raise TypeError(f"{kind} has {words_of(kind)} words in this Numba, not {len(self._words) - begin}")

    def _laid_out(self, last: set[int]) -> tuple[list[tuple[int, int, int]], int, int]:
        """Return the memory layout of the image.

        Runs of memory (begin, end, place in the image), views of one memory together, and both sizes.

        Runs that begin at the addresses `last` stand at the end.
        """
        size = kept = _up(8 * len(self._words))
        runs = []
        merged = list(_merged(sorted(_extent(array) for _, array in self._arrays)))
        for begin, end in sorted(merged, key=lambda run: run[0] in last):
            runs.append((begin, end, size))
            size += _up(end - begin)
            kept = kept if begin in last else size
        return runs, kept, size


def _address(array: Any) -> int:
    return int(array.__array_interface__["data"][0])


def _extent(array: Any) -> tuple[int, int]:
    """Return begin and end of an array's bytes.

    An empty one has a byte, too.
    """
    return _address(array), _address(array) + max(array.nbytes, 1)


def _merged(extents: Sequence[tuple[int, int]]) -> Iterator[tuple[int, int]]:
    """Yield runs of memory that overlap as one."""
    begin, end = extents[0]
    for other, last in extents[1:]:
        if other < end:
            end = max(end, last)
        else:
            yield begin, end
            begin, end = other, last
    yield begin, end


def _up(size: int) -> int:
    return -(-size // _LINE) * _LINE


def host_words(count: int) -> Any:
    """Return memory for the host's numbers.

    It becomes a section of an image.
    """
    return np.zeros(count)
