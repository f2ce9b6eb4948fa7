"""Print catalogue rows as tables or as one JSON object."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import typer

from lambda_cli.talk import columns
from lambda_core.domain.value_status import ESTIMATED

_ROOMY = 110  # columns of a terminal from which on notes stand in the table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lambda_db.catalogue import SqlCatalogue
    from lambda_db.presentation import AnyBearing
    from rich.table import Table

    from lambda_core.api import CageRow, LubricantRow, MaterialRow, Registry


def print_json(**data: object) -> None:
    """Write one JSON object with the version of its form."""
    import json

    typer.echo(json.dumps({"version": 1, **data}, indent=2, ensure_ascii=False))


def _table(*columns: str) -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    for number, column in enumerate(columns):
        uncut = number == 0  # names are there to be copied
        side: Literal["left", "right"] = "right" if column.endswith(">") else "left"
        table.add_column(column.removesuffix(">"), justify=side, overflow="fold", no_wrap=uncut)
    return table


def _print(item: object) -> None:
    """Write to stdout; a pipe gets whole lines, however long."""
    import sys

    from rich.console import Console

    Console(width=None if sys.stdout.isatty() else 400, highlight=False, markup=False, emoji=False).print(item)


def _number(value: float | None, digits: int = 6) -> str:
    return "" if value is None else f"{value:.{digits}g}"


def list_bearings(rows: Sequence[AnyBearing], json: bool) -> None:
    """Print one line per bearing; estimates are marked."""
    from lambda_db.presentation import bearing_summary

    if json:
        print_json(kind="bearings", rows=[bearing_summary(row) for row in rows])
        return
    angled = ["alpha deg>"] if any(row.contact_angle is not None for row in rows) else []
    table = _table("designation", "maker", "d>", "D>", "B>", *angled, "C kN>", "C0 kN>", "Z x Dw>", "grade")
    for row in rows:
        s = bearing_summary(row)
        design, grade = "", "unknown"
        if "roller_count" in s:
            size = (s["roller_count"], _number(s["roller_diameter_mm"]), _number(s["roller_length_mm"]))
            mark = "≈ " if s["geometry_status"] in ESTIMATED else ""
            design, grade = mark + " x ".join(map(str, size)), f"{s['geometry_grade']} {s['geometry_status']}"
        elif s["ball_count"] is not None:
            mark = "≈ " if s["geometry_status"] in ESTIMATED else ""
            design = f"{mark}{s['ball_count']} x {_number(s['ball_diameter_mm'])}"
            grade = f"{s['geometry_grade']} {s['geometry_status']}"
        names = ("bore_mm", "outside_mm", "width_mm", *(["contact_angle_deg"] if angled else []), "C_kN", "C0_kN")
        numbers = (_number(s[name]) for name in names)
        table.add_row(row.designation, row.maker, *numbers, design, grade)
    _print(table)


def list_lubricants(rows: list[LubricantRow], json: bool) -> None:
    """Print one line per oil."""
    from lambda_db.presentation import kind_of, lubricant_summary

    if json:
        print_json(kind="lubricants", rows=[lubricant_summary(row) for row in rows])
        return
    told = ["note"] if (columns() or _ROOMY) >= _ROOMY else []
    table = _table("name", "base", "nu40>", "nu100 mm2/s>", "alpha40 1/GPa>", "rheology", *told)
    for row in rows:
        s = lubricant_summary(row)
        numbers = (_number(s[name], 4) for name in ("nu40_mm2s", "nu100_mm2s", "alpha40_per_GPa"))
        table.add_row(row.name, kind_of(row), *numbers, row.rheology, *([row.note] if told else []))
    _print(table)
    if not told:
        _print("what each is: lambda-bearing db show NAME")


def show_bearing(catalogue: SqlCatalogue, name: str, row: AnyBearing, json: bool) -> None:
    """Print a bearing with sources and candidate designs.

    Print also clearance classes, suffixes and a section to scale.
    """
    from lambda_db.drawing import cross_section
    from lambda_db.presentation import candidate_lines, clearance_lines, suffix_lines, values_of

    from lambda_core import api

    suffixes = suffix_lines(catalogue, name)
    values, candidates, clearances = values_of(row), candidate_lines(row), clearance_lines(catalogue, row)
    if json:
        print_json(
            kind="bearing",
            designation=row.designation,
            maker=row.maker,
            series=row.series,
            bearing_kind=row.kind,
            layer=row.layer,
            rating_type=getattr(row, "rating_type", ""),
            values={value.pop("name"): value for value in values},
            candidates=candidates,
            clearances=clearances,
            suffixes=suffixes,
        )
        return
    whose = "" if row.layer == "core" else f"   ({row.layer} row)"
    ratings = getattr(row, "rating_type", "")
    about = f"{row.kind}   series {row.series or '-'}   ratings {ratings or '-'}{whose}"
    _print(f"{row.designation}  {row.maker}   {about}")
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
    if row.contact_angle is None:
        classes = "   ".join(f"{c['class']} {c['minimum_um']:g}-{c['maximum_um']:g}" for c in clearances)
        _print(f"radial internal clearance, um   {classes or 'not tabulated for this bore'}")
    elif isinstance(row, api.RollerRow):
        _print("its clearance is set when mounting; a pair is preloaded on a shaft: docs/shaft.md")
    else:
        _print("its clearance follows from the contact angle; a pair is preloaded on a shaft: docs/shaft.md")
    for line in suffixes:
        _print(f"suffix {line['suffix']:<8} {line['meaning']}")
    _print("")
    _print(cross_section(row))


def _print_values(values: list[dict[str, Any]]) -> None:
    table = _table("value", ">", "unit", "status", "grade", "source")
    for value in values:
        status = f"≈ {value['status']}" if value["status"] in ESTIMATED else value["status"]
        table.add_row(
            value["name"], _number(value["value"], 10), value["unit"], status, value["grade"], value["source"]
        )
    _print(table)


def show_lubricant(
    row: LubricantRow,
    models: Registry,
    temperatures: list[str] | None,
    pressures: list[str] | None,
    rheology: str | None,
    json: bool,
) -> None:
    """Print an oil and its constants.

    Print also its behaviour over temperature and pressure, by every law.
    """
    from lambda_db.presentation import parameters_of, parsed, values_of

    from lambda_core.api import oil_table

    kelvin = parsed(
        temperatures or ["20 degC", "40 degC", "60 degC", "80 degC", "100 degC"], "temperature", "--temperature"
    )
    pascal = parsed(pressures or ["0 GPa", "0.5 GPa", "1 GPa"], "pressure", "--pressure")
    table, values, parameters = oil_table(row, models, kelvin, pascal, rheology), values_of(row), parameters_of(row)
    if json:
        print_json(
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
    listed = _table("role", "model", "parameter", "value>", "unit", "status", "grade", "source")
    for p in parameters:
        told = [p[name] or "" for name in ("unit", "status", "grade", "source")]
        listed.add_row(p["role"], p["model"], p["name"], _number(p["value"], 10), *told)
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


def show_plain(row: MaterialRow | CageRow, json: bool) -> None:
    """Print a material or a cage."""
    from lambda_db.presentation import texts_of, values_of

    texts, values = texts_of(row), values_of(row)
    if json:
        print_json(
            kind="cage" if "guidance" in texts else "material",
            **texts,
            values={value.pop("name"): value for value in values},
        )
        return
    _print("   ".join(text for text in texts.values() if text))
    _print("")
    _print_values(values)
