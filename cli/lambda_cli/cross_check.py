"""Define the command cross-check."""

from __future__ import annotations

from typing import Annotated

import typer

from lambda_cli.options import BearingOption, CaseArgument, JsonOption, SetOption
from lambda_cli.run import DurationOption, limits
from lambda_cli.talk import ProgressOption, QuietOption, Style, talk


def cross_check(
    case: CaseArgument,
    changes: SetOption = None,
    bearing: BearingOption = None,
    free_cage: Annotated[
        bool, typer.Option("--free-cage", help="Leave the cage free and compare mean powers, not trajectories.")
    ] = False,
    duration: DurationOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Compare the program's integrator with SUNDIALS CVODE.

    Both integrate one case.

    The cage follows its kinematic path: a free cage moves chaotically, and trajectories could not be compared.
    --free-cage compares mean dissipated powers instead. The command needs the extra "sundials". Exit code 5 when the
    two do not agree: power within 0.02 % and states within 10 tolerances; cage free: power within the joint 95 %
    interval, or 0.02 %.
    """
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        found = api.cross_check(
            case,
            [*(changes or ()), *limits(duration, None)],
            free_cage=free_cage,
            bearing=bearing,
            announce=speaker.say,
        )
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text())
    if not found.agree:
        raise typer.Exit(5)
