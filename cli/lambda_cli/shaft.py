"""Solve or simulate a shaft in several bearings."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lambda_cli.options import JsonOption
from lambda_cli.run import DurationOption, WallOption
from lambda_cli.talk import ProgressOption, QuietOption, Style, columns, talk
from lambda_core.domain.files import check_folder

if TYPE_CHECKING:
    from lambda_core.api import WholeSummary


def shaft(
    case: Annotated[
        str, typer.Argument(metavar="CASE", help="Case file of a shaft (TOML), or the folder of a run, to be shown.")
    ],
    changes: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="PATH=VALUE", help='Change an option, for example --set bearings.left.preload="5 um".'
        ),
    ] = None,
    run: Annotated[
        bool, typer.Option("--run", help="Simulate the motion of shaft, balls and cages into a folder.")
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="DIR", help="With --run: its folder; default: NAME-run, numbered."),
    ] = None,
    force: Annotated[
        bool, typer.Option("--force", help="With --run: overwrite what a run left in the folder.")
    ] = False,
    duration: DurationOption = None,
    max_wall: WallOption = None,
    draw: Annotated[
        Path | None, typer.Option("--draw", metavar="DIR", help="Also write pictures (svg and png) into this folder.")
    ] = None,
    stiffness: Annotated[
        Path | None,
        typer.Option("--stiffness", metavar="FILE", help="Also write 6 x 6 stiffness and damping: .json or .csv."),
    ] = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Solve a shaft in its bearings: reactions, deflection, lives, critical speeds; with --run its motion.

    Computes the quasi-static equilibrium of elastic shaft, nonlinear bearings, housing, preload, thermal clearance and
    gear forces. With --run the equilibrium is the initial state of a transient simulation of shaft, housing, balls and
    cages, until the friction torque of every bearing is known to 1 %, or for --duration. Ctrl+C keeps the results so
    far; lambda-bearing resume DIR continues. Exit codes: 0 found, or converged; 3 invalid case, 4 no equilibrium or the
    solver failed, 5 not converged or stopped early, 130 interrupted.
    """
    from lambda_core import api

    if draw is not None:
        check_folder(draw, made=True)
    of_run = {"--out": out, "--force": force or None, "--duration": duration, "--max-wall": max_wall}
    given = [name for name, value in of_run.items() if value is not None]
    if given and not run:
        raise api.UsageError(f"{given[0]} goes with --run")
    if run and stiffness is not None:
        raise api.UsageError("--stiffness is that of the equilibrium: leave out --run")
    if run:
        _run(case, changes or [], out, draw, force=force, duration=duration, max_wall=max_wall, as_json=as_json,
             quiet=quiet, progress=progress)  # fmt: skip
        return
    if api.is_shaft_run(case):
        if changes or stiffness is not None:
            raise api.UsageError(f"{case} is a run that was made: --set and --stiffness go with a case file")
        tell(api.shaft_result(case), as_json=as_json)
        _draw(case, draw)
        return
    if stiffness is not None:
        api.stiffness_target(stiffness)
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


def _run(
    case: str, changes: list[str], out: Path | None, draw: Path | None, *, force: bool, duration: str | None,
    max_wall: str | None, as_json: bool, quiet: bool, progress: Style,
) -> None:  # fmt: skip
    """Simulate, say what came out, and end as it ended."""
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        found = api.shaft_run(
            api.check_shaft(case, changes), out=out, force=force, duration=seconds("--duration", duration),
            max_wall=seconds("--max-wall", max_wall), progress=speaker.update, announce=speaker.say,
        )  # fmt: skip
    tell(found, as_json=as_json)
    _draw(found.folder, draw)
    finish(found)


def _draw(folder: str, draw: Path | None) -> None:
    from lambda_core import api

    if draw is not None:
        for view in api.shaft_motion_pictures(folder):
            for path in api.draw(view, draw, Path(folder).name):
                typer.echo(str(path), err=True)


def seconds(option: str, text: str | None) -> float | None:
    """Return a time that an option gives [s]."""
    from lambda_core.domain.errors import UsageError
    from lambda_core.domain.units import parse

    if text is None:
        return None
    try:
        value = parse(text, "time")
    except ValueError as error:
        raise UsageError(f"{option}: {error}") from None
    if value <= 0.0:
        raise UsageError(f'{option}: "{text}" must be greater than 0')
    return value


def tell(found: WholeSummary, *, as_json: bool) -> None:
    """Print the summary of a run."""
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text(columns()))


def finish(found: WholeSummary) -> None:
    """End with the exit code that the state of a run calls for."""
    from lambda_core.domain.errors import PartialResultError

    if found.state == "interrupted":
        typer.echo(f"interrupted; go on with: lambda-bearing resume {found.folder}", err=True)
        raise typer.Exit(130)
    if not found.converged:
        raise PartialResultError(f"not converged: {'; '.join(found.reasons)}")
