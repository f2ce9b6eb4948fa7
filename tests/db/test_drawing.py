"""Test that the cross-section is to scale."""

from __future__ import annotations

import numpy as np
import pytest
from lambda_db.catalogue import SqlCatalogue
from lambda_db.drawing import BALL, RING, cross_section
from lambda_db.roller_drawing import RollerSection, section_of_rollers

from lambda_core.catalogue.roller_designation import roller_designation


@pytest.mark.parametrize(
    ("designation", "maker"), [("6208", "Syla2026"), ("6319", "Syla2026"), ("61814", "NSK"), ("6411", "SKF")]
)
@pytest.mark.parametrize("height", [12, 17, 40])
def test_to_scale(catalogue: SqlCatalogue, designation: str, maker: str, height: int) -> None:
    row = catalogue.bearing(designation, maker)
    assert row.ball_diameter is not None
    lines = cross_section(row, height).splitlines()
    assert len(lines) == height + 1
    radial = 0.5 * (row.outside_diameter.value - row.bore_diameter.value)
    cell_height = radial / height
    cell_width = 0.5 * cell_height
    widest = max(line.count(BALL) for line in lines)
    assert widest * cell_width == pytest.approx(row.ball_diameter.value, abs=2.5 * cell_width)
    tall = sum(BALL in line for line in lines)
    assert tall * cell_height == pytest.approx(row.ball_diameter.value, abs=2.0 * cell_height)
    assert max(line.count(RING) for line in lines) * cell_width == pytest.approx(row.width.value, abs=2 * cell_width)


def test_mirror_images(catalogue: SqlCatalogue) -> None:
    drawing = cross_section(catalogue.bearing("6208", "SKF"), 21)
    columns = max(line.count(RING) + line.count(BALL) for line in drawing.splitlines())
    for line in drawing.splitlines()[:-1]:
        cells = line.ljust(columns)[:columns]
        assert cells == cells[::-1]


def test_numbers_at_the_side(catalogue: SqlCatalogue) -> None:
    drawing = cross_section(catalogue.bearing("6208", "Syla2026"))
    for text in ("D  80 mm", "d  40 mm", "B  18 mm", "raceway 48.083 mm", "raceway 71.917 mm", "ball 11.91 mm"):
        assert text in drawing


def test_unknown_inner_geometry(catalogue: SqlCatalogue) -> None:
    assert catalogue.bearing("61806", "SKF").ball_count is None
    assert "not known" in cross_section(catalogue.bearing("61806", "SKF"))


@pytest.mark.parametrize(("kind", "ribs"), [("NU", {"outer"}), ("N", {"inner"}), ("NUP", {"inner", "outer"})])
def test_rollers_and_their_ribs_are_to_scale(kind: str, ribs: set[str]) -> None:
    """Draw a roller, and the ribs that rings have."""
    section = RollerSection(kind, 40.0, 80.0, 18.0, 60.5, 11.0, 10.0, rib=2.0)
    points = np.linspace(-9.0, 9.0, 361)
    middle = [section.cell(x, 30.25) for x in points]
    assert 18.0 * middle.count(BALL) / len(middle) == pytest.approx(10.0, abs=0.1)
    assert [section.cell(0.0, r) for r in (24.7, 24.8, 35.7, 35.8)] == [RING, BALL, BALL, RING]
    found = {ring for ring, r in (("inner", 26.0), ("outer", 34.5)) if section.cell(-5.5, r) == RING}
    assert found == ribs


def test_tapered_rollers_lie_on_their_raceways(catalogue: SqlCatalogue) -> None:
    """Leave no room between a cone and both raceways."""
    section = section_of_rollers(roller_designation(catalogue, "32216").row)  # type: ignore[union-attr]
    for x in (-8.0, 0.0, 8.0):
        column = [section.cell(x, r) for r in np.arange(40.0, 70.0, 0.02)]
        first, last = column.index(BALL), len(column) - column[::-1].index(BALL)
        assert column[first - 2] == column[last + 1] == RING
        if x < 0.0:
            large = last - first
    assert large > last - first
