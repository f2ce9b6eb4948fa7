"""Compare with Exudyn's planar ball bearing without lubricant.

Needs the package exudyn (extra "peers"). Both compute the 6208 at 2 kN radial and 2750 1/min. Exudyn's bearing has nine
balls as rigid bodies, Hertz's exponent, dry friction and springs for a cage; ours everything that the default has.
"""

from __future__ import annotations

import importlib.util
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from benchmarks.accuracy import RACEWAY
from benchmarks.cases import Point, with_tolerance
from benchmarks.passage import Horizon, passage
from benchmarks.speed import LADDER, REFERENCE, Run, runs_of
from benchmarks.tables import Cell, Section, Table, Target
from benchmarks.timing import Effort, now
from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.hertz import stiffness_constant
from lambda_core.model.bearing_model import BearingModel
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve

LOAD = 2000.0  # [N]
POINT = Point("6208 radial 2 kN, 2750 1/min", "6208-axial-1300", ("loads.axial=0 N", "loads.radial=2 kN"))
# Steps of Exudyn's implicit integrator [s], with the two kinds of Newton iteration that it has.
MODIFIED = (1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 4e-6, 3e-6, 2.5e-6)
FULL = (1e-4, 5e-5, 2e-5)
REFERENCE_STEP = 5e-7
DURATION = 0.06  # [s] of Exudyn's runs; means are taken over the second half
_MOTION = 1e-3  # how close displacement and cage speed have to come to those of the reference step
_AVERAGED = 16  # cage revolutions of our runs, after one that is discarded: over fewer the cage's mean speed scatters
FRICTION = 0.1  # dry, above 10 mm/s of slip
SLIP_ZONE = 1e-2  # [m/s]
DAMPING = 200.0  # [N s/m] of each contact
CAGE_STIFFNESS, CAGE_DAMPING = 1e5, 1e2  # of the springs that stand for the cage, as in Exudyn's own example


@dataclass(frozen=True)
class PeerRun:
    """One integration with Exudyn."""

    per_second: float  # wall time per simulated second
    per_turn: float  # wall time per revolution of the inner ring [s]
    displacement: float  # of the inner ring along the load, mean of the second half [m]
    cage_ratio: float  # mean orbital speed of the balls over the inner ring's
    friction_power: float  # mean power that drives the inner ring, second half [W]


def stiffness(start: Equilibrium) -> float:
    """Return K of Q = K delta^1.5 [N/m^1.5].

    The mean of inner and outer contact: Exudyn takes one for both.
    """
    raceways = start.context.bundle.raceways[["radius_x", "radius_y", "modulus"]].tolist()
    return float(np.mean([stiffness_constant(x, y, e) for x, y, e in raceways]))


def exudyn_run(start: Equilibrium, step: float, duration: float, *, modified_newton: bool = True) -> PeerRun:
    """Integrate Exudyn's bearing.

    It has the geometry of our model.
    """
    import exudyn as exu
    from exudyn.machines import CreateBallBearing, GetBallBearingData
    from exudyn.utilities import InertiaCylinder, MarkerBodyRigid, SensorBody, SensorObject

    model = start.context.model
    g = model.geometry
    speed = model.inner_ring.dofs["spin"].motion.terms[0].values[0]
    orbit = 0.5 * speed * (1.0 - g.ball_diameter / g.pitch_diameter)
    spin = -0.5 * speed * (g.pitch_diameter / g.ball_diameter - 1.0)  # rolling on both rings
    axis = [0, 0, 1]
    data: dict[str, Any] = GetBallBearingData(
        axis,
        g.outside_diameter,
        g.bore_diameter,
        g.width,
        g.ball_count,
        radiusBalls=0.5 * g.ball_diameter,
        radiusCage=0.5 * g.pitch_diameter,
        innerGrooveRadius=g.groove_radius_inner,
        outerGrooveRadius=g.groove_radius_outer,
    )
    data["radiusBalls"] -= 0.25 * g.clearance
    balls = start.state[: L.NB * g.ball_count].reshape(-1, L.NB)
    data["ballPositions"] = [np.array([b[L.BR] * np.cos(b[L.BPSI]), b[L.BR] * np.sin(b[L.BPSI]), 0.0]) for b in balls]
    system = exu.SystemContainer().AddSystem()
    ground = system.CreateGround()
    density, gravity = model.ball_material.density, [0, -9.81, 0]
    shaft = system.CreateRigidBody(
        referencePosition=[0, 0, 0],
        nodeType=exu.NodeType.RotationRxyz,
        inertia=InertiaCylinder(density, g.width, 0.5 * g.pitch_diameter - 0.5 * g.ball_diameter, axis=2),
        initialDisplacement=[start.displacement[1], start.displacement[2], 0.0],
        initialAngularVelocity=[0, 0, speed],
        gravity=gravity,
    )
    for coordinate in (2, 3, 4):  # planar: no axial motion, no tilt
        system.CreateCoordinateConstraint(bodyNumbers=[shaft, None], coordinates=[coordinate, None], show=False)
    drive = system.CreateCoordinateConstraint(  # ground minus shaft is the offset
        bodyNumbers=[shaft, None], coordinates=[5, None], velocityLevel=True, offset=-speed, show=False
    )
    system.CreateForce(bodyNumber=shaft, loadVector=[0, -LOAD, 0])
    markers = [system.AddMarker(MarkerBodyRigid(bodyNumber=body, localPosition=[0, 0, 0])) for body in (shaft, ground)]
    items = CreateBallBearing(
        system,
        data,
        *markers,
        density,
        density,
        cageInitialAngularVelocity=[0, 0, orbit],
        ballsInitialAngularVelocity=[0, 0, spin],
        gravity=gravity,
        springStiffnessCage=CAGE_STIFFNESS,
        springDampingCage=CAGE_DAMPING,
        contactParametersRingBalls={
            "contactStiffness": stiffness(start),
            "contactStiffnessExponent": 1.5,
            "contactDamping": DAMPING,
            "dynamicFriction": FRICTION,
            "frictionProportionalZone": SLIP_ZONE,
        },
    )
    place, turn = (
        system.AddSensor(SensorBody(bodyNumber=body, storeInternal=True, outputVariableType=kind))
        for body, kind in (
            (shaft, exu.OutputVariableType.Displacement),
            (items["objectCage"], exu.OutputVariableType.AngularVelocity),
        )
    )
    torque = system.AddSensor(
        SensorObject(objectNumber=drive, storeInternal=True, outputVariableType=exu.OutputVariableType.Force)
    )
    system.Assemble()
    settings = _settings(exu, step, duration, modified_newton)
    began = now()
    system.SolveDynamic(settings)
    seconds = now() - began
    displacement: FloatArray = np.asarray(system.GetSensorStoredData(place), dtype=np.float64)
    cage: FloatArray = np.asarray(system.GetSensorStoredData(turn), dtype=np.float64)
    moment: FloatArray = np.asarray(system.GetSensorStoredData(torque), dtype=np.float64)
    half = len(displacement) // 2
    return PeerRun(
        seconds / duration,
        seconds / (duration * speed / (2.0 * math.pi)),
        -float(np.mean(displacement[half:, 2])),
        float(np.mean(cage[half:, 3])) / speed,
        abs(float(np.mean(moment[half:, 1]))) * speed,
    )


def _settings(exu: Any, step: float, duration: float, modified_newton: bool) -> Any:
    settings = exu.SimulationSettings()
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = step
    settings.timeIntegration.numberOfSteps = round(duration / step)
    settings.timeIntegration.endTime = duration
    settings.timeIntegration.newton.useModifiedNewton = modified_newton
    # Steps that its contacts recommend shrink to nothing here; steps are still halved where Newton fails.
    settings.timeIntegration.discontinuous.useRecommendedStepSize = False
    settings.timeIntegration.verboseMode = 0
    settings.linearSolverType = exu.LinearSolverType.EigenDense  # the fastest of its solvers here
    settings.parallel.numberOfThreads = 1
    return settings


@dataclass(frozen=True)
class Setting:
    """Exudyn at one step, and its reference step."""

    step: float  # [s]
    modified_newton: bool
    run: PeerRun
    moves_alike: bool  # displacement and cage speed
    friction_off: float  # relative

    @property
    def alike(self) -> bool:
        """True if it is as accurate as ours.

        Motion and friction have the accuracy of our own runs.
        """
        return self.moves_alike and self.friction_off <= RACEWAY

    def row(self) -> tuple[Cell, ...]:
        """Return the cells of the table."""
        name = f"Exudyn, step {1e6 * self.step:g} us, {'modified' if self.modified_newton else 'full'} Newton"
        verdict = "yes" if self.alike else "motion only" if self.moves_alike else "no"
        return _row(name, self.run, 100.0 * self.friction_off, verdict)


def _settings_of(start: Equilibrium, reference: PeerRun, duration: float, quick: bool) -> list[Setting]:
    """Integrate with every step and compare.

    Twice each, with the reference.
    """
    found = []
    for modified, steps in ((True, MODIFIED), (False, FULL)):
        for step in steps[:3:2] if quick else steps:
            runs = [exudyn_run(start, step, duration, modified_newton=modified) for _ in range(2)]
            one = min(runs, key=lambda run: run.per_second)
            off = [abs(getattr(one, name) / getattr(reference, name) - 1.0) for name in ("displacement", "cage_ratio")]
            friction = abs(one.friction_power / reference.friction_power - 1.0)
            found.append(Setting(step, modified, one, max(off) <= _MOTION, friction))
    return found


def _targets(theirs: list[Setting], per_turn: float) -> tuple[Target, ...]:
    """Compare the fastest accurate settings.

    Ours with theirs, in both readings of "accurate" for theirs.
    """
    found = []
    for what, accurate, must, goal in (
        ("motion alike to 0.1 %", [one for one in theirs if one.moves_alike], 6.0, 15.0),
        ("and friction to 0.5 %", [one for one in theirs if one.alike], 50.0, 100.0),
    ):
        name = f"less time per revolution than Exudyn, {what}"
        if accurate:
            fastest = min(one.run.per_turn for one in accurate)
        else:
            smallest = min(one.step for one in theirs)
            fastest = min(one.run.per_turn for one in theirs if one.step == smallest)
            name += f" (no step down to {1e6 * smallest:g} us is: at least)"
        found.append(Target(name, "times", fastest / per_turn, must, goal, at_least=True))
    return tuple(found)


def measure(effort: Effort) -> Section:
    """Integrate the same operating point with both programs."""
    if importlib.util.find_spec("exudyn") is None:
        return Section("peer", missing='exudyn is not installed: pip install "lambda-bearing[peers]"')
    model = POINT.model()
    start = solve(model)
    duration, finest = (0.02, 5e-6) if effort.quick else (DURATION, REFERENCE_STEP)
    reference = exudyn_run(start, finest, duration)
    theirs = _settings_of(start, reference, duration, effort.quick)
    rows = [one.row() for one in theirs]
    rows.append(_row(f"Exudyn, step {1e6 * finest:g} us: reference", reference, None, ""))
    ours = _ours(model, start, effort)
    rows += [_row(f"ours, tolerance {run.tolerance:.0e}", told, off, good) for run, told, off, good in ours]
    per_turn = min((told.per_turn for _, told, _, good in ours if good == "yes"), default=math.inf)
    columns = (
        "program",
        "wall s/s",
        "wall ms/rev",
        "inner ring displaced um",
        "cage over inner ring",
        "friction power W",
        "off %",
        "accurate",
    )
    notes = (
        f"Exudyn's bearing: planar, {model.geometry.ball_count} balls, Hertz exponent 1.5, dry friction {FRICTION:g}, "
        "no lubricant, springs for a cage; started from our equilibrium, one thread, its default build. Friction "
        "power: Exudyn's from the torque that drives the ring, ours the dissipation of the raceway contacts.",
        "Accurate, Exudyn: displacement and cage speed as with its reference step to 0.1 % (motion), and the friction "
        "power to 0.5 % (yes). Ours: as in the tables above, with the energy balance, over "
        f"{effort.pick(1, _AVERAGED)} cage revolutions. The targets compare the fastest accurate settings; ours is the "
        "same in both.",
    )
    table = Table(f"Nearest open peer, {POINT.name}", columns, tuple(rows), notes)
    return Section("peer", (table,), _targets(theirs, per_turn))


def _row(name: str, run: PeerRun, off: float | None, good: str) -> tuple[Cell, ...]:
    per_turn, moved = 1e3 * run.per_turn, 1e6 * run.displacement
    return (name, run.per_second, per_turn, moved, run.cage_ratio, run.friction_power, off, good)


def _ours(model: BearingModel, start: Equilibrium, effort: Effort) -> list[tuple[Run, PeerRun, float, str]]:
    """Return our runs in the peer's words.

    With the error of the raceway loss [%], and whether it is accurate.
    """
    horizon = Horizon(1.0, effort.pick(1, _AVERAGED))
    tolerances = [factor * model.solver.tolerance for factor in LADDER]
    reference = passage(with_tolerance(model, REFERENCE), start, horizon)
    found = []
    for run in runs_of(model, start, tolerances, horizon, effort.repeats):
        per_turn = run.per_second * run.one.simulated / run.one.turns
        outcome = run.one.outcome
        told = PeerRun(run.per_second, per_turn, run.one.displacement, outcome.cage_ratio, outcome.raceway_power)
        good = "yes" if outcome.good(reference.outcome) else "no"
        found.append((run, told, 100.0 * outcome.raceway_error(reference.outcome), good))
    return found
