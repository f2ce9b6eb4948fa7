"""Draw arguments for trying a kernel.

The ranges span what the dynamics of deep-groove ball bearings from 10 to 300 mm can ask of a
law, transients included, and are wider than the range in which most laws were measured.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.random import Generator

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.role import Role
from lambda_core.laws.context import Context, Material, Oil
from lambda_core.laws.state import ROLE as STATES


@dataclass(frozen=True)
class Range:
    """Range of an argument, SI.

    `log` draws evenly per decade, `zero` adds the exact 0.
    """

    low: float
    high: float
    log: bool = False
    zero: bool = False

    def at(self, share: FloatArray) -> FloatArray:
        """Return the values at a share of the range.

        `share` is 0..1, of any shape.
        """
        if self.log:
            drawn = np.exp(math.log(self.low) + share * math.log(self.high / self.low))
        else:
            drawn = self.low + share * (self.high - self.low)
        values: FloatArray = np.where(share < 0.02, 0.0, drawn) if self.zero else drawn
        return values


RANGES: dict[str, Range] = {
    "delta": Range(1e-9, 1e-4, log=True),
    "delta_dot": Range(-0.5, 0.5),
    "load": Range(1e-3, 5e4, log=True),
    "R_x": Range(1e-3, 5e-2, log=True),
    "R_y": Range(1e-2, 2.0, log=True),
    "E_eff": Range(2.0e11, 3.5e11),
    "p": Range(0.0, 4e9),
    "p_max": Range(1e7, 4e9, log=True),
    "T": Range(250.0, 450.0),
    "T_in": Range(250.0, 420.0),
    "ln_eta": Range(math.log(1e-3), 40.0),
    "u_mean": Range(1e-3, 40.0, log=True, zero=True),
    "u_slide": Range(1e-6, 10.0, log=True, zero=True),
    "slip": Range(1e-8, 10.0, log=True, zero=True),
    "cos2": Range(0.0, 1.0),
    "eta0": Range(1e-3, 5.0, log=True),
    "alpha_p": Range(5e-9, 4e-8),
    "beta": Range(0.01, 0.1),
    "k_oil": Range(0.1, 0.2),
    "h": Range(1e-9, 1e-5, log=True),
    "semi_a": Range(1e-5, 5e-3, log=True),
    "semi_b": Range(1e-6, 1e-3, log=True),
    "tau": Range(0.0, 3e8),
    "rho": Range(700.0, 1300.0),
    "R_ball": Range(1e-3, 5e-2, log=True),
    "h_cen": Range(1e-9, 1e-5, log=True),
    "h_min": Range(1e-9, 1e-5, log=True),
    "Lambda": Range(1e-3, 30.0, log=True, zero=True),
    "r": Range(-1e-3, 1e-3),
    "t": Range(0.0, 10.0),
    "place": Range(-1e-3, 1e-3),
    "tilt": Range(-1e-2, 1e-2),
    "v_rel": Range(-1.0, 1.0),
    "omega_rel": Range(-1000.0, 1000.0),
    "v_orbit": Range(-30.0, 30.0),
    "omega_spin": Range(0.0, 3000.0),
    "azimuth": Range(-math.pi, math.pi),
    "nu": Range(1e-6, 1e-2, log=True),
    "C_hertz": Range(1e-14, 1e-9, log=True),
    "U": Range(1e-14, 1e-9, log=True),
    "G": Range(1e3, 1e4),
    "W": Range(1e-9, 1e-4, log=True),
    "eps_r0": Range(1.8, 8.0),
    "contact_angle": Range(-0.9, 0.9),
    "sigma": Range(1e-8, 1e-6, log=True),
    "area": Range(1e-10, 1e-4, log=True),
    "u_1": Range(1e-15, 1.0 - 1e-15),
    "u_2": Range(1e-15, 1.0 - 1e-15),
    "V": Range(0.1, 1000.0, log=True),
    "spin": Range(-1000.0, 1000.0),
    "psi": Range(0.0, 1.0),
    "power": Range(1e-6, 1e4, log=True, zero=True),
    "T_film": Range(250.0, 600.0),
}

VECTORS = ("r", "place", "tilt", "v_rel", "omega_rel")  # arrays of three components, not of cells


_EVEN_OPEN = ("t", "T_film", "T_in")  # what a state's law sees although the contact is open
WRENCHES = ("cage_contact", "force_element")  # roles whose output is two vectors


def output_size(role: Role, cells: int, states: int = 0) -> int:
    """Return the length of each output array.

    A law with states has as many more.
    """
    if role.elementwise:
        return cells
    if role.name == STATES:
        return states
    return 6 if role.name in WRENCHES else len(role.outputs)


def draw(role: Role, par: FloatArray, cells: int, generator: Generator, states: int = 0) -> list[Any]:
    """Draw one set of arguments for a kernel.

    The kernel belongs to `role`, to a law with so many states.

    Returns
    -------
    list
        float64 scalars and arrays in the role's order; arrays of cells have shape
        (cells,), vectors (3,), outputs are filled with NaN.
    """
    arguments: list[Any] = []
    for argument in role.arguments:
        if argument.name == "par":
            arguments.append(par)
        elif argument.output:
            arguments.append(np.full(output_size(role, cells, states), np.nan))
        elif argument.kind == "a":
            size = 3 if argument.name in VECTORS else cells
            arguments.append(RANGES[argument.name].at(generator.random(size)))
        else:
            arguments.append(np.float64(RANGES[argument.name].at(generator.random(1))[0]))
    return arguments


def open_contact(role: Role, drawn: list[Any]) -> list[Any]:
    """Return drawn arguments without contact.

    Ball and raceway do not touch.
    """
    return [
        np.float64(0.0) if argument.kind == "f" and argument.name not in _EVEN_OPEN else value
        for argument, value in zip(role.arguments, drawn, strict=True)
    ]


_STEEL = Material("steel", 2.08e11, 0.3, 7850.0, 45.0, 460.0)
_OIL = Oil("trial oil", "mineral", 313.15, 0.135, 2000.0, 0.0976, 870.0, 20.4e-9, 0.045)


def trial_context(element: str, oil: Oil = _OIL) -> Context:
    """Return the context of a test bearing.

    It is a 6208 deep-groove ball bearing at 40 degC.

    Nine balls of 11.906 mm on a pitch circle of 60 mm, steel, conformity 0.52, 2750 1/min.
    """
    inner = element in ("ball_inner", "cage_inner", "film_inner")
    ball_diameter, pitch_diameter = 11.906e-3, 60.0e-3
    gamma = ball_diameter / pitch_diameter
    curvature = 2.0 / ball_diameter * (1.0 + gamma / (1.0 - gamma) if inner else 1.0 - gamma / (1.0 + gamma))
    groove = 0.52 * ball_diameter
    raceway = element in ("ball_inner", "ball_outer", "film_inner", "film_outer")
    return Context(
        element=element,
        ball_count=9,
        ball_diameter=ball_diameter,
        pitch_diameter=pitch_diameter,
        bore_diameter=40.0e-3,
        outside_diameter=80.0e-3,
        width=18.0e-3,
        series="62",
        speed=2750.0 * math.pi / 30.0,
        mean_load=550.0,
        ball=_STEEL,
        partner=_STEEL,
        oil=oil,
        contact_angle=0.26 if raceway else math.nan,
        groove_radius=groove if raceway else math.nan,
        race_diameter=(pitch_diameter - ball_diameter if inner else pitch_diameter + ball_diameter)
        if raceway
        else math.nan,
        radius_x=1.0 / curvature if raceway else math.nan,
        radius_y=1.0 / (2.0 / ball_diameter - 1.0 / groove) if raceway else math.nan,
        e_eff=_STEEL.youngs_modulus / (1.0 - _STEEL.poisson_ratio**2),
        pocket_clearance=0.25e-3,
        land_clearance=0.30e-3,
        land_diameter=52.0e-3 if inner else 68.0e-3,
        cage_width=12.0e-3,
        oil_level=0.5 * ball_diameter,
        oil_flow=1e-5,
    )
