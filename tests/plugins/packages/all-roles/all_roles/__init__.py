"""Provide a law for every role with a known torque.

Each ball-raceway contact resists rolling with the same moment M and loses nothing else:
contacts are points (no spin, no Heathcote slip), and a stiff, slip-proportional traction
holds the balls at the epicyclic speed. A contact loses M u_m/R_x with
u_m = Omega d_m (1 - gamma^2)/4, 1/R_x = 2/(D_w (1 - gamma)) inner, 2/(D_w (1 + gamma)) outer,
so the torque is Z M d_m/D_w, whatever contact angle, load and speed. Of cylindrical rollers that are all pressed it is
the same.
"""

import math

from lambda_core.plugins import OK, Parameters, State, law, parameter


class Moment(Parameters):
    """Rolling moment of each contact [N m]."""

    moment: float = parameter(2e-4, "rolling moment [N m]")


@law("normal_contact", "own", role_api=3, reference="own work")
def normal_contact(delta, R_x, R_y, E_eff, par, out):
    out[0] = 1e8 * delta
    out[1] = 1e-6
    out[2] = 1e-6
    out[3] = 1.5 * out[0] / (math.pi * 1e-12)
    return OK


@law("damping", "own", role_api=3, reference="own work")
def damping(delta, delta_dot, load, par, out):
    force = 100.0 * delta_dot
    out[0] = force if force > -load else -load
    return OK


@law("rheology", "own", role_api=3, reference="own work")
def rheology(p, T, par, ln_eta, rho):
    for i in range(p.size):
        ln_eta[i] = math.log(0.05) + 2e-8 * min(p[i], 1e9) - 0.03 * (T[i] - 313.15)
        rho[i] = 870.0
    return OK


@law("film_thickness", "own", role_api=3, reference="own work")
def film_thickness(u_mean, cos2, load, R_x, R_y, E_eff, eta0, alpha_p, par, out):
    out[0] = 1e-6
    out[1] = 5e-7
    return OK


@law("thermal_correction", "own", role_api=3, reference="own work")
def thermal_correction(u_mean, u_slide, p_max, E_eff, eta0, beta, k_oil, par, out):
    out[0] = 1.0
    return OK


@law("contact_temperature", "own", role_api=3, reference="own work")
def contact_temperature(T_in, u_mean, h, semi_b, tau, slip, par, T):
    for i in range(T.size):
        T[i] = T_in
    return OK


@law("traction", "own", role_api=3, reference="own work")
def traction(slip, p, T, ln_eta, h, par, tau):
    for i in range(tau.size):
        tau[i] = 1e15 * slip[i]
    return OK


@law("traction", "own-rib", role_api=3, reference="own work")
def rib_traction(slip, p, T, ln_eta, h, par, tau):
    """Let ribs slide: an oil that hardly holds them."""
    for i in range(tau.size):
        tau[i] = 1e9 * slip[i]
    return OK


@law("rolling_resistance", "own", role_api=3, reference="own work")
def rolling_resistance(u_mean, load, semi_a, semi_b, R_x, R_y, E_eff, eta0, alpha_p, beta, k_oil, par, out):
    out[0] = 0.0
    return OK


@law("elastic_hysteresis", "own", Moment, role_api=3, reference="own work")
def elastic_hysteresis(load, semi_a, semi_b, R_x, R_y, R_ball, par, out):
    out[0] = par.moment
    return OK


@law("asperity_load", "own", role_api=3, reference="own work")
def asperity_load(Lambda, par, out):
    out[0] = 0.0
    return OK


@law("mixing", "own", role_api=3, reference="own work")
def mixing(psi, Lambda, load, p_max, semi_a, semi_b, par, out):
    out[0] = 1.0
    out[1] = 0.0
    return OK


@law("supply", "own", role_api=3, reference="own work")
def supply(u_mean, load, semi_a, semi_b, R_x, h_cen, h_min, par, out):
    out[0] = 1.0
    out[1] = 1.0
    return OK


@law("boundary_friction", "own", role_api=3, reference="own work")
def boundary_friction(slip, p, u_mean, par, mu):
    for i in range(mu.size):
        mu[i] = 0.0
    return OK


@law("normal_contact", "own-line", role_api=3, reference="own work", contact="line")
def normal_line(delta, R_x, R_y, E_eff, par, out):
    out[0] = 5e8 * delta
    out[1] = 0.5 * R_y
    out[2] = 1e-6
    out[3] = out[0] / (2e-6 * R_y)
    return OK


@law("damping", "own-line", role_api=3, reference="own work", contact="line")
def damping_line(delta, delta_dot, load, par, out):
    force = 100.0 * delta_dot
    out[0] = force if force > -load else -load
    return OK


@law("film_thickness", "own-line", role_api=3, reference="own work", contact="line")
def film_line(u_mean, cos2, load, R_x, R_y, E_eff, eta0, alpha_p, par, out):
    out[0] = 1e-6
    out[1] = 5e-7
    return OK


@law("rolling_resistance", "own-line", role_api=3, reference="own work", contact="line")
def rolling_line(u_mean, load, semi_a, semi_b, R_x, R_y, E_eff, eta0, alpha_p, beta, k_oil, par, out):
    out[0] = 0.0
    return OK


@law("elastic_hysteresis", "own-line", Moment, role_api=3, reference="own work", contact="line")
def hysteresis_line(load, semi_a, semi_b, R_x, R_y, R_ball, par, out):
    out[0] = par.moment
    return OK


@law("capacitance", "own-line", role_api=3, reference="own work", contact="line")
def capacitance_line(C_hertz, h, semi_a, semi_b, R_x, R_y, U, G, W, eps_r0, par, out):
    out[0] = C_hertz
    return OK


AGE = State("age", "s", "how long the run goes on", scale=1.0)


@law("contact_state", "own", role_api=3, reference="own work", states=(AGE,))
def contact_state(t, load, semi_a, semi_b, p_max, u_mean, u_slide, spin, h, Lambda, psi, power, T_film, T_in, par, out):
    out[0] = 1.0
    return OK


@law("cage_contact", "own", role_api=3, reference="own work", contact="any")
def cage_contact(r, v_rel, omega_rel, eta0, par, out):
    for i in range(6):
        out[i] = 0.0
    return OK


@law("fluid_drag", "own", role_api=3, reference="own work", contact="any")
def fluid_drag(v_orbit, omega_spin, azimuth, nu, rho, par, out):
    out[0] = 0.0
    out[1] = 0.0
    return OK


@law("permittivity", "own", role_api=3, reference="own work")
def permittivity(p, T, rho, par, eps_r):
    for i in range(p.size):
        eps_r[i] = 2.0
    return OK


@law("capacitance", "own", role_api=3, reference="own work")
def capacitance(C_hertz, h, semi_a, semi_b, R_x, R_y, U, G, W, eps_r0, par, out):
    out[0] = C_hertz
    return OK


@law("surface", "own", role_api=3, reference="own work")
def surface(azimuth, contact_angle, par, out):
    """Write raceways a micrometre higher.

    Both, all around: another clearance.
    """
    out[0] = 1e-6
    out[1] = 0.0
    out[2] = 0.0
    return OK


@law("breakdown", "own", role_api=3, reference="own work")
def breakdown(h, h_min, sigma, area, u_1, u_2, par, out):
    """Write a breakdown voltage of 4 V."""
    out[0] = 4.0
    return OK


@law("discharge", "own", role_api=3, reference="own work")
def discharge(V, h, area, par, out):
    """Write arcs of a given resistance.

    7 Ohm times the voltage that they begin at, in volts.
    """
    out[0] = 7.0 * V
    out[1] = 0.0
    out[2] = 1e-3
    return OK
