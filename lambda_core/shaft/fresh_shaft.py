"""The commented case of a shaft to start from."""

from __future__ import annotations

import json

_TEXT = """\
# A shaft in two bearings with a helical gear. Check it:  lambda-bearing check FILE
# Solve it:  lambda-bearing shaft FILE      Let it move:  lambda-bearing shaft FILE --run
# x runs along the shaft from its left end, y is horizontal, z points up. Every option: docs/shaft.md.
name = NAME
description = "gearbox shaft: locating bearing left, floating bearing right, helical gear between them"

[operation]
speed = "3000 rpm"             # positive about +x

[lubricant]
name = "FVA3"
temperature = "70 degC"

# The shaft, piece by piece from the left. Hollow pieces have a bore.
[shaft]
# reduced = "shaft.npz"        # in place of the pieces: a finite-element program's reduced model
# temperature = "80 degC"      # mean; with [housing] temperature for growth in length
# drive = "0 mm"               # where the coupling holds it against turning; default: the left end

[[shaft.sections]]
length = "30 mm"
diameter = "40 mm"

[[shaft.sections]]
length = "110 mm"
diameter = "48 mm"

[[shaft.sections]]
length = "30 mm"
diameter = "30 mm"

# Bearings by name. What stands here is what stands in [bearing] of the case of one bearing; position is its middle.
[bearings.left]
designation = "SKF 6208"
position = "21 mm"
clearance = "CN"

[bearings.right]
designation = "SKF 6206"
position = "148 mm"
support.x = "free"             # floats in its seat; also y, z, tilt_y, tilt_z; or a stiffness: "200 N/um"
# outer = "box"                # sits in a body, not in the ground
# support.motion_tilt_y = "0.5 mrad"   # a misaligned seat, or a prescribed motion over time

# An angular contact bearing has a contact angle, the direction of the force on the shaft that it takes ("+x", "-x"),
# and perhaps a preload: preload = "5 um" (rigid) or preload_force = "300 N" (spring).

# Gears: forces follow from power (or torque) and geometry.
[gears.wheel]
position = "85 mm"
pitch_diameter = "120 mm"
power = "15 kW"
role = "driven"                # pushed along the rotation; "driving": against it
mesh = "90 deg"                # azimuth of the mesh from +y to +z: on top
helix_angle = "15 deg"
hand = "right"

# Further forces and moments.
# [loads.belt]
# position = "5 mm"
# force_z = "-800 N"             # also a table over time, as moment_x for a torque

# Springs, dampers and bushings, to the ground or between bodies.
# [springs.seal]
# position = "160 mm"
# z = "1 N/um"                   # also x, y, tilt_x, tilt_y, tilt_z
# damping_z = "200 N s/m"

# A housing that gives way: a rigid body on springs. Markers are named places on the shaft, on bodies, on the ground.
# [bodies.box]
# x = "85 mm"                    # its centre of mass
# z = "-40 mm"
# length = "160 mm"              # or mass, polar_inertia, transverse_inertia
# width = "120 mm"
# height = "80 mm"
# [markers.foot]
# body = "box"
# x = "10 mm"
# z = "-80 mm"
# [springs.foot]
# marker = "foot"                # of bearings, loads, gears and discs, too, in place of a position
# z = "40 N/um"

# Wheels and rotors that are not part of the sections: mass and inertia, or diameter, width and bore of a cylinder.
[discs.wheel]
position = "85 mm"
mass = "2.5 kg"
polar_inertia = "4500 kg mm2"
# unbalance = "50 g mm"        # counts in motion

[life]
contamination = 0.6            # e_C of ISO 281, for the modified life

# In motion: vibrations in place of averages, chosen by itself where a raceway has a defect.
# [bearings.right.forces.ball_outer]
# models = { surface = "defect" }  # where it is loaded: opposite to its force on the shaft
# parameters = { surface = { width = "0.8 mm", depth = "20 um", azimuth = "188 deg" } }
# [solver]
# accuracy = "vibration"
# resolve = "2 kHz"
"""


def fresh_shaft(name: str) -> str:
    """Return the text of a shaft's case called `name`."""
    return _TEXT.replace("NAME", json.dumps(name), 1)
