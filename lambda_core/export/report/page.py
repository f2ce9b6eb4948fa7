"""Reports: one self-contained, printable page about a run or a study."""

from __future__ import annotations

import logging
import re
from dataclasses import dataclass
from html import escape
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.discovery.registry import Registry
from lambda_core.domain.errors import UsageError
from lambda_core.domain.files import check_target
from lambda_core.domain.plugin_errors import PluginError, blamed, went_on_without
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.export.report.gallery import every
from lambda_core.export.report.key_tables import (
    Table,
    breakdown,
    contacts,
    convergence,
    currents,
    in_unit,
    key_figures,
    law_table,
    run_figures,
    study_points,
    value_tables,
    watched,
)
from lambda_core.views.chart import ViewData
from lambda_core.views.method import NotApplicable
from lambda_core.views.other_units import in_units
from lambda_core.views.section import ReportTable, content_of
from lambda_core.views.table import StudyTable

log = logging.getLogger("lambda_core")

if TYPE_CHECKING:
    from lambda_core.results.citation import Citation
    from lambda_core.results.reader import Result

TEMPLATE = "page.html.jinja"
# Views that stand in a chapter of their own.
_TRUST = ("convergence", "energy-balance")
# The view that stands on the first page: which balls carry how much.
_SKETCH = "load-distribution"


@dataclass(frozen=True)
class Picture:
    """One view on a page, or the reason why it shows nothing."""

    name: str
    svg: str
    reason: str = ""


# Name of an appendix -> what it is called; the tables have no heading of their own.
_CHAPTERS = (
    ("views", "Views"),
    ("trust", "Convergence and energy"),
    ("inputs", "Inputs"),
    ("assumptions", "Assumptions"),
    ("laws", "Laws"),
    ("references", "References"),
    ("origin", "Origin"),
)
APPENDICES = ("tables", *(name for name, _ in _CHAPTERS))


@dataclass(frozen=True)
class Cover:
    """What the person who reports says: project, author, day, which appendices follow the first page, which units."""

    project: str = ""
    author: str = ""
    date: str = ""
    appendices: tuple[str, ...] = APPENDICES
    units: UnitSystem = SI

    @property
    def line(self) -> str:
        """One line for the head of the page, "" without one."""
        return "   ".join(filter(None, (self.project, self.author, self.date)))


@dataclass(frozen=True)
class Inputs:
    """What a run or a study starts from, ready to print."""

    values: tuple[Table, ...]
    assumptions: tuple[str, ...]
    laws: Table
    citation: Citation
    case_toml: str
    origin: tuple[tuple[str, str], ...]  # versions, plugins, hashes


_NO_COVER = Cover()


def run_report(registry: Registry, result: Result, cover: Cover = _NO_COVER) -> str:
    """Return the page about one run."""
    from lambda_core.results.citation import citation

    summary, units = result.summary(), cover.units
    pictures = _pictures(registry, result, "result", cover)
    versions = [(name, version) for name, version in result.versions.items()]
    hashes = dict(result.kernel_keys)
    versions.append(("machine code", hashes.pop("code", "native")))
    keys = [(f"code of {name}", key[:16]) for name, key in sorted(hashes.items())]
    inputs = Inputs(
        value_tables(result.values, units),
        tuple(map(units.sentence, result.assumptions)),
        law_table(result.laws),
        citation(result),
        result.case_toml,
        (*versions, *(("plugin", name) for name in result.plugins), *keys),
    )
    return _render(
        kind="run",
        cover=cover,
        title=result.title,
        headline=units.sentence(result.headline).splitlines(),
        subtitle=f"{summary.case}   {result.path.name}   {result.created}",
        verdict="converged" if summary.converged else "not converged",
        good=summary.converged,
        reasons=[units.sentence(reason) for reason in summary.reasons],
        warnings=[units.sentence(warning) for warning in summary.warnings],
        sketch=next((p for p in pictures if p.name == _SKETCH and p.svg), None),
        figures=key_figures(summary, units),
        tables=(
            breakdown(summary, units),
            run_figures(summary, units),
            *currents(summary),
            *watched(summary),
            contacts(summary, units),
        ),
        sections=_sections(registry, result),
        pictures=[p for p in pictures if p.name not in (*_TRUST, _SKETCH)],
        trust=[p for p in pictures if p.name in _TRUST],
        trust_tables=(convergence(summary, units),),
        inputs=inputs,
    )


def study_report(
    registry: Registry, table: StudyTable, status: Any, inputs: Inputs, definition: str, cover: Cover = _NO_COVER
) -> str:
    """Return the page about one study.

    Parameters
    ----------
    status : lambda_core.study.studies.StudyStatus
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
    tables = [study_points(table, cover.units)]
    if status.best is not None:
        units = table.units()
        rows = tuple(in_unit(name, value, units.get(name, ""), cover.units) for name, value in status.best.items())
        tables.insert(0, Table(f"best point ({status.message})", ("", "value", "unit"), rows))
    return _render(
        kind="study",
        cover=cover,
        title=table.title,
        headline=[f"{table.mode}, {table.design}: {', '.join(c.name for c in table.parameters)}"],
        subtitle=table.name,
        verdict="complete" if complete else "incomplete",
        good=complete,
        reasons=status.reasons,
        warnings=[],
        sketch=None,
        figures=figures,
        tables=tuple(tables),
        sections=[],
        pictures=_pictures(registry, table, "study", cover),
        trust=[],
        trust_tables=(),
        inputs=inputs,
        definition=definition,
    )


def case_inputs(model: Any, units: UnitSystem = SI) -> Inputs:
    """Return the inputs of a study from the resolved model of its case."""
    from types import SimpleNamespace

    from lambda_core.results.citation import citation
    from lambda_core.results.provenance import Provenance

    origin = Provenance.alone(model, {})
    laws, versions = next(iter(origin.bearings.values())).laws(), origin.versions()
    source: Any = SimpleNamespace(path=model.name, laws=laws, values=model.values, versions=versions)
    return Inputs(
        value_tables(model.values, units),
        tuple(map(units.sentence, model.assumptions)),
        law_table(laws),
        citation(source),
        model.case_toml,
        (*versions.items(), *(("plugin", name) for name in model.plugins)),
    )


def write_page(text: str, path: Path) -> Path:
    """Write a page; UsageError when that cannot be."""
    try:
        check_target(path).write_text(text, encoding="utf-8")
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror}") from None
    return path


# -- parts of a page --


def _sections(registry: Registry, result: Result) -> list[dict[str, Any]]:
    """Return what plugins say of a run; one that fails says so in its place."""
    found = []
    for section in registry.sections.values():
        try:
            parts: tuple[str | ReportTable, ...] = content_of(section, result)
        except NotApplicable:
            continue
        except PluginError as error:
            log.warning("%s", error)
            parts = (f"Not shown: {error}.",)
        source = f"{section.reference} [{section.distribution}]"
        found.append({"name": section.name, "title": section.title, "parts": parts, "source": source})
    return found


def _render(**context: Any) -> str:
    from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape

    environment = Environment(
        loader=PackageLoader("lambda_core.export.report", "."),
        autoescape=select_autoescape(default=True),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["breakable"] = _breakable
    context |= {
        "definition": context.get("definition", ""),
        "parts": context["cover"].appendices,
        "chapters": _CHAPTERS,
    }
    return environment.get_template(TEMPLATE).render(context)


def _breakable(path: str) -> Any:
    """Let a long path of an option break after its dots and underscores."""
    from markupsafe import Markup

    return Markup(re.sub(r"([._])", r"\1<wbr>", escape(path)))


def _pictures(registry: Registry, subject: Any, kind: Any, cover: Cover) -> list[Picture]:
    """Draw the views that the page shows; where pictures are no part of it only the one on its first page."""
    left_out = {
        *(_TRUST if "trust" not in cover.appendices else ()),
        *(v for v in registry.views if "views" not in cover.appendices and v not in (*_TRUST, _SKETCH)),
    }
    found = []
    for view, data in every(registry, subject, kind, without=left_out):
        try:
            found.append(
                Picture(view.name, "", str(data)) if isinstance(data, NotApplicable)
                else Picture(view.name, svg(registry, in_units(data, cover.units)))
            )  # fmt: skip
        except PluginError as fault:  # of one package: the page has the others
            went_on_without(str(fault))
            found.append(Picture(view.name, "", str(fault)))
    return found


def svg(registry: Registry, data: ViewData) -> str:
    """Return a view as SVG for the inside of a page: it takes the width that it is given."""
    buffer = BytesIO()
    view = registry.view(data.view)
    with blamed(f'the picture of the view "{view.name}" ({view.distribution})'):
        registry.figure(view, data).savefig(buffer, format="svg")
    text = buffer.getvalue().decode()
    text = text[text.index("<svg") :]
    head, rest = text.split(">", 1)
    head = re.sub(r'\s(width|height)="[^"]*"', "", head)
    return f'{head} role="img" aria-label="{escape(data.title)}">{rest}'
