"""Define the commands quasistatic and modes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lambda_cli.options import BandOption, Bands, CaseArgument, JsonOption, SetOption, Units, UnitsOption
from lambda_cli.talk import ProgressOption, QuietOption, Style, columns, talk
from lambda_core.domain.files import check_folder

if TYPE_CHECKING:
    from lambda_core.views.chart import ViewData

DrawOption = Annotated[
    Path | None, typer.Option("--draw", metavar="DIR", help="Also write pictures (svg and png) into this folder.")
]


def quasistatic(
    case: CaseArgument,
    changes: SetOption = None,
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
    reactions, deflection, lives and friction of every bearing. --draw is for machines: shaft, deflection and bending
    moment.
    """
    from lambda_core import api

    source, several = case, api.is_machine(case)
    if draw is not None:
        if not several:
            raise api.UsageError("--draw needs a machine; for one bearing use lambda-bearing run, then view")
        check_folder(draw, made=True)
    with talk(progress, quiet) as speaker:
        model = api.check(source, changes or ()) if several else None
        found = api.quasistatic(
            model or source, () if model else changes or (), band=band is Bands.MODEL, announce=speaker.say
        )
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text(columns(), units.system))
    if draw is not None and model is not None:
        _draw(api.machine_pictures(model, equilibrium=found), draw, case, units)  # type: ignore[arg-type]


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
        model = api.check(case, changes or ()) if api.is_machine(case) else None
        found = api.modes(model or case, announce=speaker.say)
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text(columns(), units.system))
    if stiffness is not None:
        typer.echo(str(api.write_stiffness(found, stiffness)), err=True)
    if draw is not None and isinstance(model, api.MachineModel):
        _draw(api.machine_pictures(model, modes=found), draw, case, units)


def _draw(views: list[ViewData], folder: Path, case: str, units: Units) -> None:
    """Write pictures in the units that were asked for."""
    from lambda_core import api
    from lambda_core.views.other_units import in_units

    for view in views:
        for path in api.draw(in_units(view, units.system), folder, api.view_stem([case])):
            typer.echo(str(path), err=True)
