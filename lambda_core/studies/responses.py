"""Define the responses of a study with unit and meaning.

Names are those of the machine interface (:class:`~lambda_core.results.summary.Summary` and
:class:`~lambda_core.results.quasistatic.QuasiStatic`), where it has them. ``friction_breakdown_Nmm`` stands for
all its parts, and ``METHOD/GROUP/ROW`` for a row of a comparison method ("skf/friction/total"). Observers, events and
states of contacts add their own (:mod:`~lambda_core.studies.observed_responses`).

Every bearing of a machine has the responses of one that is alone, with its name before them ("left.min_film_um",
"left.skf/friction/total"). The machine and the places of its bearings have further ones. Bearing currents are those of
the machine's circuit with all its bearings.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.analysis.electric.current_numbers import UNITS, meaning
from lambda_core.analysis.rotor.machine_equilibrium import BearingEquilibrium, MachineEquilibrium
from lambda_core.domain.channels import LOSSES
from lambda_core.domain.errors import CaseError, Problem, nearest, unknown_name
from lambda_core.results.bearing_summary import BearingSummary
from lambda_core.results.quantity import quantities
from lambda_core.results.quasistatic import QuasiStatic
from lambda_core.results.rating import Rating
from lambda_core.results.record import Record
from lambda_core.results.summary import Summary
from lambda_core.studies import measures
from lambda_core.studies.points import DynamicPoint

if TYPE_CHECKING:
    from lambda_core.analysis.static_point import StaticPoint
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel

Number = float | None
BREAKDOWN = "friction_breakdown_Nmm"
_RIB = f"{BREAKDOWN}.rib"  # of rollers; in a run it is among the sliding at the rings
RATED = (
    "equivalent_load_N", "basic_life_h", "reference_life_h", "modified_life_h", "modified_reference_life_h",
    "viscosity_ratio", "static_safety",
)  # fmt: skip


@dataclass(frozen=True)
class Response:
    """One number of a point.

    It is read from a bearing of a point, or from the whole point. A mode that does not have it has None.
    """

    name: str
    unit: str
    meaning: str
    static: Callable[[Any], Number] | None = None
    dynamic: Callable[[DynamicPoint], Number] | None = None

    def in_bearing(self, name: str) -> Response:
        """Return a bearing's response as one of the whole point.

        A bearing that is alone has the empty name.
        """
        static, dynamic = _in_bearing(name, self.static), _in_bearing(name, self.dynamic)
        if not name:
            return replace(self, static=static, dynamic=dynamic)
        return Response(f"{name}.{self.name}", self.unit, f"{name}: {self.meaning}", static, dynamic)


def _in_bearing(name: str, read: Callable[[Any], Number] | None) -> Callable[[Any], Number] | None:
    return None if read is None else lambda point: read(point.bearing(name))


def _field(name: str, index: int | None = None) -> Callable[[Any], Number]:
    def read(point: Any) -> Number:
        value = getattr(point.summary, name)
        if index is not None:
            value = value[index] if value else None
        return None if value is None else float(value)

    return read


def _part(name: str) -> Callable[[Any], Number]:
    def read(point: Any) -> Number:
        parts: Mapping[str, Number] = getattr(point.summary, BREAKDOWN)
        return parts.get(name, 0.0)  # rollers neither spin nor, at rest, have a cage

    return read


def _parts() -> list[Response]:
    names = [*(name for name in LOSSES if name not in ("pocket", "land")), "cage"]
    found = [
        Response(f"{BREAKDOWN}.{name}", "N mm", f"friction torque: {name.replace('_', ' ')}", _part(name), _part(name))
        for name in names
    ]
    return [*found, Response(_RIB, "N mm", "friction torque: ribs", _part("rib"))]


def of_fields(kind: type[Record], names: Iterable[str]) -> Iterator[Response]:
    """Yield the numbers of a record as responses.

    They have no values; a vector yields one for each axis.
    """
    for name in names:
        one = quantities(kind)[name]
        if one.axes:
            for axis in one.axes:
                yield Response(f"{name}.{axis}", one.unit, f"{one.label} {axis}")
        elif not one.is_list:
            yield Response(name, one.unit, one.label)


def _fields() -> list[Response]:
    """Return the numbers with a value per point.

    They are those of an equilibrium and of a run.
    """
    still, moving = quantities(QuasiStatic), quantities(BearingSummary)
    of_run = [name for name, one in quantities(Summary).items() if one.group == "trust"]
    found = [*of_fields(BearingSummary, moving), *of_fields(Summary, of_run)]
    found += of_fields(QuasiStatic, (name for name in still if name not in moving))
    return [_with_values(one, still, {*moving, *of_run}) for one in found]


def _with_values(one: Response, still: Collection[str], moving: Collection[str]) -> Response:
    """Return a response with its values' source.

    The field of its name, or a measure of its own.
    """
    name, _, axis = one.name.partition(".")
    index = None if not axis else "xyz".index(axis) - (name == "inner_ring_tilt_mrad")
    own = _field(name, index)
    static, dynamic = _MEASURED.get(name, (own if name in still else None, own if name in moving else None))
    return replace(one, static=static, dynamic=dynamic)


# What a study computes otherwise than the summary of a point: quasi-static, dynamic.
_MEASURED: Mapping[str, tuple[Any, Any]] = {
    "power_loss_W": (measures.static_power, measures.dynamic_power),
    "max_load_N": (_field("max_load_N"), measures.max_load),
    "min_film_um": (measures.static_film, _field("min_film_um")),
    "bearing_capacitance_nF": (measures.static_capacitance, measures.dynamic_capacitance),
}


def _current(name: str) -> Callable[[Any], Number]:
    def read(point: Any) -> Number:
        value: Number = getattr(point.currents, name)
        return value

    return read


def _rated(name: str) -> Callable[[Any], Number]:
    def read(point: Any) -> Number:
        return None if point.rating is None else getattr(point.rating, name)

    return read


def _ratings() -> list[Response]:
    """Return lives and safety.

    They need no time; the rows of comparison methods have the rest.
    """
    return [replace(one, static=_rated(one.name), dynamic=_rated(one.name)) for one in of_fields(Rating, RATED)]


def _currents() -> list[Response]:
    return [Response(name, unit, meaning(name), _current(name), _current(name)) for name, unit in UNITS.items()]


_CONVERGED = Response("converged", "", "1 when converged", None, lambda point: float(point.summary.converged))


def _catalogue() -> dict[str, Response]:
    found = [
        *_fields(),
        *_parts(),
        *_ratings(),
        Response(
            "min_film_parameter", "", "smallest Lambda under load", measures.static_lambda, measures.dynamic_lambda
        ),
        _CONVERGED,
        Response(
            "cage_speed_deviation", "", "standard deviation of the cage speed over its mean", None,
            measures.cage_speed_deviation,
        ),
        Response(
            "ball_speed_deviation", "", "rms deviation of unloaded balls' speed from kinematic", None,
            measures.ball_speed_deviation,
        ),
        Response("pocket_touch_share", "", "share of time a pocket touches its ball", None, measures.pocket_share),
        *_currents(),
    ]  # fmt: skip
    return {response.name: response for response in found}


RESPONSES: Mapping[str, Response] = _catalogue()  # of a bearing
USUAL: Mapping[str, tuple[str, ...]] = {
    "quasi-static": (
        "friction_torque_Nmm", BREAKDOWN, "max_load_N", "max_pressure_GPa", "min_film_um", "min_film_parameter",
    ),
    "dynamic": (
        "friction_torque_Nmm", "friction_torque_ci_Nmm", BREAKDOWN, "cage_speed_over_epicyclic", "max_pressure_GPa",
        "min_film_um", "energy_residual", "converged",
    ),
}  # fmt: skip
# Of a machine, and of each of its bearings.
_USUAL_OF_MACHINE: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "quasi-static": (
        ("system_life_h", "friction_torque_Nmm"),
        ("radial_load_N", "reference_life_h", "friction_torque_Nmm", "max_pressure_GPa", "min_film_parameter"),
    ),
    "dynamic": (
        ("friction_torque_Nmm", "energy_residual", "converged"),
        ("friction_torque_Nmm", "friction_torque_ci_Nmm", "max_pressure_GPa", "min_film_um"),
    ),
}


# -- machines --


def _of_machine() -> Iterator[Response]:
    still = quantities(MachineEquilibrium)
    for one in of_fields(Summary, quantities(Summary)):
        read = _field(one.name)
        static = _power if one.name == "power_loss_W" else read if one.name in still else None
        yield replace(one, static=static, dynamic=read)
    yield Response("max_deflection_um", "um", "largest deflection of the shaft across its axis", _deflection)
    yield Response("first_critical_speed_rpm", "rpm", "first critical speed", _critical)
    yield _CONVERGED


def _power(point: StaticPoint) -> Number:
    return float(sum(measures.static_power(one) or 0.0 for one in point.bearings.values()))


def _deflection(point: Any) -> Number:
    return float(np.hypot(*np.array(point.summary.deflection_um).T[1:]).max())


def _critical(point: Any) -> Number:
    found = point.modes.critical_speeds
    return found[0].speed_rpm if found else None


def _of_mounted() -> Iterator[Response]:
    """Yield what only a bearing in a machine has."""
    for one in of_fields(
        BearingEquilibrium, (name for name in quantities(BearingEquilibrium) if name not in RESPONSES)
    ):
        yield replace(one, static=_mounted(one.name))
    for index, axis in enumerate("xyz"):
        yield Response(f"stiffness_N_per_um.{axis}", "N/um", f"stiffness {axis}", _stiffness(index))


def _mounted(path: str) -> Callable[[Any], Number]:
    key, _, axis = path.partition(".")
    axes = quantities(BearingEquilibrium)[key].axes

    def read(point: Any) -> Number:
        value: Any = getattr(point.mounted, key)
        if axis:
            value = value[axes.index(axis)]
        return None if value is None else float(value)

    return read


def _stiffness(index: int) -> Callable[[Any], Number]:
    return lambda point: 1e-6 * float(point.mounted.stiffness[index][index])


@lru_cache(maxsize=8)
def responses_in(bearings: tuple[str, ...]) -> Mapping[str, Response]:
    """Return the responses of a point.

    `bearings` are the names in a machine; the empty name is that of a bearing alone.
    """
    found: list[Response] = []
    if any(bearings):
        once = {"converged", *quantities(Summary)} - set(quantities(BearingSummary))
        own = [*_of_mounted(), *(one for one in RESPONSES.values() if one.name not in once)]
        found += _of_machine()
    else:
        own = list(RESPONSES.values())
    found += [one.in_bearing(name) for name in bearings for one in own]
    return {response.name: response for response in found}


def asks_currents(names: Sequence[str]) -> bool:
    """Tell whether the electric circuit is among what is asked."""
    return any(name.rpartition(".")[2] in UNITS for name in names)


def bearing_names(model: BearingModel | MachineModel) -> tuple[str, ...]:
    """Return the names of a machine's bearings.

    The model of one bearing has none.
    """
    return tuple(filter(None, model.bearing_models))


def responses_of(model: BearingModel | MachineModel) -> Mapping[str, Response]:
    """Return the responses of a model.

    The model is of a bearing or a machine; its observers, events and states have responses, too.
    """
    from lambda_core.studies.observed_responses import observed_responses

    balls = [name for name, one in model.bearing_models.items() if one.rollers is None]
    ribless = {f"{name}.{_RIB}" if name else _RIB for name in balls}
    found = {name: one for name, one in responses_in(tuple(model.bearing_models)).items() if name not in ribless}
    return {**found, **observed_responses(model)}


def method_rows_among(names: Sequence[str], known: Mapping[str, Response]) -> tuple[str, ...]:
    """Return the names of comparison methods' rows.

    They alone are not among the known responses.
    """
    return tuple(name for name in names if name not in known)


def chosen(
    names: Sequence[str], mode: str, source: str, known: Mapping[str, Response], bearings: tuple[str, ...] = ()
) -> tuple[str, ...]:
    """Return the names of a study's responses.

    Groups are written out.

    Parameters
    ----------
    known : mapping
        What the case has, from :func:`responses_of`.
    bearings : tuple of str
        Names of the bearings of a machine; empty for a case of one.

    Raises
    ------
    CaseError
        For unknown names, and those that the mode does not have.
    """
    found: list[str] = []
    wrong: list[Problem] = []
    for name in names or _usual(bearings, mode):
        if name.endswith(BREAKDOWN) and any(part.startswith(f"{name}.") for part in known):
            parts = [part for part in known if part.startswith(f"{name}.")]
            found += [part for part in parts if _of_mode(known[part], mode) is not None]
        elif "/" in name and name not in known:
            if own := [one for one in known if one.startswith(f"{name.partition('/')[0]}/")]:
                wrong.append(Problem("responses", unknown_name("response", name, own)))
            elif bearings and not any(name.startswith(f"{bearing}.") for bearing in bearings):
                words = f'"{name}": name the bearing that is meant, "{bearings[0]}.{name}"'
                wrong.append(Problem("responses", words))
            found.append(name)
        elif name not in known:
            close = nearest(name, known) or [one for one in known if one.endswith(f".{name}")] or sorted(known)
            wrong.append(Problem("responses", f'"{name}" is not a known response; nearest: {", ".join(close)}'))
        elif _of_mode(known[name], mode) is None:
            other = "dynamic" if mode == "quasi-static" else "quasi-static"
            wrong.append(
                Problem(
                    "responses", f'"{name}" exists in {other} studies only: choose another, or write mode = "{other}"'
                )
            )
        else:
            found.append(name)
    if wrong:
        raise CaseError(source, wrong)
    return tuple(dict.fromkeys(found))


def _usual(bearings: tuple[str, ...], mode: str) -> tuple[str, ...]:
    """Return what is asked where nothing is named."""
    if not bearings:
        return USUAL[mode]
    once, each = _USUAL_OF_MACHINE[mode]
    return (*once, *(f"{name}.{one}" for name in bearings for one in each))


def _of_mode(response: Response, mode: str) -> Callable[[Any], Number] | None:
    return response.static if mode == "quasi-static" else response.dynamic


def evaluate(
    names: Sequence[str], point: StaticPoint | DynamicPoint, methods: Mapping[str, Number],
    known: Mapping[str, Response],
) -> dict[str, Number]:  # fmt: skip
    """Return the responses of a point.

    A number that does not exist is None.

    Parameters
    ----------
    methods : mapping
        Values of the responses that are rows of comparison methods.
    known : mapping
        What the case has, from :func:`responses_of`.
    """
    mode = "dynamic" if isinstance(point, DynamicPoint) else "quasi-static"
    found: dict[str, Number] = {}
    for name in names:
        if name not in known:
            found[name] = methods.get(name)
            continue
        read = _of_mode(known[name], mode)
        assert read is not None
        value = read(point)
        found[name] = value if value is not None and math.isfinite(value) else None
    return found
