"""The quasi-static equilibrium in the words of the machine interface."""

from __future__ import annotations

import dataclasses
import math

from pydantic import Field

from lambda_core.physics.channels import LOSSES
from lambda_core.physics.compiled import layout as L
from lambda_core.physics.compiled.observe import CONTACT_CHANNELS
from lambda_core.physics.equilibrium import Equilibrium
from lambda_core.physics.time_functions import initial
from lambda_core.simulate.averages import FloatArray, finite
from lambda_core.simulate.limits import Grooves, Shoulder, shoulders, warnings
from lambda_core.simulate.record import CARRYING, INTERFACE, Record
from lambda_core.simulate.summary import Contact, contact_list, merged_cage, span


class QuasiStatic(Record):
    """Loads, displacement, kinematics and friction without time; the cage is left out.

    Numbers that a ring at rest does not have (friction torque, film) are null.
    """

    interface: int = INTERFACE
    case: str
    title: str
    headline: str
    loaded_balls: int = Field(description="balls that the inner ring loads with more than 1 % of the largest load")
    max_load_N: float
    max_pressure_GPa: float
    friction_torque_Nmm: float | None = Field(description="dissipated power over |Omega_i - Omega_o|")
    friction_breakdown_Nmm: dict[str, float | None]
    orbit_speed_ratio: float | None = Field(description="mean orbital speed of the loaded balls over inner ring speed")
    contacts: list[Contact]
    inner_ring_displacement_um: list[float]
    inner_ring_tilt_mrad: list[float]
    film_um: list[float] = Field(description="smallest and largest central film under load")
    film_parameter: list[float] = Field(description="smallest and largest Lambda under load")
    shoulders: list[Shoulder] = Field(description="how near contacts come to the shoulders, the worst on each ring")
    warnings: list[str] = Field(description="where the state leaves what its laws are made for; empty when nowhere")
    iterations: int
    assumptions: list[str]

    def text(self) -> str:
        """Return the lines for people."""
        from lambda_core.simulate.text import quasistatic_text

        return quasistatic_text(self)


def quasistatic_of(found: Equilibrium) -> QuasiStatic:
    """Put an equilibrium into the units of the interface."""
    from lambda_core.physics.describe import headline

    model = found.assembly.model
    channels = {name: found.contacts[:, :, i] for i, name in enumerate(CONTACT_CHANNELS)}
    load = channels["load"]
    carrying = load > CARRYING * load.max()
    losses = dict(zip(LOSSES, found.losses.tolist(), strict=True))
    speed = found.relative_speed
    x, y, z, tilt_y, tilt_z = found.displacement
    edges = shoulders(
        Grooves.of(dataclasses.asdict(model.geometry)), load, channels["contact_angle"], channels["semi_axis_a"]
    )
    per_speed = {name: power / speed if speed > 0.0 else math.nan for name, power in losses.items()}
    return QuasiStatic(
        case=model.name,
        title=model.title,
        headline="\n".join(headline(model)),
        loaded_balls=int(carrying[:, 0].sum()),
        max_load_N=float(load.max()),
        max_pressure_GPa=1e-9 * float(channels["max_pressure"].max()),
        friction_torque_Nmm=finite(1e3 * sum(per_speed.values())),
        friction_breakdown_Nmm=merged_cage(per_speed),
        orbit_speed_ratio=finite(_ratio(found)),
        contacts=contact_list({**channels, "ball_azimuth": _azimuths(found)}),
        inner_ring_displacement_um=[1e6 * value for value in (x, y, z)],
        inner_ring_tilt_mrad=[1e3 * tilt_y, 1e3 * tilt_z],
        film_um=span(1e6 * channels["film_central"][carrying]),
        film_parameter=span(channels["film_parameter"][carrying]),
        shoulders=edges,
        warnings=warnings(model.oil.temperature, float(channels["max_pressure"].max()), edges),
        iterations=found.iterations,
        assumptions=list(model.assumptions),
    )


def _azimuths(found: Equilibrium) -> FloatArray:
    """Return the azimuth of each ball, shape (Z,) [rad]."""
    count = found.assembly.model.geometry.ball_count
    azimuths: FloatArray = found.state[: L.NB * count].reshape(count, L.NB)[:, L.BPSI]
    return azimuths


def _ratio(found: Equilibrium) -> float:
    """Return orbital over inner ring speed, both against the outer ring."""
    model = found.assembly.model
    inner, outer = (initial(body.dofs["spin"].motion) for body in (model.inner_ring, model.outer_ring))
    return (found.orbit - outer) / (inner - outer) if inner != outer else math.nan
