"""Convert model and equilibrium to inputs of comparison methods."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import DOFS
from lambda_core.domain.errors import SolverError
from lambda_core.laws.context import Oil
from lambda_core.laws.law import Law
from lambda_core.laws.par import flat_kernel
from lambda_core.model.bearing_model import BearingModel, Body
from lambda_core.model.laws.time_functions import initial
from lambda_core.views.method import EquilibriumState, MethodInputs


def carried_load(state: EquilibriumState) -> tuple[float, float]:
    """Return the load [N] that the balls carry.

    The radial and axial loads at the inner ring are the sum of the balls' contact forces.
    """
    axial, horizontal, vertical = _carried(state)
    return math.hypot(horizontal, vertical), abs(axial)


def _carried(state: EquilibriumState) -> tuple[float, float, float]:
    """Return the sum of the contact forces [N].

    Its components are along x, y and z.
    """
    axial = sum(contact.load_inner * math.sin(contact.angle_inner) for contact in state.contacts)
    inward = [(contact.load_inner * math.cos(contact.angle_inner), contact.azimuth) for contact in state.contacts]
    horizontal = sum(force * math.cos(azimuth) for force, azimuth in inward)
    vertical = sum(force * math.sin(azimuth) for force, azimuth in inward)
    return axial, horizontal, vertical


def bearing_load(model: BearingModel, state: EquilibriumState) -> tuple[float, float]:
    """Return the load of the bearing [N].

    Its radial and axial parts are the applied load where the ring is free, and the carried load where it is held.

    Along a free axis without support that is force and weight, exactly; contact forces alone leave out the friction
    and the gyroscopic moments of the balls, which hold a part of it.
    """
    body, carried = model.inner_ring, _carried(state)
    load = []
    for axis, force in enumerate(body.force):
        dof = body.dofs[DOFS[axis]]
        free = dof.mode == "free" and dof.stiffness == 0.0
        load.append(initial(force) + body.mass * model.gravity[axis] if free else carried[axis])
    return math.hypot(load[1], load[2]), abs(load[0])


def permittivity_over_pressure(
    permittivity: Law, permittivity_par: FloatArray, rheology: Law, rheology_par: FloatArray, temperature: float
) -> Callable[[float], float]:
    """Return the relative permittivity over pressure [Pa].

    It holds at `temperature` [K] and comes from the chosen laws in plain Python.

    Parameters
    ----------
    permittivity_par, rheology_par : float64[:]
        What :func:`lambda_core.laws.par.make_par` made for each.
    """

    viscosity_law, permittivity_law = flat_kernel(rheology), flat_kernel(permittivity)

    def value(pressure: float) -> float:
        p, t = np.array([pressure]), np.array([temperature])
        ln_eta, rho, eps_r = np.empty(1), np.empty(1), np.empty(1)
        for model, status in (
            (rheology, viscosity_law(p, t, rheology_par, ln_eta, rho)),
            (permittivity, permittivity_law(p, t, rho, permittivity_par, eps_r)),
        ):
            if status != 1:
                sentence = model.errors.get(status, f"status {status}")
                raise SolverError(f"{model.role} {model.name} at {pressure:g} Pa, {temperature:.2f} K: {sentence}")
        return float(eps_r[0])

    return value


def _applied_load(body: Body) -> tuple[float, float]:
    axial, horizontal, vertical = (initial(force) for force in body.force)
    return math.hypot(horizontal, vertical), abs(axial)


def method_inputs(
    model: BearingModel,
    oil: Oil,
    *,
    state: EquilibriumState | None = None,
    permittivity: Callable[[float], float] | None = None,
    contamination: float | None = None,
) -> MethodInputs:
    """Collect what methods may look at.

    Parameters
    ----------
    oil : Oil
        The model's oil with viscosity, density, alpha_p and beta filled in by the chosen rheology.
    state : EquilibriumState, optional
        The quasi-static solution. With it the loads are those of :func:`bearing_load`, weight and prescribed motion
        included; without it those applied to the inner ring at the start.
    permittivity : callable, optional
        Relative permittivity of the oil over pressure [Pa] at the bulk temperature.
    contamination : float, optional
        e_C of ISO 281.
    """
    radial, axial = bearing_load(model, state) if state is not None else _applied_load(model.inner_ring)
    geometry = model.geometry
    known = {value.path: value.value for value in model.values if isinstance(value.value, float)}
    drag = model.laws.get("fluid_drag", {}).get("fluid_drag")
    drag_parameters = drag.parameters if drag is not None and drag.model.name == "skf-catalogue" else None
    return MethodInputs(
        title=model.title,
        series=geometry.series,
        bore_diameter=geometry.bore_diameter,
        outside_diameter=geometry.outside_diameter,
        width=geometry.width,
        ball_count=geometry.ball_count,
        ball_diameter=geometry.ball_diameter,
        pitch_diameter=geometry.pitch_diameter,
        groove_radius_inner=geometry.groove_radius_inner,
        groove_radius_outer=geometry.groove_radius_outer,
        ball=model.ball_material,
        inner_ring=model.inner_material,
        outer_ring=model.outer_material,
        oil=oil,
        radial_load=radial,
        axial_load=axial,
        inner_speed=initial(model.inner_ring.dofs["spin"].motion),
        outer_speed=initial(model.outer_ring.dofs["spin"].motion),
        dynamic_rating=known.get("bearing.dynamic_rating"),
        static_rating=known.get("bearing.static_rating"),
        fatigue_limit=known.get("bearing.fatigue_limit"),
        contamination=contamination,
        lubrication=model.lubrication,
        oil_level=0.0 if model.lubrication == "oil jet" else model.oil_level,  # SKF: of a jet, half the lowest ball
        drag_volume_factor=getattr(drag_parameters, "v_m", None),
        drag_edition=getattr(drag_parameters, "edition", "2018"),
        permittivity=permittivity,
        state=state,
        designation=next((str(v.value) for v in model.values if v.path == "bearing.designation"), ""),
        shoulder_diameter_inner=geometry.shoulder_diameter_inner,
        contact_angle=geometry.contact_angle,
        rated_rows=geometry.rated_rows,
        on_sphere=geometry.kind.on_sphere,
    )
