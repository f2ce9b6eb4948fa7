"""Define the command electric."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import (
    BearingOption,
    CaseArgument,
    ExecutorOption,
    ForceOption,
    JsonOption,
    SetOption,
    Units,
    UnitsOption,
    WorkersOption,
)
from lambda_cli.talk import ProgressOption, QuietOption, Style, json_text, talk
from lambda_core.domain.errors import PartialResultError, UsageError
from lambda_core.domain.files import check_folder

SourceArgument = Annotated[
    str, typer.Argument(metavar="CASE|RESULT", help="Case file, name of a built-in case, or result file of a run.")
]


def electric(
    source: SourceArgument,
    changes: SetOption = None,
    udc: Annotated[str | None, typer.Option("--udc", metavar="VOLTAGE", help='Dc-link voltage, e.g. "800V".')] = None,
    fsw: Annotated[
        str | None, typer.Option("--fsw", metavar="FREQUENCY", help='Switching frequency, e.g. "10kHz".')
    ] = None,
    rise_time: Annotated[
        str | None, typer.Option("--rise-time", metavar="TIME", help='Rise time of an edge, e.g. "50ns".')
    ] = None,
    duration: Annotated[
        str | None, typer.Option("--duration", metavar="TIME", help='Simulated time, e.g. "1s".')
    ] = None,
    seed: Annotated[int | None, typer.Option("--seed", metavar="N", help="Seed of the random numbers.")] = None,
    out: Annotated[Path | None, typer.Option("--out", metavar="FILE", help="Table of discharges, .csv or .h5.")] = None,
    force: ForceOption = False,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Compute bearing voltage, discharges and impedance.

    The bearing is part of the circuit of an electric machine.

    The section electric of the case describes the circuit; the command lists the defaults that it uses. The films are
    those of quasi-static equilibria for a case, and those of the run for a result. All bearings of a machine are part
    of one circuit between shaft and frame.
    """
    from lambda_core import api

    short = {"inverter.dc_link": udc, "inverter.switching_frequency": fsw, "inverter.rise_time": rise_time}
    short |= {"duration": duration, "seed": None if seed is None else str(seed)}
    overrides = [f"electric.{path}={value}" for path, value in short.items() if value is not None]
    if out is not None:
        api.check_discharges_file(out, overwrite=force)
        if out.exists() and Path(source).exists() and out.samefile(source):
            raise UsageError(f"{out} is the input file: choose another name with --out")
    with talk(progress, quiet) as speaker:
        found = api.electric(source, [*(changes or ()), *overrides], announce=speaker.say)
    if out is not None:
        api.write_discharges(found, out, overwrite=force)
    typer.echo(json_text(found.outcome.to_dict()) if as_json else units.system.sentence(found.outcome.text()))


def film(
    case: CaseArgument,
    measured: Annotated[
        Path,
        typer.Argument(metavar="CSV", help='Columns "time" and "capacitance".'),
    ],
    changes: SetOption = None,
    bearing: BearingOption = None,
    frequency: Annotated[str | None, typer.Option("--frequency", metavar="F", help="Of a measured impedance.")] = None,
    uncertainty: Annotated[float, typer.Option("--uncertainty", metavar="SHARE", help="Of the capacitance.")] = 0.02,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Find film thickness and starvation from a measurement.

    The measured quantity is a capacitance or an impedance.
    """
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        found = api.film_from_capacitance(
            case,
            measured,
            changes or (),
            bearing=bearing,
            frequency=frequency,
            uncertainty=uncertainty,
            announce=speaker.say,
        )
    typer.echo(found.model_dump_json(indent=2) if as_json else units.system.sentence(found.text()))


def risk_map(
    source: Annotated[
        str,
        typer.Argument(
            metavar="CASE|FOLDER",
            help="Case file or name of a built-in case; or the folder of a map, to continue it.",
        ),
    ],
    changes: SetOption = None,
    bearing: BearingOption = None,
    speed: Annotated[
        str | None, typer.Option("--speed", metavar="FROM,TO", help='Of the inner ring, "500 rpm, 10000 rpm".')
    ] = None,
    temperature: Annotated[
        str, typer.Option("--temperature", metavar="FROM,TO", help="Of oil and parts.")
    ] = "20 degC, 110 degC",
    points: Annotated[str, typer.Option("--points", metavar="NxM", help="Speeds times temperatures.")] = "20x10",
    folder: Annotated[
        Path | None,
        typer.Option("--folder", metavar="FOLDER", help="Store the map as a study; the same command continues it."),
    ] = None,
    workers: WorkersOption = None,
    executor: ExecutorOption = "processes",
    out: Annotated[
        Path | None, typer.Option("--out", metavar="FILE", help="Write every number to a .csv file.")
    ] = None,
    draw: Annotated[
        Path | None, typer.Option("--draw", metavar="DIR", help="Also write pictures (svg and png) into this folder.")
    ] = None,
    force: ForceOption = False,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Map the discharges over speed and temperature, with quasi-static films.

    The section electric of the case describes the circuit, with all bearings of a machine; --bearing selects the one
    to map. Speeds have equal ratios; without --speed they range from a tenth to twice the speed of the case. With
    --folder the map is a study: after an interruption, lambda-bearing electric-map FOLDER computes the missing points.
    Exit code 5 when points have no answer; the table and the file name them with the reason.
    """
    from lambda_core import api

    if draw is not None:
        check_folder(draw, made=True)
    with talk(progress, quiet) as speaker:
        found = api.electric_map(
            source,
            changes or (),
            speed=speed,
            temperature=temperature,
            points=points,
            out=out,
            overwrite=force,
            folder=folder,
            bearing=bearing,
            executor=executor,
            workers=workers,
            progress=speaker.update,
            announce=speaker.say,
        )
    typer.echo(found.model_dump_json(indent=2) if as_json else units.system.sentence(found.text()))
    if draw is not None:
        for path in api.draw(found.picture(), draw, found.case):
            typer.echo(str(path), err=True)
    if empty := sum(bool(point.message) for point in found.points):
        raise PartialResultError(f"{empty} of {len(found.points)} points of the map have no answer")
