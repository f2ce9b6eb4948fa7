"""Summarise one run (the `--json` object)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from lambda_core.domain.channels import RINGS, SHORTED
from lambda_core.domain.errors import BearingNeededError, UsageError
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.elements.ball.kinds import kind_of
from lambda_core.formulas.loading import CARRYING, Ring, carries, largest_contact, loaded_elements
from lambda_core.results.answer import dataset, declared_numbers
from lambda_core.results.averages import Interval, finite
from lambda_core.results.bearing_summary import BearingSummary, Contact, StartState
from lambda_core.results.convergence import (
    settings_of,
    shortfalls,
    shortfalls_together,
    torque_together,
    window_of,
)
from lambda_core.results.currents import currents_of
from lambda_core.results.limits import Grooves, Shoulder, shoulders, tolerance_warning, warnings, worst
from lambda_core.results.machine_numbers import (
    ElementForce,
    Swing,
    element_numbers,
    machine_numbers,
    machine_warnings,
    reactions,
    said_once,
    total,
)
from lambda_core.results.model_band import sum_of_bands
from lambda_core.results.numerical_damping import FOURTH_POWERS, ITERATION_WORK, NumericalDamping, numerical_damping
from lambda_core.results.observed import observed_numbers, occurred_events
from lambda_core.results.quantity import FLOATING, SMALL, quantity, shown
from lambda_core.results.rating import rated_verdict
from lambda_core.results.record import INTERFACE, Record
from lambda_core.results.ring_deformation import ring_deformations
from lambda_core.results.rolling import ROLLING, SECOND_CAGE, is_full_complement, rolling_of, second_cage_ratio
from lambda_core.results.run_status import Status

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

_MECHANISMS_OF_CAGE = ("pocket", "land")
_NO_COUNTS = (FOURTH_POWERS, ITERATION_WORK)  # statistics of a run that stand elsewhere in its summary


class FieldOfOneBearingError(BearingNeededError, AttributeError):
    """Request for one bearing's field of several.

    The summary has several bearings; an AttributeError too, for hasattr.
    """


class Summary(Record):
    """Averages of a run and its end state.

    They are those of the machine, and of each bearing.

    With one bearing, the numbers of that bearing are also attributes of the summary: ``summary.min_film_um``.
    The names are stable under one number of `interface`. A number that does not exist
    yet (an average before the first whole cage revolution) is null.
    """

    interface: int = INTERFACE
    case: str
    title: str
    headline: str = Field(description="lines that describe the run")
    file: str
    state: Literal["running", "finished", "stopped", "interrupted", "failed"]
    converged: bool
    reasons: list[str] = Field(description="why the run is not converged; empty when it is")

    friction_torque_Nmm: float | None = quantity(
        "of all bearings: dissipated power over |Omega_i - Omega_o|", "N mm", label="friction torque of all bearings",
        digits=4, group="friction",
    )  # fmt: skip
    friction_torque_ci_Nmm: float | None = quantity(
        "95 % confidence half-width of friction_torque_Nmm; of several bearings the sum of theirs", "N mm",
        label="95 % confidence half-width of the friction torque", decimals=2,
    )  # fmt: skip
    power_loss_W: float | None = quantity(
        "mean dissipated power of all bearings", "W", label="power loss of all bearings", decimals=FLOATING, digits=3,
        group="friction",
    )  # fmt: skip
    friction_torque_Nmm_band: list[float] = Field(
        description="ends of the 90 % model band, of several bearings the sum of theirs; empty without one", default=[]
    )
    power_loss_W_band: list[float] = Field(description="the same of power_loss_W", default=[])
    bearings: dict[str, BearingSummary] = Field(description="each bearing by its name")
    speed_rpm: float | None = Field(description="of a machine's shaft at t = 0", default=None)
    drive_torque_Nm: float | None = quantity(
        "of the coupling on a machine's shaft, with friction; null where torques change", "N m",
        label="torque of the coupling on the shaft", column="drive torque", decimals=3, group="friction", default=None,
    )  # fmt: skip
    system_life_h: float | None = quantity(
        "of all bearings of a machine by their reference rating lives at the start, 90 %", "h",
        label="life of all bearings, 90 %", group="life", default=None,
    )  # fmt: skip
    orbit: list[Swing] = Field(description="of a machine's shaft at every lump", default=[])
    bodies: dict[str, Swing] = Field(description="bodies of a machine other than the shaft", default={})
    markers: dict[str, Swing] = Field(description="named places of a machine", default={})
    elements: dict[str, ElementForce] = Field(
        description="force elements of a bearing, connections by a law of a machine", default={}
    )
    plugin_faults: list[str] = Field(description="observers and events that failed, and why", default=[])
    warnings: list[str] = Field(description="where case or run left what bearings, oil and laws are made for")
    energy_residual: float | None = quantity(
        "(input - dissipated - stored) over integral of |input power|", label="energy residual",
        column="energy residual", decimals=SMALL, group="trust",
    )  # fmt: skip
    iteration_residual: float | None = quantity(
        "work of early ends of Newton's iteration, counted positive, over the same",
        label="ends of Newton's iterations", decimals=SMALL, group="trust", default=None,
    )  # fmt: skip

    simulated_s: float = quantity("simulated time", "s", decimals=FLOATING, digits=4, group="trust")
    wall_s: float = Field(description="wall time of the integration")
    wall_per_simulated_second: float | None
    vibrations: NumericalDamping | None = Field(description="accuracy of the vibrations")
    solver_statistics: dict[str, float]
    assumptions: list[str]

    def __getattr__(self, name: str) -> Any:
        if name in BearingSummary.model_fields:
            each = self.__dict__.get("bearings", {})
            if len(each) == 1:
                return getattr(next(iter(each.values())), name)
            first = next(iter(each), "NAME")
            raise FieldOfOneBearingError(
                f"{name} is of one bearing: choose one, {' or '.join(each)} "
                f'(--bearing {first}, in Python summary.bearings["{first}"].{name})'
            )
        raise AttributeError(f"a summary has no {name}")

    def text(self, width: int | None = None, units: UnitSystem = SI) -> str:
        """Return the lines of text in some units.

        None is longer than `width` where one is given.
        """
        from lambda_core.results.run_text import summary_text

        return summary_text(self, width, units)

    def to_xarray(self) -> Any:
        """Return the averages as an xarray.Dataset.

        They are those of every bearing, with units; UsageError without xarray.

        Returns
        -------
        xarray.Dataset
            Dimension bearing, and the axes of vectors; numbers of the machine have none.
        """
        data, labels = declared_numbers(self.bearings, "bearing")
        total, _ = declared_numbers({"": self}, "bearing")
        for name, (_, values, facts) in total.items():
            data.setdefault(name, ((), values[0], facts))
        return dataset(data, labels, {"case": self.case, "title": self.title, "state": self.state})

    def __repr__(self) -> str:
        """Return case, state and friction torque."""
        return f"<Summary {self.case}, {self.state}, friction torque {shown(self, 'friction_torque_Nmm')}>"


def field_names() -> dict[str, str]:
    """Return the names of all numbers with meanings.

    A summary's names follow the machine's.
    """
    every = BearingSummary.model_fields | Summary.model_fields
    return {name: every[name].description or "" for name in (*Summary.model_fields, *every)}


def summarise(result: Result) -> Summary:
    """Compute the summary of a result.

    The file is of a machine, or of the bearing that the result looks at.
    """
    from lambda_core.results.opening import opened  # commands that read no result start without h5py

    with opened(result.path):  # once for all that is read
        return _summarised(result)


def _summarised(result: Result) -> Summary:
    status = result.status()
    if not status.rows.samples or not status.rows.records:
        raise UsageError(f"{result.path} holds no samples yet: wait for the first ones, or run the case again")
    of_machine = result.is_machine and (not result.bearing or len(result.bearing_names) == 1)
    each = result.bearings if of_machine else {result.bearing: result}
    # A bearing of a machine need not be known better than all of them together.
    windows = [window_of(one) for one in result.bearings.values()]
    together = torque_together(windows) if len(windows) > 1 else 0.0
    bearings = {name: _of_bearing(one, status, together) for name, one in each.items()}
    first = next(iter(each.values()))
    alone = next(iter(bearings.values()))
    integrals = first.integrals()
    run_interval = Interval(integrals[0], integrals[-1])  # energy is balanced for the machine
    time = run_interval.change("time")
    known = list(bearings.values())
    shortfalls = [*shortfalls_together(windows), *said_once({name: one.reasons for name, one in bearings.items()})]
    reasons = _reasons(status.state, status.message, shortfalls if of_machine else alone.reasons)
    start = max(float(window_of(one).interval.first[0]) for one in each.values())
    return Summary(
        case=result.case,
        title=result.title,
        headline=result.headline,
        file=str(result.path),
        state=status.state,
        converged=not reasons,
        reasons=reasons,
        friction_torque_Nmm=total(one.friction_torque_Nmm for one in known),
        friction_torque_ci_Nmm=total(one.friction_torque_ci_Nmm for one in known),
        power_loss_W=total(one.power_loss_W for one in known),
        friction_torque_Nmm_band=sum_of_bands([one.friction_torque_Nmm_band for one in known]),
        power_loss_W_band=sum_of_bands([one.power_loss_W_band for one in known]),
        bearings=bearings,
        elements=element_numbers(result.of_machine() if of_machine and result.is_machine else first, start),
        plugin_faults=list(status.faults),
        warnings=alone.warnings if not of_machine else machine_warnings(result, bearings),
        energy_residual=finite(run_interval.energy_residual()),
        iteration_residual=_iteration_residual(status.statistics, run_interval),
        simulated_s=time,
        wall_s=status.wall,
        wall_per_simulated_second=finite(_quotient(status.wall, time)),
        vibrations=numerical_damping(settings_of(first), status, time),
        solver_statistics={name: count for name, count in status.statistics.items() if name not in _NO_COUNTS},
        assumptions=list(result.of_machine().assumptions) if of_machine else alone.assumptions,
        **(machine_numbers(result, bearings, start) if of_machine else {}),
    )


def _of_bearing(result: Result, status: Status, together: float) -> BearingSummary:
    """Return the summary of one bearing.

    `together` is that of :func:`.convergence.shortfalls`.
    """
    integrals = result.integrals()
    settings, last = settings_of(result), integrals[-1]
    run_interval, chosen = Interval(integrals[0], last), window_of(result)
    full = is_full_complement(result.model)
    turns = {"turns": "roller orbits"} if full else {}
    reasons = shortfalls(settings, chosen, run_interval.energy_residual(), together, **turns)
    start = float(chosen.interval.first[0])
    extremes = _Span.of(result, start)
    epicyclic = extremes.rolling
    ratio, pressure = chosen.interval.ratio("cage_angle", "inner_angle"), finite(1e-9 * extremes.pressure)
    end = _sample(result, -1)
    edges, element = _edges(result), "ball" if result.model.get("rollers") is None else "roller"
    second_cage = result.blocks(SECOND_CAGE, start) if result.model["cage"].get("per_row") else ()
    carrying = end["load"] > CARRYING * end["load"].max()
    revolutions = run_interval.change("relative_angle") / (2.0 * math.pi)
    of_machine: dict[str, Any] = reactions(result, start) if result.is_machine else {}
    found = BearingSummary(
        title=result.title,
        headline=result.headline,
        converged=not reasons,
        reasons=reasons,
        full_complement=full,
        friction_torque_Nmm=finite(1e3 * chosen.interval.torque()),
        friction_torque_ci_Nmm=finite(1e3 * chosen.torque.half_width),
        power_loss_W=finite(chosen.interval.torque() * chosen.interval.ratio("relative_angle", "time")),
        input_torque_Nmm=finite(1e3 * chosen.interval.ratio("drive", "relative_angle")) if _is_driven(result) else None,
        support_power_W=finite(chosen.interval.ratio("support", "time")) or None,
        friction_breakdown_Nmm=merged_cage(chosen.interval.breakdown()),
        cage_speed_ratio=finite(ratio),
        cage_speed_over_epicyclic=finite(ratio / epicyclic),
        second_cage_speed_ratio=finite(second_cage_ratio(second_cage)),
        epicyclic_ratio=finite(epicyclic),
        contacts=contact_list(end),
        inner_ring_displacement_um=[finite(1e6 * value) for value in chosen.interval.position()],
        inner_ring_tilt_mrad=[finite(1e3 * angle) for angle in extremes.tilt],
        bent=ring_deformations(result, start),
        max_pressure_GPa=pressure,
        min_film_um=finite(1e6 * extremes.film),
        film_um=span(1e6 * end["film_central"][carrying]),
        film_parameter=span(end["film_parameter"][carrying]),
        contact_capacitance_pF=span(1e12 * end["capacitance"][carrying]),
        bearing_capacitance_nF=finite(1e9 * float(end["bearing_capacitance"])),
        capacitance_note=capacitance_note(end["load"], end["capacitance"], element),
        currents=currents_of(result, start),
        observed=observed_numbers(result, start),
        events=occurred_events(result),
        verdict=rated_verdict(
            result.rating, pressure, span(end["film_parameter"][carrying]), 1e3 * extremes.largest_tilt
        ),
        rating=result.rating,
        shoulders=edges,
        **of_machine,
        warnings=[
            *result.case_warnings,
            *tolerance_warning(settings.tolerance),
            *warnings(
                _highest_pressure(result),
                edges,
                extremes.largest_tilt,
                kind_of(result.model["geometry"]).name,
                on_shaft=result.is_machine,
            ),
        ],
        revolutions_discarded=chosen.discarded,
        revolutions_averaged=chosen.revolutions,
        wall_per_revolution_s=finite(_quotient(status.wall, revolutions)),
        equilibrium=_equilibrium(result),
        assumptions=list(result.assumptions),
    )
    return found.with_band(result.model_band) if result.model.get("rollers") is None else _of_rollers(found, result)


def _is_driven(result: Result) -> bool:
    """Tell whether a ring's rotation is prescribed.

    A torque on a bearing alone is a load.
    """
    rings = (result.model["inner_ring"], result.model["outer_ring"])
    return result.is_machine or any(ring["dofs"]["spin"]["mode"] == "prescribed" for ring in rings)


def _of_rollers(found: BearingSummary, result: Result) -> BearingSummary:
    """Return the summary of rollers.

    It lacks what holds for balls alone: shoulders, limits of tilt and pressure.
    """
    verdict = found.verdict
    beyond = [] if verdict is None or verdict.met else [verdict.sentence]
    changes: dict[str, Any] = {
        "shoulders": [],
        "warnings": [*result.case_warnings, *tolerance_warning(settings_of(result).tolerance), *beyond],
    }
    return found.model_copy(update=changes).with_band(result.model_band)


def _iteration_residual(statistics: Mapping[str, float], run_interval: Interval) -> float | None:
    """Return the iteration's relative work.

    Early ends of the iteration put it in or took it; over the energy that flowed.
    """
    work, flow = statistics.get(ITERATION_WORK), run_interval.change("input_abs")
    return None if work is None or not flow > 0.0 else work / flow


def _reasons(state: str, message: str, found: list[str]) -> list[str]:
    """Put the end first among the reasons.

    A run that did not reach it is not converged, whatever its averages are.
    """
    ends = {"running": "the run has not reached its end", "failed": "the solver could not go on"}
    if state == "finished":
        return [message, *found] if found and message else found
    return [message or ends.get(state, "the run was stopped before its end"), *found]


def merged_cage(parts: Mapping[str, float]) -> dict[str, float | None]:
    """Return torques with the cage as one [N mm].

    The keys are mechanisms, from torques in N m; the cage's contacts are one.
    """
    merged = {name: value for name, value in parts.items() if name not in _MECHANISMS_OF_CAGE}
    merged["cage"] = sum(parts[name] for name in _MECHANISMS_OF_CAGE)
    return {name: finite(1e3 * value) for name, value in merged.items()}


@dataclass(frozen=True)
class _Span:
    """Contacts under load in the averaging window."""

    pressure: float  # largest [Pa]
    film: float  # smallest minimum film [m]
    rolling: float  # cage speed over inner ring speed of rolling balls, weighted by load
    tilt: tuple[float, float]  # mean tilt of the inner ring about y and z [rad]
    largest_tilt: float  # between the axes of the rings [rad]

    @staticmethod
    def of(result: Result, start: float) -> _Span:
        pressure, film, weighted, total = 0.0, math.inf, 0.0, 0.0
        tilts, largest, count = np.zeros(2), 0.0, 0
        names = (*ROLLING, "max_pressure", "film_minimum", "body_tilt")
        for block in result.blocks(names, start):
            inner, outer = (block["body_tilt"][:, body] for body in (0, 1))
            largest = max(largest, float(np.hypot(*(inner - outer).T).max()))
            tilts, count = tilts + inner.sum(axis=0), count + len(inner)
            load = block["load"]
            loaded = load > 0.0
            if not loaded.any():
                continue
            pressure = max(pressure, float(block["max_pressure"][loaded].max()))
            film = min(film, float(block["film_minimum"][loaded].min()))
            carried = float(load[..., 0].sum())
            rolling = rolling_of(block, result.model["geometry"], are_rollers=result.model.get("rollers") is not None)
            if math.isfinite(rolling):
                weighted, total = weighted + carried * rolling, total + carried
        about_y, about_z = (float(angle) / count if count else math.nan for angle in tilts)
        return _Span(pressure, film, weighted / total if total > 0.0 else math.nan, (about_y, about_z), largest)


def _edges(result: Result) -> list[Shoulder]:
    """Return the contacts nearest to the shoulders.

    They are those of the whole run.
    """
    grooves, found = Grooves.of(result.model["geometry"]), list[Shoulder]()
    for block in result.blocks(("load", "contact_angle", "semi_axis_a")):
        found += shoulders(grooves, block["load"], block["contact_angle"], block["semi_axis_a"])
    return worst(found)


def _highest_pressure(result: Result) -> float:
    """Return the run's largest Hertzian pressure [Pa].

    0 of a file that holds no samples yet.

    Another run with the option to overwrite the file may have put its own, just begun, in this one's place.
    """
    return max((float(block["max_pressure"].max()) for block in result.blocks(("max_pressure",))), default=0.0)


def contact_list(state: Mapping[str, NDArray[np.float64]]) -> list[Contact]:
    """Return every contact at one instant.

    The channels have shapes (ball,) and (ball, ring), SI.
    """
    load = state["load"]
    return [
        Contact(
            element=ball + 1,
            ring=name,
            azimuth_deg=math.degrees(float(state["ball_azimuth"][ball])) % 360.0,
            load_N=float(load[ball, ring]),
            contact_angle_deg=math.degrees(float(state["contact_angle"][ball, ring])),
            film_um=finite(1e6 * float(state["film_central"][ball, ring])) if load[ball, ring] > 0.0 else None,
            capacitance_pF=finite(1e12 * float(state["capacitance"][ball, ring])),
        )
        for ball in range(load.shape[0])
        for ring, name in enumerate(get_args(Ring))
    ]


def capacitance_note(load: NDArray[np.float64], capacitance: NDArray[np.float64], element: str) -> str:
    """Explain missing capacitances.

    The note tells which contacts have none, shape (element, ring), and so why the bearing may have none.

    Contacts under load are counted apart from those that hold no more than the weight and the centrifugal force of a
    ball or a roller.
    """
    touching = load > 0.0
    shorted = np.isinf(capacitance) & touching
    if not shorted.any():
        return ""
    loaded = touching & carries(load[:, 0])[:, None]
    counts = [
        f"{np.count_nonzero(shorted & group)} of {np.count_nonzero(group)} {what}"
        for group, what in ((loaded, "contacts under load"), (touching & ~loaded, "others"))
        if group.any()
    ]
    both = bool(shorted.all(axis=1).any())
    return f"asperities short {' and '.join(counts)} (film parameter below {SHORTED:g})" + (
        f", some at both rings of a {element}: the bearing has no capacitance" if both else ""
    )


def _sample(result: Result, row: int) -> dict[str, NDArray[np.float64]]:
    names = ("load", "ball_azimuth", "contact_angle", "film_central", "film_parameter", "max_pressure")
    return result.sample(row, (*names, "capacitance", "bearing_capacitance"))


def _equilibrium(result: Result) -> StartState:
    first = _sample(result, 0)
    largest, ring = largest_contact(first["load"])
    return StartState(
        loaded_elements=loaded_elements(first["load"][:, RINGS.index("inner")]),
        max_load_N=largest,
        max_load_ring=ring,
        max_pressure_GPa=1e-9 * float(first["max_pressure"].max()),
    )


def span(values: NDArray[np.float64]) -> list[float]:
    """Return the smallest and largest finite number.

    Nothing when there is none.
    """
    finite = values[np.isfinite(values)]
    return [float(finite.min()), float(finite.max())] if finite.size else []


def _quotient(numerator: float, denominator: float) -> float:
    return numerator / denominator if denominator > 0.0 else math.nan
