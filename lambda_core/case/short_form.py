"""Write the case of one bearing in the long form: as a machine with one bearing on a rigid shaft."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from lambda_core.case.case import Case
from lambda_core.case.machine import OWN, PARTS, SHARED
from lambda_core.case.motion import RingBody
from lambda_core.domain.units import show

NAME = "bearing"  # of the one bearing
# of a shaft that hardly bends, as light as a material may be
_RIGID = {
    "youngs_modulus": "210000 GPa",
    "poisson_ratio": 0.3,
    "density": "1 kg/m3",
    "thermal_expansion": "0 1/K",
    "thermal_conductivity": "45 W/(m K)",
    "specific_heat": "460 J/(kg K)",
}
_FREEDOMS = ("x", "y", "z", "tilt_y", "tilt_z")
_LOADS = {  # on the inner ring, and as loads at a place
    "radial": "radial",
    "radial_direction": "radial_direction",
    "axial": "force_x",
    "moment_y": "moment_y",
    "moment_z": "moment_z",
}
_OF_A_RING = tuple(RingBody.model_fields)
_NO_PLACE = {
    "thermal": "the network of temperatures",
    "electric": "the circuit",
    "operation.temperatures": "temperatures computed by the network of one bearing",
}


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


def expand(case: Case, *, bore: float, width: float, takes: Literal["+x", "-x"] | None = None) -> LongForm:
    """Write the case of one bearing as a machine: the bearing on a rigid shaft, its outer ring in the ground.

    The bearing, its oil, laws, cage and elastic parts, the loads on its inner ring and the supports of both rings are
    the same. What holds the inner ring holds the shaft where the bearing is; the shaft has the mass that the case gives
    it, on top of which the machine counts that of the ring.

    Parameters
    ----------
    case : Case
        Of one bearing.
    bore, width : float
        Of the bearing [m]: the shaft's diameter and length.
    takes : "+x" or "-x", optional
        Axial force on the shaft that an angular contact bearing takes.

    Returns
    -------
    LongForm
    """
    written = case.written()
    middle = show(0.5 * width, "length", 9)
    differences = [f"{path}: {words}" for path, words in _NO_PLACE.items() if _at(written, path) is not None]
    bearing = {**written["bearing"], "at": middle, **{table: written[table] for table in OWN if table in written}}
    bearing |= {"takes": takes} if takes else {}
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
        "operation": _operation(written["operation"], bodies.get("inner_ring", {}).get("spin"), differences),
        "shaft": {
            "material": _RIGID,
            "sections": [{"length": show(width, "length", 9), "diameter": show(bore, "length", 9)}],
        },
        "bearings": {NAME: bearing},
        **{table: written[table] for table in SHARED if table in written},
    }
    loads = _loads(written.get("loads", {}))
    tables |= {"loads": loads} if loads else {}
    support = {dof: inner[dof] for dof in _FREEDOMS if dof in inner}
    tables["shaft"] |= {"support": {"at": NAME, **support}} if support else {}
    connections = _connections(written.get("elements", {}), case, differences)
    tables |= {"connections": connections} if connections else {}
    tables |= _disc(inner, middle)
    tables |= {"fit": written["fit"]} if "fit" in written else {}
    markers = _markers(written.get("markers", {}), width, case)
    tables |= {"markers": markers} if markers else {}
    return LongForm(tables, tuple(differences))


def _at(tables: Mapping[str, Any], path: str) -> Any:
    """Return what is written at a dotted path; None where nothing is."""
    found: Any = tables
    for key in path.split("."):
        found = found.get(key) if isinstance(found, Mapping) else None
    return found


def _operation(written: Mapping[str, Any], spin: Any, differences: list[str]) -> dict[str, Any]:
    """Return what turns the shaft: its speed, or where the inner ring turns freely a torque."""
    mode = spin.get("mode", "free") if isinstance(spin, Mapping) else spin
    if isinstance(spin, Mapping) and "damping" in spin:
        differences.append("bodies.inner_ring.spin.damping: a resistance to the rotation of the shaft")
    torque = {"torque": written.get("torque", "0 N m")} if mode == "free" else {}
    return {"speed": written["speed"], **torque}


def _loads(written: Mapping[str, Any]) -> dict[str, Any]:
    """Return the loads on rings and cage."""
    loads: dict[str, Any] = {}
    own = {new: written[old] for old, new in _LOADS.items() if old in written}
    if own:
        loads["inner-ring"] = {"at": NAME, **own}
    if "inner_ring" in written:
        loads["further"] = {"at": NAME, **written["inner_ring"]}
    for part in PARTS:
        if part in written:
            loads[part] = {"at": f"{NAME}.{part}", **written[part]}
    return loads


def _body(name: str) -> str:
    """Return what carries a place of the bearing in the machine."""
    return f"{NAME}.{name}" if name in PARTS else "ground" if name == "ground" else "shaft"


def _connections(written: Mapping[str, Any], case: Case, differences: list[str]) -> dict[str, Any]:
    """Return the force elements between bodies and the ground."""
    found = {}
    for name, element in written.items():
        first, second = element.get("first", "ground"), element["second"]
        if any(_turns_off_axis(case, end) for end in (first, second)):
            differences.append(f"elements.{name}: acts at a place that turns with the shaft off its axis")
            continue
        at = second if second in case.markers else NAME if _body(second) == "shaft" else _body(second)
        to = first if first in case.markers else _body(first)
        found[name] = {"at": at, "to": to, **{key: element[key] for key in ("law", "parameters") if key in element}}
    return found


def _turns_off_axis(case: Case, end: str) -> bool:
    """Tell whether an end is a marker on the shaft or the inner ring, off the axis."""
    marker = case.markers.get(end)
    return marker is not None and _body(marker.body) == "shaft" and bool(marker.y or marker.z)


def _disc(written: Mapping[str, Any], middle: str) -> dict[str, Any]:
    """Return the shaft's mass as a disc at the bearing."""
    if "shaft_mass" not in written:
        return {}
    disc = {"at": middle, "mass": written["shaft_mass"]}
    names = {"shaft_polar_inertia": "polar_inertia", "shaft_transverse_inertia": "transverse_inertia"}
    return {"discs": {"shaft": disc | {new: written[old] for old, new in names.items() if old in written}}}


def _markers(written: Mapping[str, Any], width: float, case: Case) -> dict[str, Any]:
    """Return the markers of rings and cage."""
    found = {}
    for name, marker in written.items():
        body = _body(marker.get("body", "shaft"))
        x = show(0.5 * width + case.markers[name].x, "length", 9)
        found[name] = {"x": x, **{axis: marker[axis] for axis in ("y", "z") if axis in marker}}
        found[name] |= {} if body == "shaft" else {"body": body}
    return found
