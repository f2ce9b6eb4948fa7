"""Named tuples of arrays and functions that compiled code takes by their address.

Numba hands a tuple over field by field: an array takes seven words, a tuple of forty arrays three hundred arguments
that every function takes apart and puts together again. That was three quarters of the code that LLVM was given.
Here a function takes one address. Fields are read where they are used; they never change, and LLVM is told so.
"""

# Numba's compiler carries only part of its types.
# mypy: disable-error-code="no-untyped-call,no-untyped-def,untyped-decorator,misc"
from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, TypeVar

import numpy as np
from llvmlite import ir  # type: ignore[import-untyped]
from numba import types
from numba.core import cgutils
from numba.core.typing.templates import AttributeTemplate
from numba.extending import (
    NativeValue,
    infer_getattr,
    lower_getattr_generic,
    models,
    register_model,
    typeof_impl,
    unbox,
)

_WORD = 8  # [bytes]
_HEAD = 4  # words of an array before its address: two of Numba's memory management, items, size of an item
_BYTE, _INT = ir.IntType(8), ir.IntType(64)
_FUNCTION = 3  # words of a pointer to a function: its address for C, and two for Python, which stay 0
T = TypeVar("T")


class Reference(types.Type):
    """Type of a named tuple in compiled code: the address of its words.

    Parameters
    ----------
    name : str
        Of the class of the tuple.
    fields : mapping of str to numba type
        Arrays in C order, FunctionTypes and References, in the order of the tuple.
    """

    def __init__(self, name: str, fields: Mapping[str, Any]) -> None:
        self.fields, self.places, size = dict(fields), {}, 0
        for field, kind in self.fields.items():
            self.places[field] = size
            size += words_of(kind)
        self.words = size
        super().__init__(name=f"Reference({name})")

    @property
    def attribute(self) -> str:
        """Name of the attribute that has the address: of this tuple and no other."""
        return f"address_{self.name[10:-1]}"


def words_of(kind: Any) -> int:
    """Return how many words of eight bytes a field takes."""
    if isinstance(kind, Reference):
        return kind.words
    return _HEAD + 1 + 2 * kind.ndim if isinstance(kind, types.Array) else _FUNCTION


def by_reference(named: type[T]) -> type[T]:
    """Let a class of named tuples keep its words once they are made; :func:`reference_t` gives it a type."""
    own: dict[str, Any] = {"__module__": named.__module__, "__doc__": named.__doc__, "__qualname__": named.__qualname__}
    own["__getstate__"] = lambda _: None  # a copy, in this process or another, has arrays at other addresses
    return type(named.__name__, (named,), own)  # without __slots__, unlike the tuple itself


def reference_t(named: type[Any], fields: Mapping[str, Any]) -> Reference:
    """Return the type of a class from :func:`by_reference` in compiled code.

    Parameters
    ----------
    named : class
    fields : mapping of str to numba type
        In any order; all fields of the class.
    """
    kind = Reference(named.__name__, {field: fields[field] for field in named._fields})

    def address(self: Any) -> int:
        kept: Any = self.__dict__.get("_words")
        if kept is None:
            kept = self._words = np.array(list(_words(kind, self)), dtype=np.int64)
        return int(kept.ctypes.data)

    setattr(named, kind.attribute, property(address))
    typeof_impl.register(named)(lambda value, _: kind)
    return kind


def _words(kind: Any, value: Any) -> Iterator[int]:
    """Yield the words of a field.

    Raises
    ------
    TypeError
        When an array is of another type: compiled code would read past its end.
    """
    if isinstance(kind, Reference):
        for field, of_field in kind.fields.items():
            yield from _words(of_field, getattr(value, field))
    elif isinstance(kind, types.Array):
        yield from array_words(kind, value, int(value.ctypes.data))
    else:
        yield from (value.__wrapper_address__(), 0, 0)


def array_words(kind: Any, value: Any, address: int) -> Iterator[int]:
    """Yield the words of an array whose items stand at an address; TypeError when it is of another type."""
    wanted = np.dtype(str(kind.dtype)) if not isinstance(kind.dtype, types.Record) else None
    size = kind.dtype.size if wanted is None else wanted.itemsize
    if value.ndim != kind.ndim or value.itemsize != size or not value.flags.c_contiguous:
        raise TypeError(f"an array of {value.dtype}, shape {value.shape}, where compiled code takes {kind}")
    if wanted is not None and value.dtype != wanted:
        raise TypeError(f"an array of {value.dtype} where compiled code takes {wanted}")
    yield from (0, 0, value.size, value.itemsize, address, *value.shape, *value.strides)


register_model(Reference)(models.OpaqueModel)


@infer_getattr
class _Fields(AttributeTemplate):
    key = Reference

    def generic_resolve(self, typ, attr):  # type: ignore[override]
        return typ.fields.get(attr)


@lower_getattr_generic(Reference)
def _read(context, builder, kind, value, name):
    """Emit what reads one field."""
    place = builder.gep(value, [ir.Constant(_INT, _WORD * kind.places[name])])
    field = kind.fields[name]
    if isinstance(field, Reference):
        return place
    if isinstance(field, types.Array):
        return _read_array(context, builder, field, place)
    function = cgutils.create_struct_proxy(field)(context, builder)
    function.c_addr = _load(builder, place, 0, cgutils.voidptr_t)
    return function._getvalue()


def _read_array(context, builder, kind, place):
    array = context.make_array(kind)(context, builder)
    shape = [_load(builder, place, _HEAD + 1 + i, _INT) for i in range(kind.ndim)]
    item = ir.Constant(_INT, context.get_abi_sizeof(context.get_data_type(kind.dtype)))
    strides = [_load(builder, place, _HEAD + 1 + kind.ndim + i, _INT) for i in range(kind.ndim - 1)]
    null = cgutils.voidptr_t(None)
    array.meminfo, array.parent = null, builder.bitcast(null, array.parent.type)
    array.nitems = shape[0] if kind.ndim == 1 else _load(builder, place, 2, _INT)
    array.itemsize = item
    array.data = _load(builder, place, _HEAD, array.data.type)
    array.shape = cgutils.pack_array(builder, shape, ty=_INT)
    array.strides = cgutils.pack_array(builder, [*strides, item], ty=_INT)
    return array._getvalue()


def _load(builder, place, word, kind):
    """Emit the load of a word that never changes."""
    at = builder.gep(place, [ir.Constant(_INT, _WORD * word)])
    found = builder.load(builder.bitcast(at, kind.as_pointer()))
    found.set_metadata("invariant.load", builder.module.add_metadata([]))
    return found


@unbox(Reference)
def _unbox(kind, value, c):
    """Emit what asks a tuple for the address of its words."""
    builder, api = c.builder, c.pyapi
    address = cgutils.alloca_once_value(builder, cgutils.voidptr_t(None))
    found = api.object_getattr_string(value, kind.attribute)
    with builder.if_then(cgutils.is_not_null(builder, found)):
        builder.store(builder.inttoptr(api.long_as_longlong(found), cgutils.voidptr_t), address)
        api.decref(found)
    return NativeValue(builder.load(address), is_error=cgutils.is_not_null(builder, api.err_occurred()))
