"""Take losses and conductances of rollers from their operating point.

It is the equilibrium that operating points, shafts and bands ask: rollers roll without sliding.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import get_args

import numpy as np

from lambda_core.analysis.thermal.conductances import effusivity, resting_line, rolling_line
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import LOSSES
from lambda_core.elements.roller.line_contact import half_width
from lambda_core.elements.roller.roller_bearing import Ring, RollerBearing
from lambda_core.elements.roller.roller_equilibrium import RollerEquilibrium
from lambda_core.elements.roller.roller_friction import RollerFriction
from lambda_core.formulas.loading import carries
from lambda_core.laws.context import Material
from lambda_core.model.roller_case import RollerModel
from lambda_core.results.roller_quasistatic import SolvedRollers, largest_pressure

_THINNEST = 1e-9  # [m] film whose resistance counts


def roller_losses(solved: SolvedRollers, bearing: RollerBearing) -> FloatArray:
    """Return the power by mechanism [W], ordered as LOSSES.

    Friction of ribs slides: each ring has the share of its ribs in their load.
    """
    found = solved.friction
    torque = dict.fromkeys(LOSSES, 0.0)
    if found is not None:
        shares = _shares_of_ribs(bearing, solved.state)
        for ring in get_args(Ring):
            torque[f"rolling_{ring}"] = found.rolling[ring]
            torque[f"hysteresis_{ring}"] = found.hysteresis[ring]
            torque[f"sliding_{ring}"] = found.sliding[ring] + shares[ring] * found.rib
        torque["drag"] = found.drag
    return abs(solved.motion.relative) * np.array([*torque.values()])


def _shares_of_ribs(bearing: RollerBearing, state: RollerEquilibrium) -> Mapping[str, float]:
    """Return each ring's share of the ribs' load."""
    loads = dict.fromkeys(get_args(Ring), 0.0)
    for i, rib in enumerate(bearing.ribs):
        loads[rib.ring] += float(state.ribs[:, i].sum())
    total = sum(loads.values())
    return {ring: load / total if total > 0.0 else 0.0 for ring, load in loads.items()}


def roller_extras(solved: SolvedRollers, model: RollerModel, materials: Mapping[str, Material]) -> dict[str, float]:
    """Return what a thermal point has besides losses.

    Parameters
    ----------
    materials : mapping
        Of "ball" (the rollers), "inner" and "outer" ring.
    """
    found, speed = solved.friction or RollerFriction(), abs(solved.motion.relative)
    loads = {"inner": solved.state.inner, "outer": solved.state.outer}
    films = [film[carries(loads[ring].sum(axis=1))] for ring, film in found.contact_film.items()]
    carrying = np.concatenate(films) if films else np.zeros(0)
    inner, outer = (math.fsum(_conductances(solved, model, materials, ring)) for ring in get_args(Ring))
    return {
        "contact_inner": inner,
        "contact_outer": outer,
        "viscosity": model.oil.kinematic,
        "density": model.oil.density,
        "orbit": solved.motion.cage,
        "torque": found.total if speed > 0.0 else math.nan,
        "pressure": max(largest_pressure(model.bearing, one) for one in solved.states),
        "film": float(carrying.min()) if carrying.size else math.nan,
        "parameter": min(found.film_parameter.values(), default=math.nan),
    }


def _conductances(
    solved: SolvedRollers, model: RollerModel, materials: Mapping[str, Material], ring: Ring
) -> Iterator[float]:
    """Yield the conductance of every roller with a ring [W/K].

    Every lamina that rolls has its own width; at rest the length that carries has the largest one.
    """
    bearing, oil, found = model.bearing, model.oil, solved.friction
    loads = solved.state.inner if ring == "inner" else solved.state.outer
    width, radius, modulus = bearing.effective_length / loads.shape[1], bearing.radius(ring), bearing.modulus(ring)
    roller, own = materials["ball"], materials[ring]
    mean = 2.0 / (1.0 / roller.thermal_conductivity + 1.0 / own.thermal_conductivity)
    for j, each in enumerate(loads):
        total = float(each.sum())
        if total <= 0.0:
            continue
        length = width * float(np.sum(np.sqrt(each))) ** 2 / total
        halves = half_width(each[each > 0.0] / width, radius, modulus)
        resting = resting_line(length, float(halves.max()), mean)
        if found is None:
            yield resting
            continue
        film = max(float(found.contact_film[ring][j]), _THINNEST)
        through = oil.conductivity / film, effusivity(roller), effusivity(own)
        rolling = math.fsum(rolling_line(width, half, solved.motion.entrainment, *through) for half in halves.tolist())
        yield max(rolling, resting)
