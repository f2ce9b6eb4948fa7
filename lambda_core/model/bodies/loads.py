"""Resolve the loads of bearings and machines, in SI."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from lambda_core.case.case import Case
from lambda_core.case.machine import MachineCase
from lambda_core.case.machine_parts import PointLoad
from lambda_core.case.motion import Load, RadialLoad
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import POSE, SPIN, BodyName
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.formulas.elastic.body import ElasticBody
from lambda_core.formulas.gear_forces import GearForces
from lambda_core.model.bearing_model import TimeFunction
from lambda_core.model.bodies.locations import Places, carried
from lambda_core.model.laws.time_functions import added, initial, peak, scaled, time_function
from lambda_core.model.ledger import Ledger
from lambda_core.model.machine_model import GROUND, PLACES, SHAFT, BearingPart, MountedBearing, Place, RigidBody

COMPONENTS = ("force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z")
LOADS = (*COMPONENTS, "radial")  # what may change over time of a load at a place
_ABOUT_X = 3  # row of a node
_FAR_BEYOND = 1000.0  # times the static ratings: pressures ten times those that dent it
Vector = tuple[TimeFunction, TimeFunction, TimeFunction]


def components(load: Load, across: RadialLoad | None = None) -> list[TimeFunction]:
    """Return three forces and three moments of a load.

    They are along and about its axes; the force `across` the shaft is among them.
    """
    found = [time_function(getattr(load, component)) for component in COMPONENTS]
    if across is not None:
        radial = time_function(across.radial)
        for row, share in enumerate(direction(across.radial_direction), start=1):
            found[row] = added(found[row], scaled(radial, share))
    return found


def direction(azimuth: float) -> tuple[float, float]:
    """Return cosine and sine of a direction.

    Exact at whole right angles so that "down" has no sideways part.
    """
    quarter = azimuth / (math.pi / 2.0)
    if abs(quarter - round(quarter)) < 1e-12:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarter) % 4]
    return math.cos(azimuth), math.sin(azimuth)


def body_loads(name: BodyName, case: Case) -> tuple[Vector, Vector]:
    """Return force [N] and moment [N m] on a body.

    Their components are along and about x, y and z of the inertial frame.
    """
    loads, is_inner = case.loads, name == "inner_ring"
    found = components(getattr(loads, name) or Load(), loads if is_inner else None)
    if is_inner:
        drive = case.operation.torque
        for row, more in ((0, loads.axial), (4, loads.moment_y), (5, loads.moment_z), (_ABOUT_X, drive)):
            found[row] = added(found[row], time_function(more))
    return (found[0], found[1], found[2]), (found[3], found[4], found[5])


def all_loads(
    case: MachineCase, stand: Places, body: ElasticBody, bodies: Sequence[RigidBody], gears: Mapping[str, GearForces]
) -> tuple[FloatArray, tuple[tuple[int, TimeFunction], ...]]:
    """Return forces and moments at t = 0.

    They act on shaft nodes and bodies. Also return those that change, with their rows.
    """
    size = body.mass.shape[0]
    found: FloatArray = np.zeros(size + NODE * len(bodies))
    varying: dict[int, list[TimeFunction]] = {}
    for name, load in case.loads.items():
        place = stand.of[f"loads.{name}"]
        if place.body == GROUND or isinstance(place.body, BearingPart):
            continue
        if place.body == SHAFT:
            first, arm = body.rows(place.point[0]).start, np.array([0.0, *place.point[1:]])
        else:
            own = bodies[place.body - 1]
            first, arm = size + NODE * (place.body - 1), np.subtract(place.point, own.centre)
        for i, total in enumerate(_about_centre(load, place, arm)):
            found[first + i] += initial(total)
            if any(term.kind != "constant" for term in total.terms):
                varying.setdefault(first + i, []).append(total)
    for name, forces in gears.items():
        found[body.rows(case.gears[name].place)] += [*forces.force, *forces.moment]
    return found, tuple((row, added(*functions)) for row, functions in varying.items())


def loads_on_parts(case: MachineCase, stand: Places) -> dict[BearingPart, tuple[TimeFunction, ...]]:
    """Return force and moment on rings and cages.

    They are sums of all loads on each outer ring and cage, about its centre.
    """
    found: dict[BearingPart, list[TimeFunction]] = {}
    for name, load in case.loads.items():
        place = stand.of[f"loads.{name}"]
        if not isinstance(place.body, BearingPart):
            continue
        centre = stand.of[f"bearings.{place.body.bearing}"].point
        sofar = found.setdefault(place.body, [TimeFunction()] * NODE)
        own = _about_centre(load, place, np.subtract(place.point, centre))
        sofar[:] = [added(one, other) for one, other in zip(sofar, own, strict=True)]
    return {part: tuple(functions) for part, functions in found.items()}


def say_idle_loads(
    loads: Mapping[BearingPart, tuple[TimeFunction, ...]],
    bearings: Sequence[MountedBearing],
    housing: FloatArray | None,
    ledger: Ledger,
) -> None:
    """Note loads without effect on outer rings.

    Nothing can move along them; cages are loaded in motion only, which is reported.
    """
    held = {bearing.name: bearing for bearing in bearings}
    for part, load in loads.items():
        bearing = held[part.bearing]
        if part.part == "cage":
            ledger.assume(f"{part.bearing}: loads on the cage act in motion; the equilibrium of the shaft has no cage")
            for row, dof in zip((*PLACES, _ABOUT_X), (*POSE, SPIN), strict=True):
                if load[row].terms and bearing.model.cage_body.dofs[dof].mode != "free":
                    where = f"bearings.{part.bearing}.cage.{dof}"
                    ledger.problem(where, 'holds the cage, so that its load there does nothing: write "free"')
            continue
        is_housed = housing is not None and bearing.carrier == GROUND
        for row, dof in zip(PLACES, POSE, strict=True):
            k = bearing.seating.stiffness[POSE.index(dof)]
            if load[row].terms and math.isinf(k) and not is_housed:
                ledger.problem(
                    f"bearings.{part.bearing}.support.{dof}",
                    f"holds the outer ring, so that its load along {dof} does nothing: leave the load out, or write "
                    '"free" or a stiffness',
                )


def _about_centre(load: PointLoad, place: Place, arm: FloatArray) -> list[TimeFunction]:
    """Return force and moment about a point.

    The place of the load is at `arm` [m] from the point.
    """
    share = carried(arm).T @ place.turn.T  # of each component at the place in each row of its body
    functions = components(load, load)
    return [added(*(scaled(f, float(c)) for f, c in zip(functions, share[i], strict=True))) for i in range(NODE)]


def refuse_far_beyond(
    case: MachineCase, gears: Mapping[str, GearForces], bearings: Sequence[MountedBearing], ledger: Ledger
) -> None:
    """Note gears and loads beyond all contact laws.

    The check comes before balls are pressed through rings.
    """
    static = sum(bearing.static_rating for bearing in bearings)
    sizes = {
        f"gears.{name}.{'torque' if case.gears[name].power is None else 'power'}": (max(map(abs, forces.force)), "N")
        for name, forces in gears.items()
    }
    for name, load in case.loads.items():
        for component in LOADS:
            unit = "N m" if component.startswith("moment") else "N"
            sizes[f"loads.{name}.{component}"] = (peak(time_function(getattr(load, component))), unit)
    for where, (size, unit) in sizes.items():
        if not size <= _FAR_BEYOND * static:
            ledger.problem(
                where,
                f"acts with {size:.3g} {unit}, more than {_FAR_BEYOND:.0f} times the {1e-3 * static:.3g} kN that all "
                "bearings together bear at rest (C_0): is the unit right?",
            )
