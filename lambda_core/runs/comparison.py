"""Declare the answers of comparison methods."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from pydantic import Field

from lambda_core.domain.channels import RINGS
from lambda_core.domain.errors import UsageError
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.model.laws.time_functions import initial
from lambda_core.results.answer import Answer
from lambda_core.results.averages import finite
from lambda_core.results.record import INTERFACE, Record
from lambda_core.results.summary import Summary
from lambda_core.results.text import contamination_text
from lambda_core.runs.same_case import changed_values
from lambda_core.views.method import GROUP_UNITS, MethodAnswer

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.results.reader import Result

SIMULATION = "simulation"
_ROUNDING, _NOTHING = 1e-8, 1e-12  # of numbers for people; JSON has them all
_COLUMN, _NAME, _PARTS = 14, 34, ("rolling", "sliding", "drag")
# Mechanisms of the simulation under the names that catalogues print.
_SUMS = {"rolling": ("rolling", "hysteresis"), "sliding": ("sliding", "spin", "boundary"), "drag": ("drag",)}


class ComparedNumber(Record):
    """One number of one method."""

    group: str = Field(description="friction, capacitance, life, rating, kinematics, stiffness or load")
    name: str = Field(description="equal names of two methods mean the same thing")
    value: float | None
    unit: str
    meaning: str = ""


class ComparedMethod(Record):
    """Answer of one method.

    An answer without numbers has the reason why it does not apply.
    """

    name: str
    title: str
    reference: str
    validity: str
    numbers: list[ComparedNumber]
    assumptions: list[str]
    reason: str
    failed: bool = Field(default=False, description="whether it failed of its own; the reason names its package")


class Comparison(Answer):
    """Every method on one case at its start.

    The simulation is included if a result was given.
    """

    interface: int = INTERFACE
    case: str
    title: str
    headline: str
    methods: list[ComparedMethod]
    assumptions: list[str] = Field(description="of the case")
    contamination: float = Field(description="e_C of ISO 281 that modified lives were computed with")
    contamination_given: bool = Field(description="whether case or caller gives it; otherwise normal cleanliness")

    def value(self, method: str, group: str, name: str) -> float | None:
        """Return one number, None where that method has none."""
        for found in self.methods:
            for number in found.numbers:
                if (found.name, number.group, number.name) == (method, group, name):
                    return number.value
        return None

    def text(self, units: UnitSystem = SI) -> str:
        """Return the tables of methods.

        Each group has a table, each quantity a row, and each method a column.
        """
        lines = [units.sentence(self.headline)]
        for group in GROUP_UNITS:
            lines += _group_lines(group, self.methods, units)
        for method in self.methods:
            notes = [method.reason] if method.reason else method.assumptions
            lines += [f"{method.name}: {units.sentence(note)}" for note in notes]
        if any("modified rating life" in number.name for method in self.methods for number in method.numbers):
            lines.append(f"modified lives: {contamination_text(self.contamination, is_given=self.contamination_given)}")
        return "\n".join(lines)


def simulated_by(model: BearingModel | MachineModel, bearing: str, result: Result) -> ComparedMethod:
    """Return the rows of a simulation that methods have too.

    Parameters
    ----------
    model : BearingModel or MachineModel
        Of the case that is compared.
    bearing : str
        The bearing of a machine; empty where it is alone.

    Raises
    ------
    UsageError
        When the result is of another case.
    """
    changed = [
        f"{name}.{path}" if name and result.is_machine else path
        for name, paths in changed_values(result, model).items()
        for path in paths
    ]
    if changed:
        more = f" and {len(changed) - 3} more" if len(changed) > 3 else ""
        raise UsageError(f"{result.path} is of another case: {', '.join(changed[:3])}{more} differ")
    return _simulated(result.of_bearing(bearing or None).summary(), model.bearing_models[bearing])


def compared(answer: MethodAnswer) -> ComparedMethod:
    """Return a method's answer in the words of the interface."""
    method, table = answer.method, answer.table
    rows = table.rows if table is not None else ()
    return ComparedMethod(
        name=method.name,
        title=method.title,
        reference=method.reference,
        validity=method.validity,
        numbers=[
            ComparedNumber(group=r.group, name=r.name, value=finite(r.value), unit=r.unit, meaning=r.meaning)
            for r in rows
        ],
        assumptions=list(table.assumptions) if table is not None else [],
        reason=answer.reason,
        failed=answer.failed,
    )


def _simulated(summary: Summary, model: BearingModel) -> ComparedMethod:
    """Return the rows of a simulation that methods have too."""
    parts = {name: value or 0.0 for name, value in summary.friction_breakdown_Nmm.items()}
    friction: list[tuple[str, float | None]] = [("total", summary.friction_torque_Nmm)]
    friction += [
        (name, sum(value for part, value in parts.items() if part.split("_")[0] in _SUMS[name])) for name in _PARTS
    ]
    friction += [("neighbours" if model.full_complement else "cage", parts.get("cage"))]
    numbers = [ComparedNumber(group="friction", name=name, value=value, unit="N mm") for name, value in friction]
    if summary.bearing_capacitance_nF is not None:
        value = 1e3 * summary.bearing_capacitance_nF
        numbers.append(ComparedNumber(group="capacitance", name="bearing", value=value, unit="pF"))
    for ring in RINGS:
        load = max(contact.load_N for contact in summary.contacts if contact.ring == ring)
        name = f"largest contact load, {ring}"
        numbers.append(ComparedNumber(group="load", name=name, value=load, unit="N", meaning="end state"))
    if summary.cage_speed_ratio is not None:
        inner, outer = (initial(body.dofs["spin"].motion) for body in (model.inner_ring, model.outer_ring))
        cage = (outer + summary.cage_speed_ratio * (inner - outer)) * 30.0 / math.pi
        name = "roller orbit" if model.full_complement else "cage speed"
        numbers.append(ComparedNumber(group="kinematics", name=name, value=cage, unit="rpm"))
    return ComparedMethod(
        name=SIMULATION,
        title="The dynamics of this project",
        reference=summary.file,
        validity="",
        numbers=numbers,
        assumptions=[] if summary.converged else [f"not converged: {'; '.join(summary.reasons)}"],
        reason="",
    )


def _group_lines(group: str, methods: Sequence[ComparedMethod], units: UnitSystem) -> list[str]:
    """Return the table of one group.

    Nothing when no method has a number of it.
    """
    columns = [
        (
            method.name,
            {
                (n.name, units.unit(n.unit)): None if n.value is None else units.value(n.value, n.unit)
                for n in method.numbers
                if n.group == group
            },
        )
        for method in methods
    ]
    columns = [(name, numbers) for name, numbers in columns if numbers]
    if not columns:
        return []
    keys = dict.fromkeys(key for _, numbers in columns for key in numbers)
    width = max(_COLUMN, *(len(name) + 2 for name, _ in columns))
    lines = ["", f"{group:<{_NAME}}" + "".join(f"{name:>{width}}" for name, _ in columns)]
    largest = dict.fromkeys((unit for _, unit in keys), 0.0)
    for (_, unit), value in (item for _, numbers in columns for item in numbers.items()):
        largest[unit] = max(largest[unit], abs(value or 0.0))
    for name, unit in keys:
        cells = "".join(f"{_cell(numbers.get((name, unit)), largest[unit]):>{width}}" for _, numbers in columns)
        lines.append(f"  {f'{name} [{unit}]' if unit != '-' else name:<{_NAME - 2}}{cells}")
    return lines


def _cell(value: float | None, largest: float) -> str:
    """Write one number, rounding errors as 0.

    An error is tiny compared with the largest number of its unit.
    """
    if value is None:
        return ""
    if abs(value) < max(_ROUNDING * largest, _NOTHING):
        return "0"
    return f"{value:.4g}" if abs(value) < 1e4 else f"{value:.5g}"
