"""Define the command animate."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from lambda_cli.options import BearingOption, ForceOption
from lambda_cli.talk import QuietOption


def animate(
    source: Annotated[Path, typer.Argument(metavar="RESULT", help="Result file.")],
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="FILE", help="File to write, .gif, .mp4 or .glb; default: RESULT.gif."),
    ] = None,
    turns: Annotated[float, typer.Option("--turns", metavar="N", help="Revolutions of the cage to show.")] = 1.0,
    start: Annotated[
        float | None, typer.Option("--start", metavar="S", help="Start time in seconds; default: the last turns.")
    ] = None,
    frames: Annotated[int, typer.Option("--frames", metavar="N", help="Number of frames.")] = 120,
    fps: Annotated[float, typer.Option("--fps", metavar="N", help="Frames per second when played.")] = 25.0,
    bearing: BearingOption = None,
    force: ForceOption = False,
    quiet: QuietOption = False,
) -> None:
    """Show balls, cage and load vectors in motion.

    MP4 needs the extra `animation`, which brings an encoder; GIF and glTF (for viewers of three dimensions) need
    nothing. The command writes the file and prints its name.
    """
    from lambda_core import api

    shown = not quiet and sys.stderr.isatty()

    def progress(done: int, total: int) -> None:
        typer.echo(f"\r{done} of {total} frames", err=True, nl=done == total)

    path = api.animate(
        source, out, bearing=bearing, turns=turns, start=start, frames=frames, fps=fps, overwrite=force,
        progress=progress if shown else None,
    )  # fmt: skip
    typer.echo(str(path))
