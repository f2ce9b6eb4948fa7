"""Solve a machine with a rigid shaft as one bearing."""

from __future__ import annotations

from dataclasses import replace

from lambda_core.domain.elements import BODIES, BodyName
from lambda_core.model.bearing_model import BearingModel, Link
from lambda_core.model.machine_model import GROUND, BearingPart, MachineModel, Place
from lambda_core.solver.drivers.lumps import lump
from lambda_core.solver.drivers.machine_assembly import machine_members


def bearing_on_rigid_shaft(machine: MachineModel) -> BearingModel | None:
    """Return a machine's only bearing with its surroundings.

    None where more than that moves.

    Its rings and cage are the members that move: shaft and discs count to the inner ring. The tables of both are the
    same, so that the friction of the balls is in equilibrium with the loads, too.
    """
    if not machine.body.is_rigid:
        return None
    members, ties = machine_members(machine, lump(machine))
    if len(members) > len(BODIES) or ties.stiffness.any() or ties.damping.any():
        return None
    (mounted,), (inner, outer, cage) = machine.bearings, (member.body for member in members)
    links = {}
    for link in machine.links:
        first, second = _body(link.first), _body(link.second)
        assert second is not None  # the ground does not move
        links[link.name] = Link(
            first, _from(mounted.position, link.first), second, _from(mounted.position, link.second)
        )
    return replace(
        mounted.model, name=machine.name, gravity=machine.gravity, inner_ring=inner, outer_ring=outer, cage_body=cage,
        links=links,
    )  # fmt: skip


def _body(place: Place) -> BodyName | None:
    """Return the body that carries a place.

    The bearing is alone; the result is None for the ground.
    """
    if isinstance(place.body, BearingPart):
        return place.body.part
    return None if place.body == GROUND else "inner_ring"


def _from(position: float, place: Place) -> tuple[float, float, float]:
    """Return a place from a bearing's middle [m]."""
    x, y, z = place.point
    return x - position, y, z
