"""Define the command stribeck."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import (
    BandOption,
    Bands,
    BearingOption,
    CaseArgument,
    JsonOption,
    OverlayOption,
    SetOption,
    Units,
    UnitsOption,
)
from lambda_cli.pictures import check_overlay
from lambda_cli.talk import ProgressOption, QuietOption, Style, talk
from lambda_core.domain.files import check_folder

SpeedsOption = Annotated[
    list[str] | None,
    typer.Option("--speed", metavar="SPEED", help='A speed, for example "10 rpm"; may be repeated.'),
]


def stribeck(
    case: CaseArgument,
    changes: SetOption = None,
    bearing: BearingOption = None,
    speeds: SpeedsOption = None,
    points: Annotated[int, typer.Option("--points", min=2, max=200, help="Number of speeds without --speed.")] = 16,
    draw: Annotated[
        Path | None,
        typer.Option("--draw", metavar="DIR", help="Also write the picture (svg and png) into this folder."),
    ] = None,
    measured: OverlayOption = None,
    band: BandOption = Bands.MODEL,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Compute the friction torque over speed.

    It also prints the parts of the torque and SKF's catalogue model.

    Solutions are quasi-static and without a cage. Speeds range from 1 1/min to n d_m = 500 000 mm/min unless they are
    given.
    """
    from lambda_core import api

    chosen = [_rpm(text) for text in speeds or ()]
    check_overlay(measured, draw)
    if draw is not None:
        check_folder(draw, made=True)
    with talk(progress, quiet) as speaker:
        found = api.stribeck(
            case,
            changes or (),
            bearing=bearing,
            speeds_rpm=chosen,
            points=points,
            band=band is Bands.MODEL,
            announce=speaker.say,
        )
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text(units.system))
    if draw is not None:
        from lambda_core.views.other_units import in_units

        pictures = [api.stribeck_picture(found)]
        for picture in pictures if measured is None else api.with_measured(pictures, measured):
            for path in api.draw(in_units(picture, units.system), draw, api.view_stem([str(case)])):
                typer.echo(str(path), err=True)


def _rpm(text: str) -> float:
    """Read a speed with its unit [1/min]."""
    import math

    from lambda_core.domain.errors import UsageError
    from lambda_core.domain.units import parse

    try:
        return parse(text, "rotational_speed") * 30.0 / math.pi
    except ValueError as error:
        raise UsageError(f"--speed {error}") from None
