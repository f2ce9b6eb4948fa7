"""Test views of studies.

What each plots of a table whose numbers are known.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from collisions import no_collision

from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import UsageError
from lambda_core.export.report.gallery import data_of
from lambda_core.views.chart import Panel, Series, ViewData
from lambda_core.views.method import NotApplicable
from lambda_core.views.table import Column, PointState, StudyTable

SPEEDS, LOADS = (500.0, 1000.0, 2000.0, 4000.0), (1.0, 2.0, 4.0)


def torque(speed: float, load: float) -> float:
    return 0.1 * speed + 50.0 * load


def table(failed: tuple[int, ...] = (), design: str = "crossed", **more: Column) -> StudyTable:
    """Return a study with failed points.

    Of speed and load, crossed; points `failed` have no result.
    """
    pairs = [(speed, load) for speed in SPEEDS for load in LOADS]

    def column(name: str, unit: str, label: str, values: list[float]) -> Column:
        return Column(name, unit, label, tuple(None if i in failed else v for i, v in enumerate(values)))

    parameters = (
        Column("operation.speed", "rpm", "speed", tuple(s for s, _ in pairs)),
        Column("loads.radial", "kN", "radial load", tuple(f for _, f in pairs)),
    )
    responses = (
        column("friction_torque_Nmm", "N mm", "friction torque", [torque(*pair) for pair in pairs]),
        column("friction_breakdown_Nmm.rolling_inner", "N mm", "rolling inner", [0.06 * s for s, _ in pairs]),
        column("friction_breakdown_Nmm.rolling_outer", "N mm", "rolling outer", [0.04 * s for s, _ in pairs]),
        column("friction_breakdown_Nmm.sliding_inner", "N mm", "sliding inner", [50.0 * f for _, f in pairs]),
        column("cage_speed_deviation", "", "deviation of the cage speed", [1e-4 * s / f for s, f in pairs]),
    )
    states: tuple[PointState, ...] = tuple("failed" if i in failed else "done" for i in range(len(pairs)))
    reasons = tuple("no equilibrium" if state == "failed" else "" for state in states)
    return StudyTable("t", "A study", "dynamic", design, parameters, responses, states, reasons, ("",) * len(pairs))


def data(of: StudyTable, name: str, **options: Any) -> ViewData:
    found = data_of(registry().view(name), of, options)
    json.dumps(found.as_dict(), allow_nan=False)
    no_collision(found)
    return found


def series(panel: Panel, name: str) -> Series:
    return next(s for s in panel.series if s.name == name)


def test_curves_follow_the_table() -> None:
    found = data(table(), "study-curves", response="friction_torque_Nmm")
    (panel,) = found.panels
    assert (panel.x.text, panel.y.text, panel.x.log) == ("speed [rpm]", "friction torque [N mm]", True)
    assert [s.name for s in panel.series] == [f"radial load {load:g} kN" for load in LOADS]
    for load, one in zip(LOADS, panel.series, strict=True):
        np.testing.assert_allclose(one.x, SPEEDS)
        np.testing.assert_allclose(one.y, [torque(speed, load) for speed in SPEEDS])
    other = data(table(), "study-curves", response="friction_torque_Nmm", x="loads.radial").panels[0]
    assert len(other.series) == len(SPEEDS)


def test_a_map_is_the_table_on_a_mesh() -> None:
    found = data(table(), "study-map", response="friction_torque_Nmm")
    field = found.panels[0].field
    assert field is not None
    assert field.text == "friction torque [N mm]"
    np.testing.assert_allclose(field.values, [[torque(s, f) for f in LOADS] for s in SPEEDS])
    np.testing.assert_allclose(field.x[:, 0], SPEEDS)
    np.testing.assert_allclose(field.y[0], LOADS)
    assert all(field.values.min() <= level <= field.values.max() for level in field.levels)
    assert len(field.levels) >= 3


def with_a_third(design: str) -> StudyTable:
    """Return the study with oil temperatures.

    They go up and down from point to point.
    """
    oil = Column("lubricant.temperature", "degC", "oil temperature", tuple(40.0 + 30.0 * (i % 2) for i in range(12)))
    return StudyTable(**{**vars(table()), "parameters": (*table().parameters, oil), "design": design})


@pytest.mark.parametrize("design", ["crossed", "saltelli", "sobol", "latin-hypercube", "zipped"])
@pytest.mark.parametrize("view", ["study-map", "stability-map"])
def test_no_map_is_drawn_through_points_that_differ_in_a_third_parameter(design: str, view: str) -> None:
    with pytest.raises(NotApplicable, match="oil temperature varies too"):
        data(with_a_third(design), view)


def test_points_scattered_over_two_parameters_are_interpolated_and_it_is_said() -> None:
    found = data(table(design="latin-hypercube"), "study-map", response="friction_torque_Nmm")
    assert found.notes == ("interpolated linearly between 12 scattered points",)


def test_methods_stand_on_one_axis_with_the_simulation() -> None:
    """Draw the friction torque in one panel.

    The comparison is the point, whoever computed it.
    """
    torques = table().response("friction_torque_Nmm")
    skf = Column("skf/friction/total", "N mm", "total friction torque", tuple(2.0 * v for v in torques.numbers()))
    film = Column("min_film_um", "um", "smallest film under load", torques.values)
    both = StudyTable(**{**vars(table()), "responses": (torques, film, skf)})
    found = data(both, "study-curves")
    first, second = found.panels
    assert (first.y.text, second.y.text) == ("friction torque [N mm]", "smallest film under load [um]")
    names = [s.name for s in first.series]
    assert names[0] == "simulation, radial load 1 kN"
    assert names[3] == "SKF, radial load 1 kN"
    np.testing.assert_allclose(first.series[3].y, 2.0 * first.series[0].y)
    static = StudyTable(**{**vars(both), "mode": "quasi-static"})
    assert data(static, "study-curves").notes == ("the quasi-static solution has no cage",)


def test_one_parameter_alone_has_no_sensitivity() -> None:
    one = StudyTable(**{**vars(table()), "parameters": table().parameters[:1]})
    with pytest.raises(NotApplicable, match="speed alone varies"):
        data(one, "sensitivity")


def test_points_without_a_result_are_holes_with_a_mark() -> None:
    found = data(table(failed=(4,)), "study-map", response="friction_torque_Nmm")
    panel = found.panels[0]
    assert panel.field is not None
    assert np.isnan(panel.field.values[1, 1])
    assert np.isfinite(panel.field.values).sum() == 11
    marked = series(panel, "failed")
    assert (marked.x.tolist(), marked.y.tolist()) == ([1000.0], [2.0])
    assert "points without a result" in found.notes[0]


def test_a_stack_adds_up_to_the_torque() -> None:
    found = data(table(), "friction-stack")
    assert [panel.title for panel in found.panels] == [f"radial load {load:g} kN" for load in LOADS]
    for load, panel in zip(LOADS, found.panels, strict=True):
        assert panel.stacked
        np.testing.assert_allclose(sum(s.y for s in panel.series), [torque(speed, load) for speed in SPEEDS])
        np.testing.assert_allclose(series(panel, "rolling").y, 0.1 * np.array(SPEEDS))
        np.testing.assert_allclose(series(panel, "sliding").y, 50.0 * load)
    assert len({panel.y.high for panel in found.panels}) == 1  # to be compared
    over_load = data(table(), "friction-stack", x="loads.radial").panels
    assert over_load[0].x.text == "radial load [kN]"
    np.testing.assert_allclose(series(over_load[0], "sliding").y, 50.0 * np.array(LOADS))


def test_a_stack_does_not_fall_to_zero_where_a_point_failed() -> None:
    found = data(table(failed=(4,)), "friction-stack")
    middle = found.panels[1]
    np.testing.assert_allclose(middle.series[0].x, [500.0, 2000.0, 4000.0])
    assert min(s.y.min() for s in middle.series if s.name == "sliding") == pytest.approx(100.0)
    assert found.notes == ("1 points without a result are left out",)
    with pytest.raises(NotApplicable, match="fewer than two points"):
        data(table(failed=tuple(range(1, 12))), "friction-stack")


def test_the_stability_map_judges_every_point() -> None:
    found = data(table(), "stability-map", limit=0.1)
    (panel,) = found.panels
    stable, unstable = series(panel, "stable"), series(panel, "unstable")
    assert len(stable.x) + len(unstable.x) == 12
    assert all(1e-4 * s / f <= 0.1 for s, f in zip(stable.x, stable.y, strict=True))
    assert all(1e-4 * s / f > 0.1 for s, f in zip(unstable.x, unstable.y, strict=True))
    assert panel.field is not None
    assert panel.field.lines is not None
    np.testing.assert_allclose(panel.field.lines, panel.field.values - 0.1)
    assert panel.field.line_name == "limit 0.1"
    assert [s.name for s in data(table(), "stability-map", limit=10.0).panels[0].series] == ["stable"]
    lacking = StudyTable(**{**vars(table()), "responses": table().responses[:1]})
    with pytest.raises(NotApplicable, match="choose another with response=NAME"):
        data(lacking, "stability-map")


def test_sensitivities_are_bars_for_every_parameter() -> None:
    found = data(table(), "sensitivity", response="friction_torque_Nmm")
    (panel,) = found.panels
    assert panel.x.categories == ("speed", "radial load")
    regression = series(panel, "standardised regression")
    numbers = table().response("friction_torque_Nmm").numbers()
    speed, load = (column.numbers() for column in table().parameters)
    # The torque is linear in both, and both vary independently: change by one standard deviation.
    np.testing.assert_allclose(regression.y, [0.1 * speed.std() / numbers.std(), 50.0 * load.std() / numbers.std()])
    assert "linear part 100 %" in panel.title
    assert "Spearman" in found.notes[0]


def test_a_study_of_names_has_no_map() -> None:
    laws = Column("models.traction", "", "traction law", ("a", "b", "c") * 4)
    only = StudyTable(**{**vars(table()), "parameters": (table().parameters[0], laws)})
    with pytest.raises(NotApplicable, match="two numeric parameters"):
        data(only, "study-map")
    assert [s.name for s in data(only, "study-curves").panels[0].series] == ["a", "b", "c"]


def test_options_that_would_do_nothing_are_refused() -> None:
    with pytest.raises(UsageError, match='"y" is not a known option'):
        data(table(), "study-curves", y="loads.radial")
    with pytest.raises(UsageError, match='"response" is not a known option'):
        data(table(), "friction-stack", response="friction_torque_Nmm")
    with pytest.raises(UsageError, match=r'"loads\.radal" is not .*; nearest: loads\.radial'):
        data(table(), "study-map", x="loads.radal")


def test_named_values_have_positions_of_their_own() -> None:
    """Draw names of oils at their positions.

    The study has names alone.
    """
    oils = Column("lubricant.name", "", "oil", ("thin", "middle", "thick"))
    torques = Column("friction_torque_Nmm", "N mm", "friction torque", (75.0, 84.0, 105.0))
    loads = Column("max_load_N", "N", "largest load", (1697.6802, 1697.6801, 1697.6795))
    states: tuple[PointState, ...] = ("done",) * 3
    study = StudyTable("t", "Oils", "quasi-static", "crossed", (oils,), (torques, loads), states, ("",) * 3, ("",) * 3)
    first, second = data(study, "study-curves").panels
    assert first.x.categories == ("thin", "middle", "thick")
    np.testing.assert_array_equal(first.series[0].x, [0.0, 1.0, 2.0])
    np.testing.assert_array_equal(first.series[0].y, torques.numbers())
    assert second.y.least == pytest.approx(1.6976802)  # [N] rounding in the seventh digit looks flat
