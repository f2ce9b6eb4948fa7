"""Write figures and one self-contained HTML page."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

from lambda_core.discovery.api import Registry
from lambda_core.domain.errors import UsageError
from lambda_core.export.report.key_tables import Table
from lambda_core.export.report.page import write_page
from lambda_core.views.chart import ViewData
from lambda_core.views.view import Figure, View

TEMPLATE = "page.html.jinja"
_RESOLUTION = 160  # of PNG [dots per inch]


@dataclass(frozen=True)
class Chapter:
    """One experiment with its texts, figures and tables."""

    name: str
    title: str
    bars: tuple[str, ...]
    charts: tuple[ViewData, ...]
    tables: tuple[Table, ...]
    notes: tuple[str, ...]


def write(registry: Registry, chapters: Sequence[Chapter], folder: Path) -> list[Path]:
    """Write all charts and the page.

    It writes ``NAME.svg`` and ``NAME.png`` of every chart, and ``reproduction.html`` with all of it.

    Raises
    ------
    UsageError
        When the folder cannot be written.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape

    written, pictures = [], {}
    for data in (chart for chapter in chapters for chart in chapter.charts):
        figure = _figure(registry, data)
        try:
            for kind, options in (("svg", {}), ("png", {"dpi": _RESOLUTION})):
                written.append(folder / f"{data.view}.{kind}")
                figure.savefig(written[-1], format=kind, **options)
        except OSError as error:
            raise UsageError(f"cannot write into {folder}: {error.strerror}") from None
        buffer = BytesIO()
        figure.savefig(buffer, format="svg")
        pictures[data.view] = b64encode(buffer.getvalue()).decode()
    environment = Environment(
        loader=PackageLoader("lambda_syla2026", "."),
        autoescape=select_autoescape(default=True),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    text = environment.get_template(TEMPLATE).render(chapters=chapters, pictures=pictures)
    return [*written, write_page(text, folder / "reproduction.html")]


def _figure(registry: Registry, data: ViewData) -> Figure:
    """Draw a chart that belongs to no installed view.

    It is in the style of the program.
    """

    def unused(subject: object, options: object) -> ViewData:
        return data

    return registry.figure(View(data.view, data.title, "results", unused), data)
