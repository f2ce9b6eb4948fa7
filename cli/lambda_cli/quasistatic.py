"""Define the commands quasistatic and modes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lambda_cli.options import (
    BandOption,
    Bands,
    BearingOption,
    CaseArgument,
    JsonOption,
    SetOption,
    Units,
    UnitsOption,
)
from lambda_cli.talk import ProgressOption, QuietOption, Style, columns, json_text, talk
from lambda_core.domain.files import check_folder

if TYPE_CHECKING:
    from lambda_core.views.chart import ViewData

DrawOption = Annotated[
    Path | None, typer.Option("--draw", metavar="DIR", help="Also write pictures (svg and png) into this folder.")
]


def quasistatic(
    case: CaseArgument,
    changes: SetOption = None,
    bearing: BearingOption = None,
    draw: DrawOption = None,
    band: BandOption = Bands.MODEL,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Solve the quasi-static equilibrium of a case.

    Prints loads, contact angles, films and friction at t = 0, without time and cage.

    For a machine it solves elastic shaft, bearings, housing, preload, thermal clearance and gear forces, and prints
    reactions, deflection, lives and friction of every bearing; --bearing NAME prints one of them in full, with the load
    of every ball. --draw writes one bearing with the load on its ring and balls, or shaft, deflection and bending
    moment of a machine.
    """
    from lambda_core import api

    if draw is not None:
        check_folder(draw, made=True)
    with talk(progress, quiet) as speaker:
        found = api.quasistatic(case, changes or (), bearing=bearing, band=band is Bands.MODEL, announce=speaker.say)
    typer.echo(json_text(found.to_dict()) if as_json else found.text(columns(), units.system))
    if draw is not None:
        _draw(api.machine_pictures(found), draw, case, units, bearing)


def modes(
    case: CaseArgument,
    changes: SetOption = None,
    draw: DrawOption = None,
    stiffness: Annotated[
        Path | None,
        typer.Option("--stiffness", metavar="FILE", help="Also write 6 x 6 stiffness and damping: .json or .csv."),
    ] = None,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Compute critical speeds and modes of a machine.

    It also prints natural frequencies and the stiffness of every bearing.

    The bearings are as stiff as at the quasi-static equilibrium, and damped by their films and contacts.
    --draw writes the Campbell diagram: natural frequencies over speed.
    """
    from lambda_core import api

    if draw is not None:
        check_folder(draw, made=True)
    if stiffness is not None:
        api.stiffness_target(stiffness)
    with talk(progress, quiet) as speaker:
        found = api.modes(case, changes or (), announce=speaker.say)
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text(columns(), units.system))
    if stiffness is not None:
        typer.echo(str(api.write_stiffness(found, stiffness)), err=True)
    if draw is not None:
        _draw(api.machine_pictures(modes=found), draw, case, units)


def _draw(views: list[ViewData], folder: Path, case: str, units: Units, bearing: str | None = None) -> None:
    """Write pictures in the units that were asked for."""
    from lambda_core import api
    from lambda_core.views.other_units import in_units

    for view in views:
        for path in api.draw(in_units(view, units.system), folder, api.view_stem([case], bearing)):
            typer.echo(str(path), err=True)
