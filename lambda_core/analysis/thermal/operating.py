"""Find the temperatures of one bearing that is alone."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.thermal.feedback import PARTS, Loop, Steady, clearance_at, degrees, inlet_at, stated_clearance
from lambda_core.analysis.thermal.found_temperatures import FoundTemperatures
from lambda_core.analysis.thermal.losses import Announce, Losses, Point
from lambda_core.analysis.thermal.machine_network import MachineNetwork
from lambda_core.analysis.thermal.pillow_block import bearing_network
from lambda_core.analysis.thermal.surroundings import housing_area
from lambda_core.case.thermal import Thermal
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import ALONE
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.checking import resolve
from lambda_core.model.checks.describe import headline
from lambda_core.model.laws.time_functions import initial
from lambda_core.model.settings.resolve_thermal import network_assumptions

if TYPE_CHECKING:
    from lambda_core.model.machine_model import MachineModel

_ZERO_CELSIUS = 273.15


@dataclass(frozen=True)
class _Alone:
    """The only bearing of a case.

    Places count from its middle.
    """

    model: BearingModel
    name: str = ALONE
    position: float = 0.0


class BearingLoop(Loop):
    """Torque and temperature of one bearing alone.

    Parameters
    ----------
    model : BearingModel
        Resolved.
    thermal : Thermal
        Section of its case.
    announce : callable, optional
        Called with a sentence before something is compiled.
    """

    def __init__(self, model: BearingModel, thermal: Thermal, announce: Announce = None) -> None:
        super().__init__(model.name, bearing_network(model, thermal), thermal, model.oil.temperature)
        self.model, self.losses = model, Losses(model, announce)
        self.bearings, self.shaft = (_Alone(model),), (("shaft", 0.0),)
        self.speed = initial(model.inner_ring.dofs["spin"].motion)
        self.of_network = [*network_assumptions(thermal), *stated_clearance([model])]
        self.of_case = model.assumptions

    def nodes_with(self, change: Callable[[Thermal], Thermal]) -> MachineNetwork:
        """Return the network with a changed section of the case."""
        return bearing_network(self.model, change(self.thermal))

    @property
    def usual_area(self) -> float:
        """Outer surface of a usual housing [m2]."""
        return housing_area(self.model.geometry.outside_diameter)

    def seen(self, temperatures: FloatArray) -> FloatArray:
        """Return inlet temperature [K] and clearance [m]."""
        at = self.nodes.named(temperatures)
        return np.array([inlet_at(self.thermal, at), clearance_at(self.model, at)])

    def points_of(self, model: BearingModel | MachineModel) -> tuple[Point, ...]:
        """Return the point at the temperatures of a model."""
        (own,) = model.bearing_models.values()
        return (self.losses.at(own.oil.temperature, own.geometry.clearance),)

    def solved(self, seen: FloatArray) -> tuple[Point, ...]:
        """Solve and return the quasi-static point; see :meth:`Losses.at`."""
        return (self.losses.at(*seen.tolist()),)

    def grown(self, at: Mapping[str, float]) -> FloatArray:
        """Return zero.

        There is no length along which shaft and housing grow.
        """
        return np.zeros(1)

    def model_at(self, found: Steady, sentence: str = "", *, is_static: bool = True) -> BearingModel:
        """Return the model at found temperatures; see :class:`Loop`."""
        case, at = self.model.case, self.nodes.named(found.temperatures)
        warm = case.with_(
            assumptions=[*case.assumptions, *network_assumptions(case.thermal), sentence],
            lubricant={"temperature": degrees(found.points[0].inlet)},
            bearing={"temperatures": {part: degrees(at[part]) for part in PARTS if part in at}},
            operation={"temperatures": None},
        )
        return replace(resolve(warm, is_static=is_static), found_temperatures=FoundTemperatures(self, found))

    def words(self, found: Steady) -> str:
        """Return the temperatures of all parts and the oil [degC]."""
        at = self.nodes.named(found.temperatures)
        words = {name: name.replace("_", " ") for name in (*PARTS, "oil") if name in at} | {
            "balls": self.model.elements
        }
        return ", ".join(f"{words[name]} {at[name] - _ZERO_CELSIUS:.1f}" for name in words if name in at)

    def headline(self, points: Sequence[Point]) -> str:
        """Return the lines that describe the bearing at its point."""
        return "\n".join(headline(self.losses.there(points[0].inlet, points[0].clearance)))

    @property
    def count(self) -> int:
        """Quasi-static points that were solved."""
        return self.losses.count
