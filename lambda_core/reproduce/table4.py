"""Table 4: friction torque of the 6319, blind and calibrated, beside the measurement and other methods."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from pydantic import Field

from lambda_core.reproduce import parameters as P
from lambda_core.reproduce.published import LOADS, METHODS, POINTS, TABLE_4, Point, mean_absolute_error
from lambda_core.reproduce.readings import MECHANISMS
from lambda_core.reproduce.sensitivity import Sensitivity, sensitivities
from lambda_core.reproduce.workshop import Answer, Job, Workshop
from lambda_core.simulate.record import Record

TAU = "parameters.traction.tau_eyring"
TEMPERATURES = (55.0, 60.0, 62.5, 65.0, 70.0)  # of the oil [degC]
SAMPLES, QUICK_SAMPLES = 200, 40
# Beyond the published range too, only to say where a free fit would end.
_TAU_GRID = (4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0)  # [MPa]
BAND = (5.0, 95.0)  # percentiles
LAWS = {"houpert": ("elastic_hysteresis", "houpert"), "none": ("elastic_hysteresis", "none")}
OTHER_ROLLING = "goksem-hargreaves"


class OperatingPoint(Record):
    """One operating point: measured and simulated friction torque."""

    load_N: float
    speed_rpm: float
    measured_Nmm: float
    simulated_Nmm: float = Field(description="blind parameter set")
    calibrated_Nmm: float = Field(description="tau_e fitted on the three points of C/P = 10")


class Detail(Record):
    """What stands behind one point."""

    label: str
    confidence_Nmm: float = Field(description="95 % half-width of the blind run")
    low_Nmm: float = Field(description="5 % of the samples lie below")
    high_Nmm: float = Field(description="5 % of the samples lie above")
    parts_Nmm: dict[str, float]
    quasi_static_Nmm: float = Field(description="without cage, mean over the positions of the balls")
    friction_difference_pct: float = Field(description="dynamic without cage over quasi-static")
    load_difference_pct: float = Field(description="mean load of the most loaded ball, dynamic over quasi-static")
    skf_Nmm: float = Field(description="complete SKF model of this program with the same oil")


class Law(Record):
    """Another published law in place of one of the blind set, nothing else changed."""

    role: str
    law: str
    torque_Nmm: list[float]
    error_pct: float
    simulated: bool = Field(description="by runs; otherwise quasi-static plus the blind runs' difference")


class Calibration(Record):
    """tau_e alone fitted on one row of the table, the other row predicted."""

    fitted_on: str
    tau_e_MPa: float = Field(description="within the published 4 to 8 MPa")
    at_limit: bool
    free_tau_e_MPa: float = Field(description="where the fit would end without the published limits; used for nothing")
    torque_Nmm: list[float]
    simulated: bool
    six_points_pct: float
    fitted_row_pct: float
    predicted_row_pct: float


class Table4(Record):
    """The whole comparison."""

    points: list[OperatingPoint]
    mean_absolute_error_pct: dict[str, float]
    details: list[Detail]
    band: str
    inside_band: int = Field(description="measurements inside the 90 % band, of six")
    laws: list[Law]
    calibrations: list[Calibration]
    sensitivities: list[Sensitivity]
    temperatures: list[dict[str, float]] = Field(description="oil temperature [degC] and error [%]")
    bars: list[str]
    notes: list[str]


def jobs_of(replaced: Mapping[str, str | None] | None = None, kind: str = "friction") -> list[Job]:
    """Return the jobs of the six points with some values of the blind set replaced."""
    return [Job(point.case, P.changes(replaced), kind) for point in POINTS]


def table4(workshop: Workshop, *, quick: bool = False) -> Table4:
    """Run and compare.

    Parameters
    ----------
    quick : bool
        Only the six blind runs are dynamic; laws and calibrations are quasi-static plus what these runs add, and
        the band has fewer samples.
    """
    static, runs = _halves(workshop.all([*jobs_of(), *jobs_of(kind="torque")]))
    blind = [run["torque"] for run in runs]
    offset = np.array(blind) - [s["torque"] for s in static]
    low, high, samples = _band(workshop, offset, QUICK_SAMPLES if quick else SAMPLES)
    laws = _laws(workshop, offset, quick)
    calibrations = _calibrations(workshop, offset, quick)
    temperatures = _temperatures(workshop, offset)
    found = sensitivities(workshop, static, runs, quick)
    calibrated = calibrations[0]
    details = _details(static, runs, low, high, _skf(workshop))
    inside = sum(d.low_Nmm <= p.measured <= d.high_Nmm for d, p in zip(details, POINTS, strict=True))
    errors = {"blind": mean_absolute_error(blind), "calibrated": calibrated.six_points_pct}
    errors |= {f"calibrated on {c.fitted_on}": c.six_points_pct for c in calibrations[1:]}
    errors |= {f"calibrated on {c.fitted_on}, predicted row": c.predicted_row_pct for c in calibrations}
    errors |= {name: mean_absolute_error(TABLE_4[name]) for name in METHODS}
    points = [
        OperatingPoint(
            load_N=LOADS[point.load],
            speed_rpm=float(point.speed),
            measured_Nmm=point.measured,
            simulated_Nmm=blind[i],
            calibrated_Nmm=calibrated.torque_Nmm[i],
        )
        for i, point in enumerate(POINTS)
    ]
    return Table4(
        points=points,
        mean_absolute_error_pct=errors,
        details=details,
        band=f"{samples} samples of a Latin hypercube over {sum(1 for e in P.blind_set() if e.sampled and e.ends)} "
        "published ranges on the quasi-static solution, plus dynamic minus quasi-static of the blind runs",
        inside_band=inside,
        laws=laws,
        calibrations=calibrations,
        sensitivities=found,
        temperatures=temperatures,
        bars=_bars(points, errors, inside, calibrations, details, found),
        notes=_notes(quick),
    )


def _halves(answers: Sequence[Answer]) -> tuple[list[Answer], list[Answer]]:
    half = len(answers) // 2
    return list(answers[:half]), list(answers[half:])


def _torques(answers: Sequence[Answer]) -> list[float]:
    return [answer["torque"] for answer in answers]


def _band(workshop: Workshop, offset: np.ndarray, count: int) -> tuple[list[float], list[float], int]:
    """Return 5 % and 95 % of the sampled torques at each point, and the number of samples that have a solution."""
    jobs = [job for replaced in P.samples(count) for job in jobs_of(replaced)]
    answers = workshop.all(jobs)
    rows = [answers[i : i + len(POINTS)] for i in range(0, len(answers), len(POINTS))]
    solved = [row for row in rows if all(answer.state == "done" for answer in row)]
    torque = np.array([_torques(row) for row in solved]) + offset
    low, high = np.percentile(torque, BAND, axis=0)
    return low.tolist(), high.tolist(), len(solved)


def _simulated(
    workshop: Workshop, offset: np.ndarray, sets: Sequence[Mapping[str, str | None]], quick: bool
) -> list[list[float]]:
    """Return the six torques of each parameter set: by runs, or when `quick` quasi-static plus the offset."""
    kind = "friction" if quick else "torque"
    answers = workshop.all([job for replaced in sets for job in jobs_of(replaced, kind)])
    shift = offset if quick else np.zeros(len(POINTS))
    rows = [_torques(answers[i : i + len(POINTS)]) for i in range(0, len(answers), len(POINTS))]
    return [(np.array(row) + shift).tolist() for row in rows]


def _laws(workshop: Workshop, offset: np.ndarray, quick: bool) -> list[Law]:
    chosen = [*LAWS.values(), ("rolling_resistance", OTHER_ROLLING)]
    found = _simulated(workshop, offset, [P.with_law(role, law) for role, law in chosen], quick)
    return [
        Law(role=role, law=law, torque_Nmm=row, error_pct=mean_absolute_error(row), simulated=not quick)
        for (role, law), row in zip(chosen, found, strict=True)
    ]


def _calibrations(workshop: Workshop, offset: np.ndarray, quick: bool) -> list[Calibration]:
    """Fit tau_e on one row by least squares of the relative errors, on the quasi-static curve through a grid."""
    answers = workshop.all([job for tau in _TAU_GRID for job in jobs_of({TAU: f"{tau:g} MPa"})])
    grid = np.array(_torques(answers)).reshape(len(_TAU_GRID), len(POINTS)) + offset
    fits = [(load, *fitted(grid, load)) for load in LOADS]
    rows = _simulated(workshop, offset, [{TAU: f"{tau:.4g} MPa"} for _, tau, _, _ in fits], quick)
    return [_calibration(*fit, row, not quick) for fit, row in zip(fits, rows, strict=True)]


def fitted(grid: np.ndarray, load: str) -> tuple[float, bool, float]:
    """Return tau_e [MPa] fitted on the points of one load, whether it stands at a limit, and the free optimum.

    Parameters
    ----------
    grid : float64[:, :], shape (len(_TAU_GRID), 6)
        Torque at each tau_e of the grid and each point [N mm].
    """
    from scipy.interpolate import CubicSpline
    from scipy.optimize import minimize_scalar

    mine = [i for i, point in enumerate(POINTS) if point.load == load]
    curve = CubicSpline(_TAU_GRID, grid[:, mine])
    measured = np.array([POINTS[i].measured for i in mine])

    def misfit(tau: float) -> float:
        return float(np.sum((curve(tau) / measured - 1.0) ** 2))

    def best(low: float, high: float) -> float:
        return float(minimize_scalar(misfit, bounds=(low, high), method="bounded", options={"xatol": 1e-4}).x)

    low, high = (float(end.split()[0]) for end in P.entry(TAU).range)
    tau = round(best(low, high), 2)
    return tau, tau in (low, high), best(_TAU_GRID[0], _TAU_GRID[-1])


def _calibration(load: str, tau: float, at_limit: bool, free: float, row: list[float], simulated: bool) -> Calibration:
    def error(keep: list[Point]) -> float:
        chosen = [(value, point) for value, point in zip(row, POINTS, strict=True) if point in keep]
        return mean_absolute_error([value for value, _ in chosen], tuple(point for _, point in chosen))

    own = [point for point in POINTS if point.load == load]
    return Calibration(
        fitted_on=f"C/P = {load.removeprefix('cp')}",
        tau_e_MPa=tau,
        at_limit=at_limit,
        free_tau_e_MPa=free,
        torque_Nmm=row,
        simulated=simulated,
        six_points_pct=mean_absolute_error(row),
        fitted_row_pct=error(own),
        predicted_row_pct=error([point for point in POINTS if point not in own]),
    )


def _temperatures(workshop: Workshop, offset: np.ndarray) -> list[dict[str, float]]:
    sets = [{"lubricant.temperature": f"{value:g} degC"} for value in TEMPERATURES]
    rows = _simulated(workshop, offset, sets, quick=True)
    return [
        {"temperature_degC": value, "error_pct": mean_absolute_error(row)}
        for value, row in zip(TEMPERATURES, rows, strict=True)
    ]


def _skf(workshop: Workshop) -> list[float]:
    return [answer["total"] for answer in workshop.all(jobs_of(kind="skf"))]


def _details(
    static: Sequence[Answer], runs: Sequence[Answer], low: list[float], high: list[float], skf: list[float]
) -> list[Detail]:
    return [
        Detail(
            label=point.label,
            confidence_Nmm=run["ci"],
            low_Nmm=low[i],
            high_Nmm=high[i],
            parts_Nmm={name: run[name] for name in MECHANISMS},
            quasi_static_Nmm=still["torque"],
            friction_difference_pct=100.0 * ((run["torque"] - run["cage"]) / still["torque"] - 1.0),
            load_difference_pct=100.0 * (run["max_load_N"] / still["max_load_N"] - 1.0),
            skf_Nmm=skf[i],
        )
        for i, (point, still, run) in enumerate(zip(POINTS, static, runs, strict=True))
    ]


def _bars(
    points: Sequence[OperatingPoint],
    errors: Mapping[str, float],
    inside: int,
    calibrations: Sequence[Calibration],
    details: Sequence[Detail],
    found: Sequence[Sensitivity],
) -> list[str]:
    """Say which bars are met and by how much others are missed."""

    def bar(name: str, value: float, limit: float) -> str:
        short = f"{name}: {value:.3g} %, bar {limit:g} %"
        return f"met: {short}" if value < limit else f"missed by {value - limit:.1f}: {short}"

    torque = np.array([p.simulated_Nmm for p in points]).reshape(2, 3)
    rises = bool(np.all(np.diff(torque, axis=1) > 0.0) and np.all(np.diff(torque, axis=0) > 0.0))
    apart = max(abs(d.friction_difference_pct) for d in details)
    loads = max(abs(d.load_difference_pct) for d in details)
    lines = [
        bar("blind, six points", errors["blind"], 12.0),
        f"{'met' if inside >= 5 else 'missed'}: {inside} of 6 measurements inside the 90 % band, bar 5",
        *(bar(f"calibrated on {c.fitted_on}, six points", c.six_points_pct, 8.5) for c in calibrations),
        *(bar(f"calibrated on {c.fitted_on}, predicted row", c.predicted_row_pct, 8.5) for c in calibrations),
        f"{'met' if rises else 'missed'}: torque rises with speed and load in every step",
        bar("dynamic against quasi-static friction, largest difference", apart, 3.0),
        bar("dynamic against quasi-static load, largest difference", loads, 1.0),
    ]
    if errors["blind"] >= 12.0:
        best = sorted(found, key=lambda s: -max(abs(s.low_change_pct), abs(s.high_change_pct)))[:3]
        names = ", ".join(f"{s.name} ({s.effect})" for s in best)
        lines.append(f"the torque hangs most on: {names}; it is too low where these terms dominate")
    return lines


def _notes(quick: bool) -> list[str]:
    notes = [
        "the blind set was written down before the first comparison (lambda_core/reproduce/blind.toml) and is the "
        "program's default for any case",
        "Scheuermann's hysteresis law is not shown: its constants are not published",
        "quasi-static torques are means over half a ball pitch",
        "sensitivities to quasi-static parameters are differences of quasi-static solutions, those of the cage of runs",
    ]
    if quick:
        notes.append("quick: laws and calibrations are quasi-static plus what the blind runs add")
    return notes


def rows_of(found: Table4) -> list[tuple[str, list[float], float]]:
    """Return name, six torques and mean error of everything that stands in the table, the measurement first."""
    rows = [("measured", [point.measured_Nmm for point in found.points], 0.0)]
    errors = found.mean_absolute_error_pct
    rows.append(("blind", [point.simulated_Nmm for point in found.points], errors["blind"]))
    rows += [(f"calibrated on {c.fitted_on}", c.torque_Nmm, c.six_points_pct) for c in found.calibrations]
    rows += [
        (f"blind with {law.role.replace('_', ' ')} {law.law}", law.torque_Nmm, law.error_pct) for law in found.laws
    ]
    rows += [(f"{name} (printed)", list(TABLE_4[name]), errors[name]) for name in METHODS]
    skf = [detail.skf_Nmm for detail in found.details]
    return [*rows, ("SKF model of this program", skf, mean_absolute_error(skf))]
