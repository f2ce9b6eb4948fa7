"""Test `db check`.

What constraints cannot see is found, and the built-in rows have no errors.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from lambda_db.catalogue import SqlCatalogue, open_catalogue
from lambda_db.check import Finding, check_catalogue
from lambda_db.paths import user_database
from lambda_db.transfer import add_row, rows_of

from lambda_core.discovery.manager import registry
from lambda_core.model.checks.oil_table import OilLaw

if TYPE_CHECKING:
    from conftest import Meanwhile


def findings(catalogue: SqlCatalogue) -> list[Finding]:
    return check_catalogue(catalogue, registry())


def test_the_built_in_rows(catalogue: SqlCatalogue) -> None:
    (only,) = findings(catalogue)
    assert only.severity == "warning"
    assert only.where == "bearing 6319 Syla2026"
    assert "160 kN is not the 143.7 kN of the row's own geometry" in only.message


def test_what_is_found(catalogue: SqlCatalogue) -> None:
    common = {"source": "test", "grade": "A"}
    add_row(catalogue, "alias", {"kind": "cage", "alias": "x", "name": "nothing"})
    add_row(catalogue, "lubricant", {"name": "empty", "base_type": "PAO", "rheology": "roelands"})
    law = {
        "lubricant": "empty",
        "role": "traction",
        "model": "ree-eyring",
        "name": "tau_eyrng",
        "value": 5,
        "unit": "MPa",
    }
    add_row(catalogue, "lubricant_parameter", law | common)
    foreign = {"lubricant": "empty", "role": "traction", "model": "no-such-law", "name": "k", "value": 5}
    add_row(catalogue, "lubricant_parameter", foreign | common)
    limits = {"clearance_class": "CN", "bore_over_mm": 35, "bore_to_mm": 45, "minimum_um": 6, "maximum_um": 20}
    add_row(catalogue, "clearance", limits | common)
    bearing = {
        "designation": "F1",
        "maker": "t",
        "bore_diameter": "40 mm",
        "outside_diameter": "80 mm",
        "width": "18 mm",
        "dynamic_rating": "50 kN",
        "ball_count": 12,
        "ball_diameter": "12 mm",
        "pitch_diameter": "60 mm",
        "status": "published",
    }
    add_row(catalogue, "bearing", bearing | common)
    text = "\n".join(f"{f.severity} {f.where}: {f.message}" for f in findings(catalogue))
    assert 'error alias x: stands for the cage "nothing", which is not there' in text
    assert "error lubricant empty: its rheology is roelands, but it has no parameters for it" in text
    assert "traction ree-eyring: tau_eyrng" in text
    assert "warning lubricant empty: has parameters for traction no-such-law" in text
    assert "error clearance CN: the ranges to 40 mm and from 35 mm overlap" in text
    assert "warning bearing F1 t: 12 balls of 12 mm span 254 deg" in text
    assert "dynamic_rating 50 kN is not the" in text


def test_an_oil_of_ones_own_has_its_viscosities_once(catalogue: SqlCatalogue) -> None:
    """Complete a law's rows from the oil's properties."""
    common = {"source": "test", "grade": "B"}
    add_row(catalogue, "lubricant", {"name": "mine", "base_type": "mineral", "rheology": "roelands"})
    numbers = {"kinematic_viscosity_40": ("68", "mm2/s"), "kinematic_viscosity_100": ("8.7", "mm2/s")}
    numbers |= {"density_15": ("880", "kg/m3"), "thermal_conductivity": ("0.14", "W/(m K)")}
    for name, (value, unit) in numbers.items():
        add_row(
            catalogue, "lubricant_property", {"lubricant": "mine", "name": name, "value": value, "unit": unit} | common
        )
    key = {"lubricant": "mine", "role": "rheology", "model": "roelands"}
    add_row(catalogue, "lubricant_parameter", key | {"name": "alpha_p", "value": "20", "unit": "1/GPa"} | common)
    assert "its rheology" not in " ".join(found.message for found in findings(catalogue))
    add_row(catalogue, "lubricant_parameter", key | {"name": "density_slope", "value": "-0.65"} | common)
    assert [found for found in findings(catalogue) if found.where == "lubricant mine"] == []
    point, density = OilLaw(catalogue.lubricant("mine"), registry()).state(0.0, 313.15)
    assert math.exp(point) / density == pytest.approx(68e-6, rel=1e-6)


def test_a_damaged_user_file_is_an_error(user_folder: Path) -> None:
    user_folder.mkdir()
    user_database().write_bytes(b"not a database, but long enough to be read as one" * 10)
    catalogue = open_catalogue()
    assert any(f.severity == "error" and "left out" in f.message for f in findings(catalogue))
    catalogue.close()


def test_rows_added_during_a_check_are_no_findings(catalogue: SqlCatalogue, meanwhile: Meanwhile) -> None:
    """Add a cage between reading materials and cages.

    The cage has a material of its own, added after the names of materials were read.
    """
    add_row(catalogue, "suffix", {"written": "QQ7", "kind": "cage", "meaning": "brass", "value": "brass-machined"})
    other = open_catalogue()
    before = findings(catalogue)

    def add() -> None:
        material = dict(rows_of(other, "material")[0]) | {"name": "late"}
        add_row(other, "material", material, replace=True)
        add_row(other, "cage", dict(rows_of(other, "cage")[0]) | {"name": "of late", "material": "late"}, replace=True)

    with meanwhile(" FROM cage ORDER", add):
        assert findings(catalogue) == before
    assert {row["name"] for row in rows_of(catalogue, "cage", mine=True)} == {"of late"}
    other.close()
