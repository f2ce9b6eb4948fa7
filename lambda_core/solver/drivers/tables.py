"""The tables of bodies, rows of balls, raceways and lands that compiled code works on."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import BODIES, CAGE, DOFS, INNER, OUTER
from lambda_core.domain.hertz import ball_raceway_radii
from lambda_core.laws.context import Oil
from lambda_core.laws.par import number_in
from lambda_core.laws.state import names_behind
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.law_inputs import RACEWAYS, Oils, guides, links, oil_of, times
from lambda_core.solver.drivers.wave_tables import give_waves, wave_bodies, wave_rows
from lambda_core.system.bearing import BearingModel
from lambda_core.system.law_context import ContactFrame, build_context, effective_modulus, prepare
from lambda_core.system.raceways import raceways as raceways_of
from lambda_core.system.raceways import raceways_of_a_ball, row_places
from lambda_core.system.state_channels import states_of

# Below this mean surface velocity the rolling losses change sign smoothly: far below any running speed, wide
# enough for the integrator to cross when a bearing starts, stops or reverses.
ROLL_FLOOR = 1e-3  # [m/s]
# Slip below which the direction of shear fades out; small against creep at any running speed.
SLIP_FLOOR = 1e-6  # [m/s]
_MODES = {"free": R.FREE, "locked": R.LOCKED, "prescribed": R.PRESCRIBED}


class Tables(NamedTuple):
    """What a model and its laws are made of; see layout.Bundle."""

    system: Any
    bodies: Any
    rows: Any
    raceways: Any
    waves: Any
    lands: Any
    links: Any
    slots: Any
    par: FloatArray


class _Parameters:
    """Parameters of laws one after another."""

    def __init__(self, model: BearingModel, frame: ContactFrame, oils: Oils) -> None:
        self._model, self._frame, self._oils = model, frame, oils
        self._parts: list[FloatArray] = []

    def add(self, element: str, role: str) -> tuple[int, int]:
        """Append the parameters of a law; returns where they begin and end."""
        context = build_context(self._model, element, self._frame, oil_of(self._oils, element))
        begin = sum(part.size for part in self._parts)
        self._parts.append(prepare(self._model.laws[element][role], context))
        return begin, begin + self._parts[-1].size

    def all(self) -> FloatArray:
        """Return the parameters of all laws."""
        return np.concatenate(self._parts)


def running(powers: FloatArray) -> Any:
    """Return what stands behind the raceways' losses by name: powers or integrals (..., n) -> records.RUNNING."""
    return powers[..., -L.RUNNING_SIZE :].view(R.RUNNING)[..., 0]


def ball_mass(model: BearingModel) -> float:
    """Return the mass of one ball [kg]."""
    return model.ball_material.density * math.pi * model.geometry.ball_diameter**3 / 6.0


def build_tables(model: BearingModel, frame: ContactFrame, oils: Oils, terms: NDArray[np.void]) -> Tables:
    """Return the tables of one bearing: three bodies and those of elastic ones, its rows of balls and its raceways.

    Into `terms`, records.TERM, goes where the laws among them have their parameters.
    """
    parameters = _Parameters(model, frame, oils)
    raceways = _raceways(model, frame, oils, parameters)
    waves = wave_rows(model)
    rows, lands = _rows(model, oils[0], parameters), _lands(model, oils[0], parameters)
    for table, body in ((raceways, "body"), (rows, "cage"), (lands, "cage")):
        give_waves(table, body, waves)
    rows["drag"] = parameters.add("fluid_drag", "fluid_drag")
    between = _links(model, parameters)
    for i, element in enumerate(times(model)):
        terms["parameters"][(terms["kind"] == R.LAW) & (terms["law"] == i)] = parameters.add(element, "time_function")
    system = np.zeros(1, R.SYSTEM)
    s = system[0]
    s["balls"], s["gravity"] = model.geometry.balls, model.gravity
    s["roll_floor"], s["slip_floor"] = ROLL_FLOOR, SLIP_FLOOR
    s["surfaces"] = int(raceways["surface_on"].any() or np.ptp(raceways["waves"], axis=1).any())
    s["friction_on"], s["guides_on"], s["drag_azimuths"] = 1, 1, 1
    slots = _keep_states(model, raceways)
    bodies = np.concatenate([_bodies(model), wave_bodies(model)])
    return Tables(system, bodies, rows, raceways, waves, lands, between, slots, parameters.all())


def _bodies(model: BearingModel) -> Any:
    bodies = np.zeros(3, R.BODY)
    for record, body in zip(bodies, (model.inner_ring, model.outer_ring, model.cage_body), strict=True):
        for name in ("mass", "transverse_inertia", "polar_inertia", "unbalance"):
            record[name] = getattr(body, name)
        dofs = [body.dofs[name] for name in DOFS]
        record["mode"] = [_MODES[dof.mode] for dof in dofs]
        record["stiffness"], record["damping"] = [dof.stiffness for dof in dofs], [dof.damping for dof in dofs]
        record["moves"] = 1
    bodies[CAGE]["moves"], bodies[CAGE]["is_cage"] = int(model.depth.cage), 1
    return bodies


def _oil(record: Any, oil: Oil) -> None:
    """Write the constants of an oil."""
    record["temperature"], record["conductivity"] = oil.temperature, oil.thermal_conductivity
    record["viscosity"], record["density"] = oil.viscosity, oil.density
    record["alpha_p"], record["beta"] = oil.alpha_p, oil.beta


def _raceways(model: BearingModel, frame: ContactFrame, oils: Oils, parameters: _Parameters) -> Any:
    g, radius = model.geometry, 0.5 * model.geometry.ball_diameter
    grooves = raceways_of(g)
    raceways = np.zeros(len(grooves), R.RACEWAY)
    for i, (record, groove) in enumerate(zip(raceways, grooves, strict=True)):
        ring, element = groove.ring, groove.element
        rx, ry = ball_raceway_radii(
            g.ball_diameter, g.pitch_diameter, groove.groove_radius, frame.angles[ring], inner=ring == INNER
        )
        material = (model.inner_material, model.outer_material)[ring]
        record["number"], record["body"], record["laws"] = i, (INNER, OUTER)[ring], RACEWAYS.index(element)
        record["side"] = (-1.0, 1.0)[ring]
        record["groove_circle"], record["groove_radius"] = groove.groove_circle, groove.groove_radius
        record["axial_offset"], record["ball_radius"] = groove.axial_offset, radius
        record["radius_x"], record["radius_y"] = rx, ry
        record["modulus"] = effective_modulus(model.ball_material, material)
        record["radius_deformed"] = 2.0 * groove.groove_radius * radius / (groove.groove_radius + radius)
        record["roughness"] = model.roughness
        record["surface_on"] = int(model.laws[element]["surface"].model.name != "none")
        _oil(record["oil"], oils[ring])
        for role in R.RACEWAY_ROLES:
            record["parameters"][role] = parameters.add(element, role)
        begin, end = record["parameters"]["damping"]
        damping = model.laws[element]["damping"].model
        record["reach"] = number_in(damping, parameters.all()[begin:end], "reach", 0.0)
    return raceways


def _keep_states(model: BearingModel, raceways: Any) -> Any:
    """Give the states of contacts their places; returns where laws read them: behind their own parameters."""
    slots: list[tuple[int, int]] = []
    count, each = 0, model.geometry.ball_count
    for record, groove in zip(raceways, raceways_of(model.geometry), strict=True):
        kept = [state.name for state in states_of(model, groove.element)]
        begin = len(slots)
        for role in R.RACEWAY_ROLES:
            names, end = names_behind(model.laws[groove.element][role].model), int(record["parameters"][role][1])
            slots += [(kept.index(name), end - len(names) + i) for i, name in enumerate(names)]
        # compiled code counts the balls of all rows
        record["states"], record["slots"] = len(kept), (begin, len(slots))
        record["first_state"] = count - groove.row * each * len(kept)
        count += len(kept) * each
    return np.array(slots, R.SLOT)


def _rows(model: BearingModel, oil: Oil, parameters: _Parameters) -> Any:
    g, radius, mass = model.geometry, 0.5 * model.geometry.ball_diameter, ball_mass(model)
    rows, pocket = np.zeros(g.rows, R.ROW), parameters.add(guides(model)[0], "cage_contact")
    each = len(raceways_of_a_ball(g))
    for i, (record, place) in enumerate(zip(rows, row_places(g), strict=True)):
        record["number"], record["first_ball"], record["balls"] = i, i * g.ball_count, g.ball_count
        record["first_raceway"], record["raceways"] = i * each, each
        record["cage"], record["caged"] = CAGE, int(model.depth.cage)
        record["ball_radius"], record["ball_mass"], record["ball_inertia"] = radius, mass, 0.4 * mass * radius**2
        record["pocket_circle"], record["pocket_offset"] = 0.5 * g.pitch_diameter, place
        record["pocket_phase"] = i * math.pi / g.ball_count  # the rows' balls stand in turn
        record["drag_on"] = int(model.laws["fluid_drag"]["fluid_drag"].model.name != "none")
        _oil(record["oil"], oil)
        record["pocket"] = pocket
    return rows


def _lands(model: BearingModel, oil: Oil, parameters: _Parameters) -> Any:
    """Return two stations per ring that guides the cage."""
    stations = []
    for number, element in enumerate(guides(model)[1:]):
        span = parameters.add(element, "cage_contact")
        if not model.depth.cage or model.laws[element]["cage_contact"].model.name == "none":
            continue
        for side in (-1, 1):
            offset = side * (0.5 * model.cage.width)
            ring, facing = (INNER, OUTER)[number], (-1.0, 1.0)[number]
            stations.append((CAGE, ring, 0, number, 1 + number, offset, oil.viscosity, span, facing, (0, 0)))
    return np.array(stations, R.LAND)


def _links(model: BearingModel, parameters: _Parameters) -> Any:
    """Return the force elements between bodies."""
    found = np.zeros(len(model.links), R.LINK)
    for i, (record, element, link) in enumerate(zip(found, links(model), model.links.values(), strict=True)):
        record["number"] = record["law"] = i
        record["first"] = -1 if link.first is None else list(BODIES).index(link.first)
        record["second"] = list(BODIES).index(link.second)
        record["first_place"], record["second_place"] = link.first_place, link.second_place
        record["parameters"] = parameters.add(element, "force_element")
    return found
