"""Define rigid bodies, springs and connections, in SI."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from lambda_core.case.holding import Dof
from lambda_core.case.machine import MachineCase
from lambda_core.case.machine_parts import Connection, MachineBody
from lambda_core.catalogue.protocol import Catalogue
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import POSE
from lambda_core.domain.units import from_si, show
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.model.bearing_model import ELEMENT_PREFIX, ChosenLaw, TimeFunction
from lambda_core.model.bodies.locations import SUPPORT, Places
from lambda_core.model.bodies.resolve_bodies import hollow_cylinder
from lambda_core.model.bodies.resolve_materials import body_material
from lambda_core.model.laws.resolve_laws import ModelSource
from lambda_core.model.laws.resolve_links import by_laws
from lambda_core.model.laws.time_functions import peak, time_function
from lambda_core.model.ledger import Ledger
from lambda_core.model.machine_model import (
    GROUND,
    PLACES,
    SHAFT,
    BearingPart,
    Carrier,
    MachineLink,
    MachineSpring,
    MountedBearing,
    Place,
    Resistance,
    RigidBody,
    ShaftHold,
)

_DOFS = ("x", "y", "z", "tilt_x", "tilt_y", "tilt_z")
_ABOUT_X = 3  # row of a node
_ROUNDING = 1e-9
_FARTHEST = 0.1  # [m, rad] of a prescribed motion: seats and housings move by micrometres, milliradians


def rigid_bodies(case: MachineCase, catalogue: Catalogue, ledger: Ledger) -> tuple[RigidBody, ...]:
    """Return the bodies other than the shaft.

    Masses are given or follow from their shapes.
    """
    return tuple(_rigid(name, given, catalogue, ledger) for name, given in case.bodies.items())


def _rigid(name: str, given: MachineBody, catalogue: Catalogue, ledger: Ledger) -> RigidBody:
    mass, polar, transverse, extent = 0.0, 0.0, 0.0, (0.0, 0.0, 0.0)
    if given.length is not None:
        material = body_material(given.material, f"bodies.{name}.material", catalogue, ledger)
        density = material.density if material else 0.0
        if given.diameter is not None:
            mass = density * 0.25 * math.pi * (given.diameter**2 - given.bore**2) * given.length
            cylinder = hollow_cylinder(mass, 0.5 * given.bore, 0.5 * given.diameter, given.length)
            polar, transverse = cylinder.polar, cylinder.transverse
            extent = (given.length, given.diameter, given.diameter)
        elif given.width is not None and given.height is not None:
            mass = density * given.length * given.width * given.height
            polar = mass * (given.width**2 + given.height**2) / 12.0
            transverse = mass * (given.length**2 / 12.0 + (given.width**2 + given.height**2) / 24.0)
            extent = (given.length, given.width, given.height)
    mass, polar = given.mass or mass, given.polar_inertia or polar
    transverse = given.transverse_inertia or transverse
    if polar > 2.0 * transverse * (1.0 + _ROUNDING):  # of any masses I_x <= I_y + I_z
        ledger.problem(
            f"bodies.{name}.{'polar' if given.polar_inertia else 'transverse'}_inertia",
            f"no body has a polar inertia, {show(polar, 'inertia', 4)}, of more than twice its transverse one, "
            f"{show(transverse, 'inertia', 4)}",
        )
    held: list[Dof] = [getattr(given.support, dof) for dof in _DOFS]
    prescribed = tuple(time_function(getattr(one, "motion", None)) for one in held)  # none about x
    for dof, motion in zip(_DOFS, prescribed, strict=True):
        refuse_far(f"bodies.{name}.support.{dof}.motion", dof, motion, ledger)
    return RigidBody(
        name, (given.x, given.y, given.z), mass, polar, transverse, tuple(one.hold for one in held), extent, prescribed,
        tuple(float(getattr(one, "damping", 0.0)) for one in held),
    )  # fmt: skip


def refuse_far(where: str, dof: str, motion: TimeFunction, ledger: Ledger) -> None:
    """Note a motion that is too far.

    It is one of a seat or a body.
    """
    if not peak(motion) <= _FARTHEST:
        quantity = "angle" if dof.startswith("tilt") else "length"
        far = show(peak(motion), quantity, 3)
        unit = far.rpartition(" ")[2]
        most = f"{from_si(_FARTHEST, quantity, unit):.3g} {unit}"
        ledger.problem(where, f"goes to {far}, allowed up to {most}: check the unit")


def connections(case: MachineCase, stand: Places, ledger: Ledger) -> tuple[MachineSpring, ...]:
    """Return springs, dampers and bushings.

    They act along the axes of the case.
    """
    found = []
    for name, given in case.connections.items():
        if f"connections.{name}" not in stand.of or given.is_by_law:
            continue  # said where places are sought; or no spring
        place, to = stand.of[f"connections.{name}"], stand.carrier(given.to)
        _refuse_springs_on_parts(name, given, (place.body, to), ledger)
        matrices = []
        for kind in ("stiffness", "damping"):
            own = np.diag([getattr(getattr(given, dof), kind) for dof in _DOFS])
            matrices.append(place.turn.T @ own @ place.turn)
        if SHAFT in (place.body, to) and max(np.abs(matrix[3]).max() for matrix in matrices) > _ROUNDING:
            ledger.problem(f"connections.{name}.tilt_x", "would prevent rotation of the shaft; remove it")
        found.append(MachineSpring(name, place, to, *matrices))
    return (*found, *_elastic_support(case, stand))


def _refuse_springs_on_parts(name: str, given: Connection, ends: tuple[Carrier, ...], ledger: Ledger) -> None:
    """Note springs where only a law can act.

    They are at a cage, and against the rotation of an outer ring.
    """
    parts = [end for end in ends if isinstance(end, BearingPart)]
    if any(part.part == "cage" for part in parts):
        ledger.problem(
            f"connections.{name}",
            "springs hold the shaft, outer rings and bodies; at a cage give a law by `parameters`",
        )
    elif parts and (given.tilt_x.stiffness or given.tilt_x.damping):
        ledger.problem(
            f"connections.{name}.tilt_x",
            "springs do not hold the rotation of an outer ring: leave it out, or give a law",
        )


def _elastic_support(case: MachineCase, stand: Places) -> list[MachineSpring]:
    """Return springs and dampers of the support of the shaft."""
    support = case.shaft.support
    held = [getattr(support, dof) for dof in POSE]
    if SUPPORT not in stand.of or not any(one.stiffness or one.damping for one in held):
        return []
    matrices = []
    for kind in ("stiffness", "damping"):
        own = np.zeros(NODE)
        own[list(PLACES)] = [getattr(one, kind) for one in held]
        matrices.append(np.diag(own))
    return [MachineSpring("shaft support", stand.of[SUPPORT], GROUND, *matrices)]


def shaft_hold(case: MachineCase, stand: Places, ledger: Ledger) -> ShaftHold | None:
    """Return the rigid ground constraints of the shaft.

    None where it is free.
    """
    prescribed: list[TimeFunction | None] = []
    for dof in POSE:
        given: Dof = getattr(case.shaft.support, dof)
        motion = time_function(getattr(given, "motion", None))
        refuse_far(f"{SUPPORT}.{dof}.motion", dof, motion, ledger)
        prescribed.append(None if given.mode == "free" else motion)
    if SUPPORT not in stand.of or all(one is None for one in prescribed):
        return None
    return ShaftHold(stand.of[SUPPORT].point[0], tuple(prescribed))


def resistance(case: MachineCase, stand: Places, ledger: Ledger) -> Resistance | None:
    """Return the resistance to the shaft's rotation.

    None where there is none.
    """
    damping = case.shaft.support.spin.damping
    if not damping or SUPPORT not in stand.of:
        return None
    if case.operation.torque is None:
        ledger.problem(
            f"{SUPPORT}.spin.damping", "does nothing where the speed is given: leave it out, or give operation.torque"
        )
    return Resistance(stand.of[SUPPORT].point[0], damping)


def connections_by_laws(
    case: MachineCase, stand: Places, registry: ModelSource, ledger: Ledger
) -> tuple[tuple[MachineLink, ...], dict[str, dict[str, ChosenLaw]]]:
    """Return connections by laws, and the laws.

    The laws have the model's names.
    """

    def ends(where: str, given: Connection) -> tuple[Place, Place] | None:
        if where not in stand.of:
            return None
        second, to = stand.of[where], stand.carrier(given.to)
        if second.body == GROUND:
            ledger.problem(f"{where}.at", "the ground cannot move: write it as `to`, and the moving body as `at`")
        first = stand.markers[given.to].point if given.to in stand.markers else second.point
        if to == SHAFT and given.to not in stand.markers:  # no place on it: the nearest on its axis
            first = (first[0], 0.0, 0.0)
        for end, body, point in (("at", second.body, second.point), ("to", to, first)):
            if body == SHAFT and math.hypot(*point[1:]) > 0.0:
                ledger.assume(
                    f"{where}.{end} turns with the shaft off its axis; the equilibrium has it where it is at t = 0"
                )
        return Place(to, first, np.eye(3)), second

    wanted = {name: given for name, given in case.connections.items() if given.is_by_law}
    found, laws = by_laws("connections", wanted, ends, registry, ledger)
    return tuple(MachineLink(name, f"{ELEMENT_PREFIX}{name}", *own) for name, own in found.items()), laws


def refuse_idle_dampers(bearings: Sequence[MountedBearing], housing: FloatArray | None, ledger: Ledger) -> None:
    """Note dampers of seats in which no ring can move."""
    for bearing in bearings:
        for dof, k, c in zip(POSE, bearing.seating.stiffness, bearing.seating.damping, strict=True):
            if c and math.isinf(k) and housing is None:
                where = f"bearings.{bearing.name}.support.{dof}.damping"
                ledger.problem(where, "has no effect: the outer ring is locked in the ground")
