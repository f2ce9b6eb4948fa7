"""Tabulate losses over inlet temperature and clearance.

The temperatures change two numbers that the laws of the contacts see: the temperature of the oil at their inlets and
the clearance in operation.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from lambda_core.analysis.thermal.conductances import (
    effusivity,
    resting_contact,
    rolling_contact,
)
from lambda_core.analysis.thermal.roller_losses import roller_extras, roller_losses
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import LOSSES
from lambda_core.domain.errors import SolverError
from lambda_core.formulas.loading import CARRYING
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.geometry.resolve_geometry import with_clearance
from lambda_core.model.roller_case import RollerModel, roller_model, rollers_at_rest
from lambda_core.model.rollers_in_motion import with_clearance as rollers_with_clearance
from lambda_core.results.roller_quasistatic import solve_rollers
from lambda_core.solver.drivers.compiled_laws import Kernels
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.records import CONTACT_CHANNELS

Announce = Callable[[str], None] | None
_ZERO_CELSIUS = 273.15
# What a point carries behind its losses by mechanism.
_EXTRAS = ("contact_inner", "contact_outer", "viscosity", "density", "orbit", "torque", "pressure", "film", "parameter")


@dataclass(frozen=True)
class Point:
    """One quasi-static point.

    Attributes
    ----------
    inlet, clearance : float
        Where it is: temperature of the oil at the inlets [K], radial internal clearance [m].
    values : float64[:], shape (25,)
        Losses by mechanism [W]; conductance of all contacts of a ring [W/K], inner, outer; kinematic viscosity [m2/s]
        and density [kg/m3] of the oil; orbital speed [rad/s]; friction torque [N m], largest pressure [Pa], smallest
        central film under load [m] and smallest Lambda.
    """

    inlet: float
    clearance: float
    values: FloatArray

    def __getitem__(self, name: str) -> float:
        """Return one number by its name."""
        return float(self.values[len(LOSSES) + _EXTRAS.index(name)])

    def with_losses(self, losses: Mapping[str, float]) -> Point:
        """Return the point with other losses [W].

        The losses are averages of a run by mechanism.
        """
        values = self.values.copy()
        values[: len(LOSSES)] = [losses[name] for name in LOSSES]
        torque = len(LOSSES) + _EXTRAS.index("torque")
        values[torque] *= values[: len(LOSSES)].sum() / self.power
        return Point(self.inlet, self.clearance, values)

    def towards(self, other: Point, share: float) -> Point:
        """Return the point towards another one.

        The new point lies at a share of the way.
        """
        return Point(
            self.inlet + share * (other.inlet - self.inlet),
            self.clearance + share * (other.clearance - self.clearance),
            self.values + share * (other.values - self.values),
        )

    @property
    def losses(self) -> dict[str, float]:
        """Power by mechanism [W]."""
        return dict(zip(LOSSES, self.values.tolist(), strict=False))

    @property
    def power(self) -> float:
        """Dissipated power [W]."""
        return float(self.values[: len(LOSSES)].sum())


class Losses:
    """The quasi-static points of one model.

    Parameters
    ----------
    model : BearingModel
        Resolved; its temperatures may still have to be found.
    announce : callable, optional
        Called with a sentence before something is compiled.
    """

    def __init__(self, model: BearingModel, announce: Announce = None) -> None:
        self.model = dataclasses.replace(model, thermal=None)
        self.count = 0  # points that were solved
        self._announce = announce
        self._rollers = None if model.rollers is None else rollers_at_rest(self.model)
        self._kernels = None if self._rollers is not None else Kernels(self.model, announce)

    def at(self, inlet: float, clearance: float) -> Point:
        """Solve the point at temperature [K] and clearance [m].

        The temperature is that of the inlet.

        Raises
        ------
        SolverError
            When there is no equilibrium there, with the place.
        """
        self.count += 1
        try:
            there = self.there(inlet, clearance)
            if self._rollers is None:
                return point_of(solve(there, self._kernels, self._announce))
            return point_of_rollers(there, _warm(self._rollers, there))
        except SolverError as error:
            place = f"at {inlet - _ZERO_CELSIUS:.1f} degC in the inlets and a clearance of {1e6 * clearance:.1f} um"
            raise SolverError(f"{place}: {error}") from error

    def there(self, inlet: float, clearance: float) -> BearingModel:
        """Return the model at temperature [K] and clearance [m].

        The temperature is that of the inlet.
        """
        return model_at(self.model, inlet, clearance)


def model_at(model: BearingModel, inlet: float, clearance: float) -> BearingModel:
    """Return a model at inlet temperature [K] and clearance [m]."""
    return dataclasses.replace(
        model,
        geometry=with_clearance(model.geometry, clearance),
        rollers=model.rollers and rollers_with_clearance(model.rollers, clearance),
        oil=dataclasses.replace(model.oil, temperature=inlet),
    )


def _warm(rollers: RollerModel, model: BearingModel) -> RollerModel:
    """Return rollers with clearance and oil of a model."""
    case = model.case
    warmer = roller_model(case, (f"lubricant.temperature={model.oil.temperature!r} K",))
    assert warmer is not None
    assert model.rollers is not None
    return dataclasses.replace(rollers, bearing=model.rollers, oil=warmer.oil)


def point_of_rollers(model: BearingModel, rollers: RollerModel) -> Point:
    """Return the point of rollers under their load."""
    solved = solve_rollers(dataclasses.replace(rollers, dielectric=None))  # losses need no capacitance
    materials = {"ball": model.ball_material, "inner": model.inner_material, "outer": model.outer_material}
    extras = roller_extras(solved, rollers, materials)
    values = [*roller_losses(solved, rollers.bearing), *(extras[name] for name in _EXTRAS)]
    return Point(model.oil.temperature, model.geometry.clearance, np.array(values))


def point_of(found: Equilibrium) -> Point:
    """Return the point of an equilibrium of balls."""
    model, oil = found.context.model, found.context.oil
    channel = {name: found.contacts[:, :, i] for i, name in enumerate(CONTACT_CHANNELS)}
    carrying = channel["load"] > CARRYING * channel["load"].max()
    films, parameters = channel["film_central"][carrying], channel["film_parameter"][carrying]
    power, speed = float(found.losses.sum()), found.relative_speed
    extras = (
        *contact_conductances(found),
        oil.viscosity / oil.density,
        oil.density,
        found.orbit,
        power / speed if speed > 0.0 else math.nan,
        float(channel["max_pressure"].max()),
        float(films.min()) if films.size else math.nan,
        float(parameters.min()) if parameters.size else math.nan,
    )
    return Point(oil.temperature, model.geometry.clearance, np.array([*found.losses, *extras]))


def contact_conductances(found: Equilibrium) -> tuple[float, float]:
    """Return the conductances of both rings' contacts [W/K].

    The inner ring comes first; the heat flows through all contacts with the rolling elements.
    """
    model = found.context.model
    ball, oil = model.ball_material, found.context.oil
    total = [0.0, 0.0]
    for i, ring in enumerate((model.inner_material, model.outer_material)):
        mean = 2.0 / (1.0 / ball.thermal_conductivity + 1.0 / ring.thermal_conductivity)
        for contact in found.contacts[:, i]:
            value = dict(zip(CONTACT_CHANNELS, contact.tolist(), strict=True))
            if value["load"] <= 0.0:
                continue
            a, b, film = value["semi_axis_a"], value["semi_axis_b"], max(value["film_central"], 1e-9)
            rest = abs(value["entrainment"]), oil.thermal_conductivity / film, effusivity(ball), effusivity(ring)
            total[i] += max(rolling_contact(a, b, *rest), resting_contact(a, b, mean))
    return total[0], total[1]


class LossMap:
    """Interpolated points of a grid.

    The grid is solved where it is needed, linear in each of its cells.

    A cell is 2 K by 1 um: the loss of an oil whose viscosity halves in 20 K is met to 1.5e-3 in the middle of a cell.
    Continuous, so that an integrator can step over it.
    """

    INLET = 2.0  # [K]
    CLEARANCE = 1e-6  # [m]

    def __init__(self, solve: Callable[[float, float], Point], inlet: float, clearance: float) -> None:
        self._solve = solve
        self._origin = (inlet, clearance)
        self._known: dict[tuple[int, int], FloatArray] = {}

    def at(self, inlet: float, clearance: float) -> Point:
        """Return the point at temperature [K] and clearance [m].

        The temperature is that of the inlet; see :meth:`Losses.at`.
        """
        x = (inlet - self._origin[0]) / self.INLET
        y = (clearance - self._origin[1]) / self.CLEARANCE
        i, j = math.floor(x), math.floor(y)
        u, v = x - i, y - j
        corners = ((i, j, (1 - u) * (1 - v)), (i + 1, j, u * (1 - v)), (i, j + 1, (1 - u) * v), (i + 1, j + 1, u * v))
        values = sum(weight * self._corner(k, m) for k, m, weight in corners if weight > 0.0)
        return Point(inlet, clearance, np.asarray(values))

    def _corner(self, i: int, j: int) -> FloatArray:
        if (i, j) not in self._known:
            inlet, clearance = self._origin[0] + i * self.INLET, self._origin[1] + j * self.CLEARANCE
            self._known[i, j] = self._solve(inlet, clearance).values
        return self._known[i, j]
