"""Define the command recent."""

from __future__ import annotations

import json

import typer

from lambda_cli.options import JsonOption


def recent(as_json: JsonOption = False) -> None:
    """List the recent case files.

    The list has the files that you checked, ran, began or opened, the newest first.
    """
    from lambda_db.recent import recent_cases

    found = [str(path) for path in recent_cases()]
    if as_json:
        typer.echo(json.dumps({"version": 1, "cases": found}, indent=2))
    elif found:
        typer.echo("\n".join(found))
    else:
        typer.echo("no case yet; begin with: lambda-bearing init NAME --template electric-motor", err=True)
