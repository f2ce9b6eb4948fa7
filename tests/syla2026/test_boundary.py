"""Test bisection and criteria of the stability map."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from lambda_syla2026.boundary import CAGE, CASE, CRITERIA, LIMITS, TURNS, Ray, Setting, excess, search
from lambda_syla2026.job_runner import Job, JobResult, JobRunner
from lambda_syla2026.stability import Zone, half_zone, jackknife


def answer(s: float, t: float, error: float = 1e-6) -> JobResult:
    return JobResult("done", "", "", {"S": s, "S_error": error, "T": t, "T_error": error})


class Known:
    """A runner whose bearing changes at given accelerations."""

    def __init__(self, critical: dict[str, float]) -> None:
        self.critical, self.runs = critical, 0

    def all(self, jobs: list[Job]) -> list[JobResult]:
        return [self.one(job) for job in jobs]

    def one(self, job: Job) -> JobResult:
        self.runs += 1
        text = next(change for change in job.changes if change.startswith("bodies.outer_ring.x="))
        if text.endswith("locked"):
            return answer(0.01, 0.0)
        amplitude, frequency = (float(text.split(f'{key} = "')[1].split()[0]) for key in ("amplitude", "frequency"))
        a = 1e-3 * amplitude * (2.0 * math.pi * frequency) ** 2
        return answer(0.01 * (1.0 - LIMITS["S"] * a / self.critical["S"]), LIMITS["T"] * a / self.critical["T"])


@pytest.mark.parametrize("critical", [{"S": 26.0, "T": 31.0}, {"S": 1.4, "T": 300.0}])
@pytest.mark.parametrize("frequency", [15.0, 44.0])
def test_bisection_finds_both_boundaries(critical: dict[str, float], frequency: float) -> None:
    ray, known = Ray(Setting("A", 5.0), frequency), Known(critical)
    still = search(known, [ray], 1.2)  # type: ignore[arg-type]
    for criterion, value in critical.items():
        low, high = ray.bracket(criterion, still[ray.setting])
        assert low is not None
        assert high is not None
        assert low <= value <= high <= 1.2 * low
        # The excess is linear in the amplitude here, not in its logarithm: half a per cent within such a bracket.
        found = ray.boundary(criterion, still[ray.setting])
        assert found is not None
        assert found.acceleration == pytest.approx(value, rel=0.01)
    assert known.runs < 25


def test_a_change_within_three_standard_errors_alters_nothing() -> None:
    assert excess("S", answer(0.007, 0.0, error=0.002), answer(0.010, 0.0, error=0.0)) < 0.0
    assert excess("S", answer(0.007, 0.0, error=0.0005), answer(0.010, 0.0, error=0.0)) > 0.0
    assert excess("T", answer(0.01, 0.03), answer(0.01, 0.0)) < 0.0


@pytest.mark.parametrize("criterion", CRITERIA)
def test_errors_of_the_runs_are_carried_over_to_the_boundary(criterion: str) -> None:
    """Compare errors with 4000 noisy copies.

    Three runs; the noise is small, so that first order is enough.
    """
    s, t, error = (0.0100, 0.0085, 0.0075), (0.0, 0.03, 0.08), {"S": 5e-5, "T": 2e-3}
    random = np.random.default_rng(3)
    runs = [
        JobResult("done", "", "", {"S": a, "S_error": error["S"], "T": b, "T_error": error["T"]})
        for a, b in zip(s, t, strict=True)
    ]

    def at(answers: list[JobResult]) -> float:
        ray = Ray(Setting("A", 5.0), 10.0, {40.0: answers[1], 48.0: answers[2]})
        found = ray.boundary(criterion, answers[0])
        assert found is not None
        return math.log(found.acceleration)

    def noisy(which: tuple[int, ...]) -> float:
        copies = []
        for i, run in enumerate(runs):
            moved = {c: run[c] + (error[c] * random.standard_normal() if i in which else 0.0) for c in CRITERIA}
            copies.append(JobResult("done", "", "", {**run.numbers, **moved}))
        return at(copies)

    boundary = Ray(Setting("A", 5.0), 10.0, {40.0: runs[1], 48.0: runs[2]}).boundary(criterion, runs[0])
    assert boundary is not None
    assert boundary.own_error == pytest.approx(np.std([noisy((1, 2)) for _ in range(4000)]), rel=0.1)
    assert boundary.still_error == pytest.approx(np.std([noisy((0,)) for _ in range(4000)]), rel=0.1)


def test_jackknife_of_a_mean_is_its_standard_error() -> None:
    """Compare the jackknife with s/sqrt(n).

    For a mean it is exact (Efron and Tibshirani 1993, eq. 11.5).
    """
    values = np.random.default_rng(1).normal(5.0, 1.0, 10)
    mean, error = jackknife(values[:, None], np.ones((10, 1)))
    assert mean == pytest.approx(values.mean())
    assert error == pytest.approx(values.std(ddof=1) / math.sqrt(10.0), rel=1e-6)


def test_the_load_zone_wraps_around() -> None:
    zone = Zone(math.radians(-90.0), math.radians(60.0))
    inside = np.radians([270.0, 210.0, 330.0, -30.0, 328.0 + 720.0])
    outside = np.radians([90.0, 190.0, 350.0, 0.0])
    assert not zone.outside(inside).any()
    assert zone.outside(outside).all()


def test_the_motion_has_the_acceleration_that_was_asked_for() -> None:
    from lambda_core import api

    model = api.check(CASE, Setting("B", 2.0).changes(26.0, 9.0))
    for body in (model.inner_ring, model.outer_ring):
        rest, harmonic = body.dofs["x"].motion.terms
        amplitude, frequency, phase = harmonic.values
        assert rest.values == pytest.approx((-amplitude,))  # it starts where the rings' equilibrium is
        assert amplitude * (2.0 * math.pi * frequency) ** 2 == pytest.approx(9.0, rel=1e-6)
        assert phase == pytest.approx(math.pi / 2.0)
    assert model.solver.duration > TURNS / Setting("B", 2.0).cage_frequency
    assert model.cage.type == CAGE


def test_a_quick_search_averages_fewer_turns() -> None:
    from lambda_core import api

    for acceleration in (0.0, 9.0):
        changes = (Setting("A", 5.0, share=share).changes(26.0, acceleration) for share in (1.0, 0.4))
        complete, quick = (api.check(CASE, given).solver.duration for given in changes)
        assert quick == pytest.approx(0.4 * complete, rel=0.1)  # and one turn before


def test_natural_frequencies_of_what_centrifugal_force_holds() -> None:
    """Compute frequencies of the 6220 by hand.

    Cage at 0.5 (1 - 25.4/140) 1500/60 = 10.23 Hz, groove 13.462 - 12.7 = 0.762 mm.

    A sphere that rolls in the groove: 10.23 sqrt(5/7 x 70/0.762) = 82.9 Hz. Steel ball 67.4 g (7850 kg/m3), so k = 25.6
    N/mm; with a load zone of +-73.2 degrees 5.93 of ten balls are unloaded, cage 0.263 kg: sqrt(5.93 x 25600/(0.263 +
    5.93 x 0.0943))/(2 pi) = 68.1 Hz.
    """
    from lambda_syla2026.readings import axial_resonance

    from lambda_core import api

    found = axial_resonance(api.check(CASE, Setting("A", 5.0).changes()))
    assert found["ball_Hz"] == pytest.approx(82.9, rel=0.01)
    assert found["cage_Hz"] == pytest.approx(68.1, rel=0.02)


def test_half_the_load_zone() -> None:
    """Compare cos(psi) with P_d/(2 delta).

    60 degrees at delta = P_d, all of the ring without clearance and load.
    """
    assert half_zone(20e-6, 20e-6) == pytest.approx(math.pi / 3.0)
    assert half_zone(5e-6, 20e-6) == 0.0
    assert half_zone(0.0, -1e-6) == math.pi


@pytest.mark.slow
def test_runs_lie_on_both_sides_of_the_boundary(tmp_path: Path) -> None:
    """Run variant A at 20 and 80 m/s2.

    5 kN, 8.9 Hz: 20 m/s2 do not change the running, 80 m/s2 change it by both criteria.
    """
    ray = Ray(Setting("A", 5.0), 8.9)
    with JobRunner(tmp_path, 1) as runner:
        below, above = runner.all([ray.job(20.0), ray.job(80.0)])
        still = runner.all([Job(CASE, ray.setting.changes(), "stability")])[0]
    for criterion in CRITERIA:
        assert excess(criterion, below, still) < 0.0
        assert excess(criterion, above, still) > 0.0
    assert above["S"] < still["S"]  # closer to the kinematic speed
    assert not list(tmp_path.rglob("*.h5"))
