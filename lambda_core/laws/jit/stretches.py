"""Generate code for parts of arrays and kernel status."""

# Numba's compiler carries only part of its types.
# mypy: disable-error-code="no-untyped-call,no-untyped-def,untyped-decorator"
from __future__ import annotations

from typing import Any

from numba.core import types
from numba.extending import lower_builtin, type_callable

from lambda_core.laws.jit.binding import status_of, stretch

ROW = types.Array(types.float64, 1, "C")


@type_callable(stretch)
def _type_of_stretch(_: Any) -> Any:
    def typer(array: Any, start: Any, count: Any) -> Any:
        integers = isinstance(start, types.Integer) and isinstance(count, types.Integer)
        return ROW if array == ROW and integers else None

    return typer


@lower_builtin(stretch, ROW, types.Integer, types.Integer)
def _lower_stretch(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    # Needed by what compiles; its import would take a tenth of a second from every start.
    from numba.np.arrayobj import populate_array

    start, count = (
        context.cast(builder, value, kind, types.intp)
        for value, kind in zip(arguments[1:], signature.args[1:], strict=True)
    )
    part = context.make_array(ROW)(context, builder)
    size = context.get_constant(types.intp, 8)
    populate_array(
        part,
        data=builder.gep(context.make_array(ROW)(context, builder, arguments[0]).data, [start]),
        shape=(count,),
        strides=(size,),
        itemsize=size,
        meminfo=None,
    )
    return part._getvalue()


@type_callable(status_of)
def _type_of_status(_: Any) -> Any:
    return lambda returned: types.int64 if types.unliteral(returned) == types.int64 else None


@lower_builtin(status_of, types.Integer)
def _lower_status(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    return context.cast(builder, arguments[0], signature.args[0], types.int64)
