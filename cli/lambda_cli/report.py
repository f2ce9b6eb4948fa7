"""The command report: one self-contained, printable page about a run or a study."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import ForceOption


def report(
    source: Annotated[Path, typer.Argument(metavar="RESULT|STUDY", help="Result file, or the folder of a study.")],
    out: Annotated[
        Path | None, typer.Option("--out", metavar="FILE", help="The page; default: name of the source with .html.")
    ] = None,
    force: ForceOption = False,
) -> None:
    """Write a report: results, views, convergence, inputs with sources, assumptions, references.

    One HTML file without anything from outside; print it, or save it as PDF, from any browser.
    """
    from lambda_core import api

    typer.echo(str(api.report(source, out, overwrite=force)))
