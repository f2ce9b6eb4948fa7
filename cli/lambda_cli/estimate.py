"""Define the command estimate."""

from __future__ import annotations

import typer

from lambda_cli.options import CaseArgument, JsonOption, SetOption
from lambda_cli.run import DurationOption, limits
from lambda_cli.talk import ProgressOption, QuietOption, Style, talk


def estimate(
    case: CaseArgument,
    changes: SetOption = None,
    duration: DurationOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Estimate the processor time of a run.

    The first moments of the run are computed, a twentieth of a cage turn and two seconds at most. Without --duration
    the run is the shortest that can converge. --json adds the equilibrium and its rating lives.
    """
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        found = api.estimate(case, [*(changes or ()), *limits(duration, None)], announce=speaker.say)
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text())
