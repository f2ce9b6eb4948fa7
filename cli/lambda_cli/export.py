"""Define the command export."""

from __future__ import annotations

import json
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import CaseArgument, ForceOption, JsonOption, SetOption
from lambda_cli.talk import ProgressOption, QuietOption, Style, talk

app = typer.Typer(add_completion=False, no_args_is_help=True)


class Couple(StrEnum):
    """Inputs that the other program gives."""

    FORCE = "force"
    MOTION = "motion"


@app.callback()
def _export() -> None:
    """Export a bearing or a machine for other programs."""


@app.command()
def fmu(
    case: CaseArgument,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", metavar="FILE", help="The FMU; default: the name of the case.")
    ] = None,
    fmi: Annotated[int, typer.Option(metavar="VERSION", help="Version of the standard: 2 or 3.")] = 2,
    couple: Annotated[
        Couple, typer.Option(help="Inputs of the FMU: loads, or the motion of both rings of one bearing.")
    ] = Couple.FORCE,
    vary: Annotated[
        list[str] | None,
        typer.Option(
            metavar="PATH=LOW..HIGH",
            help='Option that the host may change: "lubricant.temperature=20..90 degC". Repeatable.',
        ),
    ] = None,
    platforms: Annotated[
        list[str] | None,
        typer.Option(
            "--platform",
            metavar="NAME",
            help="System to export for: linux (default), windows, linux-arm, mac-arm, mac-intel. Repeatable.",
        ),
    ] = None,
    processor: Annotated[
        str,
        typer.Option(
            metavar="NAME", help="Oldest processor to support: x86-64-v3, x86-64-v2, x86-64-v4, or native (this one)."
        ),
    ] = "x86-64-v3",
    changes: SetOption = None,
    force: ForceOption = False,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Write a case as a co-simulation unit (FMU).

    The unit has the compiled solver and needs no Python.

    It starts at the equilibrium of the case at t = 0. The export needs a C compiler; the extra fmu brings one.
    """
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        written = api.export_fmu(
            case,
            changes or (),
            out=out,
            fmi=fmi,
            couple=couple.value,
            vary=vary or (),
            platforms=platforms or ("linux",),
            processor=processor,
            overwrite=force,
            announce=speaker.say,
        )
    typer.echo(json.dumps({"file": str(written)}) if as_json else str(written))
    if not vary:
        typer.echo("this FMU has no parameters; --vary PATH=LOW..HIGH makes an option of the case one", err=True)
