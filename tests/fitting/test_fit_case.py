"""Test the fit of a case.

Parameters are found again from values that the case itself predicts.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.case.case_writer import case_toml
from lambda_core.domain.errors import CaseError, SolverError, UsageError
from lambda_core.fitting import fit_case
from lambda_core.fitting.data import Data
from lambda_core.fitting.least_squares import fit as fit_values
from lambda_core.fitting.measurements import parse_measurements
from lambda_core.fitting.operating_points import point_values
from lambda_core.fitting.parameters import Parameter
from lambda_core.fitting.problem import CaseProblem
from lambda_core.fitting.report import SuggestedPoint
from lambda_core.fitting.scores import relative
from lambda_core.fitting.subjects import subject_of
from lambda_core.model.checks.assumption_effects import effect

CASE = "6319-cp10-1500"
HEADER = "speed [1/min],radial load [kN],oil temperature [degC],friction torque [N mm],friction torque error [%]"
POINTS = ((300, 8, 60), (3000, 8, 62), (300, 30, 65), (3000, 30, 60))
FEW = "speed [1/min],friction torque [N mm],friction torque error [%]\n500,925,3\n1500,1306,3\n3000,1564,3"
TRUTH = ("parameters.elastic_hysteresis.loss_factor=0.04", "parameters.traction.tau_eyring=6 MPa")


@pytest.fixture(scope="module")
def rows() -> list[str]:
    """Return lines of predicted measurements.

    The case predicts them with other parameters, without noise.
    """
    text = api.case(CASE)
    found = []
    for speed, load, temperature in POINTS:
        at = (f"operation.speed={speed} rpm", f"loads.radial={load} kN", f"lubricant.temperature={temperature} degC")
        torque = point_values(case_toml(text), (*at, *TRUTH), ("friction torque",)).mean()
        found.append(f"{speed},{load},{temperature},{torque:.6g},1")
    return found


@pytest.fixture(scope="module")
def report(rows: list[str]) -> api.FitReport:
    measured = parse_measurements("\n".join([HEADER, *rows]), "rig.csv")
    return api.fit(CASE, measured, ["loss_factor", "tau_eyring"])


def test_a_page_that_nothing_can_print_is_refused_before_the_fit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Refuse a PDF without a browser and WeasyPrint.

    The fit was computed first.
    """
    monkeypatch.setattr("lambda_core.export.report.pdf.find_spec", lambda name: None)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr("lambda_core.api.fit", lambda *given, **more: pytest.fail("fitted"))
    page = str(tmp_path / "fit.pdf")
    assert main(["fit", CASE, str(tmp_path / "rig.csv"), "--vary", "loss_factor", "-q", "--report", page]) == 2
    assert "a PDF needs a browser on PATH" in capsys.readouterr().err


def test_a_folder_that_takes_no_case_is_refused_before_the_fit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("lambda_core.api.fit", lambda *given, **more: pytest.fail("fitted"))
    out = str(tmp_path / "none" / "fitted.toml")
    assert main(["fit", CASE, str(tmp_path / "rig.csv"), "--vary", "loss_factor", "-q", "--out", out]) == 2
    assert "does not exist" in capsys.readouterr().err


def test_true_values_are_found(report: api.FitReport) -> None:
    loss, stress = report.parameters
    assert loss.value == pytest.approx(0.04, rel=1e-3)
    assert stress.value == pytest.approx(6.0, rel=2e-3)
    assert (loss.low, loss.high) == (0.02, 0.047)  # published with the law
    assert stress.unit == "MPa"
    assert report.correlation[0][1] < -0.8
    assert report.rms_error_pct < 0.02
    assert not report.warnings
    assert report.sentence == (
        "The 4 measured values narrow the range of elastic_hysteresis.loss_factor; they do not narrow the range of "
        "traction.tau_eyring: its 95 % interval covers it."  # by Student's distribution with two degrees of freedom
    )


def test_the_next_point_is_a_new_one_and_helps(report: api.FitReport) -> None:
    assert report.next_point is not None
    assert set(report.next_point.conditions) == {"speed", "radial load", "oil temperature"}
    assert report.next_point.spread_after < 0.9 * report.next_point.spread_before


def test_the_next_point_begins_with_the_errors_of_the_fit(report: api.FitReport) -> None:
    """Compare its uncertainty with that of the fitted values.

    It left out the factor by which residuals widen their errors, and was half of theirs in a poor fit.
    """
    assert report.next_point is not None
    errors = [one.posterior_error * math.sqrt(12.0) / (one.high - one.low) for one in report.parameters]
    covariance = np.array(report.posterior_correlation) * np.outer(errors, errors)
    largest = math.sqrt(np.linalg.eigvalsh(covariance)[-1])
    assert report.next_point.spread_before == pytest.approx(largest, rel=1e-3)


def test_text_and_pictures_show_every_point(report: api.FitReport) -> None:
    text = report.text()
    assert "0.0400 ± " in text
    assert "next point to measure: speed" in text
    values, residuals = report.pictures()
    assert sum(series.y.size for series in values.panels[0].series if series.kind == "points") == len(POINTS)
    assert len(residuals.panels) == 3


def test_speeds_over_decades_have_a_logarithmic_axis(report: api.FitReport) -> None:
    """Keep slow points apart that a linear axis puts together."""
    assert not report.pictures()[0].panels[0].x.log
    slow = [point.model_copy(update={"conditions": {**point.conditions, "speed": 0.5}}) for point in report.points[:2]]
    wide = report.model_copy(update={"points": [*slow, *report.points[2:]]})
    assert wide.pictures()[0].panels[0].x.log
    assert [panel.x.log for panel in wide.pictures()[1].panels] == [True, False, False]


def test_the_fitted_case_predicts_what_was_fitted(report: api.FitReport, tmp_path: Path) -> None:
    path = api.fitted_case(CASE, report, tmp_path / "fitted.toml")
    case = api.case(path)
    assert case.fit is not None
    assert case.fit.sha256 == report.sha256
    assert case.fit.correlation == [[pytest.approx(v, abs=1e-5) for v in row] for row in report.posterior_correlation]
    model = api.check(path)
    assert any("0.0400" in sentence and "rig.csv" in sentence for sentence in model.assumptions)
    assert model.laws["ball_inner"]["elastic_hysteresis"].parameters.loss_factor == pytest.approx(0.04, rel=1e-3)
    assert "ISO VG 100 mineral oil" in path.read_text()  # comments stay
    with pytest.raises(UsageError, match="exists"):
        api.fitted_case(CASE, report, path)


def test_a_value_that_was_changed_after_the_fit_is_named(report: api.FitReport, tmp_path: Path) -> None:
    """Say that the band has the error of another value."""
    path = api.fitted_case(CASE, report, tmp_path / "fitted.toml")
    said = "elastic_hysteresis.loss_factor is 0.03 in the case and"
    fitted = api.model_band(path, quantities=["friction torque"])
    changed = api.model_band(path, ["parameters.elastic_hysteresis.loss_factor=0.03"], quantities=["friction torque"])
    assert not any("in the fit" in text for text in fitted.left_out)
    assert [text for text in changed.left_out if text.startswith(said)]


def test_a_second_fit_replaces_what_the_first_said(report: api.FitReport, tmp_path: Path) -> None:
    """Keep one assumption of each fitted parameter.

    A case that was fitted again had both values.
    """
    first = api.fitted_case(CASE, report, tmp_path / "first.toml")
    other = report.model_copy(update={"file": "other.csv", "parameters": report.parameters[:1]})
    other = other.model_copy(update={"posterior_correlation": [[1.0]]})
    case = api.case(api.fitted_case(first, other, tmp_path / "second.toml"))
    about = [text for text in case.assumptions if " values of " in text]
    assert len(about) == len(report.parameters)
    assert ["other.csv" in text for text in about if report.parameters[0].path in text] == [True]


@pytest.mark.parametrize("correlation", ["[[1.0, 2.0], [2.0, 1.0]]", "[[1.0, 0.5], [0.1, 1.0]]", "[[0.5, 0], [0, 1]]"])
def test_a_correlation_that_cannot_be_is_refused(correlation: str, tmp_path: Path) -> None:
    value = 'value = 0.03\nstandard_error = 0.001\npath = "parameters.{}"\n'
    rows = "".join(f"[[fit.parameters]]\n{value.format(name)}" for name in ("a.a", "b.b"))
    path = tmp_path / "fitted.toml"
    path.write_text(
        f'{case_toml(api.case(CASE))}\n[fit]\nfile = "a.csv"\nsha256 = "0"\ndate = "2026-01-01"\ncount = 9\n'
        f"correlation = {correlation}\n{rows}"
    )
    with pytest.raises(CaseError, match="no negative eigenvalue"):
        api.case(path)


def test_measured_values_are_stored_on_request_alone(report: api.FitReport, tmp_path: Path) -> None:
    hostile = report.model_copy(update={"file": 'a"] \\ \n[loads]\nradial = "1 N".csv'})
    without, stored = (
        api.case(api.fitted_case(CASE, hostile, tmp_path / f"{rows}.toml", rows=rows)) for rows in (False, True)
    )
    assert without.fit is not None
    assert stored.fit is not None
    assert not without.fit.measured
    assert stored.fit.file == hostile.file
    first, point = stored.fit.measured[0], report.points[0]
    assert (first.line, first.quantity, first.value, first.unit) == (2, "friction torque", point.measured, "N mm")
    assert first.conditions == "speed 300 rpm, radial load 8 kN, oil temperature 60 degC"
    assert stored.loads == without.loads
    assert main(["fit", CASE, "rig.csv", "--vary", "loss_factor", "--rows"]) == 2


def test_a_page_shows_values_points_and_pictures(report: api.FitReport, tmp_path: Path) -> None:
    page = api.report(report, tmp_path / "fit.html").read_text()
    assert report.sentence in page
    for words in ("fitted values", "correlations", "measured and predicted values", "patterns of the residuals"):
        assert f">{words}" in page
    assert "0.0400\u00a0±\u00a0" in page
    assert "<td>N\u00a0mm" in page
    assert page.count('<figure class="picture"') == len(report.pictures()) == 2
    assert '<p class="state">fitted</p>' in page
    doubtful = report.model_copy(update={"warnings": ["The residuals show a trend."]})
    page = api.report([doubtful, report], tmp_path / "two.html", appendices=["all"], units="us").read_text()
    assert '<p class="state bad">fitted with reservations</p>' in page
    assert "The residuals show a trend." in page
    assert "lbf\u00a0in" in page


def test_the_temperature_error_of_the_oil_widens_the_errors(rows: list[str], report: api.FitReport) -> None:
    head = HEADER + ",oil temperature error [K]"
    measured = parse_measurements("\n".join([head, *(f"{row},0.5" for row in rows)]), "rig.csv")
    warm = api.fit(CASE, measured, ["loss_factor", "tau_eyring"], suggest=False)
    before, after = (found.parameters[1].standard_error for found in (report, warm))
    assert before is not None
    assert after is not None
    assert after > 1.1 * before
    assert warm.points[1].error > 1.1 * report.points[1].error


@pytest.mark.parametrize(
    ("vary", "said"),
    [
        ("loss_facto", "nearest: parameters.elastic_hysteresis.loss_factor"),
        ("speed_floor", "names several parameters: write parameters.film_thickness.speed_floor or"),
        ("vogel_k", 'has no published range: give one, for example parameters.rheology.vogel_k="0.031..0.124"'),
        ("tau_eyring=3..10", 'has no unit: write 4 MPa..16 MPa'),
        ("tau_eyring=10 MPa..3 MPa", "is not a range: write LOW..HIGH"),
        ("tau_eyring=3 mm..10 mm", "no unit in common"),
        ("loss_factor=0..9", "loss_factor: 9 should be less than or equal to 0.2: give a smaller range"),
        ("lubricant.temperature", 'the column "oil temperature" of rig.csv sets it; leave one of the two out'),
    ],
)  # fmt: skip
def test_wrong_parameters_are_refused(vary: str, said: str, rows: list[str]) -> None:
    with pytest.raises(UsageError) as caught:
        api.fit(CASE, parse_measurements("\n".join([HEADER, *rows]), "rig.csv"), [vary])
    assert said in str(caught.value)


def test_a_point_that_cannot_be_computed_is_named_by_its_line(rows: list[str]) -> None:
    measured = parse_measurements("\n".join([HEADER, *rows, "0,8,60,100,1"]), "rig.csv")
    with pytest.raises((CaseError, SolverError, UsageError), match=r"rig\.csv line 6"):
        api.fit(CASE, measured, ["loss_factor"])


def test_the_command_writes_json_and_the_case(
    rows: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data, out, page = (tmp_path / name for name in ("rig.csv", "fitted.toml", "fit.html"))
    data.write_text("\n".join([HEADER, *rows]))
    assert (
        main(
            ["fit", CASE, str(data), "--vary", "loss_factor", "--json", "--out", str(out), "-q", "--report", str(page)]
        )
        == 0
    )
    found = json.loads(capsys.readouterr().out)
    assert found["parameters"][0]["state"] in ("fitted", "at limit")
    assert np.isfinite(found["rms_error_pct"])
    assert out.is_file()
    assert "fit to rig.csv" in page.read_text()


def test_an_early_ctrl_c_says_that_nothing_is_kept(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Stop in the first pass over the points.

    The command said "interrupted" alone.
    """

    def stopped(*_: object) -> None:
        raise KeyboardInterrupt

    data, out = tmp_path / "rig.csv", tmp_path / "fitted.toml"
    data.write_text("speed [1/min],friction torque [N mm]\n500,925\n1500,1306\n")
    monkeypatch.setattr(CaseProblem, "predict", stopped)
    assert main(["fit", CASE, str(data), "--vary", "loss_factor", "-q", "--out", str(out)]) == 130
    assert "there are no values to keep" in capsys.readouterr().err
    assert not out.exists()


def test_the_file_of_measurements_is_not_replaced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    data = tmp_path / "rig.csv"
    data.write_text("speed [1/min],friction torque [N mm]\n500,925\n1500,1306\n")
    before = data.read_text()
    assert main(["fit", CASE, str(data), "--vary", "loss_factor", "-q", "--out", str(data), "--force"]) == 2
    assert f"--out {data} is the file of measurements" in " ".join(capsys.readouterr().err.split())
    assert data.read_text() == before


def test_a_mistake_in_the_file_ends_the_command_with_its_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data = tmp_path / "rig.csv"
    data.write_text("speed [1/min];friction torque [N mm]\n500;1,5\n")
    assert main(["fit", CASE, str(data), "--vary", "loss_factor"]) == 3
    assert "line 2, column 2" in capsys.readouterr().err


def test_points_resolved_once_agree_with_the_changed_case() -> None:
    """Move parameters, roughness and an option, then return.

    Equal parameters have equal predictions.
    """
    subject = subject_of(CASE)
    varied = [
        subject.varied(text) for text in ("loss_factor", "tau_eyring", "surface.roughness", "lubricant.temperature")
    ]
    at, names = (
        ("operation.speed=1000 rpm", "loads.radial=16 kN"),
        ("friction torque", "minimum film", "displacement z"),
    )
    found = []
    for numbers in ((0.04, 6.0, 0.14, 60.0), (0.02, 4.0, 0.1, 66.0), (0.04, 6.0, 0.14, 60.0)):
        moved = [change for graded, number in zip(varied, numbers, strict=True) for change in graded.changes(number)]
        found.append(subject.values(at, list(zip(varied, numbers, strict=True)), names, one=False))
        anew = point_values(case_toml(api.case(CASE)), (*at, *moved), names)
        np.testing.assert_allclose(found[-1], anew, rtol=1e-7)
    np.testing.assert_array_equal(found[0], found[2])
    assert np.abs(found[1] / found[0] - 1.0).max() > 0.1


@pytest.mark.parametrize("stage", ["_suggestion", "_posterior"])
def test_an_interruption_after_the_search_keeps_its_values(stage: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*args: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(fit_case, "check_count", lambda count: None)
    monkeypatch.setattr(fit_case, "_posterior", interrupted)
    monkeypatch.setattr(fit_case, stage, interrupted)
    report = api.fit(CASE, parse_measurements(FEW, "rig.csv"), ["loss_factor"], sample=100)
    assert report.is_interrupted
    assert report.parameters[0].state == "fitted"
    assert report.posterior is None
    assert (report.next_point is None) == (stage != "_posterior")
    assert any("interrupted" in warning for warning in report.warnings)


def test_an_early_interruption_keeps_values_with_the_errors_of_their_ranges(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Stop before the data have told anything.

    The errors were 1e150, and so was the one in the fitted case.
    """

    def interrupted(problem: CaseProblem, values: np.ndarray) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(CaseProblem, "jacobian", interrupted)
    report = api.fit(CASE, parse_measurements(FEW, "rig.csv"), ["loss_factor"])
    (loss,) = report.parameters
    assert report.is_interrupted
    assert loss.low <= loss.value <= loss.high
    assert loss.posterior_error <= loss.high - loss.low
    assert "determine" not in report.sentence
    assert report.left_out_rms_error_pct == pytest.approx(report.rms_error_pct)
    assert "e1" not in report.text()
    case = api.fitted_case(CASE, report, tmp_path / "fitted.toml")
    assert "best before an interrupted fit to" in case.read_text(encoding="utf-8")
    assert api.case(case).fit.complete is False  # type: ignore[union-attr]
    api.quasistatic(case, band=True)


@pytest.mark.parametrize("begin", ["", "bearings.left."])
def test_a_fitted_parameter_stands_with_the_assumptions_of_its_law(begin: str) -> None:
    """Group it by its path.

    The word "fitted" put the loss factor with fits, under load and life.
    """
    said = "0.0370 ± 0.0033: fitted to 18 values of one.csv"
    assert effect(f"{begin}parameters.elastic_hysteresis.loss_factor {said}") == "friction"
    assert effect(f"{begin}parameters.film_thickness.factor {said}") == "film"


def test_errors_of_fitted_values_are_at_most_their_ranges() -> None:
    """Count the range with the data.

    The error of a fitted case was 0.030 for a range of 0.027.
    """
    data, ranges = Data(np.array([10.1, 11.1, 9.1]), np.full(3, 0.05)), [Parameter("mu", 0.1, 0.0, 0.2)]
    found = fit_values(lambda values: 10.0 + np.repeat(values, 3), ranges, data, limit=math.inf)
    assert math.sqrt(found.posterior[0, 0]) < 0.2 / math.sqrt(12.0) < found.standard_errors[0]


def test_a_fitted_value_near_the_end_of_what_its_law_allows_has_a_band(report: api.FitReport, tmp_path: Path) -> None:
    """Step to the other side alone.

    Value less error was below 0, and the fitted case was refused.
    """
    loss = report.parameters[0].model_copy(update={"value": 0.001, "posterior_error": 0.007})
    doubtful = report.model_copy(update={"parameters": [loss, report.parameters[1]]})
    case = api.fitted_case(CASE, doubtful, tmp_path / "fitted.toml")
    band = api.model_band(case, quantities=["friction torque"]).band("friction torque")
    assert "fitted values" in {one.name for one in band.contributors}


def test_a_next_point_that_tells_nothing_is_said_to(report: api.FitReport) -> None:
    """Do not offer a point that tells nothing.

    It reduced the uncertainty "from 1.00 to 1.00".
    """
    point = SuggestedPoint(
        conditions={"speed": "3 rpm"}, combination={"mu": 1.0}, spread_before=1.0, spread_after=0.999
    )
    said = "the best one, speed 3 rpm, leaves the uncertainty of mu at 1.00 of that before the fit"
    assert f"next point to measure: {said}" in report.model_copy(update={"next_point": point}).text()


def test_points_to_predict_are_read_before_the_fit(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(fit_case, "fit_values", None)
    with pytest.raises(UsageError, match=r'cannot read ".*none\.csv"'):
        api.fit(CASE, parse_measurements(FEW, "rig.csv"), ["loss_factor"], predict=tmp_path / "none.csv")


def test_relative_errors_leave_measured_zeros_out() -> None:
    assert relative(np.array([1.0, 2.0, -3.0]), np.array([0.0, 4.0, 6.0])).tolist() == [0.5, -0.5]


def test_a_measured_torque_of_zero_is_refused_with_its_line() -> None:
    measured = parse_measurements("speed [1/min],friction torque [N mm]\n500,925\n1500,0\n", "rig.csv")
    with pytest.raises(UsageError, match=r"rig\.csv line 3: friction torque is 0: a fit needs values above 0"):
        api.fit(CASE, measured, ["loss_factor"])


def test_points_at_rest_have_displacements_and_no_torque() -> None:
    """Fit the clearance to a displacement at rest.

    The point was refused for want of a duration.
    """
    head = "speed [1/min],displacement z [um]\n"
    report = api.fit(
        CASE, parse_measurements(f"{head}0,-60\n0,-60\n", "rest.csv"), ["bearing.clearance=5 um..60 um"], suggest=False
    )
    assert report.points[0].predicted == pytest.approx(-60.0, rel=0.01)
    torque = parse_measurements("speed [1/min],friction torque [N mm]\n0,9\n500,900\n", "rest.csv")
    with pytest.raises(UsageError, match="line 2: a bearing at rest has no friction torque"):
        api.fit(CASE, torque, ["loss_factor"], suggest=False)


def test_the_cage_speed_tells_the_contact_angle() -> None:
    """Compare cage speeds under thrust with the kinematic ones.

    A measured cage speed was no column.
    """
    subject = subject_of("6208-axial-1300")
    for clearance in (5.0, 60.0):
        at = (f"bearing.clearance={clearance} um",)
        speed = subject.values(at, (), ("cage speed",), one=True)[0, 0]
        model, found = api.check("6208-axial-1300", at, is_static=True), api.quasistatic("6208-axial-1300", at)
        ratio = model.geometry.ball_diameter * np.cos(np.radians(found.contact_angle_deg[0])) / 60e-3
        assert speed == pytest.approx(0.5 * 2750.0 * (1.0 - ratio), rel=2e-3)
