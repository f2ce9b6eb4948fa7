"""Write the case of one bearing as a machine."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from lambda_core.case.case import Case
from lambda_core.case.machine import OWN, PARTS, SHARED
from lambda_core.case.motion import RingBody
from lambda_core.domain.elements import ALONE
from lambda_core.domain.units import show

_PLACE = "0 mm"  # of the bearing: places count from its middle
_FREEDOMS = ("x", "y", "z", "tilt_y", "tilt_z")
_LOADS = {  # on the inner ring, and as loads at a place
    "radial": "radial",
    "radial_direction": "radial_direction",
    "axial": "force_x",
    "moment_y": "moment_y",
    "moment_z": "moment_z",
}
_OF_A_RING = tuple(RingBody.model_fields)
_INSULATION = ("insulation", "insulation_resistance", "shunt")  # of the circuit's grounding: each bearing has its own
# of the thermal network: those of the bearing
_OWN_NODES = ("inner_ring", "outer_ring", "balls", "oil", "cage", "shaft")
_SUPPLY = "oil_supply"


@dataclass(frozen=True)
class LongForm:
    """The case of one bearing as that of a machine.

    Attributes
    ----------
    tables : dict
        Plain tables of the machine.
    differences : tuple of str
        What the machine does not have, or has otherwise, with the path in the case of one bearing.
    """

    tables: dict[str, Any]
    differences: tuple[str, ...]


def expand(
    case: Case,
    *,
    bar: tuple[float, float] = (0.0, 0.0),
    held: Collection[str] = (),
    takes: Literal["+x", "-x"] | None = None,
    play: float = 0.0,
) -> LongForm:
    """Write the case of one bearing as a machine.

    The bearing is on a rigid shaft, its outer ring in the ground.

    The bearing, its oil, laws, cage and elastic parts, the loads on its inner ring and the supports of both rings are
    the same. What holds the inner ring holds the shaft where the bearing is; the shaft has no sections, so that it is
    rigid and has the mass that the case gives it, on top of which the machine counts that of the ring.

    Parameters
    ----------
    case : Case
        Of one bearing.
    bar : (float, float)
        Polar and transverse inertia of the shaft's mass where the case does not give them [kg m2].
    held : collection of str
        Directions in which the inner ring is locked though the case does not say so.
    takes : "+x" or "-x", optional
        Axial force on the shaft that an angular contact bearing takes.
    play : float
        Its axial play on that side [m]: a machine draws it without, the case of one bearing with both rings in the
        middle.

    Returns
    -------
    LongForm
    """
    written = case.written()
    differences: list[str] = []
    bearing = {**written["bearing"], "at": _PLACE, **{table: written[table] for table in OWN if table in written}}
    bearing |= {"takes": takes} if takes else {}
    bearing |= {"preload": show(-play, "small_length")} if play else {}
    bodies = written.get("bodies", {})
    outer, inner = bodies.get("outer_ring", {}), bodies.get("inner_ring", {})
    support = {dof: outer[dof] for dof in _FREEDOMS if dof in outer}
    parts = {
        "inner_ring": {key: inner[key] for key in _OF_A_RING if key in inner},
        "outer_ring": {key: outer[key] for key in (*_OF_A_RING, "spin") if key in outer},
        "cage": bodies.get("cage", {}),
        "support": support,
    }
    bearing |= {name: part for name, part in parts.items() if part}
    tables: dict[str, Any] = {key: written[key] for key in ("name", "description", "assumptions") if key in written}
    tables |= {
        "operation": _operation(written["operation"], inner.get("spin")),
        "bearings": {ALONE: bearing},
        **{table: written[table] for table in SHARED if table in written},
    }
    loads = _loads(written.get("loads", {}))
    tables |= {"loads": loads} if loads else {}
    support = dict.fromkeys(held, "locked") | {dof: inner[dof] for dof in _FREEDOMS if dof in inner}
    support |= _resistance(inner.get("spin"))
    tables |= {"shaft": {"support": {"at": ALONE, **support}}} if support else {}
    markers = _markers(written.get("markers", {}))
    connections = _connections(written.get("elements", {}), markers)
    tables |= {"connections": connections} if connections else {}
    tables |= _disc(inner, bar)
    tables |= {"electric": _electric(written["electric"], differences)} if "electric" in written else {}
    tables |= _thermal(written.get("thermal", {}), bearing)
    tables |= {"fit": written["fit"]} if "fit" in written else {}
    tables |= {"markers": markers} if markers else {}
    return LongForm(tables, tuple(differences))


def _electric(written: Mapping[str, Any], differences: list[str]) -> dict[str, Any]:
    """Return the circuit with insulation in each bearing."""
    found, grounding = dict(written), dict(written.get("grounding", {}))
    if "other_bearings" not in written.get("machine", {}):
        differences.append("electric.machine.other_bearings: absent, where the circuit has one more bearing like this")
    own = {key: grounding.pop(key) for key in _INSULATION if key in grounding}
    found.pop("grounding", None)
    found |= {"grounding": grounding} if grounding else {}
    return found | ({"bearings": {ALONE: own}} if own else {})


def _thermal(written: Mapping[str, Any], bearing: dict[str, Any]) -> dict[str, Any]:
    """Return the thermal network for a machine.

    The nodes of the bearing are in the bearing's own table.
    """
    found = dict(written)
    nodes = found.pop("nodes", {})
    own = {name: node for name, node in nodes.items() if name in _OWN_NODES}
    if own:
        bearing["thermal"] = {"nodes": own}
    if further := {name: node for name, node in nodes.items() if name not in _OWN_NODES}:
        found["nodes"] = further
    if "links" in found:
        found["links"] = {
            key: {**link, "between": [_node(name) for name in link["between"]]} for key, link in found["links"].items()
        }
    return {"thermal": found} if found else {}


def _node(name: str) -> str:
    """Return the machine's name of a thermal node."""
    return f"{ALONE}.{name}" if name in (*_OWN_NODES, _SUPPLY) else name


def _resistance(spin: Any) -> dict[str, Any]:
    """Return the resistance to the shaft's rotation.

    It is the resistance to the inner ring's rotation in the case.
    """
    return {"spin": {"damping": spin["damping"]}} if isinstance(spin, Mapping) and "damping" in spin else {}


def _operation(written: Mapping[str, Any], spin: Any) -> dict[str, Any]:
    """Return the drive of the shaft.

    It is a speed, or a torque where the inner ring turns freely.
    """
    mode = spin.get("mode", "free") if isinstance(spin, Mapping) else spin
    torque = {"torque": written.get("torque", "0 N m")} if mode == "free" else {}
    return {key: written[key] for key in ("speed", "temperatures") if key in written} | torque


def _loads(written: Mapping[str, Any]) -> dict[str, Any]:
    """Return the loads on rings and cage."""
    loads: dict[str, Any] = {}
    own = {new: written[old] for old, new in _LOADS.items() if old in written}
    if own:
        loads["inner-ring"] = {"at": ALONE, **own}
    if "inner_ring" in written:
        loads["further"] = {"at": ALONE, **written["inner_ring"]}
    for part in PARTS:
        if part in written:
            loads[part] = {"at": f"{ALONE}.{part}", **written[part]}
    return loads


def _body(name: str) -> str:
    """Return the machine's body of a bearing's place."""
    return f"{ALONE}.{name}" if name in PARTS else "ground" if name == "ground" else "shaft"


def _connections(written: Mapping[str, Any], markers: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """Return the force elements between bodies and the ground.

    A body that is no marker stands for its centre. Where the other end is a marker, the machine needs one there, too.
    """
    found = {}
    for name, element in written.items():
        first, second = element.get("first", "ground"), element["second"]
        at = second if second in markers else ALONE if _body(second) == "shaft" else _body(second)
        to = first if first in markers else _body(first)
        if second in markers and first not in markers:
            centre = {"x": _PLACE, **({} if to == "shaft" else {"body": to})}
            to = f"{name}-first"
            markers[to] = centre
        found[name] = {"at": at, "to": to, **{key: element[key] for key in ("law", "parameters") if key in element}}
    return found


def _disc(written: Mapping[str, Any], bar: tuple[float, float]) -> dict[str, Any]:
    """Return the shaft's mass as a disc at the bearing."""
    if "shaft_mass" not in written:
        return {}
    polar, transverse = (show(inertia, "inertia") for inertia in bar)
    disc = {
        "at": ALONE,
        "mass": written["shaft_mass"],
        "polar_inertia": written.get("shaft_polar_inertia", polar),
        "transverse_inertia": written.get("shaft_transverse_inertia", transverse),
    }
    return {"discs": {"shaft": disc}}


def _markers(written: Mapping[str, Any]) -> dict[str, Any]:
    """Return the markers of rings and cage."""
    found = {}
    for name, marker in written.items():
        body = _body(marker.get("body", "shaft"))
        found[name] = {"x": _PLACE, **{axis: marker[axis] for axis in ("x", "y", "z") if axis in marker}}
        found[name] |= {} if body == "shaft" else {"body": body}
    return found
