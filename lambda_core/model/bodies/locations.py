"""Resolve body, point and axes of a case's parts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lambda_core.case.machine import PARTS, MachineCase
from lambda_core.case.machine_parts import Connection, Placed
from lambda_core.case.motion import Marker
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import unknown_name
from lambda_core.domain.units import show
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.formulas.elastic.body import ElasticBody
from lambda_core.model.ledger import Ledger
from lambda_core.model.machine_model import GROUND, SHAFT, BearingPart, Carrier, Place

_PLACED = ("bearings", "discs", "gears", "loads", "connections")
_ON_AXIS = ("bearings", "discs", "gears", "shaft")  # stand on the shaft itself
SUPPORT = "shaft.support"
_ON_PARTS = ("loads", "connections")  # may act on outer rings and cages
_SAME = 1e-6  # [m]


@dataclass(frozen=True)
class Places:
    """Places of all parts.

    Attributes
    ----------
    of : dict of str to Place
        By path: "loads.belt".
    carriers : dict of str to int or BearingPart
        Every body by its name: ground, shaft, [bodies], and "left.outer_ring", "left.cage" of the bearing "left".
    markers : dict of str to Place
        Those of the case, and the nodes of a reduced shaft by their names.
    """

    of: Mapping[str, Place]
    carriers: Mapping[str, Carrier]
    markers: Mapping[str, Place]

    def on_shaft(self, table: str, name: str) -> bool:
        """Tell whether a part stands on the shaft."""
        return self.of[f"{table}.{name}"].body == SHAFT

    def carrier(self, name: str) -> Carrier:
        """Return a body by name or marker.

        The ground where nobody knows the name.
        """
        if name in self.carriers:
            return self.carriers[name]
        return self.markers[name].body if name in self.markers else GROUND

    def seat(self, name: str) -> int:
        """Return the body that carries an outer ring.

        It is the body's number, or that of the ground where no body can carry the ring.
        """
        found = self.carrier(name)
        return GROUND if isinstance(found, BearingPart) else found


def places(case: MachineCase, outside: ElasticBody | None, ledger: Ledger) -> Places:
    """Return the places of all parts.

    Problems are noted.

    Where the shaft comes from a file that cannot be read, names that nobody knows may be those of its nodes.
    """
    is_blind = outside is None and case.shaft.reduced is not None
    parts = bearing_parts(case)
    carriers: dict[str, Carrier] = {"ground": GROUND, "shaft": SHAFT}
    carriers |= {name: i + 1 for i, name in enumerate(case.bodies)}
    carriers |= parts
    nodes: dict[str, float] = {}
    if outside is not None and outside.names:
        nodes = dict(zip(outside.names, outside.positions.tolist(), strict=True))
    markers = {name: Place(SHAFT, (float(x), 0.0, 0.0), np.eye(3)) for name, x in nodes.items()}
    for name, marker in case.markers.items():
        if name in nodes:
            ledger.problem(f"markers.{name}", "is the name of a node of the shaft already: choose another one")
        if "x" not in marker.model_fields_set:
            ledger.problem(f"markers.{name}.x", "is required: place along the shaft, from its left end")
        if marker.body not in carriers:
            ledger.problem(f"markers.{name}.body", unknown_name("body", marker.body, carriers))
        markers[name] = Place(carriers.get(marker.body, GROUND), marker.point, _axes(marker))
    found: dict[str, Place] = {}
    for table, where, part in _placed(case):
        if part.along is not None:
            found[where] = Place(SHAFT, (part.along, 0.0, 0.0), np.eye(3))
        elif part.at is None:
            found[where] = Place(SHAFT, (_coupling(case, outside, found), 0.0, 0.0), np.eye(3))
        elif part.at in markers:
            found[where] = markers[part.at]
            is_by_law = isinstance(part, Connection) and part.is_by_law
            _fits(table, where, part.at, found[where], ledger, is_by_law=is_by_law)
        elif table in _ON_PARTS and part.at in parts:
            own = f"bearings.{parts[part.at].bearing}"
            if own in found:  # else that is what is wrong
                found[where] = Place(parts[part.at], found[own].point, np.eye(3))
        elif table != "bearings" and part.at in case.bearings:
            if f"bearings.{part.at}" in found:  # else that is what is wrong
                found[where] = Place(SHAFT, found[f"bearings.{part.at}"].point, np.eye(3))
        elif not is_blind:
            what, known = (
                ("marker", markers) if table == "bearings" else ("marker or bearing", [*markers, *case.bearings])
            )
            known = [*known, *parts] if table in _ON_PARTS and "." in part.at else known
            ledger.problem(f"{where}.at", _unknown(what, part.at, known))
    _refuse_absent_cages(case, carriers, found, ledger)
    _ends(case, carriers, markers, found, ledger)
    return Places(found, carriers, markers)


def bearing_parts(case: MachineCase) -> dict[str, BearingPart]:
    """Return the outer rings and cages as places.

    The keys are their names in a case, such as "left.outer_ring" and "left.cage".
    """
    return {f"{name}.{part}": BearingPart(name, part) for name in case.bearings for part in PARTS}


def _refuse_absent_cages(
    case: MachineCase, carriers: Mapping[str, Carrier], found: Mapping[str, Place], ledger: Ledger
) -> None:
    """Note places on the cage of a cageless bearing."""
    used = [(f"{where}.at", place.body) for where, place in found.items()]
    used += [(f"markers.{name}.body", carriers.get(marker.body, GROUND)) for name, marker in case.markers.items()]
    used += [(f"connections.{name}.to", carriers.get(one.to, GROUND)) for name, one in case.connections.items()]
    for where, body in used:
        if not isinstance(body, BearingPart) or body.part != "cage":
            continue
        depth = case.bearings[body.bearing].depth
        if not (depth if "cage" in depth.model_fields_set else case.depth).cage:
            ledger.problem(where, f'"{body.bearing}" has no cage: depth.cage is false')


def _placed(case: MachineCase) -> Iterator[tuple[str, str, Placed]]:
    """Yield table, path and part of everything that stands somewhere."""
    for table in _PLACED:
        yield from ((table, f"{table}.{name}", part) for name, part in getattr(case, table).items())
    if case.shaft.support.is_used:
        yield "shaft", SUPPORT, case.shaft.support


def _coupling(case: MachineCase, outside: ElasticBody | None, found: Mapping[str, Place]) -> float:
    """Return the place of the coupling [m].

    On a rigid shaft it is at its bearing.
    """
    if case.shaft.drive is not None:
        return case.shaft.drive
    if case.shaft.is_rigid:
        return next((place.point[0] for where, place in found.items() if where.startswith("bearings.")), 0.0)
    return 0.0 if outside is None else float(outside.positions[0])


def carried(arm: Sequence[float] | FloatArray) -> FloatArray:
    """Return the motion of a point with a body.

    `arm` is from the body's centre [m], shape (6, 6): u + theta x arm.
    """
    x, y, z = (float(a) for a in arm)
    found: FloatArray = np.eye(NODE)
    found[:3, 3:] = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]
    return found


def carried_by_shaft(body: ElasticBody, point: Sequence[float] | FloatArray) -> tuple[float, FloatArray]:
    """Return the node of a shaft's point.

    Also return its place [m] and how the point moves with the node, shape (6, 6).
    """
    node = body.nearest(float(point[0]))
    return node, carried([float(point[0]) - node, *point[1:]])


def _unknown(what: str, name: str, known: Iterable[str]) -> str:
    """Suggest a name for an unknown one."""
    names = list(known)
    words = unknown_name(what, name, names) if names else f'there is no marker "{name}"; there are no [markers]'
    return f'{words}; or a length with its unit, "85 mm"' if name[:1].isdigit() else words


def _fits(table: str, where: str, marker: str, place: Place, ledger: Ledger, *, is_by_law: bool) -> None:
    """Note a marker that this part cannot use.

    A law acts at places that turn with the shaft, too.
    """
    is_off_axis = max(abs(place.point[1]), abs(place.point[2])) > _SAME
    if table in _ON_AXIS and (place.body != SHAFT or is_off_axis):
        ledger.problem(f"{where}.at", f'"{marker}" is not on the axis of the shaft: choose a marker on it')
    elif table == "connections" and place.body == SHAFT and is_off_axis and not is_by_law:
        ledger.problem(f"{where}.at", f'"{marker}" turns with the shaft off its axis, where no spring can be attached')


def _ends(
    case: MachineCase, carriers: Mapping[str, Carrier], markers: Mapping[str, Place], found: Mapping[str, Place],
    ledger: Ledger,
) -> None:  # fmt: skip
    """Check the carriers of rings and spring ends.

    The rings are outer rings; springs have other ends.
    """
    others = [(f"bearings.{name}", "outer", part.outer) for name, part in case.bearings.items()]
    others += [(f"connections.{name}", "to", part.to) for name, part in case.connections.items()]
    for where, option, other in others:
        if other not in carriers and other not in markers:
            ledger.problem(f"{where}.{option}", unknown_name("body or marker", other, [*carriers, *markers]))
            continue
        if where not in found:
            continue
        body = carriers[other] if other in carriers else markers[other].body
        is_apart = where.startswith("connections.") and case.connections[where.partition(".")[2]].is_by_law
        if other not in carriers and not is_apart and math.dist(markers[other].point, found[where].point) > _SAME:
            at = ", ".join(show(x, "length", 6) for x in found[where].point)
            ledger.problem(f"{where}.{option}", f'"{other}" is elsewhere: both ends must be at {at}')
        if option == "outer" and (body == SHAFT or isinstance(body, BearingPart)):
            ledger.problem(
                f"{where}.outer", f'the outer ring sits in the ground or in one of [bodies], not on "{other}"'
            )
        elif body == found[where].body:
            ledger.problem(f"{where}.{option}", "both ends are on the same body")


def _axes(marker: Marker) -> FloatArray:
    """Return the axes of a marker as columns.

    Turned about x, then about y and z as they were.
    """
    found: FloatArray = np.eye(3)
    for angle, (i, k) in ((marker.about_x, (1, 2)), (marker.about_y, (2, 0)), (marker.about_z, (0, 1))):
        turn = np.eye(3)
        turn[i, i] = turn[k, k] = math.cos(angle)
        turn[k, i], turn[i, k] = math.sin(angle), -math.sin(angle)
        found = turn @ found
    return found
