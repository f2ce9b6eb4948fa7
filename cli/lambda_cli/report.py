"""Define the command report."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import BearingOption, ForceOption, Units, UnitsOption


def report(
    sources: Annotated[
        list[Path],
        typer.Argument(
            metavar="RESULT|CASE|STUDY...",
            help="Result files, case files (solved without time), folders of studies; several in one document.",
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="FILE", help="Page, .html or .pdf; default: name of the source with .html."),
    ] = None,
    project: Annotated[str, typer.Option("--project", metavar="TEXT", help="Project, for the head of the page.")] = "",
    author: Annotated[str, typer.Option("--author", metavar="TEXT", help="Author, for the head of the page.")] = "",
    full: Annotated[bool, typer.Option("--full", help="All appendices after the standard pages.")] = False,
    appendices: Annotated[
        list[str] | None,
        typer.Option(
            "--appendix",
            metavar="NAME",
            help="Appendix after the standard pages: tables, views, trust, inputs, assumptions, laws, references, "
            "origin; may be repeated; default: nothing.",
        ),
    ] = None,
    bearing: BearingOption = None,
    units: UnitsOption = Units.SI,
    force: ForceOption = False,
) -> None:
    """Write a report of four pages.

    It has a verdict with margins, a sketch, loads, lives, losses, inputs and limits.

    The report is one HTML file that needs no network, or a PDF (--out x.pdf) where a browser or WeasyPrint is
    installed; the extra "pdf" brings one. A machine has its shaft first, then two bearings on a page.
    """
    from lambda_core import api

    written = api.report(
        sources,
        out,
        overwrite=force,
        project=project,
        author=author,
        appendices=["all"] if full else appendices or [],
        units=units.value,
        bearing=bearing,
    )
    typer.echo(str(written))
