"""Define the commands measured list, compare and add."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import BandOption, Bands, ForceOption, JsonOption
from lambda_cli.talk import ProgressOption, QuietOption, Style, columns, talk
from lambda_core.domain.errors import PartialResultError
from lambda_core.domain.wrapping import wrapped

app = typer.Typer(no_args_is_help=True, help="Compare measured series with the program.")

NamesArgument = Annotated[
    list[str] | None, typer.Argument(metavar="[SERIES]...", help="Names, or TOML files of your own; default: all.")
]


@app.command("list")
def list_(as_json: JsonOption = False) -> None:
    """List the measured series with source, licence and uncertainty."""
    from lambda_core import api

    found = api.measured_series()
    if as_json:
        typer.echo(json.dumps([series.model_dump() for series in found], indent=2))
        return
    lines = []
    for series in found:
        lines += [f"{series.name}: {series.title}", f"  {series.source} ({series.licence})"]
        lines += [f"  {series.how_read}; {series.uncertainty}"]
    typer.echo("\n".join(wrapped(lines, columns())))


@app.command()
def add(
    file: Annotated[Path, typer.Argument(metavar="FILE.toml", help="Description; the points are in FILE.csv.")],
    force: ForceOption = False,
) -> None:
    """Copy your own measured series into your data folder."""
    from lambda_core import api

    series = api.add_measured(file, overwrite=force)
    typer.echo(
        f"added {series.name.removesuffix('.toml')}; next: lambda-bearing measured compare {file.stem}", err=True
    )


@app.command()
def compare(
    names: NamesArgument = None,
    band: BandOption = Bands.MODEL,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Compare measured series with quasi-static solutions. Nothing is fitted."""
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        found = api.compare_measured(names or (), band=band is Bands.MODEL, announce=speaker.say)
    if as_json:
        typer.echo(found.model_dump_json(indent=2))
    else:
        typer.echo("\n".join(wrapped(found.text().splitlines(), columns())))
    if missing := [one.series.name for one in found.compared if names and one.reason and one.series.case]:
        raise PartialResultError(f"asked for and not computed: {', '.join(missing)}")
