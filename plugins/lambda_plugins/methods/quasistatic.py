"""Offer the quasi-static equilibrium as a comparison method."""

from __future__ import annotations

import math

from lambda_core.formulas.loading import loaded_elements
from lambda_core.views.method import (
    EquilibriumState,
    Method,
    MethodInputs,
    MethodRow,
    MethodTable,
    NotApplicable,
)

_MOST = "contact angle of the ball that the inner ring loads most"
_AXES = ("x", "y", "z", "tilt_y", "tilt_z")
# sums to compare with M_rr, M_sl and M_drag of the catalogue
_SUMS = {
    "rolling": ("rolling", "hysteresis"),
    "sliding": ("sliding", "spin", "boundary"),
    "drag": ("drag",),
}


def _stiffness_rows(stiffness: tuple[tuple[float, ...], ...]) -> list[MethodRow]:
    """Return the upper triangle of the stiffness matrix.

    It is 5 x 5, in N/um, N/mrad and N m/mrad.
    """
    rows = []
    for i, first in enumerate(_AXES):
        for j in range(i, len(_AXES)):
            angles = (i >= 3) + (j >= 3)
            unit, scale = (("N/um", 1e-6), ("N/mrad", 1e-3), ("N m/mrad", 1e-3))[angles]
            rows.append(MethodRow("stiffness", f"{first} {_AXES[j]}", stiffness[i][j] * scale, unit))
    return rows


def _load_rows(state: EquilibriumState) -> list[MethodRow]:
    most = max(state.contacts, key=lambda contact: contact.load_inner)
    outer = max(contact.load_outer for contact in state.contacts)
    loaded = loaded_elements([contact.load_inner for contact in state.contacts])
    x, y, z = (value * 1e6 for value in state.displacement[:3])
    return [
        MethodRow("load", "largest contact load, inner", most.load_inner, "N"),
        MethodRow("load", "largest contact load, outer", outer, "N"),
        MethodRow("load", "angle, most loaded, inner", math.degrees(most.angle_inner), "deg", _MOST),
        MethodRow("load", "angle, most loaded, outer", math.degrees(most.angle_outer), "deg", _MOST),
        MethodRow("load", "loaded balls", float(loaded), "-", "by the inner ring, with over 1 % of its largest load"),
        MethodRow("load", "displacement x", x, "um"),
        MethodRow("load", "displacement y", y, "um"),
        MethodRow("load", "displacement z", z, "um"),
    ]


def _friction_rows(state: EquilibriumState) -> list[MethodRow]:
    """Return the friction torque and its parts.

    The total first, then the three sums that catalogues print, then every part.
    """
    if not state.friction:
        return []
    total = sum(value for _, value in state.friction)
    rows = [MethodRow("friction", "total", total * 1e3, "N mm", "quasi-static, cage left out")]
    for name, mechanisms in _SUMS.items():
        part = sum(value for part, value in state.friction if part.split(" ")[0] in mechanisms)
        rows.append(MethodRow("friction", name, part * 1e3, "N mm", " + ".join(mechanisms)))
    named = {row.name for row in rows}
    rows += [MethodRow("friction", part, value * 1e3, "N mm") for part, value in state.friction if part not in named]
    return rows


def evaluate(inputs: MethodInputs) -> MethodTable:
    """Return loads, displacement, stiffness and friction of an equilibrium.

    The equilibrium is quasi-static.
    """
    state = inputs.state
    if state is None or not state.contacts:
        raise NotApplicable("no quasi-static equilibrium was found")
    rows = _load_rows(state)
    rows += _friction_rows(state)
    if state.stiffness is not None:
        rows += _stiffness_rows(state.stiffness)
    return MethodTable(tuple(rows))


QUASI_STATIC = Method(
    name="quasi-static",
    title="Quasi-static equilibrium of this project",
    reference="the same laws and geometry as the simulation, without its dynamics",
    evaluate=evaluate,
    method_api=1,
)
