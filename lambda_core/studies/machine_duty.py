"""Compute lives and losses of machines over a duty cycle."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from pydantic import Field

from lambda_core.analysis.rotor.machine_equilibrium import BearingEquilibrium, MachineEquilibrium, equilibrium_of
from lambda_core.analysis.thermal.machine_temperatures import ready_machine_of
from lambda_core.case.machine import MachineCase
from lambda_core.domain.number_text import hours, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.formulas.life import system_life
from lambda_core.results.averages import finite
from lambda_core.results.record import INTERFACE, Record
from lambda_core.solver.drivers.machine_statics import SharedKernels, solve_machine
from lambda_core.studies.duty_cycle import YEAR, DutyCycle, PhaseResult, duty_table, summed_phases

SYSTEM = (
    "life of all bearings: (sum L_i^-e)^(-1/e), e = 10/9 for balls, from L_10rh of each over the cycle "
    "(Lundberg and Palmgren 1947; Harris and Kotzalas 2006)"
)


class MachineDutyCycle(Record):
    """Sum of a machine's duty cycle.

    A life is null where a phase has none.
    """

    interface: int = INTERFACE
    name: str
    case: str
    cycle_h: float = Field(description="duration of one cycle")
    bearings: dict[str, DutyCycle] = Field(description="the cycle of each bearing by its name")
    system_life_h: float | None = Field(description="of all bearings by their reference rating lives, 90 %")
    mean_power_loss_W: float | None = Field(description="of all bearings")
    energy_loss_kJ: float | None = Field(description="of all bearings and phases, in one cycle")
    energy_loss_kWh_per_year: float | None = Field(description="of a cycle repeated without a pause, in 8766 h")
    warnings: list[str] = Field(description="geometric conflicts of parts on the shaft")
    assumptions: list[str]

    def text(self, units: UnitSystem = SI) -> str:
        """Return the table of each bearing.

        The table of all bearings together follows.
        """
        lines = [f"{self.name}: a cycle of {number(self.cycle_h, 2)} h of {self.case}"]
        for name, own in self.bearings.items():
            lines += ["", name, *duty_table(own, units)]
        life = "-" if self.system_life_h is None else hours(self.system_life_h)
        lines += [
            "",
            f"system life   {life} (L10rh of all bearings)",
            f"power loss    {units.text(self.mean_power_loss_W, 'W')} in the mean",
            f"energy        {number(self.energy_loss_kJ)} kJ are lost in a cycle, "
            f"{number(self.energy_loss_kWh_per_year)} kWh in a year of cycles without a pause",
        ]
        told = [*self.warnings]
        for name, own in self.bearings.items():
            told += [f"{phase.name}: {name}: {text}" for phase in own.phases for text in phase.warnings]
        lines += ["", *(f"WARNING  {units.sentence(text)}" for text in told)]
        return "\n".join([*lines, *(f"assumed  {text}" for text in self.assumptions)])

    def to_dict(self) -> dict[str, Any]:
        """Return plain data, ready for JSON."""
        return self.model_dump(mode="json")

    def __repr__(self) -> str:
        """Return cycle and system life."""
        life = "-" if self.system_life_h is None else hours(self.system_life_h)
        return f"<MachineDutyCycle {self.name} of {self.case}, system life {life}>"


@dataclass
class MachinePhases:
    """Phases of a machine, solved in order.

    Laws are compiled once.
    """

    announce: Callable[[str], None] | None = None
    kernels: SharedKernels = field(init=False)

    def __post_init__(self) -> None:
        self.kernels = SharedKernels(self.announce)

    def solved_case(self, case: MachineCase, changes: Sequence[str]) -> MachineEquilibrium:
        """Return the equilibrium of one phase.

        SolverError where there is none.
        """
        model = ready_machine_of(case, changes, self.announce)
        return equilibrium_of(model, solve_machine(model, self.announce, self.kernels))


def added_machine(
    name: str, case: str, phases: Sequence[tuple[str, float]], found: Sequence[MachineEquilibrium],
    assumptions: Sequence[str],
) -> MachineDutyCycle:  # fmt: skip
    """Add up the phases of a machine.

    Parameters
    ----------
    phases : sequence of (str, float)
        Name and time of each [s].
    found : sequence of MachineEquilibrium
        Of each phase.
    """
    total_time = sum(time for _, time in phases)
    bearings = {}
    for number_, first in enumerate(found[0].bearings):
        own = [
            _phase(phase, time, time / total_time, state, state.bearings[number_])
            for (phase, time), state in zip(phases, found, strict=True)
        ]
        bearings[first.name] = summed_phases(name, f"{case}, {first.name}", total_time, own, assumptions)
    lives = [one.reference_life_h for one in bearings.values()]
    damaging = [one for one in bearings.values() if one.mean_speed_rpm > 0.0]
    known = [one.reference_life_h for one in damaging if one.reference_life_h is not None]
    loss = _total([one.mean_power_loss_W for one in bearings.values()])
    return MachineDutyCycle(
        name=name,
        case=case,
        cycle_h=total_time / 3600.0,
        bearings=bearings,
        system_life_h=finite(system_life(known)) if any(lives) and len(known) == len(damaging) else None,
        mean_power_loss_W=loss,
        energy_loss_kJ=_total([one.energy_loss_kJ for one in bearings.values()]),
        energy_loss_kWh_per_year=None if loss is None else 1e-3 * loss * YEAR,
        warnings=list(dict.fromkeys(text for state in found for text in state.warnings)),
        assumptions=[*assumptions, SYSTEM],
    )


def _phase(name: str, time: float, share: float, state: MachineEquilibrium, bearing: BearingEquilibrium) -> PhaseResult:
    """Return one bearing in one phase."""
    speed, loss = abs(state.speed_rpm), bearing.power_loss_W
    return PhaseResult(
        name=name,
        share=share,
        speed_rpm=speed,
        equivalent_load_N=bearing.rating.equivalent_load_N,
        basic_life_h=bearing.rating.basic_life_h if speed else None,
        reference_life_h=bearing.rating.reference_life_h if speed else None,
        damage=None,
        friction_torque_Nmm=bearing.friction_torque_Nmm if speed else None,
        power_loss_W=loss if speed else 0.0,
        energy_loss_kJ=0.0 if not speed else None if loss is None else 1e-3 * loss * time,
        warnings=bearing.warnings,
    )


def _total(values: Sequence[float | None]) -> float | None:
    """Return a sum.

    None where a part of it is not known.
    """
    return None if None in values else math.fsum(value for value in values if value is not None)
