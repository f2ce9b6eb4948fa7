"""Build the chapters of a report."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from lambda_core.domain.elements import ALONE
from lambda_core.domain.errors import LambdaError
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.export.report.input_tables import given_values, law_table, value_tables
from lambda_core.export.report.key_tables import (
    Table,
    breakdown,
    contacts,
    key_figures,
    lives,
    machine_figures,
    machine_reactions,
    margins,
    margins_of_two,
    more_figures,
)
from lambda_core.export.report.sketch import bearing_sketch, load_sketch, shaft_sketch
from lambda_core.results.verdict import Verdict

if TYPE_CHECKING:
    from lambda_core.results.citation import Citation
    from lambda_core.results.model_band import ModelBand
    from lambda_core.results.reader import Result
    from lambda_core.results.summary import Summary

_SIZES = ("bore_diameter", "outside_diameter", "width")


@dataclass(frozen=True)
class Picture:
    """One view on a page.

    It may be the reason for the absence of the view.
    """

    name: str
    svg: str
    reason: str = ""


@dataclass(frozen=True)
class Inputs:
    """Start of a run or a study.

    It is ready to print.
    """

    values: tuple[Table, ...]
    assumptions: tuple[str, ...]
    laws: Table
    citation: Citation
    case_toml: str
    origin: tuple[tuple[str, str], ...]  # versions, plugins, hashes
    given: Table  # what the case says and what the bearing is


@dataclass(frozen=True)
class BearingPart:
    """Report of one bearing."""

    name: str  # of a bearing of a machine; "" of one alone
    title: str
    lines: tuple[str, ...]
    verdict: str
    is_met: bool
    margin_line: str
    margins: Table | None
    figures: Sequence[tuple[str, str, str]]  # what the table over a machine's bearings has, too
    more: Sequence[tuple[str, str, str]]
    sketch: str
    loads: str  # picture of the loads of its balls
    lives: Table
    losses: Table
    contacts: Table


@dataclass(frozen=True)
class Chapter:
    """One subject of a document.

    It has the pages of a run, of a case or of a study.
    """

    kind: str  # "run", "case" or "study"
    title: str
    subtitle: str
    state: str  # in a word: converged, complete ...
    good: bool
    bearings: tuple[BearingPart, ...] = ()
    lines: tuple[str, ...] = ()
    reasons: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    figures: Sequence[tuple[str, str, str]] = ()
    sketch: str = ""
    overview: tuple[Table, ...] = ()  # of a machine: a column for each bearing
    reactions: Table | None = None  # of a machine
    shown: tuple[Picture, ...] = ()  # pictures of the standard pages
    inputs: Inputs | None = None
    tables: tuple[Table, ...] = ()  # in the appendices
    sections: Sequence[Mapping[str, Any]] = ()
    pictures: tuple[Picture, ...] = ()
    trust: tuple[Picture, ...] = ()
    trust_tables: tuple[Table, ...] = ()
    definition: str = ""
    notes: tuple[str, ...] = field(default=())

    @property
    def limits(self) -> tuple[Table, ...]:
        """Return margins to limits; two bearings share a table."""
        found = {one.name: one.margins for one in self.bearings if one.margins is not None}
        if len(found) == 2:
            return (margins_of_two(found),)
        return tuple(replace(table, caption=name) for name, table in found.items())


def bearing_part(
    found: Any, geometry: Mapping[str, Any], *, name: str = "", loads: Sequence[float] = (), speed: str = "",
    units: UnitSystem = SI,
) -> BearingPart:  # fmt: skip
    """Return what there is to say of one bearing.

    Parameters
    ----------
    found : QuasiStatic, BearingSummary or Summary
        Its numbers.
    geometry : mapping
        Of the resolved model, SI, with `rollers` where it has them.
    loads : sequence of float
        Radial and axial load [N].
    """
    element = "roller" if "rollers" in geometry else "ball"
    verdict: Verdict | None = found.verdict
    return BearingPart(
        name=name,
        title=found.title,
        lines=tuple(units.sentence(found.headline).splitlines()),
        verdict=units.sentence(verdict.sentence) if verdict is not None else "",
        is_met=verdict is None or verdict.met,
        margin_line="   ".join(verdict.lines(units)[1]) if verdict is not None else "",
        margins=margins(verdict, units) if verdict is not None else None,
        figures=key_figures(found, units),
        more=more_figures(found, units),
        sketch=bearing_sketch(geometry, loads, speed, units),
        loads=load_sketch(found.contacts, units, element),
        lives=lives(found, element),
        losses=breakdown(found, units),
        contacts=contacts(found, units, element),
    )


def _geometry(model: Any) -> Mapping[str, Any]:
    """Return sizes of a bearing, with those of its rollers.

    The model is resolved or that of a result.
    """
    from lambda_core.results.provenance import plain

    if isinstance(model, Mapping):
        sizes, own = model["geometry"], model.get("rollers")
    else:
        sizes, own = plain(model.geometry), None if model.rollers is None else plain(model.rollers)
    return sizes if own is None else {**sizes, "rollers": own}


def case_chapter(
    model: Any, found: Any, units: UnitSystem = SI, pictures: Sequence[Picture] = (), bearing: str | None = None
) -> Chapter:
    """Return the chapter of a case.

    The case is at its operating point and describes one bearing or a machine.

    Parameters
    ----------
    model : BearingModel or MachineModel
        The resolved case.
    found : QuasiStatic or MachineEquilibrium
        Its equilibrium.
    bearing : str, optional
        The only bearing of the machine that the chapter is about.
    """
    if hasattr(model, "bearings"):
        chapter = _machine_chapter(model, found, units, pictures)
        return chapter if bearing is None else _about_one(chapter, bearing)
    loads = _applied(model)
    speed = _speed(model)
    part = bearing_part(found, _geometry(model), loads=loads, speed=speed, units=units)
    return Chapter(
        kind="case", title=found.title, subtitle=f"{model.name}, quasi-static at t = 0", state="equilibrium found",
        good=True, bearings=(part,), warnings=_sentences(found.warned(), units), inputs=model_inputs(model, units),
        notes=(_QUASISTATIC,),
    )  # fmt: skip


def _machine_chapter(model: Any, found: Any, units: UnitSystem, pictures: Sequence[Picture]) -> Chapter:
    """Return the chapter of a machine at its operating point."""
    from lambda_core.results.provenance import machine_data, plain

    parts = tuple(
        bearing_part(
            found.of_bearing(one.name),
            _geometry(seat.model),
            name=one.name,
            loads=(one.radial_load_N, one.axial_load_N),
            units=units,
        )
        for one, seat in zip(found.bearings.values(), model.bearings, strict=True)
    )
    sizes = {one.name: _size(plain(one.model.geometry)) for one in model.bearings}
    return Chapter(
        kind="case", title=f"{model.name}: {' + '.join(one.title.split(' (')[0] for one in found.bearings.values())}",
        subtitle=f"{found.speed_rpm:.5g} 1/min, quasi-static at t = 0", state="equilibrium found", good=True,
        bearings=parts, warnings=_sentences(found.warned(), units),
        sketch=shaft_sketch(machine_data(model), sizes, units),
        overview=(machine_figures(found, units),), reactions=machine_reactions(found, units), shown=tuple(pictures),
        inputs=model_inputs(model, units), notes=(_QUASISTATIC,),
    )  # fmt: skip


def _about_one(chapter: Chapter, bearing: str) -> Chapter:
    """Return a machine's chapter about one bearing, without the shaft."""
    own = tuple(part for part in chapter.bearings if part.name == bearing)
    title = f"{own[0].title}, {bearing} of {chapter.title.partition(':')[0]}"
    return replace(chapter, title=title, bearings=own, sketch="", overview=(), reactions=None, shown=())


_QUASISTATIC = "quasi-static: without time, vibration and cage; no confidence interval of a simulation applies"


def banded_summary(result: Result) -> Summary:
    """Return the averages of a run with model bands.

    A run without bands has them computed for its case.
    """
    summary = result.summary()
    if all(one.model_band is not None for one in summary.bearings.values()):
        return summary
    bands, each = _bands(result.case_toml), summary.bearings.items()
    own = {name: one if one.model_band is not None else one.with_band(bands.get(name)) for name, one in each}
    return summary.model_copy(update={"bearings": own})


def run_bearings(result: Result, summary: Summary, units: UnitSystem) -> tuple[BearingPart, ...]:
    """Return the parts of the bearings of a run."""
    several = result.is_machine and len(summary.bearings) > 1
    return tuple(
        bearing_part(
            one,
            _geometry(result.of_bearing(name).model),
            name=name if several else "", loads=_carried(one), units=units,
        )
        for name, one in summary.bearings.items()
    )  # fmt: skip


def _carried(found: Any) -> tuple[float, ...]:
    """Return the carried loads of a bearing [N].

    Radial and axial load from its contacts.
    """
    inner = [c for c in found.contacts if c.ring == "inner"]
    angles = [(math.radians(c.contact_angle_deg), math.radians(c.azimuth_deg), c.load_N) for c in inner]
    across = [q * math.cos(a) for a, _, q in angles]
    y = sum(f * math.cos(psi) for f, (_, psi, _) in zip(across, angles, strict=True))
    z = sum(f * math.sin(psi) for f, (_, psi, _) in zip(across, angles, strict=True))
    return math.hypot(y, z), sum(q * math.sin(a) for a, _, q in angles)


def _applied(model: Any) -> tuple[float, ...]:
    """Return the applied loads on the inner ring [N].

    Radial and axial load at the start.
    """
    from lambda_core.model.laws.time_functions import initial

    x, y, z = (initial(force) for force in model.inner_ring.force)
    return math.hypot(y, z), x


def _speed(model: Any) -> str:
    from lambda_core.model.checks.describe import function_text

    return str(function_text(model.inner_ring.dofs["spin"].motion, "rotational_speed"))


def _size(geometry: Mapping[str, Any]) -> tuple[float, float, float]:
    bore, outside, width = (float(geometry[name]) for name in _SIZES)
    return bore, outside, width


def _sentences(lines: Sequence[str], units: UnitSystem) -> tuple[str, ...]:
    return tuple(map(units.sentence, lines))


@lru_cache(maxsize=8)
def _bands(case_toml: str) -> dict[str, ModelBand]:
    """Return the 90 % model bands of a case's bearings.

    It is empty where there are none.
    """
    from lambda_core.analysis.band.model_band import model_band
    from lambda_core.case.case_io import toml_tables
    from lambda_core.results.model_band import ModelBand

    try:
        found = model_band(toml_tables(case_toml, "case"))
    except LambdaError:
        return {}
    return {ALONE: found} if isinstance(found, ModelBand) else found.bearings


def run_inputs(result: Result, units: UnitSystem = SI) -> Inputs:
    """Return the inputs of a run, from its file."""
    from lambda_core.results.citation import citation

    bearings = result.bearings if result.is_machine else {"": result.of_bearing()}
    hashes = {name: key for one in bearings.values() for name, key in one.kernel_keys.items()}
    origin = [*result.versions.items(), ("machine code", hashes.pop("code", "native"))]
    origin += [("plugin", name) for name in result.plugins]
    keys = [(f"code of {name}", key[:16]) for name, key in sorted(hashes.items())]
    values = {name: one.values for name, one in bearings.items()}
    return Inputs(
        value_tables(values, units),
        _sentences((result.of_machine() if result.is_machine else result).assumptions, units),
        law_table({name: one.laws for name, one in bearings.items()}),
        citation(result),
        result.case_toml,
        (*origin, *keys),
        given_values(values, units),
    )


def model_inputs(model: Any, units: UnitSystem = SI) -> Inputs:
    """Return the inputs of a case and its bearings."""
    from types import SimpleNamespace

    from lambda_core.results.citation import citation
    from lambda_core.results.provenance import Provenance

    bearings = model.bearing_models
    origins = {name: Provenance.alone(one, {}) for name, one in bearings.items()}
    laws = {name: next(iter(origin.bearings.values())).laws() for name, origin in origins.items()}
    values = {name: one.values for name, one in bearings.items()}
    versions = next(iter(origins.values())).versions()
    each = {name: SimpleNamespace(laws=laws[name], values=values[name]) for name in bearings}
    source: Any = SimpleNamespace(path=model.name, versions=versions, bearing="", bearings=each)
    plugins = dict.fromkeys(name for one in bearings.values() for name in one.plugins)
    return Inputs(
        value_tables(values, units),
        _sentences(model.assumptions, units),
        law_table(laws),
        citation(source),
        model.case_toml,
        (*versions.items(), *(("plugin", name) for name in plugins)),
        given_values(values, units),
    )
