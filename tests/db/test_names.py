"""Test that names resolve by spelling or alias."""

from __future__ import annotations

import pytest
from lambda_db.catalogue import SqlCatalogue

from lambda_core.domain.errors import CatalogueError


def test_several_makers_are_listed(catalogue: SqlCatalogue) -> None:
    with pytest.raises(CatalogueError) as error:
        catalogue.bearing("6208")
    assert "choose one: KOYO, NSK, SKF, Syla2026" in str(error.value)
    assert error.value.exit_code == 3


def test_one_maker_needs_no_name(catalogue: SqlCatalogue) -> None:
    assert catalogue.bearing("6411").maker == "SKF"
    assert catalogue.bearing(" 618/4 ").designation == "618/4"


@pytest.mark.parametrize(
    ("designation", "maker", "message"),
    [
        ("6391", None, '"6391" is not a known bearing; nearest: 6'),
        ("6208", "FAG", '"FAG" is not a maker of 6208 in the catalogue; makers: KOYO, NSK, SKF, Syla2026'),
        ("7208B", "SKF", '"SKF" is not a maker of 7208B in the catalogue; makers: NSK; SKF has 7208BE, '),
        ("FAG 7208-B-XL-TVP", None, "available: 7208A, 7208B, 7208BE, 7208C"),
        ("6209B", "NSK", '"6209B" is not a known bearing; nearest: 6209, '),
        ("NU 2O8", "SKF", '"NU 2O8" is not a known bearing; nearest: NU 208, '),
        ("6208'; DROP TABLE bearing; --", None, "is not a known bearing"),
        ("", None, "is not a known bearing"),
        ("SKF 22216 EK", None, '"SKF 22216 EK" is a spherical roller bearing, a kind that is not simulated; nearest'),
        ("51208", None, "a thrust ball bearing, a kind that is not simulated; nearest kind: angular contact ball"),
        ("81112", None, "a cylindrical or needle roller thrust bearing, a kind that is not simulated"),
        ("29412 E", None, "a spherical roller thrust bearing, a kind that is not simulated"),
        ("NN 3008 K", None, "a double row cylindrical roller bearing, a kind that is not simulated; nearest kind"),
        ("C 2216", None, "a toroidal roller bearing, a kind that is not simulated; nearest kind: needle rollers"),
    ],
)
def test_unknown_bearings(catalogue: SqlCatalogue, designation: str, maker: str | None, message: str) -> None:
    with pytest.raises(CatalogueError, match="(?s)" + message.replace("(", r"\(")):
        catalogue.bearing(designation, maker)
    assert catalogue.bearing("6208", "nsk").maker == "NSK"


@pytest.mark.parametrize(
    ("spelled", "name"),
    [
        ("fva3a", "FVA3A"),
        ("FVA 3", "FVA3"),
        ("bode", "bode-mineral"),
        ("Mineral ISO VG 100 (generic, VI~95)", "mineral-vg100"),
        ("PAOR", "pao-vg320"),
    ],
)
def test_lubricants_by_alias(catalogue: SqlCatalogue, spelled: str, name: str) -> None:
    assert catalogue.lubricant(spelled).name == name


def test_materials_and_cages_by_alias(catalogue: SqlCatalogue) -> None:
    assert catalogue.material("AISI 52100").name == "100Cr6"
    assert catalogue.cage("TN9").name == "pa66"
    assert catalogue.cage("brass").material == "CW614N"


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda c: c.lubricant("FVA4"), "nearest: FVA3"),
        (lambda c: c.lubricant("Mineral ISO VG 101 (generic, VI~95)"), "nearest: Mineral ISO VG 1"),
        (lambda c: c.material("unobtainium"), "available: 100Cr6"),
        (lambda c: c.cage("pa67"), "nearest: pa66"),
        (lambda c: c.clearance(0.04, "C9"), "is not a known clearance class; nearest: C"),
        (lambda c: c.clearance(2.0, "CN"), "tabulated over 2.5 to 1600 mm, not for 2000 mm"),
    ],
)
def test_unknown_names_say_the_nearest(catalogue: SqlCatalogue, call: object, message: str) -> None:
    with pytest.raises(CatalogueError) as error:
        call(catalogue)  # type: ignore[operator]
    assert message in str(error.value)


def test_cages_name_known_materials(catalogue: SqlCatalogue) -> None:
    for name in catalogue.names("cage"):
        assert catalogue.material(catalogue.cage(name).material)


def test_cage_mass_of_the_source(catalogue: SqlCatalogue) -> None:
    """Compare brass and ribbon cages with known masses.

    The brass cage of a 6319 weighs about 1.27 kg, the ribbon of a 6205 7.4 to 9 g (5 %).
    """
    import math

    def mass(cage: str, ball: float, pitch: float) -> float:
        row = catalogue.cage(cage)
        density = catalogue.material(row.material).density.value
        ring = row.fill.value * math.pi * pitch * row.radial_ratio.value * ball * row.axial_ratio.value * ball
        return density * ring

    assert mass("brass-machined", 0.030, 0.1475) == pytest.approx(1.27, rel=0.05)
    assert 0.0070 <= mass("steel-ribbon", 0.00794, 0.03904) <= 0.0090
