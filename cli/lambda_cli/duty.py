"""Define the command duty."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import JsonOption, Units, UnitsOption
from lambda_cli.talk import ProgressOption, QuietOption, Style, json_text, talk


def duty(
    file: Annotated[
        Path, typer.Argument(metavar="CYCLE", help="Duty cycle (TOML): a case, and phases with time and changes.")
    ],
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Add up rating life and losses over a duty cycle.

    Each phase has its quasi-static equilibrium. Lives follow ISO 281 and ISO/TS 16281; damages are added (Palmgren,
    Miner). A machine has the lives of every bearing and of the system. spectrum = "loads.csv" in the TOML file reads
    the phases from a CSV file.
    """
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        found = api.duty(file, announce=speaker.say)
    typer.echo(json_text(found.to_dict()) if as_json else found.text(units.system))
