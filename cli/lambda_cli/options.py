"""Arguments and options that several commands share, declared once."""

from __future__ import annotations

from typing import Annotated

import typer

CaseArgument = Annotated[str, typer.Argument(metavar="CASE", help="Case file (TOML) or name of a built-in case.")]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="PATH=VALUE", help='Change an option, for example --set loads.radial="20 kN".'),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object instead of text.")]
ForceOption = Annotated[bool, typer.Option("--force", help="Overwrite an existing file.")]
