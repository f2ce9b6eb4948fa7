"""Write the C header of each case."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from lambda_core.analysis.electric import columns as circuit_columns
from lambda_core.domain.channels import RINGS, SHORTED
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.elements.roller.roller_ratings import HIGHEST_ROLLER_PRESSURE
from lambda_core.export.fmu.circuit_image import NUMBERS, OF_A_BEARING
from lambda_core.export.fmu.frozen import Frozen
from lambda_core.export.fmu.variables import Variable, control
from lambda_core.formulas.gap_capacitance import VACUUM_PERMITTIVITY
from lambda_core.formulas.loading import CARRYING
from lambda_core.laws.jit.portable import features, known_processor
from lambda_core.results.limits import THINNEST_FILM, Grooves, highest_pressure
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.fault_roles import ROLES
from lambda_core.solver.arrays.integrator_memory import COUNT
from lambda_core.solver.drivers.ball_paths import NO_PATH, PATH_ITERATIONS, PATH_SHARE, PATH_TOLERANCE
from lambda_core.solver.drivers.coupling import MOST_ITERATIONS, MOST_ITERATIONS_PER_SECOND
from lambda_core.solver.drivers.equilibrium import MAX_ITERATIONS
from lambda_core.solver.drivers.external_inputs import SHAFT_SPIN
from lambda_core.solver.drivers.ring_values import are_ribs, rings_of_contacts
from lambda_core.solver.drivers.static_search import BEGUN
from lambda_core.solver.records import STATIC_REPORT
from lambda_core.solver.status import Status

# What a processor must have that is called so.
_NAMED = {
    "x86-64-v2": ("sse4.2", "popcnt"),
    "x86-64-v3": ("avx2", "fma", "bmi", "bmi2"),
    "x86-64-v4": ("avx2", "fma", "bmi", "bmi2", "avx512f", "avx512vl", "avx512dq", "avx512bw", "avx512cd"),
}
# Where the processor says that it has them: leaf of the instruction cpuid, register (1: ebx, 2: ecx), bit.
_CPUID = {
    "sse4.2": (1, 2, 20),
    "popcnt": (1, 2, 23),
    "avx": (1, 2, 28),
    "fma": (1, 2, 12),
    "bmi": (7, 1, 3),
    "avx2": (7, 1, 5),
    "bmi2": (7, 1, 8),
    "avx512f": (7, 1, 16),
    "avx512dq": (7, 1, 17),
    "avx512cd": (7, 1, 28),
    "avx512bw": (7, 1, 30),
    "avx512vl": (7, 1, 31),
}
_WIDE = {"avx512": 0xE6, "avx": 0x6}  # registers that the system must keep for features that begin so
_LOST_STEP = 1e-30  # [s] shorter steps at t = 0 are numbers still, but their inverse squares are not
_LONGEST_STEP = 1e3  # [s] an hour or so of computing
_CALM = 0.1  # [s] after which a limit that is passed again is reported again
# What it looks at in a contact, to tell limits.
_LOOKED_AT = (
    "load", "contact_angle", "max_pressure", "semi_axis_a", "film_parameter", "asperity_share", "semi_axis_b",
    "film_central", "film_minimum", "entrainment", "capacitance_hertz", "capacitance",
)  # fmt: skip


def header_text(frozen: Frozen, variables: Sequence[Variable]) -> str:
    """Return a case's header for the library's C."""
    image, fault = frozen.image, frozen.image.place(frozen.bundle.scratch) + _at(R.SCRATCH, "fault")
    numbers = {
        "IMAGE_SIZE": image.size,
        "KEPT_SIZE": image.kept,
        "HOST": image.place(frozen.host),
        "CONTROL_TIME": control(frozen, "time"),
        "CONTROL_STOP": control(frozen, "stop"),
        "SAMPLES_WAITING": image.place(frozen.memory.count) + _at(COUNT, "samples_waiting"),
        "ITERATIONS": image.place(frozen.memory.count) + _at(COUNT, "newton_iterations"),
        "LOST_STEP": _LOST_STEP,
        "LONGEST_STEP": _LONGEST_STEP,
        "MOST_ITERATIONS": MOST_ITERATIONS,
        "MOST_ITERATIONS_PER_SECOND": MOST_ITERATIONS_PER_SECOND,
        "PRESSURE": next(i for i, v in enumerate(variables) if v.name.endswith(".max_pressure")),
        "FAULT_ROLE": fault + _at(R.FAULT, "role"),
        "FAULT_STATUS": fault + _at(R.FAULT, "status"),
        "FAULT_BALL": fault + _at(R.FAULT, "ball"),
        "FAULT_INPUTS": fault + _at(R.FAULT, "inputs"),
        "LOSSES": image.place(frozen.scratch.rates),
        "INTEGRALS": image.place(frozen.memory.integrals),
        "LOSS_COUNT": frozen.losses,
        "RELATIVE_SPEED": frozen.rate("relative_speed"),
        "RELATIVE_ANGLE": frozen.integral("relative_speed"),
        "STATUS_OK": int(Status.OK),
        "STATUS_REFUSED": int(Status.REFUSED),
        "STATUS_STEP_TOO_SMALL": int(Status.STEP_TOO_SMALL),
        "VARIABLES": len(variables),
        **{f"TERM_{name.upper()}": _at(R.TERM, name) for name in ("value", "rate", "acceleration", "begin")},
        **_limit_numbers(frozen),
        **_start_numbers(frozen),
        **_circuit_numbers(frozen),
        **_slope_numbers(frozen),
    }
    needed = _needed()
    lines = ['#include "token.h"']
    lines += [f"#define LB_{name} {number}" for name, number in numbers.items()]
    lines += [f'#define LB_PROCESSOR "{known_processor()} ({", ".join(needed)})"']
    kept = next((mask for head, mask in _WIDE.items() if any(name.startswith(head) for name in needed)), 0)
    lines += [f"#define LB_REGISTERS {kept}"]
    places = ", ".join(f"{{{leaf}, {register}, {bit}}}" for leaf, register, bit in map(_CPUID.__getitem__, needed))
    lines += [f"static const unsigned lb_needs[][3] = {{{places}}};"]
    lines += [f"static const uint32_t lb_relocations[][2] = {{{_pairs(image.relocations)}}};"]
    lines += [f"static const uint32_t lb_fixes[][2] = {{{_pairs(image.fixes)}}};"]
    lines += [f"static const char *const lb_roles[] = {{{', '.join(map(_quoted, ROLES))}}};"]
    lines += [
        *_part_table(frozen),
        *_film_table(frozen),
        *_start_tables(frozen),
        *_slope_table(frozen),
        *_curves(frozen),
    ]
    lines += _machine_tables(frozen, variables)
    first, rows = 0, []
    for v in variables:
        place, count = (first, len(v.parts)) if v.parts else (v.place, v.count)
        first += len(v.parts)
        limits = ",".join(map(_real, v.limits))
        rows.append(f"{{{v.kind:d},{place},{count},{v.stride},{v.scale!r},{v.begin},{limits},{v.axis},{v.turn!r}}}")
    lines += [f"static const lb_variable lb_variables[] = {{{', '.join(rows)}}};"]
    units = [f" {v.unit}" if v.unit not in ("", "1") else "" for v in variables]  # behind a number
    for name, texts in (("names", [v.name for v in variables]), ("units", units)):
        lines += [f"static const char *const lb_{name}[] = {{{', '.join(map(_quoted, texts))}}};"]
    return "\n".join(lines) + "\n"


def _limit_numbers(frozen: Frozen) -> dict[str, object]:
    """Return the numbers of the warnings at limits.

    They are limits of laws: :mod:`lambda_core.results.limits`.
    """
    contacts = frozen.scratch.contacts
    places = {f"CONTACT_{name.upper()}": _at(R.CONTACT_SAMPLE, name) for name in _LOOKED_AT}
    return {
        "CONTACTS": frozen.image.place(contacts),
        "CONTACT_SIZE": R.CONTACT_SAMPLE.itemsize,
        "CONTACTS_OF_A_BALL": contacts.shape[-2],
        "BALLS": contacts.shape[-3],
        "PARTS": len(frozen.bearings),
        **places,
        "THINNEST_FILM": THINNEST_FILM,
        "SHORTED_BELOW": SHORTED,
        "CALM": _CALM,
        "CARRYING": CARRYING,
    }


def _part_table(frozen: Frozen) -> list[str]:
    """Return the table of all bearings' parts.

    The place of each bearing, the ring of each contact of its balls, and its limits and grooves.

    Of both rings the groove: radius, edge, edge between two arcs.
    """
    parts = []
    for one in frozen.bearings:
        geometry = one.context.model.geometry
        rings, ribs = rings_of_contacts(geometry), are_ribs(geometry).astype(int)
        element, grooves = (
            ("ball", _grooves(geometry)) if one.context.model.rollers is None else ("roller", _NO_GROOVES)
        )
        label = f"{one.name}: " if one.name else ""
        parts.append(
            f'{{"{label}", "{element}", {one.span.first_ball}, {one.span.balls}, {len(rings)}, '
            f"{{{', '.join(map(str, rings))}}}, {{{', '.join(map(str, ribs))}}}, {grooves}}}"
        )
    return [f"static const lb_part lb_parts[] = {{{', '.join(parts)}}};"]


# Rollers have no shoulders to run over.
_NO_GROOVES = f"0, {{{{0.0}}}}, {HIGHEST_ROLLER_PRESSURE!r}, 0.0, 0, 0"


def _grooves(geometry: Geometry) -> str:
    """Return the grooves of a ball bearing and its limits."""
    grooves = Grooves.of(dataclasses.asdict(geometry))
    ridge = np.zeros(len(RINGS)) if grooves.ridge is None else grooves.ridge
    rows = ("{" + _reals(row) + "}" for row in np.column_stack([grooves.radius, grooves.edge, ridge]).tolist())
    return (
        f"1, {{{', '.join(rows)}}}, {highest_pressure(grooves.kind)!r}, {grooves.least_share!r}, "
        f"{int(grooves.one_sided)}, {int(grooves.ridge is not None)}"
    )


def _start_numbers(frozen: Frozen) -> dict[str, object]:
    """Return the numbers of another start.

    It is not at the case's equilibrium.
    """
    image, start = frozen.image, frozen.start
    found: dict[str, object] = {
        "STATE": image.place(frozen.memory.y),
        "BALL_SIZE": R.BALL.itemsize,
        "STALE": image.place(frozen.memory.count) + _at(COUNT, "stale"),
        "VALUES": image.place(frozen.host, frozen.host.size - len(frozen.varied)),
        "CONSTANTS": len(frozen.constants),
        "SETTLES": int(start is not None),
        "FOLLOWERS": 0 if frozen.machine is None else len(list(_followers(frozen))),
    }
    if start is None:
        return found
    system = image.place(frozen.bundle.system)
    places = {f"START_{name[6:].upper()}": image.place(array) for name, _, array in start.sections()}
    fields = {f"BALL_{name.upper()}": _at(R.BALL, name) for name in ("x", "radius", "azimuth", "velocity", "spin")}
    spin = [place for name, place in _given_places(frozen) if name == "inner_ring.spin"]
    return {
        **found,
        **places,
        **fields,
        "STATES": start.state.size,
        "BALLS_OF_A_ROW": start.slope.size,
        "REPORT_SIZE": start.report.nbytes,
        "REPORT_ORBIT": image.place(start.report) + _at(STATIC_REPORT, "orbit"),
        "REPORT_ITERATIONS": image.place(start.report) + _at(STATIC_REPORT, "iterations"),
        "BEGUN": BEGUN,
        "FRICTION_ON": system + _at(R.SYSTEM, "friction_on"),
        "GUIDES_ON": system + _at(R.SYSTEM, "guides_on"),
        "SPIN": spin[0] if spin else -1,
        "SPEED": repr(start.speed),
        "SMOOTH_WORK": MAX_ITERATIONS[False],
        "FRICTION_WORK": MAX_ITERATIONS[True],
        "PATH_ITERATIONS": 0 if frozen.bearings[0].context.model.geometry.kind.on_sphere else PATH_ITERATIONS,
        "PATH_SHARE": PATH_SHARE,
        "PATH_TOLERANCE": PATH_TOLERANCE,
        "NO_PATH": NO_PATH,
        "CAGE_ENTRIES": len(start.cage),
        "CAGE_X": L.SX,
        "CAGE_ANGLE": L.STHETA,
        "CAGE_SPEED": L.SSIGMA,
    }


def _followers(frozen: Frozen) -> Iterator[tuple[int, int, list[tuple[int, float]]]]:
    """Yield the places that follow a machine's inputs.

    They have the time since when they follow, and their shares.
    """
    for row, shares in frozen.inputs.shares.items() if frozen.machine else ():
        begin = frozen.of_row(frozen.inputs.rows, row, "begin")
        for k, field in enumerate(("value", "rate")):
            if k and [frozen.inputs.names[number] for number, _ in shares] != [SHAFT_SPIN]:
                continue  # loads have no rates
            sources = [(frozen.input_place(frozen.inputs.names[number]) + 8 * k, weight) for number, weight in shares]
            yield frozen.of_row(frozen.inputs.rows, row, field), begin, sources


def _machine_tables(frozen: Frozen, variables: Sequence[Variable]) -> list[str]:
    """Return the followers of a machine's inputs.

    Also return the sums that its outputs are.
    """
    followers: list[str] = []
    shares: list[str] = []
    for place, begin, sources in _followers(frozen):
        followers.append(f"{{{place},{begin},{len(shares)},{len(sources)}}}")
        shares += [f"{{{source},{weight!r}}}" for source, weight in sources]
    parts = [f"{{{place},{weight!r}}}" for v in variables for place, weight in v.parts]
    return [
        f"static const lb_follower lb_followers[] = {{{', '.join(followers) or '{0}'}}};",
        f"static const lb_share lb_shares[] = {{{', '.join(shares) or '{0}'}}};",
        f"static const lb_share lb_terms[] = {{{', '.join(parts) or '{0}'}}};",
    ]


def _circuit_numbers(frozen: Frozen) -> dict[str, object]:
    """Return the numbers of the circuit, where there is one."""
    found, image = frozen.circuit, frozen.image
    if found is None:
        return {"CIRCUIT": 0}
    arguments = found.arguments
    tables, nodes = arguments["tables"], arguments["nodes"]
    places = {f"TABLE_{name.upper()}": image.place(getattr(tables, name)) for name in tables._fields}
    places |= {f"CIRCUIT_{name.upper()}": found.place(image, name) for name in NUMBERS}
    arrays = {"SOURCE_T": "source_t", "SOURCE_V": "source_v", "TIMES": "t", "TOTAL": "total", "PLACE": "place"}
    places |= {f"CIRCUIT_{name}": image.place(arguments[key]) for name, key in arrays.items()}
    places |= {f"CIRCUIT_{name.upper()}": image.place(arguments[name]) for name in ("extremes", "events")}
    columns = ("T_EVENTS", "T_TRACE", "T_TIME", "T_BEGAN", "T_STATUS", "E_BALL", "E_CHARGE", "E_PEAK", "N_EVENT")
    return {
        "CIRCUIT": 1,
        **places,
        **{f"CIRCUIT_{name}": getattr(circuit_columns, name) for name in columns},
        "CIRCUIT_FIRST": image.place(found.words),
        "CIRCUIT_ANSWERS": image.place(found.answers),
        "CIRCUIT_BEARINGS": len(found.films),
        "CIRCUIT_OF_A_BEARING": len(OF_A_BEARING),
        **{f"CIRCUIT_A_{name.upper()}": k for k, name in enumerate(OF_A_BEARING)},
        "CIRCUIT_PATCHES": image.place(found.rate),
        "CIRCUIT_CHARGE": image.place(nodes.charge),
        "CIRCUIT_POTENTIAL": image.place(nodes.potential),
        "CIRCUIT_WINDING": image.place(found.sizes),
        "CIRCUIT_FULL": circuit_columns.EVENTS_FULL,
        "CIRCUIT_OK": circuit_columns.OK,
        "VACUUM_PERMITTIVITY": repr(VACUUM_PERMITTIVITY),
    }


def _film_table(frozen: Frozen) -> list[str]:
    """Return the films of each bearing of the circuit."""
    rows = []
    for part in frozen.circuit.films if frozen.circuit else ():
        film = part.film
        numbers = (film.conductivity, film.metal_resistance, film.ball_permittivity or 0.0)
        is_rough = int(film.roughness != "smooth")
        rows.append(f"{{{part.first},{part.balls},{part.node},{_reals(numbers)},{is_rough}}}")
    return [f"static const lb_film lb_films[] = {{{', '.join(rows)}}};"] if rows else []


def _slope_numbers(frozen: Frozen) -> dict[str, object]:
    """Return the numbers of the reactions' slopes.

    They use the solver's Jacobian, where the host prescribes the rings' motion.
    """
    prescribed, image = frozen.prescribed, frozen.image
    if prescribed is None:
        return {"SLOPES": 0}
    kept = prescribed.bundle.states
    return {
        "SLOPES": 1,
        "ELEMENT_STATES_SIZE": 8 * int(frozen.bundle.system["tail"][0]),
        "SLOPE_STATE": image.place(prescribed.state),
        "SLOPE_MATRIX": image.place(prescribed.blocks.shared),
        "SLOPE_WIDTH": prescribed.blocks.shared.shape[-1],
        "SHARED": image.place(frozen.scratch.shared),
        "CONTACT_STATES": image.place(frozen.memory.y, frozen.memory.y.size - kept.size),
        "CONTACT_STATES_SIZE": kept.nbytes,
    }


def _slope_table(frozen: Frozen) -> list[str]:
    """Return the free shared states of the Jacobian.

    The bearing has a prescribed motion.
    """
    states = ", ".join(map(str, frozen.prescribed.bundle.active)) if frozen.prescribed else ""
    return [f"static const unsigned lb_slope_states[] = {{{states}}};"] if states else []


def _given_places(frozen: Frozen) -> Iterable[tuple[str, int]]:
    return ((name, frozen.of_row(frozen.inputs.rows, row, "value")) for row, name in enumerate(frozen.inputs.names))


def _start_tables(frozen: Frozen) -> list[str]:
    start = frozen.start
    if start is None:
        return []
    rolling = ", ".join(_reals(row) for row in start.rolling.reshape(-1, 4).tolist())
    return [
        f"static const double lb_rolling[] = {{{rolling}}};",
        f"static const double lb_path[] = {{{_reals(start.slope.tolist())}}};",
        f"static const unsigned lb_cage[][2] = {{{_pairs(start.cage or ((0, 0),))}}};",
    ]


def _curves(frozen: Frozen) -> list[str]:
    """Return the dependent constants' curves.

    They are the points of every option and the values of every curve.
    """
    rows: list[str] = []
    curves: list[str] = []
    values: list[float] = []
    for constant in frozen.constants:
        rows.append(f"{{{constant.word},{constant.base!r},{constant.scales:d},{len(curves)},{len(constant.curves)}}}")
        for curve in constant.curves:
            curves.append(f"{{{curve.option},{len(values)},{curve.values.size - 1}}}")
            values += curve.values.tolist()
    options = (f"{{{each.lowest!r},{each.start!r},{each.highest!r}}}" for each in frozen.varied)
    return [
        f"static const lb_option lb_options[] = {{{', '.join(options) or '{0}'}}};",
        f"static const lb_constant lb_constants[] = {{{', '.join(rows) or '{0}'}}};",
        f"static const lb_curve lb_curves[] = {{{', '.join(curves) or '{0}'}}};",
        f"static const double lb_values[] = {{{_reals(values) or '0'}}};",
    ]


def _needed() -> tuple[str, ...]:
    """Return the processor features of this process's code."""
    name = known_processor()
    return _NAMED[name] if name in _NAMED else tuple(each for each in _CPUID if each in features())


def _at(kind: object, name: str) -> int:
    return int(kind.fields[name][1])  # type: ignore[attr-defined]


def _pairs(pairs: Sequence[tuple[int, int]]) -> str:
    return ",".join(f"{{{a},{b}}}" for a, b in pairs)


def _quoted(text: str) -> str:
    return f'"{text}"'


def _real(value: float) -> str:
    return repr(value).replace("inf", "INFINITY")


def _reals(values: Iterable[float]) -> str:
    return ",".join(map(_real, values))
