"""Declare arguments and options that several commands share."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from lambda_core.domain.unit_systems import UnitSystem


class Units(StrEnum):
    """In which units numbers are printed."""

    SI = "si"
    US = "us"

    @property
    def system(self) -> UnitSystem:
        """The units themselves."""
        from lambda_core.domain.unit_systems import unit_system

        return unit_system(self.value)


class Bands(StrEnum):
    """Bands to compute with a result."""

    MODEL = "model"
    NONE = "none"


CaseArgument = Annotated[str, typer.Argument(metavar="CASE", help="Case file (TOML) or name of a built-in case.")]
SetOption = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="PATH=VALUE", help='Change an option, for example --set loads.radial="20 kN".'),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object instead of text.")]
UnitsOption = Annotated[
    Units,
    typer.Option(
        "--units",
        envvar="LAMBDA_BEARING_UNITS",
        show_envvar=False,
        help="Units of the output; LAMBDA_BEARING_UNITS=us changes the default. Files and --json stay in SI.",
    ),
]
BandOption = Annotated[
    Bands,
    typer.Option("--band", help="model: also compute the 90 % model band; none: skip it and save a second."),
]
BearingOption = Annotated[str | None, typer.Option("--bearing", metavar="NAME", help="Bearing of a machine.")]
OverlayOption = Annotated[
    Path | None,
    typer.Option(
        "--measured", metavar="FILE.csv", help='Measured points for the pictures, in columns such as "speed [1/min]".'
    ),
]
ForceOption = Annotated[bool, typer.Option("--force", help="Overwrite an existing file.")]
WorkersOption = Annotated[
    int | None, typer.Option("--workers", min=1, metavar="N", help="Processes; default: every processor.")
]
ExecutorOption = Annotated[
    str,
    typer.Option(
        "--executor",
        metavar="WHERE",
        help="processes, here (this process), dask (a cluster on this machine), or a dask scheduler: address or file.",
    ),
]
