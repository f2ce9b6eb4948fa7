"""The command shaft: a shaft in several bearings, one equilibrium of the whole."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import JsonOption
from lambda_cli.talk import ProgressOption, QuietOption, Style, columns, talk
from lambda_core.domain.files import check_folder


def shaft(
    case: Annotated[str, typer.Argument(metavar="CASE", help="Case file of a shaft (TOML).")],
    changes: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="PATH=VALUE", help='Change an option, for example --set bearings.left.preload="5 um".'
        ),
    ] = None,
    draw: Annotated[
        Path | None, typer.Option("--draw", metavar="DIR", help="Also write pictures (svg and png) into this folder.")
    ] = None,
    stiffness: Annotated[
        Path | None,
        typer.Option("--stiffness", metavar="FILE", help="Also write the 6 x 6 stiffness matrices: .json or .csv."),
    ] = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Solve a shaft in its bearings: reactions, deflection, lives, critical speeds.

    One quasi-static equilibrium of the whole: elastic shaft, nonlinear bearings, housing, preload, thermal clearance,
    gear forces. Exit codes: 0 found, 3 invalid case, 4 no equilibrium.
    """
    from lambda_core import api

    if draw is not None:
        check_folder(draw, made=True)
    with talk(progress, quiet) as speaker:
        model = api.check_shaft(case, changes or ())
        found = api.shaft(model, announce=speaker.say)
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text(columns()))
    if stiffness is not None:
        typer.echo(str(api.write_stiffness(found, stiffness)), err=True)
    if draw is not None:
        for view in api.shaft_pictures(model, found):
            for path in api.draw(view, draw, api.view_stem([case])):
                typer.echo(str(path), err=True)
