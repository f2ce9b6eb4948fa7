"""Choose the compiled core: pack or native."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from lambda_core.laws.pack import pack


@dataclass(frozen=True)
class Unit:
    """One entry point of compiled code.

    Python calls it, and other compiled code calls it as a pointer.
    """

    call: Callable[..., int]
    pointer: Any


@dataclass(frozen=True)
class Core:
    """Compiled functions of the core.

    Pointers are for other compiled code.

    Parameters
    ----------
    find : function
        The unit of a name: of :data:`lambda_core.solver.entry.UNITS`, or of rollers.
    """

    find: Callable[[str], Unit]
    wrench_pointer: Any
    tangent_pointer: Any
    evaluate_pointer: Any
    jacobian_pointer: Any
    evaluate: Any
    jacobian: Any
    advance: Any
    observe: Any
    solve_static: Any
    advance_pointer: Any
    observe_pointer: Any
    integrate: Any
    sample: Any

    @classmethod
    def of(cls, find: Callable[[str], Unit]) -> Core:
        """Return the core with the units that every run needs."""
        pointers = ("wrench", "tangent", "evaluate", "jacobian", "advance", "observe")
        calls = ("evaluate", "jacobian", "advance", "observe", "solve_static", "integrate", "sample")
        units = {name: find(name) for name in {*pointers, *calls}}
        return cls(
            find,
            **{f"{name}_pointer": units[name].pointer for name in pointers},
            **{name: units[name].call for name in calls},
        )

    @cached_property
    def advance_finely(self) -> Any:
        """The one-step formula, which runs that resolve vibrations take."""
        return self.find("advance_finely").call

    @cached_property
    def advance_finely_pointer(self) -> Any:
        """Pointer to the one-step formula."""
        return self.find("advance_finely").pointer

    @cached_property
    def probe(self) -> Any:
        """Probe of one raceway contact alone.

        Views of its field use it.
        """
        return self.find("probe").call


_loaded: dict[str, Core] = {}  # by where the code comes from


def core(announce: Callable[[str], None] | None = None) -> Core:
    """Return the compiled core.

    `announce` is called with a sentence before anything is compiled.
    """
    packed = pack()
    origin = packed.key if packed else ""
    if origin not in _loaded:
        _loaded[origin] = Core.of(_found_in(packed) if packed else _compiled(announce))
    return _loaded[origin]


def begin(
    announce: Callable[[str], None] | None = None, units: Iterable[str] | None = None, *, has_rollers: bool = False
) -> None:
    """Begin to compile missing code.

    It is not on disk, and there is no pack.

    Parameters
    ----------
    announce, units
        As for :func:`lambda_core.solver.entry.begin`, of the units that every machine may need.
    has_rollers : bool
        Whether those of rollers are needed, too; a pack has them.
    """
    packed = pack()
    needs_core = packed is None and "" not in _loaded
    has_rollers = has_rollers and packed is None
    if needs_core or has_rollers:
        from lambda_core.solver import entry

        entry.begin(announce, [*((entry.NEEDED if units is None else units) if needs_core else ()),
                               *(entry.OF_ROLLERS if has_rollers else ())])  # fmt: skip


def roller_unit(compiled: Core, name: str) -> Unit:
    """Return a unit of rollers.

    Their missing code is compiled by several processes.
    """
    if pack() is None:
        from lambda_core.solver import entry

        begin(has_rollers=True)
        entry.wait()
    return compiled.find(name)


def _found_in(packed: Any) -> Callable[[str], Unit]:
    def find(name: str) -> Unit:
        if not packed.has(name):
            from lambda_core.solver import entry

            return Unit(*entry.call_and_pointer(name))
        found = packed.unit(name)
        return Unit(found, found)

    return find


def _compiled(announce: Callable[[str], None] | None) -> Callable[[str], Unit]:
    from lambda_core.solver import entry

    entry.begin(announce)
    entry.wait()

    def find(name: str) -> Unit:
        return Unit(*entry.call_and_pointer(name, announce))

    return find
