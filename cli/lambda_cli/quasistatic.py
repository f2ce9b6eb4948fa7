"""The command quasistatic: the equilibrium of a case, without time."""

from __future__ import annotations

import typer

from lambda_cli.options import CaseArgument, JsonOption, SetOption, Units, UnitsOption
from lambda_cli.talk import ProgressOption, QuietOption, Style, columns, talk


def quasistatic(
    case: CaseArgument,
    changes: SetOption = None,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Solve loads, contact angles, films and friction of a case at t = 0, without time and cage."""
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        found = api.quasistatic(case, changes or (), announce=speaker.say)
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text(columns(), units.system))
