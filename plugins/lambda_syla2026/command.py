"""Repeat the published experiments."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from lambda_cli.options import JsonOption
from lambda_cli.talk import ProgressOption, QuietOption, Style, talk


def reproduce(
    what: Annotated[
        str,
        typer.Argument(metavar="table4|anchors|fig5|fig7|all", help="Which experiment of the paper, or the catalogue."),
    ],
    out: Annotated[
        Path, typer.Option("--out", metavar="DIR", help="Folder of figures, page, and all that was computed.")
    ] = Path("reproduction"),
    quick: Annotated[bool, typer.Option("--quick", help="Run fewer cases and list the omitted ones.")] = False,
    workers: Annotated[
        int | None, typer.Option("--workers", min=1, metavar="N", help="Processes; default: up to 4.")
    ] = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Repeat experiments of Syla et al. 2026.

    It compares them with the printed values of Lubricants 14, 154.

    table4: friction torque of the 6319, blind and calibrated; anchors: friction of other bearings against SKF's model;
    fig5: limits of axial excitation of the 6220; fig7: capacitance of the 6208. The command writes figures (SVG, PNG)
    and one HTML page. A second call continues where the first one ended. A point without a result is marked failed; the
    exit code is then 5.
    """
    from lambda_core.domain.errors import PartialResultError
    from lambda_syla2026 import reproduce as repeat

    with talk(progress, quiet) as speaker:
        found = repeat(what, out, workers=workers, quick=quick, progress=speaker.update, announce=speaker.say)
    if not as_json:
        typer.echo(found.text())
    else:
        data = json.loads(found.model_dump_json())  # what a point without a result would have is null there
        if what != "all":
            data = data[what] | {name: data[name] for name in ("files", "effort", "failed")}
        typer.echo(json.dumps(data, indent=2))
    lost = [sentence for sentences in found.failed.values() for sentence in sentences]
    if lost:
        raise PartialResultError(
            f"{len(lost)} points have no result: {lost[0]}; change or leave out that point, or call again to retry it"
        )
