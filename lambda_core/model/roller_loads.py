"""Read loads and supports of rings at rest."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, get_args

import numpy as np

from lambda_core.case.case import Case
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import POSE
from lambda_core.formulas.loading import Ring
from lambda_core.model.bodies.resolve_bodies import ring_inertia
from lambda_core.model.bodies.resolve_materials import materials_apart
from lambda_core.model.geometry.resolve_geometry import resolve_geometry
from lambda_core.model.laws.time_functions import initial, time_function
from lambda_core.model.ledger import Ledger

if TYPE_CHECKING:
    from lambda_core.case.motion import RingBody
    from lambda_core.catalogue.protocol import Catalogue
    from lambda_core.elements.roller.roller_bearing import RollerBearing

STRAIGHT = "the shaft holds the inner ring straight: tilts are locked where the case leaves them open"
Held = tuple[bool, bool, bool, bool, bool]
_HELD_OR_FREE = ("free", "locked")
_FORCES = ("force_x", "force_y", "force_z", "moment_y", "moment_z")


def outer_speed(case: Case) -> float:
    """Return the initial speed of the outer ring [rad/s]."""
    motion = case.bodies.outer_ring.spin.motion
    return 0.0 if motion is None else initial(time_function(motion))


def ring_masses(case: Case, rollers: RollerBearing, catalogue: Catalogue) -> tuple[float, float]:
    """Return the masses of inner and outer ring [kg].

    They are those of motion: given, or of rings for as many balls; the shaft counts to the inner one.
    """
    from lambda_core.model.rollers_in_motion import as_balls  # which resolves loads at rest itself

    ledger, given = Ledger(), {"inner": case.bodies.inner_ring, "outer": case.bodies.outer_ring}
    materials = materials_apart(get_args(Ring), case, catalogue, ledger)
    found = resolve_geometry(as_balls(case, rollers).bearing, None, catalogue, ledger)
    masses = [given[ring].mass for ring in get_args(Ring)]
    if found is not None:  # else a problem says what is missing
        masses = [
            ring_inertia(found[0], ring, materials[ring].density).mass if mass is None else mass
            for ring, mass in zip(get_args(Ring), masses, strict=True)
        ]
    return (masses[0] or 0.0) + case.bodies.inner_ring.shaft_mass, masses[1] or 0.0


def inner_loads(case: Case, mass: float) -> FloatArray:
    """Return the loads at t = 0, (5,).

    They act on the inner ring; the weight is that of its `mass` [kg] with the shaft.
    """
    loads = case.loads
    numbers = {
        name: initial(time_function(getattr(loads, name))) for name in ("radial", "axial", "moment_y", "moment_z")
    }
    direction = loads.radial_direction
    found = np.array(
        [
            numbers["axial"],
            numbers["radial"] * math.cos(direction),
            numbers["radial"] * math.sin(direction),
            numbers["moment_y"],
            numbers["moment_z"],
        ]
    )
    if loads.inner_ring is not None:
        found += [initial(time_function(getattr(loads.inner_ring, name))) for name in _FORCES]
    return found + _weight(case, mass)


def _weight(case: Case, mass: float) -> FloatArray:
    return mass * np.array([case.gravity.x, case.gravity.y, case.gravity.z, 0.0, 0.0])


def held_directions(case: Case, ledger: Ledger) -> Held:
    """Return the held displacements of the inner ring.

    Tilts that the case leaves open are locked; others may be prescribed.
    """
    ring, found = case.bodies.inner_ring, []
    for name in POSE:
        mode = _mode(ring, name)
        written = name in ring.model_fields_set
        is_tilt = name.startswith("tilt")
        if mode not in (*_HELD_OR_FREE, *(("prescribed",) if is_tilt else ())):
            ways = "free, locked or prescribed" if is_tilt else "free or locked"
            ledger.problem(f"bodies.inner_ring.{name}", f"must be {ways} for roller bearings")
        found.append(mode in ("locked", "prescribed") or (is_tilt and not written))
        if found[-1] and _begins_away(case.bodies.outer_ring, name):
            ledger.problem(
                f"bodies.outer_ring.{name}",
                "must begin at zero: the inner ring of these rollers is locked along it",
            )
    if not {"tilt_y", "tilt_z"} & ring.model_fields_set:
        ledger.assume(STRAIGHT)
    x, y, z, tilt_y, tilt_z = found
    return x, y, z, tilt_y, tilt_z


def prescribed_pose(case: Case) -> FloatArray | None:
    """Return the prescribed pose of the inner ring, (5,).

    It is that at t = 0 [m, rad]; None where the case prescribes nothing.
    """
    motions = [getattr(getattr(case.bodies.inner_ring, name), "motion", None) for name in POSE]
    if all(motion is None for motion in motions):
        return None
    return np.array([0.0 if motion is None else initial(time_function(motion)) for motion in motions])


def _begins_away(ring: RingBody, name: str) -> bool:
    """Tell whether a motion begins away from zero."""
    motion = getattr(getattr(ring, name), "motion", None)
    return motion is not None and initial(time_function(motion)) != 0.0


def _mode(ring: RingBody, name: str) -> str:
    """Return how a ring is held in a direction."""
    holding = getattr(ring, name)
    return "spring" if getattr(holding, "stiffness", None) else str(getattr(holding, "mode", holding))


def as_outer_ring(case: Case, held: Held, loads: FloatArray, outer_loads: FloatArray) -> tuple[Held, tuple[str, ...]]:
    """Return what of the rings' relative pose is held.

    Also return the loose directions. Where the outer ring alone is free, it goes where no load is left.
    """
    found, loose = list(held), []
    for i, name in enumerate(POSE):
        mode = _mode(case.bodies.outer_ring, name)
        if mode == "free" and held[i]:
            found[i], loads[i] = False, -outer_loads[i]
        elif mode == "free" and loads[i] != 0.0:
            loose.append(name)
    x, y, z, tilt_y, tilt_z = found
    return (x, y, z, tilt_y, tilt_z), tuple(loose)


def outer_support(case: Case) -> FloatArray | None:
    """Return the stiffness of the outer ring's support.

    It is inf where the ring is rigid, (5,) [N/m, N m/rad]; None: everywhere.
    """
    found = [getattr(getattr(case.bodies.outer_ring, name), "stiffness", 0.0) or math.inf for name in POSE]
    return None if all(math.isinf(one) for one in found) else np.array(found)


def outer_ring_loads(case: Case, mass: float) -> FloatArray:
    """Return the loads on the outer ring [N, N m].

    They are those at t = 0, (5,), with the weight of its `mass` [kg].
    """
    found = np.zeros(len(POSE))
    if case.loads.outer_ring is not None:
        found += [initial(time_function(getattr(case.loads.outer_ring, name))) for name in _FORCES]
    return found + _weight(case, mass)
