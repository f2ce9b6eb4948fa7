"""Declare markers, bodies, wheels, springs, loads and gears."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Literal

from pydantic import ValidationInfo, field_validator, model_validator

from lambda_core.case.option import Section, option
from lambda_core.case.parts import MaterialChoice
from lambda_core.case.signals import AngleSignal, ForceSignal, LengthSignal, MomentSignal
from lambda_core.domain.units import (
    Angle,
    AngularDamping,
    AngularStiffness,
    Damping,
    Inertia,
    Length,
    Mass,
    Moment,
    Power,
    Stiffness,
    Unbalance,
    parse,
    show,
)

# Stiffness and damping at most, in SI: a cube of steel of a metre has 2e11 N/m; where one part is 1e20 as stiff as
# others, these are lost in rounding.
LARGEST = 1e15


class Placed(Section):
    """What stands at a place of the shaft."""

    marker: str | None = option(None, "in place of the position: one of [markers]", min_length=1)
    position: Length | None = option(None, "place along the shaft, from its left end")

    @field_validator("position")
    @classmethod
    def _stands_somewhere(cls, position: float | None, info: ValidationInfo) -> float | None:
        marker = info.data.get("marker", "unknown" if position is None else None)
        if position is None and marker is None:
            raise ValueError("is required, or a marker")
        if position is not None and marker is not None:
            raise ValueError("give either `position` or `marker`, not both")
        return position

    @property
    def place(self) -> float:
        """Along the shaft [m]; markers are replaced by their positions before anything is computed."""
        return 0.0 if self.position is None else self.position


class ShaftMarker(Section):
    """A named place on the shaft, on another body or on the ground, and the axes of what acts there."""

    body: str = option("shaft", 'body that carries it: "shaft", "ground" or one of [bodies]', min_length=1)
    x: Length = option(description="place along the shaft, from its left end, where it is drawn")
    y: Length = option("0 mm", "distance from the shaft's axis, horizontal")
    z: Length = option("0 mm", "distance from the shaft's axis, vertical")
    about_x: Angle = option("0 deg", "axes of springs and loads here: turned about x, then about y and z as they were")
    about_y: Angle = option("0 deg", "likewise about y")
    about_z: Angle = option("0 deg", "likewise about z")


def held(text: str, quantity: str) -> str:
    folded = text.strip()
    if folded in ("locked", "free"):
        return folded
    try:
        value = parse(folded, quantity)
    except ValueError as error:
        raise ValueError(f'{error}; or write "locked" or "free"') from None
    if value <= 0.0:
        raise ValueError(f'"{text}": a stiffness must be greater than 0; or write "free"')
    if value > LARGEST:
        raise ValueError(f'"{text}": a stiffness must be at most {show(LARGEST, quantity)}; or write "locked"')
    return folded


def without_motion(value: Any) -> Any:
    """Refuse a motion over time where a degree of freedom is held."""
    if isinstance(value, Mapping):
        raise ValueError(
            'must be "locked", "free" or a stiffness; to move the shaft give operation.speed, loads over time or an '
            "unbalance; to move a locked seat or body give its motion_x to motion_tilt_z"
        )
    return value


def leads_what_is_locked(motion: Any, info: ValidationInfo, prefix: str) -> Any:
    """Refuse a motion_DOF of what is not locked in that degree of freedom, by the option of the same name."""
    dof = prefix + str(info.field_name).removeprefix("motion_")
    how = info.data.get(dof, "locked")
    if motion is not None and how != "locked":
        raise ValueError(f'needs {dof} = "locked", not "{how}": only a locked direction can have a prescribed motion')
    return motion


class ShaftBody(Section):
    """A rigid body such as a housing: mass and inertia, or a shape, and the supports of its centre of mass."""

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
    hold_x: str = option("free", 'how the ground holds its centre: "free", "locked" or a stiffness ("200 N/um")')
    hold_y: str = option("free", "horizontal, likewise")
    hold_z: str = option("free", "vertical, likewise")
    hold_tilt_x: str = option("free", 'rotation about x: "free", "locked" or a stiffness ("50 N m/mrad")')
    hold_tilt_y: str = option("free", "rotation about y, likewise")
    hold_tilt_z: str = option("free", "rotation about z, likewise")
    motion_x: LengthSignal | None = option(None, "prescribed displacement of a locked centre from its place, axial")
    motion_y: LengthSignal | None = option(None, "horizontal, likewise")
    motion_z: LengthSignal | None = option(None, "vertical, likewise")
    motion_tilt_y: AngleSignal | None = option(None, "rotation about y, likewise")
    motion_tilt_z: AngleSignal | None = option(None, "rotation about z, likewise")

    _without_motion = field_validator(
        "hold_x", "hold_y", "hold_z", "hold_tilt_x", "hold_tilt_y", "hold_tilt_z", mode="before"
    )(without_motion)

    @field_validator("hold_x", "hold_y", "hold_z")
    @classmethod
    def _translation(cls, text: str) -> str:
        return held(text, "stiffness")

    @field_validator("hold_tilt_x", "hold_tilt_y", "hold_tilt_z")
    @classmethod
    def _rotation(cls, text: str) -> str:
        return held(text, "angular_stiffness")

    @field_validator("motion_x", "motion_y", "motion_z", "motion_tilt_y", "motion_tilt_z")
    @classmethod
    def _leads_what_is_locked(cls, motion: Any, info: ValidationInfo) -> Any:
        return leads_what_is_locked(motion, info, "hold_")

    @model_validator(mode="after")
    def _has_a_mass(self) -> ShaftBody:
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
    """A rigid wheel, rotor or coupling on the shaft: its mass and inertia, or its shape."""

    mass: Mass | None = option(None, "mass; absent: that of the shape", gt=0.0)
    polar_inertia: Inertia | None = option(None, "about the axis; absent: 0, or that of the shape", ge=0.0)
    transverse_inertia: Inertia | None = option(
        None, "about a diameter; absent: half the polar one, or that of the shape", ge=0.0
    )
    diameter: Length | None = option(None, "in place of the mass: a cylinder of this outside diameter", gt=0.0)
    width: Length | None = option(None, "width of the cylinder", gt=0.0)
    bore: Length = option("0 mm", "bore of the cylinder", ge=0.0)
    material: MaterialChoice = option("100Cr6", "of the cylinder: catalogue name or a table of properties")
    unbalance: Unbalance = option("0 g mm", "mass times eccentricity; counts in motion (shaft --run)", ge=0.0)
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


class ShaftSpring(Placed):
    """Spring and damper between a place and the ground or another body, without force where they are drawn.

    With six stiffnesses it is a bushing; its axes are those of its marker, and it acts at its place.
    """

    to: str = option(
        "ground", "what it holds its place to: ground, shaft, one of [bodies], or a marker there", min_length=1
    )
    x: Stiffness = option("0 N/m", "stiffness along the shaft", ge=0.0, le=LARGEST)
    y: Stiffness = option("0 N/m", "horizontal", ge=0.0, le=LARGEST)
    z: Stiffness = option("0 N/m", "vertical", ge=0.0, le=LARGEST)
    tilt_x: AngularStiffness = option(
        "0 N m/rad", "against rotation about x; not of the shaft, which turns", ge=0.0, le=LARGEST
    )
    tilt_y: AngularStiffness = option("0 N m/rad", "against rotation about y", ge=0.0, le=LARGEST)
    tilt_z: AngularStiffness = option("0 N m/rad", "against rotation about z", ge=0.0, le=LARGEST)
    damping_x: Damping = option("0 N s/m", "damping along the shaft", ge=0.0, le=LARGEST)
    damping_y: Damping = option("0 N s/m", "horizontal", ge=0.0, le=LARGEST)
    damping_z: Damping = option("0 N s/m", "vertical", ge=0.0, le=LARGEST)
    damping_tilt_x: AngularDamping = option("0 N m s/rad", "of rotation about x; not of the shaft", ge=0.0, le=LARGEST)
    damping_tilt_y: AngularDamping = option("0 N m s/rad", "of rotation about y", ge=0.0, le=LARGEST)
    damping_tilt_z: AngularDamping = option("0 N m s/rad", "of rotation about z", ge=0.0, le=LARGEST)


class PointLoad(Placed):
    """Force and moment on the shaft or another body at one place, over time; the equilibrium is that of t = 0.

    Along the axes of its marker, where it has one.
    """

    force_x: ForceSignal = option("0 N", "force along the shaft")
    force_y: ForceSignal = option("0 N", "horizontal force")
    force_z: ForceSignal = option("0 N", "vertical force, upwards")
    moment_x: MomentSignal = option("0 N m", "torque about x")
    moment_y: MomentSignal = option("0 N m", "moment about y")
    moment_z: MomentSignal = option("0 N m", "moment about z")


class Gear(Placed):
    """A spur or helical gear on the shaft: forces from what it transmits."""

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
