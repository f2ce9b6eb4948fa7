"""Cite the program and the sources that a result used."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import BearingOption, JsonOption


def cite(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Result file.")],
    as_json: JsonOption = False,
    bearing: BearingOption = None,
    bibtex: Annotated[bool, typer.Option("--bibtex", help="Print BibTeX entries instead of text.")] = False,
) -> None:
    """Print the references that a result used.

    The list has exactly the laws and data of the result, and the program.
    """
    from lambda_core import api
    from lambda_core.domain.errors import UsageError

    if as_json and bibtex:
        raise UsageError("give either --json or --bibtex, not both")
    found = api.cite(api.result(file, bearing))
    if bibtex:
        typer.echo(found.bibtex())
    else:
        typer.echo(found.model_dump_json(indent=2) if as_json else found.text())
