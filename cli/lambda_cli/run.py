"""Define the command run."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lambda_cli.options import BandOption, Bands, CaseArgument, JsonOption, SetOption, Units, UnitsOption
from lambda_cli.plugin_option import taken_options
from lambda_cli.talk import ProgressOption, QuietOption, Style, columns, talk

if TYPE_CHECKING:
    from lambda_core.api import Result

OutOption = Annotated[
    Path | None, typer.Option("--out", metavar="FILE", help="Result file; default: name of the case, numbered.")
]
DurationOption = Annotated[
    str | None,
    typer.Option("--duration", metavar="TIME", help='Simulated time, for example "0.5 s"; default: until converged.'),
]
WallOption = Annotated[
    str | None, typer.Option("--max-wall", metavar="TIME", help='Stop after this wall time, for example "10 min".')
]


def run(
    case: CaseArgument,
    changes: SetOption = None,
    out: OutOption = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite an existing result file.")] = False,
    duration: DurationOption = None,
    max_wall: WallOption = None,
    band: BandOption = Bands.MODEL,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Simulate a case and write its result.

    The run starts from the quasi-static equilibrium.

    Without --duration the run ends when the friction torque is known to 1 % (95 % confidence),
    after one discarded and at least four averaged cage revolutions. Ctrl+C keeps the results so far;
    lambda-bearing resume FILE continues the run. Exit codes: 0 converged, 3 invalid case, 4 the solver
    failed, 5 not converged or stopped early (the program prints the reason), 130 interrupted.
    """
    from lambda_db.recent import remember

    from lambda_core import api

    remember(case)
    overrides = [*(changes or ()), *limits(duration, max_wall)]
    model = api.check(case, overrides)
    with talk(progress, quiet) as speaker:
        for line in api.describe(model).headline:
            speaker.say(units.system.sentence(line))
        wanted = band is Bands.MODEL
        result = api.run(model, out=out, overwrite=force, band=wanted, progress=speaker.update, announce=speaker.say)
    finish(result, as_json, units)


def limits(duration: str | None, max_wall: str | None) -> list[str]:
    """Return the overrides that the options mean."""
    found = {"solver.duration": duration, "solver.max_wall": max_wall}
    return [f"{path}={value}" for path, value in found.items() if value is not None]


def finish(result: Result, as_json: bool, units: Units) -> None:
    """Print the summary and end with its code.

    The state of the result decides the exit code.
    """
    from lambda_core.domain.errors import PartialResultError
    from lambda_core.domain.plugin_errors import PluginError

    summary = result.summary()
    typer.echo(summary.model_dump_json(indent=2) if as_json else summary.text(columns(), units.system))
    if summary.state == "interrupted":
        typer.echo(f"interrupted; continue with: lambda-bearing resume {result.path}{taken_options()}", err=True)
        raise typer.Exit(130)
    if not summary.converged:
        raise PartialResultError(f"not converged: {'; '.join(summary.reasons)}")
    if summary.plugin_faults:
        raise PluginError("; ".join(summary.plugin_faults))
