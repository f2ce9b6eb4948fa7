"""Define the command traction."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import JsonOption, Units, UnitsOption
from lambda_cli.talk import ProgressOption, QuietOption, Style, columns, talk
from lambda_core.domain.files import check_folder
from lambda_core.domain.wrapping import wrapped


def traction(
    oil: Annotated[str, typer.Argument(metavar="OIL", help="Name in the catalogue.")],
    pressure: Annotated[str, typer.Option("--pressure", metavar="VALUE", help='Largest Hertzian pressure, "1.2 GPa".')],
    temperature: Annotated[str, typer.Option("--temperature", metavar="VALUE", help='Of the oil, "60 degC".')],
    speed: Annotated[str, typer.Option("--speed", metavar="VALUE", help='Mean speed of both surfaces, "2 m/s".')],
    measured: Annotated[
        Path | None,
        typer.Option(
            "--measured", metavar="FILE.csv", help='Columns "slide-roll ratio [%]" and "traction coefficient [-]".'
        ),
    ] = None,
    draw: Annotated[
        Path | None,
        typer.Option("--draw", metavar="DIR", help="Also write the picture (svg and png) into this folder."),
    ] = None,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Compute traction over slide-roll ratio.

    It compares all traction laws, for a steel ball of 19.05 mm on a steel disc.
    """
    from lambda_core import api

    if draw is not None:
        check_folder(draw, made=True)
    with talk(progress, quiet) as speaker:
        found = api.traction(oil, pressure, temperature, speed, measured=measured, announce=speaker.say)
    typer.echo(found.model_dump_json(indent=2) if as_json else "\n".join(wrapped(found.text().splitlines(), columns())))
    if draw is not None:
        from lambda_core.views.other_units import in_units

        for path in api.draw(in_units(found.picture(), units.system), draw, "".join(oil.split())):
            typer.echo(str(path), err=True)
