"""Test the comparison with SKF's model on other bearings."""

from __future__ import annotations

from pathlib import Path

import pytest
from lambda_syla2026 import anchors as A
from lambda_syla2026 import parameters as P
from lambda_syla2026.anchor_pages import chapter
from lambda_syla2026.axial_load import SHARES, axial_load, axial_notes
from lambda_syla2026.job_runner import ANCHOR, Job, JobResult, case_text
from lambda_syla2026.readings import MECHANISMS, anchor
from lambda_syla2026.readings import axial_load as READ

from lambda_core.studies.job import resolve_point

HEAT = {"contacts": 90.0, "drag": 60.0, "skf drag": 50.0, "heat": 100.0}
PARTS = {"rolling": 30.0, "hysteresis": 10.0, "sliding": 20.0, "spin": 5.0, "skf rolling": 50.0, "skf sliding": 40.0}


class Invented:
    """Runner with SKF's torque.

    Its inputs of load and set differ.
    """

    def all(self, jobs: list[Job]) -> list[JobResult]:
        return [
            JobResult("done", "", "", {"torque": 100.0 * self.ratio(job), "boundary": 1.0, **self.axial(job), **HEAT})
            for job in jobs
        ]

    def axial(self, job: Job) -> dict[str, float]:
        """Double SKF's sliding torque.

        Wherever there is an axial load; nothing else changes.
        """
        loaded = any(change.startswith("loads.axial=") and change != "loads.axial=0 N" for change in job.changes)
        sliding = 80.0 if loaded and job.kind == "axial load" else 40.0
        return PARTS | {"skf sliding": sliding, "skf": 60.0 + sliding, "schaeffler load": 7.0}

    def ratio(self, job: Job) -> float:
        if "parameters.traction.tau_eyring=6 MPa" in job.changes:
            return 0.7
        return 1.1 if "bearing.designation=6205" in job.changes else 1.0


def test_the_grid_is_no_table_4() -> None:
    """Check ten bearings of two makers.

    Three loads and three speeds; none of the bearings is the 6319.
    """
    assert len(A.BEARINGS) >= 10
    assert "6319" not in {name for name, _ in A.BEARINGS}
    assert {"SKF", "NSK"} <= {maker for _, maker in A.BEARINGS}
    assert len(A.LOADS) == len(A.SPEEDS) == 3


@pytest.mark.full
def test_bias_and_scatter_of_known_ratios() -> None:
    found = A.anchors(Invented())  # type: ignore[arg-type]
    first = found.spreads[0]
    count = len(A.BEARINGS)
    assert first.points == 9 * count
    assert first.bias_pct == pytest.approx(10.0 / count)
    assert first.rms_pct == pytest.approx(10.0 / count**0.5)
    assert first.by_bearing_pct["6205 SKF"] == pytest.approx(10.0)
    assert list(first.by_load_pct.values()) == pytest.approx([10.0 / count] * 3)
    blind = found.spreads[-1]
    assert (blind.parameters, blind.bias_pct) == ("blind", pytest.approx(-30.0))
    assert "met: 0.515/0.525 grooves" in found.bars[0]
    assert [bar.split(":")[0] for bar in found.bars[-2:]] == ["met", "met"]
    assert found.rated[0].with_drag == pytest.approx([1.5] * 3)
    # The bar with drag is held against SKF's model with drag, 100 + 50, and not against the heat of 100.
    assert found.rated[0].over_skf == pytest.approx([1.0] * 3)
    assert "with drag over that of SKF's model with drag" in found.bars[-1]
    titles = [table.caption for table in chapter(found, ()).tables]
    assert len(titles) == len(set(titles)) == 7
    for p in found.populations:
        assert (p.rolling_median, p.sliding_median) == pytest.approx((0.8, 0.65))


def test_an_axial_load_is_compared_with_none() -> None:
    steps = axial_load(Invented())  # type: ignore[arg-type]
    assert [step.share for step in steps] == list(SHARES)
    assert (steps[0].skf_sliding, steps[0].skf, steps[0].ratio) == (1.0, 1.0, 1.0)
    for step in steps[1:]:
        assert (step.skf_sliding, step.skf, step.ratio) == pytest.approx((2.0, 1.4, 1.0 / 1.4))
        assert step.rolling == step.sliding == step.total == step.schaeffler == 1.0
    assert "SKF's M_sl 2.00" in axial_notes(steps)[0]


def test_a_small_axial_load_is_felt_by_skfs_model_alone() -> None:
    """Add 75 N axial to 1.5 kN radial.

    A 6208: neither the contacts nor Schaeffler's catalogue change.
    """
    case = ("bearing.designation=6208", "loads.radial=1500 N", "operation.speed=1000 rpm")
    none, small = (READ(resolve_point(case_text(ANCHOR), (*case, f"loads.axial={axial} N"))) for axial in (0, 75))
    assert small["torque"] == pytest.approx(none["torque"], rel=0.03)
    assert small["schaeffler load"] == pytest.approx(none["schaeffler load"], rel=1e-3)
    assert small["skf"] > 1.3 * none["skf"]


def test_quick_says_what_it_leaves_out() -> None:
    found = A.anchors(Invented(), quick=True)  # type: ignore[arg-type]
    assert not found.populations
    assert {s.grooves for s in found.spreads} == {A.USUAL}
    assert found.notes[-1].startswith("quick")


def test_random_cases_are_the_same_every_time() -> None:
    for name, count in A.POPULATIONS.items():
        cases = A.random_cases(name)
        assert cases == A.random_cases(name)
        assert len({case[0] for case in cases}) == count
        assert all(any(c.startswith("loads.axial") for c in case) == name.endswith("axial") for case in cases)


def test_the_random_case_that_once_had_no_equilibrium_has_a_torque() -> None:
    """Find an equilibrium of a 6001 again.

    427 1/min under both loads, its balls half a pitch on.
    """
    case = next(c for c in A.random_cases("VG 68, radial and axial") if "bearing.designation=6001" in c)
    assert 0.3 < (anchor(resolve_point(case_text(ANCHOR), case))["torque"] or 0.0) < 30.0


@pytest.mark.parametrize("parameters", A.SETS)
def test_a_point_of_either_set(parameters: str) -> None:
    """Compare both sets for a 6208.

    At C/P = 10 parts add up, the sets differ, and SKF's is the catalogue's own number.
    """
    changes = ("bearing.designation=6208", "loads.radial=3.25 kN", "operation.speed=3667 rpm", *A.laws_of(parameters))
    found = anchor(resolve_point(case_text(ANCHOR), changes))
    assert found["torque"] == pytest.approx(
        sum(found[n] or 0.0 for n in MECHANISMS if n not in ("cage", "drag") and n in found)
    )
    assert found["skf"] == pytest.approx((found["skf rolling"] or 0.0) + (found["skf sliding"] or 0.0))
    ratio = (found["torque"] or 0.0) / (found["skf"] or 1.0)
    assert (0.9 if parameters == "default" else 0.6) < ratio < (1.05 if parameters == "default" else 0.8)


def test_the_anchored_set_replaces_what_the_blind_one_names() -> None:
    """Compare the paths of both sets.

    Every path but the laws that come with it is in the blind set too, and everything has a source.
    """
    blind = {entry.path for entry in P.blind_set()}
    for path, value, source in P.anchored_set():
        assert source
        assert path in blind, path
        assert value or path.startswith("parameters.")
    assert not any("lubricant" in path or "bearing" in path for path in P.anchored())


def test_the_case_of_the_anchors_needs_no_other_file(tmp_path: Path) -> None:
    assert resolve_point(case_text(ANCHOR), ()).geometry.ball_count == 9
