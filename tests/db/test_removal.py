"""Test removing rows of the user; built-in ones stay."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lambda_cli.main import main
from lambda_db.catalogue import SqlCatalogue
from lambda_db.removal import remove_row
from lambda_db.transfer import add_row, rows_of

from lambda_core.domain.errors import CatalogueError, UsageError

BEARING: dict[str, object] = {
    "designation": "6208",
    "maker": "NSK",
    "bore_diameter": "40 mm",
    "outside_diameter": "80 mm",
    "width": "18 mm",
    "dynamic_rating": "29.1 kN",
    "static_rating": "17.9 kN",
    "rating_type": "ISO 281",
    "source": "my own drawing",
    "grade": "B",
}
CONSTANT: dict[str, object] = {
    "role": "traction", "model": "my-law", "name": "k", "value": 3.5, "unit": "", "source": "test", "grade": "B",
}  # fmt: skip
STEEL: dict[str, object] = {
    "name": "steel-x", "youngs_modulus": "200 GPa", "poisson_ratio": 0.3, "density": "7800 kg/m3",
    "thermal_conductivity": "40 W/(m K)", "specific_heat": "460 J/(kg K)", "thermal_expansion": "12e-6 1/K",
    "source": "test", "grade": "B",
}  # fmt: skip


def test_the_built_in_row_shows_again(catalogue: SqlCatalogue) -> None:
    before = catalogue.bearing("6208", "NSK")
    add_row(catalogue, "bearing", BEARING)
    assert catalogue.bearing("6208", "NSK").layer == "user"
    done = remove_row(catalogue, "bearing", {"designation": "6208", "maker": "nsk"})
    assert done.uncovered
    assert done.removed == {"bearing": 1, "candidate": 5}
    assert catalogue.bearing("6208", "NSK") == before
    assert rows_of(catalogue, "bearing", mine=True) == []


def test_a_part_of_the_key_is_enough_where_it_names_one_row(catalogue: SqlCatalogue) -> None:
    add_row(catalogue, "bearing", BEARING | {"designation": "X1", "maker": "one"})
    assert remove_row(catalogue, "bearing", {"designation": "x1"}).row == "bearing X1 one"
    with pytest.raises(CatalogueError, match='"X1" is not a known bearing'):
        catalogue.bearing("X1")
    for maker in ("one", "two"):
        add_row(catalogue, "bearing", BEARING | {"designation": "X2", "maker": maker})
    with pytest.raises(CatalogueError, match=r"2 of your rows match .*X2 one.*X2 two.*give designation, maker"):
        remove_row(catalogue, "bearing", {"designation": "X2"})
    assert len(catalogue.bearings("X2", 9)) == 2


def test_what_is_built_in_is_refused(catalogue: SqlCatalogue) -> None:
    message = "bearing 6208 SKF is built in, or a plugin's, and cannot be removed"
    with pytest.raises(CatalogueError, match=message):
        remove_row(catalogue, "bearing", {"designation": "6208", "maker": "SKF"})
    add_row(catalogue, "bearing", BEARING)  # now there is a database of one's own
    with pytest.raises(CatalogueError, match=message):
        remove_row(catalogue, "bearing", {"designation": "6208", "maker": "SKF"})
    with pytest.raises(CatalogueError, match="lubricant FVA3 is built in"):
        remove_row(catalogue, "lubricant", {"name": "FVA3"})


def test_an_oil_goes_with_its_constants_and_leaves_those_of_others(catalogue: SqlCatalogue) -> None:
    oil = {"name": "my-oil", "base_type": "mineral", "rheology": "roelands", "note": "test"}
    add_row(catalogue, "lubricant", oil)
    for name in ("my-oil", "FVA3"):
        add_row(catalogue, "lubricant_parameter", CONSTANT | {"lubricant": name})
    assert remove_row(catalogue, "lubricant", {"name": "My-Oil"}).removed == {"lubricant": 1, "lubricant_parameter": 1}
    assert catalogue.lubricant("FVA3").parameters["traction"]["my-law"]["k"].value == 3.5
    one = {key: CONSTANT[key] for key in ("role", "model", "name")} | {"lubricant": "FVA3"}
    assert not remove_row(catalogue, "lubricant_parameter", one).uncovered
    assert "my-law" not in catalogue.lubricant("FVA3").parameters["traction"]


def test_a_material_that_a_cage_of_ones_own_is_made_of_stays(catalogue: SqlCatalogue) -> None:
    add_row(catalogue, "material", STEEL)
    steel = next(row for row in rows_of(catalogue, "cage"))
    add_row(catalogue, "cage", steel | {"name": "my-cage", "material": "steel-x"})
    with pytest.raises(CatalogueError, match="your cage my-cage is made of steel-x: remove or change it first"):
        remove_row(catalogue, "material", {"name": "steel-x"})
    remove_row(catalogue, "cage", {"name": "my-cage"})
    remove_row(catalogue, "material", {"name": "steel-x"})
    assert "steel-x" not in catalogue.names("material")


@pytest.mark.parametrize(
    ("table", "cells", "message"),
    [
        ("bearin", {"designation": "6208"}, '"bearin" is not a known catalogue table; nearest: bearing'),
        ("bearing", {"width": "18 mm"}, "width_mm is not of the key of bearing: designation, maker"),
        ("bearing", {"designatoin": "6208"}, "designation"),
        ("bearing", {}, "name the bearing: designation=... maker=..."),
    ],
)
def test_a_key_that_is_none_is_refused(
    catalogue: SqlCatalogue, table: str, cells: dict[str, object], message: str
) -> None:
    with pytest.raises(UsageError) as found:
        remove_row(catalogue, table, cells)
    assert message in str(found.value)


def test_the_command(user_folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cells = [f"{name}={value}" for name, value in BEARING.items()]
    assert main(["db", "add", "bearing", *cells]) == 0
    capsys.readouterr()
    assert main(["db", "remove", "bearing", "designation=6208", "maker=NSK"]) == 0
    captured = capsys.readouterr()
    assert captured.out.splitlines()[0].startswith("removed 1 bearing row from ")
    assert captured.out.splitlines()[-1] == "bearing 6208 NSK: the built-in row is in use again"
    assert main(["db", "remove", "bearing", "designation=6208", "maker=NSK"]) == 3
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "is built in" in captured.err
    assert main(["db", "add", "bearing", *cells]) == 0
    capsys.readouterr()
    assert main(["db", "remove", "bearing", "designation=6208", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert (data["kind"], data["removed"]["bearing"], data["uncovered"]) == ("remove", 1, True)
    assert main(["db", "remove", "bearing", "6208"]) == 2
    assert "write NAME=VALUE" in capsys.readouterr().err
