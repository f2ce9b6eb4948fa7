"""Define the command resume."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import JsonOption, Units, UnitsOption
from lambda_cli.run import DurationOption, WallOption, finish, limits
from lambda_cli.talk import ProgressOption, QuietOption, Style, talk


def resume(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Result file of the run.")],
    duration: DurationOption = None,
    max_wall: WallOption = None,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Continue a run from its last checkpoint.

    The results are the same as without the interruption.

    This works after Ctrl+C, a kill, a full disk or the limit of wall time. --duration makes a finished run longer.
    --max-wall applies to this session; the earlier limit is discarded. Exit codes are those of run.
    """
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        for line in api.result(file).headline.splitlines():
            speaker.say(units.system.sentence(line))
        result = api.resume(file, limits(duration, max_wall), progress=speaker.update, announce=speaker.say)
    finish(result, as_json, units)
