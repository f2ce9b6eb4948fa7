"""Declare markers, bodies, wheels, springs, loads and gears."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any, ClassVar, Literal, Self

from pydantic import PrivateAttr, field_validator, model_validator

from lambda_core.case.holding import Roll, RotationSpring, ShaftSpin, Tilt, Translation, TranslationSpring
from lambda_core.case.motion import Load, RadialLoad
from lambda_core.case.option import NAME_PATTERN, Section, option
from lambda_core.case.parts import MaterialChoice
from lambda_core.domain.units import (
    Angle,
    Inertia,
    Length,
    Mass,
    Moment,
    Power,
    Unbalance,
    parse,
)

_DOFS = ("x", "y", "z", "tilt_x", "tilt_y", "tilt_z")
BUSHING = "bushing"  # law of a connection that is springs and dampers
_AT = 'write at = "85 mm", a place along the shaft, or at = "NAME", a marker or a bearing'


class Placed(Section):
    """Part at a place of the shaft or a body."""

    INSTEAD: ClassVar[Mapping[str, str]] = {"position": _AT, "marker": _AT}

    at: str = option(
        description='where: a place along the shaft from its left end ("85 mm"), one of [markers], or a bearing; of '
        'loads and connections also "NAME.outer_ring" and "NAME.cage" of a bearing',
        quantity="length",
        min_length=1,
    )
    _place: float = PrivateAttr(default=0.0)

    @field_validator("at")
    @classmethod
    def _is_a_place(cls, at: str | None) -> str | None:
        if at is not None and not re.match(NAME_PATTERN, at):
            parse(at, "length")
        return at

    @property
    def along(self) -> float | None:
        """Place along the shaft [m].

        None where it is a name, or none is given.
        """
        return None if self.at is None else length_in(self.at)

    @property
    def place(self) -> float:
        """Along the shaft [m], once names have been looked up."""
        return self._place

    def placed(self, place: float) -> Self:
        """Return a copy whose name has been looked up."""
        found = self.model_copy()
        found._place = place
        return found


def length_in(text: str) -> float | None:
    """Return the length in a text [m].

    None where it is none.
    """
    try:
        return parse(text, "length")
    except ValueError:
        return None


class ShaftSupport(Placed):
    """Ground support of the shaft at one place.

    It has every degree of freedom; the rotation about x is only damped.
    """

    at: str | None = option(  # type: ignore[assignment]
        None,
        "where: a place along the shaft, one of [markers], or a bearing; absent: where the coupling is",
        quantity="length",
        min_length=1,
    )
    x: Translation = option("free", 'axial: "free", "locked", a stiffness ("200 N/um") or a motion')
    y: Translation = option("free", "horizontal, in the same way")
    z: Translation = option("free", "vertical, in the same way")
    tilt_y: Tilt = option("free", 'rotation about y, in the same way; a stiffness is "50 N m/mrad"')
    tilt_z: Tilt = option("free", "rotation about z, in the same way")
    spin: ShaftSpin = option("free", "rotation about x: { damping = ... } is a load that grows with the speed")

    @property
    def is_used(self) -> bool:
        """True if it holds or damps the shaft."""
        return bool(self.spin.damping) or any(
            dof.mode != "free" or dof.stiffness or dof.damping
            for dof in (self.x, self.y, self.z, self.tilt_y, self.tilt_z)
        )


class BodySupport(Section):
    """Ground support of a body's centre.

    It has every degree of freedom.
    """

    x: Translation = option("free", 'axial: "free", "locked", a stiffness ("200 N/um") or a motion')
    y: Translation = option("free", "horizontal, in the same way")
    z: Translation = option("free", "vertical, in the same way")
    tilt_x: Roll = option("free", 'rotation about x: "free", "locked" or a stiffness ("50 N m/mrad")')
    tilt_y: Tilt = option("free", "rotation about y, in the same way, or a motion")
    tilt_z: Tilt = option("free", "rotation about z, in the same way")


class MachineBody(Section):
    """Rigid body such as a housing.

    It has mass and inertia, or a shape, and the supports of its centre of mass.
    """

    INSTEAD: ClassVar[Mapping[str, str]] = {
        **{f"hold_{dof}": f'write support.{dof} = "locked", "free" or a stiffness' for dof in _DOFS},
        **{f"motion_{dof}": f"write support.{dof} = {{ motion = ... }}" for dof in _DOFS},
    }

    x: Length = option(description="centre of mass along the shaft, from the shaft's left end")
    y: Length = option("0 mm", "distance of the centre of mass from the shaft's axis, horizontal")
    z: Length = option("0 mm", "distance of the centre of mass from the shaft's axis, vertical")
    mass: Mass | None = option(None, "mass; absent: that of the shape", gt=0.0)
    polar_inertia: Inertia | None = option(None, "about x through the centre; absent: that of the shape", gt=0.0)
    transverse_inertia: Inertia | None = option(
        None, "about y and about z; absent: that of the shape (of a box the mean of both)", gt=0.0
    )
    length: Length | None = option(None, "of a shape, along x", gt=0.0)
    diameter: Length | None = option(None, "a cylinder's outside diameter", gt=0.0)
    bore: Length = option("0 mm", "a cylinder's bore", ge=0.0)
    width: Length | None = option(None, "a box's width along y", gt=0.0)
    height: Length | None = option(None, "a box's height along z", gt=0.0)
    material: MaterialChoice = option("100Cr6", "of a shape: catalogue name or a table of properties")
    support: BodySupport = option({}, "how the ground holds its centre")

    @model_validator(mode="after")
    def _has_a_mass(self) -> MachineBody:
        round_, box = self.diameter is not None, self.width is not None or self.height is not None
        if round_ and box:
            raise ValueError("give either `diameter` (cylinder) or `width` and `height` (box), not both")
        if (round_ or box) != (self.length is not None) or (self.width is None) != (self.height is None):
            raise ValueError("a shape needs length and diameter (cylinder), or length, width and height (box)")
        given = (self.mass, self.polar_inertia, self.transverse_inertia)
        if self.length is None and None in given:
            raise ValueError("give mass, polar_inertia and transverse_inertia, or a shape")
        if self.diameter is not None and self.bore >= self.diameter:
            raise ValueError("the bore must be smaller than the diameter")
        return self


class ShaftDisc(Placed):
    """Rigid wheel, rotor or coupling on the shaft.

    It has mass and inertia, or a shape.
    """

    mass: Mass | None = option(None, "mass; absent: that of the shape", gt=0.0)
    polar_inertia: Inertia | None = option(None, "about the axis; absent: 0, or that of the shape", ge=0.0)
    transverse_inertia: Inertia | None = option(
        None, "about a diameter; absent: half the polar one, or that of the shape", ge=0.0
    )
    diameter: Length | None = option(None, "in place of the mass: a cylinder of this outside diameter", gt=0.0)
    width: Length | None = option(None, "width of the cylinder", gt=0.0)
    bore: Length = option("0 mm", "bore of the cylinder", ge=0.0)
    material: MaterialChoice = option("100Cr6", "of the cylinder: catalogue name or a table of properties")
    unbalance: Unbalance = option("0 g mm", "mass times eccentricity; counts in motion", ge=0.0)
    unbalance_angle: Angle = option("0 deg", "azimuth of the unbalance at t = 0, from +y to +z")

    @model_validator(mode="after")
    def _has_a_mass(self) -> ShaftDisc:
        if (self.mass is None) == (self.diameter is None):
            raise ValueError("give either `mass` or `diameter` and `width` (cylinder)")
        if (self.diameter is None) != (self.width is None):
            raise ValueError("a cylinder needs diameter and width")
        if self.diameter is not None and self.bore >= self.diameter:
            raise ValueError("the bore must be smaller than the diameter")
        return self


class Connection(Placed):
    """Force element between a place and another body.

    The other body may be the ground; springs and dampers, or a law, give the force.

    With six stiffnesses it is a bushing, without force where it is drawn; its axes are those of its marker, and it acts
    at its place. A law acts between two places, on the one of `at`, along the axes of the case.
    """

    INSTEAD: ClassVar[Mapping[str, str]] = {
        **Placed.INSTEAD,
        **{f"damping_{dof}": f"write {dof} = {{ stiffness = ..., damping = ... }}" for dof in _DOFS},
    }

    law: str = option(BUSHING, "springs and dampers, or a law of the role force_element", min_length=1)
    to: str = option(
        "ground",
        'what it holds its place to: ground, shaft, one of [bodies], "NAME.outer_ring" or "NAME.cage" of a bearing, or '
        "a marker there",
        min_length=1,
    )
    x: TranslationSpring = option("free", 'along the shaft: a stiffness ("1 N/um"), or stiffness and damping')
    y: TranslationSpring = option("free", "horizontal, in the same way")
    z: TranslationSpring = option("free", "vertical, in the same way")
    tilt_x: RotationSpring = option("free", "against rotation about x; not of the shaft, which turns")
    tilt_y: RotationSpring = option("free", "against rotation about y")
    tilt_z: RotationSpring = option("free", "against rotation about z")
    parameters: dict[str, Any] = option({}, "parameters of the law, in place of springs and dampers along x, y and z")

    @model_validator(mode="after")
    def _has_springs_or_parameters(self) -> Connection:
        springs = [dof for dof in _DOFS if dof in self.model_fields_set]
        if springs and (self.parameters or self.law != BUSHING):
            raise ValueError(f'law = "{self.law}" takes parameters in place of {", ".join(springs)}')
        return self

    @property
    def is_by_law(self) -> bool:
        """True if a law gives the force.

        It replaces springs and dampers in the case.
        """
        return self.law != BUSHING or "parameters" in self.model_fields_set


class PointLoad(Placed, RadialLoad, Load):
    """Force and moment at one place over time.

    They act on the shaft or another body; the equilibrium is that of t = 0.

    Along the axes of its marker, where it has one.
    """


class Gear(Placed):
    """Spur or helical gear on the shaft.

    Its forces follow from the transmitted power or torque.
    """

    pitch_diameter: Length = option(description="working pitch diameter", gt=0.0)
    power: Power | None = option(None, "power through the mesh", gt=0.0)
    torque: Moment | None = option(None, "in place of the power: torque about the shaft", gt=0.0)
    role: Literal["driving", "driven"] = option(description="whether it drives its mate or is driven by it")
    mesh: Angle = option(description="azimuth of the mesh, from +y to +z")
    pressure_angle: Angle = option("20 deg", "normal pressure angle", gt=0.0, lt=math.radians(60.0))
    helix_angle: Angle = option("0 deg", "helix angle at the pitch diameter", ge=0.0, lt=math.radians(80.0))
    hand: Literal["right", "left"] | None = option(None, "hand of the helix")

    @model_validator(mode="after")
    def _transmits(self) -> Gear:
        if (self.power is None) == (self.torque is None):
            raise ValueError("give either `power` or `torque`")
        if self.helix_angle > 0.0 and self.hand is None:
            raise ValueError('a helical gear needs hand = "right" or "left"')
        return self
