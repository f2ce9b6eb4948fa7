"""Move raceways of elastic rings.

Contacts load the waves of the ring.

Those of an elastic cage are moved likewise; what its guides do is in cage.cage_waves.

A pattern of n waves stands in the table of bodies like a body on supports: its y and z are the amplitudes of cos(n a)
and sin(n a), a the azimuth in the ring's material; modal mass, stiffness and damping are those of the body, its kinetic
and elastic energy and its loss count as those of any other. The radial displacement w = sum of c_n cos(n a) + s_n
sin(n a) moves the groove's circle under a ball; of the force on the ring its radial part bends it, by the work that it
does on w. Tangential displacements of the raceway, w/n of a wave, and tractions are left out of both.
"""

from __future__ import annotations

from lambda_core.solver.arrays.bundle import NS, SSIGMA, SVY, SVZ
from lambda_core.solver.layout import helper
from lambda_core.solver.vec import cosine_sine


@helper
def widen(raceway, azimuth, bundle, kin):
    """Write an elastic raceway's displacement at an azimuth.

    It is a radial displacement with its slope and rate; the azimuth is in its material [rad].
    """
    first_c, first_s = cosine_sine(azimuth)
    kin.wave_cosine, kin.wave_sine = first_c, first_s
    cosine, sine = first_c, first_s
    for i in range(raceway.waves[0], raceway.waves[1]):
        cosine, sine = cosine * first_c - sine * first_s, sine * first_c + cosine * first_s
        wave = bundle.waves[i]
        now = bundle.bodies_now[wave.body]
        kin.widening += now.position[1] * cosine + now.position[2] * sine
        kin.widening_slope += wave.order * (now.position[2] * cosine - now.position[1] * sine)
        kin.widening_rate += now.velocity[1] * cosine + now.velocity[2] * sine


@helper
def wave_pushes(raceway, kin, wrench, pushes):
    """Write a contact's forces on the waves.

    Generalised forces on the waves of its raceway, cosine and sine in turn [N].
    """
    push = -wrench.force[2] * kin.outward
    cosine, sine = kin.wave_cosine, kin.wave_sine
    for i in range(raceway.waves[1] - raceway.waves[0]):
        cosine, sine = (
            cosine * kin.wave_cosine - sine * kin.wave_sine,
            sine * kin.wave_cosine + cosine * kin.wave_sine,
        )
        pushes[2 * i], pushes[2 * i + 1] = push * cosine, push * sine


@helper
def push_waves(raceway, place, bundle):
    """Add a raceway contact to wave forces.

    The contact is at a place of scratch, on the waves of its ring.
    """
    scratch = bundle.scratch[0]
    pushes = scratch.out[:]
    wave_pushes(raceway, scratch.kinematics[place], scratch.wrench[place], pushes)
    add_pushes(raceway.waves[0], raceway.waves[1], pushes, bundle)


@helper
def add_pushes(first, last, pushes, bundle):
    """Add generalised forces to those on the waves first..last."""
    for i in range(last - first):
        force = bundle.body_wrenches[bundle.waves[first + i].body].force
        force[1] += pushes[2 * i]
        force[2] += pushes[2 * i + 1]


@helper
def add_push_slope(slopes, i, column, step, pushes):
    """Add a push's slope on wave i.

    It is a change over a step and goes to one column of the slopes of its force, (6, n).

    The push where it was stands in pushes[0], what is near it in pushes[1].
    """
    slopes[1, column] += (pushes[1, 2 * i] - pushes[0, 2 * i]) / step
    slopes[2, column] += (pushes[1, 2 * i + 1] - pushes[0, 2 * i + 1]) / step


@helper
def push_slopes(raceway, r, bundle, slopes, column, step, bl):
    """Add a contact's slope on the waves.

    Change over a step of its push on its ring's waves, to one column of their force slopes.

    The push where it was stands in bl.pushes[0]; scratch holds what is near it.
    """
    scratch = bundle.scratch[0]
    wave_pushes(raceway, scratch.kinematics[1], scratch.wrench[1], bl.pushes[1])
    for i in range(raceway.waves[1] - raceway.waves[0]):
        p = bl.reach.place[r, bundle.waves[raceway.waves[0] + i].body]
        add_push_slope(slopes[p], i, column, step, bl.pushes)


@helper
def turn_waves(bundle):
    """Add the Coriolis forces on the waves.

    They arise in turning rings (Bryan 1890) and have no power.

    The inward pull of rotation is left out: of order (spin/frequency)^2.
    """
    for i in range(bundle.waves.size):
        wave = bundle.waves[i]
        now, force = bundle.bodies_now[wave.body], bundle.body_wrenches[wave.body].force
        turn = wave.coupling * bundle.bodies_now[wave.ring].spin
        force[1] += turn * now.velocity[2]
        force[2] -= turn * now.velocity[1]


@helper
def turning_columns(bundle, bl):
    """Add the slopes of the Coriolis forces."""
    for i in range(bundle.waves.size):
        wave = bundle.waves[i]
        now, first, spin = bundle.bodies_now[wave.body], NS * wave.body, NS * wave.ring + SSIGMA
        turn, slopes = wave.coupling * bundle.bodies_now[wave.ring].spin, bl.shared[wave.body]
        slopes[1, first + SVZ] += turn
        slopes[2, first + SVY] -= turn
        slopes[1, spin] += wave.coupling * now.velocity[2]
        slopes[2, spin] -= wave.coupling * now.velocity[1]
