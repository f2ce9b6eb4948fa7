"""Test that the cross-section is to scale."""

from __future__ import annotations

import pytest
from lambda_db.catalogue import SqlCatalogue
from lambda_db.drawing import BALL, RING, cross_section


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
