"""Read numbers from an equilibrium or a run.

Each is computed in a worker process.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import LOSSES, RINGS
from lambda_core.formulas.loading import CARRYING
from lambda_core.model.bearing_model import BearingModel, Solver
from lambda_core.model.laws.time_functions import initial
from lambda_core.results.convergence import window
from lambda_core.results.reader import Result
from lambda_syla2026.stability import half_zone, stability

if TYPE_CHECKING:
    from lambda_core.solver.drivers.equilibrium import Equilibrium

Numbers = dict[str, float | None]

# Positions of the balls over half a pitch and their weights: under a radial load the other half mirrors it.
_PHASES = {0.0: 0.125, 0.125: 0.25, 0.25: 0.25, 0.375: 0.25, 0.5: 0.125}
# Beyond the published range too, only to say where a free fit would end.
TAU_GRID = (4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0)  # [MPa]
_COARSE_PHASES = {0.0: 0.25, 0.25: 0.5, 0.5: 0.25}
MECHANISMS = ("sliding", "spin", "boundary", "rolling", "hysteresis", "damping", "drag", "cage")
_OF_CAGE = {"pocket": "cage", "land": "cage"}


def _grouped(losses: Mapping[str, float]) -> dict[str, float]:
    """Return losses by mechanism, both rings together."""
    found = dict.fromkeys(MECHANISMS, 0.0)
    for name, value in losses.items():
        mechanism = _OF_CAGE.get(name, name.split("_")[0])
        if mechanism in found:
            found[mechanism] += value
    return found


def friction(model: BearingModel) -> Numbers:
    """Return the quasi-static friction torque [N mm].

    It is the mean over the positions of the balls, without a cage.
    """
    from lambda_core.analysis.thermal.temperatures import ready_model
    from lambda_core.solver.drivers.equilibrium import solve
    from lambda_core.studies.job import kernels_of

    model = ready_model(model)
    kernels = kernels_of(model)
    return _mean_friction(solve(model, kernels, phase=phase) for phase in _PHASES)


def friction_over_tau(model: BearingModel) -> Numbers:
    """Return torques of :func:`friction` over tau_e [N mm].

    Normal forces do not depend on the traction: each equilibrium is found next to that of the model's own tau_e.
    """
    from lambda_core.analysis.thermal.temperatures import ready_model
    from lambda_core.solver.drivers.equilibrium import solve
    from lambda_core.solver.drivers.near_equilibrium import solve_near
    from lambda_core.studies.job import kernels_of

    model = ready_model(model)
    kernels = kernels_of(model)
    own = [solve(model, kernels, phase=phase) for phase in _PHASES]
    found = Numbers()
    for tau in TAU_GRID:
        changed = _with_tau(model, tau)
        found[torque_at(tau)] = _mean_friction(solve_near(changed, near, kernels) for near in own)["torque"]
    return found


def torque_at(tau: float) -> str:
    """Return the name of the torque at a tau_e [MPa]."""
    return f"torque at {tau:g} MPa"


def _with_tau(model: BearingModel, tau: float) -> BearingModel:
    laws = {
        element: {
            role: replace(law, parameters=law.parameters.model_copy(update={"tau_eyring": 1e6 * tau}))
            if role == "traction"
            else law
            for role, law in roles.items()
        }
        for element, roles in model.laws.items()
    }
    return replace(model, laws=laws)


def _mean_friction(solved: Iterable[Equilibrium]) -> Numbers:
    """Return the mean over equilibria at _PHASES."""
    from lambda_core.solver.records import CONTACT_CHANNELS

    total = dict.fromkeys((*MECHANISMS, "torque", "max_load_N"), 0.0)
    for weight, found in zip(_PHASES.values(), solved, strict=True):
        losses = _grouped(dict(zip(LOSSES, (1e3 * found.losses / found.relative_speed).tolist(), strict=True)))
        load = found.contacts[:, RINGS.index("inner"), CONTACT_CHANNELS.index("load")]
        numbers = {**losses, "torque": sum(losses.values()), "max_load_N": float(load.max())}
        for name, value in numbers.items():
            total[name] += weight * value
    return {**total}


def skf(model: BearingModel) -> Numbers:
    """Return the friction torque of SKF's model [N mm].

    The rows of the method `skf` for the same case have these names.
    """
    from lambda_core.analysis.rating.compare_methods import comparison_inputs
    from lambda_core.discovery.api import registry
    from lambda_core.solver.drivers.equilibrium import solve
    from lambda_core.studies.job import kernels_of

    table = registry().method("skf").evaluate(comparison_inputs(solve(model, kernels_of(model))))
    return {row.name: row.value for row in table.rows if row.group == "friction"}


def anchor(model: BearingModel) -> Numbers:
    """Return friction torques without cage and drag [N mm].

    Return the means over the positions of the balls, and SKF's torque.
    """
    from lambda_core.analysis.rating.compare_methods import comparison_inputs
    from lambda_core.discovery.api import registry
    from lambda_core.solver.drivers.equilibrium import solve
    from lambda_core.studies.job import kernels_of

    kernels, total = kernels_of(model), dict.fromkeys(MECHANISMS, 0.0)
    for phase, weight in _COARSE_PHASES.items():
        found = solve(model, kernels, phase=phase)
        torque = 1e3 * found.losses / found.relative_speed
        for name, value in _grouped(dict(zip(LOSSES, torque.tolist(), strict=True))).items():
            total[name] += weight * value
    table = registry().method("skf").evaluate(comparison_inputs(found, stiffness=False))
    catalogue = {row.name: row.value for row in table.rows if row.group == "friction"}
    own = {name: value for name, value in total.items() if name not in ("cage", "drag")}
    parts = {f"skf {name}": catalogue[name] for name in ("rolling", "sliding")}
    return {**own, **parts, "torque": sum(own.values()), "skf": sum(parts.values())}


def axial_load(model: BearingModel) -> Numbers:
    """Return :func:`anchor` and the load-dependent torque of Schaeffler [N mm]."""
    from lambda_core.analysis.rating.compare_methods import comparison_inputs
    from lambda_core.discovery.api import registry
    from lambda_core.solver.drivers.equilibrium import solve
    from lambda_core.studies.job import kernels_of

    inputs = comparison_inputs(solve(model, kernels_of(model)), stiffness=False)
    rows = registry().method("schaeffler").evaluate(inputs).rows
    load = next(row.value for row in rows if row.group == "friction" and row.name == "load dependent")
    return {**anchor(model), "schaeffler load": load}


def rated(model: BearingModel) -> Numbers:
    """Return the losses and the rated heat [W].

    The loss of the equilibrium, SKF's, and the heat that ISO 15312 lets the bearing emit.
    """
    from lambda_core.analysis.rating.compare_methods import comparison_inputs
    from lambda_core.analysis.thermal import iso15312
    from lambda_core.discovery.api import registry
    from lambda_core.solver.drivers.equilibrium import solve
    from lambda_core.studies.job import kernels_of

    found, g = solve(model, kernels_of(model)), model.geometry
    losses = dict(zip(LOSSES, found.losses.tolist(), strict=True))
    table = registry().method("skf").evaluate(comparison_inputs(found, stiffness=False))
    skf = {row.name: 1e-3 * found.relative_speed * row.value for row in table.rows if row.group == "friction"}
    area = iso15312.reference_area(g.bore_diameter, g.outside_diameter, g.width)
    return {
        "contacts": sum(losses.values()) - losses["drag"],
        "drag": losses["drag"],
        "skf": skf["rolling"] + skf["sliding"],
        "skf drag": skf["drag"],
        "heat": iso15312.heat_flow_density(area) * area,
    }


def capacitance(model: BearingModel) -> Numbers:
    """Return the contacts and the analytical capacitance.

    Contacts of the quasi-static solution, means over the loaded balls.
    """
    from lambda_core.analysis.rating.compare_methods import comparison_inputs
    from lambda_core.discovery.api import registry
    from lambda_core.solver.drivers.equilibrium import solve
    from lambda_core.solver.records import CONTACT_CHANNELS
    from lambda_core.studies.job import kernels_of

    found = solve(model, kernels_of(model))
    channels = {name: found.contacts[:, :, i] for i, name in enumerate(CONTACT_CHANNELS)}
    numbers = contact_numbers({name: values[None] for name, values in channels.items()}, CARRYING)
    table = registry().method("analytical-capacitance").evaluate(comparison_inputs(found))
    numbers.update({f"analytical {row.name}": row.value for row in table.rows})
    return numbers


def contact_numbers(channels: Mapping[str, FloatArray], carrying: float) -> Numbers:
    """Return contact means and the bearing's capacitance.

    The means are over the loaded contacts of each ring.

    Parameters
    ----------
    channels : mapping of float64[:, :, :], shape (time, ball, ring)
        Contact channels, SI.
    carrying : float
        Share of the largest load from which a contact counts.
    """
    load, found = channels["load"], Numbers()
    area = math.pi * channels["semi_axis_a"] * channels["semi_axis_b"]
    wanted = {
        "load_N": load,
        "contact_angle_deg": np.degrees(channels["contact_angle"]),
        "area_mm2": 1e6 * area,
        "film_um": 1e6 * channels["film_central"],
        "hertz_pF": 1e12 * channels["capacitance_hertz"],
        "contact_pF": 1e12 * channels["capacitance"],
    }
    for i, ring in enumerate(RINGS):
        under = load[:, :, i] > carrying * load[:, :, i].max()
        for name, values in wanted.items():
            found[f"{ring} {name}"] = float(values[:, :, i][under].mean())
        found[f"{ring} k_c"] = float((channels["capacitance"] / channels["capacitance_hertz"])[:, :, i][under].mean())
    with np.errstate(divide="ignore"):
        series = 1.0 / (1.0 / channels["capacitance"]).sum(axis=2)
    found["bearing_pF"] = 1e12 * float(series.sum(axis=1).mean())
    return found


def axial_resonance(model: BearingModel) -> Numbers:
    """Return axial stiffness and natural frequency [Hz].

    The stiffness holds about the equilibrium; the frequency is that of the inner ring with its shaft.

    Of the bearing under its static load; where the rings share their axial motion it is the frequency that the
    inner ring would have. It also returns those of bodies that only centrifugal force holds axially, in the
    outer groove: a ball that rolls across it (mass 7/5 m, as for any solid sphere), and the cage on all
    unloaded balls, without play.
    """
    from lambda_core.solver.drivers.equilibrium import solve
    from lambda_core.solver.drivers.stiffness import stiffness_matrix
    from lambda_core.studies.job import kernels_of

    found = solve(model, kernels_of(model))
    stiffness = stiffness_matrix(found)[0][0]
    speed = initial(model.inner_ring.dofs["spin"].motion)
    ball, cage = _held_by_centrifugal_force(found)
    return {
        "ball_Hz": ball,
        "cage_Hz": cage,
        "stiffness_N_per_um": 1e-6 * stiffness,
        "resonance_Hz": math.sqrt(stiffness / model.inner_ring.mass) / (2.0 * math.pi),
        "mass_kg": model.inner_ring.mass,
        "orbit_Hz": abs(found.orbit) / (2.0 * math.pi),
        "speed_rpm": speed * 30.0 / math.pi,
    }


def _held_by_centrifugal_force(found: Equilibrium) -> tuple[float, float]:
    """Return the axial natural frequencies of loose parts [Hz].

    Centrifugal force holds these parts: an unloaded ball, and the cage on all unloaded balls.
    """
    model = found.context.model
    geometry, cage = model.geometry, model.cage_body
    mass = model.ball_material.density * math.pi / 6.0 * geometry.ball_diameter**3
    force = mass * 0.5 * geometry.pitch_diameter * found.orbit**2
    stiffness = force / (geometry.groove_radius_outer - 0.5 * geometry.ball_diameter)
    shift = math.hypot(found.displacement[1], found.displacement[2])
    unloaded = geometry.ball_count * (1.0 - half_zone(shift, geometry.clearance) / math.pi)
    rolling = 1.4 * mass
    of_cage = unloaded * stiffness / (cage.mass + unloaded * rolling)
    return math.sqrt(stiffness / rolling) / (2.0 * math.pi), math.sqrt(of_cage) / (2.0 * math.pi)


def torque(result: Result) -> Numbers:
    """Return averages of a run.

    Torque and parts [N mm], load of the most loaded ball, and measures of their accuracy.
    """
    summary = result.summary()
    parts = _grouped({name: value or 0.0 for name, value in summary.friction_breakdown_Nmm.items()})
    largest = np.concatenate(
        [block["load"][:, :, 0].max(axis=1) for block in result.blocks(("load",), _averages_start(result))]
    )
    return {
        **parts,
        "torque": summary.friction_torque_Nmm,
        "ci": summary.friction_torque_ci_Nmm,
        "max_load_N": float(largest.mean()),
        "cage_over_epicyclic": summary.cage_speed_over_epicyclic,
        "energy_residual": summary.energy_residual,
        "converged": float(summary.converged),
        "simulated_s": summary.simulated_s,
        "wall_s": summary.wall_s,
    }


def _averages_start(result: Result) -> float:
    """Return when the averaging window begins [s]."""
    settings = Solver(**{name: float(value) for name, value in result.model["solver"].items()})
    return float(window(settings, result.revolutions(), result.integrals()[-1]).interval.first[0])


def contacts(result: Result) -> Numbers:
    """Return mean contacts of a run.

    They are means over time and loaded balls, for comparison with the quasi-static ones.
    """
    names = ("load", "contact_angle", "semi_axis_a", "semi_axis_b", "film_central", "capacitance_hertz", "capacitance")
    blocks = list(result.blocks(names, _averages_start(result)))
    return contact_numbers({name: np.concatenate([block[name] for block in blocks]) for name in names}, CARRYING)


STATIC: Mapping[str, Callable[[BearingModel], Numbers]] = {
    "friction": friction,
    "friction over tau_e": friction_over_tau,
    "skf": skf,
    "anchor": anchor,
    "axial load": axial_load,
    "rated": rated,
    "capacitance": capacitance,
    "axial resonance": axial_resonance,
}
DYNAMIC: Mapping[str, Callable[[Result], Numbers]] = {"torque": torque, "contacts": contacts, "stability": stability}
