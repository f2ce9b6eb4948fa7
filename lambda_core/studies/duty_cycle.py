"""Compute life and losses over a duty cycle.

The damage of the phases adds (Palmgren 1924, Z. VDI 68, 339; Miner 1945, J. Appl. Mech. 12, A159): a bearing that
would live L_i under phase i alone lives T/sum(t_i/L_i) under all of them, T = sum(t_i). All phases load the same place
of the raceways; where the load wanders the bearing lives longer.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from pydantic import Field, ValidationError, model_validator

from lambda_core.analysis.thermal.temperatures import ready
from lambda_core.case.case import Case
from lambda_core.case.case_io import apply_overrides, read_case, syntax_problem
from lambda_core.case.machine import MachineCase
from lambda_core.case.option import NAME_PATTERN, Section, option
from lambda_core.case.problems import problems
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.elements import ALONE
from lambda_core.domain.errors import CaseError, Problem, SolverError, UsageError
from lambda_core.domain.files import read_text
from lambda_core.domain.number_text import hours_alone, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.domain.units import Time
from lambda_core.elements.roller.roller_life import LIFE_EXPONENT
from lambda_core.results.averages import finite
from lambda_core.results.machine_numbers import total
from lambda_core.results.record import INTERFACE, Record, by_bearing
from lambda_core.studies.job import solved_point
from lambda_core.studies.load_spectrum import read_spectrum

if TYPE_CHECKING:
    from lambda_core.results.quasistatic import BearingStatics
    from lambda_core.studies.machine_duty import MachineDutyCycle

Solved = TypeVar("Solved")
_MOST_PHASES = 1000
YEAR = 8766.0  # [h], 365.25 days
_BALLS = 3.0  # exponent of ball bearings: L = (C/P)^3


class Phase(Section):
    """One part of a duty cycle."""

    name: str = option(description="name of the phase in the answer", min_length=1)
    time: Time = option(description="how long it lasts in one cycle", gt=0.0)
    changes: dict[str, bool | int | float | str] = option({}, "what differs from the case: option and value")


class Cycle(Section):
    """Duty cycle of a case with phases."""

    name: str = option(description="short name", pattern=NAME_PATTERN)
    case: str = option(description="case file, relative to this one, or built-in case", min_length=1)
    phases: list[Phase] = option([], "one after the other", max_length=_MOST_PHASES)
    spectrum: str | None = option(None, "CSV file with a phase in each line, in place of phases", min_length=1)

    @model_validator(mode="after")
    def _one_of(self) -> Cycle:
        if bool(self.phases) == (self.spectrum is not None):
            raise ValueError("give either [[phases]] or a spectrum")
        return self


class PhaseResult(Record):
    """Result of one phase alone.

    Null where a standard does not answer, or nothing turns.
    """

    name: str
    share: float = Field(description="of the time")
    speed_rpm: float = Field(description="of the rings against each other")
    equivalent_load_N: float | None = Field(description="P of ISO 281")
    basic_life_h: float | None = Field(description="L_10h of ISO 281, if the phase continued for ever")
    reference_life_h: float | None = Field(description="L_10rh of ISO/TS 16281, if the phase continued for ever")
    damage: float | None = Field(description="share of the damage by ISO/TS 16281")
    friction_torque_Nmm: float | None = Field(description="quasi-static, without cage")
    power_loss_W: float | None = Field(description="null where the balls have no steady motion")
    energy_loss_kJ: float | None = Field(description="in one cycle")
    warnings: list[str]


class CycleSum(Record):
    """Sum of the duty cycle of a bearing or machine."""

    interface: int = INTERFACE
    name: str
    case: str
    cycle_h: float = Field(description="duration of one cycle")

    if TYPE_CHECKING:

        @property
        def bearings(self) -> Mapping[str, DutyCycle]:
            """Cycle of each bearing by name; a field of machines."""

    @property
    def lives(self) -> list[tuple[float | None, str]]:
        """Lives [h] with what they are; the decisive one first."""
        raise NotImplementedError

    def to_dict(self) -> dict[str, Any]:
        """Return plain data, ready for JSON."""
        return self.model_dump(mode="json")

    def told(self) -> list[tuple[str, str]]:
        """Return all warnings, each with its phase."""
        return [
            (phase.name, f"{name}: {words}" if len(self.bearings) > 1 else words)
            for name, own in self.bearings.items()
            for phase in own.phases
            for words in phase.warnings
        ]


class DutyCycle(CycleSum):
    """Sum of a duty cycle.

    A life is null where a phase has none.
    """

    phases: list[PhaseResult]
    basic_life_h: float | None = Field(description="L_10h of ISO 281, damages added")
    reference_life_h: float | None = Field(description="L_10rh of ISO/TS 16281, damages added")
    mean_load_N: float | None = Field(description="constant P of equal basic rating life at the mean speed")
    mean_speed_rpm: float
    mean_power_loss_W: float | None
    energy_loss_kJ: float | None = Field(description="of all phases, in one cycle")
    energy_loss_kWh_per_year: float | None = Field(description="of a cycle that is repeated without a pause, in 8766 h")
    assumptions: list[str]

    @property
    def bearings(self) -> Mapping[str, DutyCycle]:
        """This cycle by the name that results give the bearing."""
        return {ALONE: self}

    def to_dict(self) -> dict[str, Any]:
        """Return plain data, ready for JSON.

        The cycle of the bearing is in ``bearings``, by its name, as in a machine.
        """
        (name,) = self.bearings
        losses = ("mean_power_loss_W", "energy_loss_kJ", "energy_loss_kWh_per_year")
        around = (*CycleSum.model_fields, "assumptions")
        return by_bearing(self, name, around, losses, system_life_h=self.reference_life_h)

    @property
    def lives(self) -> list[tuple[float | None, str]]:
        """Reference and basic rating life [h]."""
        return [(self.reference_life_h, "(ISO/TS 16281)"), (self.basic_life_h, "(ISO 281), damages added")]

    def text(self, units: UnitSystem = SI) -> str:
        """Return the table of phases.

        Each phase has a row; the sum follows.
        """
        lines = [f"{self.name}: a cycle of {number(self.cycle_h, 2)} h of {self.case}", ""]
        lines += [
            *duty_table(self, units),
            "",
            f"energy   {number(self.energy_loss_kJ)} kJ are lost in a cycle, "
            f"{number(self.energy_loss_kWh_per_year)} kWh in a year of cycles without a pause",
        ]
        return "\n".join([*lines, "", *closing_lines(self.told(), self.assumptions, units)])


def closing_lines(told: Sequence[tuple[str, str]], assumptions: Sequence[str], units: UnitSystem) -> list[str]:
    """Return warnings with their phases, then assumptions."""
    warned = [f"WARNING  {f'{phase}: ' if phase else ''}{units.sentence(words)}" for phase, words in told]
    return [*warned, *(f"assumed  {text}" for text in assumptions)]


def duty_table(found: DutyCycle, units: UnitSystem) -> list[str]:
    """Return a row per phase, and one of them together."""
    force, torque = units.unit("N"), units.unit("N mm")
    head = (
        "phase", "time %", "rpm", f"P {force}", "L10h", "L10rh", "damage %", f"torque {torque}",
        f"loss {units.unit('W')}", "energy kJ",
    )  # fmt: skip
    rows = [head, *(_row(phase, units) for phase in found.phases), _sum_row(found, units)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(head))]
    return ["  ".join([row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])]) for row in rows]


_ADDED = (
    "damages of the phases add (Palmgren, Miner), each by its L_10rh; all load the same place of the raceways",
    "every phase at its quasi-static equilibrium: no cage, nothing of what lies between two phases",
)


@dataclass(frozen=True)
class _Step:
    """One phase to solve.

    It has a name, the place of its mistakes, a time [s] and its changes.
    """

    name: str
    where: str
    time: float
    changes: tuple[str, ...]


class SolvedPhase(NamedTuple):
    """Answer of one phase.

    The speed of the rings against each other [1/min], every bearing by its name, and warnings of a machine.
    """

    speed_rpm: float
    bearings: Mapping[str, BearingStatics]
    warnings: Sequence[str]


@one_blas_thread()
def duty(
    source: str | Path | Mapping[str, Any], *, announce: Callable[[str], None] | None = None
) -> DutyCycle | MachineDutyCycle:
    """Solve a duty cycle and add up life and losses.

    Parameters
    ----------
    source : path-like or mapping
        File of the duty cycle (TOML), or its tables. Its case is one bearing, or a machine of several.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    DutyCycle or MachineDutyCycle
        Each phase, and the sum: life by ISO 281 and ISO/TS 16281, mean load, mean loss; of a machine that of every
        bearing, and the life of all of them.

    Raises
    ------
    UsageError
        When the file does not exist.
    CaseError, SolverError
        With a sentence about the cycle, or about a phase that is named.
    """
    cycle, case, steps = _read(source)
    found = [_at(step, case.name, partial(_solved, case, announce, step.changes)) for step in steps]
    if isinstance(case, Case):
        return _cycles(cycle.name, {ALONE: case.name}, steps, found)[ALONE]
    from lambda_core.studies.machine_duty import joined_bearings

    names = {name: f"{case.name}, {name}" for name in found[0].bearings}
    warned = list(dict.fromkeys(text for phase in found for text in phase.warnings))
    sums, of_rollers = _cycles(cycle.name, names, steps, found), _with_rollers(found)
    return joined_bearings(cycle.name, case.name, sums, of_rollers, warned, _ADDED)


def _cycles(
    name: str, cases: Mapping[str, str], steps: Sequence[_Step], found: Sequence[SolvedPhase]
) -> dict[str, DutyCycle]:
    """Return the sum of every bearing.

    `cases` says by the bearing's name what its sum is of.
    """
    time, cycles, of_rollers = sum(step.time for step in steps), {}, _with_rollers(found)
    for bearing, case in cases.items():
        own = [_phase(step, step.time / time, phase, bearing) for step, phase in zip(steps, found, strict=True)]
        cycles[bearing] = summed_phases(name, case, time, own, _ADDED, of_rollers=bearing in of_rollers)
    return cycles


def _with_rollers(found: Sequence[SolvedPhase]) -> set[str]:
    """Return the names of bearings with rollers."""
    return {name for name, one in found[0].bearings.items() if one.rollers is not None}


def _phase(step: _Step, share: float, found: SolvedPhase, name: str) -> PhaseResult:
    """Return one bearing in one phase."""
    own, turns = found.bearings[name], found.speed_rpm > 0.0
    rating = own.rating
    assert rating is not None  # each of a phase has one
    return PhaseResult(
        name=step.name,
        share=share,
        speed_rpm=found.speed_rpm,
        equivalent_load_N=rating.equivalent_load_N,
        basic_life_h=rating.basic_life_h if turns else None,
        reference_life_h=rating.reference_life_h if turns else None,
        damage=None,
        friction_torque_Nmm=own.friction_torque_Nmm if turns else None,
        power_loss_W=own.power_loss_W if turns else 0.0,
        energy_loss_kJ=0.0 if not turns else None if own.power_loss_W is None else 1e-3 * own.power_loss_W * step.time,
        warnings=own.warnings,
    )


def summed_phases(
    name: str,
    case: str,
    total_time: float,
    alone: Sequence[PhaseResult],
    assumptions: Sequence[str],
    *,
    of_rollers: bool,
) -> DutyCycle:
    """Add up the phases of one bearing.

    `total_time` is the time of all of them [s].
    """
    lives = {kind: _added(alone, kind) for kind in ("basic_life_h", "reference_life_h")}
    reference = lives["reference_life_h"]
    phases = [phase.model_copy(update={"damage": _damage(phase, reference)}) for phase in alone]
    mean_speed = sum(phase.share * phase.speed_rpm for phase in phases)
    mean_loss = total([None if phase.power_loss_W is None else phase.share * phase.power_loss_W for phase in phases])
    return DutyCycle(
        name=name,
        case=case,
        cycle_h=total_time / 3600.0,
        phases=phases,
        basic_life_h=finite(lives["basic_life_h"]),
        reference_life_h=finite(reference),
        mean_load_N=_mean_load(phases, mean_speed, LIFE_EXPONENT if of_rollers else _BALLS),
        mean_speed_rpm=mean_speed,
        mean_power_loss_W=mean_loss,
        energy_loss_kJ=total([phase.energy_loss_kJ for phase in phases]),
        energy_loss_kWh_per_year=None if mean_loss is None else 1e-3 * mean_loss * YEAR,
        assumptions=list(assumptions),
    )


def _read(source: str | Path | Mapping[str, Any]) -> tuple[Cycle, Case | MachineCase, list[_Step]]:
    """Return the cycle, its case and its phases.

    An error has every mistake of the file.
    """
    if isinstance(source, Mapping):
        name, data, folder = "duty cycle", dict(source), Path()
    else:
        path = Path(source)
        name, folder = path.name, path.parent
        data = _tables(path)
    if "case" not in data and not {"bearing", "shaft"}.isdisjoint(data):
        raise CaseError(name, [Problem("", "is a case, not a duty cycle: name it by case = in a file with [[phases]]")])
    try:
        cycle = Cycle.model_validate(data)
    except ValidationError as error:
        raise CaseError(name, problems(error, Cycle, data)) from None
    sibling = folder / cycle.case
    case = read_case(sibling if sibling.is_file() else cycle.case)
    steps = _steps(cycle, folder)
    _refuse_mistakes(steps, case)
    return cycle, case, steps


def _steps(cycle: Cycle, folder: Path) -> list[_Step]:
    """Return the phases.

    They come from the file itself or from its spectrum.
    """
    if cycle.spectrum is None:
        return [
            _Step(
                phase.name, f'phase "{phase.name}"', phase.time,
                tuple(f"{path}={_written(value)}" for path, value in phase.changes.items()),
            )
            for phase in cycle.phases
        ]  # fmt: skip
    lines = read_spectrum(folder / cycle.spectrum)
    if len(lines) > _MOST_PHASES:
        raise CaseError(cycle.spectrum, [Problem("", f"has {len(lines)} phases, {_MOST_PHASES} at most")])
    return [
        _Step(
            line.name, f"{cycle.spectrum}, line {line.number}", line.time,
            tuple(f"{path}={value}" for path, value in line.changes.items()),
        )
        for line in lines
    ]  # fmt: skip


def _refuse_mistakes(steps: Sequence[_Step], case: Case | MachineCase) -> None:
    """Refuse a cycle with a wrong change.

    It has no place in the case; every such phase is named, before any is solved.
    """
    found: list[Problem] = []
    for step in steps:
        try:
            apply_overrides(case, step.changes)
        except CaseError as error:
            found += [Problem(f"{step.where}, {problem.where}", problem.message) for problem in error.problems]
    if found:
        raise CaseError(case.name, found)


def _at(step: _Step, case: str, solve: Callable[[], Solved]) -> Solved:
    """Return the result of one phase.

    Any error begins with the phase's name.
    """
    try:
        return solve()
    except CaseError as error:
        raise CaseError(f"{step.where} of {case}", error.problems) from None
    except SolverError as error:
        raise SolverError(f"{step.where}: {error}") from None


def _tables(path: Path) -> dict[str, Any]:
    if not path.is_file():
        raise UsageError(f'"{path}" is not a file: give a TOML file with a case and its phases')
    if path.suffix.lower() == ".csv":
        text = f'name = "day", case = "motor.toml", spectrum = "{path.name}"'
        raise UsageError(f'"{path}" is a load spectrum, not a duty cycle: name it in a TOML file: {text}')
    try:
        text = read_text(path)
        return tomllib.loads(text)
    except UnicodeDecodeError:
        raise CaseError(path.name, [Problem("", "is not a text file in UTF-8")]) from None
    except ValueError as error:
        raise CaseError(path.name, [syntax_problem(str(error), text)]) from None
    except RecursionError:
        raise CaseError(path.name, [Problem("", "is nested too deeply")]) from None


def _solved(case: Case | MachineCase, announce: Callable[[str], None] | None, changes: Sequence[str]) -> SolvedPhase:
    """Solve a phase."""
    point = solved_point(ready(apply_overrides(case, changes), announce=announce, is_static=True), announce)
    return SolvedPhase(point.speed_rpm, point.answer.bearings, point.model.warnings)


def _written(value: bool | int | float | str) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _added(phases: Sequence[PhaseResult], kind: str) -> float:
    """Return the life of all phases [h].

    NaN where one that turns has none, infinite where nothing turns.
    """
    damage = 0.0
    for phase in phases:
        if phase.speed_rpm > 0.0:
            life = getattr(phase, kind)
            damage += math.nan if life is None else phase.share / life
    return math.inf if damage == 0.0 else 1.0 / damage


def _damage(phase: PhaseResult, total: float) -> float | None:
    if phase.speed_rpm == 0.0:
        return 0.0
    return finite(phase.share * total / phase.reference_life_h) if phase.reference_life_h else None


def _mean_load(phases: Sequence[PhaseResult], mean_speed: float, exponent: float) -> float | None:
    """Return the mean load P_m.

    (sum P_i^p n_i t_i / sum n_i t_i)^(1/p), p = 3 of balls, 10/3 of rollers (SKF, Rolling bearings, 17000 EN, 2018:
    mean load).
    """
    turning = [phase for phase in phases if phase.speed_rpm > 0.0]
    if not turning or any(phase.equivalent_load_N is None for phase in turning):
        return None
    weighted = sum((phase.equivalent_load_N or 0.0) ** exponent * phase.speed_rpm * phase.share for phase in turning)
    return float((weighted / mean_speed) ** (1.0 / exponent))


def _row(phase: PhaseResult, units: UnitSystem) -> tuple[str, ...]:
    return (
        phase.name,
        number(100.0 * phase.share),
        number(phase.speed_rpm, 0),
        units.number(phase.equivalent_load_N, "N", 0),
        hours_alone(phase.basic_life_h),
        hours_alone(phase.reference_life_h),
        number(None if phase.damage is None else 100.0 * phase.damage),
        units.number(phase.friction_torque_Nmm, "N mm"),
        units.number(phase.power_loss_W, "W"),
        number(phase.energy_loss_kJ),
    )


def _sum_row(found: DutyCycle, units: UnitSystem) -> tuple[str, ...]:
    return (
        "together",
        "100.0",
        number(found.mean_speed_rpm, 0),
        units.number(found.mean_load_N, "N", 0),
        hours_alone(found.basic_life_h),
        hours_alone(found.reference_life_h),
        "",
        "",
        units.number(found.mean_power_loss_W, "W"),
        number(found.energy_loss_kJ),
    )
