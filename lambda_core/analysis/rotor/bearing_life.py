"""Rating lives and static safety of the bearings on a shaft, by the loads that they carry there."""

from __future__ import annotations

import math
from dataclasses import dataclass

from lambda_core.formulas.life import (
    basic_rating_life,
    dynamic_equivalent_load,
    life_hours,
    life_modification_factor,
    reference_rating_life,
    reference_viscosity,
    static_equivalent_load,
)
from lambda_core.formulas.ratings import static_factor
from lambda_core.model.machine_model import MountedBearing
from lambda_core.solver.drivers.equilibrium import Equilibrium

_LEAST_RATIO = 0.1  # kappa of ISO 281's a_ISO


@dataclass(frozen=True)
class BearingLife:
    """Lives [h] and safety; None where there is none."""

    equivalent_load: float  # P of ISO 281 [N]
    basic: float  # L_10h
    reference: float  # L_10rh of ISO/TS 16281
    modified_basic: float | None  # L_nmh of ISO 281
    modified: float | None  # L_nmrh
    viscosity_ratio: float | None
    static_safety: float  # C_0/P_0


def bearing_life(bearing: MountedBearing, found: Equilibrium, radial: float, axial: float) -> BearingLife:
    """Return what the standards say of a bearing.

    Parameters
    ----------
    found : Equilibrium
        With the load of every ball.
    radial, axial : float
        What the bearing carries [N].
    """
    g, angle, speed = bearing.model.geometry, bearing.nominal_angle, found.relative_speed
    gamma = g.ball_diameter * math.cos(angle) / g.pitch_diameter
    factor, kind, aligning = static_factor(gamma, on_sphere=g.kind.on_sphere), (angle, g.rated_rows), g.kind.on_sphere
    load = dynamic_equivalent_load(radial, axial, bearing.static_rating, factor, *kind, on_sphere=aligning).load
    reference = reference_rating_life(
        *found.loads_by_row(),
        dynamic_rating=bearing.dynamic_rating,
        gamma=gamma,
        inner_conformity=g.groove_radius_inner / g.ball_diameter,
        outer_conformity=g.groove_radius_outer / g.ball_diameter,
        nominal_angle=angle,
        rows=g.rated_rows,
    )
    ratio = modified = modified_basic = None
    contamination, basic = bearing.model.contamination, basic_rating_life(bearing.dynamic_rating, load)
    if speed > 0.0:
        oil = found.context.oil
        ratio = oil.viscosity / oil.density / reference_viscosity(speed, g.pitch_diameter)
        if contamination is not None and ratio >= _LEAST_RATIO:
            dirt = ratio, contamination, bearing.fatigue_limit
            modified_basic = life_hours(life_modification_factor(*dirt, load) * basic, speed)
            modified = life_hours(life_modification_factor(*dirt, reference.equivalent_load) * reference.life, speed)
    static_load = static_equivalent_load(radial, axial, *kind, on_sphere=aligning)
    return BearingLife(
        load,
        life_hours(basic, speed),
        life_hours(reference.life, speed),
        modified_basic,
        modified,
        ratio,
        bearing.static_rating / static_load if static_load > 0.0 else math.inf,
    )
