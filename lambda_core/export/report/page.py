"""Render reports as one self-contained HTML document."""

from __future__ import annotations

import logging
import re
from dataclasses import dataclass
from html import escape
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.discovery.api import Registry
from lambda_core.domain.errors import LambdaError, UsageError
from lambda_core.domain.files import check_target
from lambda_core.domain.plugin_errors import PluginError, blamed, went_on_without
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.export.report.band_table import model_bands
from lambda_core.export.report.chapters import Chapter, Inputs, Picture, banded_summary, run_bearings, run_inputs
from lambda_core.export.report.gallery import every
from lambda_core.export.report.key_tables import (
    Table,
    convergence,
    currents,
    in_unit,
    machine_figures,
    machine_reactions,
    rounded,
    run_figures,
    watched,
)
from lambda_core.export.report.sketch import shaft_sketch
from lambda_core.export.report.study_points import study_bands, study_points
from lambda_core.model.checks.assumption_effects import by_effect
from lambda_core.views.chart import ViewData
from lambda_core.views.method import NotApplicable
from lambda_core.views.other_units import in_units
from lambda_core.views.section import ReportTable, content_of
from lambda_core.views.table import StudyTable

log = logging.getLogger("lambda_core")

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lambda_core.results.reader import Result
    from lambda_core.results.side_by_side import SideBySide

TEMPLATE = "page.html.jinja"
# Views that stand in a chapter of their own.
_TRUST = ("convergence", "energy-balance")

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
    """Cover data that the user gives.

    They are project, author, day, the appendices after the standard pages, and units.
    """

    project: str = ""
    author: str = ""
    date: str = ""
    appendices: tuple[str, ...] = ()
    units: UnitSystem = SI

    @property
    def line(self) -> str:
        """One line for the head of the page.

        It is "" without one.
        """
        return "   ".join(filter(None, (self.project, self.author, self.date)))


_NO_COVER = Cover()


def run_chapter(registry: Registry, result: Result, cover: Cover = _NO_COVER) -> Chapter:
    """Return the chapter of one run.

    The run is one of a bearing or of a machine.
    """
    summary, units = banded_summary(result), cover.units
    pictures = _pictures(registry, result, "result", cover)
    overview: tuple[Table, ...] = ()
    sketch, shown, reactions = "", [], None
    alone = summary.bearings[next(iter(summary.bearings))] if len(summary.bearings) == 1 else None
    if result.is_machine and not result.bearing:
        found = _start_of(result)
        model = result.machine
        sizes = {
            name: tuple(float(one.model["geometry"][key]) for key in ("bore_diameter", "outside_diameter", "width"))
            for name, one in result.bearings.items()
        }
        sketch = shaft_sketch(model, sizes, units)  # type: ignore[arg-type]
        if found is not None:
            overview = (machine_figures(found[1], units, summary),)
            reactions = machine_reactions(found[1], units)
            shown = machine_drawings(registry, *found, cover)
    tables = [run_figures(summary, units)] if alone is not None else []
    for one in summary.bearings.values():
        tables += [*model_bands(one, units), *currents(one), *watched(one)]
    return Chapter(
        kind="run",
        title=result.title,
        subtitle=f"{result.path.name}   {result.created[:16].replace('T', ' ')}",
        state="converged" if summary.converged else "not converged",
        good=summary.converged,
        bearings=run_bearings(result, summary, units),
        lines=tuple(units.sentence(result.headline).splitlines()),
        reasons=tuple(units.sentence(reason) for reason in summary.reasons),
        warnings=tuple(units.sentence(warning) for warning in summary.warnings),
        sketch=sketch,
        overview=overview,
        reactions=reactions,
        shown=tuple(shown),
        inputs=run_inputs(result, units),
        tables=tuple(tables),
        sections=_sections(registry, result),
        pictures=tuple(p for p in pictures if p.name not in _TRUST),
        trust=tuple(p for p in pictures if p.name in _TRUST),
        trust_tables=(convergence(summary, units),) if alone is not None else (),
        notes=("lives, safety and torques of catalogues are those of the loads at the start",),
    )


def _start_of(result: Result) -> tuple[Any, Any] | None:
    """Return model and equilibrium of a machine's run.

    They come from its case; the result is None where it cannot be solved any more.
    """
    from lambda_core.analysis.static_point import static_point
    from lambda_core.case.case_io import toml_tables
    from lambda_core.model.resolve_machine import resolve_machine

    try:
        model = resolve_machine(toml_tables(result.case_toml, result.case))
        return model, static_point(model).summary
    except LambdaError as error:
        log.warning("the equilibrium at the start is not shown: %s", error)
        return None


def machine_drawings(registry: Registry, model: Any, found: Any, cover: Cover) -> list[Picture]:
    """Draw a machine's equilibrium.

    It draws deflection, bending moment and the other drawings.
    """
    from lambda_core.views.view import MachineData

    drawn = every(registry, MachineData(model, found, None), "machine")
    return [Picture(v.name, svg(registry, in_units(d, cover.units))) for v, d in drawn if isinstance(d, ViewData)]


def study_chapter(
    registry: Registry, table: StudyTable, status: Any, inputs: Inputs, definition: str, cover: Cover = _NO_COVER
) -> Chapter:
    """Return the chapter of one study.

    Parameters
    ----------
    status : lambda_core.studies.folders.StudyStatus
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
    tables = [*study_bands(status.model_band), study_points(table, cover.units)]
    pictures = _pictures(registry, table, "study", cover, all_of_them=True)
    if status.best is not None:
        units = table.units()
        rows = tuple(in_unit(name, value, units.get(name, ""), cover.units) for name, value in status.best.items())
        tables.insert(0, Table(f"best point ({status.message})", ("", "value", "unit"), rows))
    return Chapter(
        kind="study",
        title=table.title,
        lines=(f"{table.mode}, {table.design}: {', '.join(c.name for c in table.parameters)}",),
        subtitle=table.name,
        state="complete" if complete else "incomplete",
        good=complete,
        reasons=tuple(status.reasons),
        figures=figures,
        overview=tuple(tables),
        shown=tuple(picture for picture in pictures if picture.svg or cover.appendices),
        inputs=inputs,
        definition=definition,
    )


def document(chapters: Sequence[Chapter], cover: Cover = _NO_COVER, comparison: Sequence[Table] = ()) -> str:
    """Return one page with all chapters.

    Several begin with the tables that compare them.
    """
    title = chapters[0].title if len(chapters) == 1 else f"{len(chapters)} results"
    return _render(title=title, chapters=chapters, cover=cover, comparison=comparison)


def comparison_tables(found: SideBySide, units: UnitSystem = SI) -> tuple[Table, ...]:
    """Return differing inputs and key numbers of several results."""
    inputs = tuple((one.option, *(units.sentence(v or "–") for v in one.values)) for one in found.inputs)
    numbers = tuple(
        (
            f"{one.name} {units.unit(one.unit)}".rstrip(),
            *(rounded(None if v is None else units.value(v, one.unit), 4) for v in one.values),
        )
        for one in found.numbers
    )
    head = ("", *found.names)
    return Table("inputs that differ", head, inputs), Table("results", head, numbers)


def write_page(text: str, path: Path) -> Path:
    """Write a page; UsageError when that cannot be."""
    try:
        check_target(path).write_text(text, encoding="utf-8")
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror}") from None
    return path


# -- parts of a page --


def _sections(registry: Registry, result: Result) -> list[dict[str, Any]]:
    """Return the plugins' sections on a run.

    A section that fails shows the failure in its place.
    """
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
    environment.filters["by_effect"] = by_effect
    context |= {"parts": context["cover"].appendices, "appendices": _CHAPTERS}
    return environment.get_template(TEMPLATE).render(context)


def _breakable(path: str) -> Any:
    """Let a long option path break.

    It may break after dots and underscores.
    """
    from markupsafe import Markup

    return Markup(re.sub(r"([._])", r"\1<wbr>", escape(path)))


def _pictures(registry: Registry, subject: Any, kind: Any, cover: Cover, *, all_of_them: bool = False) -> list[Picture]:
    """Draw the views that the appendices show."""
    wanted = cover.appendices
    if not all_of_them and "views" not in wanted and "trust" not in wanted:
        return []
    left_out = set() if all_of_them else {
        *(_TRUST if "trust" not in wanted else ()),
        *(v for v in registry.views if "views" not in wanted and v not in _TRUST),
    }  # fmt: skip
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
    """Return a view as SVG for a page.

    It takes the width that it is given.
    """
    buffer = BytesIO()
    view = registry.views.get(data.view)
    whose = view.distribution if view is not None else "the house"
    with blamed(f'the picture of the view "{data.view}" ({whose})'):
        registry.figure(view, data).savefig(buffer, format="svg")
    text = buffer.getvalue().decode()
    text = text[text.index("<svg") :]
    head, rest = text.split(">", 1)
    head = re.sub(r'\s(width|height)="[^"]*"', "", head)
    return f'{head} role="img" aria-label="{escape(data.title)}">{rest}'
