"""Test the derivation of rollers in the catalogue.

Every row is derived again (docs/catalogue.md, section Rollers) from what its maker prints, and checked against printed
numbers that the derivation does not use: the rating C of cylindrical rollers, the room that a full complement leaves,
the pressure centre of tapered ones.
"""

from __future__ import annotations

import math

import pytest
from lambda_db.catalogue import SqlCatalogue
from scipy.optimize import brentq

from lambda_core.catalogue.protocol import RollerRow
from lambda_core.elements.roller.rib import tapered_angles
from lambda_core.elements.roller.roller_ratings import roller_dynamic_rating, roller_static_rating

# SKF general catalogue (6000 edition), pages 523 to 537: raceways F and E, shoulders d_1 and D_1 [mm]
RINGS = {
    "204": (26.5, 41.5, 29.7, 38.8),
    "205": (31.5, 46.5, 34.7, 43.8),
    "206": (37.5, 55.5, 41.2, 52.5),
    "207": (44.0, 64.0, 48.1, 60.7),
    "208": (49.5, 71.5, 54.0, 67.9),
    "209": (54.5, 76.5, 59.0, 73.0),
    "210": (59.5, 81.5, 64.0, 78.0),
    "211": (66.0, 90.0, 70.8, 86.3),
    "212": (72.0, 100.0, 77.5, 95.7),
    "213": (78.5, 108.5, 84.4, 104.0),
    "214": (83.5, 113.5, 89.4, 109.0),
    "215": (88.5, 118.5, 94.3, 114.0),
    "216": (95.3, 127.3, 101.0, 123.0),
    "304": (27.5, 45.5, 31.2, 42.4),
    "305": (34.0, 54.0, 38.1, 50.7),
    "306": (40.5, 62.5, 45.0, 58.9),
    "307": (46.2, 70.2, 51.0, 66.3),
    "308": (52.0, 80.0, 57.5, 75.6),
    "309": (58.5, 88.5, 64.4, 83.8),
    "310": (65.0, 97.0, 71.2, 92.1),
    "311": (70.5, 106.5, 77.5, 101.0),
    "312": (77.0, 115.0, 84.3, 110.0),
}
# the same, pages 564 and 565: raceway E, shoulders d_1 and D_1 [mm]
FULL = {
    "NCF 3004": (36.8, 29.0, 33.0),
    "NCF 3005": (42.5, 34.0, 39.0),
    "NCF 3006": (49.6, 40.0, 45.0),
    "NCF 3007": (55.5, 45.0, 51.0),
    "NCF 3009": (66.9, 55.0, 62.0),
    "NCF 3010": (72.3, 59.0, 68.0),
    "NCF 3011": (83.5, 68.0, 79.0),
    "NCF 3012": (86.7, 71.0, 82.0),
    "NCF 3013": (93.1, 78.0, 88.0),
    "NCF 2912": (78.65, 69.0, 74.5),
    "NCF 2914": (92.5, 80.5, 88.5),
}
# NSK CAT. No. E1102e, pages B262 to B265: F_w [mm]
NEEDLES = {"NA 4904": 25.0, "NA 4906": 35.0, "NA 4907": 42.0, "NA 4908": 48.0, "NA 4909": 52.0, "NA 4910": 58.0}
# pages B346 and B350: standard rollers and needles [mm]
ROLLERS = (4.0, 4.5, 5.0, 5.5, 6.0, 6.5, 7.0, 7.5, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0)
NEEDLE_ROLLERS = (2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0)
# designation, maker, width of the cup, pressure centre a from the cup's back [mm], e, Y, Y_0: SKF, pages 619 to 623;
# NSK, pages B113 to B121
TAPERED = """
30204 NSK 12 11 0.35 1.7 0.96
30205 NSK 13 12.7 0.37 1.6 0.88
30206 NSK 14 13.9 0.37 1.6 0.88
30207 NSK 15 15 0.37 1.6 0.88
30208 NSK 16 16.6 0.37 1.6 0.88
30209 NSK 16 18.3 0.41 1.5 0.81
30210 NSK 17 19.6 0.42 1.4 0.79
30211 NSK 18 20.9 0.41 1.5 0.81
30212 NSK 19 22 0.41 1.5 0.81
30213 NSK 20 23.8 0.41 1.5 0.81
30214 NSK 21 25.7 0.42 1.4 0.79
30215 NSK 22 27 0.44 1.4 0.76
30216 NSK 22 28.1 0.42 1.4 0.79
30304 NSK 13 11.6 0.3 2 1.1
30305 NSK 15 13.2 0.3 2 1.1
30307 NSK 18 16.7 0.32 1.9 1.1
30308 NSK 20 19.5 0.35 1.7 0.96
30309 NSK 22 21.1 0.35 1.7 0.96
30310 NSK 23 23.1 0.35 1.7 0.96
30311 NSK 25 24.6 0.35 1.7 0.96
30312 NSK 26 26 0.35 1.7 0.96
30313 NSK 28 27.9 0.35 1.7 0.96
30314 NSK 30 29.7 0.35 1.7 0.96
30315 NSK 31 31.8 0.35 1.7 0.96
30316 NSK 33 34 0.35 1.7 0.96
31305 NSK 13 19.9 0.83 0.73 0.40
31306 NSK 14 23.1 0.83 0.73 0.40
31307 NSK 15 25.2 0.83 0.73 0.40
31308 NSK 17 28.7 0.83 0.73 0.40
31309 NSK 18 31.5 0.83 0.73 0.40
31310 NSK 19 34.2 0.83 0.73 0.40
31311 NSK 21 37 0.83 0.73 0.40
31312 NSK 22 40.3 0.83 0.73 0.40
31313 NSK 23 43.2 0.83 0.73 0.40
31314 NSK 25 45.7 0.83 0.73 0.40
31315 NSK 26 48.7 0.83 0.73 0.40
31316 NSK 27 51.8 0.83 0.73 0.40
32005 NSK 11.5 11.8 0.43 1.4 0.77
32006 NSK 13 13.5 0.43 1.4 0.77
32007 NSK 14 15 0.45 1.3 0.73
32009 NSK 15.5 16.6 0.39 1.5 0.84
32010 NSK 15.5 17.9 0.42 1.4 0.78
32011 NSK 17.5 19.7 0.41 1.5 0.81
32012 NSK 17.5 20.9 0.43 1.4 0.77
32013 NSK 17.5 22.4 0.46 1.3 0.72
32014 NSK 19 23.7 0.43 1.4 0.76
32015 NSK 19 25.1 0.46 1.3 0.72
32016 NSK 22 26.9 0.42 1.4 0.78
32206 NSK 17 15.4 0.37 1.6 0.88
32207 NSK 19 17.9 0.37 1.6 0.88
32209 NSK 19 20.1 0.41 1.5 0.81
32210 NSK 19 21 0.42 1.4 0.79
32211 NSK 21 22.7 0.41 1.5 0.81
32212 NSK 24 24.1 0.41 1.5 0.81
32213 NSK 27 27.1 0.41 1.5 0.81
32214 NSK 27 28.6 0.42 1.4 0.79
32215 NSK 27 29.8 0.44 1.4 0.76
32304 NSK 18 13.9 0.3 2 1.1
32305 NSK 20 15.6 0.3 2 1.1
32306 NSK 23 18 0.32 1.9 1.1
32307 NSK 25 20.7 0.32 1.9 1.1
32308 NSK 27 23.4 0.35 1.7 0.96
32309 NSK 30 25.0 0.35 1.7 0.96
32310 NSK 33 27.9 0.35 1.7 0.96
32311 NSK 35 29.9 0.35 1.7 0.96
32312 NSK 37 31.4 0.35 1.7 0.96
32313 NSK 39 34 0.35 1.7 0.96
32314 NSK 42 36 0.35 1.7 0.96
32315 NSK 45 38.9 0.35 1.7 0.96
32316 NSK 48 41.3 0.35 1.7 0.96
33005 NSK 14 11 0.29 2.1 1.1
33006 NSK 16 13.1 0.29 2.1 1.1
33007 NSK 17 14.1 0.31 2 1.1
33008 NSK 18 14.6 0.28 2.1 1.2
33009 NSK 19 16.3 0.29 2 1.1
33010 NSK 19 17.4 0.32 1.9 1
33011 NSK 21 19.2 0.31 1.9 1.1
33012 NSK 21 20 0.33 1.8 1.0
33013 NSK 21 21.1 0.35 1.7 0.95
33014 NSK 25.5 22.2 0.28 2.1 1.2
33015 NSK 25.5 23 0.30 2 1.1
33016 NSK 29.5 25.5 0.28 2.2 1.2
30204 SKF 12 11 0.35 1.7 0.9
30205 SKF 13 12 0.37 1.6 0.9
30206 SKF 14 14 0.37 1.6 0.9
30207 SKF 15 15 0.37 1.6 0.9
30208 SKF 16 16 0.37 1.6 0.9
30209 SKF 16 18 0.4 1.5 0.8
30210 SKF 17 19 0.43 1.4 0.8
30304 SKF 13 11 0.3 2 1.1
30305 SKF 15 13 0.3 2 1.1
30306 SKF 16 15 0.31 1.9 1.1
30307 SKF 18 16 0.31 1.9 1.1
30308 SKF 20 19 0.35 1.7 0.9
31305 SKF 13 20 0.83 0.72 0.4
31306 SKF 14 22 0.83 0.72 0.4
31307 SKF 15 25 0.83 0.72 0.4
32005 SKF 11.5 11 0.43 1.4 0.8
32006 SKF 13 13 0.43 1.4 0.8
32009 SKF 15.5 16 0.4 1.5 0.8
32010 SKF 15.5 18 0.43 1.4 0.8
32206 SKF 17 15 0.37 1.6 0.9
32207 SKF 19 17 0.37 1.6 0.9
32210 SKF 19 21 0.43 1.4 0.8
32304 SKF 18 14 0.3 2 1.1
32305 SKF 20 15 0.3 2 1.1
32306 SKF 23 18 0.31 1.9 1.1
32307 SKF 25 20 0.31 1.9 1.1
32308 SKF 27 23 0.35 1.7 0.9
32310 SKF 33 27 0.35 1.7 0.9
33010 SKF 19 17 0.31 1.9 1.1
"""
CHAMFERS = 0.2  # roller length over contact length, in diameters: the default of `bearing.rollers.roller_length`


def named(catalogue: SqlCatalogue, designation: str, maker: str) -> RollerRow:
    """Return a roller bearing of a maker."""
    (row,) = (row for row in catalogue.rollers() if (row.designation, row.maker) == (designation, maker))
    return row


def derived(catalogue: SqlCatalogue, how: str) -> list[RollerRow]:
    """Return the rows of a derivation, named by its source."""
    rows = [
        row for row in catalogue.rollers() if row.roller_count.source.startswith(f"derived (docs/catalogue.md): {how}")
    ]
    assert rows
    return rows


def contact_length(row: RollerRow, count: int, diameter: float, pitch: float, angle: float = 0.0) -> float:
    """Return the contact length that C_0 needs (ISO 76) [mm]."""
    one = roller_static_rating(count, diameter * 1e-3, 1e-3, pitch * 1e-3, contact_angle=angle)
    return row.static_rating.value / one


def rating_ratio(row: RollerRow) -> float:
    """Return the printed C over that of ISO 281."""
    shape = (int(row.roller_count.value), row.roller_diameter.value, row.effective_length.value)
    angle = row.contact_angle.value if row.contact_angle else 0.0
    return row.dynamic_rating.value / roller_dynamic_rating(*shape, row.pitch_diameter.value, contact_angle=angle)


def is_row(row: RollerRow, count: int, diameter: float, pitch: float, length: float) -> None:
    """Fail unless the row has these rollers [mm]."""
    assert row.roller_count.value == count, row.designation
    given = (row.roller_diameter, row.pitch_diameter, row.effective_length, row.roller_length)
    lengths = (diameter, pitch, length, length + CHAMFERS * diameter)
    assert [1e3 * value.value for value in given] == pytest.approx(lengths, abs=0.0151), row.designation


def room(row: RollerRow) -> float:
    """Return the pitch of the rollers in their diameters."""
    return math.pi * row.pitch_diameter.value / (row.roller_count.value * row.roller_diameter.value)


def test_cylindrical_rollers_follow_from_the_rings(catalogue: SqlCatalogue) -> None:
    rows = derived(catalogue, "diameter and pitch of the rollers from the raceway")
    for row in rows:
        series, number = row.designation.split()[1][:-2], row.designation[-2:]
        bore, outside, inner_shoulder, outer_shoulder = RINGS[("3" if series == "3" else "2") + number]
        diameter, pitch = 0.5 * (outside - bore), 0.5 * (outside + bore)
        count = int(math.pi * pitch / (1.2 * diameter))
        is_row(row, count, diameter, pitch, contact_length(row, count, diameter, pitch))
        ribs = 0.25 * (inner_shoulder - bore + outside - outer_shoulder)
        assert row.rib_height is not None
        assert 1e3 * row.rib_height.value == pytest.approx(ribs, abs=0.0501)
    assert {row.series for row in rows} == {"2", "22", "3"}


def test_ratings_of_cylindrical_rollers_confirm_them(catalogue: SqlCatalogue) -> None:
    """Compare C, which gave no cylindrical roller.

    SKF rates sizes 204 and 205 after ISO 281; all others are Explorer bearings, which SKF rates 1.15 times higher.
    """
    for row in derived(catalogue, "diameter and pitch of the rollers from the raceway"):
        plain = row.designation[-3:] in ("204", "205") and row.series != "3"
        assert rating_ratio(row) == pytest.approx(1.0 if plain else 1.15, rel=0.02), row.designation


def test_full_complements_close_on_the_pitch_circle(catalogue: SqlCatalogue) -> None:
    """Find the roller by C; room and ribs confirm it."""
    rows = {row.designation: row for row in derived(catalogue, "pitch from E")}
    assert rows.keys() == FULL.keys()
    for name, (outside, inner_shoulder, outer_shoulder) in FULL.items():
        row = rows[name]

        def off(diameter: float, row: RollerRow = row, outside: float = outside) -> float:
            count, pitch = int(math.pi / math.asin(diameter / (outside - diameter))), outside - diameter
            length = contact_length(row, count, diameter, pitch)
            rating = roller_dynamic_rating(count, diameter * 1e-3, length * 1e-3, pitch * 1e-3)
            return abs(row.dynamic_rating.value / rating - 1.0)

        diameter = min(ROLLERS, key=off)
        pitch = outside - diameter
        count = int(math.pi / math.asin(diameter / pitch))
        is_row(row, count, diameter, pitch, contact_length(row, count, diameter, pitch))
        assert rating_ratio(row) == pytest.approx(1.0, abs=0.01 if row.roller_count.grade == "B" else 0.02), name
        assert 1.0 <= pitch * math.sin(math.pi / count) / diameter < 1.005, name  # of the pitch circle's chord
        inner, outer = 0.5 * (inner_shoulder - outside) + diameter, 0.5 * (outside - outer_shoulder)
        assert inner == pytest.approx(outer, abs=0.45), name


def test_needles_follow_from_the_ratings(catalogue: SqlCatalogue) -> None:
    rows = {row.designation: row for row in derived(catalogue, "pitch from F_w")}
    assert rows.keys() == NEEDLES.keys()
    for name, bore in NEEDLES.items():
        row = rows[name]
        found = {}
        for diameter in NEEDLE_ROLLERS:
            count, pitch = int(math.pi * (bore + diameter) / (1.2 * diameter)), bore + diameter
            length = contact_length(row, count, diameter, pitch)
            rating = roller_dynamic_rating(count, diameter * 1e-3, length * 1e-3, pitch * 1e-3)
            found[diameter] = (abs(row.dynamic_rating.value / rating - 1.0), count, pitch, length)
        diameter = min(found, key=found.__getitem__)
        off, *rest = found[diameter]
        is_row(row, rest[0], diameter, rest[1], rest[2])
        assert off < 0.015 < 0.04 < sorted(found.values())[1][0], name  # the next needle is far off


def tapered(row: RollerRow, angle: float) -> tuple[int, float, float]:
    """Derive number, diameter and contact length [mm] of tapered rollers."""
    pitch = 0.5e3 * (row.bore_diameter.value + row.outside_diameter.value)

    def off(diameter: float, count: int) -> float:
        length = contact_length(row, count, diameter, pitch, angle)
        size = (diameter * 1e-3, length * 1e-3, pitch * 1e-3)
        return roller_dynamic_rating(count, *size, contact_angle=angle) / row.dynamic_rating.value - 1.0

    diameters = {count: float(brentq(off, 0.03 * pitch, 0.35 * pitch, args=(count,))) for count in range(9, 32)}
    count = min(diameters, key=lambda one: abs(math.pi * pitch / (one * diameters[one]) - 1.1))
    return count, diameters[count], contact_length(row, count, diameters[count], pitch, angle)


def cup_angle(limit: float, static: str) -> float:
    """Return the cup angle of e and Y_0 [rad].

    It is the middle of what both roundings allow, and of what e allows where they exclude each other.
    """
    digit = 0.5 * 10.0 ** -len(static.partition(".")[2])
    low, high = (math.atan((limit + one) / 1.5) for one in (-0.005, 0.005))
    other = [math.atan(0.22 / (float(static) + one)) for one in (digit, -digit)]
    if max(low, other[0]) <= min(high, other[1]):
        low, high = max(low, other[0]), min(high, other[1])
    return 0.5 * (low + high)


PRINTED = [line.split() for line in TAPERED.split("\n") if line]


@pytest.mark.parametrize("printed", PRINTED, ids=" ".join)
def test_tapered_rollers_follow_from_ratings_and_angle(catalogue: SqlCatalogue, printed: list[str]) -> None:
    """Derive tapered rollers; e, Y and a confirm them."""
    row = named(catalogue, *printed[:2])
    cup, centre, limit, factor = map(float, printed[2:6])
    angle = cup_angle(limit, printed[6])
    assert row.contact_angle is not None
    assert row.contact_angle.value == pytest.approx(angle, abs=math.radians(0.0051))
    assert 1.5 * math.tan(angle) == pytest.approx(limit, abs=0.006)
    assert 0.4 / math.tan(angle) == pytest.approx(factor, rel=0.035)
    count, diameter, length = tapered(row, row.contact_angle.value)
    pitch = 0.5e3 * (row.bore_diameter.value + row.outside_diameter.value)
    is_row(row, count, diameter, pitch, length)
    assert 1.05 < room(row) < 1.15
    # the normal of the cup's raceway in the middle of the cup meets the axis at the pressure centre
    half = tapered_angles(diameter * 1e-3, pitch * 1e-3, angle).half
    radius = 0.5 * (pitch + diameter * math.cos(angle - half))
    assert 0.5 * cup + radius * math.tan(angle) == pytest.approx(centre, abs=1.5, rel=0.05)


def test_every_derived_tapered_row_is_checked(catalogue: SqlCatalogue) -> None:
    rows = {(row.designation, row.maker) for row in derived(catalogue, "cup angle from e")}
    assert rows == {(name, maker) for name, maker, *_ in PRINTED}


# designation, maker: number and mean diameter of the rollers that are published [mm], and by how much they may differ
PUBLISHED = {
    ("30306", "NSK"): (14, 10.53, 0.01),
    ("32208", "SKF"): (17, 10.0, 0.02),
    ("32008", "SKF"): (23, 6.489, 0.04),
}


@pytest.mark.parametrize(("name", "maker"), PUBLISHED)
def test_the_derivation_finds_published_tapered_rollers(catalogue: SqlCatalogue, name: str, maker: str) -> None:
    count, diameter, tolerance = PUBLISHED[name, maker]
    row = named(catalogue, name, maker)
    assert row.contact_angle is not None
    found = tapered(row, row.contact_angle.value)
    assert found[0] == count
    assert found[1] == pytest.approx(diameter, rel=tolerance)


def test_common_series_have_two_sizes(catalogue: SqlCatalogue) -> None:
    rows = catalogue.rollers()
    for series in ("302", "303", "313", "320", "322", "323", "330"):
        assert len({row.designation for row in rows if row.series == series}) >= 2
    for kind in ("NU", "NJ", "NUP", "N"):
        assert {row.series for row in rows if row.kind == kind} >= {"2", "3"}
