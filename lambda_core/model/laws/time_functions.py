"""Convert time functions of a case into sums of terms.

The module also gives their bounds beforehand.
"""

from __future__ import annotations

import math
from dataclasses import replace

from lambda_core.case.signals import ByLaw, Constant, Harmonic, Ramp, Sum, Table, TimeTable
from lambda_core.domain.elements import SPIN
from lambda_core.model.bearing_model import Body, LawTerm, TableTerm, Term, TimeFunction
from lambda_core.model.laws.interpolation import curve, extremes, table_term


def time_function(signal: float | TimeTable | None) -> TimeFunction:
    """Convert a value or table of a case.

    None and zero give the function without terms.
    """
    if signal is None:
        return TimeFunction()
    if isinstance(signal, Sum):
        return added(*(time_function(term) for term in signal.terms))
    if isinstance(signal, Constant):
        signal = signal.value
    if isinstance(signal, Ramp):
        return TimeFunction((Term("ramp", (signal.start, signal.end, signal.start_time, signal.end_time)),))
    if isinstance(signal, Harmonic):
        return TimeFunction((Term("harmonic", (signal.amplitude, signal.frequency, signal.phase)),))
    if isinstance(signal, Table):
        return TimeFunction((table_term(signal),))
    if isinstance(signal, ByLaw):
        if signal.course is None:  # the law is not there, which the resolution has said
            return TimeFunction()
        return TimeFunction((LawTerm("law", (signal.amplitude, *signal.course[1:]), signal.course[0]),))
    if isinstance(signal, TimeTable):
        raise TypeError(f"{type(signal).__name__} is not a kind of time function")
    return TimeFunction.constant(float(signal)) if signal else TimeFunction()


def added(*functions: TimeFunction) -> TimeFunction:
    """Return the sum of time functions, constants merged."""
    terms = [term for function in functions for term in function.terms]
    level = math.fsum(term.values[0] for term in terms if term.kind == "constant")
    varying = tuple(term for term in terms if term.kind != "constant")
    return TimeFunction(((Term("constant", (level,)),) if level else ()) + varying)


def scaled(function: TimeFunction, factor: float) -> TimeFunction:
    """Return the function times `factor`.

    A zero factor gives the function without terms.
    """
    if factor == 0.0:
        return TimeFunction()
    return TimeFunction(tuple(replace(term, values=_scaled_values(term, factor)) for term in function.terms))


def _scaled_values(term: Term, factor: float) -> tuple[float, ...]:
    if term.kind == "ramp":
        start, end, *times = term.values
        return (factor * start, factor * end, *times)
    if term.kind == "table":
        return tuple(factor * number if index % 2 else number for index, number in enumerate(term.values))
    return (factor * term.values[0], *term.values[1:])


def peak(function: TimeFunction) -> float:
    """Return an upper bound of the magnitude at all times."""
    return math.fsum(_term_peak(term) for term in function.terms)


def _term_peak(term: Term) -> float:
    if term.kind == "ramp":
        return max(abs(term.values[0]), abs(term.values[1]))
    if isinstance(term, TableTerm):
        return max(abs(value) for _, value in extremes(term))
    if term.kind == "law":
        return abs(term.values[0]) * term.values[2]
    return abs(term.values[0])


def initial(function: TimeFunction) -> float:
    """Return the value at t = 0."""
    return math.fsum(_term_initial(term) for term in function.terms)


def _term_initial(term: Term) -> float:
    if term.kind == "harmonic":
        return term.values[0] * math.sin(term.values[2])
    if term.kind == "law":
        return term.values[0] * term.values[1]
    if isinstance(term, TableTerm):
        times, numbers = term.values[0::2], term.values[1::2]
        if times[0] >= 0.0 or times[-1] <= 0.0:
            return numbers[0] if times[0] >= 0.0 else numbers[-1]
        return float(curve(term)(0.0))
    return term.values[0]


def planned_speed(function: TimeFunction) -> float:
    """Return the value at t = 0.

    Where it is 0, return the largest planned value with its sign.
    """
    values = [initial(function)]
    for term in function.terms:
        values += {"ramp": term.values[1:2], "table": term.values[1::2]}.get(term.kind, ())
    return values[0] or max(values, key=abs)


def spin_at_start(body: Body) -> float:
    """Return the prescribed spin at t = 0 [rad/s].

    It is 0 where nothing prescribes it.
    """
    return initial(body.dofs[SPIN].motion) if body.dofs[SPIN].mode == "prescribed" else 0.0


def highest_frequency(*functions: TimeFunction) -> float:
    """Return the highest frequency of all terms [Hz].

    0 if none has one.
    """
    places = {"harmonic": 1, "law": 3}
    terms = (term for function in functions for term in function.terms if term.kind in places and term.values[0])
    return max((term.values[places[term.kind]] for term in terms), default=0.0)
