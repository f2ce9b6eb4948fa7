"""Define the command gui."""

from __future__ import annotations

import os
import sys
from typing import Annotated

import typer


def gui(
    case: Annotated[
        str | None, typer.Argument(metavar="[CASE]", help="Case file (TOML) or built-in case; default: choose one.")
    ] = None,
    serve: Annotated[bool, typer.Option("--serve", help="Serve the builder to a browser.")] = False,
    host: Annotated[str, typer.Option("--host", metavar="ADDRESS", help="With --serve: address.")] = "localhost",
    port: Annotated[int, typer.Option("--port", min=1, max=65535, help="With --serve: port.")] = 8000,
    units: Annotated[
        str,
        typer.Option(
            "--units",
            metavar="[si|us]",
            envvar="LAMBDA_BEARING_UNITS",
            show_envvar=False,
            help="Units of the display.",
        ),
    ] = "si",
) -> None:
    """Build and run cases and view results in the terminal.

    Without CASE the builder offers an empty model, the case files of this folder and the built-in cases. With --serve
    open the printed address in a browser; Ctrl+C ends the builder.
    """
    from lambda_core.domain.unit_systems import unit_system

    system = unit_system(units)
    if not serve:
        # a server gives the builder a screen of its own kind (TEXTUAL_DRIVER)
        if not (sys.stdin.isatty() and sys.stderr.isatty()) and "TEXTUAL_DRIVER" not in os.environ:
            from lambda_core.domain.errors import UsageError

            raise UsageError("the builder needs a terminal; lambda-bearing gui --serve shows it in a browser")
        from lambda_gui.app import main

        main(case, system)
        return
    from lambda_gui.serve import serve as start
    from lambda_gui.serve import warning

    if text := warning(host):
        typer.echo(f"warning: {text}", err=True)

    def announce(address: str) -> None:
        typer.echo(
            f"serving the builder at {address} (the address lets in: do not pass it on); end it with Ctrl+C", err=True
        )

    os.environ["LAMBDA_BEARING_UNITS"] = system.name  # each tab is a builder of its own
    start(case, host, port, announce)
