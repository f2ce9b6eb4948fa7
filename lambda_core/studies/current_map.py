"""Map bearing currents over speed and temperature.

The map is a study, so it has workers and can be resumed.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from contextlib import closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from lambda_core.analysis.electric.current_numbers import UNITS
from lambda_core.analysis.rotor.bearing_alone import bearing_number
from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.domain.lists import listed
from lambda_core.domain.units import parse
from lambda_core.studies.definition import Parameter, Study
from lambda_core.studies.design import Plan
from lambda_core.studies.folders import is_study, prepare, resume, start, status
from lambda_core.studies.job import point_model
from lambda_core.studies.store import Manifest, readable

if TYPE_CHECKING:
    from lambda_core.analysis.electric.risk_map import RiskMap
    from lambda_core.case.case import Case
    from lambda_core.case.case_io import Source
    from lambda_core.case.machine import MachineCase
    from lambda_core.studies.scheduler import StudyProgress
    from lambda_core.views.table import StudyTable

MOST_POINTS = 10000
DURATION = "50 ms"  # of the march at each point, where the case says nothing
SPEED, TEMPERATURE = "operation.speed", "lubricant.temperature"
_EXAMPLES = {"speed": "500 rpm, 10000 rpm", "temperature": "20 degC, 110 degC"}
Spacing = Literal["linear", "log"]
_ZERO_CELSIUS = 273.15


def electric_map(
    source: Source,
    overrides: Iterable[str] = (),
    *,
    speed: str | None = None,
    temperature: str = "20 degC, 110 degC",
    points: str = "20x10",
    out: str | Path | None = None,
    overwrite: bool = False,
    folder: str | Path | None = None,
    bearing: str | None = None,
    executor: str | Executor = "processes",
    workers: int | None = None,
    progress: Callable[[StudyProgress], None] | None = None,
    announce: Callable[[str], None] | None = None,
) -> RiskMap:
    """Compute bearing currents over speed and temperature on quasi-static films.

    Parameters
    ----------
    source
        The case, as for :func:`check`; or the folder of a map, which goes on with what is missing and is read.
    overrides : iterable of str
        Changes ``path=value``; of a case only.
    speed : str, optional
        First and last speed of the inner ring, "500 rpm, 10000 rpm", even in logarithm; default: from a tenth to twice
        the largest speed of the case.
    temperature : str
        First and last temperature of oil and parts.
    points : str
        Speeds times temperatures.
    out : path-like, optional
        Every number in a CSV file.
    overwrite : bool
        Replace a file that stands there.
    folder : path-like, optional
        Keep the map there as a study, so that it can go on after a kill; default: it is gone when it is interrupted.
    bearing : str, optional
        Which one of a machine the map is of. All bearings stand in the machine's circuit and move with its shaft; the
        folder of a map has all of them.
    executor, workers
        As for :func:`study_run`.
    progress, announce : callable, optional
        Called with where the map stands; with a sentence before something is compiled and with the estimate.

    Returns
    -------
    RiskMap
        ``text()`` is the table of discharges, ``picture()`` is for :func:`draw`. The same whatever the workers.

    Raises
    ------
    UsageError, CaseError, SolverError
        With a sentence about the map, the case, or about why no point has a solution.
    """
    from lambda_core.analysis.electric.event_files import check_target

    if out is not None:
        check_target(Path(out), overwrite, "the map", (".csv",))
    if isinstance(source, str | Path) and is_study(Path(source)):
        if folder is not None or speed is not None or listed(overrides, "overrides"):
            raise UsageError(f"{source} is a map already: its case, speeds and folder cannot be changed")
        found = _read_on(Path(source), bearing, executor, workers, progress)
    else:
        if folder is not None and is_study(Path(folder)):
            raise UsageError(f"{folder} already holds a study: go on with it (lambda-bearing electric-map {folder})")
        case, study = _study(source, overrides, bearing, speed, temperature, points)
        ready = prepare(study, workers, announce, case)
        if announce is not None:
            announce(ready.estimate.text())
        with _folder(folder) as path:
            start(ready, path, where=executor, workers=workers, report=progress)
            found = map_of(path, bearing)
    if out is not None:
        found.write(Path(out))
    return found


def _read_on(
    folder: Path, bearing: str | None, executor: str | Executor, workers: int | None,
    progress: Callable[[StudyProgress], None] | None,
) -> RiskMap:  # fmt: skip
    """Do what a map lacks, and read it."""
    if status(folder).pending:
        with closing(Manifest(folder)) as manifest, readable(folder):
            map_axes(manifest.table(), folder)  # before any work on another study
            model = point_model(manifest.case_toml, Plan(manifest.study).point(0).changes)
        bearing_number(model, bearing)  # likewise of a bearing that the machine does not have
        resume(folder, where=executor, workers=workers, report=progress)
    return map_of(folder, bearing)


@contextmanager
def _folder(folder: str | Path | None) -> Iterator[Path]:
    """Give a folder to work in.

    A folder without a name is removed afterwards.
    """
    if folder is not None:
        yield Path(folder)
        return
    with tempfile.TemporaryDirectory(prefix="lambda-bearing-map-") as place:
        yield Path(place)


def _study(
    source: Source,
    overrides: Iterable[str],
    bearing: str | None,
    speed: str | None,
    temperature: str,
    points: str,
) -> tuple[Case | MachineCase, Study]:
    """Return the case and study of a map."""
    from lambda_core.case.case_io import read_case
    from lambda_core.model.api import check
    from lambda_core.model.laws.law_context import max_speed

    case = read_case(source, listed(overrides, "overrides"))
    model = check(case)
    bearing_number(model, bearing)  # before any work on a map that nobody could read
    each = model.bearing_models
    responses = [f"{one}.{name}" if one else name for one in each for name in UNITS]
    fixed: dict[str, bool | int | float | str] = {"operation.temperatures": "given"}
    if case.electric is None or case.electric.duration is None:
        fixed["electric.duration"] = DURATION
    study = Study(
        name=case.name,
        title=f"{case.name}: bearing currents over speed and temperature",
        case="case.toml",
        set=fixed,
        responses=responses,
        parameters=list(map_parameters(speed, temperature, points, max_speed(next(iter(each.values()))))),
    )
    return case, study


def map_parameters(speed: str | None, temperature: str, points: str, top: float) -> tuple[Parameter, Parameter]:
    """Return what varies in a map.

    Parameters
    ----------
    speed, temperature : str
        "FROM, TO"; speed None: from a tenth to twice `top` [rad/s].
    points : str
        "20x10": speeds times temperatures.

    Raises
    ------
    UsageError
        With a sentence about what cannot be read.
    """
    counts = re.fullmatch(r"\s*(\d{1,4})\s*[xX*]\s*(\d{1,4})\s*", points)
    rows, columns = (int(counts[1]), int(counts[2])) if counts is not None else (0, 0)
    if rows == 0 or columns == 0:
        raise UsageError(f'points "{points}": write speeds times temperatures, for example 20x10')
    if rows * columns > MOST_POINTS:
        raise UsageError(f"points {points} are {rows * columns}: at most {MOST_POINTS}")
    if speed is None and top == 0.0:
        raise UsageError('the case does not turn: give the speeds of the map, speed "500 rpm, 10000 rpm"')
    per_minute = 30.0 / np.pi * top
    asked = f"{0.1 * per_minute:.10g} rpm, {2.0 * per_minute:.10g} rpm" if speed is None else speed
    low, high = _ends("speed", asked, "rotational_speed", rows)
    if not parse(low, "rotational_speed") > 0.0:
        raise UsageError(f'speed "{speed}": must be greater than 0')
    cold, hot = _ends("temperature", temperature, "temperature", columns)
    return _range(SPEED, "speed", low, high, rows, "log"), _range(TEMPERATURE, "temperature", cold, hot, columns)


def _range(path: str, label: str, first: str, last: str, count: int, spacing: Spacing = "linear") -> Parameter:
    if count == 1:
        return Parameter(path=path, label=label, values=[first])
    return Parameter(path=path, label=label, range=[first, last], points=count, spacing=spacing)


def _ends(name: str, text: str, quantity: str, count: int) -> tuple[str, str]:
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2:
        raise UsageError(f'{name} "{text}": write the first and the last one, for example "{_EXAMPLES[name]}"')
    try:
        low, high = (parse(part, quantity) for part in parts)
    except ValueError as error:
        raise UsageError(f"{name} {error}") from None
    if low > high:
        raise UsageError(f'{name} "{text}": the first is larger than the last')
    if low == high and count > 1:
        raise UsageError(f'{name} "{text}": {count} points need two different ends')
    return parts[0], parts[1]


def map_axes(table: StudyTable, folder: Path) -> tuple[list[float], list[float]]:
    """Return speeds [1/min] and temperatures [degC] of rows.

    They are the rows of a map.

    Raises
    ------
    UsageError
        When the study is no map.
    """
    wanted = {SPEED: "rotational_speed", TEMPERATURE: "temperature"}
    known = {column.name for column in table.responses}
    missing = [name for name in UNITS if not any(one == name or one.endswith(f".{name}") for one in known)]
    if {column.name for column in table.parameters} != set(wanted) or table.design != "crossed" or missing:
        raise UsageError(
            f"{folder} is not a map of bearing currents, a crossed study of {SPEED} and {TEMPERATURE} with the "
            f"responses {', '.join(UNITS)}"
        )
    speed, temperature = (
        np.array([parse(f"{value} {column.unit}", quantity) for value in column.values])
        for column, quantity in ((table.parameter(name), quantity) for name, quantity in wanted.items())
    )
    return (speed * 30.0 / np.pi).tolist(), (temperature - _ZERO_CELSIUS).tolist()


def map_of(folder: Path, bearing: str | None = None) -> RiskMap:
    """Read a map from its study's folder.

    The study may still be at work.

    Parameters
    ----------
    bearing : str, optional
        Which one of a machine.

    Raises
    ------
    UsageError
        When the folder holds no map.
    SolverError
        When no point has a solution.
    """
    from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
    from lambda_core.analysis.electric.outcome import assumptions, source_words
    from lambda_core.analysis.electric.risk_map import RiskMap, RiskPoint

    with closing(Manifest(folder)) as manifest, readable(folder):
        table, study, case_toml = manifest.table(), manifest.study, manifest.case_toml
        wall = float(manifest.meta("wall") or 0.0)
    speeds, temperatures = map_axes(table, folder)
    model = point_model(case_toml, Plan(study).point(0).changes)
    number = bearing_number(model, bearing)
    circuit, prefix = circuit_bearings(model)[number], list(model.bearing_models)[number]
    own = f"{prefix}." if prefix else ""
    found = {}
    for row, speed, temperature in zip(table.rows(), speeds, temperatures, strict=True):
        message = {"pending": "not computed yet"}.get(row["state"], row["reason"])
        found[speed, temperature] = RiskPoint(
            speed_rpm=speed,
            temperature_degC=temperature,
            message=message,
            **{name: row[own + name] if row["state"] == "done" else None for name in UNITS},
        )
    if all(point.message for point in found.values()):
        raise SolverError(f"no point of the map has an equilibrium; the first: {next(iter(found.values())).message}")
    rows, columns = sorted(set(speeds)), sorted(set(temperatures))
    return RiskMap(
        case=model.name,
        bearing=own.removesuffix("."),
        source=source_words(circuit.options),
        seed=circuit.options.seed,
        simulated_s=circuit.options.duration,
        wall_s=wall,
        speeds_rpm=rows,
        temperatures_degC=columns,
        points=[found[speed, temperature] for speed in rows for temperature in columns],
        assumptions=assumptions(circuit),
    )
