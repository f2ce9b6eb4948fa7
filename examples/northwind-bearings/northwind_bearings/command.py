"""Define the command `lambda-bearing northwind`."""

import json
from contextlib import closing
from typing import Annotated

import typer

app = typer.Typer(help="Bearings of Northwind.")


@app.command()
def bearings(
    bore: Annotated[float | None, typer.Option(help="Only this bore in mm.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object instead of text.")] = False,
) -> None:
    """List the bearings of Northwind."""
    from lambda_core import api

    with closing(api.catalogue()) as catalogue:
        rows = [row for row in catalogue.bearings("Northwind", limit=1000) if row.maker == "Northwind"]
    if bore is not None:
        rows = [row for row in rows if abs(row.bore_diameter.value * 1e3 - bore) < 1e-6]
    table = [
        {
            "designation": row.designation,
            "bore_mm": round(row.bore_diameter.value * 1e3, 6),
            "dynamic_rating_kN": round(row.dynamic_rating.value / 1e3, 6),
        }
        for row in rows
    ]
    if as_json:
        typer.echo(json.dumps({"version": 1, "bearings": table}))
        return
    for line in table:
        typer.echo(f"{line['designation']:<8} bore {line['bore_mm']:g} mm   C {line['dynamic_rating_kN']:g} kN")
