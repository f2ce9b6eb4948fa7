"""Map bearing currents over speed and temperature."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import Field

from lambda_core.analysis.electric.current_limits import DENSITY_CLASSES
from lambda_core.analysis.electric.current_numbers import CurrentNumbers
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError
from lambda_core.domain.wrapping import lines_under
from lambda_core.results.record import INTERFACE, Record
from lambda_core.results.text import line
from lambda_core.views.chart import Axis, Panel, Series, ViewData
from lambda_core.views.chart import Field as Mesh

QUIET = ("films hold", "metal", "no equilibrium")  # why nothing discharges
_NAMED = 4  # points without an answer of which the text gives the reason
_METAL = 0.05  # share of contacts and time from which on a point where nothing discharges is called metal


class _Place(Record):
    speed_rpm: float
    temperature_degC: float


class RiskPoint(CurrentNumbers, _Place):
    """One speed at one temperature.

    None where there is no equilibrium or nothing discharges.
    """

    message: str = Field("", description="why a point is empty")

    @property
    def quiet_because(self) -> str:
        """Reason for no discharge, one of QUIET.

        It is "" where something discharges.
        """
        if self.discharges_per_s is None:
            return "no equilibrium"
        if self.discharges_per_s > 0.0:
            return ""
        return "metal" if (self.metal_share or 0.0) > _METAL else "films hold"


class RiskMap(Record):
    """Bearing currents over speed and temperature."""

    interface: int = INTERFACE
    case: str
    bearing: str = Field("", description="which one of a machine; empty for a case of one")
    source: str = Field(description="common-mode voltage")
    seed: int = Field(description="key of the random numbers")
    simulated_s: float | None = Field(description="at each point; absent: ten turns of the cage")
    wall_s: float = Field(description="of all sessions that worked on it")
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

    @property
    def title(self) -> str:
        """The case, and the bearing of a machine."""
        return f"{self.case}, {self.bearing}" if self.bearing else self.case

    @property
    def span(self) -> str:
        """Text of the quantities at each point."""
        return "ten turns of the cage" if self.simulated_s is None else f"{self.simulated_s:g} s"

    def text(self) -> str:
        """Return the rates of discharges as a table for people."""
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
        """Return a picture of risk over speed and temperature.

        It shows discharges, film, voltage and current density.
        """
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
                levels = DENSITY_CLASSES if column == "current_density_A_per_mm2" else ()
                field = Mesh(name, unit, x, y, values, levels=levels, log=log)
                panels.append(Panel(name, speed, temperature, self._empty(values), field=field))
        low, some, high = DENSITY_CLASSES
        notes = (
            f"{self.span} at each point, nothing broke down before; seed {self.seed}",
            f"lines of J_b: {low:g} A/mm2, up to which no influence on life is published; {some:g} to {high:g} A/mm2 "
            "suspicious, above dangerous (Muetze and Binder 2007, not read in the original)",
        )
        return ViewData("electric-map", "Bearing currents", f"{self.title}   {self.source}", tuple(panels), 2, notes)

    def _empty(self, values: FloatArray) -> tuple[Series, ...]:
        """Return marks on the points without a value.

        The marks depend on the reason.
        """
        missing = [p for p, value in zip(self.points, values.ravel(), strict=True) if not np.isfinite(value)]
        kinds = ((look, reason, [p for p in missing if p.quiet_because == reason]) for look, reason in enumerate(QUIET))
        return tuple(
            Series(
                reason,
                np.array([p.speed_rpm for p in points]),
                np.array([p.temperature_degC for p in points]),
                "points",
                group=look,
            )
            for look, reason, points in kinds
            if points
        )


def _is_even_in_log(values: Sequence[float]) -> bool:
    ratio = np.diff(np.log(values))
    return len(values) > 2 and bool(np.ptp(ratio) < 1e-6 * np.abs(ratio).max())


def map_text(found: RiskMap) -> str:
    """Return the table of discharges per second.

    The table covers speed and temperature; each speed has a row.
    """
    columns = found.temperatures_degC
    cells = [_rate(point) for point in found.points]
    rows = [f"{'1/min':>9}" + "".join(f"{f'{value:.4g} degC':>10}" for value in columns)]
    for k, speed in enumerate(found.speeds_rpm):
        row = cells[k * len(columns) : (k + 1) * len(columns)]
        rows.append(f"{speed:9.5g}" + "".join(f"{cell:>10}" for cell in row))
    return "\n".join(
        [
            *([line("bearing", f"{found.bearing}, in one circuit with all others")] if found.bearing else []),
            line("source", found.source),
            line("map", f"{len(found.points)} points", f"{found.span} each", f"{found.wall_s:.3g} s in all"),
            "",
            "discharges through the bearing per second (metal: asperities short it; -: no equilibrium)",
            *rows,
            *lines_under("empty", _reasons(found)),
            "",
            *lines_under("assumed", found.assumptions),
        ]
    )


def _reasons(found: RiskMap) -> list[str]:
    """Name the first points without an answer, and why."""
    empty = [point for point in found.points if point.message]
    told = [" ".join(one.message.splitlines()[-1].split()) for one in empty[:_NAMED]]  # without a case's heading
    named = [
        f"{one.speed_rpm:.5g} 1/min at {one.temperature_degC:.4g} degC: {why}"
        for one, why in zip(empty, told, strict=False)
    ]
    return [*named, *([f"and {len(empty) - _NAMED} more: --out and --json name all"] if len(empty) > _NAMED else [])]


def _rate(point: RiskPoint) -> str:
    value = point.discharges_per_s
    if value is None:
        return "-"
    if point.quiet_because == "metal":
        return "metal"
    return f"{value:.3g}" if value < 1000.0 else f"{1e-3 * value:.3g}k"
