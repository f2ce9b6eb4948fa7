"""Write common lines of pages, and an equilibrium's page."""

from __future__ import annotations

import textwrap
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from lambda_core.domain.number_text import counted, hours, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.domain.wrapping import HEAD, lines_under, wrapped
from lambda_core.results.band_text import band_text, ends, source_lines, temperature_text
from lambda_core.results.quantity import Quantity, quantities, quantity_of, remaining, shown, shown_numbers

if TYPE_CHECKING:
    from lambda_core.results.bearing_summary import Contact
    from lambda_core.results.limits import Shoulder
    from lambda_core.results.model_band import ModelBand
    from lambda_core.results.quasistatic import QuasiStatic, RollerLoad, RollerStatics
    from lambda_core.results.rating import Rating
    from lambda_core.results.record import Record
    from lambda_core.results.ring_shape import RingShape
    from lambda_core.results.verdict import Verdict

_PER_RING = ("sliding", "spin", "rolling", "hysteresis", "boundary", "damping")
_REST = ("rib", "cage", "drag", "bending")
# Numbers that texts and reports place by hand; every other declared number with a column follows them.
PLACED = frozenset({
    "bearing_capacitance_nF", "cage_speed_over_epicyclic", "cage_speed_ratio", "contact_capacitance_pF",
    "drive_torque_Nm", "energy_residual", "film_parameter", "film_um", "friction_torque_Nmm",
    "inner_ring_displacement_um", "inner_ring_tilt_mrad", "loaded_elements", "max_load_N", "max_pressure_GPa",
    "min_film_um", "power_loss_W", "second_cage_speed_ratio", "support_power_W",
    # of a bearing in the equilibrium of a machine
    "axial_load_N", "basic_life_h", "contact_angle_deg", "displacement_um", "force_N",
    "misalignment_mrad", "modified_life_h", "modified_reference_life_h", "moment_Nm", "position_mm",
    "radial_load_N", "reference_life_h", "static_safety", "viscosity_ratio",
})  # fmt: skip
_WIDTH = 100  # of sentences where no width is given


def other_lines(found: Record, units: UnitSystem, placed: Collection[str] = PLACED) -> list[str]:
    """Return a line for every other number of a record.

    It is declared and has no place of its own, as those in `placed` have.
    """
    return [line(one.column, by_axis(one, value, units)) for one, value in remaining(found, placed)]


def by_axis(one: Quantity, value: Any, units: UnitSystem) -> str:
    """Write a number with its unit.

    A vector has its axes, too.
    """
    if not one.axes or not value:
        return one.text(value, units)
    each = (f"{axis} {one.number(part, units)}" for axis, part in zip(one.axes, value, strict=True))
    return f"{'  '.join(each)} {units.unit(one.unit)}"


def band_lines(band: ModelBand | None, units: UnitSystem = SI) -> list[str]:
    """Return computed temperatures and sources of bands."""
    temperatures = temperature_text(band, units)
    return [
        *([line("temperatures", temperatures)] if temperatures else []),
        *lines_under("model band", source_lines(band)),
    ]


def rating_lines(rating: Rating | None, units: UnitSystem = SI, life_band: Sequence[float] = ()) -> list[str]:
    """Return the ratings of the run.

    They follow standards and catalogues for the case at its start.
    """
    if rating is None:
        return []
    facts = quantities(type(rating))
    makers = (("SKF", rating.skf_torque_Nmm), ("Schaeffler", rating.schaeffler_torque_Nmm))
    torques = facts["skf_torque_Nmm"]
    names = {"static_safety": "static C0/P0", "viscosity_ratio": "viscosity ratio kappa"}
    safeties = [(name, words) for name, words in names.items() if getattr(rating, name) is not None]
    says = [f"{maker} {torques.number(torque, units)}" for maker, torque in makers if torque is not None]
    modified = rating.life_factor, rating.contamination, rating.contamination_given
    rated = [
        f"{standard}: {_lives(zip(names, found, strict=True))}"
        for standard, *found, names in (
            ("ISO 281", rating.basic_life_h, rating.modified_life_h, ("L_10h", "L_nmh")),
            ("ISO/TS 16281", rating.reference_life_h, rating.modified_reference_life_h, ("L_10rh", "L_nmrh")),
        )
        if found[0] is not None
    ]
    return [
        *([line("catalogues", f"{'   '.join(says)} {units.unit('N mm')}")] if says else []),
        *_step(rating, units),
        *lines_under("rating life", rated),
        *([line("", f"L_10rh by the model band {ends(life_band, 'h', units, named=True)}")] if life_band else []),
        *([line("", life_factor_text(*modified))] if rating.modified_life_h is not None else []),
        line("safety", *(f"{words} {facts[name].number(getattr(rating, name))}" for name, words in safeties)),
    ]


def _step(rating: Rating, units: UnitSystem) -> list[str]:
    """Explain a large torque of SKF.

    The sliding torque of SKF steps where an axial load begins.
    """
    without = rating.skf_torque_without_step_Nmm
    if without is None or rating.skf_torque_Nmm is None:
        return []
    number = quantities(type(rating))["skf_torque_Nmm"].number(without, units)
    unit = units.unit("N mm")
    return [line("", f"SKF {number} {unit} without its step where an axial load begins (d_m^-0.26 to d_m^-0.145)")]


def _lives(found: Iterable[tuple[str, float | None]]) -> str:
    """Write lives with their symbols."""
    return "  ".join(f"{name} {hours(life)}" for name, life in found if life is not None)


def contamination_text(contamination: float | None, *, is_given: bool) -> str:
    """Say which e_C modified lives were computed with, and why."""
    given = "" if is_given else ": normal cleanliness, the case gives none (life.contamination)"
    return f"e_C {contamination:g}{given}"


def life_factor_text(factor: float | None, contamination: float | None, is_given: bool) -> str:
    """Say which a_ISO modified lives have, and with which e_C."""
    return f"a_ISO {number(factor, 2)} with {contamination_text(contamination, is_given=is_given)}"


def verdict_line(verdicts: Mapping[str, Verdict | None]) -> list[str]:
    """Return the verdicts on a machine's bearings in short."""
    judged = [f"{name} {'MET' if one.met else 'NOT MET'}" for name, one in verdicts.items() if one is not None]
    return [line("verdict", *judged)] if judged else []


def life_line(life: float | None) -> list[str]:
    """Return the life of all bearings.

    Nothing without one.
    """
    return [] if life is None else [line("system life", f"{hours(life)} of all bearings together (ISO/TS 16281, 90 %)")]


def verdict_lines(verdict: Verdict | None, units: UnitSystem = SI) -> list[str]:
    """Return the verdict, then the margins to limits."""
    if verdict is None:
        return []
    sentence, margins = verdict.lines(units)
    return [line("verdict", sentence), *([line("margins", *margins)] if margins else [])]


def bent_lines(shapes: Iterable[RingShape], units: UnitSystem) -> list[str]:
    """Return a line for every elastic ring."""
    return [line("" if i else "shape of rings", *_bent(bent, units)) for i, bent in enumerate(shapes)]


def _bent(found: RingShape, units: UnitSystem) -> tuple[str, str]:
    """Report the deformation of an elastic ring.

    It gives the largest one outwards and inwards, with the places.
    """
    return (
        f"{found.ring} {units.text(found.outwards_um, 'um', 2)} outwards at {found.outwards_deg:.0f} deg",
        f"{units.text(found.inwards_um, 'um', 2)} inwards at {found.inwards_deg:.0f} deg",
    )


def quasistatic_text(found: QuasiStatic, width: int | None = None, units: UnitSystem = SI) -> str:
    """Return the page of one bearing in equilibrium.

    It has a line per subject and a table of contacts or rollers; without a width, lines are as long as they are.
    """
    where = "" if found.rollers is None else "--json lists them"
    lines = [*statics_lines(found, width, units), *assumption_lines(found.assumptions, where=where)]
    return "\n".join(wrapped(lines, width))


def statics_lines(found: QuasiStatic, width: int | None, units: UnitSystem, *, is_section: bool = False) -> list[str]:
    """Return what a page says of one bearing in equilibrium.

    A section of a machine's page begins with its headline; it has no table of contacts, and the force on the shaft
    stands above it.
    """
    own, verdict = found.rollers, verdict_lines(found.verdict, units)
    head = units.sentence(found.headline).splitlines()
    element = "ball" if own is None else "roller"
    table = _contact_rows(found.contacts, units) if own is None else _roller_rows(own.loads, units)
    tilt_y, tilt_z = found.inner_ring_tilt_mrad
    loads = {one.name: line(one.column, by_axis(one, value, units)) for one, value in shown_numbers(found, ("load",))}
    return [
        *([*head, *verdict] if is_section else [*verdict, *head]),
        *(text for name, text in loads.items() if not is_section or name != "force_N"),
        line(
            "equilibrium",
            f"{counted(found.loaded_elements, element)} loaded",
            f"{named(found, 'max_load_N', units)} ({found.max_load_ring} ring)",
            named(found, "max_pressure_GPa", units),
        ),
        line("inner ring", *_place_with_play(found, units), f"tilt y {tilt_y:z.4f}  z {tilt_z:z.4f} mrad"),
        *([headed(found, "contact_angle_deg", units)] if is_section and any(found.contact_angle_deg) else []),
        *bent_lines(found.ring_shapes, units),
        *_friction_lines(found, units),
        *rating_lines(found.rating, units, found.reference_life_h_band),
        *_motion_lines(found, element, units),
        *(_rib_lines(own, units) if own is not None else []),
        *shoulder_lines(found.shoulders, units),
        *_capacitance_line(found, units),
        *other_lines(found, units, PLACED | loads.keys()),
        *found.own_lines(units),
        *band_lines(found.model_band, units),
        *([] if is_section else table),
        *warning_lines([units.sentence(warning) for warning in found.warnings], width),
    ]


def _contact_rows(contacts: Sequence[Contact], units: UnitSystem) -> list[str]:
    """Return a row per contact of a ball."""
    load, film = (f"{name} {units.unit(unit)}" for name, unit in (("load", "N"), ("film", "um")))
    head = f"{'ball':>6}{'azimuth':>10}{'ring':>8}{load:>10}{'angle deg':>11}{film:>10}{'C pF':>9}"
    return [head] + [
        f"{contact.element:>6}{contact.azimuth_deg:>10.1f}{contact.ring:>8}"
        f"{units.value(contact.load_N, 'N'):>10.1f}{contact.contact_angle_deg:>11.2f}"
        f"{units.number(contact.film_um, 'um', 3):>10}{number(contact.capacitance_pF, 1):>9}"
        for contact in contacts
    ]


def _roller_rows(rollers: Sequence[RollerLoad], units: UnitSystem) -> list[str]:
    """Return a row per roller."""
    force = units.unit("N")
    heads = (f"inner {force}", f"outer {force}", f"rib {force}", "tilt mrad", "N/mm")
    table = [f"{'roller':>8}{'azimuth':>10}" + "".join(f"{head:>12}" for head in heads)]
    for one in rollers:
        loads = "".join(f"{units.value(load, 'N'):>12.1f}" for load in (one.inner_N, one.outer_N, one.rib_N))
        row = f"{one.roller:>8}{one.azimuth_deg:>10.1f}{loads}{one.tilt_mrad:>z12.4f}{one.max_line_load_N_mm:>12.1f}"
        table.append(row)
    return table


def _friction_lines(found: QuasiStatic, units: UnitSystem) -> list[str]:
    """Return torque, its parts and the power.

    The list is empty at rest.
    """
    if found.friction_torque_Nmm is None:
        turns = found.orbit_speed_ratio is not None
        return [line("friction torque", "unknown: no steady motion was found" if turns else "none: nothing turns")]
    own = found.rollers
    shares = "" if own is None else f"raceways {_percent(own.raceway_share)}, ribs {_percent(own.rib_share)}"
    loss = [headed(found, "power_loss_W", units)] if found.power_loss_W is not None else []
    left_out = "(without cage)" if own is None or not own.full_complement else "(neighbours left out)"
    torque = headed(found, "friction_torque_Nmm", units, left_out, shares)
    return [torque, *breakdown_lines(found.friction_breakdown_Nmm, units), *loss]


def _percent(share: float | None) -> str:
    return f"{100.0 * (share or 0.0):.0f} %"


def _motion_lines(found: QuasiStatic, element: str, units: UnitSystem) -> list[str]:
    """Return the orbit of the rolling elements and their films.

    They roll up the films; at rest there are none.
    """
    if found.friction_torque_Nmm is None:
        return []
    own = found.rollers
    least, central = band_text(found.model_band, "minimum film", units), shown(found, "film_um", units)
    films = (f"minimum {least}", f"central {central}") if least else (central,)
    factors = () if own is None else (f"heat {number(own.heat_factor, 3)}", f"supply {number(own.supply_factor, 3)}")
    return [
        *([line("rolling factors", *factors)] if factors else []),
        line(f"{element} orbit", f"{shown(found, 'orbit_speed_ratio')} of inner ring"),
        line("film", *films, named(found, "film_parameter")),
    ]


def _capacitance_line(found: QuasiStatic, units: UnitSystem) -> list[str]:
    """Return the capacitance with its band, and what shorts."""
    plain = shown(found, "bearing_capacitance_nF", units) if found.bearing_capacitance_nF is not None else ""
    known = band_text(found.model_band, "capacitance", units) or plain
    texts = [f"bearing {known}" if known else "", found.capacitance_note]
    return [line("capacitance", *texts)] if any(texts) else []


def _rib_lines(own: RollerStatics, units: UnitSystem) -> list[str]:
    """Return load, film and limit of the ribs."""
    parts = []
    if own.rib_load_N > 0.0:
        film = "" if own.rib_film_um is None else f"film {units.text(own.rib_film_um, 'um', 2)}"
        friction = "" if own.rib_friction is None else f"friction {number(own.rib_friction, 4)}"
        parts = [f"load {units.text(own.rib_load_N, 'N', 0)}", film, friction]
    if own.axial_limit_N is not None:
        parts.append(f"axial limit {units.text(own.axial_limit_N, 'N', 0)}")
    return [line("rib", *parts)] if parts else []


def line(head: str, *parts: str) -> str:
    """Return one line: what it is about, then its parts."""
    return f"{head:<{HEAD}}{'   '.join(part for part in parts if part)}".rstrip()


def headed(record: Record, name: str, units: UnitSystem, *more: str) -> str:
    """Return the line of one declared number."""
    one = quantity_of(record, name)
    return line(one.column or one.label, shown(record, name, units), *more)


def named(record: Record, name: str, units: UnitSystem = SI) -> str:
    """Write a declared number behind its short name."""
    return f"{quantity_of(record, name).column} {shown(record, name, units)}"


def breakdown_lines(
    parts: Mapping[str, float | None], units: UnitSystem = SI, *, full_complement: bool = False
) -> list[str]:
    """Return the parts of the friction torque.

    Each ring has one line and the rest has one [N mm]. In a full complement neighbours rub, and no cage does.
    """
    shown = {name: units.number(value, "N mm") for name, value in parts.items()}
    width = max(map(len, shown.values()), default=1)
    each = [name for name in _PER_RING if f"{name}_inner" in parts]
    rings = [
        f"  {ring:<6}" + "".join(f"  {name} {shown[f'{name}_{ring}']:>{width}}" for name in each)
        for ring in ("inner", "outer")
    ]
    rest = [name for name in _REST if parts.get(name) or (name in parts and name != "bending")]  # of elastic parts only
    words = {"cage": "neighbours"} if full_complement else {}
    return [*rings, f"  {'':<6}" + "".join(f"  {words.get(name, name)} {shown[name]}" for name in rest)]


def warning_lines(warnings: Sequence[str], width: int | None = None) -> list[str]:
    """Return what is beyond a limit, a paragraph each."""
    room = _WIDTH if width is None else max(20, width - HEAD)
    each = [textwrap.wrap(warning, room, break_on_hyphens=False) for warning in warnings]
    return [text for parts in each for text in lines_under("WARNING", parts)]


def shoulder_lines(edges: Sequence[Shoulder], units: UnitSystem) -> list[str]:
    """Return how near contacts come to the shoulders."""
    return [line("shoulders", *(_margin(edge, units) for edge in edges))] if edges else []


def _margin(edge: Shoulder, units: UnitSystem) -> str:
    where = "clear of" if edge.margin_um >= 0.0 else "OVER"
    return f"{edge.ring} {units.text(abs(edge.margin_um), 'um', 0)} {where} the edge"


def assumption_lines(assumptions: Sequence[str], file: str = "", where: str = "") -> list[str]:
    """Return the count of assumptions in one line.

    The line also says where they and their reasons are listed: `where`, or a command for a case or a `file`.
    """
    if not assumptions:
        return []
    where = where or (f"lambda-bearing show {file} --assumptions" if file else "lambda-bearing check --all")
    return [line("assumed", f"{len(assumptions)} thing{'s' * (len(assumptions) != 1)}: {where}")]


def vector(record: Record, name: str, units: UnitSystem = SI) -> str:
    """Write a declared vector with its axes and unit."""
    return by_axis(quantity_of(record, name), getattr(record, name), units)


def _place_with_play(found: QuasiStatic, units: UnitSystem) -> list[str]:
    """Write a displacement with its axial play [um].

    The play counts where the ring has moved through half of it.
    """
    place, play = vector(found, "inner_ring_displacement_um", units), found.axial_play_um
    if not play or abs(found.inner_ring_displacement_um[0]) < 0.5 * play:
        return [place]
    return [place, f"x includes {units.number(play, 'um', 2)} {units.unit('um')} of axial play"]
