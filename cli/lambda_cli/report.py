"""The command report: one self-contained, printable page about a run or a study."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import BearingOption, ForceOption, Units, UnitsOption


def report(
    source: Annotated[Path, typer.Argument(metavar="RESULT|STUDY", help="Result file, or the folder of a study.")],
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="FILE", help="Page, .html or .pdf; default: name of the source with .html."),
    ] = None,
    project: Annotated[str, typer.Option("--project", metavar="TEXT", help="Project, for the head of the page.")] = "",
    author: Annotated[str, typer.Option("--author", metavar="TEXT", help="Who writes it, for the head.")] = "",
    appendices: Annotated[
        list[str] | None,
        typer.Option(
            "--appendix",
            metavar="NAME",
            help="What follows the first page: tables, views, trust, inputs, assumptions, laws, references, origin, "
            "or none; may be repeated; default: all.",
        ),
    ] = None,
    bearing: BearingOption = None,
    units: UnitsOption = Units.SI,
    force: ForceOption = False,
) -> None:
    """Write a report: results, views, convergence, inputs with sources, assumptions, references.

    One HTML file without anything from outside, or a PDF (--out x.pdf) where a browser or WeasyPrint is installed;
    the extra "pdf" brings one.
    """
    from lambda_core import api

    parts = None if not appendices else [name for name in appendices if name != "none"]
    written = api.report(
        source,
        out,
        overwrite=force,
        project=project,
        author=author,
        appendices=parts,
        units=units.value,
        bearing=bearing,
    )
    typer.echo(str(written))
