"""Write an assembly as tables of compiled code.

Every bearing appends its entries at their final place. Bodies are the members, then the waves of elastic parts, bearing
by bearing.
"""

from __future__ import annotations

import itertools
import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import CAGE, DOFS, INNER, OUTER
from lambda_core.domain.errors import SolverError
from lambda_core.elements.ball.raceways import raceways as raceways_of
from lambda_core.elements.ball.raceways import raceways_of_a_ball, row_places
from lambda_core.formulas.hertz import ball_raceway_radii
from lambda_core.laws.context import Context, Oil
from lambda_core.laws.par import number_in
from lambda_core.laws.state import names_behind
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.law_context import build_context, effective_modulus
from lambda_core.model.laws.state_channels import states_of
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.assembly import AssembledBearing, Assembly, BearingSpan
from lambda_core.solver.drivers.law_inputs import contacts_of, guides, oil_of, times
from lambda_core.solver.drivers.roller_tables import states_of_an_element, write_line, write_rib, write_row
from lambda_core.solver.drivers.row_cages import cages_in, further_cages
from lambda_core.solver.drivers.time_tables import build_times
from lambda_core.solver.drivers.wave_tables import give_waves, wave_bodies, wave_rows

# Below this mean surface velocity the rolling losses change sign smoothly: far below any running speed, wide
# enough for the integrator to cross when a bearing starts, stops or reverses.
ROLL_FLOOR = 1e-3  # [m/s]
# Slip below which the direction of shear fades out; small against creep at any running speed.
SLIP_FLOOR = 1e-6  # [m/s]
# State that each direction of a member moves, and its sign: turning about +y moves a_z towards -.
STATES = np.array([L.SX, L.SY, L.SZ, L.STHETA, L.SAZ, L.SAY])
SIGNS = np.array([1.0, 1.0, 1.0, 1.0, -1.0, 1.0])
_MODES = {"free": R.FREE, "locked": R.LOCKED, "prescribed": R.PRESCRIBED}
# State and rate of each degree of freedom, in the order of DOFS.
_POSITIONS = (L.SX, L.SY, L.SZ, L.SAZ, L.SAY, L.STHETA)
_RATES = (L.SVX, L.SVY, L.SVZ, L.SWY, L.SWZ, L.SSIGMA)
_SPIN = len(DOFS) - 1


class Tables(NamedTuple):
    """Tables of an assembly and its laws.

    See layout.Bundle.
    """

    system: Any
    bodies: Any
    rows: Any
    raceways: Any
    waves: Any
    lands: Any
    links: Any
    slots: Any
    par: FloatArray
    tied: NDArray[np.int64]
    tie_stiffness: FloatArray
    tie_damping: FloatArray
    tie_rest: FloatArray
    terms: NDArray[np.void]
    table: FloatArray
    active: NDArray[np.int64]
    laws: L.Laws


class _Parameters:
    """Parameters of laws one after another."""

    def __init__(self) -> None:
        self._parts: list[FloatArray] = []
        self._size = 0
        self._contexts: dict[tuple[str, str], Context] = {}  # by bearing and force element
        self._made: dict[tuple[str, str, str], FloatArray] = {}  # by bearing, force element and role

    def add(self, bearing: AssembledBearing, element: str, role: str) -> tuple[int, int]:
        """Append the parameters of a law.

        Return where they begin and end.
        """
        place, begin = (bearing.name, element), self._size
        if place not in self._contexts:
            oil = oil_of(bearing.oils, element)
            self._contexts[place] = build_context(bearing.model, element, bearing.frame, oil)
        if (*place, role) not in self._made:  # raceways of several rows have the same
            self._made[*place, role] = bearing.kernels.parameters(bearing.model, element, role, self._contexts[place])
        self._parts.append(self._made[*place, role])
        self._size += self._parts[-1].size
        return begin, self._size

    def last(self) -> FloatArray:
        """Return what was added last."""
        return self._parts[-1]

    def all(self) -> FloatArray:
        """Return the parameters of all laws."""
        return np.concatenate(self._parts)


class _Part(NamedTuple):
    """Tables of one bearing."""

    raceways: Any
    rows: Any
    lands: Any
    links: Any
    waves: Any
    slots: Any


class _Offsets(NamedTuple):
    """Law and slot counts of earlier bearings.

    It counts sets of laws, and slots.
    """

    raceways: int = 0
    guides: int = 0
    drag: int = 0
    links: int = 0
    times: int = 0
    slots: int = 0
    waves: int = 0


def plain(table: Any) -> Any:
    """Return a view of records without attributes.

    Python writes and reads their fields twenty times as fast.
    """
    return table.view(np.dtype((np.void, table.dtype)))


def running(powers: FloatArray) -> Any:
    """Return the powers behind the raceways' losses.

    The keys are names; the powers or integrals (..., n) give records.RUNNING.
    """
    return powers[..., -L.RUNNING_SIZE :].view(R.RUNNING)[..., 0]


def ball_mass(model: BearingModel) -> float:
    """Return the mass of one element [kg].

    The element is a ball or a roller.
    """
    if model.rollers is not None:
        return model.rollers.mass
    return model.ball_material.density * math.pi * model.geometry.ball_diameter**3 / 6.0


def build(assembly: Assembly) -> Tables:
    """Return the tables of an assembly.

    Raises
    ------
    SolverError
        When its bearings divide their contacts into different cells, of which compiled code has one grid.
    """
    _refuse_other_grids(assembly)
    parameters, parts, laws = _Parameters(), [], []
    terms, table = build_times(assembly)
    offsets = _Offsets()
    for i, (bearing, span) in enumerate(zip(assembly.bearings, assembly.spans(), strict=True)):
        parts.append(_part(assembly, i, span, offsets, parameters))
        for k, element in enumerate(times(bearing.model)):
            own = (terms["kind"] == R.LAW) & (terms["law"] == offsets.times + k)
            terms["parameters"][own] = parameters.add(bearing, element, "time_function")
        laws.append(bearing.kernels.pointers())
        counts = [*map(len, laws[-1]), parts[-1].slots.size, parts[-1].waves.size]
        offsets = _Offsets(*(before + own for before, own in zip(offsets, counts, strict=True)))
    raceways, rows, lands, links, waves, slots = (np.concatenate(of_kind) for of_kind in zip(*parts, strict=True))
    bodies = _bodies(assembly)
    tied, stiffness, damping, rest = _ties(assembly)
    return Tables(
        _system(assembly, raceways), bodies, rows, raceways, waves, lands, links, slots, parameters.all(), tied,
        stiffness, damping, rest, terms, table, _active(bodies),
        L.Laws(*(np.ascontiguousarray(np.concatenate(of_role)) for of_role in zip(*laws, strict=True))),
    )  # fmt: skip


def _refuse_other_grids(assembly: Assembly) -> None:
    """Refuse bearings with another contact grid.

    It differs from that of the first.
    """
    first = assembly.bearings[0]
    for other in assembly.bearings[1:]:
        one, two = first.model.depth, other.model.depth
        if (one.strips, one.rows) != (two.strips, two.rows):
            raise SolverError(
                f"{first.name} divides a contact into {one.strips} x {one.rows} cells, {other.name} into "
                f"{two.strips} x {two.rows}: give all bearings of a machine the same depth.strips and depth.rows"
            )


def _part(assembly: Assembly, i: int, span: BearingSpan, offsets: _Offsets, parameters: _Parameters) -> _Part:
    """Return the entries of bearing `i`.

    Parameters of its laws are in the order in which these are added.
    """
    bearing = assembly.bearings[i]
    raceways = _raceways(bearing, span, offsets, parameters)
    waves = wave_rows(bearing.model, span.bodies)
    rows = _rows(bearing, i, span, offsets, parameters)
    lands = _lands(bearing, i, span, offsets, parameters)
    for table, body in ((raceways, "body"), (rows, "cage"), (lands, "cage")):
        give_waves(table, body, waves, offsets.waves)
    rows["drag"] = parameters.add(bearing, "fluid_drag", "fluid_drag")
    links = _links(assembly, i, offsets, parameters)
    slots = _keep_states(bearing.model, raceways, span, offsets.slots)
    return _Part(raceways, rows, lands, links, waves, slots)


def _system(assembly: Assembly, raceways: Any) -> Any:
    system = np.zeros(1, R.SYSTEM)
    s = plain(system)[0]
    s["balls"] = sum(bearing.model.geometry.balls for bearing in assembly.bearings)
    s["tail"] = assembly.spans()[-1].end
    s["gravity"] = assembly.gravity
    s["roll_floor"], s["slip_floor"] = ROLL_FLOOR, SLIP_FLOOR
    s["surfaces"] = int(raceways["surface_on"].any() or np.ptp(raceways["waves"], axis=1).any())
    s["friction_on"], s["guides_on"], s["drag_azimuths"] = 1, 1, 1
    return system


def _bodies(assembly: Assembly) -> Any:
    bodies = np.zeros(len(assembly.members), R.BODY)
    for record, member in zip(plain(bodies), assembly.members, strict=True):
        body = member.body
        for name in ("mass", "transverse_inertia", "polar_inertia", "unbalance"):
            record[name] = getattr(body, name)
        dofs = [body.dofs[name] for name in DOFS]
        record["mode"] = [_MODES[dof.mode] for dof in dofs]
        record["stiffness"], record["damping"] = [dof.stiffness for dof in dofs], [dof.damping for dof in dofs]
        record["moves"], record["bearing"] = 1, -1
    found = [bodies]
    for i, bearing in enumerate(assembly.bearings):
        cage, waves = plain(bodies)[bearing.members[CAGE]], wave_bodies(bearing.model)
        cage["moves"], cage["is_cage"] = int(bearing.model.depth.cage), 1
        if bearing.model.cage.per_row and cage["mode"][0] == R.LOCKED:
            cage["mode"][0] = R.PRESCRIBED  # at the place of its row: what is locked is at 0
        bodies["bearing"][list(bearing.members)] = waves["bearing"] = i
        found += [bodies[bearing.members[CAGE:]].repeat(further_cages(bearing.model)), waves]
    return np.concatenate(found)


def _active(bodies: Any) -> NDArray[np.int64]:
    """Return the free entries of shared state.

    The angles of prescribed spins are among them.
    """
    found: list[int] = []
    for b, body in enumerate(plain(bodies)):
        if not body["moves"]:
            continue
        for mode, position, rate in zip(body["mode"], _POSITIONS, _RATES, strict=True):
            if mode == R.FREE:
                found += [L.NS * b + position, L.NS * b + rate]
        if body["mode"][_SPIN] == R.PRESCRIBED:
            found.append(L.NS * b + L.STHETA)
    return np.array(sorted(found), dtype=np.int64)


def _ties(assembly: Assembly) -> tuple[NDArray[np.int64], FloatArray, FloatArray, FloatArray]:
    """Return the ties of the shared state.

    They have the tied entries, stiffness and damping between them, and their rest.
    """
    ties = assembly.ties
    used = np.flatnonzero(np.abs(ties.stiffness).sum(axis=1) + np.abs(ties.damping).sum(axis=1))
    tied, signs = L.NS * ties.member + STATES[ties.direction], SIGNS[ties.direction]
    around = np.outer(signs, signs)
    stiffness, damping = ((matrix * around)[np.ix_(used, used)] for matrix in (ties.stiffness, ties.damping))
    if not damping.any():
        damping = np.zeros((0, 0))
    return tied[used], np.ascontiguousarray(stiffness), np.ascontiguousarray(damping), (ties.rest * signs)[used]


def _oil(record: Any, oil: Oil) -> None:
    """Write the constants of an oil."""
    record["temperature"], record["conductivity"] = oil.temperature, oil.thermal_conductivity
    record["viscosity"], record["density"] = oil.viscosity, oil.density
    record["alpha_p"], record["beta"] = oil.alpha_p, oil.beta


def _raceways(bearing: AssembledBearing, span: BearingSpan, offsets: _Offsets, parameters: _Parameters) -> Any:
    model, frame = bearing.model, bearing.frame
    g, radius = model.geometry, 0.5 * model.geometry.ball_diameter
    grooves = raceways_of(g)
    raceways = np.zeros(len(grooves), R.RACEWAY)
    for i, (record, groove) in enumerate(zip(plain(raceways), grooves, strict=True)):
        ring, element = groove.ring, groove.element
        rx, ry = ball_raceway_radii(
            g.ball_diameter, g.pitch_diameter, groove.groove_radius, frame.angles[ring], inner=ring == INNER
        )
        material = (model.inner_material, model.outer_material)[ring]
        record["number"], record["body"] = span.first_raceway + i, span.bodies[(INNER, OUTER)[ring]]
        record["laws"] = offsets.raceways + contacts_of(model).index(element)  # a set for all that are alike
        record["side"] = (-1.0, 1.0)[ring]
        record["groove_circle"], record["groove_radius"] = groove.groove_circle, groove.groove_radius
        record["axial_offset"], record["ball_radius"] = groove.axial_offset, radius
        record["radius_x"], record["radius_y"] = rx, ry
        record["modulus"] = effective_modulus(model.ball_material, material)
        record["radius_deformed"] = 2.0 * groove.groove_radius * radius / (groove.groove_radius + radius)
        record["roughness"] = model.roughness
        if model.rollers is not None and groove.end:
            write_rib(record, model.rollers, ring, groove.end)
        elif model.rollers is not None:
            write_line(record, model.rollers, ring, span.first_line + i)
        record["surface_on"] = int(model.laws[element]["surface"].model.name != "none")
        _oil(record["oil"], bearing.oils[ring])
        damping = model.laws[element]["damping"].model
        for role in R.RACEWAY_ROLES:
            record["parameters"][role] = parameters.add(bearing, element, role)
            if role == "damping":
                record["reach"] = number_in(damping, parameters.last(), "reach", 0.0)
    return raceways


def _keep_states(model: BearingModel, raceways: Any, span: BearingSpan, before: int) -> Any:
    """Give the states of contacts their places.

    Return where laws read them: behind their own parameters.

    Parameters
    ----------
    before : int
        Slots of the bearings before.
    """
    slots: list[tuple[int, int, float, float]] = []
    count, each = span.first_state, model.geometry.ball_count
    for record, groove in zip(plain(raceways), raceways_of(model.geometry), strict=True):
        states = states_of(model, groove.element)
        kept = [state.name for state in states]
        begin = len(slots)
        for role in R.RACEWAY_ROLES:
            names, end = names_behind(model.laws[groove.element][role].model), int(record["parameters"][role][1])
            for i, name in enumerate(names):
                state = states[kept.index(name)]
                slots.append((kept.index(name), end - len(names) + i, state.lower, state.upper))
        # compiled code counts the balls of all rows
        record["states"], record["slots"] = len(kept), (before + begin, before + len(slots))
        record["first_state"] = count - (span.first_ball + groove.row * each) * len(kept)
        count += len(kept) * each
    return np.array(slots, R.SLOT)


def _rows(bearing: AssembledBearing, number: int, span: BearingSpan, offsets: _Offsets, parameters: _Parameters) -> Any:
    model = bearing.model
    g, radius, mass = model.geometry, 0.5 * model.geometry.ball_diameter, ball_mass(model)
    rows, pocket = np.zeros(g.rows, R.ROW), parameters.add(bearing, guides(model)[0], "cage_contact")
    each, size = len(raceways_of_a_ball(g)), states_of_an_element(model)
    cages = cages_in(span.bodies, model)
    for i, (record, place) in enumerate(zip(plain(rows), row_places(g), strict=True)):
        record["number"], record["bearing"] = span.first_row + i, number
        record["first_ball"], record["balls"] = span.first_ball + i * g.ball_count, g.ball_count
        record["first_state"], record["size"] = span.begin + i * size * g.ball_count, size
        record["first_raceway"], record["raceways"] = span.first_raceway + i * each, each
        record["cage"], record["caged"] = cages[i % len(cages)], int(model.depth.cage)
        record["ball_radius"], record["ball_mass"], record["ball_inertia"] = radius, mass, 0.4 * mass * radius**2
        if model.rollers is not None:
            write_row(record, model.rollers, model.cage)
        record["pocket_circle"] = 0.5 * g.pitch_diameter
        if len(cages) == 1:
            record["pocket_offset"], record["pocket_phase"] = place, i * math.pi / g.ball_count  # balls stand in turn
        record["drag_on"] = int(model.laws["fluid_drag"]["fluid_drag"].model.name != "none")
        record["guide_law"], record["drag_law"] = offsets.guides, offsets.drag
        _oil(record["oil"], bearing.oils[0])
        record["pocket"] = pocket
    return rows


def _lands(
    bearing: AssembledBearing, number: int, span: BearingSpan, offsets: _Offsets, parameters: _Parameters
) -> Any:
    """Return two stations per cage and ring that guides it."""
    model, stations = bearing.model, []
    for ring, element in enumerate(guides(model)[1:]):
        place = parameters.add(bearing, element, "cage_contact")
        if not model.depth.cage or model.laws[element]["cage_contact"].model.name == "none":
            continue
        cages = enumerate(cages_in(span.bodies, model))
        for (row, cage), side in itertools.product(cages, (-1, 1)):
            offset = side * (0.5 * model.cage.width)
            body, facing = span.bodies[(INNER, OUTER)[ring]], (-1.0, 1.0)[ring]
            law, viscosity = offsets.guides + 1 + ring, bearing.oils[0].viscosity
            pair = land_number(number, ring)
            stations.append((cage, body, span.first_row + row, pair, law, offset, viscosity, place, facing, (0, 0)))
    return np.array(stations, R.LAND)


def land_number(bearing: int, ring: int) -> int:
    """Return the number of a land.

    Both stations of the land have it.
    """
    return 2 * bearing + ring


def bearing_of_land(number: int) -> tuple[int, int]:
    """Return bearing and ring of what :func:`land_number` returned."""
    return divmod(number, 2)


def _links(assembly: Assembly, number: int, offsets: _Offsets, parameters: _Parameters) -> Any:
    """Return the force elements between members.

    Their laws are those of a bearing.
    """
    own = [(i, link) for i, link in enumerate(assembly.links) if link.bearing == number]
    found = np.zeros(len(own), R.LINK)
    for k, (record, (i, link)) in enumerate(zip(plain(found), own, strict=True)):
        record["number"], record["law"] = i, offsets.links + k
        record["first"], record["second"] = link.first, link.second
        record["first_place"], record["second_place"] = link.first_place, link.second_place
        record["apart"] = link.apart
        record["parameters"] = parameters.add(assembly.bearings[number], link.element, "force_element")
    return found
