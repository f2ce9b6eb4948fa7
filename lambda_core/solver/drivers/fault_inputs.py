"""Name the inputs in a fault report."""

from __future__ import annotations

# What the report of a fault holds of a law's inputs, by the names of the law's arguments; "state" is a contact's first.
INPUTS = {
    "normal_contact": ("delta", "R_x", "R_y", "E_eff"),
    "damping": ("delta", "delta_dot", "load"),
    "rheology": ("p", "T"),
    "film_thickness": ("u_mean", "cos2", "load", "eta0"),
    "thermal_correction": ("u_mean", "u_slide", "p_max", "eta0"),
    "supply": ("u_mean", "load", "h_cen", "heated"),
    "contact_temperature": ("u_mean", "h", "semi_b", "tau"),
    "traction": ("p", "h", "slip", "ln_eta"),
    "rolling_resistance": ("u_mean", "load", "semi_a", "semi_b"),
    "elastic_hysteresis": ("load", "semi_a", "semi_b", "R_x"),
    "asperity_load": ("Lambda", "load"),
    "boundary_friction": ("slip", "p"),
    "mixing": ("psi", "Lambda", "load", "p_max"),
    "contact_state": ("t", "load", "power", "state"),
    "permittivity": ("p", "T", "rho"),
    "capacitance": ("C_hertz", "h", "semi_a", "semi_b"),
    "surface": ("azimuth", "contact_angle"),
    "cage_contact": ("r[0]", "r[1]", "r[2]", "v_rel[0]"),
    "fluid_drag": ("v_orbit", "omega_spin", "azimuth", "nu"),
    "force_element": ("t", "place[0]", "place[1]", "place[2]"),
    "time_function": ("t", "out[0]", "out[1]", "out[2]"),
}
