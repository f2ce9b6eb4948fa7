"""From a resolved model to the arrays and pointers that compiled code works on."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.physics.compiled import layout as L
from lambda_core.physics.compiled.blocks import make_blocks
from lambda_core.physics.compiled.entry import core
from lambda_core.physics.contact_grid import unit_grid
from lambda_core.physics.hertz import ball_raceway_radii
from lambda_core.physics.kernels import Kernels
from lambda_core.physics.law_inputs import ContactFrame, effective_modulus, prepare_all
from lambda_core.physics.model import DOFS, BearingModel
from lambda_core.physics.time_tables import build_times
from lambda_core.registry.model import Oil

FloatArray = NDArray[np.float64]
# Below this mean surface velocity the rolling losses change sign smoothly: far below any running speed, wide
# enough for the integrator to cross when a bearing starts, stops or reverses.
ROLL_FLOOR = 1e-3  # [m/s]
# Slip below which the direction of shear fades out; small against creep at any running speed.
SLIP_FLOOR = 1e-6  # [m/s]
_MODES = {"free": L.FREE, "locked": L.LOCKED, "prescribed": L.PRESCRIBED}


def ball_mass(model: BearingModel) -> float:
    """Return the mass of one ball [kg]."""
    return model.ball_material.density * math.pi * model.geometry.ball_diameter**3 / 6.0


def build_system(model: BearingModel, frame: ContactFrame, oil: Oil) -> Any:
    """Fill the record of constants."""
    g = model.geometry
    system = np.zeros(1, dtype=L.SYSTEM)
    s = system[0]
    radius = 0.5 * g.ball_diameter
    mass = ball_mass(model)
    grooves = (g.groove_radius_inner, g.groove_radius_outer)
    s["balls"], s["cage_on"] = g.ball_count, int(model.depth.cage)
    s["ball_radius"], s["ball_mass"], s["ball_inertia"] = radius, mass, 0.4 * mass * radius**2
    s["groove_circle"] = (
        0.5 * g.race_diameter_inner + grooves[0],
        0.5 * g.race_diameter_outer - grooves[1],
    )
    s["groove_radius"] = grooves
    for i, ring in enumerate((model.inner_material, model.outer_material)):
        rx, ry = ball_raceway_radii(g.ball_diameter, g.pitch_diameter, grooves[i], frame.angles[i], inner=i == 0)
        s["radius_x"][i], s["radius_y"][i] = rx, ry
        s["e_eff"][i] = effective_modulus(model.ball_material, ring)
        s["radius_deformed"][i] = 2.0 * grooves[i] * radius / (grooves[i] + radius)
    for b, body in enumerate((model.inner_ring, model.outer_ring, model.cage_body)):
        s["mass"][b] = body.mass
        s["transverse_inertia"][b] = body.transverse_inertia
        s["polar_inertia"][b] = body.polar_inertia
        s["unbalance"][b] = body.unbalance
        for d, name in enumerate(DOFS):
            dof = body.dofs[name]
            s["mode"][6 * b + d] = _MODES[dof.mode]
            s["stiffness"][6 * b + d], s["damping"][6 * b + d] = dof.stiffness, dof.damping
    s["gravity"] = model.gravity
    s["oil_temperature"], s["k_oil"] = oil.temperature, oil.thermal_conductivity
    s["eta0"], s["alpha_p"], s["beta"], s["rho0"] = oil.viscosity, oil.alpha_p, oil.beta, oil.density
    s["roughness"], s["starvation"] = model.roughness, model.starvation
    s["pocket_circle"] = 0.5 * g.pitch_diameter
    s["land_offset"] = 0.5 * model.cage.width
    s["land_on"] = [int(model.laws[e]["cage_contact"].model.name != "none") for e in ("cage_inner", "cage_outer")]
    s["surface_on"] = [int(model.laws[e]["surface"].model.name != "none") for e in ("ball_inner", "ball_outer")]
    s["surfaces"] = int(s["surface_on"].any())
    s["drag_on"] = int(model.laws["fluid_drag"]["fluid_drag"].model.name != "none")
    s["roll_floor"], s["slip_floor"] = ROLL_FLOOR, SLIP_FLOOR
    s["friction_on"], s["guides_on"] = 1, 1
    return system


def state_scales(model: BearingModel, active: NDArray[np.int64]) -> FloatArray:
    """Return the absolute scales that the tolerance multiplies, shape (9 Z + n_active,).

    Positions 50 um, velocities 0.1 m/s, ball spins 7 rad/s; angles and angular speeds of the big bodies and
    azimuths are the same lengths and velocities at the pitch radius.
    """
    arm = 0.5 * model.geometry.pitch_diameter
    length, speed, spin = 50e-6, 0.1, 7.0
    ball = [length, length, length / arm, speed, speed, speed, spin, spin, spin]
    body = [length] * 3 + [length / arm] * 3 + [speed] * 3 + [speed / arm] * 3
    shared = np.array(body * 3)
    return np.concatenate([np.tile(ball, model.geometry.ball_count), shared[active]])


@dataclass
class Assembly:
    """Everything compiled code needs for one model at one contact frame."""

    model: BearingModel
    kernels: Kernels
    oil: Oil
    frame: ContactFrame
    bundle: L.Bundle
    blocks: Any
    scale: FloatArray

    def parameters(self, element: str, role: str) -> FloatArray:
        """Return the parameters of a raceway's law, a view of what compiled code reads."""
        system = self.bundle.system[0]
        k = L.RACEWAY_KERNELS * ("ball_inner", "ball_outer").index(element) + L.RACEWAY_ROLES.index(role)
        found: FloatArray = self.bundle.par[system["par_start"][k] : system["par_start"][k + 1]]
        return found

    @property
    def size(self) -> int:
        """Number of states."""
        return int(self.scale.size)


def assemble(model: BearingModel, kernels: Kernels, frame: ContactFrame, oil: Oil) -> Assembly:
    """Build the bundle for given frozen contact angles and mean loads."""
    terms, table, active = build_times(model)
    grid = unit_grid(model.depth.strips, model.depth.rows)
    balls = model.geometry.ball_count
    pars = prepare_all(model, frame, oil)
    system = build_system(model, frame, oil)
    system[0]["par_start"][: L.N_PAR + 1] = np.cumsum([0, *(par.size for par in pars)])
    compiled = core()
    bundle = L.Bundle(
        system,
        kernels.pointers(),
        compiled.wrench_pointer,
        compiled.tangent_pointer,
        np.concatenate(pars),
        grid,
        terms,
        table,
        active,
        np.zeros((L.NCH, 3)),
        np.zeros((2, L.N_CELL_ROWS, grid.shape[1])),
        np.zeros((L.N_SCRATCH, 64)),
        np.zeros((balls, 6)),
    )
    blocks = make_blocks(balls, active)
    return Assembly(model, kernels, oil, frame, bundle, blocks, state_scales(model, active))
