"""Declare the sections bearing, materials, lubricant and surface."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Discriminator, Tag, field_validator, model_validator

from lambda_core.case.option import Section, option
from lambda_core.case.rollers import InlineRollers
from lambda_core.domain.errors import unknown_name
from lambda_core.domain.lubrication import Lubrication
from lambda_core.domain.units import (
    Angle,
    Density,
    Force,
    KinematicViscosity,
    Length,
    Modulus,
    SmallLength,
    SpecificHeat,
    Temperature,
    ThermalConductivity,
    ThermalExpansion,
    parse,
)
from lambda_core.elements.ball.kinds import kinds

_LONGEST_NAME = 200  # characters: names are compared with all of the catalogue
_LIGHTEST = 1.0  # [kg/m3] of a solid or an oil: foams are heavier, and the program divides by it
_STEEPEST = math.pi / 4.0  # contact angles of radial bearings end at 45 degrees (ISO 281) [rad]

CLEARANCE_CLASSES = ("C2", "CN", "C3", "C4", "C5")
# Behind a class: its lower half, its upper half, its middle, or its upper half with the lower half of the next class.
CLEARANCE_PARTS = "LHMP"


class InlineGeometry(Section):
    """Inner geometry written in the case.

    With a designation it replaces single catalogue values.
    """

    ball_count: int | None = option(None, "number of balls, of one row", ge=3, le=60)
    ball_diameter: Length | None = option(None, "ball diameter D_w", gt=0.0)
    pitch_diameter: Length | None = option(None, "pitch diameter d_m", gt=0.0)
    groove_radius_inner: Length | None = option(None, "radius of the inner groove r_i", gt=0.0)
    groove_radius_outer: Length | None = option(None, "radius of the outer groove r_o", gt=0.0)
    conformity_inner: float | None = option(None, "r_i / D_w, in place of the groove radius", gt=0.5, le=0.7)
    conformity_outer: float | None = option(None, "r_o / D_w, in place of the groove radius", gt=0.5, le=0.7)
    race_diameter_inner: Length | None = option(None, "inner raceway diameter at the groove's bottom", gt=0.0)
    race_diameter_outer: Length | None = option(None, "outer raceway diameter at the groove's bottom", gt=0.0)
    shoulder_diameter_inner: Length | None = option(None, "diameter of the inner ring's shoulders", gt=0.0)
    shoulder_diameter_outer: Length | None = option(None, "diameter of the outer ring's shoulders", gt=0.0)
    bore_diameter: Length | None = option(None, "bore d", gt=0.0)
    outside_diameter: Length | None = option(None, "outside diameter D", gt=0.0)
    width: Length | None = option(None, "width B", gt=0.0)
    shim_angle: Angle | None = option(
        None,
        "four-point contact: contact angle of a ball that rests on both arcs of a ring, by the shims they are ground "
        "with; absent: what contact angle and clearance leave, where the catalogue's bearing is of this kind",
        gt=0.0,
        lt=_STEEPEST,
        reference="Harris and Kotzalas 2006, ch. 2",
    )
    series: (
        Literal[
            "60", "62", "63", "64", "618", "619", "70", "72", "73", "32", "33", "QJ2", "QJ3", "12", "13", "22", "23"
        ]
        | None
    ) = option(None, "dimension series")
    rows: Literal[1, 2] | None = option(None, "rows of balls; two of angular contact make a double row bearing")
    row_distance: Length | None = option(
        None,
        "distance of the planes of the balls of two rows; of a self-aligning bearing it follows from the contact angle",
        gt=0.0,
    )
    arrangement: Literal["O", "X", "spherical"] | str | None = option(
        None,
        "of two rows: O back to back, X face to face, spherical on one sphere of the outer ring (self-aligning); "
        "absent: O",
    )
    dynamic_rating: Force | None = option(None, "basic dynamic load rating C", gt=0.0)
    static_rating: Force | None = option(None, "basic static load rating C0", gt=0.0)

    @field_validator("arrangement")
    @classmethod
    def _of_a_kind(cls, text: str | None) -> str | None:
        known = [name for kind in kinds().values() for name in kind.arrangements]
        if text is not None and text not in known:
            raise ValueError(unknown_name("arrangement", text, known))
        return text


class Fits(Section):
    """Seats of the rings; an interference fit takes clearance away."""

    shaft: str | None = option(None, 'ISO 286 tolerance of the shaft ("k5") or a diametral interference ("12 um")')
    housing: str | None = option(None, 'ISO 286 tolerance of the housing ("H7") or a diametral interference ("0 um")')
    shaft_bore: Length = option("0 mm", "bore of a hollow shaft", ge=0.0)
    housing_outside_diameter: Length | None = option(
        None, "outside diameter of the housing; absent: endless steel around it", gt=0.0
    )

    @field_validator("shaft", "housing")
    @classmethod
    def _tolerance_or_value(cls, text: str | None) -> str | None:
        if text is None or re.fullmatch(r"[A-Za-z]{1,2}\d{1,2}", text.strip()):
            return text.strip() if text else text
        parse(text, "small_length")
        return text


class PartTemperatures(Section):
    """Temperatures in operation, for thermal expansion.

    Absent parts have the oil's temperature.
    """

    reference: Temperature = option("20 degC", "temperature at which clearance and diameters were measured")
    inner_ring: Temperature | None = option(None, "inner ring")
    outer_ring: Temperature | None = option(None, "outer ring")
    balls: Temperature | None = option(None, "balls or rollers")
    shaft: Temperature | None = option(None, "shaft; absent: as the inner ring")
    housing: Temperature | None = option(None, "housing; absent: as the outer ring")


class Bearing(Section):
    """Bearing and its clearance."""

    INSTEAD: ClassVar[Mapping[str, str]] = dict.fromkeys(
        ("kind", "type"),
        'the designation decides it ("7208B", "NU 208"), or [bearing.geometry] with contact_angle, rows and '
        "arrangement of balls, or [bearing.rollers] with kind",
    )

    designation: str | None = option(
        None,
        'catalogue designation, as "6208" or "7208B"; suffixes ("6208-2RS1/C3") decide what the case leaves open',
        min_length=1,
        max_length=_LONGEST_NAME,
    )
    maker: str | None = option(
        None, "whose design, where several makers are in the catalogue", min_length=1, max_length=_LONGEST_NAME
    )
    geometry: InlineGeometry | None = option(None, "inner geometry written here")
    rollers: InlineRollers | None = option(None, "rollers in place of balls, written here")
    clearance: str | None = option(
        None,
        'radial internal clearance (diametral measure): a class ("CN"; "C3L", "C3H", "C3M", "C3P": lower half, upper '
        'half, middle, upper half and lower half of the next), a value ("14 um") or "geometry" (follows from the '
        "raceway diameters); absent: the suffix's, or CN",
        reference="ISO 5753-1 for the classes; of four-point contact ISO 5753-2, of the axial clearance",
    )
    axial_clearance: SmallLength | None = option(
        None,
        "axial internal clearance, free axial movement of the rings: of four-point contact, where it is absent that of "
        "the class; of two rows, below zero with preload, where it is absent that of the class of the catalogue's",
    )
    contact_angle: Angle | None = option(
        None,
        "free contact angle of an angular contact bearing, in place of a clearance: 2 A (1 - cos(alpha_0)) of the "
        "distance A of the groove centres; absent: the catalogue's, where the bearing is one of angular contact",
        gt=0.0,
        le=_STEEPEST,
        reference="Harris and Kotzalas 2006, eq. 2.9",
    )
    clearance_pick: Literal["minimum", "middle", "maximum"] = option("middle", "which value of a clearance class")
    fits: Fits | None = option(None, "seats of the rings; absent: the clearance is that of the mounted bearing")
    temperatures: PartTemperatures | None = option(
        None, "temperatures of the parts; absent: the clearance is that at operating temperature"
    )

    @model_validator(mode="after")
    def _one_of_both(self) -> Bearing:
        # rows on a sphere have both: the angle places the balls, the clearance the inner ring
        spherical = self.geometry is not None and self.geometry.arrangement == "spherical"
        if self.contact_angle is not None and self.clearance is not None and not spherical:
            raise ValueError("give either `clearance` or `contact_angle`, not both")
        if self.axial_clearance is not None and self.clearance is not None:
            raise ValueError("give either `clearance` or `axial_clearance`, not both")
        return self

    @field_validator("clearance")
    @classmethod
    def _class_or_value(cls, text: str | None) -> str | None:
        if text is None:
            return None
        folded = text.strip().upper()
        if folded in (*CLEARANCE_CLASSES, "C0"):
            return "CN" if folded == "C0" else folded
        if folded[:2] in CLEARANCE_CLASSES and len(folded) == 3 and folded[2] in CLEARANCE_PARTS:
            return folded
        if text.strip().casefold() == "geometry":
            return "geometry"
        if not re.search(r"\d", text) or re.fullmatch(r"\s*[Cc]\d+\s*", text):
            known = ", ".join(CLEARANCE_CLASSES)
            raise ValueError(f'"{text}" is not a clearance class; write {known}, a value like "14 um", or "geometry"')
        parse(text, "small_length")
        return text


class InlineMaterial(Section):
    """A material written in the case."""

    youngs_modulus: Modulus = option(description="Young's modulus E", gt=0.0)
    poisson_ratio: float = option(description="Poisson's ratio", ge=0.0, lt=0.5)
    density: Density = option(description="density", ge=_LIGHTEST)
    thermal_conductivity: ThermalConductivity = option(description="thermal conductivity", gt=0.0)
    specific_heat: SpecificHeat = option(description="specific heat capacity", gt=0.0)
    thermal_expansion: ThermalExpansion = option("0 1/K", "linear thermal expansion", ge=0.0)


def _name_or_table(value: Any) -> str:
    return "kind:table" if isinstance(value, dict | Section) else "kind:name"


MaterialChoice = Annotated[
    Annotated[str, Tag("kind:name")] | Annotated[InlineMaterial, Tag("kind:table")], Discriminator(_name_or_table)
]


class Materials(Section):
    """Material of each part.

    It is a catalogue name or a table of properties.
    """

    inner: MaterialChoice = option("100Cr6", "inner ring")
    outer: MaterialChoice = option("100Cr6", "outer ring")
    balls: MaterialChoice = option("100Cr6", 'balls or rollers; "Si3N4" makes a hybrid bearing')
    cage: MaterialChoice | None = option(None, "cage; absent: the material of the cage type")


class InlineLubricant(Section):
    """Oil written in the case.

    It has what every oil needs. Its laws take required parameters of the same name from here, others from
    parameters.<role>.
    """

    base_type: str = option("mineral", "kind of base oil", min_length=1)
    rheology: str = option(description="rheology model that the parameters are for", min_length=1)
    thermal_conductivity: ThermalConductivity = option(description="thermal conductivity", gt=0.0)
    specific_heat: SpecificHeat = option(description="specific heat capacity", gt=0.0)
    kinematic_viscosity_40: KinematicViscosity | None = option(None, "kinematic viscosity at 40 degC", gt=0.0)
    kinematic_viscosity_100: KinematicViscosity | None = option(None, "kinematic viscosity at 100 degC", gt=0.0)
    density_15: Density | None = option(None, "density at 15 degC", ge=_LIGHTEST)


class Lubricant(Section):
    """Oil or grease, and its amount."""

    name: str = option(
        description='catalogue name, for example "FVA3A"; with properties: any name',
        min_length=1,
        max_length=_LONGEST_NAME,
    )
    properties: InlineLubricant | None = option(None, "the oil's properties, in place of the catalogue's")
    temperature: Temperature = option(description="temperature of the oil bath and of the contact inlets")
    lubrication: Lubrication | None = option(
        None,
        'how the oil gets to the balls: "oil bath", "oil jet", "under-race" (through the inner ring), "oil-air" or '
        '"grease"; absent: grease for a grease, else oil bath. Without a bath balls run in a mixture of oil and air',
    )
    oil_level: Length = option(
        "0 mm",
        "height of the oil above the lowest point of the pitch circle; 0 is the centre of the lowest ball",
        reference="usual oil bath level at standstill; a grease has none",
    )
    starvation: float = option(
        1.0, "film over that of a flooded contact, rolling resistance falls with its inlet; 1: flooded", gt=0.0, le=1.0
    )


class OwnLubricant(Lubricant):
    """Oil of one bearing of a machine.

    Absent options are those of [lubricant].
    """

    name: str | None = option(None, "catalogue name; absent: that of [lubricant]", min_length=1)  # type: ignore[assignment]
    temperature: Temperature | None = option(  # type: ignore[assignment]
        None, "temperature of the oil bath and of the contact inlets; absent: that of [lubricant]"
    )


class Surface(Section):
    """Roughness of the rolling surfaces."""

    roughness: SmallLength = option(
        "0.16 um",
        "composite rms roughness sigma of ball and raceway",
        reference="raceways of Wingertszahn et al. 2023, Lubricants 11, 369 (0.10 and 0.16 um); ISO 281's kappa = "
        "Lambda^1.3 means 0.15 um in catalogue bearings",
        gt=0.0,
    )
