"""The command resume: go on with a run that was interrupted or is to be longer."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.machine_run import finish as finish_shaft
from lambda_cli.machine_run import seconds, tell
from lambda_cli.options import JsonOption, Units, UnitsOption
from lambda_cli.run import DurationOption, WallOption, finish, limits
from lambda_cli.talk import ProgressOption, QuietOption, Style, talk


def resume(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Result file of the run, or the folder of a shaft's.")],
    duration: DurationOption = None,
    max_wall: WallOption = None,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Continue a run from its last checkpoint, with the same results as without the interruption.

    Works after Ctrl+C, a kill, a full disk or the limit of wall time. --duration makes a
    finished run longer. --max-wall applies to this session; the earlier limit is discarded.
    Exit codes as for run.
    """
    from lambda_core import api

    if api.is_shaft_run(file):
        with talk(progress, quiet) as speaker:
            found = api.shaft_resume(
                file, duration=seconds("--duration", duration), max_wall=seconds("--max-wall", max_wall),
                progress=speaker.update, announce=speaker.say,
            )  # fmt: skip
        tell(found, as_json=as_json)
        finish_shaft(found)
        return
    if api.is_shaft_run(file.parent) and file.suffix == ".h5":
        raise api.UsageError(f"{file} belongs to the run of a shaft: lambda-bearing resume {file.parent}")
    with talk(progress, quiet) as speaker:
        for line in api.result(file).headline.splitlines():
            speaker.say(units.system.sentence(line))
        result = api.resume(file, limits(duration, max_wall), progress=speaker.update, announce=speaker.say)
    finish(result, as_json, units)
