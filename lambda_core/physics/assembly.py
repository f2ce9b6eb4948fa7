"""From a resolved model to the arrays and pointers that compiled code works on."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from lambda_core.errors import SolverError
from lambda_core.physics.compiled import layout as L
from lambda_core.physics.compiled.entry import core
from lambda_core.physics.compiled.jacobian import make_blocks
from lambda_core.physics.hertz import ball_raceway_radii, reduced_modulus
from lambda_core.physics.model import DOFS, BearingModel, Law, TimeFunction
from lambda_core.physics.time_functions import peak
from lambda_core.registry.check import check_choice
from lambda_core.registry.kernels import compile_kernel
from lambda_core.registry.model import Context, Material, Oil
from lambda_core.registry.par import make_par

FloatArray = NDArray[np.float64]
Announce = Callable[[str], None] | None

# Below this mean surface velocity the rolling losses change sign smoothly: far below any running speed, wide
# enough for the integrator to cross when a bearing starts, stops or reverses.
ROLL_FLOOR = 1e-3  # [m/s]
# Slip below which the direction of shear fades out; small against creep at any running speed.
SLIP_FLOOR = 1e-6  # [m/s]
_VECTOR = 16  # cells that vectorised loops take at once
_MODES = {"free": L.FREE, "locked": L.LOCKED, "prescribed": L.PRESCRIBED}
_KINDS = {"constant": L.TF_CONSTANT, "ramp": L.TF_RAMP, "harmonic": L.TF_HARMONIC, "table": L.TF_TABLE}


@dataclass(frozen=True)
class ContactFrame:
    """Frozen geometry of the two raceway force elements: inner, outer."""

    angles: tuple[float, float]  # contact angles at which R_x is frozen [rad]
    mean_loads: tuple[float, float]  # [N]


def effective_modulus(one: Material, other: Material) -> float:
    """Return E' of two bodies [Pa]."""
    return reduced_modulus(one.youngs_modulus, one.poisson_ratio, other.youngs_modulus, other.poisson_ratio)


def ball_mass(model: BearingModel) -> float:
    """Return the mass of one ball [kg]."""
    return model.ball_material.density * math.pi * model.geometry.ball_diameter**3 / 6.0


def unit_grid(strips: int, rows: int) -> FloatArray:
    """Divide the unit ellipse into strips and rows; weights carry area and load exactly.

    Returns
    -------
    float64[:, :], shape (6, strips * rows rounded up to full vectors)
        Rows layout.GRID_S ... GRID_DT. sum(area) = pi and sum(area * pressure) = 2 pi/3, the Hertzian load over
        a b p_max.
    """
    edges = np.linspace(-1.0, 1.0, strips + 1)
    mid = 0.5 * (edges[1:] + edges[:-1])
    area, load = np.diff(_disc_area(edges)), np.diff(0.5 * np.pi * (edges - edges**3 / 3.0))
    half = np.sqrt(1.0 - mid * mid)
    row_edges = np.linspace(-1.0, 1.0, rows + 1)
    row_mid = 0.5 * (row_edges[1:] + row_edges[:-1])
    row_load = np.diff(_disc_area(row_edges)) / np.pi
    shape = (strips, rows)
    per_area = np.repeat(area[:, None] / rows, rows, 1)
    grid = np.array(
        [
            np.repeat(mid[:, None], rows, 1).ravel(),
            (half[:, None] * row_mid[None, :]).ravel(),
            (load[:, None] * row_load[None, :] / per_area).ravel(),
            per_area.ravel(),
            np.full(shape, 2.0 / strips).ravel(),
            np.repeat(half[:, None] * 2.0 / rows, rows, 1).ravel(),
        ]
    )
    # Loops over cells run in vectors: filled up with copies of the last cell that have no area.
    filling = np.repeat(grid[:, -1:], -grid.shape[1] % _VECTOR, axis=1)
    filling[L.GRID_AREA] = 0.0
    return np.concatenate([grid, filling], axis=1)


def _disc_area(x: FloatArray) -> FloatArray:
    """Return the area of the unit disc to the left of x, up to a constant."""
    return x * np.sqrt(np.maximum(1.0 - x * x, 0.0)) + np.arcsin(x)


def _terms(channel: int, function: TimeFunction, rows: list[list[float]], table: list[float]) -> None:
    """Append a time function's terms to the flat tables that compiled code reads."""
    for term in function.terms:
        row = [float(channel), float(_KINDS[term.kind]), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
        if term.kind == "table":
            from scipy.interpolate import CubicSpline  # a third of a second to import, and most runs have no table

            times, values = np.array(term.values[0::2]), np.array(term.values[1::2])
            row[6], row[7] = len(table), times.size
            spline = CubicSpline(times, values, bc_type="clamped" if times.size > 2 else "natural")
            for i in range(times.size - 1):
                table += [times[i], *(float(spline.c[3 - k, i]) for k in range(4))]
            table += [times[-1], values[-1], 0.0, 0.0, 0.0]
        else:
            row[2 : 2 + len(term.values)] = term.values
        rows.append(row)


def build_times(model: BearingModel) -> tuple[FloatArray, FloatArray, NDArray[np.int64]]:
    """Return flattened loads and motions (terms, table) and the indices of the free shared states."""
    rows: list[list[float]] = []
    table: list[float] = []
    active: list[int] = []
    for b, body in enumerate((model.inner_ring, model.outer_ring, model.cage_body)):
        if b == L.CAGE and not model.depth.cage:
            continue
        for d, name in enumerate(DOFS):
            dof = body.dofs[name]
            if dof.mode == "prescribed":
                _terms(L.CH_MOTION + 6 * b + d, dof.motion, rows, table)
            if dof.mode == "free":
                # Turning about y moves a_z, turning about z moves a_y.
                position = {3: L.SAZ, 4: L.SAY}.get(d, d)
                active += [L.NS * b + position, L.NS * b + 6 + d]
            elif d == 5 and dof.mode == "prescribed":
                active.append(L.NS * b + L.STHETA)
        for axis in range(3):
            _terms(L.CH_FORCE + 3 * b + axis, body.force[axis], rows, table)
            _terms(L.CH_MOMENT + 3 * b + axis, body.moment[axis], rows, table)
    terms = np.array(rows, dtype=np.float64).reshape(-1, 8)
    return terms, np.array(table or [0.0]), np.array(sorted(active), dtype=np.int64)


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


def build_context(model: BearingModel, element: str, frame: ContactFrame, oil: Oil) -> Context:
    """Return what the `prepare` of this force element's laws may look at."""
    g = model.geometry
    speed = max_speed(model)
    raceways = {"ball_inner": model.inner_material, "ball_outer": model.outer_material}
    partner = (raceways | {"ball_ball": model.ball_material}).get(element, model.cage_material)
    common = Context(
        element=element,
        ball_count=g.ball_count,
        ball_diameter=g.ball_diameter,
        pitch_diameter=g.pitch_diameter,
        bore_diameter=g.bore_diameter,
        outside_diameter=g.outside_diameter,
        width=g.width,
        series=g.series,
        speed=speed,
        mean_load=max(frame.mean_loads),
        ball=model.ball_material,
        partner=partner,
        oil=oil,
        pocket_clearance=model.cage.pocket_clearance,
        cage_width=model.cage.width,
        oil_level=model.oil_level,
    )
    if element in ("ball_inner", "ball_outer"):
        i = 0 if element == "ball_inner" else 1
        groove = (g.groove_radius_inner, g.groove_radius_outer)[i]
        rx, ry = ball_raceway_radii(g.ball_diameter, g.pitch_diameter, groove, frame.angles[i], inner=i == 0)
        return dataclasses.replace(
            common,
            mean_load=frame.mean_loads[i],
            contact_angle=frame.angles[i],
            groove_radius=groove,
            race_diameter=(g.race_diameter_inner, g.race_diameter_outer)[i],
            radius_x=rx,
            radius_y=ry,
            e_eff=effective_modulus(model.ball_material, partner),
        )
    if element in ("cage_inner", "cage_outer"):
        land = g.shoulder_diameter_inner if element == "cage_inner" else g.shoulder_diameter_outer
        ring = model.inner_material if element == "cage_inner" else model.outer_material
        return dataclasses.replace(common, land_clearance=model.cage.land_clearance, land_diameter=land, partner=ring)
    return common


def max_speed(model: BearingModel) -> float:
    """Return the largest planned spin of either ring [rad/s]; 0 when both are free and start at rest."""
    return max(peak(body.dofs["spin"].motion) for body in (model.inner_ring, model.outer_ring))


def guides(model: BearingModel) -> tuple[str, str, str]:
    """Return the force elements that take the solver's places of pocket, inner and outer land."""
    return ("ball_cage" if model.depth.cage else "ball_ball", "cage_inner", "cage_outer")


class Kernels:
    """Compiled kernels of a model's laws; pointers and code stay alive with this object."""

    def __init__(self, model: BearingModel, announce: Announce = None) -> None:
        self._laws = model.laws
        self._guides = guides(model)
        # one model in several force elements is compiled once
        known: dict[tuple[str, str], Any] = {}
        self.compiled: dict[tuple[str, str], Any] = {}
        self.tried: set[tuple[str, str, str, str]] = set()  # what check_laws has found in order
        for element, roles in model.laws.items():
            for role, law in roles.items():
                name = (role, law.model.name)
                if name not in known:
                    known[name] = compile_kernel(law.model, announce)
                self.compiled[element, role] = known[name]

    def keys(self) -> dict[str, str]:
        """Return "element/role/model" -> hash of everything the kernel reaches."""
        return {f"{e}/{r}/{self._laws[e][r].model.name}": k.key for (e, r), k in sorted(self.compiled.items())}

    def in_order(self, form: Literal["pointer", "dispatcher"]) -> L.Laws:
        """Return the laws in the solver's order: pointers for compiled code, dispatchers for Python."""

        def law(element: str, role: str) -> Any:
            return getattr(self.compiled[element, role], form)

        def raceway(element: str) -> L.RacewayLaws:
            return L.RacewayLaws(*(law(element, role) for role in L.RacewayLaws._fields))

        pocket, land_inner, land_outer = (law(element, "cage_contact") for element in self._guides)
        drag = law("fluid_drag", "fluid_drag")
        return L.Laws(raceway("ball_inner"), raceway("ball_outer"), pocket, land_inner, land_outer, drag)


def prepare(law: Law, context: Context) -> FloatArray:
    """Run a law's set-up; compiled code takes par[0] even of laws without parameters."""
    par = make_par(law.model, law.parameters, context)
    return par if par.size else np.zeros(1)


def check_laws(model: BearingModel, kernels: Kernels, frame: ContactFrame, oil: Oil) -> None:
    """Try every law out with the parameters of this run before any compiled code calls it.

    Kernels that serve many runs (a study) are tried once for each choice of parameters.

    Raises
    ------
    PluginError
        With the first law that does not keep the contract of its role.
    """
    for element, roles in model.laws.items():
        context = build_context(model, element, frame, oil)
        for role, law in roles.items():
            key = (element, role, law.model.name, law.parameters.model_dump_json())
            if key not in kernels.tried:
                check_choice(law.model, prepare(law, context), kernels.compiled[element, role])
                kernels.tried.add(key)


def prepare_all(model: BearingModel, frame: ContactFrame, oil: Oil) -> list[FloatArray]:
    """Return the parameters of every kernel, in the order of layout.par_of."""
    pars: list[FloatArray] = []
    for element in ("ball_inner", "ball_outer"):
        context = build_context(model, element, frame, oil)
        pars += [prepare(model.laws[element][role], context) for role in L.RacewayLaws._fields]
    for element in guides(model):
        pars.append(prepare(model.laws[element]["cage_contact"], build_context(model, element, frame, oil)))
    pars.append(prepare(model.laws["fluid_drag"]["fluid_drag"], build_context(model, "fluid_drag", frame, oil)))
    return pars


def derive_oil(model: BearingModel, kernels: Kernels, frame: ContactFrame) -> Oil:
    """Return the oil with viscosity, density, alpha_p and beta from the chosen rheology kernel.

    alpha_p is the tangent d ln(eta)/dp at p = 0, beta is -d ln(eta)/dT at the bulk temperature.
    """
    law = model.laws["ball_inner"]["rheology"]
    par = prepare(law, build_context(model, "ball_inner", frame, model.oil))
    check_choice(law.model, par, kernels.compiled["ball_inner", "rheology"])
    t, dp, dt = model.oil.temperature, 1e6, 0.5
    p = np.array([0.0, dp, 2.0 * dp, 0.0, 0.0])
    temperatures = np.array([t, t, t, t - dt, t + dt])
    ln_eta, rho = np.full(5, np.nan), np.full(5, np.nan)
    status = kernels.compiled["ball_inner", "rheology"].dispatcher(p, temperatures, par, ln_eta, rho)
    if status != 1 or not np.all(np.isfinite(ln_eta)) or not np.all(rho > 0.0):
        raise SolverError(f"{law.model.label}: no finite viscosity and density at {t:.2f} K (status {status})")
    alpha = (-3.0 * ln_eta[0] + 4.0 * ln_eta[1] - ln_eta[2]) / (2.0 * dp)
    beta = (ln_eta[3] - ln_eta[4]) / (2.0 * dt)
    return dataclasses.replace(
        model.oil, viscosity=math.exp(ln_eta[0]), density=float(rho[0]), alpha_p=float(alpha), beta=float(beta)
    )


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
        kernels.in_order("pointer"),
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
