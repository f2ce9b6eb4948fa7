"""Test friction torque of the 6319.

Quasi-static trends, the fit of tau_e, and what the command prints.
"""

from __future__ import annotations

import numpy as np
import pytest
from lambda_syla2026 import parameters as P
from lambda_syla2026.calibration import by_law, fitted, laws_of
from lambda_syla2026.job_runner import Job, JobResult
from lambda_syla2026.published import POINTS
from lambda_syla2026.readings import TAU_GRID, friction, friction_over_tau, torque_at
from lambda_syla2026.table4 import OperatingPoint

from lambda_core import api


@pytest.fixture(scope="module")
def torque() -> np.ndarray:
    return np.array([friction(api.check(point.case, P.changes()))["torque"] for point in POINTS]).reshape(2, 3)


def test_torque_rises_with_speed_and_load(torque: np.ndarray) -> None:
    assert np.all(np.diff(torque, axis=1) > 0.0)
    assert np.all(np.diff(torque, axis=0) > 0.0)


def test_quasi_static_torque_meets_a_run() -> None:
    """Compare quasi-static torque with a run to 3 %.

    Without the cage both have the same physics.
    """
    case = "6319-cp10-3000"
    still = friction(api.check(case, P.changes()))["torque"]
    assert still is not None
    from lambda_core.solver.drivers.dynamics import BearingEngine

    model = api.check(case, (*P.changes(), "depth.strips=15"))
    engine = BearingEngine(model)
    turn = 0.0502  # of the cage [s], 3000 1/min times 0.3983
    assert engine.advance(turn).ok
    first = engine.integrals()
    assert engine.advance(2.0 * turn).ok
    last = engine.integrals()
    loss = sum(
        last[name] - first[name]
        for name in last
        if name.startswith("loss.") and name not in ("loss.pocket", "loss.land")
    )
    run = 1e3 * loss / (last["relative_angle"] - first["relative_angle"])
    assert run == pytest.approx(still, rel=0.03)


def test_torques_over_tau_are_those_of_each_case() -> None:
    case, changes = "6319-cp6.5-500", P.changes(P.with_law("elastic_hysteresis", "houpert"))
    found = friction_over_tau(api.check(case, changes))
    assert list(found) == [torque_at(tau) for tau in TAU_GRID]
    for tau in (TAU_GRID[0], TAU_GRID[-1]):
        alone = friction(api.check(case, (*changes, f"parameters.traction.tau_eyring={tau:g} MPa")))["torque"]
        assert found[torque_at(tau)] == pytest.approx(alone, rel=1e-9)


@pytest.mark.parametrize("true", [4.6, 6.0, 7.7])
def test_the_fit_finds_the_tau_that_made_the_measurement(true: float, monkeypatch: pytest.MonkeyPatch) -> None:
    from lambda_syla2026 import calibration

    curve = np.array([[100.0 * i + 10.0 * tau + tau**2 for i in range(6)] for tau in (*TAU_GRID, true)])
    points = tuple(type(point)(point.load, point.speed, float(curve[-1, i])) for i, point in enumerate(POINTS))
    monkeypatch.setattr(calibration, "POINTS", points)
    tau, at_limit, free = fitted(curve[:-1], "cp10")
    assert tau == pytest.approx(true, abs=0.01)
    assert free == pytest.approx(true, abs=0.01)
    assert not at_limit


def test_the_fit_stays_inside_the_published_range(monkeypatch: pytest.MonkeyPatch) -> None:
    from lambda_syla2026 import calibration

    points = tuple(type(point)(point.load, point.speed, 1e4) for point in POINTS)
    monkeypatch.setattr(calibration, "POINTS", points)
    tau, at_limit, free = fitted(np.array([[100.0 * tau] * 6 for tau in TAU_GRID]), "cp6.5")
    assert (tau, at_limit) == (8.0, True)
    assert free > 11.9


def test_the_machine_interface_of_a_point() -> None:
    names = ("load_N", "speed_rpm", "measured_Nmm", "simulated_Nmm", "calibrated_Nmm")
    assert tuple(OperatingPoint.model_fields) == names


def test_a_law_without_a_second_alternative_is_shown_once() -> None:
    from lambda_syla2026.sensitivity import Sensitivity, ends_of

    law = P.entry("models.rolling_resistance")
    first, last = ends_of(law)
    assert first == last == "goksem-hargreaves"
    found = Sensitivity(
        name=law.label,
        value=law.value,
        low=first,
        high=last,
        low_change_pct=-10.0,
        high_change_pct=-10.0,
        low_error_pct=None,
        high_error_pct=None,
        published=True,
        basis="",
        source="",
    )
    assert found.span == "goksem-hargreaves"
    assert found.effect == "-10.0 % with goksem-hargreaves"
    assert ends_of(P.entry("parameters.traction.tau_eyring")) == ("4 MPa", "8 MPa")


def test_every_law_without_constants_of_the_user_is_calibrated() -> None:
    """Calibrate all laws but two.

    Scheuermann's law has no published constants; without rolling resistance there is nothing to compare.
    """
    assert laws_of("elastic_hysteresis")[0] == "loss-factor"
    assert {"loss-factor", "houpert", "none"} <= set(laws_of("elastic_hysteresis"))
    assert "scheuermann" not in laws_of("elastic_hysteresis")
    assert laws_of("rolling_resistance")[0] == "biboulet-houpert"
    assert "goksem-hargreaves" in laws_of("rolling_resistance")
    assert "none" not in laws_of("rolling_resistance")


class Invented:
    """Runner with measured torques at 7 MPa.

    With one pair of laws, half of it with others.
    """

    PAIR = ("models.elastic_hysteresis=houpert", "models.rolling_resistance=goksem-hargreaves")

    def all(self, jobs: list[Job]) -> list[JobResult]:
        return [JobResult("done", "", "", {torque_at(tau): self.torque(job, tau) for tau in TAU_GRID}) for job in jobs]

    def torque(self, job: Job, tau: float) -> float:
        point = next(point for point in POINTS if point.case == job.case)
        share = 1.0 if all(change in job.changes for change in self.PAIR) else 0.5
        return share * point.measured * (1.0 + 0.1 * (tau - 7.0))


def test_tau_is_fitted_with_every_pair_of_laws() -> None:
    found = by_law(Invented(), np.zeros(len(POINTS)))  # type: ignore[arg-type]
    pairs = {(c.elastic_hysteresis, c.rolling_resistance) for c in found}
    assert len(found) == 2 * len(pairs) == 2 * len(laws_of("elastic_hysteresis")) * len(laws_of("rolling_resistance"))
    for c in found:
        right = (c.elastic_hysteresis, c.rolling_resistance) == ("houpert", "goksem-hargreaves")
        assert c.tau_e_MPa == (7.0 if right else 8.0)
        assert c.at_limit is not right
        # 10 % below at the blind 6 MPa, exact at 7; half of 0.9 and of 1.1 with any other pair.
        assert c.unfitted_pct == pytest.approx(10.0 if right else 55.0)
        assert c.predicted_row_pct == pytest.approx(0.0 if right else 45.0, abs=1e-3)
        assert not c.simulated
