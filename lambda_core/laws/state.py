"""Define states of contacts and their rates."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from lambda_core.domain.channels import CHANNELS, DIMENSIONS, Channel
from lambda_core.domain.errors import nearest
from lambda_core.domain.roles import ROLES
from lambda_core.domain.units import UNITS
from lambda_core.laws.context import Context

if TYPE_CHECKING:
    from lambda_core.laws.law import Law

ROLE = "contact_state"
READERS = tuple(name for name, role in ROLES.items() if role.reads_states)
MOST = 16  # states of one law
_NAME = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*")


@dataclass(frozen=True)
class State:
    """State that every raceway contact keeps.

    It is one number: a temperature, a wear depth or a layer of oil.

    Attributes
    ----------
    name : str
        In lower case with underscores: laws read it as ``par.NAME``, the result has a channel of this name.
    unit, meaning : str
        As of a channel.
    scale : float
        A change that matters, in this unit: the integrator allows `solver.tolerance` times it as error per step.
    start : float or callable
        Value at the start; or ``start(parameters, context)``, which returns it.
    lower, upper : float
        Bounds that the program holds: no law reads a value outside them, and a rate that points outwards at a bound
        counts as zero.
    """

    name: str
    unit: str
    meaning: str
    scale: float
    start: float | Callable[[Any, Context], float] = 0.0
    lower: float = -math.inf
    upper: float = math.inf

    @property
    def channel(self) -> Channel:
        """Channel in the result."""
        return Channel(self.name, ("ball", "ring"), self.unit, self.meaning)

    def at_start(self, parameters: Any, context: Context) -> float:
        """Return the value at the start."""
        return float(self.start(parameters, context) if callable(self.start) else self.start)


def names_behind(law: Law) -> tuple[str, ...]:
    """Return the states behind a law's parameters.

    The states that it reads come before those that it keeps.
    """
    return (*law.reads, *(state.name for state in law.states))


def values_behind(law: Law, parameters: Any, context: Context) -> list[float]:
    """Return the initial values of the states.

    They hold until the solver computes others: of a trial, and at the start.
    """
    return [*map(float, law.reads.values()), *(state.at_start(parameters, context) for state in law.states)]


def state_fault(law: Law) -> str:
    """Report a wrong state of a law.

    The law keeps or reads it; nothing if all are right.
    """
    if law.role == ROLE and not law.states and law.name != "none":
        return "keeps no state: name what every contact keeps, states=(State(name, unit, meaning, scale),)"
    if law.states and law.role != ROLE:
        return f"keeps states: only laws of the role {ROLE} do"
    if len(law.states) > MOST:
        return f"keeps {len(law.states)} states, at most {MOST} are allowed"
    if law.reads and law.role not in READERS:
        return f"reads states, which laws of the role {law.role} cannot; these can: {', '.join(READERS)}"
    names = names_behind(law)
    taken = {channel.name for channel in CHANNELS} | {*DIMENSIONS, "ball", "marker", "status"}
    for name in names:
        if not isinstance(name, str) or not _NAME.fullmatch(name):
            return f'has the state "{name}": its name is in lower case with underscores ("wear_depth")'
        if name in taken or names.count(name) > 1:
            return f"has the state {name}: the name is taken"
    for state in law.states:
        if fault := _unit_fault(state.unit):
            return f"has the state {state.name} in {fault}"
        if not (state.scale > 0.0 and math.isfinite(state.scale)):
            return f"has the state {state.name} of the scale {state.scale}: must be a positive number"
        if not state.lower < state.upper:
            return f"has the state {state.name} between {state.lower:g} and {state.upper:g}: lower must be below upper"
    return _reads_fault(law.reads)


def _unit_fault(unit: str) -> str:
    """Report a wrong unit.

    Nothing if it is right; apart from powers and strokes its symbols are those of the units.
    """
    if unit == "-":
        return ""
    known = {symbol for units in UNITS.values() for each in units for symbol in _symbols(each)}
    strange = [symbol for symbol in _symbols(unit) if symbol not in known]
    if not unit.strip() or strange:
        near = f"; nearest: {', '.join(nearest(strange[0], known))}" if strange and nearest(strange[0], known) else ""
        return f'"{unit}", which is no unit{near}: write it like "K", "m3", "J/m2", or "-" where it has none'
    return ""


def _symbols(unit: str) -> list[str]:
    return [symbol for word in re.split(r"[ /()]+", unit) if (symbol := word.rstrip("0123456789")) and symbol != "-"]


def _reads_fault(reads: Mapping[str, float]) -> str:
    for name, value in reads.items():
        if not isinstance(value, int | float) or not math.isfinite(value):
            return f"reads the state {name} and is tried with {value!r}: must be a finite number"
    return ""
