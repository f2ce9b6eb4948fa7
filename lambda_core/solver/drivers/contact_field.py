"""Compute the fields inside one contact ellipse.

These are pressure, slip, shear, temperature and permittivity, cell by cell.

The compiled contact pipeline of the simulation, run once on a grid as fine as one likes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.domain.errors import SolverError
from lambda_core.elements.ball.raceways import raceways
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.contact_grid import cell_block, contacts_at_once, unit_grid
from lambda_core.solver.drivers.equilibrium import fault_sentence
from lambda_core.solver.drivers.solver_context import SolverContext


@dataclass(frozen=True)
class ContactField:
    """One ball-raceway contact in cells, SI.

    The cells form a structured mesh of shape (strips, rows).

    Attributes
    ----------
    load, film, semi_axis_a, semi_axis_b, max_pressure, loss : float
        Normal load, damping included [N]; central film [m]; semi-axes across and along rolling [m]; [Pa];
        power dissipated in the contact [W].
    radius_x, radius_y : float
        Reduced radii along and across rolling [m].
    across, along : float64[:, :]
        Places of the cells from the contact's centre: across rolling, along rolling [m].
    area : float64[:, :]
        Area of each cell [m2].
    pressure, shear : float64[:, :]
        [Pa]; shear is that of film and asperities together, against the slip.
    slip_along, slip_across : float64[:, :]
        Velocity of the ball over the ring [m/s].
    temperature : float64[:, :]
        Mean film temperature [K].
    permittivity : float64[:, :]
        Relative permittivity of the oil at the pressure and the bulk temperature.
    """

    load: float
    film: float
    semi_axis_a: float
    semi_axis_b: float
    max_pressure: float
    loss: float
    radius_x: float
    radius_y: float
    across: FloatArray
    along: FloatArray
    area: FloatArray
    pressure: FloatArray
    shear: FloatArray
    slip_along: FloatArray
    slip_across: FloatArray
    temperature: FloatArray
    permittivity: FloatArray


def contact_state(sample: Mapping[str, FloatArray], ball: int, ring: str) -> tuple[FloatArray, FloatArray]:
    """Return the states of ball and ring.

    The channels of one sample give one ball (9,) and one ring (12,).

    Parameters
    ----------
    sample : mapping
        Channel -> array without the time axis, SI (lambda_core.domain.channels).
    ball : int
        From 0.
    """
    one = np.concatenate(
        [
            [sample["ball_axial"][ball], sample["ball_radius"][ball], sample["ball_azimuth"][ball]],
            sample["ball_velocity"][ball],
            sample["ball_spin"][ball],
        ]
    )
    body = RINGS.index(ring)
    state = np.zeros(1, R.BODY_STATE)
    other = state[0]
    other.position[:] = sample["body_position"][body]
    other.tilt[:] = sample["body_tilt"][body][1], -sample["body_tilt"][body][0]
    other.tilt_velocity[:] = sample["body_tilt_velocity"][body]
    other.angle, other.spin = sample["body_spin_angle"][body], sample["body_spin"][body]
    other.velocity[:] = sample["body_velocity"][body]
    return one, state.view(np.float64)


def contact_field(
    context: SolverContext, ball: FloatArray, body: FloatArray, place: int, strips: int = 61, rows: int = 41
) -> ContactField:
    """Run the contact pipeline on a fine grid.

    The contact is that of one ball and one raceway.

    Parameters
    ----------
    context : SolverContext
        Of the equilibrium that the run started from.
    ball, body : float64[:], shapes (9,) and (12,)
        States of the ball and of the ring (lambda_core.solver.layout).
    place : int
        Which of the bearing's raceways, in the order of system.raceways.raceways.

    Raises
    ------
    SolverError
        When the bodies do not touch, or a law refuses.
    """
    bundle, kernels, groove = context.bundle, context.kernels, raceways(context.model.geometry)[place]
    raceway: Any = bundle.raceways[place]
    grid = unit_grid(strips, rows)
    width = grid.shape[1]
    cells, scratch = cell_block(width, contacts_at_once(width)), np.zeros_like(bundle.scratch)
    losses = np.zeros(L.MECHANISMS * bundle.raceways.size)
    scratch[0].fault.role = -1
    finer = bundle._replace(grid=grid, cells=cells, scratch=scratch)
    status = core().probe(ball.view(R.BALL), body.view(R.BODY_STATE), place, finer, losses)
    if status == -1:
        raise SolverError(
            f"the ball does not touch the {RINGS[groove.ring]} ring at this moment: choose another ball or time"
        )
    if status != 1:
        bundle.scratch["fault"] = scratch["fault"]
        raise SolverError(fault_sentence(context))
    contact, its = scratch[0].contact[0], L.named_cells(cells, 0, 1, width)
    places, a, b = L.Grid(*grid), float(contact.semi_axis_a), float(contact.semi_axis_b)

    def mesh(values: FloatArray) -> FloatArray:
        return values[: strips * rows].reshape(strips, rows).copy()

    element = groove.element
    pars = {name: context.parameters(element, name) for name in ("rheology", "permittivity")}
    ln_eta, density, permittivity = np.zeros((3, grid.shape[1]))
    inlet = np.full(grid.shape[1], float(raceway.oil.temperature))
    pressure = its.pressure.copy()
    status = kernels.compiled[element, "rheology"].dispatcher(pressure, inlet, pars["rheology"], ln_eta, density)
    if status == 1:
        law = kernels.compiled[element, "permittivity"].dispatcher
        status = law(pressure, inlet, density, pars["permittivity"], permittivity)
    if status != 1:
        raise SolverError(f"{context.model.laws[element]['permittivity'].model.label} returned status {status}")
    return ContactField(
        load=float(contact.load + contact.damping_force),
        film=float(contact.film_central),
        semi_axis_a=a,
        semi_axis_b=b,
        max_pressure=float(contact.max_pressure),
        loss=float(losses.sum()),
        radius_x=float(raceway.radius_x),
        radius_y=float(raceway.radius_y),
        across=mesh(a * places.across),
        along=mesh(b * places.along),
        area=mesh(a * b * places.area),
        pressure=mesh(pressure),
        shear=mesh(its.shear),
        slip_along=mesh(its.slip_t),
        slip_across=mesh(its.slip_s),
        temperature=mesh(its.temperature),
        permittivity=mesh(permittivity),
    )
