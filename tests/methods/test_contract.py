"""Test the contract of comparison methods.

Registration, tables, and answers that never take each other down.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lambda_plugins.methods import register_methods

from lambda_core.laws.context import Material, Oil
from lambda_core.views.method import (
    GROUP_UNITS,
    ContactLoad,
    EquilibriumState,
    Method,
    MethodInputs,
    MethodRow,
    MethodTable,
    NotApplicable,
    evaluate_methods,
)

STEEL = Material("steel", 210e9, 0.3, 7850.0, 46.0, 460.0)
OIL = Oil("FVA3", "mineral", 335.65, 0.134, 2000.0, 0.0315, 859.1, 18e-9, 0.04)


PARTS = (("sliding inner", 0.2), ("spin inner", 0.1), ("rolling outer", 0.4), ("hysteresis outer", 0.2), ("drag", 0.1))


def contacts(count: int = 9, load: float = 4000.0, angle: float = 0.0) -> tuple[ContactLoad, ...]:
    azimuths = [2.0 * math.pi * i / count for i in range(count)]
    loads = [load * max(-math.sin(psi), 0.0) ** 1.5 for psi in azimuths]  # load zone at the bottom
    return tuple(ContactLoad(psi, q, q, angle, angle) for psi, q in zip(azimuths, loads, strict=True))


def inputs(**changes: Any) -> MethodInputs:
    base = MethodInputs(
        title="6319 (Syla2026)",
        series="63",
        bore_diameter=0.095,
        outside_diameter=0.2,
        width=0.045,
        ball_count=9,
        ball_diameter=0.03,
        pitch_diameter=0.1475,
        groove_radius_inner=0.015375,
        groove_radius_outer=0.01575,
        ball=STEEL,
        inner_ring=STEEL,
        outer_ring=STEEL,
        oil=OIL,
        radial_load=16e3,
        axial_load=0.0,
        inner_speed=1500 * math.pi / 30,
        outer_speed=0.0,
        dynamic_rating=160e3,
        static_rating=112.6e3,
        oil_level=0.0,
        permittivity=lambda pressure: 2.2 + 0.2e-9 * pressure,
        state=EquilibriumState(contacts(), (0.0, 0.0, -30e-6, 0.0, 0.0)),
    )
    return dataclasses.replace(base, **changes)


@pytest.fixture(scope="module")
def methods() -> dict[str, Method]:
    found: list[Method] = []
    register_methods(found.append)
    return {method.name: method for method in found}


def test_registered_through_the_hook(methods: dict[str, Method]) -> None:
    from lambda_core.discovery.manager import registry

    known = registry().methods
    assert set(methods) <= set(known)
    assert set(methods) == {
        "quasi-static",
        "skf",
        "schaeffler",
        "houpert",
        "analytical-capacitance",
        "iso-281",
        "iso-ts-16281",
        "kinematic",
    }
    assert all(method.reference and method.title for method in methods.values())


def test_every_method_answers_a_complete_case(methods: dict[str, Method]) -> None:
    answers = evaluate_methods((one for one in methods.values() if one.is_about(rollers=False)), inputs())
    assert all(answer.table is not None for answer in answers), [answer.reason for answer in answers]
    for answer in answers:
        assert answer.table is not None
        names = [(row.group, row.name) for row in answer.table.rows]
        assert len(names) == len(set(names))
        for row in answer.table.rows:
            assert math.isfinite(row.value)
            assert row.unit in GROUP_UNITS[row.group]


def test_friction_parts_add_up(methods: dict[str, Method]) -> None:
    skf = methods["skf"].evaluate(inputs(drag_volume_factor=3e-5))
    parts = sum(skf.value("friction", name) for name in ("rolling", "sliding", "drag"))
    assert skf.value("friction", "total") == pytest.approx(parts)
    schaeffler = methods["schaeffler"].evaluate(inputs())
    parts = sum(schaeffler.value("friction", name) for name in ("speed dependent", "load dependent"))
    assert schaeffler.value("friction", "total") == pytest.approx(parts)


def test_volume_factor_is_read_from_the_chart(methods: dict[str, Method]) -> None:
    unknown = methods["skf"].evaluate(inputs())
    said = [text for text in unknown.assumptions if "V_M" in text]
    assert len(said) == 1
    assert "SKF's chart" in said[0]
    factor = float(said[0].split()[2])
    known = methods["skf"].evaluate(inputs(drag_volume_factor=factor))
    assert known.value("friction", "total") == pytest.approx(unknown.value("friction", "total"), rel=1e-3)
    assert not any("chart" in text for text in known.assumptions)


def test_older_drag_formula(methods: dict[str, Method]) -> None:
    old = methods["skf"].evaluate(inputs(drag_volume_factor=2e-5, drag_edition="2008"))
    bare = methods["skf"].evaluate(inputs(drag_volume_factor=0.0, drag_edition="2008"))
    expected = 2e-5 * 3.1 * 295 / 105 * 1e-12 * 147.5**5 * 1500.0**2
    assert old.value("friction", "total") - bare.value("friction", "total") == pytest.approx(expected)
    assert any("2008" in text for text in old.assumptions)


@pytest.mark.parametrize(
    ("name", "changes", "sentence"),
    [
        ("skf", {"series": "30"}, "series of the SKF friction table"),
        ("skf", {"series": ""}, "series of the SKF friction table"),
        ("skf", {"axial_load": 500.0, "static_rating": None}, "static load rating"),
        ("schaeffler", {"series": "619"}, "series of the Schaeffler friction table"),
        ("schaeffler", {"static_rating": None}, "static load rating"),
        ("schaeffler", {"lubrication": "oil jet"}, "oil jet"),
        ("analytical-capacitance", {"permittivity": None}, "no permittivity"),
        ("analytical-capacitance", {"inner_speed": 0.0}, "at rest"),
        ("analytical-capacitance", {"state": None}, "quasi-static"),
        ("iso-ts-16281", {"state": None}, "quasi-static"),
        ("quasi-static", {"state": None}, "quasi-static"),
    ],
)
def test_not_applicable_is_a_sentence(
    methods: dict[str, Method], name: str, changes: dict[str, Any], sentence: str
) -> None:
    with pytest.raises(NotApplicable, match=sentence):
        methods[name].evaluate(inputs(**changes))
    answers = evaluate_methods(methods.values(), inputs(**changes))
    by_name = {answer.method.name: answer for answer in answers}
    assert by_name[name].table is None
    assert sentence in by_name[name].reason
    assert by_name["kinematic"].table is not None


def test_bug_in_a_method_is_not_hidden() -> None:
    def broken(_: MethodInputs) -> MethodTable:
        raise ZeroDivisionError

    (answer,) = evaluate_methods([Method("broken", "", "", broken, distribution="mine 1.0")], inputs())
    assert answer.table is None
    assert answer.reason.startswith('the method "broken" (mine 1.0) fails: ZeroDivisionError (test_contract.py, line')


def test_unknown_row_names_the_nearest(methods: dict[str, Method]) -> None:
    table = methods["skf"].evaluate(inputs())
    with pytest.raises(LookupError, match="nearest: friction rolling"):
        table.value("friction", "roling")


def test_unit_of_another_group_is_refused() -> None:
    with pytest.raises(ValueError, match='"pF" is not a unit of friction'):
        MethodRow("friction", "total", 1.0, "pF")


def test_life_says_where_ratings_came_from(methods: dict[str, Method]) -> None:
    given_ratings = methods["iso-281"].evaluate(inputs())
    assert given_ratings.value("life", "basic rating life") == pytest.approx(1000.0)
    assert given_ratings.value("rating", "static safety") == pytest.approx(112.6 / 16.0)
    derived = methods["iso-281"].evaluate(inputs(dynamic_rating=None, static_rating=None))
    assert derived.value("life", "basic rating life") == pytest.approx((143.667 / 16.0) ** 3, rel=1e-4)
    assert any(text.startswith("C = 143.7 kN") for text in derived.assumptions)
    assert any(text.startswith("C_0 = 112.4 kN") for text in derived.assumptions)


def test_modified_life_needs_a_contamination_factor(methods: dict[str, Method]) -> None:
    without = methods["iso-281"].evaluate(inputs())
    assert any("contamination" in text for text in without.assumptions)
    assert "modified rating life" not in [row.name for row in without.rows]
    clean = methods["iso-281"].evaluate(inputs(contamination=0.7))
    factor = clean.value("life", "life modification factor")
    assert clean.value("life", "modified rating life") == pytest.approx(factor * 1000.0)
    thin = dataclasses.replace(OIL, viscosity=OIL.viscosity / 100.0)
    assert any(
        "below 0.1" in text for text in methods["iso-281"].evaluate(inputs(contamination=0.7, oil=thin)).assumptions
    )


def test_at_rest(methods: dict[str, Method]) -> None:
    rest = inputs(inner_speed=0.0)
    skf = methods["skf"].evaluate(rest)
    assert skf.value("friction", "rolling") == 0.0
    assert skf.value("friction", "sliding coefficient") == 0.15
    assert skf.value("friction", "sliding") > 0.0
    assert methods["schaeffler"].evaluate(rest).value("friction", "speed dependent") == 0.0
    life = methods["iso-281"].evaluate(rest)
    assert [row.unit for row in life.rows if row.name.startswith("basic")] == ["1e6 rev"]


def test_direction_of_rotation_does_not_matter(methods: dict[str, Method]) -> None:
    for name in ("skf", "schaeffler", "analytical-capacitance", "iso-281"):
        forward, backward = (methods[name].evaluate(inputs(inner_speed=s)) for s in (150.0, -150.0))
        assert [row.value for row in forward.rows] == [row.value for row in backward.rows]


def test_quasi_static_stiffness_units(methods: dict[str, Method]) -> None:
    matrix = tuple(tuple(float(10 * i + j) * 1e6 for j in range(5)) for i in range(5))
    state = EquilibriumState(contacts(), (1e-6, 0.0, 0.0, 0.0, 0.0), matrix, PARTS)
    table = methods["quasi-static"].evaluate(inputs(state=state))
    assert table.value("stiffness", "x y") == pytest.approx(1.0)  # 1e6 N/m = 1 N/um
    assert table.value("stiffness", "x tilt_y") == pytest.approx(3000.0)  # 3e6 N/rad = 3000 N/mrad
    assert table.value("stiffness", "tilt_z tilt_z") == pytest.approx(44000.0)
    assert sum(row.group == "stiffness" for row in table.rows) == 15
    assert table.value("friction", "total") == pytest.approx(1000.0)
    assert table.value("friction", "sliding") == pytest.approx(300.0)
    assert table.value("friction", "rolling") == pytest.approx(600.0)
    assert table.value("friction", "drag") == pytest.approx(100.0)
    assert table.value("friction", "spin inner") == pytest.approx(100.0)
    assert table.value("load", "displacement x") == pytest.approx(1.0)


@given(st.floats(1e3, 4e4), st.floats(0.0, 1e4), st.floats(10.0, 600.0), st.floats(1.01, 1.5))
def test_friction_grows_with_load(radial: float, axial: float, speed: float, more: float) -> None:
    found: list[Method] = []
    register_methods(found.append)
    for method in found:
        if method.name not in ("skf", "schaeffler"):
            continue
        low, high = (
            method.evaluate(inputs(radial_load=k * radial, axial_load=k * axial, inner_speed=speed)).value(
                "friction", "total"
            )
            for k in (1.0, more)
        )
        assert high > low > 0.0
