"""Define the command warmup."""

from __future__ import annotations

import typer

from lambda_cli.options import JsonOption
from lambda_cli.talk import QuietOption


def warmup(as_json: JsonOption = False, quiet: QuietOption = False) -> None:
    """Compile the solver and every installed law.

    Takes half a minute to a minute on two cores, a second or two if everything is compiled.
    Exit code 3 if a law cannot be compiled; the command compiles all others.
    """
    from lambda_core import api

    found = api.warmup(announce=None if quiet else lambda text: typer.echo(text, err=True))
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text())
    if found.faults:
        raise typer.Exit(3)
