"""Loads and motions over time as the flat tables that compiled code reads."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import DOFS
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.law_inputs import times
from lambda_core.solver.drivers.wave_tables import wave_states, weightless
from lambda_core.system.bearing import BearingModel, LawTerm, TableTerm, TimeFunction
from lambda_core.system.interpolation import curve

_KINDS = {"constant": R.CONSTANT, "ramp": R.RAMP, "harmonic": R.HARMONIC, "table": R.TABLE, "law": R.LAW}
# Fields of a term that take the values of each kind.
_VALUES = {
    "constant": ("value",),
    "ramp": ("before", "after", "begin", "end"),
    "harmonic": ("amplitude", "frequency", "phase"),
    "law": ("amplitude",),
}
MOTION, FORCE, MOMENT, PER_BODY = 0, 6, 9, 12  # places of the signals of a body, in the order of records.INPUTS
_CAGE = 2


def add_terms(
    signal: int, function: TimeFunction, rows: list[NDArray[np.void]], table: list[float], laws: Sequence[str] = ()
) -> None:
    """Append a time function's terms to the flat tables that compiled code reads."""
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


def build_times(model: BearingModel) -> tuple[NDArray[np.void], FloatArray, NDArray[np.int64]]:
    """Return flattened loads and motions (terms, table) and the indices of the free shared states."""
    rows: list[NDArray[np.void]] = []
    table: list[float] = []
    active: list[int] = []
    laws = times(model)
    for b, body in enumerate((model.inner_ring, model.outer_ring, model.cage_body)):
        if b == _CAGE and not model.depth.cage:
            continue
        for d, name in enumerate(DOFS):
            dof = body.dofs[name]
            if dof.mode == "prescribed":
                add_terms(PER_BODY * b + MOTION + d, dof.motion, rows, table, laws)
            if dof.mode == "free":
                # Turning about y moves a_z, turning about z moves a_y.
                position = {3: L.SAZ, 4: L.SAY}.get(d, d)
                active += [L.NS * b + position, L.NS * b + 6 + d]
            elif d == 5 and dof.mode == "prescribed":
                active.append(L.NS * b + L.STHETA)
        for axis in range(3):
            add_terms(PER_BODY * b + FORCE + axis, body.force[axis], rows, table, laws)
            add_terms(PER_BODY * b + MOMENT + axis, body.moment[axis], rows, table, laws)
    active += wave_states(model)
    terms = np.concatenate([np.zeros(0, R.TERM), *rows, weightless(model, PER_BODY, FORCE)])
    return terms, np.array(table or [0.0]), np.array(sorted(active), dtype=np.int64)
