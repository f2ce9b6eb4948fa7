"""Compute lives and losses of machines over a duty cycle."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from pydantic import Field

from lambda_core.domain.number_text import hours, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.formulas.life import BALL_SLOPE, ROLLER_SLOPE, system_life
from lambda_core.results.averages import finite
from lambda_core.results.machine_numbers import total
from lambda_core.studies.duty_cycle import YEAR, CycleSum, DutyCycle, closing_lines, duty_table

SYSTEM = (
    "life of all bearings: L with sum (L/L_i)^e = 1, e = 10/9 for balls, 9/8 for rollers, from L_10rh of each over "
    "the cycle (Lundberg and Palmgren 1947, 1952; Harris and Kotzalas 2006)"
)


class MachineDutyCycle(CycleSum):
    """Sum of a machine's duty cycle.

    A life is null where a phase has none.
    """

    bearings: dict[str, DutyCycle] = Field(description="the cycle of each bearing by its name")
    system_life_h: float | None = Field(description="of all bearings by their reference rating lives, 90 %")
    mean_power_loss_W: float | None = Field(description="of all bearings")
    energy_loss_kJ: float | None = Field(description="of all bearings and phases, in one cycle")
    energy_loss_kWh_per_year: float | None = Field(description="of a cycle repeated without a pause, in 8766 h")
    warnings: list[str] = Field(description="geometric conflicts of parts on the shaft")
    assumptions: list[str]

    @property
    def lives(self) -> list[tuple[float | None, str]]:
        """Life of all bearings [h]."""
        return [(self.system_life_h, "of all bearings together")]

    def told(self) -> list[tuple[str, str]]:
        """Return all warnings, each with its phase.

        Those about the machine have none.
        """
        return [*(("", words) for words in self.warnings), *super().told()]

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
        return "\n".join([*lines, "", *closing_lines(self.told(), self.assumptions, units)])

    def __repr__(self) -> str:
        """Return cycle and system life."""
        life = "-" if self.system_life_h is None else hours(self.system_life_h)
        return f"<MachineDutyCycle {self.name} of {self.case}, system life {life}>"


def joined_bearings(
    name: str,
    case: str,
    bearings: dict[str, DutyCycle],
    of_rollers: Collection[str],
    warnings: list[str],
    assumptions: Sequence[str],
) -> MachineDutyCycle:
    """Join the sums of all bearings of a machine.

    Those in `of_rollers` have rollers.
    """
    each = bearings.values()
    known = {b: one.reference_life_h for b, one in bearings.items() if one.mean_speed_rpm > 0.0}
    lives = [life for life in known.values() if life is not None]
    slopes = [ROLLER_SLOPE if b in of_rollers else BALL_SLOPE for b, life in known.items() if life is not None]
    loss = total(one.mean_power_loss_W for one in each)
    return MachineDutyCycle(
        name=name,
        case=case,
        cycle_h=next(iter(each)).cycle_h,
        bearings=bearings,
        system_life_h=finite(system_life(lives, slopes)) if lives and len(lives) == len(known) else None,
        mean_power_loss_W=loss,
        energy_loss_kJ=total(one.energy_loss_kJ for one in each),
        energy_loss_kWh_per_year=None if loss is None else 1e-3 * loss * YEAR,
        warnings=warnings,
        assumptions=[*assumptions, SYSTEM],
    )
