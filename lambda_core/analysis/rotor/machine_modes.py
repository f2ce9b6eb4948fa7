"""Compute natural frequencies and critical speeds of a machine."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from pydantic import Field

from lambda_core.analysis.rotor.vibration import (
    Mode,
    bearing_damping,
    criticals,
    damped,
    housed_damping,
    housed_stiffness,
    modes_at,
    supported,
)
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.model.machine_model import MachineModel
from lambda_core.results.answer import Answer, dataset, drawn
from lambda_core.results.record import INTERFACE, Record
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.machine_statics import MachineState

_CAMPBELL = 9  # speeds
_SHOWN = 8  # modes
AXES = ("x", "y", "z", "tilt_x", "tilt_y", "tilt_z")


class BearingMatrices(Record):
    """Stiffness and damping of one bearing at the operating point."""

    name: str
    title: str
    position_mm: float = Field(description="of its middle, from the shaft's left end")
    force_N: list[float] = Field(description="of the bearing on the shaft: x, y, z")
    stiffness: list[list[float]] = Field(
        description="6 x 6, inner ring against outer ring, order of `axes` [N/m, N/rad, N m/rad]; no row turns about x"
    )
    housed_stiffness: list[list[float]] = Field(description="the same with the housing in series")
    damping: list[list[float]] = Field(
        description="6 x 6, of vibrations with the shaft's speed [N s/m, N s/rad, N m s/rad]; zeros at rest"
    )
    housed_damping: list[list[float]] = Field(description="the same with the housing in series")


class ModeAtSpeed(Record):
    """A natural frequency of the turning shaft."""

    frequency_Hz: float
    direction: float = Field(description="+1 whirls with the shaft, -1 against it, between: elliptic or in a line")
    kind: str = Field(
        description="motion of the shaft: bending (of a rigid one lateral), axial, torsion; body: of other bodies only"
    )
    bodies_share: float = Field(description="share of the kinetic energy in the other bodies")
    damping_ratio: float = Field(description="share of critical damping, by the bearings; 0 where it is left out")


class CampbellRow(Record):
    """Natural frequencies at one speed."""

    speed_rpm: float
    modes: list[ModeAtSpeed]


class CriticalSpeed(Record):
    """Speed at which the shaft whirls synchronously.

    It then whirls as fast as it turns.
    """

    speed_rpm: float
    direction: float
    kind: str = Field(description="how the shaft moves most: bending (of a rigid one lateral), axial, torsion")
    bodies_share: float = Field(description="share of the kinetic energy in the other bodies")


class MachineModes(Answer):
    """Natural frequencies and critical speeds of a machine.

    Its bearings are as stiff as at its operating point.
    """

    interface: int = INTERFACE
    case: str = Field(description="name of the case")
    speed_rpm: float = Field(description="of the shaft")
    axes: tuple[str, ...] = Field(default=AXES, description="order of rows and columns of the matrices")
    bearings: dict[str, BearingMatrices] = Field(description="each bearing by its name, from left to right")
    critical_speeds: list[CriticalSpeed] = Field(description="at which the shaft moves across its axis")
    modes: list[ModeAtSpeed] = Field(description="natural frequencies at this speed, damped by the bearings")
    campbell: list[CampbellRow] = Field(description="natural frequencies over speed, undamped")
    assumptions: list[str]

    def text(self, width: int | None = None, units: UnitSystem = SI) -> str:
        """Return the lines of text.

        None is longer than `width` where one is given.
        """
        from lambda_core.analysis.rotor.machine_text import modes_text

        return modes_text(self, width, units)

    def to_dict(self) -> dict[str, Any]:
        """Return plain data, ready for JSON."""
        return self.model_dump(mode="json")

    def plot(self, name: str = "whirl", **options: Any) -> Any:
        """Return natural frequencies over speed as matplotlib figure.

        The options are those of views.
        """
        return drawn(None, None, self, name, options)

    def to_xarray(self) -> Any:
        """Return natural frequencies as an xarray.Dataset.

        Speed is a dimension; UsageError when xarray is not installed.

        Returns
        -------
        xarray.Dataset
            Dimensions speed and mode, by rising frequency.
        """
        count = min((len(row.modes) for row in self.campbell), default=0)
        values = np.array([[mode.frequency_Hz for mode in row.modes[:count]] for row in self.campbell])
        data = {"frequency": (("speed", "mode"), values, {"units": "Hz", "long_name": "natural frequency"})}
        return dataset(data, {"speed": [row.speed_rpm for row in self.campbell]}, {"case": self.case})

    def __repr__(self) -> str:
        """Return case, speed and the first critical speed."""
        first = f", first critical speed {self.critical_speeds[0].speed_rpm:.5g} 1/min" if self.critical_speeds else ""
        return f"<MachineModes {self.case}, {self.speed_rpm:.5g} 1/min{first}>"


def modes_of(model: MachineModel, state: MachineState) -> MachineModes:
    """Return natural frequencies and critical speeds.

    They hold at an equilibrium, with the matrices of the bearings.
    """
    dampings = bearing_damping(model, [ring.equilibrium() for ring in state.rings])
    stiffness = supported(model, state)
    critical = criticals(model, stiffness)[:_SHOWN]
    matrices = zip(
        model.bearings, state.reactions, state.stiffness, housed_stiffness(model, state), dampings,
        housed_damping(model, state, dampings), strict=True,
    )  # fmt: skip
    return MachineModes(
        case=model.name,
        speed_rpm=30.0 / math.pi * model.speed,
        bearings={
            bearing.name: BearingMatrices(
                name=bearing.name, title=bearing.model.title, position_mm=1e3 * bearing.position,
                force_N=reaction[:3].tolist(), stiffness=six(own), housed_stiffness=six(housed),
                damping=damping.tolist(), housed_damping=in_housing.tolist(),
            )
            for bearing, reaction, own, housed, damping, in_housing in matrices
        },
        critical_speeds=[
            CriticalSpeed(
                speed_rpm=30.0 / math.pi * mode.frequency, direction=mode.direction, kind=mode.kind,
                bodies_share=mode.bodies_share,
            )
            for mode in critical
        ],
        modes=_modes(modes_at(model, stiffness, model.speed, damped(model, state, dampings))),
        campbell=[
            CampbellRow(speed_rpm=30.0 / math.pi * spin, modes=_modes(modes_at(model, stiffness, spin)))
            for spin in np.linspace(0.0, _fastest(model, critical), _CAMPBELL).tolist()
        ],
        assumptions=[
            "critical speeds, natural frequencies over speed: undamped, bearings as stiff as at this operating point"
        ],
    )  # fmt: skip


def modes_at_speed(model: MachineModel, state: MachineState, equilibria: Sequence[Equilibrium]) -> list[ModeAtSpeed]:
    """Return natural frequencies at an equilibrium's speed.

    The bearings damp them.
    """
    dampings = bearing_damping(model, equilibria)
    return _modes(modes_at(model, supported(model, state), model.speed, damped(model, state, dampings)))


def six(matrix: FloatArray) -> list[list[float]]:
    """Return a matrix over POSE.

    The row and column of turning about x are zero.
    """
    rows: list[list[float]] = np.insert(np.insert(matrix, 3, 0.0, axis=0), 3, 0.0, axis=1).tolist()
    return rows


def _fastest(model: MachineModel, critical: list[Mode]) -> float:
    """Return the end of the whirl's speeds [rad/s].

    It is beyond the first critical ones.
    """
    return max(2.0 * abs(model.speed), *(1.2 * mode.frequency for mode in critical[:2]), 1.0)


def _modes(found: list[Mode]) -> list[ModeAtSpeed]:
    return [
        ModeAtSpeed(
            frequency_Hz=mode.frequency / (2.0 * math.pi), direction=mode.direction, kind=mode.kind,
            bodies_share=mode.bodies_share, damping_ratio=mode.damping,
        )
        for mode in found[:_SHOWN]
    ]  # fmt: skip
