"""Provide closed forms and independent derivations for tests.

Nothing here is used by the product; it is written from the sources named below so that the product can be checked
against it. SI units throughout.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq, root
from scipy.special import ellipe, ellipk

from lambda_core.domain.arrays import FloatArray

# --- load distribution with many balls (Stribeck 1901, Sjoevall 1933; Harris and Kotzalas, vol. 1, ch. 7) -----------


def _zone(epsilon: float) -> float:
    return math.pi if epsilon >= 1.0 else math.acos(1.0 - 2.0 * epsilon)


def _relative_load(psi: float, epsilon: float, exponent: float) -> float:
    return max(1.0 - (1.0 - math.cos(psi)) / (2.0 * epsilon), 0.0) ** exponent


def sjovall_integrals(epsilon: float, exponent: float = 1.5) -> tuple[float, float]:
    """Return the load integrals (J_r, J_a).

    Mean over the raceway of (Q/Q_max) cos psi and of Q/Q_max.
    """
    end = _zone(epsilon)
    radial = quad(lambda psi: _relative_load(psi, epsilon, exponent) * math.cos(psi), 0.0, end, epsabs=1e-12)[0]
    axial = quad(lambda psi: _relative_load(psi, epsilon, exponent), 0.0, end, epsabs=1e-12)[0]
    return radial / math.pi, axial / math.pi


def fatigue_integral(epsilon: float, power: float, exponent: float = 1.5) -> float:
    """Return J_1 or J_2.

    J_1 (power 3) or J_2 (power 10/3): (mean of (Q/Q_max)^power)^(1/power).
    """
    total = quad(lambda psi: _relative_load(psi, epsilon, exponent) ** power, 0.0, _zone(epsilon), epsabs=1e-12)[0]
    return float((total / math.pi) ** (1.0 / power))


def stribeck_number(ball_count: int, exponent: float = 1.5) -> float:
    """Return S of Q_max = S F_r/Z.

    Without clearance, one ball under the load; 1/J_r(0.5) = 4.37 for many balls.
    """
    cosine = np.maximum(np.cos(2.0 * math.pi * np.arange(ball_count) / ball_count), 0.0)
    return float(ball_count / np.sum(cosine ** (exponent + 1.0)))


# --- Hertz by the classical route: solve F(rho) for the axis ratio, then integrals (Harris and Kotzalas, ch. 6) ------


@dataclass(frozen=True)
class HertzFactors:
    """Factors of Harris and Kotzalas, table 6.1.

    a*, b*, delta* and the axis ratio.
    """

    a: float
    b: float
    delta: float
    ratio: float


def hertz_factors(curvature_difference: float) -> HertzFactors:
    """Return dimensionless contact parameters.

    For 0 < F(rho) < 1.
    """

    def difference(kappa: float) -> float:
        m = 1.0 - kappa**-2
        first, second = ellipk(m), ellipe(m)
        return float(((kappa**2 + 1.0) * second - 2.0 * first) / ((kappa**2 - 1.0) * second))

    kappa = brentq(lambda k: difference(k) - curvature_difference, 1.0 + 1e-7, 1e5, xtol=1e-13)
    m = 1.0 - kappa**-2
    first, second = float(ellipk(m)), float(ellipe(m))
    a = (2.0 * kappa**2 * second / math.pi) ** (1.0 / 3.0)
    b = (2.0 * second / (math.pi * kappa)) ** (1.0 / 3.0)
    delta = 2.0 * first / math.pi * (math.pi / (2.0 * kappa**2 * second)) ** (1.0 / 3.0)
    return HertzFactors(a, b, delta, kappa)


# --- a ball between two grooves under axial load (Jones 1960; Harris and Kotzalas, vol. 1 ch. 7, vol. 2 ch. 3) -------


@dataclass(frozen=True)
class AxialEquilibrium:
    """Equilibrium under pure axial load.

    Angles [rad] and loads [N] of every ball.
    """

    angle_inner: float
    angle_outer: float
    load_inner: float
    load_outer: float
    displacement: float  # of the inner ring from the centred position [m]


def axial_equilibrium(
    axial_load: float,
    ball_count: int,
    legs: tuple[float, float],
    clearance: float,
    stiffness: tuple[float, float],
    centrifugal: float = 0.0,
) -> AxialEquilibrium:
    """Return the equilibrium of one ball.

    Q = K delta^1.5 at each contact.

    Parameters
    ----------
    legs : (inner, outer)
        r_g - D_w/2 of each groove [m].
    clearance : float
        Diametral [m].
    stiffness : (inner, outer)
        K [N/m^1.5].
    centrifugal : float
        Outward force on the ball [N].
    """
    share = axial_load / ball_count
    gap = sum(legs) - 0.5 * clearance  # radial distance of the groove centres

    def stretched(ring: int, angle: float) -> float:
        return float(legs[ring] + (share / math.sin(angle) / stiffness[ring]) ** (2.0 / 3.0))

    def static(angle: float) -> float:
        return (stretched(0, angle) + stretched(1, angle)) * math.cos(angle) - gap

    angle = brentq(static, math.radians(2.0), math.radians(85.0), xtol=1e-15)

    def running(x: FloatArray) -> list[float]:
        inner, outer = x
        return [
            math.cos(outer) / math.sin(outer) - math.cos(inner) / math.sin(inner) - centrifugal / share,
            (stretched(0, inner) * math.cos(inner) + stretched(1, outer) * math.cos(outer)) / gap - 1.0,
        ]

    solution = root(running, [angle, angle], tol=1e-14)
    assert solution.success or np.max(np.abs(solution.fun)) < 1e-12, solution.message
    inner, outer = (float(value) for value in solution.x)
    displacement = stretched(0, inner) * math.sin(inner) + stretched(1, outer) * math.sin(outer)
    return AxialEquilibrium(inner, outer, share / math.sin(inner), share / math.sin(outer), displacement)


# --- ISO/TS 16281:2008, section 4: the five-degree-of-freedom model reduced to a plane -------------------------------


@dataclass(frozen=True)
class SpecificationEquilibrium:
    """Equilibrium after ISO/TS 16281.

    Displacements (radial [m], axial from the centred position [m], tilt [rad]) and ball loads [N].
    """

    radial: float
    axial: float
    tilt: float
    loads: FloatArray


def specification_equilibrium(
    *,
    ball_count: int,
    groove_centre_distance: float,
    lever: float,
    first_ball: float = 0.0,
    clearance: float,
    spring_constant: float,
    radial_load: float,
    axial_load: float,
    moment: float = 0.0,
    start: Sequence[float] = (10.0, 100.0, 0.0),
) -> SpecificationEquilibrium:
    """Return ball loads after ISO/TS 16281.

    Eq. 8-18: static, rigid rings.

    `groove_centre_distance` A = r_i + r_e - D_w, `lever` arm of tilt and moment (D_pw/2; the specification takes the
    inner groove-centre circle for the tilt), `first_ball` azimuth of the first ball from the load, `spring_constant`
    c_P of ball and both raceways in series [N/m^1.5]; `start` in um, um, mrad.
    """
    psi = first_ball + 2.0 * math.pi * np.arange(ball_count) / ball_count
    angle = math.acos(1.0 - clearance / (2.0 * groove_centre_distance))

    def contacts(x: FloatArray) -> tuple[FloatArray, FloatArray]:
        radial = groove_centre_distance * math.cos(angle) + x[0] * np.cos(psi)
        axial = groove_centre_distance * math.sin(angle) + x[1] + lever * math.sin(x[2]) * np.cos(psi)
        stretch = np.maximum(np.hypot(radial, axial) - groove_centre_distance, 0.0)
        return spring_constant * stretch**1.5, np.arctan(axial / radial)

    scale = max(radial_load, axial_load, 1.0)

    units = np.array([1e-6, 1e-6, 1e-3])

    def balance(scaled: FloatArray) -> list[float]:
        load, alpha = contacts(scaled * units)
        return [
            (radial_load - float(np.sum(load * np.cos(alpha) * np.cos(psi)))) / scale,
            (axial_load - float(np.sum(load * np.sin(alpha)))) / scale,
            (moment - lever * float(np.sum(load * np.sin(alpha) * np.cos(psi)))) / scale / lever,
        ]

    solution = root(balance, np.asarray(start), tol=1e-13)
    assert np.max(np.abs(solution.fun)) < 1e-8, solution.message
    x = solution.x * units
    axial = float(x[1]) + groove_centre_distance * math.sin(angle)
    return SpecificationEquilibrium(float(x[0]), axial, float(x[2]), contacts(x)[0])


# --- rigid-body kinematics by vectors (no bearing formula) ------------------------------------------------------------


def raceway_motion(
    *,
    inner_speed: float,
    orbit_speed: float,
    ball_spin: Sequence[float],
    ball_diameter: float,
    pitch_diameter: float,
    contact_angle: float,
    inner: bool,
    outer_speed: float = 0.0,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return surface velocities and spin.

    Of ball and ring at a contact, seen from the cage; the spin is their relative one, a vector.

    x is the shaft axis, z radially outwards through the ball, y along the orbit for a positive speed (y = x cross
    -z turned so that x, y, z are right handed: velocity = omega x r). `ball_spin` is the ball's angular velocity in
    the frame that turns with the cage.
    """
    sign = -1.0 if inner else 1.0
    # groove of the inner ring lies towards the axis; a positive angle moves the inner contact to -x, the outer to +x
    normal = np.array([sign * math.sin(contact_angle), 0.0, sign * math.cos(contact_angle)])
    arm = 0.5 * ball_diameter * normal
    ball = np.cross(np.asarray(ball_spin, dtype=float), arm)
    ring_speed = (inner_speed if inner else outer_speed) - orbit_speed
    ring_spin = np.array([ring_speed, 0.0, 0.0])
    ring = np.cross(ring_spin, np.array([0.0, 0.0, 0.5 * pitch_diameter]) + arm)
    return ball, ring, np.asarray(ball_spin, dtype=float) - ring_spin


def numerical_gyroscopic_moment(
    inertia: float, spin: float, orbit: float, pitch: float, step: float = 1e-6
) -> FloatArray:
    """Return the gyroscopic moment by differences.

    d/dt of a ball's spin angular momentum while its axis is carried around the shaft.

    The spin vector makes the angle `pitch` with the shaft axis x in the radial plane. Returns the moment [N m] in the
    frame (x, orbit direction, radial) at t = 0.
    """

    def momentum(time: float) -> FloatArray:
        angle = orbit * time
        radial = np.array([0.0, -math.sin(angle), math.cos(angle)])
        axis = math.cos(pitch) * np.array([1.0, 0.0, 0.0]) + math.sin(pitch) * radial
        return inertia * spin * axis

    return (momentum(step) - momentum(-step)) / (2.0 * step)


# --- geometry of a torus ---------------------------------------------------------------------------------------------


def torus_distance(point: FloatArray, centre_radius: float, groove_radius: float) -> float:
    """Return the signed distance to a torus.

    Of a point (x, y, z) to its surface about x, negative inside the tube.
    """
    radius = math.hypot(point[1], point[2])
    return math.hypot(point[0], radius - centre_radius) - groove_radius


def principal_curvatures(point: FloatArray, centre_radius: float, groove_radius: float, step: float) -> FloatArray:
    """Return a torus's principal curvatures.

    At a point of its surface, from the Hessian of the distance (differences).
    """
    hessian = np.empty((3, 3))
    unit = np.eye(3) * step
    for i in range(3):
        for j in range(3):
            hessian[i, j] = (
                torus_distance(point + unit[i] + unit[j], centre_radius, groove_radius)
                - torus_distance(point + unit[i] - unit[j], centre_radius, groove_radius)
                - torus_distance(point - unit[i] + unit[j], centre_radius, groove_radius)
                + torus_distance(point - unit[i] - unit[j], centre_radius, groove_radius)
            ) / (4.0 * step * step)
    values = np.linalg.eigvalsh(hessian)
    # the distance does not curve along its own gradient: drop the eigenvalue nearest to zero
    return np.delete(values, int(np.argmin(np.abs(values))))
