"""Define the command study: run, resume, watch and read."""

from __future__ import annotations

import csv
import json
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lambda_cli.options import (
    BandOption,
    Bands,
    ExecutorOption,
    ForceOption,
    JsonOption,
    Units,
    UnitsOption,
    WorkersOption,
)
from lambda_cli.plugin_option import taken_options
from lambda_cli.talk import ProgressOption, QuietOption, Style, talk
from lambda_core.domain.printable import cell_text, printable

if TYPE_CHECKING:
    from lambda_core.api import StudyStatus
    from lambda_core.domain.unit_systems import UnitSystem
    from lambda_core.views.table import StudyTable

app = typer.Typer(no_args_is_help=True, add_completion=False, help="Evaluate a case over many operating points.")

FolderArgument = Annotated[Path, typer.Argument(metavar="FOLDER", help="Folder of a study.")]


@app.command()
def init(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Name of the new study.")],
    start: Annotated[
        str | None,
        typer.Option(
            "--from",
            metavar="STUDY",
            help="friction-map (default), warm-and-tight, what-decides, risk-map or cage-stability; of machines: "
            "machine-map.",
        ),
    ] = None,
    case: Annotated[
        str | None,
        typer.Option("--case", metavar="CASE", help="Built-in case or case file to study; check the ranges, too."),
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", metavar="FILE", help="File to write; default: NAME.toml.")
    ] = None,
    force: ForceOption = False,
) -> None:
    """Write a commented study file to start from.

    friction-map: friction over speed and load, 500 points; warm-and-tight: the least friction that film and pressure
    allow, a search; what-decides: which parameter decides, Sobol' indices; risk-map: bearing currents over speed and
    temperature, 200 points; cage-stability: where the cage turns steadily, 16 runs. machine-map is for machines: life
    and losses over speed and temperature, 60 points.
    """
    from lambda_core import api

    target = api.init_study(name, start, out, overwrite=force, case=case)
    typer.echo(f"wrote {target}; next: lambda-bearing study run {target} --dry-run", err=True)


@app.command()
def run(
    study: Annotated[Path, typer.Argument(metavar="STUDY", help="Study file (TOML).")],
    out: Annotated[
        Path | None, typer.Option("--out", metavar="FOLDER", help="Folder to create; default: the study's name.")
    ] = None,
    workers: WorkersOption = None,
    executor: ExecutorOption = "processes",
    band: BandOption = Bands.MODEL,
    dry: Annotated[bool, typer.Option("--dry-run", help="Check the study and estimate its time; run nothing.")] = False,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Run a study and store it in a folder.

    Ctrl+C keeps the finished points; lambda-bearing study resume FOLDER continues. Exit codes: 0 every point has
    a result, 2 the study is too large or cannot be written, 3 it is invalid, 5 points failed or have not converged,
    130 interrupted.
    """
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        if dry:
            estimate = api.study_check(study, workers=workers, announce=speaker.say)
        else:
            status = api.study_run(
                study,
                out,
                executor=executor,
                workers=workers,
                band=band is Bands.MODEL,
                progress=speaker.update,
                announce=speaker.say,
            )
    if dry:
        typer.echo(estimate.model_dump_json(indent=2) if as_json else estimate.text())
        return
    _finish(status, as_json)


@app.command()
def resume(
    folder: FolderArgument,
    retry: Annotated[bool, typer.Option("--retry", help="Repeat failed points.")] = False,
    workers: WorkersOption = None,
    executor: ExecutorOption = "processes",
    as_json: JsonOption = False,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Continue an interrupted study: compute the missing points."""
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        status = api.study_resume(folder, executor=executor, workers=workers, retry=retry, progress=speaker.update)
    _finish(status, as_json)


@app.command()
def status(folder: FolderArgument, as_json: JsonOption = False) -> None:
    """Print the progress of a study, also while it runs."""
    from lambda_core import api

    found = api.study_status(folder)
    typer.echo(found.model_dump_json(indent=2) if as_json else printable(found.text()))


@app.command()
def show(
    folder: FolderArgument,
    as_csv: Annotated[bool, typer.Option("--csv", help="Print comma-separated values.")] = False,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
) -> None:
    """Print the table of a study.

    It has parameters, responses and the state of every point.
    """
    from lambda_core import api

    table = api.study_table(folder)
    if as_json:
        data = {"version": 1, "name": table.name, "mode": table.mode, "design": table.design}
        typer.echo(
            json.dumps(
                {**data, "units": table.units(), "points": [_finite(row) for row in table.rows()]},
                indent=2,
                allow_nan=False,
            )
        )
    elif as_csv:
        _csv(table)
    else:
        _print(table, units.system)


@app.command()
def schema() -> None:
    """Print the JSON schema of study files, for editors."""
    from lambda_core import api

    typer.echo(json.dumps(api.study_schema(), indent=2))


def _finish(status: StudyStatus, as_json: bool) -> None:
    """Print the state of a study and exit.

    The state decides the exit code.
    """
    from lambda_core.domain.errors import PartialResultError

    typer.echo(status.model_dump_json(indent=2) if as_json else printable(status.text()))
    resume = f"continue with: lambda-bearing study resume {status.folder}{taken_options()}"
    if status.interrupted:
        typer.echo(f"interrupted; {resume}", err=True)
        raise typer.Exit(130)
    if status.pending:
        raise PartialResultError(f"{status.pending} of {status.points} points wait for another process; {resume}")
    lacks = [(status.failed, "have no result"), (status.partial, "have not converged")]
    short = [f"{count} of {status.points} points {what}" for count, what in lacks if count]
    if short:
        raise PartialResultError("; ".join(short))


def _csv(table: StudyTable) -> None:
    from lambda_core.views.table import BAND

    units = table.units()
    rows = table.rows()
    writer = csv.writer(sys.stdout, lineterminator="\n")
    names = ["point", *units, "state", "reason", "file"]
    banded = [column for column in table.responses if column.band]
    heads = [printable(f"{name} [{units[name]}]" if units.get(name) else name) for name in names]
    ends = [f"{column.name}{BAND}_{end} [{column.unit}]" for column in banded for end in ("low", "high")]
    writer.writerow([*heads, *map(printable, ends)])
    for index, row in enumerate(rows):
        pairs = (column.band[index] or ("", "") for column in banded)
        writer.writerow([*(_written(row[name]) for name in names), *(end for pair in pairs for end in pair)])


def _written(value: object) -> object:
    return "" if value is None else cell_text(printable(value)) if isinstance(value, str) else value


def _finite(row: dict[str, Any]) -> dict[str, Any]:
    """Return a row without infinity for JSON.

    There is no number where there is none.
    """
    return {key: None if isinstance(v, float) and not math.isfinite(v) else v for key, v in row.items()}


def _print(table: StudyTable, units: UnitSystem) -> None:
    """Print the columns that fit a terminal.

    The parts of the friction torque are in --csv and --json.
    """
    from rich.console import Console
    from rich.table import Table

    columns = [*table.parameters, *(c for c in table.responses if not c.is_part)]
    shown = Table(box=None, pad_edge=False, header_style="bold")
    shown.add_column("point", justify="right")
    for column in columns:
        text = printable(column.label) + (f"\n[{units.unit(column.unit)}]" if column.unit else "")
        shown.add_column(text.replace("[", "\\["), justify="right", max_width=14)
        if column.band:
            shown.add_column("90 % model\nband", justify="right")
    shown.add_column("state")
    for index, row in enumerate(table.rows()):
        cells = []
        for column in columns:
            cells.append(column.text(index, units) or _cell(row[column.name], column.unit, units))
            cells += [column.band_text(index, units)] if column.band else []
        shown.add_row(str(index + 1), *cells, row["state"], style="dim" if row["state"] == "failed" else None)
    Console(width=None if sys.stdout.isatty() else 240, highlight=False).print(shown)


def _cell(value: float | str | None, unit: str, units: UnitSystem) -> str:
    if value is None:
        return "-"
    return printable(units.sentence(value)) if isinstance(value, str) else f"{units.value(value, unit):.5g}"
