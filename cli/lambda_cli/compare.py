"""Compare methods with each other and with a simulation."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import BearingOption, CaseArgument, JsonOption, SetOption, Units, UnitsOption
from lambda_cli.talk import ProgressOption, QuietOption, Style, talk

SIDE_BY_SIDE = "To compare results: lambda-bearing show A.h5 B.h5, or view A.h5 B.h5"


def compare(
    case: CaseArgument,
    changes: SetOption = None,
    bearing: BearingOption = None,
    method: Annotated[
        list[str] | None, typer.Option("--method", metavar="NAME", help="Only this method; may be repeated.")
    ] = None,
    result: Annotated[
        Path | None, typer.Option("--result", metavar="FILE", help="Result of the same case, as the first column.")
    ] = None,
    contamination: Annotated[
        float | None, typer.Option("--contamination", metavar="E_C", min=0.0, max=1.0, help="e_C of ISO 281, 0 to 1.")
    ] = None,
    as_json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Compare a quasi-static solution with catalogues and standards.

    The catalogue formulas and standards answer for the same case.

    They are friction by the SKF and Schaeffler models, analytical capacitance, rating life after ISO 281 and ISO/TS
    16281, loads and stiffness of the quasi-static equilibrium, and the methods of plugins.
    """
    from lambda_core import api

    if case.endswith(".h5"):
        raise api.UsageError(f"{case} is a result, compare takes a case. {SIDE_BY_SIDE}")
    with talk(progress, quiet) as speaker:
        found = api.compare(
            case,
            changes or (),
            bearing=bearing,
            methods=method or (),
            result=result,
            contamination=contamination,
            announce=speaker.say,
        )
    typer.echo(found.model_dump_json(indent=2) if as_json else found.text(units.system))
