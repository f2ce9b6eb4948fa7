"""Read results from equilibria at several positions of the balls."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from lambda_core.analysis.band.quantities import MEASURED, STIFFNESS, stiffness_reading
from lambda_core.case.case_io import toml_tables
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.domain.errors import UsageError
from lambda_core.domain.units import from_si, parse
from lambda_core.formulas.between_rings import between_rings
from lambda_core.formulas.life import life_hours, reference_rating_life
from lambda_core.formulas.loading import CARRYING
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.checks.operating_limits import ratings
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.stiffness import stiffness_matrix
from lambda_core.solver.records import CONTACT_CHANNELS

# Positions of the balls in pitches, equally weighted: half a pitch mirrors the other under a radial load, and two
# midpoints leave out all but the fourth harmonic of the ball pass.
POSITIONS = (0.125, 0.375)
_LOAD = CONTACT_CHANNELS.index("load")
UNITS_OF = {
    **{name: measured.unit for name, measured in MEASURED.items()},
    "maximum pressure": "GPa",
    "rating life": "h",
}
_SAME = 1e-6  # relative spread of the loads below which the position of the balls does not matter


def read_values(
    solved: Callable[[float], Equilibrium], readers: Sequence[Callable[[Equilibrium], float]], *, one: bool = False
) -> FloatArray:
    """Return what readers find in the equilibria.

    `solved` returns the equilibria at several positions of the balls.
    """
    found = []
    for position in POSITIONS[:1] if one else POSITIONS:
        equilibrium = solved(position)
        found.append([reader(equilibrium) for reader in readers])
        loads = equilibrium.contacts[:, 0, _LOAD]
        if np.ptp(loads) <= _SAME * loads.max():
            break
    return np.array(found)


def _torque(found: Equilibrium) -> float:
    if found.relative_speed <= 0.0:
        raise UsageError("a bearing at rest has no friction torque: remove the points at speed 0")
    return 1e3 * float(found.losses.sum()) / found.relative_speed


def _loss(found: Equilibrium) -> float:
    return float(found.losses.sum()) if found.relative_speed > 0.0 else 0.0


def _film(found: Equilibrium) -> float:
    if found.relative_speed <= 0.0:
        raise UsageError("a bearing at rest has no film: remove the points at speed 0")
    load = found.contacts[:, :, _LOAD]
    film = found.contacts[:, :, CONTACT_CHANNELS.index("film_minimum")]
    return 1e6 * float(film[load > CARRYING * load.max()].min())


def _pressure(found: Equilibrium) -> float:
    return 1e-9 * float(found.contacts[:, :, CONTACT_CHANNELS.index("max_pressure")].max())


def _capacitance(found: Equilibrium) -> float:
    return 1e9 * between_rings(found.contacts[:, :, CONTACT_CHANNELS.index("capacitance")])


def _life(found: Equilibrium) -> float:
    """Return L_10rh of ISO/TS 16281.

    It follows from the load of every ball.
    """
    model = found.context.model
    g = model.geometry
    life = reference_rating_life(
        *found.loads_by_row(),
        dynamic_rating=ratings(model)[0],
        gamma=g.ball_diameter * math.cos(g.contact_angle) / g.pitch_diameter,
        inner_conformity=g.groove_radius_inner / g.ball_diameter,
        outer_conformity=g.groove_radius_outer / g.ball_diameter,
        nominal_angle=g.contact_angle,
        rows=g.rated_rows,
    ).life
    return life_hours(life, found.relative_speed)


def _displacement(axis: int) -> Callable[[Equilibrium], float]:
    return lambda found: 1e6 * float(found.displacement[axis])


def _stiffness(name: str) -> Callable[[Equilibrium], float]:
    return lambda found: stiffness_reading(name, stiffness_matrix(found))


_PLACES = {
    "oil temperature": ("lubricant", "temperature"),
    **{f"{ring} ring temperature": ("bearing", "temperatures", f"{ring}_ring") for ring in RINGS},
}


def computed_temperature(model: BearingModel, name: str) -> float:
    """Return a computed temperature [degC].

    The case of the model has it; `name` is that of a quantity.
    """
    value: Any = toml_tables(model.case_toml, model.name)
    for part in _PLACES[name]:
        value = value[part]
    return from_si(parse(value, "temperature"), "temperature", "degC")


def _temperature(name: str) -> Callable[[Equilibrium], float]:
    return lambda found: computed_temperature(found.context.model, name)


READ: Mapping[str, Callable[[Equilibrium], float]] = {
    "friction torque": _torque,
    "power loss": _loss,
    "minimum film": _film,
    "maximum pressure": _pressure,
    "capacitance": _capacitance,
    "rating life": _life,
    "cage speed": lambda found: 30.0 / math.pi * abs(found.orbit),  # of a cage that follows the loaded balls
    **{f"displacement {axis}": _displacement(index) for index, axis in enumerate("xyz")},
    **{name: _stiffness(name) for name in STIFFNESS},
    **{name: _temperature(name) for name in _PLACES},
}
