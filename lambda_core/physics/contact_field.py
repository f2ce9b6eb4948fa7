"""What happens inside one contact ellipse: pressure, slip, shear, temperature and permittivity cell by cell.

The compiled contact pipeline of the simulation, run once on a grid as fine as one likes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.errors import SolverError
from lambda_core.physics.assembly import Assembly
from lambda_core.physics.channels import RINGS
from lambda_core.physics.compiled import layout as L
from lambda_core.physics.compiled import probe
from lambda_core.physics.contact_grid import unit_grid
from lambda_core.physics.equilibrium import fault_sentence
from lambda_core.registry.kernels import compile_host

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class ContactField:
    """One ball - raceway contact, cells on a structured mesh of shape (strips, rows), SI.

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
    """Return the states of one ball (9,) and one ring (12,) from the channels of one sample.

    Parameters
    ----------
    sample : mapping
        Channel -> array without the time axis, SI (lambda_core.physics.channels).
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
    other = np.zeros(L.NS)
    other[L.SX : L.SX + 3] = sample["body_position"][body]
    other[L.SAZ], other[L.SAY] = -sample["body_tilt"][body][0], sample["body_tilt"][body][1]
    other[L.SWY : L.SWY + 2] = sample["body_tilt_velocity"][body]
    other[L.STHETA] = sample["body_spin_angle"][body]
    other[L.SVX : L.SVX + 3] = sample["body_velocity"][body]
    other[L.SSIGMA] = sample["body_spin"][body]
    return one, other


def contact_field(
    assembly: Assembly, ball: FloatArray, ring: FloatArray, which: str, strips: int = 61, rows: int = 41
) -> ContactField:
    """Run the contact pipeline of one ball and one ring on a fine grid.

    Parameters
    ----------
    assembly : Assembly
        Of the equilibrium that the run started from.
    ball, ring : float64[:], shapes (9,) and (12,)
        States (lambda_core.physics.compiled.layout).
    which : str
        ``inner`` or ``outer``.

    Raises
    ------
    SolverError
        When the bodies do not touch, or a law refuses.
    """
    index, bundle, kernels = RINGS.index(which), assembly.bundle, assembly.kernels
    system: Any = bundle.system.view(np.recarray)[0]
    grid = unit_grid(strips, rows)
    cells, scratch, losses = np.zeros((2, L.N_CELL_ROWS, grid.shape[1])), np.zeros_like(bundle.scratch), np.zeros(L.NL)
    scratch[L.FAULT, 0] = -1.0
    finer = bundle._replace(grid=grid, cells=cells, scratch=scratch)
    run = compile_host(probe.probe, probe.probe_sig, Path(probe.__file__).parent).dispatcher
    status = run(np.ascontiguousarray(ball), np.ascontiguousarray(ring), index, finer, losses)
    if status == -1:
        raise SolverError(f"the ball does not touch the {which} ring at this moment")
    if status != 1:
        bundle.scratch[L.FAULT] = scratch[L.FAULT]
        raise SolverError(fault_sentence(assembly))
    scalars, cells = scratch[L.SCALARS], cells[0]
    a, b = float(scalars[L.C_A]), float(scalars[L.C_B])

    def mesh(values: FloatArray) -> FloatArray:
        return values[: strips * rows].reshape(strips, rows).copy()

    element = f"ball_{which}"
    pars = {name: assembly.parameters(element, name) for name in ("rheology", "permittivity")}
    ln_eta, density, permittivity = np.zeros((3, grid.shape[1]))
    inlet = np.full(grid.shape[1], float(system.oil_temperature))
    pressure = cells[L.X_P].copy()
    status = kernels.compiled[element, "rheology"].dispatcher(pressure, inlet, pars["rheology"], ln_eta, density)
    if status == 1:
        law = kernels.compiled[element, "permittivity"].dispatcher
        status = law(pressure, inlet, density, pars["permittivity"], permittivity)
    if status != 1:
        raise SolverError(f"{assembly.model.laws[element]['permittivity'].model.label} returned status {status}")
    return ContactField(
        load=float(scalars[L.C_LOAD] + scalars[L.C_DAMP]),
        film=float(scalars[L.C_HCEN]),
        semi_axis_a=a,
        semi_axis_b=b,
        max_pressure=float(scalars[L.C_PMAX]),
        loss=float(losses.sum()),
        radius_x=float(system.radius_x[index]),
        radius_y=float(system.radius_y[index]),
        across=mesh(a * grid[L.GRID_S]),
        along=mesh(b * grid[L.GRID_T]),
        area=mesh(a * b * grid[L.GRID_AREA]),
        pressure=mesh(pressure),
        shear=mesh(cells[L.X_TAU]),
        slip_along=mesh(cells[L.X_VT]),
        slip_across=mesh(cells[L.X_VS]),
        temperature=mesh(cells[L.X_T1]),
        permittivity=mesh(permittivity),
    )
