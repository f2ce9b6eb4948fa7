"""Bearing currents over speed and temperature: which corners of the operation discharge."""

from __future__ import annotations

import csv
import re
import time
from collections.abc import Callable, Sequence
from contextlib import closing
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from lambda_core.case.case_io import apply_overrides
from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.domain.units import parse, show
from lambda_core.electric.circuit_run import simulate
from lambda_core.electric.contacts import contacts_of_equilibria, equilibria
from lambda_core.electric.electrified import of_model
from lambda_core.results.record import INTERFACE, Record
from lambda_core.system.checking import check
from lambda_core.views.chart import Axis, Panel, ViewData
from lambda_core.views.chart import Field as Mesh

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.system.bearing import BearingModel

PHASES = 3  # equilibria per ball pitch
MOST_POINTS = 10000
_TOLD_AFTER = 5.0  # wall time between words about how far it is [s]
_EXAMPLES = {"speed": "500 rpm, 10000 rpm", "temperature": "20 degC, 110 degC"}
DURATION = 0.05  # of the march at each point, where the case says nothing [s]


class RiskPoint(Record):
    """One speed at one temperature; None where there is no equilibrium or nothing discharges."""

    speed_rpm: float
    temperature_degC: float
    film_um: float | None = Field(description="smallest central film of a loaded contact")
    film_parameter: float | None = Field(description="Lambda there")
    bearing_capacitance_pF: float | None
    bearing_voltage_ratio: float | None
    bearing_voltage_V: float | None = Field(description="largest, either sign")
    metal_share: float | None = Field(description="of contacts and time: asperities touch")
    discharges_per_s: float | None
    breakdown_voltage_V: float | None = Field(description="of the bearing at discharges, median")
    peak_current_A: float | None = Field(description="median")
    current_density_A_per_mm2: float | None
    arc_power_mW: float | None
    message: str = Field("", description="why a point is empty")


class RiskMap(Record):
    """Bearing currents over speed and temperature."""

    interface: int = INTERFACE
    case: str
    source: str = Field(description="common-mode voltage")
    seed: int = Field(description="key of the random numbers")
    simulated_s: float = Field(description="at each point, from a rotor without charge")
    wall_s: float
    speeds_rpm: list[float] = Field(description="of the inner ring")
    temperatures_degC: list[float] = Field(description="of oil and parts")
    points: list[RiskPoint] = Field(description="speeds first, each at all temperatures")
    assumptions: list[str]

    def grid(self, name: str) -> Any:
        """Return one quantity over speeds and temperatures.

        Parameters
        ----------
        name : str
            A field of the points.

        Returns
        -------
        float64[:, :]
            Shape (speeds, temperatures), NaN where there is none.
        """
        values = [getattr(point, name) for point in self.points]
        numbers = np.array([np.nan if value is None else value for value in values], dtype=np.float64)
        return numbers.reshape(len(self.speeds_rpm), len(self.temperatures_degC))

    def text(self) -> str:
        """Return the rates of discharges as a table for people."""
        from lambda_core.electric.circuit_lines import map_text

        return map_text(self)

    def write(self, path: Path) -> Path:
        """Write every point as CSV.

        Parameters
        ----------
        path : pathlib.Path
            Is replaced where it stands.

        Returns
        -------
        pathlib.Path
            The file.

        Raises
        ------
        UsageError
            When it cannot be written.
        """
        names = [name for name in RiskPoint.model_fields if name != "message"]
        try:
            with path.open("w", newline="", encoding="utf-8") as file:
                writer = csv.writer(file, lineterminator="\n")
                writer.writerow([*names, "message"])
                for point in self.points:
                    values = [getattr(point, name) for name in names]
                    writer.writerow(["" if value is None else value for value in values] + [point.message])
        except OSError as error:
            raise UsageError(f"cannot write {path}: {error.strerror or error}") from None
        return path

    def picture(self) -> ViewData:
        """Return discharges, film, voltage and current density over speed and temperature, to be drawn."""
        x, y = np.meshgrid(self.speeds_rpm, self.temperatures_degC, indexing="ij")
        speed, temperature = Axis("speed", "1/min", log=_is_even_in_log(self.speeds_rpm)), Axis("temperature", "degC")
        shown = (
            ("discharges", "1/s", "discharges_per_s", True),
            ("film", "um", "film_um", False),
            ("largest bearing voltage", "V", "bearing_voltage_V", False),
            ("current density J_b", "A/mm2", "current_density_A_per_mm2", False),
        )
        panels = []
        for name, unit, column, log in shown:
            values = self.grid(column)
            values = np.where(values > 0.0, values, np.nan) if log else values
            if np.isfinite(values).any():
                panels.append(Panel(name, speed, temperature, field=Mesh(name, unit, x, y, values, log=log)))
        notes = (f"{self.simulated_s:g} s at each point from a rotor without charge, seed {self.seed}; white: none",)
        return ViewData("electric-map", "Bearing currents", f"{self.case}   {self.source}", tuple(panels), 2, notes)


def _is_even_in_log(values: Sequence[float]) -> bool:
    ratio = np.diff(np.log(values))
    return len(values) > 2 and bool(np.ptp(ratio) < 1e-6 * np.abs(ratio).max())


def axes(speed: str | None, temperature: str, points: str, top: float) -> tuple[list[float], list[float]]:
    """Return speeds [rad/s], even in logarithm, and temperatures [K] of a map.

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
    if counts is None or "0" in (counts[1].lstrip("0") or "0", counts[2].lstrip("0") or "0"):
        raise UsageError(f'points "{points}": write speeds times temperatures, for example 20x10')
    rows, columns = int(counts[1]), int(counts[2])
    if rows * columns > MOST_POINTS:
        raise UsageError(f"points {points} are {rows * columns}: at most {MOST_POINTS}")
    if speed is None and top == 0.0:
        raise UsageError('the case does not turn: give the speeds of the map, speed "500 rpm, 10000 rpm"')
    low, high = (0.1 * top, 2.0 * top) if speed is None else _ends("speed", speed, "rotational_speed")
    if not low > 0.0:
        raise UsageError(f'speed "{speed}": must be greater than 0')
    cold, hot = _ends("temperature", temperature, "temperature")
    return list(np.geomspace(low, high, rows)), list(np.linspace(cold, hot, columns))


def _ends(name: str, text: str, quantity: str) -> tuple[float, float]:
    parts = text.split(",")
    if len(parts) != 2:
        raise UsageError(f'{name} "{text}": write the first and the last one, for example "{_EXAMPLES[name]}"')
    try:
        low, high = (parse(part.strip(), quantity) for part in parts)
    except ValueError as error:
        raise UsageError(f"{name} {error}") from None
    if low > high:
        raise UsageError(f'{name} "{text}": the first is larger than the last')
    return low, high


def risk_map(
    case: Case,
    speeds: Sequence[float],
    temperatures: Sequence[float],
    *,
    announce: Callable[[str], None] | None = None,
) -> RiskMap:
    """Compute the circuit at speeds [rad/s] and oil temperatures [K] on quasi-static films.

    Raises
    ------
    CaseError
        With every mistake of the case.
    SolverError
        When no point has an equilibrium.
    """
    from lambda_core.solver.drivers.compiled_laws import Kernels

    points: list[RiskPoint] = []
    started = told = time.perf_counter()
    last = None
    with closing(registry().catalogue()) as catalogue:
        kernels = Kernels(check(at_point(case, speeds[0], temperatures[0]), catalogue=catalogue), announce)
        for speed, temperature in product(speeds, temperatures):
            model = check(at_point(case, speed, temperature), catalogue=catalogue)
            try:
                found = _simulation(model, kernels, announce)
                points.append(_point(speed, temperature, found.outcome, found.contacts))
                last = found.outcome
            except SolverError as error:
                points.append(_empty(speed, temperature, str(error)))
            now = time.perf_counter()
            if announce is not None and now - told > _TOLD_AFTER:
                told = now
                announce(f"{len(points)} of {len(speeds) * len(temperatures)} points")
    if last is None:
        raise SolverError(f"no point of the map has an equilibrium; the first: {points[0].message}")
    return RiskMap(
        case=case.name,
        source=last.source,
        seed=last.seed,
        simulated_s=_duration(case),
        wall_s=time.perf_counter() - started,
        speeds_rpm=[speed * 30.0 / np.pi for speed in speeds],
        temperatures_degC=[temperature - 273.15 for temperature in temperatures],
        points=points,
        assumptions=last.assumptions,
    )


def _duration(case: Case) -> float:
    options = case.electric
    return DURATION if options is None or options.duration is None else options.duration


def at_point(case: Case, speed: float, temperature: float) -> Case:
    """Return the case at one speed [rad/s] and one temperature of oil and parts [K]."""
    changes = [
        f"operation.speed={show(speed, 'rotational_speed', 12)}",
        f"lubricant.temperature={show(temperature, 'temperature', 12)}",
        "operation.temperatures=given",
        f"electric.duration={show(_duration(case), 'time', 12)}",
    ]
    return apply_overrides(case, changes)


def _simulation(model: BearingModel, kernels: Any, announce: Any) -> Any:
    bearing = of_model(model)
    contacts = contacts_of_equilibria(equilibria(model, PHASES, announce, kernels), bearing.options.duration)
    return simulate(contacts, bearing, announce=announce)


def _point(speed: float, temperature: float, outcome: Any, contacts: Any) -> RiskPoint:
    film = np.where(contacts.loaded, contacts.film, np.inf)
    thinnest = np.unravel_index(int(np.argmin(film)), film.shape)
    low, high = outcome.bearing_voltage_V

    def middle(values: Sequence[float] | None) -> float | None:
        return None if values is None else values[1]

    return RiskPoint(
        speed_rpm=speed * 30.0 / np.pi,
        temperature_degC=temperature - 273.15,
        film_um=1e6 * float(film[thinnest]),
        film_parameter=float(contacts.film_parameter[thinnest]),
        bearing_capacitance_pF=outcome.bearing_capacitance_pF[1],
        bearing_voltage_ratio=outcome.bearing_voltage_ratio,
        bearing_voltage_V=max(abs(low), abs(high)),
        metal_share=outcome.shorted_share,
        discharges_per_s=outcome.discharges_per_s,
        breakdown_voltage_V=middle(outcome.breakdown_voltage_V),
        peak_current_A=middle(outcome.peak_current_A),
        current_density_A_per_mm2=outcome.current_density_A_per_mm2,
        arc_power_mW=outcome.arc_power_mW,
        message="",
    )


def _empty(speed: float, temperature: float, message: str) -> RiskPoint:
    known: dict[str, Any] = {
        "speed_rpm": speed * 30.0 / np.pi,
        "temperature_degC": temperature - 273.15,
        "message": message,
    }
    return RiskPoint(**{**dict.fromkeys(RiskPoint.model_fields), **known})
