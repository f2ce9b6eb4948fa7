"""Define the command show."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import BearingOption, JsonOption, Units, UnitsOption
from lambda_cli.talk import columns
from lambda_core.domain.wrapping import wrapped


def show(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE...",
            help="Result file, also of a running simulation; or several.",
        ),
    ],
    as_json: JsonOption = False,
    bearing: BearingOption = None,
    assumptions: Annotated[bool, typer.Option("--assumptions", help="List the assumptions.")] = False,
    units: UnitsOption = Units.SI,
) -> None:
    """Show the summary of a result.

    The run may be finished, still going on, or killed.

    A machine shows its motion and a section for each bearing; --bearing shows one bearing alone. Several results
    show the differences of their cases and their key numbers in columns.
    """
    from lambda_core import api

    if len(files) > 1 and not assumptions:
        found = api.side_by_side([api.result(file, bearing) for file in files])
        typer.echo(found.model_dump_json(indent=2) if as_json else found.text(units.system))
        return
    if len(files) > 1:
        raise api.UsageError("--assumptions needs exactly one result")
    result = api.result(files[0], bearing)
    if assumptions:
        lines = list(result.assumptions)
        typer.echo(
            json.dumps({"interface": 1, "assumptions": lines}, indent=2)
            if as_json
            else "\n".join(map(units.system.sentence, lines))
        )
        return
    summary = result.summary()
    if as_json:
        typer.echo(summary.model_dump_json(indent=2))
        return
    lines = [*units.system.sentence(summary.headline).splitlines(), *summary.text(columns(), units.system).splitlines()]
    typer.echo("\n".join(wrapped(lines, columns())))
