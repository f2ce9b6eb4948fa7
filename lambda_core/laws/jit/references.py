"""Pass named tuples to compiled code by address.

Numba hands a tuple over field by field: an array takes seven words, a tuple of forty arrays three hundred arguments
that every function takes apart and puts together again. That was three quarters of the code that LLVM was given.
Here a function takes one address. Fields are read where they are used; they never change, which LLVM may assume.
"""

# Numba's compiler carries only part of its types.
# mypy: disable-error-code="no-untyped-call,no-untyped-def,untyped-decorator,misc"
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numba
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

from lambda_core.laws.jit.words import HEAD, Array, attribute, kinds_of, words_of

_WORD = 8  # [bytes]
_BYTE, _INT = ir.IntType(8), ir.IntType(64)


class Reference(types.Type):
    """Type of a named tuple in compiled code.

    It is the address of its words.

    Parameters
    ----------
    named : class
        From :func:`lambda_core.laws.jit.words.by_reference`.
    fields : mapping of str to numba type
        Arrays in C order, FunctionTypes and References, in the order of the tuple.
    """

    def __init__(self, named: type[Any], fields: Mapping[str, Any]) -> None:
        self.fields, self.places, size = dict(fields), {}, 0
        for field, kind in kinds_of(named).items():
            self.places[field] = size
            size += words_of(kind)
        self.words, self.attribute = size, attribute(named)
        super().__init__(name=f"Reference({named.__name__})")


_known: dict[type[Any], Reference] = {}


def array_t(kind: Array) -> Any:
    """Return the type of arrays in compiled code."""
    return types.Array(numba.from_dtype(kind.dtype), kind.ndim, "C")


def reference_t(named: type[Any], functions: Mapping[str, Any] | None = None) -> Reference:
    """Return the type of a class in compiled code.

    The class comes from :func:`lambda_core.laws.jit.words.by_reference`.

    Parameters
    ----------
    named : class
    functions : mapping of str to numba FunctionType
        Of its fields that are pointers to functions.
    """
    if named in _known:
        return _known[named]
    fields = {}
    for name, kind in kinds_of(named).items():
        if isinstance(kind, Array):
            fields[name] = array_t(kind)
        else:
            fields[name] = reference_t(kind) if isinstance(kind, type) else (functions or {})[name]
    found = _known[named] = Reference(named, fields)
    typeof_impl.register(named)(lambda value, _: found)
    return found


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
    shape = [_load(builder, place, HEAD + 1 + i, _INT) for i in range(kind.ndim)]
    item = ir.Constant(_INT, context.get_abi_sizeof(context.get_data_type(kind.dtype)))
    strides = [_load(builder, place, HEAD + 1 + kind.ndim + i, _INT) for i in range(kind.ndim - 1)]
    null = cgutils.voidptr_t(None)
    array.meminfo, array.parent = null, builder.bitcast(null, array.parent.type)
    array.nitems = shape[0] if kind.ndim == 1 else _load(builder, place, 2, _INT)
    array.itemsize = item
    array.data = _load(builder, place, HEAD, array.data.type)
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
    """Emit the code for a tuple's address.

    It is the address of its words.
    """
    builder, api = c.builder, c.pyapi
    address = cgutils.alloca_once_value(builder, cgutils.voidptr_t(None))
    found = api.object_getattr_string(value, kind.attribute)
    with builder.if_then(cgutils.is_not_null(builder, found)):
        builder.store(builder.inttoptr(api.long_as_longlong(found), cgutils.voidptr_t), address)
        api.decref(found)
    return NativeValue(builder.load(address), is_error=cgutils.is_not_null(builder, api.err_occurred()))
