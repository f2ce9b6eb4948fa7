"""Declare the case of a machine: a shaft in bearings."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import partial
from typing import Any, ClassVar, Literal

from pydantic import ValidationInfo, field_validator, model_validator

from lambda_core.case.elastic import Elastic
from lambda_core.case.electric import MachineElectric
from lambda_core.case.fitted import FitOrigin, fit_of_part
from lambda_core.case.holding import SeatTilt, SeatTranslation
from lambda_core.case.machine_parts import (
    Connection,
    Gear,
    MachineBody,
    Placed,
    PointLoad,
    ShaftDisc,
    ShaftSupport,
    length_in,
)
from lambda_core.case.modelling import Depth, Forces, Models, Output, Parameters, Solver
from lambda_core.case.motion import CageBody, Gravity, Marker, RingBody, TurningRing
from lambda_core.case.option import Section, option
from lambda_core.case.pairs import Pairs, rising
from lambda_core.case.parts import Bearing, Lubricant, MaterialChoice, Materials, OwnLubricant, Surface
from lambda_core.case.requirements import Life, Requirements
from lambda_core.case.salvage import SHARED_STAND_INS, StandIns
from lambda_core.case.signals import MomentSignal, SpeedSignal
from lambda_core.case.thermal import BearingThermal, MachineThermal
from lambda_core.case.written import Written
from lambda_core.domain.elements import POSE
from lambda_core.domain.errors import Problem
from lambda_core.domain.units import Force, Length, SmallLength, Temperature

# tables of the case of every bearing
SHARED = (
    "lubricant",
    "materials",
    "surface",
    "depth",
    "models",
    "parameters",
    "gravity",
    "solver",
    "output",
    "observers",
    "events",
    "life",
    "requirements",
)
OWN = ("elastic", "forces")  # tables of one of them
REPLACED = ("materials", "surface", "depth", "models", "parameters")  # tables whose entries each may have of its own
_AROUND = (  # options of [thermal] that each bearing has as it stands there
    "conductances",
    "ambient",
    "start",
    "inlet",
    "limit",
    "air_speed",
    "emissivity",
    "seat_conductance",
    "oil_volume",
    "oil_flow",
    "oil_supply",
)
# of a bearing that carry loads, markers and connections: "left.cage"
PARTS: tuple[Literal["outer_ring"], Literal["cage"]] = ("outer_ring", "cage")
NAMED = ("bearings", "markers", "bodies", "discs", "loads", "gears", "connections")  # tables of named parts
# Names that are taken already
TAKEN = {"bearings": ("shaft",), "markers": ("shaft", "ground"), "bodies": ("shaft", "ground")}

# A dot would separate the steps of a path: bearings.left.clearance
_PART_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*")
STAND_IN = "stand-in"  # a bearing where no other is left
_PIECES = [{"length": "1 m", "diameter": "40 mm"}]


class ShaftSection(Section):
    """Piece of the shaft of one diameter.

    Pieces follow each other along +x.
    """

    length: Length = option(description="length along the axis", gt=0.0)
    diameter: Length = option(description="outside diameter", gt=0.0)
    bore: Length = option("0 mm", "bore of a hollow piece", ge=0.0)

    @model_validator(mode="after")
    def _has_a_wall(self) -> ShaftSection:
        if self.bore >= self.diameter:
            raise ValueError("the bore must be smaller than the diameter")
        return self


class Shaft(Section):
    """Shaft of pieces, or a reduced model.

    Each piece has one diameter; they start at the left end, x = 0. A reduced model is imported.

    Without either it is rigid and has no mass but that of its discs; so can be the shaft of a single bearing.
    """

    reduced: str | None = option(
        None,
        "in place of the pieces: file with mass, stiffness and nodes of a finite-element program's reduced model; "
        "every part on the shaft is at one of its nodes, by position or by the node's name as the marker",
        min_length=1,
    )
    sections: list[ShaftSection] = option(
        [], "pieces from left to right; without any the shaft of a single bearing is rigid, its mass that of its discs"
    )
    material: MaterialChoice = option("100Cr6", "catalogue name or a table of properties")
    temperature: Temperature = option("20 degC", "mean temperature, for its growth in length")
    temperatures: list[tuple[Length, Temperature]] = option(
        [],
        'in place of the mean temperature: pairs of place and temperature, [["0 mm", "60 degC"], ...]',
    )
    drive: Length | None = option(
        None,
        "where the coupling holds the shaft against turning, by the rest of the torque; absent: the left end",
    )
    twists: bool = option(
        False, "in motion: whether the shaft twists; otherwise torques go to the coupling without delay"
    )

    support: ShaftSupport = option({}, "what holds the shaft in addition to its bearings")

    @field_validator("temperatures")
    @classmethod
    def _rises(cls, pairs: list[tuple[float, float]]) -> list[tuple[float, float]]:
        rising(Pairs(tuple(pairs), '"temperatures"', "entry", range(1, len(pairs) + 1)), "places")
        return pairs

    @field_validator("sections")
    @classmethod
    def _is_from_one_source(cls, sections: list[ShaftSection], info: ValidationInfo) -> list[ShaftSection]:
        if sections and info.data.get("reduced") is not None:
            raise ValueError("give either `sections` or `reduced`, not both")
        return sections

    @property
    def is_rigid(self) -> bool:
        """True for a rigid shaft on one bearing."""
        return not self.sections and self.reduced is None

    @model_validator(mode="after")
    def _has_one_temperature(self) -> Shaft:
        if self.temperatures and "temperature" in self.model_fields_set:
            raise ValueError("give either `temperature` or `temperatures`, not both")
        return self


class Housing(Section):
    """Housing of the outer rings.

    It has a thermal growth in length, and an elastic model if one is given.
    """

    material: MaterialChoice = option("100Cr6", "catalogue name or a table of properties")
    temperature: Temperature = option("20 degC", "mean temperature")
    reduced: str | None = option(
        None,
        "file with stiffness, mass and nodes of an elastic housing that is held somewhere (a finite-element program's, "
        "reduced to the bearing seats); it holds the outer rings where their support is locked",
        min_length=1,
    )


class Support(Section):
    """Support of an outer ring in the housing.

    Each degree of freedom is locked, free, held by a spring, or moved.
    """

    INSTEAD: ClassVar[Mapping[str, str]] = {
        f"{old}_{dof}": f"write {dof} = {{ {new} }}"
        for old, new in (("damping", "stiffness = ..., damping = ..."), ("motion", "motion = ..."))
        for dof in POSE
    }

    x: SeatTranslation = option("locked", 'axial: "locked", "free" (floating), a stiffness ("200 N/um") or a motion')
    y: SeatTranslation = option("locked", "horizontal, in the same way")
    z: SeatTranslation = option("locked", "vertical, in the same way")
    tilt_y: SeatTilt = option("locked", 'rotation about y, in the same way; a stiffness is "50 N m/mrad"')
    tilt_z: SeatTilt = option("locked", "rotation about z, in the same way")


class MachineBearing(Bearing, Placed):
    """Bearing on the shaft and its mounting.

    The bearing is described as in the case of one bearing.
    """

    INSTEAD: ClassVar[Mapping[str, str]] = {
        **Bearing.INSTEAD,
        **Placed.INSTEAD,
        **{f"hold_{dof}": f'write support.{dof} = "locked", "free" or a stiffness' for dof in POSE},
        **{f"motion_{dof}": f"write support.{dof} = {{ motion = ... }}" for dof in POSE},
    }

    outer: str = option(
        "ground", "what carries its outer ring: ground, one of [bodies], or a marker there", min_length=1
    )
    takes: Literal["+x", "-x"] | None = option(
        None,
        "axial force on the shaft that it can take: needed for angular contact, cones, NJ and a preload; +x left "
        "and -x right is an O arrangement, the other way round X, both alike tandem",
    )
    preload: SmallLength | None = option(
        None, "axial displacement of the outer ring against the inner one from where the play is just taken up"
    )
    preload_force: Force | None = option(None, "force of a spring on the outer ring, which slides in its seat", gt=0.0)
    support: Support = option({}, "how the housing holds the outer ring")
    lubricant: OwnLubricant | None = option(None, "its own oil, or its temperature or amount")
    thermal: BearingThermal = option({}, "what differs from [thermal] in this bearing")
    inner_ring: RingBody = option({}, "mass of the inner ring, which turns with the shaft")
    outer_ring: TurningRing = option({}, "mass and rotation of the outer ring")
    cage: CageBody = option({}, "cage, as bodies.cage in the case of one bearing")
    elastic: Elastic = option({}, "parts of the bearing that bend, as elastic in the case of one bearing")
    forces: Forces = option({}, "models of its own by force element, as forces in the case of one bearing: a defect")
    materials: Materials = option({}, "what differs from [materials] in this bearing")
    surface: Surface = option({}, "what differs from [surface]")
    depth: Depth = option({}, "what differs from [depth]: the cage; all bearings have the same cells")
    models: Models = option({}, "what differs from [models]")
    parameters: Parameters = option({}, "what differs from [parameters], role by role")

    @model_validator(mode="after")
    def _sits(self) -> MachineBearing:
        preloaded = self.preload is not None or self.preload_force is not None
        if preloaded and self.takes is None:
            raise ValueError('a preload needs takes = "+x" or "-x": the way in which the shaft pushes the bearing')
        if self.preload is not None and self.preload_force is not None:
            raise ValueError("give either `preload` (rigid) or `preload_force` (spring), not both")
        if self.preload_force is not None and "x" in self.support.model_fields_set and self.support.x.mode == "locked":
            raise ValueError('preload_force needs an outer ring that slides: support.x = "free" or a stiffness')
        return self


class MachineOperation(Section):
    """Drive of the shaft."""

    speed: SpeedSignal = option(
        description="speed of the shaft over time (initial speed where a torque drives it); the equilibrium is that of "
        "t = 0"
    )
    torque: MomentSignal | None = option(
        None, "in motion: torque of the coupling on the shaft, in place of its speed; the shaft then twists"
    )
    temperatures: Literal["given", "computed"] = option(
        "given", 'of oil, bearings, shaft and housing: given in the case, or "computed" by [thermal] for t = 0'
    )


class MachineCase(Written):
    """Case file of a machine.

    Values are in SI, written as unit strings.
    """

    INSTEAD: ClassVar[Mapping[str, str]] = {
        **dict.fromkeys(("springs", "elements"), "write [connections.NAME]"),
    }
    STAND_INS: ClassVar[StandIns] = {
        **SHARED_STAND_INS,
        ("shaft",): {"sections": _PIECES},
        ("shaft", "sections"): _PIECES,
        ("bearings",): {STAND_IN: {"at": "0 mm"}},
    }

    shaft: Shaft = option({}, "the shaft")
    bearings: dict[str, MachineBearing] = option(description="its bearings, by name", min_length=1)
    markers: dict[str, Marker] = option({}, "named places on the shaft, on bodies and on the ground, by name")
    bodies: dict[str, MachineBody] = option({}, "other rigid bodies, such as flexibly mounted housings, by name")
    discs: dict[str, ShaftDisc] = option({}, "rigid bodies on the shaft, by name")
    loads: dict[str, PointLoad] = option({}, "forces and moments on the shaft and on bodies, by name")
    gears: dict[str, Gear] = option({}, "gears on the shaft, by name")
    connections: dict[str, Connection] = option(
        {}, "springs, dampers and laws of forces between shaft, bodies and ground, by name"
    )
    housing: Housing = option({}, "the housing")
    operation: MachineOperation = option(description="what turns the shaft")
    lubricant: Lubricant = option(description="the oil")
    materials: Materials = option({}, "materials of the bearings' parts")
    surface: Surface = option({}, "surfaces")
    gravity: Gravity = option({}, "acceleration of gravity")
    thermal: MachineThermal = option({}, "thermal network of shaft, housing and all bearings")
    life: Life = option({}, "what modified rating lives need")
    requirements: Requirements = option({}, "what every bearing has to reach")
    depth: Depth = option({}, "modelling depth, of every bearing")
    models: Models = option({}, "model by role, for every bearing")
    parameters: Parameters = option({}, "parameters by role, for every bearing")
    electric: MachineElectric | None = option(
        None, "the electric circuit of shaft and frame with all bearings; absent: not computed"
    )
    solver: Solver = option({}, "integrator and averages, in motion")
    output: Output = option({}, "what is written, in motion")
    observers: Parameters = option({}, "channels that plugins add to every bearing: a table per observer")
    events: Parameters = option({}, "what plugins look out for in every bearing: a table per event")
    fit: FitOrigin | None = option(None, "where fitted values come from; written by the command fit")

    @classmethod
    def own_problems(cls, data: Mapping[str, Any]) -> list[Problem]:
        """Return problems of names and of the shaft's shape.

        Each problem of the plain tables has its own path.
        """
        found = _shape_problems(data)
        for table in NAMED:
            parts = data.get(table)
            for name in parts if isinstance(parts, Mapping) else ():
                if not _PART_NAME.fullmatch(str(name)):
                    told = "use letters, digits, dash and underscore in names, the first a letter or digit"
                    found.append(Problem(f"{table}.{name}", told))
                elif table == "markers" and length_in(str(name)) is not None:
                    found.append(Problem(f"{table}.{name}", "looks like a length: choose another name"))
                elif name in TAKEN.get(table, ()):
                    found.append(Problem(f"{table}.{name}", f'"{name}" exists already: choose another name'))
        return found


def _shape_problems(data: Mapping[str, Any]) -> list[Problem]:
    """Report several bearings on a shaft without shape."""
    bearings, shaft = data.get("bearings"), data.get("shaft", {})
    if not isinstance(bearings, Mapping) or len(bearings) < 2 or not isinstance(shaft, Mapping):
        return []
    if shaft.get("sections") or shaft.get("reduced") is not None:
        return []
    told = "must have at least one entry, or give the file `reduced`: only the shaft of a single bearing can be rigid"
    return [Problem("shaft.sections", told)]


def bearing_tables(tables: Mapping[str, Any], name: str) -> dict[str, Any]:
    """Return the case tables of one bearing alone.

    They are plain tables, as valid as those of the machine.
    """
    given = tables["bearings"][name]
    operation = tables.get("operation")
    speed = operation.get("speed") if isinstance(operation, Mapping) else None
    # the shaft decides how the inner ring tilts: nothing is to be assumed of a ring that stands alone
    bodies: dict[str, Any] = {name: given[name] for name in ("outer_ring", "cage") if name in given}
    inner = given.get("inner_ring", {})
    bodies["inner_ring"] = {"tilt_y": "locked", "tilt_z": "locked", **(inner if isinstance(inner, Mapping) else {})}
    found = {
        "name": name,
        "bearing": {key: value for key, value in given.items() if key in Bearing.model_fields},
        "operation": {} if speed is None else {"speed": speed},
        "bodies": bodies,
        **{table: given[table] for table in OWN if table in given},
        **{table: tables[table] for table in SHARED if table in tables},
    }
    for table in (name for name in REPLACED if isinstance(given.get(name), Mapping)):
        shared = tables.get(table, {})
        found[table] = {**(shared if isinstance(shared, Mapping) else {}), **given[table]}
    thermal = _own_thermal(tables, given)
    found |= _own_oil(tables, given) | ({"thermal": thermal} if thermal else {})
    return found | fit_of_part(tables.get("fit"), partial(_place_in_bearing, tables, name))


def _own_oil(tables: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the table of a bearing's own oil.

    It exists where the bearing has options of its own; another oil has its own properties.
    """
    shared, own = tables.get("lubricant", {}), given.get("lubricant")
    if not isinstance(shared, Mapping) or not isinstance(own, Mapping):
        return {}
    is_other = "name" in own or "properties" in own
    kept = {key: value for key, value in shared.items() if not (is_other and key in ("name", "properties"))}
    return {"lubricant": {**kept, **own}}


def _own_thermal(tables: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the thermal network of a bearing.

    It has its surroundings, and its own oil and nodes; no housing, no shaft.
    """
    shared, own = ({} if not isinstance(one, Mapping) else one for one in (tables.get("thermal"), given.get("thermal")))
    found = {key: value for key, value in shared.items() if key in _AROUND} | dict(own)
    if "oil_flow" not in found:
        found.pop("oil_supply", None)
    if found.get("conductances") == "none" and "links" not in own:
        found.pop("conductances")  # the links of the machine lead where a bearing alone has nothing
    return found


def place_in_machine(tables: Mapping[str, Any], name: str, where: str) -> str:
    """Return the place of a bearing's option in the machine.

    `where` is the option's place in the tables of one bearing.
    """
    own, (first, *rest) = tables["bearings"][name], where.split(".")
    if first == "bearing":
        return ".".join(("bearings", name, *rest))
    if first == "bodies" and rest and rest[0] in own:
        return ".".join(("bearings", name, *where.split(".")[1:]))
    table = own.get(first) if first in (*REPLACED, "lubricant", "thermal") else None
    is_replaced = isinstance(table, Mapping) and (not rest or rest[0] in table)
    return f"bearings.{name}.{where}" if first in OWN or is_replaced else where


def _place_in_bearing(tables: Mapping[str, Any], name: str, path: str) -> str:
    """Return the place of a machine's option in a bearing.

    `path` is the option's place in the machine; empty where the bearing does not have it.

    What bearings have of their own takes the place of what they share.
    """
    own = path.removeprefix(f"bearings.{name}.")
    first = own.split(".")[0]
    if own == path:
        return path if first in SHARED and place_in_machine(tables, name, path) == path else ""
    if first in Bearing.model_fields:
        return f"bearing.{own}"
    return own if first in (*OWN, *REPLACED, "lubricant") else ""
