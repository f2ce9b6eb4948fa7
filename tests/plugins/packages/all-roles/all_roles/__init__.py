"""A law for every role, made so that the friction torque of a bearing has a closed form.

Each ball-raceway contact resists rolling with the same moment M and loses nothing else:
contacts are points (no spin, no Heathcote slip), and a stiff, slip-proportional traction
holds the balls at the epicyclic speed. A contact loses M u_m/R_x with
u_m = Omega d_m (1 - gamma^2)/4, 1/R_x = 2/(D_w (1 - gamma)) inner, 2/(D_w (1 + gamma)) outer,
so the torque is Z M d_m/D_w, whatever contact angle, load and speed.
"""

import math

from pydantic import BaseModel

from lambda_core.plugins import hookimpl, model


class Moment(BaseModel):
    """Rolling moment of each contact [N m]."""

    moment: float = 2e-4


def normal_contact(delta, R_x, R_y, E_eff, par, out):
    out[0] = 1e8 * delta
    out[1] = 1e-6
    out[2] = 1e-6
    out[3] = 1.5 * out[0] / (math.pi * 1e-12)
    return 1


def damping(delta, delta_dot, load, par, out):
    force = 100.0 * delta_dot
    out[0] = force if force > -load else -load
    return 1


def rheology(p, T, par, ln_eta, rho):
    for i in range(p.size):
        ln_eta[i] = math.log(0.05) + 2e-8 * min(p[i], 1e9) - 0.03 * (T[i] - 313.15)
        rho[i] = 870.0
    return 1


def film_thickness(u_mean, theta, load, R_x, R_y, E_eff, eta0, alpha_p, par, out):
    out[0] = 1e-6
    out[1] = 5e-7
    return 1


def thermal_correction(u_mean, u_slide, p_max, E_eff, eta0, beta, k_oil, par, out):
    out[0] = 1.0
    return 1


def contact_temperature(T_in, u_mean, h, semi_b, tau, slip, par, T):
    for i in range(T.size):
        T[i] = T_in
    return 1


def traction(slip, p, T, ln_eta, h, par, tau):
    for i in range(tau.size):
        tau[i] = 1e15 * slip[i]
    return 1


def rolling_resistance(u_mean, load, semi_a, semi_b, R_x, R_y, E_eff, eta0, alpha_p, beta, k_oil, par, out):
    out[0] = 0.0
    return 1


def elastic_hysteresis(load, semi_a, semi_b, R_x, R_y, R_ball, par, out):
    out[0] = par[0]
    return 1


def asperity_load(Lambda, par, out):
    out[0] = 0.0
    return 1


def boundary_friction(slip, p, par, mu):
    for i in range(mu.size):
        mu[i] = 0.0
    return 1


def cage_contact(r, v_rel, omega_rel, eta0, par, out):
    for i in range(6):
        out[i] = 0.0
    return 1


def fluid_drag(v_orbit, omega_spin, azimuth, nu, rho, par, out):
    out[0] = 0.0
    out[1] = 0.0
    return 1


def permittivity(p, T, rho, par, eps_r):
    for i in range(p.size):
        eps_r[i] = 2.0
    return 1


def capacitance(C_hertz, h, semi_a, semi_b, R_x, R_y, U, G, W, eps_r0, par, out):
    out[0] = C_hertz
    return 1


def surface(azimuth, contact_angle, par, out):
    """Both raceways a micrometre higher all around: another clearance."""
    out[0] = 1e-6
    out[1] = 0.0
    out[2] = 0.0
    return 1


KERNELS = [
    normal_contact,
    damping,
    rheology,
    film_thickness,
    thermal_correction,
    contact_temperature,
    traction,
    rolling_resistance,
    asperity_load,
    boundary_friction,
    cage_contact,
    fluid_drag,
    permittivity,
    capacitance,
    surface,
]


@hookimpl
def lambda_models(register):
    for kernel in KERNELS:
        register(model(kernel.__name__, "own", kernel, reference="own work"))
    register(model("elastic_hysteresis", "own", elastic_hysteresis, Moment, reference="own work"))
