"""Balance the energy over one step of several stages.

The terms are those of the formula, of the exchange, and of rings with prescribed motion; :mod:`.balance` has what the
stages share with a step of the BDF.
"""

from __future__ import annotations

from lambda_core.solver.arrays.bundle import NOT_DISSIPATED, NS, SSIGMA, SVX, SWY
from lambda_core.solver.integrator.balance import LEAK, SCATTER, allowed, floor_of
from lambda_core.solver.integrator.tableau import ERROR, LOSS, STAGES, WEIGHTS, A
from lambda_core.solver.layout import helper, running_of
from lambda_core.solver.records import PRESCRIBED


@helper
def leak_of_stages(mem, h):
    """Return a staged step's relative leak.

    The energy that it loses, over what a step may lose; see leak_of_step.

    The scheme's own share is known from the matrix of its algebraic stability, and of either sign. The quadrature's
    is the difference of the formula and the one embedded in it.
    """
    stages, taken, error = mem.stages, 0.0, 0.0
    for i in range(mem.new.size):
        if mem.inertia[i] > 0.0:
            for j in range(STAGES):
                along = 0.5 * LOSS[j, j] * stages[j, i]
                for k in range(j):
                    along += LOSS[j, k] * stages[k, i]
                taken += mem.inertia[i] * stages[j, i] * along
    for j in range(STAGES):
        lost = 0.0
        for i in range(mem.rates.size - NOT_DISSIPATED):
            lost += mem.stage_rates[j, i]
        error += ERROR[j] * lost
    lost = abs(h * h * taken) / allowed(mem, h, LEAK, floor_of(mem, h))
    return max(lost, abs(h * error) / allowed(mem, h, SCATTER, mem.control[0].leak_floor))


@helper
def add_turn_over(mem, h):
    """Add the last stage's alternating energy.

    The forces of the stage move it to and fro.
    """
    power = 0.0
    for i in range(mem.new.size):
        if mem.inertia[i] > 0.0:
            power += abs(mem.inertia[i] * mem.new[i] * mem.stages[STAGES - 1, i])
    mem.control[0].turned_over += h * power


@helper
def _settled(mem, end, inertia, k, h):
    """Return a prescribed speed's remaining energy [J].

    It is the growth of its kinetic energy in a step beyond that given to the stages.
    """
    start, given = mem.shared[k], 0.0
    for i in range(STAGES):
        v = start
        for j in range(i + 1):
            v += h * A[i, j] * mem.stage_shared[j, k]
        given += h * WEIGHTS[i] * v * mem.stage_shared[i, k]
    return inertia * (0.5 * (end[k] * end[k] - start * start) - given)


@helper
def settle_prescribed(bundle, mem, h):
    """Add prescribed rings' kinetic energy.

    It goes to the input of a step, also across jumps.
    """
    running = running_of(mem.integrals)[0]
    for b in range(bundle.bodies.size):
        body, first = bundle.bodies[b], NS * b
        for i in range(3):
            if body.mode[i] == PRESCRIBED:
                running.input += _settled(mem, bundle.shared, body.mass, first + SVX + i, h)
        for i in range(2):
            if body.mode[3 + i] == PRESCRIBED:
                running.input += _settled(mem, bundle.shared, body.transverse_inertia, first + SWY + i, h)
        if body.mode[5] == PRESCRIBED:
            drive = _settled(mem, bundle.shared, body.polar_inertia, first + SSIGMA, h)
            running.input += drive
            running.drive += drive
