"""Write loads and motions over time as tables."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import CAGE, DOFS
from lambda_core.model.bearing_model import BearingModel, LawTerm, TableTerm, TimeFunction
from lambda_core.model.laws.interpolation import curve
from lambda_core.solver import records as R
from lambda_core.solver.drivers.assembly import Assembly
from lambda_core.solver.drivers.law_inputs import times
from lambda_core.solver.drivers.row_cages import cage_places, cages_in, own_bodies
from lambda_core.solver.drivers.wave_tables import AMPLITUDES, waves_of

_KINDS = {"constant": R.CONSTANT, "ramp": R.RAMP, "harmonic": R.HARMONIC, "table": R.TABLE, "law": R.LAW}
# Fields of a term that take the values of each kind.
_VALUES = {
    "constant": ("value",),
    "ramp": ("before", "after", "begin", "end"),
    "harmonic": ("amplitude", "frequency", "phase"),
    "law": ("amplitude",),
}
MOTION, FORCE, MOMENT, PER_BODY = 0, 6, 9, 12  # places of the signals of a body, in the order of records.INPUTS


def add_terms(
    signal: int, function: TimeFunction, rows: list[NDArray[np.void]], table: list[float], laws: Sequence[str] = ()
) -> None:
    """Append a time function's terms to tables.

    They are the flat tables that compiled code reads.
    """
    for term in function.terms:
        row = np.zeros(1, R.TERM)
        row["signal"], row["kind"] = signal, _KINDS[term.kind]
        if isinstance(term, TableTerm):
            joined = curve(term)
            row["start"], row["knots"] = len(table), joined.x.size
            table += np.column_stack([joined.x[:-1], joined.c[::-1].T]).ravel().tolist()
            table += [joined.x[-1], term.values[-1], 0.0, 0.0, 0.0]
        else:
            for name, value in zip(_VALUES[term.kind], term.values, strict=False):
                row[name] = value
        if isinstance(term, LawTerm):
            row["law"] = laws.index(term.law)
        rows.append(row)


def build_times(assembly: Assembly) -> tuple[NDArray[np.void], FloatArray]:
    """Return loads and motions as terms.

    They belong to all members, as records.TERM with their table.
    """
    rows: list[NDArray[np.void]] = []
    table: list[float] = []
    laws = [element for bearing in assembly.bearings for element in times(bearing.model)]
    left_out = {bearing.members[CAGE] for bearing in assembly.bearings if not bearing.model.depth.cage}
    bodies = [(b, member.body, 0.0) for b, member in enumerate(assembly.members)]
    for bearing, span in zip(assembly.bearings, assembly.spans(), strict=True):
        own, places = cages_in(span.bodies, bearing.model), cage_places(bearing.model)
        body = bodies[own[0]][1]
        bodies[own[0]] = (own[0], body, places[0])
        bodies += [(number, body, place) for number, place in zip(own[1:], places[1:], strict=True)]
        left_out |= set(own[1:]) if own[0] in left_out else set()
    for b, body, place in bodies:
        if b in left_out:
            continue
        for d, name in enumerate(DOFS):
            if body.dofs[name].mode == "prescribed":
                add_terms(PER_BODY * b + MOTION + d, body.dofs[name].motion, rows, table, laws)
            if name == "x" and place and body.dofs[name].mode != "free":
                add_terms(PER_BODY * b + MOTION + d, TimeFunction.constant(place), rows, table, laws)
        for axis in range(3):
            add_terms(PER_BODY * b + FORCE + axis, body.force[axis], rows, table, laws)
            add_terms(PER_BODY * b + MOMENT + axis, body.moment[axis], rows, table, laws)
    for bearing, span in zip(assembly.bearings, assembly.spans(), strict=True):
        rows += [_weightless(bearing.model, span.bodies[own_bodies(bearing.model) :], assembly.gravity)]
    return np.concatenate([np.zeros(0, R.TERM), *rows]), np.array(table or [0.0])


def _weightless(model: BearingModel, bodies: Sequence[int], gravity: Sequence[float]) -> NDArray[np.void]:
    """Return loads that hold up wave bodies.

    They are records.TERM, because gravity bends no ring.
    """
    masses = [waves.ring.mass(order) for _, order, waves in waves_of(model)]
    rows = np.zeros((len(masses), len(AMPLITUDES)), R.TERM)
    rows["kind"] = R.CONSTANT
    for row, body, mass in zip(rows, bodies, masses, strict=True):
        for term, axis in zip(row, AMPLITUDES, strict=True):
            term["signal"], term["value"] = PER_BODY * body + FORCE + axis, -mass * gravity[axis]
    return rows.ravel()
