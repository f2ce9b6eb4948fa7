"""Select functions by tables of addresses at run time.

A contact's law is read while compiled code runs.

A tuple of functions would fix their number when the solver is compiled; a table has as many rows as there are bearings,
raceways and cages.
"""

# Numba's compiler carries only part of its types.
# mypy: disable-error-code="no-untyped-call,no-untyped-def,untyped-decorator"
from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir  # type: ignore[import-untyped]
from numba.core import cgutils, types
from numba.extending import lower_builtin, type_callable

TABLE = types.Array(types.int64, 2, "C")


def reader(kind: Any) -> Callable[[Any, int], Any]:
    """Return the function ``read(table, row)``.

    It makes functions of the addresses in one row of a table.

    Parameters
    ----------
    kind : numba type
        A FunctionType, or a NamedTuple of them, one for each column.

    In plain Python a table is a sequence of what `kind` stands for.
    """

    def read(table: Any, row: int) -> Any:
        return table[row]

    is_tuple = isinstance(kind, types.NamedTuple)
    columns = list(kind.types) if is_tuple else [kind]

    @type_callable(read)
    def type_of_read(_: Any) -> Any:
        def typer(table: Any, row: Any) -> Any:
            return kind if table == TABLE and isinstance(row, types.Integer) else None

        return typer

    @lower_builtin(read, TABLE, types.Integer)
    def lower_read(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        data = context.make_array(TABLE)(context, builder, arguments[0]).data
        row = context.cast(builder, arguments[1], signature.args[1], types.int64)
        first = builder.mul(row, ir.Constant(row.type, len(columns)))
        found = []
        for number, column in enumerate(columns):
            place = builder.add(first, ir.Constant(row.type, number))
            function = cgutils.create_struct_proxy(column)(context, builder)
            function.c_addr = builder.inttoptr(builder.load(builder.gep(data, [place])), cgutils.voidptr_t)
            found.append(function._getvalue())
        return context.make_tuple(builder, kind, found) if is_tuple else found[0]

    return read
