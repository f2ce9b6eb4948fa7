"""Compare SKF's series 32 A and 33 A with standards."""

from __future__ import annotations

import math

import pytest
from lambda_db.catalogue import SqlCatalogue

from lambda_core import api
from lambda_core.catalogue.designation import designated
from lambda_core.catalogue.protocol import BearingRow
from lambda_core.formulas.kind_clearance import DOUBLE_ROW
from lambda_core.formulas.life import dynamic_equivalent_load, static_equivalent_load
from lambda_core.formulas.ratings import dynamic_rating, static_rating

UPRATED = 1.05  # SKF Explorer over ISO 281
# SKF, general catalogue 6000, pages 443 and 445: distance a of the pressure centres in whole mm.
PRESSURE_CENTRES = {"3200A": 16, "3205A": 30, "3208A": 46, "3308A": 53, "3213A": 71, "3315A": 97, "3222A": 119}


def rows_of(catalogue: SqlCatalogue) -> list[BearingRow]:
    return [row for row in catalogue.bearings("maker=SKF", 1000) if row.kind == "double row"]


def design(row: BearingRow) -> tuple[int, float, float, float, float]:
    """Return the design of double rows.

    Ball count, ball and pitch diameter, contact angle, distance of the rows (SI).
    """
    values = row.ball_count, row.ball_diameter, row.pitch_diameter, row.contact_angle, row.row_distance
    count, ball, pitch, angle, apart = (value.value for value in values if value is not None)
    return int(count), ball, pitch, angle, apart


def case(name: str, **bearing: str) -> dict[str, object]:
    return {
        "name": "rows",
        "bearing": {"designation": name, **bearing},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "loads": {"axial": "500 N"},
        "operation": {"speed": "1000 rpm"},
    }


def test_ratings_of_every_row(catalogue: SqlCatalogue) -> None:
    """Compare C and C_0 of all 42 rows.

    Whole standard balls: C_0 within 1.7 %, C within 3.6 %, medians 0.7 and 0.6 %.

    Shoulders of the inner ring, which were not used, stand 0.17 to 0.28 D_w over the raceways.
    """
    rows = rows_of(catalogue)
    assert len(rows) == 42
    dynamic, static, heights = [], [], []
    for row in rows:
        count, ball, pitch, angle, _ = design(row)
        assert row.dynamic_rating is not None
        assert row.static_rating is not None
        class_of_maker = UPRATED if "Explorer" in row.rating_type else 1.0
        computed = class_of_maker * dynamic_rating(count, ball, pitch, contact_angle=angle, rows=2)
        dynamic.append(abs(computed / row.dynamic_rating.value - 1.0))
        computed = static_rating(count, ball, pitch, contact_angle=angle, outer_conformity=0.52, rows=2)
        static.append(abs(computed / row.static_rating.value - 1.0))
        if row.shoulder_diameter_inner is not None:
            heights.append((row.shoulder_diameter_inner.value - pitch + ball) / (2.0 * ball))
    assert max(dynamic) < 0.036
    assert max(static) < 0.017
    assert sorted(dynamic)[21] < 0.006
    assert sorted(static)[21] < 0.0075
    assert len(heights) == 21
    assert (min(heights), max(heights)) == pytest.approx((0.17, 0.28), abs=0.01)


@pytest.mark.parametrize(("name", "printed"), PRESSURE_CENTRES.items())
def test_distance_of_the_rows(catalogue: SqlCatalogue, name: str, printed: float) -> None:
    """Compare row distance + d_m tan(30 deg) with a.

    Lines of contact meet the axis a apart, within the rounding of a, 0.5 mm.
    """
    _, _, pitch, angle, apart = design(catalogue.bearing(name, "SKF"))
    assert 1e3 * (apart + pitch * math.tan(angle)) == pytest.approx(printed, abs=0.01)
    assert catalogue.bearing(name, "SKF").row_distance is not None


def test_rows_have_their_place(catalogue: SqlCatalogue) -> None:
    """Keep rows inside the bearing and clear of balls.

    Rows are about a ball apart (0.86 to 1.14 D_w), and grooves lie within the width.
    """
    for row in rows_of(catalogue):
        count, ball, pitch, _, apart = design(row)
        assert 0.86 < apart / ball < 1.14
        assert math.hypot(apart, pitch * math.sin(0.5 * math.pi / count)) > ball
        assert apart + 0.85 * ball < row.width.value


def test_factors_as_printed() -> None:
    """Compare with page 440, table 3, exactly.

    e 0.8, X 0.63, Y_1 0.78, Y_2 1.24, Y_0 0.66.
    """
    angle = math.radians(30.0)
    below = dynamic_equivalent_load(1000.0, 100.0, 1e4, 14.0, angle, 2)
    above = dynamic_equivalent_load(1000.0, 900.0, 1e4, 14.0, angle, 2)
    assert (below.limit, below.axial_factor) == pytest.approx((0.8, 0.78))
    assert (above.radial_factor, above.axial_factor) == pytest.approx((0.63, 1.24))
    assert static_equivalent_load(1000.0, 1000.0, angle, 2) == pytest.approx(1660.0)


def test_clearance(catalogue: SqlCatalogue) -> None:
    """Compare clearances of a 40 mm bore, page 438.

    CN 9 to 29, C3 21 to 40 um along the shaft; values and preload are accepted too.
    """
    limits = DOUBLE_ROW.limits(0.04, "CN")
    assert (limits.minimum, limits.maximum) == pytest.approx((9e-6, 29e-6))

    def axial(**bearing: str) -> float:
        g = api.check(case("3208 A", **bearing)).geometry
        distance = g.groove_radius_inner + g.groove_radius_outer - g.ball_diameter
        return 2.0 * distance * (math.sin(g.contact_angle) - math.sin(g.resting_angle))

    assert axial() == pytest.approx(19e-6)
    assert axial(clearance="C3") == pytest.approx(30.5e-6)
    assert axial(axial_clearance="-5 um") == pytest.approx(-5e-6)
    with pytest.raises(api.CaseError, match="is a radial clearance"):
        axial(clearance="20 um")


@pytest.mark.parametrize("written", ["3208 A", "SKF 3208 ATN9/C3", "3208A-2RS1", "3208A"])
def test_designations(catalogue: SqlCatalogue, written: str) -> None:
    row, _ = designated(catalogue, written)
    assert (row.designation, row.kind) == ("3208A", "double row")


def test_masses(catalogue: SqlCatalogue) -> None:
    """Compare masses with SKF to 7 %.

    Rings, balls and cage; the printed mass was not used. The median of ten counts.
    """
    found = []
    for name in ("3200A", "3203A", "3206A", "3208A", "3210A", "3212A", "3305A", "3308A", "3312A", "3214A"):
        model = api.check(case(name))
        count, ball, *_ = design(catalogue.bearing(name, "SKF"))
        balls = 2 * count * model.ball_material.density * math.pi / 6.0 * ball**3
        complete = model.inner_ring.mass + model.outer_ring.mass + model.cage_body.mass + balls
        mass = catalogue.bearing(name, "SKF").mass
        assert mass is not None
        found.append(complete / mass.value)
    assert sorted(found)[5] == pytest.approx(1.0, abs=0.07)
