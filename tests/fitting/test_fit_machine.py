"""Test fits of machines and of one of their bearings."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.errors import CaseError, LambdaError, UsageError
from lambda_core.fitting.measurements import Measurements, parse_measurements
from lambda_core.fitting.subjects import Subject, subject_of
from lambda_core.model.machine_templates import shaft_text

SUPPORT = "bearings.right.support.z=50 N/um..400 N/um"
TRUTH = ("parameters.elastic_hysteresis.loss_factor=0.035", "bearings.right.support.z=100 N/um")
NAMES = ("right friction torque", "bending frequency 1")
LOADS = ((1000, -800), (4500, -3000))


@pytest.fixture(scope="module")
def machine() -> str:
    """Return the case of a belt shaft.

    Its right bearing sits in an elastic seat.
    """
    text = shaft_text("geared-shaft", "rig").replace(
        'support.x = "free" ', 'support.z = "150 N/um"\nsupport.x = "free" '
    )
    return f'{text}\n[loads.belt]\nat = "5 mm"\nforce_z = "-800 N"\n'


@pytest.fixture(scope="module")
def subject(machine: str) -> Subject:
    return subject_of(tomllib.loads(machine))


@pytest.fixture(scope="module")
def measured(subject: Subject) -> Measurements:
    """Return what the machine does with other parameters, without noise."""
    head = "speed [1/min],loads.belt.force_z [N]," + ",".join(
        f"{name} [{subject.words.measured[name].unit}],{name} error [%]" for name in NAMES
    )
    rows = [head]
    for speed, force in LOADS:
        at = (f"operation.speed={speed} rpm", f"loads.belt.force_z={force} N", *TRUTH)
        torque, frequency = subject.values(at, (), NAMES, one=False)[0]
        rows.append(f"{speed},{force},{torque:.8g},2,{frequency:.8g},1")
    return parse_measurements("\n".join(rows), "rig.csv", subject.words)


@pytest.fixture(scope="module")
def report(machine: str, measured: Measurements) -> api.FitReport:
    return api.fit(tomllib.loads(machine), measured, ["loss_factor", SUPPORT], suggest=False)


@pytest.mark.full
def test_loss_factor_and_seat_of_a_machine_are_found_again(report: api.FitReport) -> None:
    loss, seat = report.parameters
    assert loss.path == "parameters.elastic_hysteresis.loss_factor"
    assert loss.value == pytest.approx(0.035, rel=2e-3)
    assert seat.path == "bearings.right.support.z"
    assert seat.value == pytest.approx(100.0, rel=1e-3)
    assert seat.unit == "N/um"
    assert "loads.belt.force_z" in report.pictures()[1].panels[1].x.label


@pytest.mark.full
def test_laws_leave_the_torque_open_and_the_frequency_not(report: api.FitReport) -> None:
    assert 1.0 < report.discrepancy_pct["right friction torque"] < 50.0
    assert report.discrepancy_pct["bending frequency 1"] == 0.0


@pytest.mark.full
def test_the_fitted_machine_has_the_values_and_their_origin(
    report: api.FitReport, machine: str, tmp_path: Path
) -> None:
    source = tmp_path / "rig.toml"
    source.write_text(machine)
    path = api.fitted_case(source, report, tmp_path / "fitted.toml")
    tables = tomllib.loads(path.read_text())
    assert tables["bearings"]["right"]["support"]["z"].endswith("N/um")
    assert tables["fit"]["parameters"][1]["path"] == "bearings.right.support.z"
    assert isinstance(api.check(path), api.MachineModel)
    assert "positive about +x" in path.read_text()  # comments stay


def test_natural_frequencies_and_stiffness_are_those_of_modes(machine: str, subject: Subject) -> None:
    found = api.modes(tomllib.loads(machine))
    names = ("natural frequency 2", "right stiffness z")
    frequency, stiffness = subject.values((), (), names, one=False)[0]
    assert frequency == pytest.approx(sorted(mode.frequency_Hz for mode in found.modes)[1], rel=1e-9)
    assert stiffness == pytest.approx(1e-6 * found.bearings["right"].stiffness[2][2], rel=1e-9)


def test_columns_of_one_bearing_need_no_name(machine: str, subject: Subject) -> None:
    own = subject_of(tomllib.loads(machine), bearing="left")
    names = ("friction torque", "left friction torque", "right friction torque")
    short, left, right = own.values((), (), names, one=False)[0]
    assert short == left
    assert subject.values((), (), ("friction torque",), one=False)[0, 0] == pytest.approx(left + right)


def test_parameters_of_one_bearing_are_its_own(machine: str) -> None:
    found = subject_of(tomllib.loads(machine), bearing="left").varied("loss_factor")
    assert found.path == "bearings.left.parameters.elastic_hysteresis.loss_factor"
    assert found.changes(0.03)[0] == "bearings.left.models.elastic_hysteresis=loss-factor"


@pytest.mark.full
def test_temperatures_that_a_machine_computes_are_measured_quantities(machine: str) -> None:
    text = machine.replace("[operation]", '[operation]\ntemperatures = "computed"')
    own = subject_of(tomllib.loads(text), bearing="left")
    assert "inner ring temperature" not in own.words.conditions
    inner, outer = own.values((), (), ("inner ring temperature", "left outer ring temperature"), one=False)[0]
    assert 20.0 < outer < inner < 150.0
    warm = parse_measurements("speed [rpm],inner ring temperature [degC]\n3000,60\n", "rig.csv", own.words)
    with pytest.raises(UsageError, match=r'add a column "inner ring temperature error \[K\]"'):
        api.fit(tomllib.loads(text), warm, ["loss_factor"], bearing="left")


@pytest.mark.parametrize(
    ("header", "said"),
    [
        ("left frction torque [N mm]", "nearest: left friction torque"),
        ("radial load [kN],friction torque [N mm]", '"radial load [kN]" is not a known column'),
        ("loads.belt.force_q [N],friction torque [N mm]", "line 1, column 1"),
        ("loads.belt.force_z [rpm],friction torque [N mm]", "rpm is not a unit of force"),
        ("loads.belt.force_z,friction torque [N mm]", "has no unit"),
    ],
)
def test_mistakes_in_columns_of_a_machine_have_their_line(header: str, said: str, subject: Subject) -> None:
    with pytest.raises(CaseError) as caught:
        parse_measurements(f"{header}\n1,2\n", "rig.csv", subject.words)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("vary", "said"),
    [
        ("los_factor", "nearest: parameters.elastic_hysteresis.loss_factor"),
        ("bearings.right.support.z", 'give one, for example bearings.right.support.z="75 N/um..300 N/um"'),
        ("bearing.clearance", "write bearings.left.clearance or bearings.right.clearance"),
        ("bearings.middle.support.z=1 N/um..2 N/um", "name a number in the case of rig"),
    ],
)
def test_wrong_parameters_of_a_machine_are_refused(vary: str, said: str, subject: Subject) -> None:
    with pytest.raises(UsageError) as caught:
        subject.varied(vary)
    assert said in str(caught.value)


def test_one_parameter_of_balls_and_rollers_is_refused() -> None:
    """Name the bearings whose laws differ.

    The law of the balls was given to the rollers, and the file of measurements was blamed.
    """
    mixed = subject_of(tomllib.loads(shaft_text("motor-shaft", "motor")))
    with pytest.raises(UsageError, match=r"different laws of elastic_hysteresis .*: write bearings\.fan\.parameters"):
        mixed.varied("loss_factor")
    assert mixed.varied("mu").path == "parameters.boundary_friction.mu"


def test_a_bearing_that_is_not_there_is_refused(machine: str) -> None:
    with pytest.raises(LambdaError, match="nearest: left"):
        subject_of(tomllib.loads(machine), bearing="lefft")
    with pytest.raises(UsageError, match="has one bearing"):
        subject_of("6319-cp10-1500", bearing="left")


@pytest.mark.full  # the command: tests/fitting/test_fit_case.py
def test_the_command_fits_one_bearing_of_a_machine(
    machine: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, data = tmp_path / "rig.toml", tmp_path / "rig.csv"
    case.write_text(machine)
    data.write_text("speed [1/min],friction torque [N mm],friction torque error [%]\n1000,26,2\n3000,19,2\n")
    arguments = ["fit", str(case), str(data), "--bearing", "right", "--vary", "loss_factor", "-q"]
    out = tmp_path / "fitted.toml"
    assert main([*arguments, "--out", str(out)]) == 0
    (row,) = tomllib.loads(out.read_text())["fit"]["parameters"]
    assert row["path"] == "bearings.right.parameters.elastic_hysteresis.loss_factor"
    assert "right of rig" in capsys.readouterr().out
    data.write_text("speed [1/min],friction torque [N mm]\n1000,26\n3000,x\n")
    assert main(arguments) == 3
    assert "line 3, column 2" in capsys.readouterr().err
