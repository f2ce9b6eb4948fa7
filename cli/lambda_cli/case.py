"""Define the commands init, check and schema."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lambda_cli.options import CaseArgument, ForceOption, JsonOption, SetOption, Units, UnitsOption
from lambda_cli.talk import columns
from lambda_core.domain.wrapping import wrapped

if TYPE_CHECKING:
    from lambda_core.api import BearingModel, MachineModel
    from lambda_core.domain.errors import Problem

FileOption = Annotated[
    Path | None, typer.Option("--out", metavar="FILE", help="Where to write; default: standard output.")
]


def init(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Name of the new case.")],
    start: Annotated[
        str | None,
        typer.Option(
            "--from", metavar="CASE", help="Built-in case or case file to start from; default: 6319-cp10-1500."
        ),
    ] = None,
    bearing: Annotated[
        str | None,
        typer.Option(
            "--bearing", metavar="DESIGNATION", help='Start from a bearing of the catalogue: "SKF 6208-2RS1/C3".'
        ),
    ] = None,
    template: Annotated[
        str | None,
        typer.Option(
            "--template",
            metavar="NAME",
            help="Start from a template: a shaft in two bearings (geared-shaft, motor-shaft, tapered-shaft), or one "
            "bearing with the usual loads and oil of an electric-motor, gearbox-shaft, spindle, pump, wheel or "
            "thin-housing; --bearing selects it.",
        ),
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", metavar="FILE", help="File to write; default: NAME.toml.")
    ] = None,
    radial: Annotated[
        str | None, typer.Option("--radial", metavar="FORCE", help="With --bearing: radial load.")
    ] = None,
    axial: Annotated[str | None, typer.Option("--axial", metavar="FORCE", help="With --bearing: axial load.")] = None,
    speed: Annotated[
        str | None, typer.Option("--speed", metavar="SPEED", help="With --bearing: speed of the inner ring.")
    ] = None,
    oil: Annotated[str | None, typer.Option("--oil", metavar="NAME", help="With --bearing: lubricant.")] = None,
    temperature: Annotated[
        str | None, typer.Option("--temperature", metavar="TEMPERATURE", help="With --bearing: lubricant temperature.")
    ] = None,
    as_machine: Annotated[
        bool,
        typer.Option(
            "--as-machine", help="Write one bearing as a machine: it can have gears, discs, connections and a shaft."
        ),
    ] = False,
    force: ForceOption = False,
) -> None:
    """Write a commented case file to start from."""
    from lambda_db.recent import remember

    from lambda_core import api

    given = {"loads.radial": radial, "loads.axial": axial, "operation.speed": speed}
    given |= {"lubricant.name": oil, "lubricant.temperature": temperature}
    changes = [f"{path}={value}" for path, value in given.items() if value is not None]
    if any(mark in name for mark in "/\\"):
        raise api.UsageError(f'"{name}" is a path: give a name alone, and the file with --out "{name}"')
    name = name.removesuffix(".toml")  # whoever names the file means the case in it
    target = api.init_case(
        name, start, out, overwrite=force, bearing=bearing, template=template, changes=changes, as_machine=as_machine
    )
    remember(target)
    typer.echo(f"wrote {target}; next: lambda-bearing check {target}", err=True)


def check(
    case: CaseArgument,
    changes: SetOption = None,
    everything: Annotated[
        bool, typer.Option("--all", help="Also print laws, and every assumption with its source.")
    ] = False,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
) -> None:
    """Check a case: errors, model, warnings and assumptions."""
    from lambda_db.recent import remember

    from lambda_core import api

    remember(case)
    try:
        model = api.check(case, changes or ())
        if faults := _faults(model):
            raise api.CaseError(model.name, faults)
        report = api.describe(model)
    except api.CaseError as error:
        if not as_json:
            raise
        problems = [{"where": problem.where, "message": problem.message} for problem in error.problems]
        typer.echo(json.dumps({"version": 1, "valid": False, "source": error.source, "errors": problems}, indent=2))
        raise typer.Exit(error.exit_code) from None
    if as_json:
        typer.echo(json.dumps(report.model_dump(mode="json"), indent=2, allow_nan=False))
        return
    typer.echo("\n".join(wrapped(units.system.sentence(report.text(everything)).splitlines(), columns())))


def _faults(model: BearingModel | MachineModel) -> list[Problem]:
    """Return the mistakes of laws, observers and events.

    A case without observers and events loads no solver.
    """
    from lambda_core import api

    bearings = model.bearing_models.values()
    found = dict.fromkeys(fault for one in bearings for fault in api.law_problems(one))
    watched = api.watch_problems(model) if any(one.observers or one.events for one in bearings) else []
    return list(found | dict.fromkeys(watched))


def schema(out: FileOption = None) -> None:
    """Print the JSON schema of case files, for editors."""
    from lambda_core import api
    from lambda_core.domain.files import check_target

    text = json.dumps(api.schema(), indent=2)
    if out is None:
        typer.echo(text)
    else:
        try:
            check_target(out).write_text(text + "\n", encoding="utf-8")
        except OSError as error:
            raise api.UsageError(f'cannot write "{out}": {error.strerror}') from None
        typer.echo(f"wrote {out}", err=True)
