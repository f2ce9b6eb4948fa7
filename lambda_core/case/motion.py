"""Declare the sections for loads and motion.

These are loads, operation, bodies, gravity and markers.
"""

from __future__ import annotations

import math
from typing import Any, Literal

from pydantic import field_validator

from lambda_core.case.holding import InnerSpin, Spin, Tilt, Translation
from lambda_core.case.option import Section, option
from lambda_core.case.signals import ForceSignal, MomentSignal, SpeedSignal
from lambda_core.domain.units import (
    Acceleration,
    Angle,
    Inertia,
    Length,
    Mass,
    SmallLength,
    Unbalance,
)


class RingBody(Section):
    """Mass and inertias of a body of a bearing."""

    mass: Mass | None = option(None, "mass; absent: from the geometry", gt=0.0)
    transverse_inertia: Inertia | None = option(None, "moment of inertia about a diameter; absent: estimated", gt=0.0)
    polar_inertia: Inertia | None = option(None, "moment of inertia about the axis; absent: estimated", gt=0.0)
    unbalance: Unbalance = option("0 g mm", "mass times eccentricity of the centre of mass", ge=0.0)


class InnerRing(RingBody):
    """The inner ring with its shaft."""

    shaft_mass: Mass = option("0 kg", "mass of the shaft that moves with the inner ring", ge=0.0)
    shaft_transverse_inertia: Inertia | None = option(None, "of the shaft; absent: bar filling the bore", ge=0.0)
    shaft_polar_inertia: Inertia | None = option(None, "of the shaft; absent: bar filling the bore", ge=0.0)
    x: Translation = option("free", "axial")
    y: Translation = option("free", "horizontal")
    z: Translation = option("free", "vertical")
    tilt_y: Tilt = option("free", "rotation about y")
    tilt_z: Tilt = option("free", "rotation about z")
    spin: InnerSpin = option("prescribed", "rotation: prescribed (operation.speed) or free (operation.torque)")


class OuterRing(RingBody):
    """Outer ring, fixed by default.

    Where it moves, its mass may include the housing's.
    """

    x: Translation = option("locked", "axial")
    y: Translation = option("locked", "horizontal")
    z: Translation = option("locked", "vertical")
    tilt_y: Tilt = option("locked", "rotation about y")
    tilt_z: Tilt = option("locked", "rotation about z")
    spin: Spin = option("locked", "rotation about the axis")


class TurningRing(RingBody):
    """Outer ring of a bearing in a machine.

    Its support holds it in the other directions.
    """

    spin: Spin = option("locked", "rotation about the axis")


class CageBody(RingBody):
    """Cage by its type from the catalogue.

    Single values replace those of the catalogue.
    """

    type: str = option("steel-ribbon", "catalogue name of the cage type", min_length=1)
    guidance: Literal["ball", "inner ring", "outer ring"] | None = option(None, "what centres the cage")
    pocket_clearance: SmallLength | None = option(None, "diametral clearance of ball and pocket", gt=0.0)
    land_clearance: SmallLength | None = option(None, "diametral clearance of cage and guiding ring", gt=0.0)
    per_row: bool = option(False, "two rows: a cage for each row, in place of one for both")
    width: Length | None = option(None, "axial width", gt=0.0)
    radial_thickness: Length | None = option(None, "radial thickness", gt=0.0)
    x: Translation = option("free", "axial")
    y: Translation = option("free", "horizontal")
    z: Translation = option("free", "vertical")
    tilt_y: Tilt = option("free", "rotation about y")
    tilt_z: Tilt = option("free", "rotation about z")
    spin: Spin = option("free", "rotation about the axis")


class Bodies(Section):
    """Masses and boundary conditions of the bodies."""

    inner_ring: InnerRing = option({}, "inner ring with shaft")
    outer_ring: OuterRing = option({}, "outer ring with housing")
    cage: CageBody = option({}, "cage")


class Load(Section):
    """External force and moment over time.

    They act in the inertial frame; the equilibrium is that of t = 0.
    """

    force_x: ForceSignal = option("0 N", "force along the shaft")
    force_y: ForceSignal = option("0 N", "horizontal force")
    force_z: ForceSignal = option("0 N", "vertical force, upwards")
    moment_x: MomentSignal = option("0 N m", "torque about x")
    moment_y: MomentSignal = option("0 N m", "moment about y")
    moment_z: MomentSignal = option("0 N m", "moment about z")


class RadialLoad(Section):
    """Force across the shaft by size and direction."""

    radial: ForceSignal = option("0 N", "radial load")
    radial_direction: Angle = option("270 deg", "azimuth of the radial load, from +y to +z; 270 deg is down")

    @field_validator("radial_direction")
    @classmethod
    def _within_a_turn(cls, angle: float) -> float:
        if abs(angle) > 2.0 * math.pi:
            raise ValueError(f"must lie within a full turn, -360 deg to 360 deg, not {math.degrees(angle):.6g} deg")
        return angle


class Loads(RadialLoad):
    """External loads; the first four act on the inner ring."""

    radial: ForceSignal = option("0 N", "radial load on the inner ring")
    axial: ForceSignal = option("0 N", "axial load on the inner ring, along +x")
    moment_y: MomentSignal = option("0 N m", "moment on the inner ring about y")
    moment_z: MomentSignal = option("0 N m", "moment on the inner ring about z")
    inner_ring: Load | None = option(None, "further loads on the inner ring")
    outer_ring: Load | None = option(None, "loads on the outer ring")
    cage: Load | None = option(None, "loads on the cage")


class Operation(Section):
    """Drive of the bearing."""

    speed: SpeedSignal = option(description="speed of the inner ring over time (initial speed where its spin is free)")
    torque: MomentSignal | None = option(None, "driving torque on the inner ring; needs bodies.inner_ring.spin free")
    temperatures: Literal["given", "computed"] = option(
        "given", 'of oil and parts: given in the case, or "computed" by the network of [thermal] for t = 0'
    )


class Gravity(Section):
    """Acceleration of gravity."""

    x: Acceleration = option("0 m/s2", "along the shaft")
    y: Acceleration = option("0 m/s2", "horizontal")
    z: Acceleration = option("-9.80665 m/s2", "vertical", reference="standard gravity, ISO 80000-3")


class Marker(Section):
    """Named point on a body, with axes.

    Loads and connections there use the axes; its motion is written to the result.

    In the case of one bearing it stands in the body's frame, in that of a machine where it is drawn.
    """

    body: str = option(
        "shaft",
        'body that carries it: "shaft", of one bearing "inner_ring", "outer_ring" or "cage", of a machine "ground", '
        'one of [bodies], "NAME.outer_ring" or "NAME.cage" of a bearing',
        min_length=1,
    )
    x: Length = option("0 mm", "along the shaft: from the bearing's centre, in a machine from the shaft's left end")
    y: Length = option("0 mm", "horizontal distance from the axis at t = 0")
    z: Length = option("0 mm", "vertical distance from the axis at t = 0")
    about_x: Angle = option("0 deg", "axes of springs and loads here: turned about x, then about y and z as they were")
    about_y: Angle = option("0 deg", "the same about y")
    about_z: Angle = option("0 deg", "the same about z")

    @property
    def point(self) -> tuple[float, float, float]:
        """Its place [m]."""
        return self.x, self.y, self.z


class BetweenBodies(Section):
    """Force element between two bodies.

    One may be the ground. The elements of the bearing act as well.
    """

    law: str = option("bushing", "law of the role force_element", min_length=1)
    first: str = option("ground", 'body or marker at one end; "ground" does not move', min_length=1)
    second: str = option(description="body or marker at the other end, on which the law's force acts", min_length=1)
    parameters: dict[str, Any] = option({}, "parameters of the law")
