"""Run a machine of several bearings into a folder, and show how a run ended."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from lambda_cli.talk import Style, columns, talk

if TYPE_CHECKING:
    from lambda_core.api import WholeSummary


def run_machine(
    case: str, changes: list[str], out: Path | None, *, force: bool, duration: str | None, max_wall: str | None,
    as_json: bool, quiet: bool, progress: Style,
) -> None:  # fmt: skip
    """Simulate, say what came out, and end as it ended."""
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        found = api.shaft_run(
            api.check_shaft(case, changes), out=out, force=force, duration=seconds("--duration", duration),
            max_wall=seconds("--max-wall", max_wall), progress=speaker.update, announce=speaker.say,
        )  # fmt: skip
    tell(found, as_json=as_json)
    finish(found)


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
