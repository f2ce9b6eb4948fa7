"""Define the command thermal."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import BandOption, Bands, JsonOption, OverlayOption, SetOption, Units, UnitsOption
from lambda_cli.pictures import check_overlay
from lambda_cli.talk import ProgressOption, QuietOption, Style, talk
from lambda_core.domain.files import check_folder

TransientOption = Annotated[
    str | None,
    typer.Option("--transient", metavar="TIME", help='Compute the temperatures over time, for example "1 h".'),
]


def thermal(
    source: Annotated[
        str, typer.Argument(metavar="CASE|RESULT", help="Case file, built-in case, or the result file of a run.")
    ],
    changes: SetOption = None,
    transient: TransientOption = None,
    draw: Annotated[
        Path | None, typer.Option("--draw", metavar="DIR", help="Also write pictures (svg and png) into this folder.")
    ] = None,
    measured: OverlayOption = None,
    band: BandOption = Bands.MODEL,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Find the temperatures of a bearing or machine.

    Its own losses heat it.

    The section thermal of the case describes the network: bearings, shaft, housing, surroundings. Clearance, preload,
    viscosity and films follow the temperatures. With a result file the losses are the averages of that run.
    Exit codes: 0 found, 3 invalid case, 4 no steady
    temperatures (a runaway is named with the gain that caused it), 5 a warm-up that passed thermal.limit.
    """
    from lambda_core import api
    from lambda_core.domain.errors import PartialResultError
    from lambda_core.views.other_units import in_units

    check_overlay(measured, draw)
    if draw is not None:
        check_folder(draw, made=True)
    with talk(progress, quiet) as speaker:
        course = None
        if transient is not None:
            course = api.warm_up(source, _seconds(transient), changes or (), announce=speaker.say)
        found = course or api.thermal(source, changes or (), band=band is Bands.MODEL, announce=speaker.say)
        views = api.thermal_pictures(found)
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text(units.system))
    if draw is not None:
        for view in views if measured is None else api.with_measured(views, measured):
            for path in api.draw(in_units(view, units.system), draw, api.view_stem([source])):
                typer.echo(str(path), err=True)
    if course is not None and course.reason:
        raise PartialResultError(course.reason)


def _seconds(text: str) -> float:
    """Read a time with its unit."""
    from lambda_core.domain.errors import UsageError
    from lambda_core.domain.units import parse

    try:
        return parse(text, "time")
    except ValueError as error:
        raise UsageError(f"--transient {error}") from None
