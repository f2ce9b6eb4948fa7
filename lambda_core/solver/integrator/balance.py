"""Balance the energy over one integration step.

The terms are the work of loads and drives, and what the scheme itself takes.

The step solves D(y) = f(y), where D(u) = (u_n - base)/gamma is the difference quotient of the BDF. Energies are of
second order in the states, D(E) = grad E . D(y) but for squares of differences (_dissipated). So the running integrals
W are advanced by D(W) = P, with the powers P that the step's own equations of motion transfer: then work, losses and
the energy of the states part by small squares alone. By the trapezium rule they part by a speed times its local error.
"""

from __future__ import annotations

from lambda_core.solver.arrays.bundle import (
    BPSI,
    BVR,
    BVT,
    BVX,
    BWX,
    MECHANISMS,
    NB,
    NOT_DISSIPATED,
    NS,
    RUNNING_SIZE,
    SAY,
    SSIGMA,
    SVX,
    SWY,
)
from lambda_core.solver.layout import first_of, helper, large_helper, running_of, vector_helper
from lambda_core.solver.records import PRESCRIBED
from lambda_core.solver.vec import cosine_sine

# Shares of the energy that flows, over the tolerance, which a step may lose.
LEAK = 0.4  # for good, twice (scheme and iteration): together a fifth below what a balance may miss
SCATTER = 5.0  # with either sign: cancels from step to step but for single events, which this bounds
_LEFT_ON_ROLLERS = 0.1  # of the power that flows, by what the iteration leaves of forces on rollers
_AT_ONCE = 0.25  # of what earlier steps have left
_CLOSER = 0.1  # of the floor is left to the iteration: what it leaves looks to the scheme like a loss of its own
_ROUNDING = 2.0**-51  # relative, of a double: two units in its last place
_OF_ONE = 2 * MECHANISMS + RUNNING_SIZE - NOT_DISSIPATED  # dissipators of one bearing
_OF_BDF = 0.7  # share of the BDF's error in its distance from the trapezium rule, 2/9 of 2/9 + 1/12


@helper
def _quotient(mem, shared, k):
    """Return D(shared[k])."""
    return (shared[k] - mem.shared_base[k]) / mem.control[0].gamma


@helper
def _power_of_speed(mem, shared, k):
    """Return a prescribed speed's power per mass.

    The kinetic power is D(v^2/2) of a BDF and v D(v) of a stage.

    Such a speed is known, and its kinetic energy with it: v D(v) of the step across a jump would be twice as much.
    """
    v = shared[k]
    if mem.stages.shape[0] > 0:
        return v * _quotient(mem, shared, k)
    before, last = mem.shared[k] * mem.shared[k], mem.shared1[k] * mem.shared1[k]
    return 0.5 * (v * v - before - mem.control[0].back * (before - last)) / mem.control[0].gamma


@helper
def _work_of_motion(body, now, wrench, inputs, first, shared, mem, running):
    """Add one body's share.

    See _work_of_motions. The state of the body begins at `first`.
    """
    for i in range(3):
        if body.mode[i] == PRESCRIBED:
            v = now.velocity[i]
            force = wrench.force[i] - body.stiffness[i] * now.position[i]
            taken = _power_of_speed(mem, shared, first + SVX + i) - v * inputs.motion[i].acceleration
            running.input += body.mass * taken - force * (_quotient(mem, shared, first + i) - v)
    # A tilt (phi_y, phi_z) turns the axis to (1, phi_z, -phi_y).
    for i in range(2):
        if body.mode[3 + i] == PRESCRIBED:
            axis, sign = (1, -1.0) if i == 0 else (0, 1.0)
            w = now.tilt_velocity[i]
            moment = wrench.moment[1 + i] - body.stiffness[3 + i] * sign * now.tilt[axis]
            taken = _power_of_speed(mem, shared, first + SWY + i) - w * inputs.motion[3 + i].acceleration
            along = moment * (sign * _quotient(mem, shared, first + SAY + axis) - w)
            running.input += body.transverse_inertia * taken - along
    if body.mode[5] == PRESCRIBED:
        taken = _power_of_speed(mem, shared, first + SSIGMA) - now.spin * inputs.motion[5].rate
        drive = body.polar_inertia * taken
        running.input += drive
        running.drive += drive


@helper
def _work_of_motions(bundle, mem):
    """Add the work of prescribed motions.

    It belongs to the input, because their differences differ from their derivatives.

    A ring with prescribed motion has the kinetic power m D(v^2/2), a force F on it does the work F D(x): not m v dv/dt
    and F v, where a motion has a corner or changes fast. Translation, tilt, spin.
    """
    running = running_of(mem.rates)[0]
    for b in range(bundle.bodies.size):
        _work_of_motion(
            bundle.bodies[b], bundle.bodies_now[b], bundle.body_wrenches[b], bundle.inputs[b], NS * b, bundle.shared,
            mem, running,
        )  # fmt: skip


@helper
def _work_of_loads(bundle, mem):
    """Return the last correction's power of loads [W].

    Change by Newton of the power of loads and weights on what is free.

    Of balls of a bypassed bearing: all corrections since its powers were computed.
    """
    system, move, since = bundle.system[0], mem.last_move, mem.since
    tail, power = system.tail, 0.0
    gx, gy, gz = system.gravity[0], system.gravity[1], system.gravity[2]
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for j in range(row.first_ball, row.first_ball + row.balls):
            i = first_of(row, j)
            c, s = cosine_sine(mem.new[i + BPSI])
            along = gx * since[i + BVX] + (gy * c + gz * s) * since[i + BVR] + (gz * c - gy * s) * since[i + BVT]
            power += row.ball_mass * along
    for i in range(tail, tail + bundle.active.size):
        b, c = bundle.active[i - tail] // NS, bundle.active[i - tail] % NS
        if c >= SVX and c < SWY:
            axis = c - SVX
            load = bundle.inputs[b].force[axis].value + bundle.bodies[b].mass * system.gravity[axis]
            power += load * move[i]
        elif c >= SWY:
            axis = 0 if c == SSIGMA else c - SWY + 1
            power += bundle.inputs[b].moment[axis].value * move[i]
    return power


@helper
def _prescribed_speeds(bundle):
    """Return raceway speeds of prescribed rings [m/s].

    They are the speed and the circumferential speed.
    """
    speed, spin = 0.0, 0.0
    for k in range(bundle.raceways.size):
        raceway = bundle.raceways[k]
        body, now = bundle.bodies[raceway.body], bundle.bodies_now[raceway.body]
        for i in range(3):
            if body.mode[i] == PRESCRIBED:
                speed += abs(now.velocity[i])
        if body.mode[5] == PRESCRIBED:
            spin += abs(now.spin) * raceway.groove_circle
    return speed, spin


@vector_helper
def _power_of_residual(inertia, new, base, slope, per_gamma):
    """Return the residual's power [W].

    It uses D(y) - f at the last iterate; positions have none.
    """
    power = 0.0
    for i in range(new.size):
        power += new[i] * (inertia[i] * ((new[i] - base[i]) * per_gamma - slope[i]))
    return power


@vector_helper
def _forces_of_residual(inertia, new, base, slope, per_gamma, first, count, size, per_radius):
    """Return the residual's forces on elements [N].

    The moments over their radius are added; all count as positive.

    The states of `count` elements stand from `first` on, `size` each.
    """
    force, moment = 0.0, 0.0
    for j in range(count):
        start = first + size * j
        for i in range(start + BVX, start + BWX):
            force += abs(inertia[i] * ((new[i] - base[i]) * per_gamma - slope[i]))
        for i in range(start + BWX, start + BWX + 3):
            moment += abs(inertia[i] * ((new[i] - base[i]) * per_gamma - slope[i]))
    return force + moment * per_radius


@helper
def _residual_work(bundle, mem):
    """Return the residual's power and shares [W].

    D(y) - f at the last iterate, how much of it moves prescribed rings, and the spins' share.

    Creep is stiff: within the error allowed per step the tractions of an iterate may be off by more than themselves,
    and what the step accelerates the balls by, D(v), is not f. The difference is a force R on each ball (moment M)
    that came from the rings. A ring with prescribed motion whose surface moves at u gave at most (|R| + |M|/r) |u|;
    the rest is an unattributed energy error.
    """
    inertia, new, base, slope, per_gamma = mem.inertia, mem.new, mem.base, mem.slope, 1.0 / mem.control[0].gamma
    power, force = _power_of_residual(inertia, new, base, slope, per_gamma), 0.0
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        force += _forces_of_residual(
            inertia, new, base, slope, per_gamma, row.first_state, row.balls, row.size, 1.0 / row.ball_radius
        )
    speed, spin = _prescribed_speeds(bundle)
    most = force * (speed + spin)
    return power, min(max(power, -most), most), spin / (speed + spin + 1e-300)


@vector_helper
def _twice_energy(inertia, speed):
    """Return twice the kinetic energy of speeds [J]."""
    twice = 0.0
    for i in range(speed.size):
        twice += inertia[i] * speed[i] * speed[i]
    return twice


@helper
def floor_of(mem, h):
    """Return the floor of a step's loss [J].

    It may lose this energy although nothing flows: so much per time, however short steps are.

    By the step, a thousand short ones would lose a thousand times as much: more than a light bearing turns slowly by.
    Never less than rounding leaves of the kinetic energy: no step is short enough for that.
    """
    twice = _twice_energy(mem.inertia, mem.new)
    return max(mem.control[0].leak_floor * h / mem.control[0].longest_step, _ROUNDING * twice)


@helper
def _flow(mem):
    """Return the power that flows [W].

    It is put in or dissipated, whichever is more, now or on the average so far; where vibrations are the answer, also
    what goes to and fro between motion and springs.
    """
    control, rates, integrals = mem.control[0], mem.rates, mem.integrals
    now, so_far = running_of(rates)[0], running_of(integrals)[0]
    lost, all_lost = 0.0, 0.0
    for i in range(rates.size - NOT_DISSIPATED):
        lost += rates[i]
        all_lost += integrals[i]
    flow = max(lost, now.input_abs)
    if control.time > 0.0:
        flow = max(flow, max(all_lost, so_far.input_abs, control.turned_over) / control.time)
    return flow


@helper
def allowed(mem, h, share, floor):
    """Return the allowed loss of a step [J].

    `share` tolerances of what flows, and the floor.
    """
    return share * mem.control[0].tolerance * h * _flow(mem) + floor


@vector_helper
def _work_of_moves(inertia, slope, since):
    """Return the work of forces on corrections [J].

    All count as positive.
    """
    total = 0.0
    for i in range(since.size):
        total += abs(inertia[i] * slope[i] * since[i])
    return total


@vector_helper
def _power_left(inertia, new, base, slope, per_gamma, first, last):
    """Return the power of the residual of states first..last [W].

    That of every state counts as positive.
    """
    power = 0.0
    for i in range(first, last):
        power += abs(new[i] * inertia[i] * ((new[i] - base[i]) * per_gamma - slope[i]))
    return power


@helper
def _excess_on_rollers(bundle, mem, h):
    """Return the power left on rollers, relative.

    It is that of the residual, over what the iteration may leave.

    Creep of a line in cold oil is so stiff that a slip which is off by a part of the error allowed per step is a force
    of hundreds of newtons, and a correction by a matrix of a contact that creeps says nothing of one that slides. What
    is left turns the rollers over in the next steps, which get short, and skews them; that its energy is balanced does
    not help.
    """
    left, per_gamma = 0.0, 1.0 / mem.control[0].gamma
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if row.size != NB:
            last = row.first_state + row.size * row.balls
            left += _power_left(mem.inertia, mem.new, mem.base, mem.slope, per_gamma, row.first_state, last)
    if left == 0.0:
        return 0.0
    return h * left / (_LEFT_ON_ROLLERS * h * _flow(mem) + floor_of(mem, h))


@helper
def leak_of_iterate(bundle, mem, h):
    """Return the iteration's relative leak.

    The energy that Newton leaves unaccounted for, over what a step may lose.

    The powers are those of the last iterate, of bypassed bearings of an earlier one: off by the work of its forces
    on the corrections since at most, and by what of the residual's work is unattributed. See _excess_on_rollers.
    """
    power, given, _ = _residual_work(bundle, mem)
    off = abs(power - given) + _work_of_moves(mem.inertia, mem.slope, mem.since)
    leak = h * off / allowed(mem, h, LEAK, _CLOSER * floor_of(mem, h))
    return max(leak, _excess_on_rollers(bundle, mem, h))


@large_helper
def finalise_step(bundle, mem):
    """Finish positions and powers of a step.

    They go from the last iterate to the step's result.

    A matrix factored for another gamma leaves D(x) - v, next to nothing; times the forces in the contacts it is energy.
    Loads, and what leads or drives rings: see _work_of_loads, _work_of_motions, _residual_work.
    """
    gamma, running = mem.control[0].gamma, running_of(mem.rates)[0]
    for i in range(mem.new.size):
        p = mem.place[i]
        if p >= 0:
            mem.new[p] = mem.base[p] + gamma * mem.new[i]
    _work_of_motions(bundle, mem)
    power, given, share = _residual_work(bundle, mem)
    running.iteration = abs(power)
    running.input += given + _work_of_loads(bundle, mem)
    running.drive += given * share
    running.input_abs = abs(running.input)


@vector_helper
def _energy_of_bends(inertia, new, now, before, per_w):
    """Return twice a bend's kinetic energy [J].

    The energy is that of e = d_1/w - (u_1 - u_2).
    """
    total = 0.0
    for i in range(new.size):
        e = (new[i] - now[i]) * per_w - (now[i] - before[i])
        total += inertia[i] * e * e
    return total


@helper
def _dissipated(mem, h):
    """Return the scheme's own dissipation [J].

    It is kinetic energy in this step.

    With base = u_1 + a (u_1 - u_2) and d_k = u - u_k, gamma [D(u^2) - 2 u D(u)] = a d_2^2 - (1 + a) d_1^2: a difference
    of two norms, which the next steps give back, and a w e^2, e = d_1/w - (u_1 - u_2), w the ratio of the steps; all
    steps together lose that over 1 - a (equal steps: Hairer and Wanner 1996, Solving ODEs II, V.6).
    """
    w, back = h / mem.control[0].last_step, mem.control[0].back
    total = _energy_of_bends(mem.inertia, mem.new, mem.y, mem.y1, 1.0 / w)
    return 0.5 * w * back / (1.0 - back) * total


@helper
def _quadrature(mem, h, losses):
    """Return the dissipated energy's error [J].

    It is that of this step, the BDF's increment against the trapezium's.

    Of the third derivative times h^3 the one misses (1 + w)^2/(6 w (1 + 2 w)), 2/9 in equal steps, the other -1/12.
    """
    lost, grown = 0.0, 0.0
    for i in range(losses):
        lost += mem.rates[i]
        grown += mem.integrals[i] - mem.integrals1[i]
    grown = mem.control[0].back * grown + mem.control[0].gamma * lost
    return _OF_BDF * (grown - 0.5 * h * (lost + mem.control[0].dissipated_power))


@helper
def leak_of_step(mem, h):
    """Return the scheme's relative leak.

    The energy that it loses in this step, over what a step may lose.

    What is dissipated adds up over as much time as the longest step takes: that one might lose it all at once, and so
    may a blow, of what the steps before have left. Errors of quadrature have either sign, and where a loss jumps no
    step is short enough.
    """
    losses = mem.rates.size - NOT_DISSIPATED
    # One bearing has two raceways: loops of a length that the compiler knows.
    error = _quadrature(mem, h, _OF_ONE) if losses == _OF_ONE else _quadrature(mem, h, losses)
    control, lost, own = mem.control[0], _dissipated(mem, h), allowed(mem, h, LEAK, floor_of(mem, h))
    control.kept = own - lost
    excess = lost / (own + _AT_ONCE * control.allowance)
    return max(excess, abs(error) / allowed(mem, h, SCATTER, control.leak_floor))


@helper
def keep_allowance(mem, h):
    """Keep unused allowance for later steps.

    What an accepted one has not lost of its share, at most the longest step's.
    """
    control = mem.control[0]
    most = allowed(mem, control.longest_step, LEAK, control.leak_floor)
    control.allowance = min(max(control.allowance + control.kept, 0.0), most)


@helper
def add_to_integrals(mem):
    """Advance the running integrals by D(W) = P."""
    back, gamma = mem.control[0].back, mem.control[0].gamma
    for i in range(mem.rates.size):
        grown = back * (mem.integrals[i] - mem.integrals1[i]) + gamma * mem.rates[i]
        mem.integrals1[i] = mem.integrals[i]
        mem.integrals[i] += grown
    mem.control[0].dissipated_power = 0.0
    for i in range(mem.rates.size - NOT_DISSIPATED):
        mem.control[0].dissipated_power += mem.rates[i]
