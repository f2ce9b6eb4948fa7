"""Test fits of roller bearings.

Alone by their quasi-static answer, and in a machine.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.fitting.measurements import parse_measurements
from lambda_core.fitting.subjects import subject_of

CASE = {
    "name": "32216",
    "bearing": {"designation": "SKF 32216"},
    "lubricant": {"name": "FVA3", "temperature": "50 degC"},
    "loads": {"axial": "6 kN"},
    "operation": {"speed": "2000 rpm"},
}
SHAFT = {
    "name": "motor",
    "shaft": {"sections": [{"length": "400 mm", "diameter": "40 mm"}]},
    "bearings": {
        "floating": {"designation": "SKF NU 208 ECP", "at": "20 mm"},
        "located": {"designation": "SKF 6308", "at": "360 mm"},
    },
    "loads": {"belt": {"at": "5 mm", "force_z": "-4 kN"}},
    "operation": {"speed": "1000 rpm"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
}
LOSS, RIB = "parameters.elastic_hysteresis.loss_factor", "bearing.rollers.rib_roughness"
HEADER = "speed [1/min],axial load [kN],friction torque [N mm],friction torque error [%]"


@pytest.mark.full
def test_loss_factor_and_roughness_of_the_rib_are_found_again(tmp_path: Path) -> None:
    subject, rows = subject_of(CASE), [HEADER]
    for speed, load in ((20, 2), (20, 15), (2000, 2), (2000, 15)):
        at = (f"operation.speed={speed} rpm", f"loads.axial={load} kN", f"{LOSS}=0.04", f"{RIB}=0.35 um")
        rows.append(f"{speed},{load},{subject.values(at, (), ('friction torque',), one=True)[0, 0]:.8g},1")
    measured = parse_measurements("\n".join(rows), "rig.csv", subject.words)
    report = api.fit(CASE, measured, ["loss_factor", f"{RIB}=0.1 um..0.6 um"], suggest=False)
    loss, rib = report.parameters
    assert loss.value == pytest.approx(0.04, rel=1e-3)
    assert rib.value == pytest.approx(0.35, rel=1e-3)
    fitted = api.fitted_case(CASE, report, tmp_path / "fitted.toml")
    at = ("operation.speed=20 rpm", "loads.axial=15 kN")
    assert api.quasistatic(fitted, at).friction_torque_Nmm == pytest.approx(report.points[1].predicted, rel=1e-4)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("elastic_hysteresis.loss_factor", "0.045"),
        ("rolling_resistance.thermal_coefficient", "0.2"),
        ("traction.tau_eyring", "4 MPa"),
        ("traction.limit_ratio", "0.0001"),
        ("boundary_friction.mu", "0.06"),
        ("supply.k_rs", "6e-8"),
    ],
)
def test_parameters_of_laws_count_in_the_answer_of_rollers(path: str, value: str) -> None:
    """Count parameters of laws in a fit of rollers.

    They were left out silently.
    """
    at = ("operation.speed=20 rpm", "loads.axial=15 kN")
    before, after = (api.quasistatic(CASE, (*at, *more)) for more in ((), (f"parameters.{path}={value}",)))
    assert abs(after.friction_torque_Nmm - before.friction_torque_Nmm) > 1e-6


def test_what_does_not_count_is_told_and_what_is_wrong_refused() -> None:
    found = api.quasistatic(CASE, ("parameters.supply.k_z=3",))
    assert any("parameters.supply.k_z counts in motion only" in sentence for sentence in found.assumptions)
    with pytest.raises(CaseError, match=r"parameters\.traction\.tau_eyring.*has no unit"):
        api.quasistatic(CASE, ("parameters.traction.tau_eyring=6",))
    model = api.check(CASE, (f"{LOSS}=0.04",))
    assert model.laws["ball_inner"]["elastic_hysteresis"].parameters.loss_factor == 0.04


def test_the_permittivity_of_rollers_follows_from_a_measured_capacitance() -> None:
    law = {"models": {"permittivity": "constant"}}
    subject = subject_of(CASE | law)
    known = {"parameters": {"permittivity": {"eps_r": 2.25}}}
    points = []
    for speed in (1000, 1500, 2000):
        found = api.quasistatic(CASE | law | known, (f"operation.speed={speed} rpm",), band=False)
        points.append(f"{speed},{found.bearing_capacitance_nF!r},1\n")
    text = "speed [1/min],capacitance [nF],capacitance error [%]\n" + "".join(points)
    fit = api.fit(CASE | law, parse_measurements(text, "f.csv", subject.words), ["eps_r=2..3"])
    assert fit.parameters[0].value == pytest.approx(2.25, rel=1e-3)


def test_rollers_have_no_measured_film() -> None:
    with pytest.raises(CaseError, match="minimum film"):
        api.fit(CASE, parse_measurements("speed [1/min],minimum film [um]\n9,1\n", "f.csv", subject_of(CASE).words), [])
    with pytest.raises(UsageError, match=r"nearest: parameters\.elastic_hysteresis\.loss_factor"):
        subject_of(CASE).varied("los_factor")


def test_rollers_of_a_machine_take_fitted_parameters() -> None:
    subject = subject_of(SHAFT, bearing="floating")
    loss = subject.varied("loss_factor")
    assert loss.path == f"bearings.floating.{LOSS}"
    low, high = (subject.values((), [(loss, end)], ("friction torque",), one=True)[0, 0] for end in (0.02, 0.047))
    assert high > 1.02 * low


@pytest.mark.full
def test_rollers_at_computed_temperatures_are_fitted_there() -> None:
    """Predict rollers that warm up, and measure their temperatures.

    The given temperature was kept.
    """
    tables = {**CASE, "operation": {"speed": "2000 rpm", "temperatures": "computed"}}
    subject = subject_of(tables)
    torque, oil = subject.values((), (), ("friction torque", "oil temperature"), one=True)[0]
    assert torque == pytest.approx(api.quasistatic(tables).friction_torque_Nmm, rel=1e-6)
    assert abs(oil - 50.0) > 2.0
    assert subject.deviations((), ("oil temperature",), ())["oil temperature"] > 0.0
    cage = subject.values((), (), ("cage speed",), one=True)[0, 0]
    assert cage == pytest.approx(2000.0 * api.quasistatic(tables).orbit_speed_ratio)


def test_rollers_of_a_machine_have_the_errors_of_their_band() -> None:
    """Compare the deviation before a fit with the model band.

    It was that of the laws of balls.
    """
    subject = subject_of(SHAFT)
    name = "floating friction torque"
    value = subject.values((), (), (name,), one=True)[0, 0]
    low, high = np.log(np.array(subject.bands((), (name,))[name]) / value)
    assert subject.deviations((), (name,), ())[name] == pytest.approx((high - low) / 2 / 1.645, rel=0.01)
