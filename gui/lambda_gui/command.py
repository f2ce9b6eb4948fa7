"""The command gui: the model builder in the terminal, or served to a browser."""

from __future__ import annotations

from typing import Annotated

import typer


def gui(
    case: Annotated[
        str | None, typer.Argument(metavar="[CASE]", help="Case file (TOML) or built-in case; asks without one.")
    ] = None,
) -> None:
    """Build cases, run them and look at results in the terminal."""
    from lambda_gui.app import main

    main(case)
