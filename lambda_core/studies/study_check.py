"""Check a study and estimate its cost before it runs."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice, product
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import BaseModel, ConfigDict, Field

from lambda_core.domain.errors import CaseError, LambdaError, Problem, UsageError
from lambda_core.studies.definition import Study
from lambda_core.studies.design import Coordinate, Plan, Point
from lambda_core.studies.job import point_model, solved_point, static_values, values_of
from lambda_core.studies.responses import (
    Response,
    bearing_names,
    chosen,
    method_rows_among,
    responses_of,
)
from lambda_core.studies.store import Heading, parameter_headings

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.machine import MachineCase
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel

Announce = Callable[[str], None] | None
_TRIED_VALUES = 50  # values of a list that are tried out beforehand
_BETWEEN = 0.3819660113  # share of a range at which samples are tried out: the golden section, no round number
_STARTUP = 4.0  # until the first process works [s]


class StudyEstimate(BaseModel):
    """Size and cost of a study."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    title: str
    mode: str
    design: str
    points: int
    parameters: list[str]
    responses: list[str]
    workers: int
    seconds_per_point: float = Field(description="of the first point, measured; of runs extrapolated")
    wall_s: float = Field(description="estimate")
    disk_bytes: float = Field(description="estimate of the result files")
    warnings: list[str] = Field(description="points that cannot work, found by trying the ends of ranges")

    def alone(self) -> StudyEstimate:
        """Return the estimate for the process of the command alone."""
        return self.model_copy(update={"workers": 1, "wall_s": self.points * self.seconds_per_point})

    def text(self) -> str:
        """Return the lines for people."""
        disk = f", {_bytes(self.disk_bytes)} of result files" if self.disk_bytes else ""
        lines = [
            f"{self.title or self.name}: {self.points} points, {self.mode}, {self.design}",
            *(f"  {parameter}" for parameter in self.parameters),
            f"about {duration(self.wall_s)} on {self.workers} worker{'s' * (self.workers > 1)} "
            f"({duration(self.seconds_per_point)} per point){disk}",
            *(f"warning: {warning}" for warning in self.warnings),
        ]
        return "\n".join(lines)


@dataclass(frozen=True)
class Ready:
    """A study that was checked and can start."""

    study: Study
    plan: Plan
    case_toml: str
    names: tuple[str, ...]  # of the responses
    headings: tuple[Heading, ...]
    estimate: StudyEstimate
    first: BearingModel | MachineModel


def check(
    study: Study, folder: Path | None, workers: int, announce: Announce = None, case: Case | MachineCase | None = None
) -> Ready:
    """Check a study.

    Counts, case, paths, units, responses, cost; its kernels are compiled afterwards.

    Parameters
    ----------
    folder : pathlib.Path, optional
        That file names of the study are relative to.
    case : Case, optional
        In place of the one that the study names.

    Raises
    ------
    CaseError
        With everything that is wrong.
    UsageError
        When the case does not exist, or the study has more points than it allows; with what they would cost.
    """
    plan = Plan(study)
    case_toml = _case_toml(study, folder, case)
    first = _first_model(study, plan, case_toml)
    known = responses_of(first)
    names = chosen(study.responses, study.mode, study.name, known, bearing_names(first))
    _check_goal(study, names)
    warnings = _try_ends(study, plan, case_toml)
    rows = method_rows_among(names, known)
    seconds, columns, size = _probe(study, first, names, rows, announce)
    estimate = StudyEstimate(
        name=study.name,
        title=study.title,
        mode=study.mode,
        design=study.design.kind,
        points=plan.count,
        parameters=[_parameter_text(c) for c in plan.coordinates],
        responses=list(names),
        workers=workers,
        seconds_per_point=seconds,
        wall_s=_STARTUP + plan.count * seconds / (1 if study.design.kind == "optimise" else workers),
        disk_bytes=plan.count * size,
        warnings=warnings,
    )
    if plan.count > study.max_points:
        disk = f" and {_bytes(estimate.disk_bytes)} of disk" if estimate.disk_bytes else ""
        raise UsageError(
            f"{study.name}: {plan.count:,} points would take about {duration(estimate.wall_s)} on {workers} workers"
            f"{disk}; at most {study.max_points:,} are allowed (max_points): take fewer points, or samples "
            '(design.kind = "sobol")'
        )
    headings = (*parameter_headings(plan.coordinates), *_response_headings(names, columns, known))
    return Ready(study, plan, case_toml, names, headings, estimate, first)


def _case_toml(study: Study, folder: Path | None, case: Case | MachineCase | None) -> str:
    """Return the study's case with its fixed changes, complete."""
    from lambda_core.case.case_io import apply_overrides, read_case
    from lambda_core.case.case_writer import standalone
    from lambda_core.discovery.api import registry
    from lambda_core.domain.written_values import written
    from lambda_core.model.laws.law_packages import packaged_toml

    changes = [f"{path}={written(value)}" for path, value in study.set.items()]
    if case is None:
        local = folder / study.case if folder is not None else Path(study.case)
        case = read_case(local if local.is_file() else study.case)
    return packaged_toml(standalone(apply_overrides(case, changes) if changes else case), registry())


def _first_model(study: Study, plan: Plan, case_toml: str) -> BearingModel | MachineModel:
    """Resolve the first point.

    An error there is an error everywhere.
    """
    point = _corner(plan, {})
    try:
        return point_model(case_toml, point.changes)
    except CaseError as error:
        raise CaseError(f"{study.name}, first point ({', '.join(point.changes)})", error.problems) from None


def _corner(plan: Plan, chosen_: dict[int, tuple[str, float | str]]) -> Point:
    """Return the point of all first values.

    The parameters in `chosen_` are exceptions.
    """
    pairs = [chosen_.get(place, c.at(0.0)) for place, c in enumerate(plan.coordinates)]
    changes = tuple(f"{c.parameter.path}={text}" for c, (text, _) in zip(plan.coordinates, pairs, strict=True))
    return Point(changes, tuple(entry for _, entry in pairs))


def _try_ends(study: Study, plan: Plan, case_toml: str) -> list[str]:
    """Try values of every parameter alone.

    Return warnings about points that cannot work.

    Raises
    ------
    CaseError
        For names that do not exist and values that the case does not take.
    """
    wrong: list[Problem] = []
    warnings: list[str] = []
    for where, changes, is_name in _trials(study, plan):
        try:
            point_model(case_toml, changes)
        except CaseError as error:
            physical = not is_name and not _refused_by_schema(case_toml, changes)
            for problem in error.problems:
                if physical:
                    warnings.append(f"{where}: {problem.where} {problem.message}")
                else:
                    wrong.append(Problem(where, f"{problem.where} {problem.message}"))
    if wrong:
        raise CaseError(study.name, wrong)
    return warnings


def _trials(study: Study, plan: Plan) -> Iterator[tuple[str, tuple[str, ...], bool]]:
    """Yield the trials of a study.

    A name, the changes, and whether it tries a name of a list.
    """
    yield from _names_together(study, plan)
    if study.design.kind == "zipped":
        last = plan.point(plan.count - 1)
        yield f"point {plan.count}", last.changes, False
        return
    for place, c in enumerate(plan.coordinates):
        for pair in _tried(c):
            yield f"{c.parameter.path} = {pair[0]}", _corner(plan, {place: pair}).changes, c.scale is None


def _names_together(study: Study, plan: Plan) -> Iterator[tuple[str, tuple[str, ...], bool]]:
    """Yield combinations of names of several lists.

    An oil may lack the data of a law.
    """
    lists = {place: c for place, c in enumerate(plan.coordinates) if c.scale is None}
    if len(lists) < 2:
        return
    values = [[c.value(index) for index in range(c.count)] for c in lists.values()]
    together = zip(*values, strict=True) if study.design.kind == "zipped" else product(*values)
    for pairs in islice(dict.fromkeys(together), _TRIED_VALUES):
        named = ", ".join(f"{c.parameter.path} = {text}" for c, (text, _) in zip(lists.values(), pairs, strict=True))
        yield named, _corner(plan, dict(zip(lists, pairs, strict=True))).changes, True


def _tried(c: Coordinate) -> Iterator[tuple[str, float | str]]:
    """Yield further values of a parameter.

    A list yields all values after its first; a range yields the last one and one between.

    The one between shows options that take whole numbers only.
    """
    if not c.is_range:
        yield from (c.value(index) for index in range(1, min(c.count, _TRIED_VALUES)))
        return
    if c.count != 2:
        yield c.value(1) if c.count else c.at(_BETWEEN)
    yield c.at(1.0)


def _refused_by_schema(case_toml: str, changes: tuple[str, ...]) -> bool:
    from lambda_core.case.case_io import read_case, toml_tables

    try:
        read_case(toml_tables(case_toml, "case"), changes)
    except LambdaError:
        return True
    return False


def _check_goal(study: Study, names: tuple[str, ...]) -> None:
    """Require responses for goal and constraints."""
    if study.optimise is None:
        return
    asked = [study.optimise.response, *(c.response for c in study.optimise.constraints)]
    missing = [
        Problem("optimise", f'"{name}" is not among the responses of this study') for name in asked if name not in names
    ]
    if missing:
        raise CaseError(study.name, missing)


def _probe(
    study: Study, model: BearingModel | MachineModel, names: tuple[str, ...], rows: tuple[str, ...], announce: Announce
) -> tuple[float, dict[str, tuple[float | None, str, str]], float]:
    """Compile the study and time one point.

    `rows` of comparison methods are among the `names`.

    Returns
    -------
    seconds : float
        Per point [s].
    columns : dict
        Value, unit and meaning of rows of comparison methods.
    size : float
        Of one result file [byte].
    """
    from lambda_core.analysis.thermal.temperatures import ready
    from lambda_core.runs.estimate import estimate as estimate_run
    from lambda_core.studies.method_columns import method_columns

    asked = names if study.mode == "quasi-static" else rows
    warm = ready(model)
    point = solved_point(warm, announce)
    values_of(point, warm, asked)  # compiles or loads, also a circuit; not timed
    columns = method_columns(point, rows)
    start = time.perf_counter()
    static_values(ready(point_model(model.case_toml, ())), asked)
    seconds = time.perf_counter() - start
    if study.mode == "quasi-static":
        return seconds, columns, 0.0
    run = estimate_run(warm, announce)
    if run.processor_s is None or run.simulated_s is None:
        return math.nan, columns, math.nan
    each = zip(warm.bearing_models.values(), point.equilibria, strict=True)
    size = sum(_file_size(one, run.simulated_s, found.orbit) for one, found in each)
    return seconds + run.processor_s, columns, size


def _file_size(model: BearingModel, simulated: float, orbit: float) -> float:
    """Return the size of a run's samples [byte].

    It counts before compression; `orbit` is the mean speed of the balls [rad/s].
    """
    from lambda_core.domain.channels import CHANNELS, DIMENSIONS
    from lambda_core.solver.drivers.engine import SAMPLES_PER_REVOLUTION

    sizes = {name: len(labels) for name, labels in DIMENSIONS.items()} | {"ball": model.geometry.balls}
    per_sample = sum(math.prod(sizes[dim] for dim in channel.dims) for channel in CHANNELS)
    interval = model.output.interval or 2.0 * math.pi / abs(orbit) / SAMPLES_PER_REVOLUTION
    return _DOUBLE * per_sample * simulated / interval


def _response_headings(
    names: tuple[str, ...], columns: dict[str, tuple[float | None, str, str]], known: Mapping[str, Response]
) -> Iterator[Heading]:
    for name in names:
        if name in known:
            yield Heading("response", name, known[name].unit, known[name].meaning)
        else:
            yield Heading("response", name, columns[name][1], columns[name][2])


def _parameter_text(c: Coordinate) -> str:
    parameter = c.parameter
    if parameter.range is not None:
        count = f", {parameter.points} points" if parameter.points is not None else ""
        return f"{parameter.path}: {parameter.range[0]} to {parameter.range[1]}{count}"
    values = parameter.values or []
    shown = ", ".join(str(value) for value in values[:5])
    return f"{parameter.path}: {shown}{f' and {len(values) - 5} more' if len(values) > 5 else ''}"


_DOUBLE = 8.0  # [byte]
_UNITS = ((31_557_600.0, "years"), (86_400.0, "days"), (3_600.0, "hours"), (60.0, "minutes"), (1.0, "s"))


def duration(seconds: float) -> str:
    """Write a time for people: "3.2 hours"."""
    if not math.isfinite(seconds):
        return "unknown time"
    for size, name in _UNITS:
        if seconds >= 1.5 * size:
            return f"{seconds / size:.3g} {name}"
    return f"{seconds:.2g} s" if seconds >= 0.0995 else f"{1e3 * seconds:.2g} ms"  # never "1e+02 ms"


def _bytes(size: float) -> str:
    if not math.isfinite(size):
        return "unknown size"
    for factor, name in ((1e12, "TB"), (1e9, "GB"), (1e6, "MB")):
        if size >= factor:
            return f"{size / factor:.3g} {name}"
    return f"{size / 1e3:.3g} kB"
