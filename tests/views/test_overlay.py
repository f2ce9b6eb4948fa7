"""Test measured points in pictures.

Columns find their axes by name, in the unit of the axis.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.results.reader import Result
from lambda_core.views.chart import Axis, Panel, Series, ViewData
from lambda_core.views.method import NotApplicable


def _temperatures() -> ViewData:
    time = np.array([0.0, 60.0])
    rings = tuple(Series(f"{ring} ring", time, np.array([20.0, 60.0]), role=ring) for ring in ("inner", "outer"))
    loss = Series("loss", time, np.array([10.0, 8.0]))
    axis = Axis("time", "min")
    return ViewData(
        "temperatures", "Temperatures", "case",
        (
            Panel("temperatures", axis, Axis("temperature", "degC"), rings),
            Panel("power loss", axis, Axis("power loss", "W"), (loss,)),
            Panel("over speed", Axis("speed", "1/min"), Axis("power loss", "W"), (loss,)),
        ),
    )  # fmt: skip


def _file(folder: Path, text: str) -> Path:
    path = folder / "rig.csv"
    path.write_text(text)
    return path


def test_points_stand_in_the_unit_of_the_axis_with_their_errors(tmp_path: Path) -> None:
    text = (
        "time [s],outer ring temperature [K],outer ring temperature error [K],power loss [kW],power loss error [%]\n"
        "600,303.15,2,0.009,10\n1800,313.15,2,,10\n"
    )
    (found,) = api.with_measured([_temperatures()], _file(tmp_path, text))
    warm, loss, speed = found.panels
    assert isinstance(warm, Panel)
    assert isinstance(loss, Panel)
    outer = warm.series[-1]
    assert (outer.name, outer.kind, outer.role) == ("outer ring, measured", "points", "outer")
    np.testing.assert_allclose(outer.x, [10.0, 30.0])
    np.testing.assert_allclose(outer.y, [30.0, 40.0])
    assert outer.low is not None
    half = 1.959964 * 2.0  # 95 % of a standard deviation of 2 K
    np.testing.assert_allclose(outer.low, [30.0 - half, 40.0 - half])
    np.testing.assert_allclose(loss.series[-1].y, [9.0])
    assert loss.series[-1].high is not None
    np.testing.assert_allclose(loss.series[-1].high, [9.0 + 1.959964 * 0.9])
    from lambda_plugins.views.drawing import draw

    texts = [text.get_text() for text in draw(found).axes[0].get_legend().get_texts()]
    assert texts.count("bars: 95 % of the error of measurement") == 1
    assert isinstance(speed, Panel)
    assert len(speed.series) == 1
    assert "measured: rig.csv" in found.notes


def test_pictures_without_axes_for_the_file_are_left_out(tmp_path: Path) -> None:
    other = ViewData("film", "Film", "case", (_temperatures().panels[2],))
    found = api.with_measured([other, _temperatures()], _file(tmp_path, "time [s],temperature [degC]\n60,30\n"))
    assert [one.view for one in found] == ["temperatures"]


def test_views_that_were_not_asked_for_have_no_notes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    views = [("heat", NotApplicable("there is no heat")), ("temperatures", _temperatures())]
    monkeypatch.setattr(api, "view_all", lambda sources, bearing: views)
    file = _file(tmp_path, "time [s],temperature [degC]\n60,30\n")
    assert main(["view", str(tmp_path), "--measured", str(file), "--json"]) == 0
    assert "no heat" not in capsys.readouterr().err
    assert main(["view", str(tmp_path), "--json"]) == 0
    assert "heat: there is no heat" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("time [s],torque [N mm]\n1,2\n", 'line 1, column 2       "torque [N mm]" is not a known column'),
        ("time [s],temperature [W]\n1,2\n", "W is not a unit of temperature"),
        ("time [s],temperature [degC]\n1,2\n2,x\n", "line 3, column 2"),
        ("speed [rpm],temperature [degC]\n1,2\n", "rig.csv: no picture has temperature over what is given"),
    ],
)
def test_a_file_that_fits_no_axis_is_refused(text: str, said: str, tmp_path: Path) -> None:
    with pytest.raises((CaseError, UsageError)) as caught:
        api.with_measured([_temperatures()], _file(tmp_path, text))
    assert said in str(caught.value)


def test_measured_capacitance_stands_in_the_view_of_a_run(radial_run: Result, tmp_path: Path) -> None:
    time = float(radial_run["time"][-1])
    file = _file(tmp_path, f"time [s],capacitance [nF]\n{0.8 * time},0.9\n{time},0.95\n")
    (found,) = api.with_measured([api.view(radial_run, "capacitance")], file)
    last = found.panels[-1]
    assert isinstance(last, Panel)
    np.testing.assert_allclose(last.series[-1].y, [900.0, 950.0])
    assert main(["view", str(radial_run.path), "capacitance", "--measured", str(file), "--out", str(tmp_path)]) == 0
    assert list(tmp_path.glob("*-capacitance.svg"))


def test_measured_torque_stands_in_the_curve_over_speed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = _file(tmp_path, "speed [1/min],friction torque [N m]\n800,1.1\n")
    arguments = ["stribeck", "6319-cp10-1500", "--speed", "500 rpm", "--speed", "1500 rpm", "-q"]
    assert main([*arguments, "--draw", str(tmp_path / "pictures"), "--measured", str(file)]) == 0
    assert "rig.csv" in (tmp_path / "pictures" / "6319-cp10-1500-stribeck.svg").read_text()
    assert main([*arguments, "--measured", str(file)]) == 2
    assert "--draw DIR" in capsys.readouterr().err


@pytest.mark.full
def test_a_run_shows_measured_torque_over_speed_and_temperatures_over_time(
    combined_run: Result, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Draw measured points over speed and time.

    A run is one point: the curve of its case, and its warm-up, have the measured points.
    """
    torque = _file(tmp_path, "speed [1/min],friction torque [N mm]\n800,900\n3000,1500\n")
    (curve,) = api.with_measured([], torque, result=combined_run.path)
    panel = curve.panels[0]
    assert isinstance(panel, Panel)
    shown = {series.name: series for series in panel.series}
    assert shown["measured, rig.csv"].role != shown["SKF"].role
    assert shown["total"].band == "90 % model band"
    warm = _file(tmp_path, "time [min],oil temperature [degC]\n0,20\n2,25\n")
    (found,) = api.with_measured([], warm, result=combined_run.path)
    panel = found.panels[0]
    assert isinstance(panel, Panel)
    assert panel.series[-1].name == "oil, measured"
    assert panel.series[0].x[-1] == pytest.approx(2.0)
    still = _file(tmp_path, "time [min],oil temperature [degC]\n0,20\n")
    assert main(["view", str(combined_run.path), "--measured", str(still)]) == 2
    assert "rig.csv: the times of a warm-up begin at 0 and rise" in capsys.readouterr().err


def test_a_gap_in_a_signal_is_named_with_its_line(radial_run: Result, tmp_path: Path) -> None:
    times = [number * 1e-4 for number in range(60) if number != 30]
    rows = [f"{time:.4g},{(-1) ** number}" for number, time in enumerate(times)]
    file = _file(tmp_path, "\n".join(["time [s],acceleration [m/s2]", *rows]))
    with pytest.raises(UsageError, match=r"rig\.csv line 32: the times of a signal must be evenly spaced and rise"):
        api.view(radial_run, "vibration", {"measured": str(file)})
