"""Test the run loop on an engine with known answers.

What it averages, when it ends, what it says.
"""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import pytest
from fake_engine import FakeEngine, MakeProvenance, Truth

from lambda_core import api
from lambda_core.domain.channels import LOSSES
from lambda_core.domain.elements import ALONE
from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.results.provenance import Provenance
from lambda_core.results.summary import Summary
from lambda_core.runs.loop import run
from lambda_core.runs.progress import Progress
from lambda_core.solver.drivers.engine import Advance

TURN = FakeEngine().turn


def test_a_run_without_duration_ends_when_converged(provenance: MakeProvenance, tmp_path: Path) -> None:
    """Average a wave over complete turns.

    Mean torque 1.2 N m; nine periods per cage turn.
    """
    seen: list[Progress] = []
    result = run(FakeEngine(), provenance(), tmp_path / "r.h5", report=seen.append)
    summary = result.summary()
    assert summary.converged
    assert summary.reasons == []
    assert summary.revolutions_discarded == 1
    assert summary.revolutions_averaged == 4
    assert summary.simulated_s == pytest.approx(5.0 * TURN, rel=0.02)
    assert summary.friction_torque_Nmm == pytest.approx(1200.0, rel=1e-3)
    assert summary.friction_torque_ci_Nmm is not None
    assert summary.friction_torque_ci_Nmm < 1.2
    assert summary.input_torque_Nmm == pytest.approx(summary.friction_torque_Nmm)
    assert summary.cage_speed_ratio == pytest.approx(0.4)
    # 6319: (1 - 30/147.5)/2
    assert summary.epicyclic_ratio == pytest.approx(0.5 * (1.0 - 30.0 / 147.5))
    assert summary.cage_speed_over_epicyclic == pytest.approx(0.4 / 0.5 / (1.0 - 30.0 / 147.5))
    assert summary.inner_ring_displacement_um == pytest.approx([1.0, 2.0, -3.0])
    assert summary.energy_residual == pytest.approx(0.0, abs=1e-12)
    assert summary.wall_s > 0.0
    assert summary.wall_per_revolution_s == pytest.approx(
        summary.wall_per_simulated_second * 2.0 * math.pi / FakeEngine().truth.speed
    )
    assert seen[-1].percent == 100.0
    assert seen[-1].averaged == 4


def test_breakdown_adds_up_and_puts_the_cage_together(provenance: MakeProvenance, tmp_path: Path) -> None:
    summary = run(FakeEngine(), provenance(), tmp_path / "r.h5").summary()
    parts = summary.friction_breakdown_Nmm
    assert sum(parts.values()) == pytest.approx(summary.friction_torque_Nmm)
    shares = dict(zip(LOSSES, FakeEngine().truth.shares, strict=True))
    assert parts["cage"] == pytest.approx((shares["pocket"] + shares["land"]) * summary.friction_torque_Nmm)
    assert set(parts) == {*LOSSES, "cage"} - {"pocket", "land"}


def test_a_noisy_torque_takes_as_many_turns_as_its_confidence_needs(provenance: MakeProvenance, tmp_path: Path) -> None:
    summary = run(FakeEngine(Truth(noise=20.0)), provenance(max_duration=60 * TURN), tmp_path / "r.h5").summary()
    assert summary.converged
    assert summary.revolutions_averaged > 4
    assert summary.friction_torque_ci_Nmm <= 0.01 * summary.friction_torque_Nmm


def test_reasons_name_every_condition_that_fails(provenance: MakeProvenance, tmp_path: Path) -> None:
    engine = FakeEngine(Truth(noise=60.0, leak=0.01))
    summary = run(engine, provenance(max_duration=5.5 * TURN), tmp_path / "r.h5").summary()
    assert not summary.converged
    assert summary.state == "finished"
    assert len(summary.reasons) == 2
    assert "at most 1 % is allowed" in summary.reasons[0]
    assert "the energy residual is 0.0099 of the input" in summary.reasons[1]
    assert summary.reasons[1].endswith("lower solver.tolerance")


def test_a_condition_that_just_fails_is_told_in_as_many_digits_as_it_takes(
    provenance: MakeProvenance, tmp_path: Path
) -> None:
    engine = FakeEngine(Truth(leak=0.001004))
    summary = run(engine, provenance(duration=5.5 * TURN), tmp_path / "r.h5").summary()
    (reason,) = (reason for reason in summary.reasons if "energy" in reason)
    said = float(reason.removeprefix("the energy residual is ").split()[0])
    assert 1e-3 < said < 1.004e-3


def test_a_short_run_is_not_converged(provenance: MakeProvenance, tmp_path: Path) -> None:
    summary = run(FakeEngine(), provenance(duration=1.5 * TURN), tmp_path / "r.h5").summary()
    assert summary.reasons == ["0 whole cage revolutions were averaged, at least 4 are needed"]
    assert summary.friction_torque_Nmm == pytest.approx(1200.0, rel=0.01)  # mean of what there is
    assert summary.friction_torque_ci_Nmm is None


def test_discarding_nothing_is_not_converged(provenance: MakeProvenance, tmp_path: Path) -> None:
    given = provenance(duration=6.2 * TURN, discard_revolutions=0.0)
    summary = run(FakeEngine(), given, tmp_path / "r.h5").summary()
    assert summary.reasons == ["0 cage revolutions were discarded, at least 1 is needed"]


def test_duration_is_met_exactly_by_the_step_past_it(provenance: MakeProvenance, tmp_path: Path) -> None:
    result = run(FakeEngine(), provenance(duration=0.1), tmp_path / "r.h5")
    times = result["time"]
    assert 0.1 <= result.integrals()[-1, 0] < 0.1 + TURN / 150.0
    assert times[0] == 0.0
    assert times == pytest.approx([i * TURN / 200.0 for i in range(len(times))])


def test_samples_arrive_unchanged_and_in_order(provenance: MakeProvenance, tmp_path: Path) -> None:
    result = run(FakeEngine(), provenance(duration=0.05), tmp_path / "r.h5")
    engine = FakeEngine()
    engine.advance(0.05)
    expected = engine.samples().bearings[ALONE]
    for channel in result.channels:
        assert (result[channel.name] == expected[channel.name]).all(), channel.name


def test_a_solver_that_gives_up_keeps_the_file(provenance: MakeProvenance, tmp_path: Path) -> None:
    path = tmp_path / "r.h5"
    with pytest.raises(SolverError, match=r"ball 3, inner ring.*is kept in .*r\.h5"):
        run(FakeEngine(Truth(fails_at=0.12)), provenance(), path)
    from lambda_core.results.reader import Result

    summary = Result(path).summary()
    assert summary.state == "failed"
    assert summary.reasons[0].startswith("ball 3, inner ring")
    assert summary.simulated_s == pytest.approx(0.12, abs=TURN / 100.0)


def test_an_engine_that_stands_still_is_a_solver_failure(provenance: MakeProvenance, tmp_path: Path) -> None:
    engine = FakeEngine()
    engine.advance = lambda until, pause: Advance(True, "")  # type: ignore[method-assign]
    with pytest.raises(SolverError, match="does not get past t = 0 s"):
        run(engine, provenance(), tmp_path / "r.h5")


def test_limit_of_wall_time_stops_the_run(provenance: MakeProvenance, tmp_path: Path) -> None:
    summary = run(FakeEngine(Truth(slowness=1e-3)), provenance(max_wall=0.2), tmp_path / "r.h5").summary()
    assert summary.state == "stopped"
    assert summary.reasons[0].startswith("the limit of wall time was reached at t = ")


@pytest.mark.full
def test_own_sample_interval_does_not_move_the_averages(provenance: MakeProvenance, tmp_path: Path) -> None:
    given = provenance()
    (before,) = given.models
    model = replace(before, output=replace(before.output, interval=1e-5))
    engine = FakeEngine()
    engine.sample_interval = 1e-5
    summary = run(engine, Provenance.alone(model, {"core": "abc"}), tmp_path / "r.h5").summary()
    assert summary.converged
    assert summary.friction_torque_Nmm == pytest.approx(1200.0, rel=1e-3)


def test_an_existing_result_is_never_overwritten_silently(provenance: MakeProvenance, tmp_path: Path) -> None:
    path = tmp_path / "r.h5"
    run(FakeEngine(), provenance(duration=0.01), path)
    before = path.read_bytes()
    with pytest.raises(UsageError, match="exists: choose another name"):
        run(FakeEngine(), provenance(duration=0.02), path)
    assert path.read_bytes() == before
    run(FakeEngine(), provenance(duration=0.02), path, overwrite=True)
    assert path.read_bytes() != before


@pytest.mark.parametrize("folder", ["missing", "/proc"])
def test_a_folder_that_takes_no_file_is_said_before_anything_runs(
    folder: str, provenance: MakeProvenance, tmp_path: Path
) -> None:
    with pytest.raises(UsageError, match=r"cannot write .*r\.h5"):
        run(FakeEngine(), provenance(), tmp_path / folder / "r.h5")


def test_the_summary_is_valid_json_with_the_names_of_the_interface(provenance: MakeProvenance, tmp_path: Path) -> None:
    result = run(FakeEngine(), provenance(), tmp_path / "r.h5")
    data = json.loads(result.summary().model_dump_json())
    promised = (
        "friction_torque_Nmm friction_torque_ci_Nmm input_torque_Nmm friction_breakdown_Nmm cage_speed_ratio "
        "cage_speed_over_epicyclic contacts inner_ring_displacement_um max_pressure_GPa min_film_um energy_residual "
        "wall_per_simulated_second wall_per_revolution_s assumptions converged"
    )
    assert set(promised.split()) <= set(data) | set(data["bearings"][ALONE])
    contacts = data["bearings"][ALONE]["contacts"]
    assert set(contacts[0]) == {
        "element", "ring", "azimuth_deg", "load_N", "contact_angle_deg", "film_um", "capacitance_pF",
    }  # fmt: skip
    assert [(c["element"], c["ring"]) for c in contacts[:3]] == [(1, "inner"), (1, "outer"), (2, "inner")]
    assert all(0.0 <= c["azimuth_deg"] < 360.0 for c in contacts)
    assert contacts[0]["film_um"] is None  # unloaded
    last = result.sample(-1, ("load", "film_central", "capacitance"))
    assert contacts[3]["film_um"] == pytest.approx(1e6 * last["film_central"][1, 1])
    assert contacts[3]["capacitance_pF"] == pytest.approx(1e12 * last["capacitance"][1, 1])
    assert data["assumptions"]
    assert Summary.model_validate(data) == result.summary()


def test_the_window_is_what_extremes_are_taken_over(provenance: MakeProvenance, tmp_path: Path) -> None:
    result = run(FakeEngine(), provenance(), tmp_path / "r.h5")
    kept = result["time"] >= result.revolutions()[1, 0]
    loaded = result["load"][kept] > 0.0
    summary = result.summary()
    assert summary.max_pressure_GPa == pytest.approx(1e-9 * result["max_pressure"][kept][loaded].max())
    assert summary.min_film_um == pytest.approx(1e6 * result["film_minimum"][kept][loaded].min())


@pytest.mark.full
def test_memory_is_flat_over_a_long_run(
    provenance: MakeProvenance, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Limit the memory of a long run.

    Each record is flushed here: the memory of Python must not grow with the samples. What threads of the test runner
    take meanwhile does not count.
    """
    import gc
    import tracemalloc

    held: dict[int, int] = {}
    ours = [
        tracemalloc.Filter(inclusive=True, filename_pattern=f"*{name}*") for name in ("lambda_core", "h5py", "numpy")
    ]

    def look(progress: Progress) -> None:
        half = int(2.0 * progress.cage_revolutions)
        if half not in held:
            gc.collect()
            taken = tracemalloc.take_snapshot().filter_traces(ours).statistics("filename")
            held[half] = sum(file.size for file in taken)

    monkeypatch.setattr("lambda_core.runs.session._FLUSH_AFTER", 0.0)
    monkeypatch.setattr("lambda_core.runs.session._REPORT_AFTER", 0.0)
    tracemalloc.start()
    try:
        result = run(FakeEngine(), provenance(duration=1.05 * TURN), tmp_path / "r.h5", report=look)
    finally:
        tracemalloc.stop()
    written = 100 * 8 * sum(math.prod(result[c.name].shape[1:]) for c in result.channels)
    assert held[2] - held[1] < 0.05 * written


def test_a_braked_ring_that_a_torque_drives(tmp_path: Path) -> None:
    """Drive a braked ring by a torque.

    The brake is no friction of the bearing, and the torque no drive that the program prescribes.
    """
    spin = 'bodies.inner_ring.spin={mode="free",damping="0.002 N m s/rad"}'
    changes = [spin, "operation.torque=0.5 N m", "solver.duration=1 ms"]
    found = api.run("6208-axial-1300", changes, out=tmp_path / "braked.h5").summary()
    assert found.support_power_W == pytest.approx(0.002 * 288.0**2, rel=0.1)
    assert found.friction_torque_Nmm is not None
    assert 200.0 < found.friction_torque_Nmm < 300.0
    assert found.input_torque_Nmm is None
    assert "input torque" not in found.text()
    assert abs(found.energy_residual) < 1e-3


def test_a_bearing_at_rest_without_an_end_is_not_run(tmp_path: Path) -> None:
    """Refuse a model that was resolved for an equilibrium alone.

    It was run into a finished result without samples.
    """
    model = api.check("6208-axial-1300", ["operation.speed=0 rpm"], is_static=True)
    with pytest.raises(api.UsageError, match="nothing turns, so the run needs a duration"):
        api.run(model, out=tmp_path / "rest.h5")
    assert not list(tmp_path.iterdir())
