"""Resolve the integrator settings of a bearing."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from lambda_core.case.case import Case
from lambda_core.case.modelling import Solver
from lambda_core.domain.units import show
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.model.bearing_model import USUAL_RESOLVE, ChosenLaw
from lambda_core.model.bearing_model import Solver as SolverSettings
from lambda_core.model.laws.time_functions import highest_frequency, peak, time_function
from lambda_core.model.laws.time_laws import signals_of
from lambda_core.model.ledger import Ledger

# A run that has not converged after this many turns of the cage has something to say.
LONGEST_RUN = 30.0  # [cage turns]
MOST_TIME = 1e6  # [s] simulated; at a tenth of a millisecond per step that is a month of computing
MOST_STEPS, MOST_SAMPLES = 1e9, 1e7  # of one run: half a day of computing, some ten gigabytes
# Largest step: the cage must not skip over pocket contacts, nor any step over an excitation. With 200 steps per turn
# a 6319 at 3000 rpm without a cage leaves 1.3e-3 of the energy unexplained, with 400 1.3e-4 for the same wall time.
STEPS_PER_CAGE_TURN = 400.0
STEPS_PER_PERIOD = 20.0
# The formula of order 4 for vibrations: it shifts a frequency by 0.1 % at six steps per period, by 0.006 % at twelve.
FINE_STEPS_PER_CAGE_TURN = 100.0
FINE_STEPS_PER_PERIOD = 6.0
# Samples per period of the highest frequency that is followed. An analyser takes 2.56 behind a filter (ISO 13373-2);
# here is none, and what stands above falls into the spectrum: at a defect 2.56 made a line 2.3 times too high, 5.12
# adds at most 5 %.
SAMPLES_PER_PERIOD = 5.12
_ROUNDED = 1e-9  # what is excited with every turn is not excited faster
LEAST_PER_PERIOD = 2.56  # samples further apart cause a warning
OVER_EXCITATION = 2.0  # frequency that is followed over the highest that is excited


def resolve_solver(
    case: Case, geometry: Geometry, laws: Mapping[str, Mapping[str, ChosenLaw]], ledger: Ledger, *, is_static: bool
) -> SolverSettings:
    """Return the settings of the integrator.

    Objections become problems.
    """
    given, fastest = case.solver, [peak(time_function(signal)) for signal in _spins(case)]
    turn = cage_period(geometry, *fastest)
    if math.isinf(turn) and given.duration is None and not is_static:
        ledger.problem(
            "solver.duration", "is required if nothing turns at first: averages need revolutions of the cage"
        )
    frequency = highest_frequency(*(time_function(signal) for _, signal in signals_of(case)))
    why = surface_of_its_own(laws) or excited_faster("bearing", frequency, max(fastest))
    resolve = resolution(given, frequency, why, ledger, is_silent=is_static)
    found = settings(given, turn, frequency, resolve, ledger)
    if not is_static:
        say_cut(given, found.max_step, ledger)
        end_in_sight(given, case.output.interval, found.duration or found.max_duration, turn, ledger)
        _say_what_folds(case, resolve or frequency, ledger)
    return found


def settings(given: Solver, turn: float, frequency: float, resolve: float, ledger: Ledger) -> SolverSettings:
    """Return the settings of the integrator.

    Parameters
    ----------
    given : Solver
        What the case says.
    turn : float
        Shortest turn of the cage [s]; inf at rest.
    frequency, resolve : float
        Highest one that excites, and that is followed, 0 for averages [Hz].
    """
    longest = given.max_duration or (LONGEST_RUN * turn if math.isfinite(turn) else given.duration or 0.0)
    if given.duration is not None and given.max_duration is not None and given.duration > given.max_duration:
        ledger.problem("solver.duration", f"is longer than solver.max_duration, {show(given.max_duration, 'time')}")
    if resolve:
        largest = min(turn / FINE_STEPS_PER_CAGE_TURN, 1.0 / (FINE_STEPS_PER_PERIOD * resolve))
    else:
        steps = [turn / STEPS_PER_CAGE_TURN, *([1.0 / (STEPS_PER_PERIOD * frequency)] if frequency else [])]
        largest = min(steps)
    if math.isinf(largest):
        largest = (given.duration or 1.0) / STEPS_PER_CAGE_TURN
    return SolverSettings(
        tolerance=given.tolerance,
        duration=given.duration or 0.0,
        max_duration=max(longest, given.duration or 0.0),
        discard_revolutions=given.discard_revolutions,
        average_revolutions=given.average_revolutions,
        max_step=min(given.max_step or largest, largest) if resolve else given.max_step or largest,
        max_wall=given.max_wall or math.inf,
        resolve=resolve,
    )


def say_cut(given: Solver, longest: float, ledger: Ledger) -> None:
    """Report steps that are shorter than requested [s]."""
    if given.max_step is not None and given.max_step > longest:
        ledger.assume(
            f"steps are at most {show(longest, 'time', 3)}: solver.max_step is too long to resolve the vibrations"
        )


def resolution(given: Solver, frequency: float, why: str, ledger: Ledger, *, is_silent: bool) -> float:
    """Return the highest frequency to resolve [Hz].

    0 where averages are the answer; the choice is reported.

    Vibrations are the answer where the case asks for them, has a raceway that is not nominal, or is excited faster
    than the shaft turns.

    Parameters
    ----------
    given : Solver
        What the case says.
    frequency : float
        Highest one that excites [Hz].
    why : str
        What makes vibrations the answer where the case does not say, or nothing.
    """
    if given.accuracy == "averages":
        if given.resolve is not None:
            ledger.problem("solver.resolve", 'needs solver.accuracy = "vibration": averages resolve no frequency')
        return 0.0
    if given.accuracy == "auto" and not why and given.resolve is None:
        return 0.0
    resolve = given.resolve or max(USUAL_RESOLVE, OVER_EXCITATION * frequency)
    if frequency > resolve:
        ledger.problem(
            "solver.resolve", f"is {show(resolve, 'frequency')}: the case is excited at {show(frequency, 'frequency')}"
        )
    if is_silent or (given.accuracy == "vibration" and given.resolve is not None):
        return resolve
    until = f"vibrations are resolved up to {show(resolve, 'frequency')}"
    chosen = f", since {why}" if given.accuracy == "auto" and given.resolve is None else ""
    other = ' (solver.accuracy = "averages" costs less)' if chosen else ""
    ledger.assume(f"{until}{chosen}{other}")
    return resolve


def surface_of_its_own(laws: Mapping[str, Mapping[str, ChosenLaw]]) -> str:
    """Return the raceway that is not nominal, in words.

    The text is empty where there is none.
    """
    for element, roles in laws.items():
        if "surface" in roles and roles["surface"].model.name != "none":
            return f"{element} has the surface law {roles['surface'].model.name}"
    return ""


def excited_faster(what: str, frequency: float, speed: float) -> str:
    """Report an excitation faster than all rotations.

    `what` is excited faster [Hz] than anything turns [rad/s]; or nothing.
    """
    if frequency > speed / (2.0 * math.pi) * (1.0 + _ROUNDED):
        return f"the {what} is excited at {show(frequency, 'frequency')}"
    return ""


def _spins(case: Case) -> tuple[Any, Any]:
    """Return the planned speeds of both rings."""
    return case.operation.speed, case.bodies.outer_ring.spin.motion


def cage_period(geometry: Geometry, inner: float, outer: float = 0.0) -> float:
    """Return the duration of a cage turn [s].

    It is one epicyclic turn at the highest planned speeds [rad/s]; it is infinite at rest.

    omega_c = (Omega_i (1 - D_w/d_m) + Omega_o (1 + D_w/d_m))/2, contact angle 0.
    """
    ratio = geometry.ball_diameter / geometry.pitch_diameter
    speed = 0.5 * (inner * (1.0 - ratio) + outer * (1.0 + ratio))
    return 2.0 * math.pi / speed if speed > 0.0 else math.inf


def _say_what_folds(case: Case, highest: float, ledger: Ledger) -> None:
    """Report samples that are too far apart.

    They are too far apart for the highest frequency that is resolved or excited.
    """
    interval = case.output.interval
    if interval is not None and highest * LEAST_PER_PERIOD * interval > 1.0:
        ledger.assume(
            f"output.interval resolves frequencies up to {show(0.5 / interval, 'frequency')}; faster motion, up to "
            f"{show(highest, 'frequency')}, folds into the spectra at wrong frequencies"
        )


def end_in_sight(given: Solver, interval: float | None, end: float, turn: float, ledger: Ledger) -> None:
    """Refuse what no machine finishes.

    It refuses too long a time, and too many steps or samples in it.

    Parameters
    ----------
    given : Solver
        What the case says.
    interval : float or None
        Between samples, where it is given [s].
    end, turn : float
        Simulated time, and a turn of the cage [s].
    """
    if end > MOST_TIME:
        key = "duration" if given.duration is not None else "max_duration"
        slow = f": one turn of the cage takes {show(turn, 'time', 3)}" if math.isfinite(turn) else ""
        ledger.problem(
            f"solver.{key}", f"is {show(end, 'time', 3)}, at most {show(MOST_TIME, 'time')} are simulated{slow}"
        )
        return
    counted = (
        ("solver.max_step", given.max_step, MOST_STEPS, "steps"),
        ("output.interval", interval, MOST_SAMPLES, "samples"),
    )
    for place, length, most, what in counted:
        if length is not None and end > most * length:
            ledger.problem(
                place, f"makes {end / length:.2g} {what} of {show(end, 'time')}; at most {most:.0e}: "
                f"{show(end / most, 'time')} or longer, or a shorter solver.duration",
            )  # fmt: skip
    resolve = given.resolve
    if resolve is not None and SAMPLES_PER_PERIOD * resolve * end > MOST_SAMPLES:
        made = SAMPLES_PER_PERIOD * resolve * end
        allowed = 0.99 * resolve * MOST_SAMPLES / made  # rounded, it is still allowed
        ledger.problem(
            "solver.resolve", f"makes {made:.2g} samples of {show(end, 'time', 3)}; at most {MOST_SAMPLES:.0e}: "
            f"{show(allowed, 'frequency', 3)} or lower, or a shorter solver.duration",
        )  # fmt: skip
