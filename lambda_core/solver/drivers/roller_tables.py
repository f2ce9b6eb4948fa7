"""Write rollers as tables of compiled code."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import INNER
from lambda_core.elements.ball import BALL
from lambda_core.elements.kind import LINE, RIB
from lambda_core.elements.roller.roller_bearing import Rib, Ring, RollerBearing
from lambda_core.elements.roller.roller_kinds import ROLLER
from lambda_core.elements.roller.slices import SLICES, slice_positions
from lambda_core.laws.jit.words import addresses
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.factors import RollerBlocks
from lambda_core.solver.core import roller_unit

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel, Cage
    from lambda_core.solver.core import Core

_BAR = 0.9  # length of the bars that rollers touch, over the effective length: ends are relieved


def states_of_an_element(model: BearingModel) -> int:
    """Return the state count of an element.

    Each ball or roller of a bearing has so many.
    """
    return (BALL if model.rollers is None else ROLLER).states


def spin_in_space(rollers: RollerBearing | None, spin: FloatArray) -> FloatArray:
    """Return spins (..., 3) in turning axes.

    Axial, radial, tangential, from those of the state; rollers have theirs about own axes.
    """
    if rollers is None:
        return spin.copy()
    axis = rollers.faces * rollers.angles.roller  # the large end points to -x where they face x
    c, s = np.cos(axis), np.sin(axis)
    own, across = spin[..., 0], spin[..., 1]
    return np.stack([c * own + s * across, c * across - s * own, spin[..., 2]], axis=-1)


def write_line(record: Any, rollers: RollerBearing, ring: int, line: int) -> None:
    """Write the fields of a rollers' raceway.

    They are those that differ from a raceway of balls.

    The clearance is shared by both rings, as are those of balls. To laws R_y is the effective length.
    """
    side, angles, half = record["side"], rollers.angles, 0.5 * rollers.diameter
    name: Ring = "inner" if ring == INNER else "outer"
    cone = angles.inner if ring == INNER else angles.outer
    lean = np.cos(angles.roller)
    record["kind"], record["line"], record["cone"] = LINE.number, line, -rollers.faces * cone
    record["groove_circle"] = rollers.centre + side * (half * lean + 0.25 * rollers.clearance / np.cos(cone))
    record["axial_offset"] = rollers.faces * side * half * np.sin(angles.roller)
    record["groove_radius"], record["ball_radius"] = np.inf, half
    record["radius_x"], record["radius_y"] = rollers.radius(name), rollers.effective_length
    record["radius_deformed"] = np.inf


def rib_of(rollers: RollerBearing, ring: int, end: int) -> Rib:
    """Return a rib of a ring.

    It is at the end of the rollers towards +x or -x.
    """
    name = ("inner", "outer")[ring]
    return next(rib for rib in rollers.ribs if (rib.ring, rollers.faces * rib.end) == (name, end))


def write_rib(record: Any, rollers: RollerBearing, ring: int, end: int) -> None:
    """Write the fields of a rib.

    They are those that differ from a raceway of balls; R_x is along sliding.
    """
    rib = rib_of(rollers, ring, end)
    record["kind"], record["side"] = RIB.number, end
    record["axial_offset"], record["rib_radius"] = rollers.faces * rib.place[0] + end * rib.gap, rib.contact.distance
    record["rib_angle"] = np.arctan2(end * -rib.normal[1], end * rollers.faces * -rib.normal[0])
    record["ball_radius"] = rib.contact.end_radius
    record["radius_x"], record["radius_y"] = rib.contact.radius_x, rib.contact.radius_y
    record["radius_deformed"], record["roughness"] = 2.0 * rib.contact.radius_y, rollers.rib_roughness


def write_row(record: Any, rollers: RollerBearing, cage: Cage) -> None:
    """Write the fields of a rollers' row.

    They are those that differ from a row of balls; large ends of cones that face x point to -x.
    """
    polar, transverse = rollers.inertias
    record["kind"], record["ball_radius"] = R.ROLLERS, 0.5 * rollers.diameter
    record["ball_inertia"], record["transverse_inertia"] = polar, transverse
    axis, half = rollers.faces * rollers.angles.roller, rollers.faces * rollers.angles.half
    record["axis_angle"], record["cone_angle"] = -axis, -half
    record["length"], record["total_length"] = rollers.effective_length, rollers.length
    record["end_radius"] = rollers.ribs[0].contact.end_radius if rollers.ribs else np.inf
    record["bar_gap"] = record["end_gap"] = 0.5 * cage.pocket_clearance
    record["bar_length"] = _BAR * rollers.effective_length


def lines_of(models: Sequence[BearingModel]) -> FloatArray:
    """Return Bundle.lines of all roller bearings.

    Inner raceways come first.
    """
    found = [_lines(model.rollers) for model in models if model.rollers is not None]
    return np.concatenate(found) if found else np.zeros((0, L.LINE_ROWS, 0))


def _lines(rollers: RollerBearing) -> FloatArray:
    """Return the slices' tables of a line.

    Places along the contact, widths, drops and reduced radii, (2, LINE_ROWS, SLICES).

    Places count along s = n x t, which is x of the outer raceway and -x of the inner one.
    """
    x = slice_positions(rollers.effective_length, SLICES)
    width = np.full(SLICES, rollers.effective_length / SLICES)
    share = rollers.faces * np.tan(rollers.angles.half) / (0.5 * rollers.diameter)  # of the radius, towards -x
    rings: tuple[tuple[Ring, float], ...] = (("inner", 1.0), ("outer", -1.0))
    drop = rollers.drops(SLICES)
    return np.array([[x, width, drop, rollers.radius(name) * (1.0 + sign * share * x)] for name, sign in rings])


_kept: dict[str, Any] = {}  # code of rollers: tables of addresses do not keep it


def roller_code(compiled: Core, has_rollers: bool) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the addresses of rollers' code.

    They are those of RollerCode and RollerBlocks, which are compiled when a machine first has rollers.
    """
    names = [*L.RollerCode._fields], [*RollerBlocks._fields]
    if not has_rollers:
        return np.zeros((0, len(names[0])), dtype=np.int64), np.zeros((0, len(names[1])), dtype=np.int64)
    for name in (*names[0], *names[1]):
        if name not in _kept:
            _kept[name] = roller_unit(compiled, f"roller_{name}").pointer
    code, blocks = (addresses([[_kept[name] for name in each]]) for each in names)
    return code, blocks


def roller_pointers() -> list[Any]:
    """Return the pointers whose addresses `roller_code` has returned."""
    return [*_kept.values()]
