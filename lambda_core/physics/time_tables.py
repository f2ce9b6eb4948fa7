"""Loads and motions over time as the flat tables that compiled code reads."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lambda_core.physics.compiled import layout as L
from lambda_core.physics.model import DOFS, BearingModel, TimeFunction

FloatArray = NDArray[np.float64]
_KINDS = {"constant": L.TF_CONSTANT, "ramp": L.TF_RAMP, "harmonic": L.TF_HARMONIC, "table": L.TF_TABLE}


def _terms(channel: int, function: TimeFunction, rows: list[list[float]], table: list[float]) -> None:
    """Append a time function's terms to the flat tables that compiled code reads."""
    for term in function.terms:
        row = [float(channel), float(_KINDS[term.kind]), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
        if term.kind == "table":
            from scipy.interpolate import CubicSpline  # a third of a second to import, and most runs have no table

            times, values = np.array(term.values[0::2]), np.array(term.values[1::2])
            row[6], row[7] = len(table), times.size
            spline = CubicSpline(times, values, bc_type="clamped" if times.size > 2 else "natural")
            for i in range(times.size - 1):
                table += [times[i], *(float(spline.c[3 - k, i]) for k in range(4))]
            table += [times[-1], values[-1], 0.0, 0.0, 0.0]
        else:
            row[2 : 2 + len(term.values)] = term.values
        rows.append(row)


def build_times(model: BearingModel) -> tuple[FloatArray, FloatArray, NDArray[np.int64]]:
    """Return flattened loads and motions (terms, table) and the indices of the free shared states."""
    rows: list[list[float]] = []
    table: list[float] = []
    active: list[int] = []
    for b, body in enumerate((model.inner_ring, model.outer_ring, model.cage_body)):
        if b == L.CAGE and not model.depth.cage:
            continue
        for d, name in enumerate(DOFS):
            dof = body.dofs[name]
            if dof.mode == "prescribed":
                _terms(L.CH_MOTION + 6 * b + d, dof.motion, rows, table)
            if dof.mode == "free":
                # Turning about y moves a_z, turning about z moves a_y.
                position = {3: L.SAZ, 4: L.SAY}.get(d, d)
                active += [L.NS * b + position, L.NS * b + 6 + d]
            elif d == 5 and dof.mode == "prescribed":
                active.append(L.NS * b + L.STHETA)
        for axis in range(3):
            _terms(L.CH_FORCE + 3 * b + axis, body.force[axis], rows, table)
            _terms(L.CH_MOMENT + 3 * b + axis, body.moment[axis], rows, table)
    terms = np.array(rows, dtype=np.float64).reshape(-1, 8)
    return terms, np.array(table or [0.0]), np.array(sorted(active), dtype=np.int64)
