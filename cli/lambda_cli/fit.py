"""Define the command fit."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import (
    BearingOption,
    CaseArgument,
    ForceOption,
    JsonOption,
    SetOption,
    Units,
    UnitsOption,
    WorkersOption,
)
from lambda_cli.talk import ProgressOption, QuietOption, Style, columns, talk
from lambda_core.domain.errors import PartialResultError, UsageError
from lambda_core.domain.files import check_folder, check_new

MeasuredArgument = Annotated[
    Path, typer.Argument(metavar="DATA.csv", help='Measured points; columns such as "speed [1/min]".')
]
VaryOption = Annotated[
    list[str],
    typer.Option(
        "--vary",
        metavar="PATH[=LOW..HIGH]",
        help='Parameter to fit, "loss_factor" or "tau_eyring=3 MPa..10 MPa"; may be repeated.',
    ),
]


def fit(
    case: CaseArgument,
    measured: MeasuredArgument,
    vary: VaryOption,
    changes: SetOption = None,
    bearing: BearingOption = None,
    predict: Annotated[
        Path | None,
        typer.Option("--predict", metavar="OTHER.csv", help="Predict measured points that the fit does not use."),
    ] = None,
    sample: Annotated[
        int, typer.Option("--sample", metavar="N", help="Also draw so many samples of the posterior (emcee).")
    ] = 0,
    out: Annotated[
        Path | None, typer.Option("--out", metavar="FILE", help="Write a case file with the fitted values.")
    ] = None,
    rows: Annotated[bool, typer.Option("--rows", help="Also store the measured values in that file.")] = False,
    draw: Annotated[
        Path | None, typer.Option("--draw", metavar="DIR", help="Write pictures (svg and png) into this folder.")
    ] = None,
    report: Annotated[
        Path | None, typer.Option("--report", metavar="FILE", help="Write a page (.html or .pdf) about the fit.")
    ] = None,
    workers: WorkersOption = None,
    force: ForceOption = False,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Fit parameters of a case to measurements.

    The measurements are operating points. The report names the parameters that they determine.

    Solutions are quasi-static and without a cage. Ctrl+C keeps the best values so far.
    """
    from lambda_core import api

    if rows and out is None:
        raise UsageError("--rows stores measured values in the case of --out: name a file with --out")
    if out is not None:
        check_folder(check_new(out, force).absolute().parent, out)
    if report is not None:
        api.check_page(report, overwrite=force)
    if draw is not None:
        check_folder(draw, made=True)
    read = [one for one in (measured, predict) if one is not None and one.exists()]
    for option, path in (("--out", out), ("--report", report)):
        if path is not None and path.exists() and any(path.samefile(one) for one in read):
            raise UsageError(f"{option} {path} is the file of measurements: choose another name")
    try:
        with talk(progress, quiet) as speaker:
            found = api.fit(
                case,
                measured,
                vary,
                changes or (),
                bearing=bearing,
                predict=predict,
                sample=sample,
                workers=workers,
                progress=speaker.update,
                announce=speaker.say,
            )
    except KeyboardInterrupt:
        typer.echo("the fit was stopped before it had solved every point once: there are no values to keep", err=True)
        raise
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text(columns(), units.system))
    if out is not None:
        typer.echo(str(api.fitted_case(case, found, out, changes or (), overwrite=force, rows=rows)), err=True)
    if draw is not None:
        from lambda_core.views.other_units import in_units

        for picture in found.pictures():
            for path in api.draw(in_units(picture, units.system), draw, api.view_stem([str(case)])):
                typer.echo(str(path), err=True)
    if report is not None:
        typer.echo(str(api.report(found, report, overwrite=force, units=units.value)), err=True)
    if found.is_interrupted:
        raise PartialResultError("the fit was interrupted: the values are the best so far")
    if found.unsolved_lines:
        lines = ", ".join(map(str, found.unsolved_lines))
        raise PartialResultError(f"the fit leaves out lines of {found.file} without a solution: {lines}")
