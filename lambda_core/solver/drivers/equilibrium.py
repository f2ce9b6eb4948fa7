"""Solve the quasi-static equilibrium of a bearing.

A five-degree-of-freedom inner ring, every ball at its azimuth with centrifugal force, gyroscopic moment and the ball's
motion from the equilibrium of its own friction, on the kernels of the dynamics, which it starts. The cage is left out:
a ball that the inner ring does not touch takes the mean orbital speed of the others. Each ball has the mean drag of one
revolution: in the bearing none stays in the oil bath, and the cage carries it through.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import SHORTED
from lambda_core.domain.elements import INNER, LANDS, OUTER
from lambda_core.domain.errors import EquilibriumError, SolverError
from lambda_core.domain.time_limit import is_late
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.elements.ball.raceways import raceways, raceways_of_a_ball
from lambda_core.laws.law import Law
from lambda_core.laws.shear_limit import SHEAR_LIMIT, limitless_sentence, stress_ratio
from lambda_core.laws.state import names_behind
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.checks.loose_rings import loose_directions, loose_sentence
from lambda_core.model.checks.operating_limits import operating_point, operating_warnings
from lambda_core.model.laws.law_context import ContactFrame
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.fault_roles import OUTSIDE, ROLES
from lambda_core.solver.core import Core, core
from lambda_core.solver.drivers.assembly import Assembly
from lambda_core.solver.drivers.ball_paths import follow_paths
from lambda_core.solver.drivers.compiled_laws import Announce, Kernels, check_laws, derive_oils
from lambda_core.solver.drivers.fault_inputs import INPUTS
from lambda_core.solver.drivers.first_state import first_frame, first_state, place_between, roll
from lambda_core.solver.drivers.law_inputs import guides, times
from lambda_core.solver.drivers.position_continuation import by_other_positions
from lambda_core.solver.drivers.ring_values import are_ribs, contacts_by_ring, losses_by_ring, rings_of_contacts
from lambda_core.solver.drivers.solver_context import SolverContext, assemble
from lambda_core.solver.drivers.static_search import CREEP, attempt, driven_at
from lambda_core.solver.drivers.tables import bearing_of_land
from lambda_core.solver.drivers.viscosity_continuation import StaticReport, by_viscosity_continuation
from lambda_core.solver.records import CONTACT_CHANNELS, STATIC_REPORT
from lambda_core.solver.status import Status

_FRAME_ITERATIONS = 4
_FRAME_TOLERANCE = 1e-4  # [rad] change of the frozen contact angle that ends the iteration
# Without friction an iteration is cheap, and at low speed unloaded balls slide far along the groove.
MAX_ITERATIONS = {False: 5000, True: 1000}
_FRESH_STARTS, _FRESH_ITERATIONS = 3, 300  # with friction, where the first attempt stalls
# Rollers with friction: found after 260 iterations at most in 152 of 156 operating points, or not at all. About a
# second; a fresh start finds nothing either.
_ROLLER_ITERATIONS = 500
# First step in pseudo-time [s]; from a state near the equilibrium; and that with which the way from there is tried
# first, for so many iterations: above 1 s the continuation is Newton's method.
_FIRST_STEP, _NEAR_STEP, _NEWTON_STEP, _NEWTON_ITERATIONS = 1e-6, 1e-2, 10.0, 15
# Where drag is averaged over a revolution; balls dip into a bath of usual level over about 70 degrees.
_DRAG_AZIMUTHS = 36
_LOAD, _ANGLE = CONTACT_CHANNELS.index("load"), CONTACT_CHANNELS.index("contact_angle")


@dataclass
class Equilibrium:
    """The quasi-static solution.

    Attributes
    ----------
    state : float64[:], shape (size,)
        State vector (layout in lambda_core.solver.layout), balls at their own orbital speeds.
    contacts : float64[:, :, :], shape (balls, 2, 16)
        Contact channels (sampling.CONTACT_CHANNELS), inner then outer ring; see ring_values.contacts_by_ring.
    arcs : float64[:, :, :], shape (balls, contacts of a ball, 16)
        The same by raceway, in the order of system.raceways.raceways_of_a_ball.
    losses : float64[:], shape (16,)
        Dissipated power by mechanism [W].
    displacement : tuple of 5 floats
        Inner ring x, y, z [m], tilt about y and z [rad].
    orbit : float
        Mean orbital speed of the loaded balls [rad/s].
    relative_speed : float
        |Omega_i - Omega_o| [rad/s].
    iterations : int
        Of the pseudo-transient continuation with friction.
    converged : bool
        False where only the normal forces are in equilibrium and the balls roll kinematically.
    phase : float
        Where the balls stand, in ball pitches.
    """

    context: SolverContext
    state: FloatArray
    contacts: FloatArray
    arcs: FloatArray
    losses: FloatArray
    displacement: tuple[float, float, float, float, float]
    orbit: float
    relative_speed: float
    iterations: int
    converged: bool = True
    phase: float = 0.0

    @property
    def pose(self) -> FloatArray:
        """Return the inner ring's pose against the outer one.

        In the order of POSE, (5,) [m, rad].
        """
        inner, outer = self.context.bundle.bodies_now[INNER], self.context.bundle.bodies_now[OUTER]
        tilt = inner.tilt - outer.tilt
        return np.array([*(inner.position - outer.position), -tilt[1], tilt[0]])

    def loads_by_row(self) -> tuple[list[float], list[float]]:
        """Return the raceway loads row by row [N].

        Inner and outer, of four-point contact by pairs of arcs.
        """
        load = self.arcs[:, ~are_ribs(self.context.model.geometry), _LOAD]
        sides = load.shape[1] // 2
        return load[:, :sides].T.ravel().tolist(), load[:, sides:].T.ravel().tolist()


def solve(
    model: BearingModel,
    kernels: Kernels | None = None,
    announce: Announce = None,
    *,
    strict: bool = True,
    by_warmer_oil: bool = True,
    with_friction: bool = True,
    phase: float = 0.0,
    near: Equilibrium | None = None,
) -> Equilibrium:
    """Find the quasi-static equilibrium at t = 0.

    Parameters
    ----------
    strict : bool
        Whether the balls' friction must be in equilibrium too. The dynamics can start without it, from rolling balls,
        unless the limit of wall time has passed.
    by_warmer_oil : bool
        Whether to go by way of warmer oil where the direct search fails, which takes ten times as long.
    with_friction : bool
        Whether friction moves the balls; without it they roll kinematically under their normal forces.
    phase : float
        Where the balls stand, in ball pitches: at 0 one of them is lowest, at 0.5 two are equally low.
    near : Equilibrium, optional
        Of the same balls at other azimuths, from whose places the search for the normal forces begins.

    Raises
    ------
    SolverError
        When there is none, with what was tried.
    """
    if model.thermal is not None:
        raise SolverError(f"{model.name}: internal error: temperatures must be computed before the equilibrium")
    if loose := loose_directions(model):
        raise SolverError(loose_sentence(model.name, loose[0]))
    kernels = kernels or Kernels(model, announce)
    frame = first_frame(model) if near is None else near.context.frame
    oils = derive_oils(model, kernels, frame)
    # A law that breaks the rules is refused at once, not after the solver was compiled.
    check_laws(model, kernels, frame, oils)
    compiled = core(announce)
    state: FloatArray | None = None
    for _ in range(_FRAME_ITERATIONS):
        context = assemble(model, kernels, frame, oils)
        if state is None:
            state = first_state(context, phase)
            if near is not None:
                place_between(context, state, near.state)
        without_friction(compiled, context, state)
        contacts, _ = contact_channels(compiled, context, state)
        new = mean_frame(model.geometry, contacts, frame)
        change = max(abs(a - b) for a, b in zip(new.angles, frame.angles, strict=True))
        frame = new
        if change < _FRAME_TOLERANCE:
            break
    context = assemble(model, kernels, frame, oils)
    assert state is not None
    creeps = without_friction(compiled, context, state)
    roll(model, frame, L.elements_in(context.bundle, state), contacts)
    smooth, converged = state.copy(), with_friction
    try:
        if with_friction:
            report = _with_friction(compiled, context, state, strict=strict, by_warmer_oil=by_warmer_oil)
            report = follow_paths(
                context,
                state,
                report,
                lambda near, driven: continue_static(compiled, context, near, friction=True, driven=driven),
                partial(driven_at, compiled, context),
            )
    except SolverError:
        if strict or is_late():
            raise
        converged = False
    if not converged:
        if creeps is not None:
            raise creeps
        state, report = smooth, np.zeros(1, dtype=STATIC_REPORT)
        report["orbit"] = smooth[L.BVT] / smooth[L.BR]
    channels = contact_channels(compiled, context, state)
    return solution(context, state, channels, report, phase=phase, converged=converged)


def solution(
    context: SolverContext,
    state: FloatArray,
    channels: tuple[FloatArray, FloatArray],
    report: StaticReport,
    *,
    phase: float,
    converged: bool = True,
) -> Equilibrium:
    """Return the solution of an equilibrium's state.

    `channels` as :func:`contact_channels` returns them.
    """
    arcs, losses = channels
    inner, outer = context.bundle.bodies_now[INNER], context.bundle.bodies_now[OUTER]
    x, y, z, tilt_y, tilt_z = (float(v) for v in (*inner.position, -inner.tilt[1], inner.tilt[0]))
    return Equilibrium(
        context,
        state,
        contacts_by_ring(context.model.geometry, arcs),
        arcs,
        losses,
        displacement=(x, y, z, tilt_y, tilt_z),
        orbit=float(report["orbit"][0]),
        relative_speed=abs(float(inner.spin - outer.spin)),
        iterations=int(report["iterations"][0]),
        converged=converged,
        phase=phase,
    )


def continue_static(
    compiled: Core,
    context: SolverContext,
    state: FloatArray,
    *,
    friction: bool,
    is_near: bool = False,
    once: bool = False,
    driven: NDArray[np.int64] | None = None,
) -> StaticReport:
    """Run the continuation from `state`, in place; returns its report.

    From a state that `is_near` the equilibrium it begins with Newton's method, and from the same state with shorter
    steps where that does not end soon; `once` it is given up there.
    Which balls are `driven` by the cage is decided in the state where it is not known.

    With friction it begins anew where it stalls, as methods with a memory are restarted (Powell 1977, Math. Program.
    12, 241): a ball at a kink of its friction narrows the limit on its own steps to nothing, and the step in
    pseudo-time, which waits for all balls, stays what it was. Rollers are given one attempt, and so is a traction law
    that gives stresses of no oil: its slopes are what the continuation cannot follow.
    """
    system = context.bundle.system[0]
    system["friction_on"], system["guides_on"], system["drag_azimuths"] = int(friction), 0, _DRAG_AZIMUTHS
    of_rollers = friction and context.model.rollers is not None
    most = _ROLLER_ITERATIONS if of_rollers else MAX_ITERATIONS[friction]
    attempts = [(most, _NEAR_STEP if is_near else _FIRST_STEP)]
    attempts += [(_FRESH_ITERATIONS, _FIRST_STEP)] * (_FRESH_STARTS if friction and not of_rollers else 0)
    spent = 0.0
    if is_near:
        there = state.copy()
        status, report = attempt(compiled, context, there, _NEWTON_ITERATIONS, _NEWTON_STEP, driven)
        spent = float(report["iterations"][0])
        if status == Status.OK or once:
            state[:], attempts = there, []
    for most, step in attempts:
        status, report = attempt(compiled, context, state, most, step, driven)
        spent += report["iterations"][0]
        if status in (Status.OK, Status.REFUSED) or (friction and _limitless(context)):
            break
    report["iterations"] = spent
    system["friction_on"], system["guides_on"], system["drag_azimuths"] = 1, 1, 1
    if status == Status.REFUSED:
        raise SolverError(f"the quasi-static equilibrium failed: {fault_sentence(context)}")
    if status != Status.OK:
        sentence = _no_equilibrium(context, report, friction=friction)
        raise EquilibriumError(sentence, float(report["last_change"][0]))
    return report


def without_friction(compiled: Core, context: SolverContext, state: FloatArray) -> SolverError | None:
    """Find the equilibrium of normal forces, in place.

    Return the residual where unloaded balls still creep.
    """
    try:
        continue_static(compiled, context, state, friction=False)
    except EquilibriumError as error:
        if error.step > CREEP:
            raise
        return error
    return None


def _with_friction(
    compiled: Core, context: SolverContext, state: FloatArray, *, strict: bool, by_warmer_oil: bool
) -> StaticReport:
    """Find the friction's equilibrium, in place.

    It starts from the equilibrium without friction and goes by way of warmer oil, or of other azimuths, where needed.

    Where there is none, the message lists what lies beyond the limits of bearing, oil and laws.
    """

    def found(where: SolverContext, start: FloatArray) -> StaticReport:
        return continue_static(compiled, where, start, friction=True)

    start = state.copy()
    try:
        return found(context, state)
    except SolverError as error:
        is_worth_more = strict and by_warmer_oil and not (is_late() or _limitless(context))
        near = by_viscosity_continuation(context, start, found) if is_worth_more else None
        if near is None and is_worth_more and not is_late():
            near = by_other_positions(context, start, found)
        if near is None:
            beyond = operating_warnings(context.model) if strict else []
            error.args = ("; ".join([str(error), *beyond]),)
            raise error from None
        state[:], report = near
        return report


def _no_equilibrium(context: SolverContext, report: StaticReport, *, friction: bool) -> str:
    iterations, change = report["iterations"][0], report["last_change"][0]
    how_far = f"after {iterations:.0f} iterations (last step {change:.2e} of the states' scales)"
    if friction:
        return (
            f"{operating_point(context.model)}: no quasi-static equilibrium with friction {how_far}: loads and contact "
            "angles were found, a steady motion of the rolling elements was not: "
            f"{_limitless(context) or 'try a speed or temperature nearby, or a run, which needs none'}"
        )
    held = "is every free degree of freedom of the ring held by a load or a support?"
    beyond = "; ".join([*operating_warnings(context.model), held])
    return f"no quasi-static equilibrium without friction {how_far}: {beyond}"


def _limitless(context: SolverContext) -> str:
    """Report a traction law with stresses that no oil has."""
    for element in ("ball_inner", "ball_outer"):
        law = context.model.laws[element]["traction"]
        ratio = stress_ratio(law.model, context.parameters(element, "traction"))
        if ratio > SHEAR_LIMIT:
            return f"{law.model.label} {limitless_sentence(ratio)}"
    return ""


def contact_channels(compiled: Core, context: SolverContext, state: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return contact channels and losses at a state.

    They are by raceway (balls, contacts of a ball, 16), and the losses (16,) [W].
    """
    g, bundle, powers = context.model.geometry, context.bundle, L.power_count(context.bundle)
    z = g.balls
    contacts = np.zeros((1, z, len(raceways_of_a_ball(g)), len(CONTACT_CHANNELS)))
    rates = np.zeros((1, powers))
    system = bundle.system[0]
    system["guides_on"], system["drag_azimuths"] = 0, _DRAG_AZIMUTHS
    ok = compiled.observe(
        np.zeros(1), state.reshape(1, -1), bundle, compiled.evaluate_pointer, SHORTED, contacts, np.zeros((1, z, 3)),
        np.zeros((1, 2, 3)), np.zeros((1, powers + 2)), np.zeros((1, bundle.shared.size)), rates,
        np.zeros(context.size),
    )  # fmt: skip
    system["guides_on"], system["drag_azimuths"] = 1, 1
    if ok != 1:
        raise SolverError(f"the quasi-static equilibrium failed: {fault_sentence(context)}")
    return contacts[0], losses_by_ring(g, rates[0, : -L.NOT_LOST]).copy()


def mean_frame(geometry: Geometry, contacts: FloatArray, before: ContactFrame) -> ContactFrame:
    """Return load-weighted angles and loads of each ring."""
    angles, loads, rings, ribs = [], [], rings_of_contacts(geometry), are_ribs(geometry)
    for i in range(2):
        own = contacts[:, (rings == i) & ~ribs]
        load, angle = own[..., _LOAD].ravel(), np.abs(own[..., _ANGLE]).ravel()
        angles.append(float(np.sum(load * angle) / np.sum(load)) if np.sum(load) > 0.0 else before.angles[i])
        loads.append(float(np.mean(load[load > 0.0])) if np.any(load > 0.0) else before.mean_loads[i])
    return ContactFrame((angles[0], angles[1]), (loads[0], loads[1]))


_WHOLE = ("force_element", "time_function")  # roles that belong to no ball


def _state_of(context: SolverContext, element: str) -> str:
    """Return the first kept state's name.

    The state is one of a contact of this element.
    """
    states = context.model.laws[element]["contact_state"].model.states
    return states[0].name if states else "state"


def fault_sentence(context: SolverContext, time: float | None = None) -> str:
    """Report the kernel that refused.

    The sentence names the bearing where there are several, the place and the inputs.
    """
    fault = context.bundle.scratch[0].fault
    if fault.role < 0:
        return "the time step became too small"
    role = ROLES[fault.role]
    number, element, ball = _faulty(context.assembly, role, int(fault.ball), int(fault.place))
    bearing = context.assembly.bearings[number]
    model = bearing.model.laws[element][role].model
    status = int(fault.status)
    if status == 1:
        what = "returned a number that is not finite"
    elif status == 0:
        what = "raised an exception"
    elif status == OUTSIDE:
        what = "wrote behind the end of its output: an index is out of its array"
    else:
        what = f"returned status {status}: {model.errors.get(status, 'not declared')}"
    shown = element if bearing.model.rollers is None else element.replace("ball", "roller")
    place = shown.replace("_", " - ") + (f", t = {time:.6g} s" if time is not None else "")
    if element not in LANDS and role not in _WHOLE:
        place = f"{'ball' if bearing.model.rollers is None else 'roller'} {ball + 1}, {place}"
    names = [_state_of(context, element) if name == "state" else name for name in INPUTS[role]]
    given = [*zip(names, fault.inputs, strict=False), *_states_read(context, role, model, int(fault.place))]
    inputs = ", ".join(f"{name} {value:.6g}" for name, value in given)
    sentence = f"{model.label} {what} ({place}; {inputs})"
    return f"{bearing.name}: {sentence}" if bearing.name else sentence


def _states_read(context: SolverContext, role: str, law: Law, place: int) -> list[tuple[str, float]]:
    """Return the states that a law read.

    They are those of the contact when the law refused, by name.
    """
    if not law.reads:
        return []
    end = int(context.bundle.raceways[place]["parameters"][role][1])
    names = names_behind(law)
    return list(zip(names, map(float, context.bundle.par[end - len(names) : end]), strict=True))


def _faulty(assembly: Assembly, role: str, ball: int, place: int) -> tuple[int, str, int]:
    """Return the bearing, element and ball at fault.

    Their law refused.
    """
    spans = assembly.spans()
    if role == "force_element":
        return assembly.links[place].bearing, assembly.links[place].element, 0
    if role == "time_function":
        return *[(i, name) for i, one in enumerate(assembly.bearings) for name in times(one.model)][place], 0
    if role == "cage_contact" and place >= 0:
        bearing, ring = bearing_of_land(place)
        return bearing, tuple(LANDS)[ring], 0
    bearing = max(i for i, span in enumerate(spans) if span.first_ball <= ball or i == 0)
    model, span = assembly.bearings[bearing].model, spans[bearing]
    if role == "cage_contact":
        element = guides(model)[0]
    elif role == "fluid_drag":
        element = "fluid_drag"
    else:
        element = raceways(model.geometry)[max(place - span.first_raceway, 0)].element
    return bearing, element, ball - span.first_ball
