"""Reports: one self-contained, printable page about a run or a study."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.errors import UsageError
from lambda_core.registry.chart import ViewData
from lambda_core.registry.method import NotApplicable
from lambda_core.registry.registry import Registry
from lambda_core.registry.table import StudyTable
from lambda_core.report.gallery import every
from lambda_core.schema.units import show

if TYPE_CHECKING:
    from lambda_core.physics.model import ResolvedValue
    from lambda_core.simulate.citation import Citation
    from lambda_core.simulate.results import Result

TEMPLATE = "page.html.jinja"
_ROWS = 1000  # of a study's table
# Views that stand in a chapter of their own.
_TRUST = ("convergence", "energy-balance")
# Sections of a case whose entries are parts: materials.inner, forces.ball_inner ...
_IN_PARTS = ("materials", "forces", "bodies")
_CONTACT = "contacts at the end state"


@dataclass(frozen=True)
class Table:
    """One table of a page: a caption, headings, rows of text."""

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Picture:
    """One view on a page, or the reason why it shows nothing."""

    name: str
    svg: str
    reason: str = ""


@dataclass(frozen=True)
class Inputs:
    """What a run or a study starts from, ready to print."""

    values: tuple[Table, ...]
    assumptions: tuple[str, ...]
    laws: Table
    citation: Citation
    case_toml: str
    origin: tuple[tuple[str, str], ...]  # versions, plugins, hashes


def run_report(registry: Registry, result: Result) -> str:
    """Return the page about one run."""
    from lambda_core.simulate.citation import citation

    summary = result.summary()
    pictures = _pictures(registry, result, "result")
    versions = [(name, version) for name, version in result.versions.items()]
    keys = [(f"code of {name}", key[:16]) for name, key in sorted(result.kernel_keys.items())]
    inputs = Inputs(
        _value_tables(result.values),
        result.assumptions,
        _law_table(result.laws),
        citation(result),
        result.case_toml,
        (*versions, *(("plugin", name) for name in result.plugins), *keys),
    )
    return _render(
        kind="run",
        title=result.title,
        headline=result.headline.splitlines(),
        subtitle=f"{summary.case}   {result.path.name}   {result.created}",
        verdict="converged" if summary.converged else "not converged",
        good=summary.converged,
        reasons=summary.reasons,
        figures=_key_figures(summary),
        tables=(_breakdown(summary), _contacts(summary)),
        pictures=[p for p in pictures if p.name not in _TRUST],
        trust=[p for p in pictures if p.name in _TRUST],
        trust_tables=(_convergence(summary),),
        inputs=inputs,
    )


def study_report(registry: Registry, table: StudyTable, status: Any, inputs: Inputs, definition: str) -> str:
    """Return the page about one study.

    Parameters
    ----------
    status : lambda_core.study.session.StudyStatus
        Where it stands.
    definition : str
        The study file.
    """
    complete = not (status.failed or status.pending or status.partial)
    figures = [("points", f"{status.points}", ""), ("with a result", f"{status.done + status.partial}", "")]
    figures += [
        (name, f"{count}", "")
        for name, count in (("partial", status.partial), ("failed", status.failed), ("to do", status.pending))
        if count
    ]
    tables = [_study_points(table)]
    if status.best is not None:
        units = table.units()
        rows = tuple((name, _text(value), units.get(name, "")) for name, value in status.best.items())
        tables.insert(0, Table(f"best point ({status.message})", ("", "value", "unit"), rows))
    return _render(
        kind="study",
        title=table.title,
        headline=[f"{table.mode}, {table.design}: {', '.join(c.name for c in table.parameters)}"],
        subtitle=table.name,
        verdict="complete" if complete else "incomplete",
        good=complete,
        reasons=status.reasons,
        figures=figures,
        tables=tuple(tables),
        pictures=_pictures(registry, table, "study"),
        trust=[],
        trust_tables=(),
        inputs=inputs,
        definition=definition,
    )


def case_inputs(model: Any) -> Inputs:
    """Return the inputs of a study from the resolved model of its case."""
    from types import SimpleNamespace

    from lambda_core.simulate.citation import citation
    from lambda_core.simulate.provenance import Provenance

    origin = Provenance(model, {})
    laws, versions = origin.laws(), origin.versions()
    source: Any = SimpleNamespace(path=model.name, laws=laws, values=model.values, versions=versions)
    return Inputs(
        _value_tables(model.values),
        tuple(model.assumptions),
        _law_table(laws),
        citation(source),
        model.case_toml,
        (*versions.items(), *(("plugin", name) for name in model.plugins)),
    )


def write_page(text: str, path: Path) -> Path:
    """Write a page; UsageError when that cannot be."""
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror}") from None
    return path


# -- parts of a page --


def _render(**context: Any) -> str:
    from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape

    environment = Environment(
        loader=PackageLoader("lambda_core.report", "."),
        autoescape=select_autoescape(default=True),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["breakable"] = _breakable
    return environment.get_template(TEMPLATE).render({"definition": "", **context})


def _breakable(path: str) -> Any:
    """Let a long path of an option break after its dots and underscores."""
    from markupsafe import Markup

    return Markup(re.sub(r"([._])", r"\1<wbr>", escape(path)))


def _pictures(registry: Registry, subject: Any, kind: Any) -> list[Picture]:
    found = []
    for view, data in every(registry, subject, kind):
        if isinstance(data, NotApplicable):
            found.append(Picture(view.name, "", str(data)))
        else:
            found.append(Picture(view.name, svg(registry, data)))
    return found


def svg(registry: Registry, data: ViewData) -> str:
    """Return a view as SVG for the inside of a page: it takes the width that it is given."""
    buffer = BytesIO()
    registry.figure(registry.view(data.view), data).savefig(buffer, format="svg")
    text = buffer.getvalue().decode()
    text = text[text.index("<svg") :]
    head, rest = text.split(">", 1)
    head = re.sub(r'\s(width|height)="[^"]*"', "", head)
    return f'{head} role="img" aria-label="{escape(data.title)}">{rest}'


def _key_figures(summary: Any) -> list[tuple[str, str, str]]:
    """Return what one looks for first: name, number, unit."""
    torque = _text(summary.friction_torque_Nmm)
    if summary.friction_torque_ci_Nmm is not None:
        torque += f" ± {summary.friction_torque_ci_Nmm:.2g}"
    position = ", ".join(_text(value) for value in summary.inner_ring_displacement_um)
    return [
        ("friction torque", torque, "N mm"),
        ("input torque", _text(summary.input_torque_Nmm), "N mm"),
        ("cage over inner ring speed", _text(summary.cage_speed_ratio), ""),
        ("cage over kinematic speed", _text(summary.cage_speed_over_epicyclic), ""),
        ("largest pressure", _text(summary.max_pressure_GPa), "GPa"),
        ("smallest film", _text(summary.min_film_um), "um"),
        ("Lambda", "..".join(_text(value) for value in summary.film_parameter), ""),
        ("capacitance of the bearing", _text(summary.bearing_capacitance_nF), "nF"),
        ("inner ring x, y, z", position, "um"),
        ("energy residual", _text(summary.energy_residual), "of input"),
        ("wall time per revolution", _text(summary.wall_per_revolution_s), "s"),
    ]


def _breakdown(summary: Any) -> Table:
    total = summary.friction_torque_Nmm
    rows = [
        (name.replace("_", " "), _text(value), f"{100.0 * value / total:.1f}" if total and value is not None else "")
        for name, value in summary.friction_breakdown_Nmm.items()
    ]
    return Table("friction torque by mechanism", ("mechanism", "N mm", "%"), tuple(rows))


def _contacts(summary: Any) -> Table:
    head = ("ball", "ring", "azimuth deg", "load N", "contact angle deg", "film um", "capacitance pF")
    rows = tuple(
        (
            str(c.ball), c.ring, f"{c.azimuth_deg:.1f}", f"{c.load_N:.1f}", f"{c.contact_angle_deg:.2f}",
            _text(c.film_um), _text(c.capacitance_pF),
        )
        for c in summary.contacts
    )  # fmt: skip
    return Table(_CONTACT, head, rows)


def _convergence(summary: Any) -> Table:
    rows = [
        ("simulated time", _text(summary.simulated_s), "s"),
        ("cage revolutions discarded", str(summary.revolutions_discarded), ""),
        ("cage revolutions averaged", str(summary.revolutions_averaged), ""),
        ("95 % half-width of the friction torque", _text(summary.friction_torque_ci_Nmm), "N mm"),
        ("energy residual", _text(summary.energy_residual), "of input"),
        ("wall time", _text(summary.wall_s), "s"),
        *((name.replace("_", " "), f"{count:.0f}", "") for name, count in summary.solver_statistics.items()),
    ]
    return Table("convergence", ("", "value", "unit"), tuple(rows))


def _study_points(table: StudyTable) -> Table:
    columns = [*table.parameters, *(c for c in table.responses if "." not in c.name)]
    head = ("point", *(f"{c.label} [{c.unit}]" if c.unit else c.label for c in columns), "state")
    shown = table.rows()[:_ROWS]
    rows = tuple(
        (
            str(row["point"]),
            *(_text(row[c.name]) for c in columns),
            f"{row['state']}: {row['reason']}" if row["reason"] else row["state"],
        )
        for row in shown
    )
    left = f" (the first {_ROWS} of {len(table)})" if len(table) > _ROWS else ""
    return Table(f"points{left}", head, rows)


def _value_tables(values: Iterable[ResolvedValue]) -> tuple[Table, ...]:
    """Return the resolved values with their sources, a table for each section of the case.

    What parts of a section share (the material of rings and balls, the laws of both raceways) stands there once.
    """
    sections: dict[str, dict[tuple[str, ...], list[str]]] = {}
    for value in values:
        section, _, name = value.path.partition(".")
        part = ""
        if section in _IN_PARTS:
            part, _, name = name.partition(".")
        row = (name or section.removesuffix("s"), _shown(value), value.status, value.source, value.grade)
        sections.setdefault(section, {}).setdefault(row, []).append(part.replace("_", " "))
    head = ("", "value", "status", "source", "grade")
    return tuple(
        Table(
            section, ("", "of", *head[1:]), tuple((row[0], ", ".join(parts), *row[1:]) for row, parts in rows.items())
        )
        if section in _IN_PARTS
        else Table(section, head, tuple(rows))
        for section, rows in sections.items()
    )


def _shown(value: ResolvedValue) -> str:
    if value.quantity and isinstance(value.value, float):
        return show(value.value, value.quantity, 6)
    return _text(value.value)


def _law_table(laws: Sequence[Mapping[str, str]]) -> Table:
    """Return every law with the force elements that use it and its parameters."""
    import json

    found: dict[tuple[str, str, str, str], list[str]] = {}
    for row in laws:
        found.setdefault((row["role"], row["model"], row["parameters"], row["distribution"]), []).append(row["element"])
    rows = []
    for (role, name, parameters, distribution), elements in found.items():
        values = ", ".join(f"{key} {_text(value)}" for key, value in json.loads(parameters).items())
        rows.append((role, name, ", ".join(elements).replace("_", " "), values, distribution))
    return Table("laws", ("role", "law", "force elements", "parameters (SI)", "package"), tuple(rows))


def _text(value: object) -> str:
    """Write one entry of a table; a dash for what does not exist."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.5g}" if isinstance(value, float) else str(value)
