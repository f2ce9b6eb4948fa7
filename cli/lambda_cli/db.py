"""Define the commands `lambda-bearing db`."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lambda_cli.db_text import list_bearings, list_lubricants, print_json, show_bearing, show_lubricant, show_plain
from lambda_cli.options import JsonOption, Units, UnitsOption
from lambda_cli.talk import ProgressOption, QuietOption, Style, talk

if TYPE_CHECKING:
    from lambda_db.catalogue import SqlCatalogue
    from lambda_db.presentation import AnyBearing
    from lambda_db.transfer import ImportReport

    from lambda_core.api import Registry

app = typer.Typer(
    no_args_is_help=True, add_completion=False, help="Search and edit the catalogue of bearings, oils and materials."
)

_TABLES = "source, alias, bearing, clearance, material, cage, lubricant, lubricant_property, lubricant_parameter"
TableOption = Annotated[str | None, typer.Option("--table", metavar="TABLE", help=f"One of {_TABLES}.")]
ReplaceOption = Annotated[bool, typer.Option("--replace", help="Replace your own rows that have the same key.")]


@contextmanager
def _opened() -> Iterator[tuple[SqlCatalogue, Registry]]:
    """Open the catalogue with the rows of every plugin."""
    from lambda_db.catalogue import SqlCatalogue

    from lambda_core.api import registry
    from lambda_core.domain.errors import UsageError

    models = registry()
    catalogue = models.catalogue()
    try:
        if not isinstance(catalogue, SqlCatalogue):
            raise UsageError(
                "the catalogue comes from another plugin: edit it there, this command edits the built-in one only"
            )
        yield catalogue, models
    finally:
        catalogue.close()


@app.command()
def search(
    words: Annotated[
        list[str] | None,
        typer.Argument(metavar="[WORD]...", help='Designation, maker, series or a dimension; or "d=40", "C>30".'),
    ] = None,
    bore: Annotated[float | None, typer.Option(help="Bore in mm.")] = None,
    outside: Annotated[float | None, typer.Option(help="Outside diameter in mm.")] = None,
    width: Annotated[float | None, typer.Option(help="Width in mm.")] = None,
    series: Annotated[str | None, typer.Option(help="Dimension series, for example 62.")] = None,
    maker: Annotated[str | None, typer.Option(help="Maker.")] = None,
    rating: Annotated[float | None, typer.Option(help="Least dynamic load rating C in kN.")] = None,
    lubricants: Annotated[bool, typer.Option("--lubricants", help="Search the oils instead.")] = False,
    limit: Annotated[int, typer.Option(min=1, max=1_000_000, help="Most rows to show.")] = 50,
    json: JsonOption = False,
) -> None:
    """List the bearings (or oils) that match every word."""
    options = {"d=": bore, "D=": outside, "B=": width, "series=": series, "maker=": maker, "C>=": rating}
    text = " ".join([*(words or []), *(f"{key}{value}" for key, value in options.items() if value is not None)])
    from lambda_db.presentation import found_some, rollers_found

    with _opened() as (catalogue, _):
        if lubricants:
            list_lubricants(found_some(catalogue, "lubricant", text, catalogue.lubricants(text, limit)), json)
        else:
            rows: list[AnyBearing] = [*catalogue.bearings(text, limit)]
            rows += rollers_found(catalogue, text)
            list_bearings(found_some(catalogue, "bearing", text, rows[:limit]), json)


@app.command()
def choose(
    radial: Annotated[str, typer.Option("--radial", metavar="FORCE", help='Radial load, "5 kN".')],
    speed: Annotated[str, typer.Option("--speed", metavar="SPEED", help='Of the inner ring, "3000 rpm".')],
    life: Annotated[str, typer.Option("--life", metavar="TIME", help='Required rating life, "20000 h".')],
    axial: Annotated[str, typer.Option("--axial", metavar="FORCE", help="Axial load.")] = "0 N",
    bore: Annotated[str | None, typer.Option("--bore", metavar="LENGTH", help='Only this bore, "40 mm".')] = None,
    outside: Annotated[
        str | None, typer.Option("--outside", metavar="LENGTH", help="Largest outside diameter.")
    ] = None,
    kind: Annotated[
        str | None,
        typer.Option(
            metavar="KIND",
            help="Only deep groove, angular contact, four-point, double row, self-aligning, cylindrical, needle or "
            "tapered; or NU, N, NJ, NUP, NCF.",
        ),
    ] = None,
    maker: Annotated[str | None, typer.Option(help="Only bearings of this maker.")] = None,
    oil: Annotated[str, typer.Option(metavar="NAME", help="Oil or grease of the catalogue.")] = "mineral-vg68",
    temperature: Annotated[str, typer.Option(metavar="TEMPERATURE", help="Of the oil in operation.")] = "70 degC",
    contamination: Annotated[
        str | None,
        typer.Option(metavar="E_C|LEVEL", help='e_C, or a level such as "normal cleanliness": modified lives count.'),
    ] = None,
    static_safety: Annotated[float, typer.Option("--static-safety", min=0.0, help="Least C0/P0.")] = 1.0,
    limit: Annotated[int, typer.Option(min=1, max=100, help="Bearings to show.")] = 10,
    json: JsonOption = False,
    units: UnitsOption = Units.SI,
    quiet: QuietOption = False,
    progress: ProgressOption = Style.AUTO,
) -> None:
    """Choose bearings by load, speed and life.

    The smallest bearings that meet all conditions come first.
    """
    from lambda_core import api

    with talk(progress, quiet) as speaker:
        found = api.choose(
            radial=radial, axial=axial, speed=speed, life=life, bore=bore, outside=outside, kind=kind, maker=maker,
            oil=oil, temperature=temperature, contamination=contamination, static_safety=static_safety, limit=limit,
            announce=speaker.say,
        )  # fmt: skip
    typer.echo(found.model_dump_json(indent=2) if json else found.text(units.system))


@app.command()
def show(
    words: Annotated[list[str], typer.Argument(metavar="NAME", help="Bearing, lubricant, material or cage.")],
    maker: Annotated[str | None, typer.Option(help="Maker, if several have this designation.")] = None,
    temperature: Annotated[
        list[str] | None, typer.Option(help='Of a lubricant: temperatures, for example "40 degC".')
    ] = None,
    pressure: Annotated[list[str] | None, typer.Option(help='Of a lubricant: pressures, for example "1 GPa".')] = None,
    rheology: Annotated[str | None, typer.Option(help="Of a lubricant: the law to evaluate; default: its own.")] = None,
    json: JsonOption = False,
) -> None:
    """Show one row with its sources and grades.

    It prints the source and grade of every value; an oil also over temperature and pressure.
    """
    from lambda_db.presentation import find

    from lambda_core.api import BearingRow, LubricantRow, RollerRow

    name = " ".join(words)
    with _opened() as (catalogue, models):
        row = find(catalogue, name, maker)
        if isinstance(row, BearingRow | RollerRow):
            show_bearing(catalogue, name, row, json)
        elif isinstance(row, LubricantRow):
            show_lubricant(row, models, temperature, pressure, rheology, json)
        else:
            show_plain(row, json)


@app.command()
def add(
    table: Annotated[str, typer.Argument(metavar="TABLE", help=f"One of {_TABLES}.")],
    values: Annotated[
        list[str],
        typer.Argument(
            metavar="NAME=VALUE...",
            help='For example designation=6208 maker=FAG bore_diameter="40 mm" ... source="FAG catalogue" grade=A.',
        ),
    ],
    replace: ReplaceOption = False,
    json: JsonOption = False,
) -> None:
    """Add one row to your own catalogue.

    The program estimates missing inner geometry.
    """
    from lambda_db.transfer import add_row

    cells = _cells(values)
    with _opened() as (catalogue, _):
        _report(add_row(catalogue, table, cells, replace=replace), json)


def _cells(values: list[str]) -> dict[str, object]:
    """Split NAME=VALUE."""
    from lambda_core.domain.errors import UsageError

    cells: dict[str, object] = {}
    for value in values:
        name, equals, text = value.partition("=")
        if not equals:
            raise UsageError(f'"{value}": write NAME=VALUE')
        if name.strip() in cells:
            raise UsageError(f'"{name.strip()}" is given twice')
        cells[name.strip()] = text
    return cells


@app.command()
def remove(
    table: Annotated[str, typer.Argument(metavar="TABLE", help=f"One of {_TABLES}.")],
    values: Annotated[
        list[str],
        typer.Argument(metavar="NAME=VALUE...", help="The row's key, for example designation=6208 maker=FAG."),
    ],
    json: JsonOption = False,
) -> None:
    """Remove one row of your own and its dependent rows.

    Built-in rows stay.
    """
    from lambda_db.removal import remove_row

    cells = _cells(values)
    with _opened() as (catalogue, _):
        done = remove_row(catalogue, table, cells)
    if json:
        print_json(kind="remove", path=str(done.path), row=done.row, removed=done.removed, uncovered=done.uncovered)
        return
    for name, count in done.removed.items():
        typer.echo(f"removed {count} {name} row{'s' if count != 1 else ''} from {done.path}")
    if done.uncovered:
        typer.echo(f"{done.row}: the built-in row is in use again")


def _report(report: ImportReport, json: bool) -> None:
    """Print what was written and refused.

    The exit code is 3 if a row was refused.
    """
    refused = [{"where": problem.where, "reason": problem.message} for problem in report.refused]
    if json:
        print_json(kind="import", path=str(report.path), added=report.added, replaced=report.replaced, refused=refused)
    else:
        for what, counts in (("added", report.added), ("replaced", report.replaced)):
            for table, count in counts.items():
                typer.echo(f"{what} {count} {table} row{'s' if count != 1 else ''} in {report.path}")
        for problem in report.refused:
            typer.echo(f"refused {problem}", err=True)
    if refused:
        raise typer.Exit(3)


@app.command("import")
def import_rows(
    path: Annotated[Path, typer.Argument(metavar="PATH", help="A .csv or .toml file, or a folder of them.")],
    table: TableOption = None,
    keep_good: Annotated[
        bool, typer.Option("--keep-good/--roll-back", help="Keep the good rows, or write nothing when one is bad.")
    ] = False,
    replace: ReplaceOption = False,
    json: JsonOption = False,
) -> None:
    """Import rows into your own catalogue."""
    from lambda_db.transfer import import_path

    with _opened() as (catalogue, _):
        _report(import_path(catalogue, path, table, keep_good=keep_good, replace=replace), json)


@app.command("export")
def export_rows(
    path: Annotated[Path, typer.Argument(metavar="PATH", help="A .csv or .toml file, or a folder for CSV files.")],
    tables: Annotated[
        list[str] | None, typer.Option("--table", metavar="TABLE", help=f"Only these tables, of {_TABLES}.")
    ] = None,
    mine: Annotated[bool, typer.Option("--mine", help="Only your own rows.")] = False,
    json: JsonOption = False,
) -> None:
    """Write the catalogue, or your own rows, to files.

    Importing them gives the same rows.
    """
    from lambda_db.seed_tables import SEED_TABLES
    from lambda_db.transfer import export_rows as write

    chosen = tables or ([path.stem] if path.suffix == ".csv" else list(SEED_TABLES))
    with _opened() as (catalogue, _):
        counts = write(catalogue, path, chosen, mine=mine)
    if json:
        print_json(kind="export", path=str(path), rows=counts)
    else:
        typer.echo(f"wrote {sum(counts.values())} rows of {', '.join(counts)} to {path}")


@app.command()
def accept(json: JsonOption = False) -> None:
    """Accept your own catalogue after a change with another tool.

    The program names every row that another tool has changed and ignores the file until you accept it.
    """
    from lambda_db.paths import user_database
    from lambda_db.user import accept as seal

    found = seal(user_database())
    if json:
        print_json(kind="accept", path=str(user_database()), differences=found)
        return
    for difference in found:
        typer.echo(difference)
    typer.echo(f"accepted: {len(found)} differences in {user_database()}")


@app.command()
def check(json: JsonOption = False) -> None:
    """Check the catalogue for contradictions.

    The exit code is 3 if a row cannot be used.
    """
    from dataclasses import asdict

    from lambda_db.check import check_catalogue

    with _opened() as (catalogue, models):
        findings = check_catalogue(catalogue, models)
    if json:
        print_json(kind="check", findings=[asdict(finding) for finding in findings])
    else:
        for finding in findings:
            typer.echo(f"{finding.severity:<8} {finding.where}: {finding.message}")
        errors = sum(finding.severity == "error" for finding in findings)
        typer.echo(f"errors: {errors}   warnings: {len(findings) - errors}")
    if any(finding.severity == "error" for finding in findings):
        raise typer.Exit(3)
