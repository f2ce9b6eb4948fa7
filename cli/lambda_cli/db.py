"""`lambda-bearing db`: search, show, add, import, export and check the catalogue."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lambda_cli.options import JsonOption

if TYPE_CHECKING:
    from lambda_db.catalogue import SqlCatalogue
    from lambda_db.transfer import ImportReport
    from rich.table import Table

    from lambda_core.registry.catalogue import BearingRow, CageRow, LubricantRow, MaterialRow
    from lambda_core.registry.registry import Registry

app = typer.Typer(
    no_args_is_help=True, add_completion=False, help="Search and edit the catalogue of bearings, oils and materials."
)

_TABLES = "source, alias, bearing, clearance, material, cage, lubricant, lubricant_property, lubricant_parameter"
TableOption = Annotated[str | None, typer.Option("--table", metavar="TABLE", help=f"One of {_TABLES}.")]
ReplaceOption = Annotated[bool, typer.Option("--replace", help="Put rows in the place of your own of the same key.")]


@contextmanager
def _opened() -> Iterator[tuple[SqlCatalogue, Registry]]:
    """Open the catalogue with the rows of every plugin."""
    from lambda_db.catalogue import SqlCatalogue

    from lambda_core.errors import UsageError
    from lambda_core.registry.manager import registry

    models = registry()
    catalogue = models.catalogue()
    try:
        if not isinstance(catalogue, SqlCatalogue):
            raise UsageError("another plugin provides the catalogue; this command edits the built-in one")
        yield catalogue, models
    finally:
        catalogue.close()


def _json(**data: object) -> None:
    import json

    typer.echo(json.dumps({"version": 1, **data}, indent=2, ensure_ascii=False))


def _table(*columns: str) -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    for column in columns:
        name = column.removesuffix(">")
        table.add_column(name, justify="right" if column.endswith(">") else "left", overflow="fold")
    return table


def _print(item: object) -> None:
    """Write to stdout; a pipe gets whole lines, however long."""
    import sys

    from rich.console import Console

    Console(width=None if sys.stdout.isatty() else 400, highlight=False, markup=False, emoji=False).print(item)


def _number(value: float | None, digits: int = 6) -> str:
    return "" if value is None else f"{value:.{digits}g}"


@app.command()
def search(
    words: Annotated[
        list[str] | None,
        typer.Argument(metavar="[WORD]...", help='Designation, maker, series or a dimension; or "d=40", "C>30".'),
    ] = None,
    bore: Annotated[float | None, typer.Option(help="Bore [mm].")] = None,
    outside: Annotated[float | None, typer.Option(help="Outside diameter [mm].")] = None,
    width: Annotated[float | None, typer.Option(help="Width [mm].")] = None,
    series: Annotated[str | None, typer.Option(help="Dimension series, for example 62.")] = None,
    maker: Annotated[str | None, typer.Option(help="Maker.")] = None,
    rating: Annotated[float | None, typer.Option(help="Least dynamic load rating C [kN].")] = None,
    lubricants: Annotated[bool, typer.Option("--lubricants", help="Search the oils instead.")] = False,
    limit: Annotated[int, typer.Option(min=1, help="Most rows to show.")] = 50,
    json: JsonOption = False,
) -> None:
    """List the bearings (or oils) that match every word."""
    options = {"d=": bore, "D=": outside, "B=": width, "series=": series, "maker=": maker, "C>=": rating}
    text = " ".join([*(words or []), *(f"{key}{value}" for key, value in options.items() if value is not None)])
    with _opened() as (catalogue, _):
        if lubricants:
            _list_lubricants(catalogue.lubricants(text, limit), json)
        else:
            _list_bearings(catalogue.bearings(text, limit), json)


def _list_bearings(rows: list[BearingRow], json: bool) -> None:
    from lambda_db.presentation import bearing_summary

    if json:
        _json(kind="bearings", rows=[bearing_summary(row) for row in rows])
        return
    table = _table("designation", "maker", "d>", "D>", "B>", "C kN>", "C0 kN>", "Z x Dw>", "grade")
    for row in rows:
        s = bearing_summary(row)
        design, grade = "", "unknown"
        if s["ball_count"] is not None:
            mark = "≈ " if s["geometry_status"] != "published" else ""
            design = f"{mark}{s['ball_count']} x {_number(s['ball_diameter_mm'])}"
            grade = f"{s['geometry_grade']} {s['geometry_status']}"
        numbers = (_number(s[name]) for name in ("bore_mm", "outside_mm", "width_mm", "C_kN", "C0_kN"))
        table.add_row(row.designation, row.maker, *numbers, design, grade)
    _print(table)


def _list_lubricants(rows: list[LubricantRow], json: bool) -> None:
    from lambda_db.presentation import lubricant_summary

    if json:
        _json(kind="lubricants", rows=[lubricant_summary(row) for row in rows])
        return
    table = _table("name", "base", "nu40>", "nu100 mm2/s>", "alpha40 1/GPa>", "rheology", "note")
    for row in rows:
        s = lubricant_summary(row)
        numbers = (_number(s[name], 4) for name in ("nu40_mm2s", "nu100_mm2s", "alpha40_per_GPa"))
        table.add_row(row.name, row.base_type, *numbers, row.rheology, row.note)
    _print(table)


@app.command()
def show(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Bearing, lubricant, material or cage.")],
    maker: Annotated[str | None, typer.Option(help="Whose bearing, where several makers are in the catalogue.")] = None,
    temperature: Annotated[
        list[str] | None, typer.Option(help='Of a lubricant: temperatures, for example "40 degC".')
    ] = None,
    pressure: Annotated[list[str] | None, typer.Option(help='Of a lubricant: pressures, for example "1 GPa".')] = None,
    rheology: Annotated[str | None, typer.Option(help="Of a lubricant: the law to evaluate; default: its own.")] = None,
    json: JsonOption = False,
) -> None:
    """Show one row with the source and grade of every value; an oil also over temperature and pressure."""
    from lambda_db.presentation import find

    from lambda_core.registry.catalogue import BearingRow, LubricantRow

    with _opened() as (catalogue, models):
        row = find(catalogue, name, maker)
        if isinstance(row, BearingRow):
            _show_bearing(catalogue, row, json)
        elif isinstance(row, LubricantRow):
            _show_lubricant(row, models, temperature, pressure, rheology, json)
        else:
            _show_plain(row, json)


def _show_bearing(catalogue: SqlCatalogue, row: BearingRow, json: bool) -> None:
    from lambda_db.drawing import cross_section
    from lambda_db.presentation import candidate_lines, clearance_lines, values_of

    values, candidates, clearances = values_of(row), candidate_lines(row), clearance_lines(catalogue, row)
    if json:
        _json(
            kind="bearing",
            designation=row.designation,
            maker=row.maker,
            series=row.series,
            layer=row.layer,
            rating_type=row.rating_type,
            values={value.pop("name"): value for value in values},
            candidates=candidates,
            clearances=clearances,
        )
        return
    whose = "" if row.layer == "core" else f"   ({row.layer} row)"
    _print(f"{row.designation}  {row.maker}   series {row.series or '-'}   ratings {row.rating_type or '-'}{whose}")
    _print("")
    _print_values(values)
    if candidates:
        _print("")
        _print("inner geometry is estimated; candidates:")
        table = _table("Z x Dw mm>", "pitch mm>", "score>", "weight>", "filling deg>")
        for c in candidates:
            design = f"{c['ball_count']} x {_number(c['ball_diameter_mm'])}"
            rest = (_number(c[name], 4) for name in ("score", "weight", "filling_angle_deg"))
            table.add_row(design, _number(c["pitch_diameter_mm"]), *rest)
        _print(table)
    _print("")
    classes = "   ".join(f"{c['class']} {c['minimum_um']:g}-{c['maximum_um']:g}" for c in clearances)
    _print(f"radial internal clearance, um   {classes or 'not tabulated for this bore'}")
    _print("")
    _print(cross_section(row))


def _print_values(values: list[dict[str, Any]]) -> None:
    table = _table("value", ">", "unit", "status", "grade", "source")
    for value in values:
        status = f"≈ {value['status']}" if value["status"] != "published" else value["status"]
        table.add_row(
            value["name"], _number(value["value"], 10), value["unit"], status, value["grade"], value["source"]
        )
    _print(table)


def _show_lubricant(
    row: LubricantRow,
    models: Registry,
    temperatures: list[str] | None,
    pressures: list[str] | None,
    rheology: str | None,
    json: bool,
) -> None:
    from lambda_db.presentation import parameters_of, parsed, values_of

    from lambda_core.physics.oil_table import oil_table

    kelvin = parsed(
        temperatures or ["20 degC", "40 degC", "60 degC", "80 degC", "100 degC"], "temperature", "--temperature"
    )
    pascal = parsed(pressures or ["0 GPa", "0.5 GPa", "1 GPa"], "pressure", "--pressure")
    table, values, parameters = oil_table(row, models, kelvin, pascal, rheology), values_of(row), parameters_of(row)
    if json:
        _json(
            kind="lubricant",
            name=row.name,
            base_type=row.base_type,
            note=row.note,
            layer=row.layer,
            values={value.pop("name"): value for value in values},
            parameters=parameters,
            table=table.model_dump(mode="json"),
        )
        return
    _print(f"{row.name}   {row.base_type}   {row.note}   ({row.layer})")
    _print("")
    _print_values(values)
    _print("")
    listed = _table("role", "model", "parameter", "value>", "unit", "grade", "source")
    for p in parameters:
        listed.add_row(p["role"], p["model"], p["name"], _number(p["value"], 10), p["unit"], p["grade"], p["source"])
    _print(listed)
    _print("")
    _print(f"by {table.rheology}: {table.reference}")
    _print(f"valid {table.validity}")
    grid = _table("degC>", "GPa>", "eta mPa s>", "nu mm2/s>", "rho kg/m3>", "eps_r>")
    for point in table.points:
        numbers = (point.viscosity_mPas, point.kinematic_viscosity_mm2s, point.density_kgm3, point.permittivity)
        grid.add_row(f"{point.temperature_degC:g}", f"{point.pressure_GPa:g}", *(_number(n, 4) for n in numbers))
    _print(grid)
    _print("")
    coefficients = _table("degC>", "alpha at p=0>", "secant 0.2 GPa>", "reciprocal 1/GPa>", "beta 1/K>")
    for c in table.coefficients:
        alphas = (c.alpha_tangent_per_GPa, c.alpha_secant_per_GPa, c.alpha_reciprocal_per_GPa, c.beta_per_K)
        coefficients.add_row(f"{c.temperature_degC:g}", *(_number(a, 4) for a in alphas))
    _print(coefficients)


def _show_plain(row: MaterialRow | CageRow, json: bool) -> None:
    from lambda_db.presentation import texts_of, values_of

    texts, values = texts_of(row), values_of(row)
    if json:
        _json(
            kind="cage" if "guidance" in texts else "material",
            **texts,
            values={value.pop("name"): value for value in values},
        )
        return
    _print("   ".join(text for text in texts.values() if text))
    _print("")
    _print_values(values)


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
    """Add one row to your own catalogue; inner geometry that is left open is estimated."""
    from lambda_db.transfer import add_row

    from lambda_core.errors import UsageError

    cells: dict[str, object] = {}
    for value in values:
        name, equals, text = value.partition("=")
        if not equals:
            raise UsageError(f'"{value}": write NAME=VALUE')
        if name.strip() in cells:
            raise UsageError(f'"{name.strip()}" is given twice')
        cells[name.strip()] = text
    with _opened() as (catalogue, _):
        _report(add_row(catalogue, table, cells, replace=replace), json)


def _report(report: ImportReport, json: bool) -> None:
    """Print what was written and refused; exit 3 if a row was refused."""
    refused = [{"where": problem.where, "reason": problem.message} for problem in report.refused]
    if json:
        _json(kind="import", path=str(report.path), added=report.added, replaced=report.replaced, refused=refused)
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
    """Bring rows into your own catalogue."""
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
    """Write the catalogue, or your own rows, to files; importing them gives the same rows."""
    from lambda_db.models import SEED_TABLES
    from lambda_db.transfer import export_rows as write

    chosen = tables or ([path.stem] if path.suffix == ".csv" else list(SEED_TABLES))
    with _opened() as (catalogue, _):
        counts = write(catalogue, path, chosen, mine=mine)
    if json:
        _json(kind="export", path=str(path), rows=counts)
    else:
        typer.echo(f"wrote {sum(counts.values())} rows of {', '.join(counts)} to {path}")


@app.command()
def check(json: JsonOption = False) -> None:
    """Look for rows that contradict themselves or each other; exit 3 when one cannot be used."""
    from dataclasses import asdict

    from lambda_db.check import check_catalogue

    with _opened() as (catalogue, models):
        findings = check_catalogue(catalogue, models)
    if json:
        _json(kind="check", findings=[asdict(finding) for finding in findings])
    else:
        for finding in findings:
            typer.echo(f"{finding.severity:<8} {finding.where}: {finding.message}")
        errors = sum(finding.severity == "error" for finding in findings)
        typer.echo(f"errors: {errors}   warnings: {len(findings) - errors}")
    if any(finding.severity == "error" for finding in findings):
        raise typer.Exit(3)
