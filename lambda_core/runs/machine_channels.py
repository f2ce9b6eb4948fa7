"""List channels of shaft and bodies."""

from __future__ import annotations

from lambda_core.domain.channels import Channel
from lambda_core.model.laws.state_channels import element_channels

MACHINE_CHANNELS = (
    Channel("shaft_position", ("lump", "axis"), "m", "displacement of the shaft at every lump"),
    Channel("shaft_tilt", ("lump", "tilt"), "rad", "tilt of the shaft at every lump about y and z"),
    Channel("shaft_twist", ("lump",), "rad", "turn of the shaft at every lump beyond that of the coupling"),
    Channel("body_position", ("body", "axis"), "m", "displacement of every other body"),
    Channel("body_tilt", ("body", "axis"), "rad", "rotation of every other body about x, y and z"),
    Channel("marker_position", ("marker", "axis"), "m", "displacement of every named place"),
    Channel("reaction_force", ("bearing", "axis"), "N", "force of every bearing on the shaft"),
    Channel("reaction_moment", ("bearing", "axis"), "N m", "moment of every bearing on the shaft about its centre"),
    Channel("power_loss", (), "W", "power that all bearings dissipate"),
    *element_channels("connection", "connection by a law"),
)
