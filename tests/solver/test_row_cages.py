"""Test a cage for each row of balls.

Slip of the unloaded row, places, third law, Jacobian, machines, resuming, refusals.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.export.fmu.frozen import freeze
from lambda_core.model.long_form import long_form
from lambda_core.results.reader import Result
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.dynamics import BearingEngine

from .support import dense

DISTANCE = 11.36e-3  # of the rows of a 3208 A [m]


def two_rows(**sections: Any) -> dict[str, Any]:
    """Return a double row bearing under thrust."""
    tables: dict[str, Any] = {
        "name": "two-rows",
        "bearing": {"designation": "SKF 3208 A"},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "loads": {"radial": "1 kN", "axial": "4 kN"},
        "operation": {"speed": "3000 rpm"},
        "bodies": {"inner_ring": {"tilt_y": "locked", "tilt_z": "locked"}, "cage": {"per_row": True}},
        "solver": {"duration": "60 ms"},
    }
    return tables | sections


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> Result:
    out = tmp_path_factory.mktemp("row-cages") / "two.h5"
    api.run(two_rows(), out=out)
    return api.result(out)


def test_the_cage_of_the_unloaded_row_lags(ran: Result) -> None:
    """Compare the cages with kinematics.

    The loaded row takes its cage along at the kinematic speed; oil drags and nothing drives the other row.
    """
    summary = ran.summary()
    assert summary.cage_speed_over_epicyclic == pytest.approx(1.0, abs=5e-3)
    assert summary.second_cage_speed_ratio is not None
    assert summary.second_cage_speed_ratio < 0.995 * summary.cage_speed_ratio  # type: ignore[operator]
    assert abs(summary.energy_residual) < 1e-3  # type: ignore[arg-type]
    assert "second row" in summary.text()


def test_one_cage_has_no_line_of_a_second(tmp_path: Path) -> None:
    """Leave the second cage out of texts and reports.

    Every run had a line "second row" with a dash.
    """
    summary = api.run(two_rows(bodies={}, solver={"duration": "1 ms"}), out=tmp_path / "one.h5").summary()
    assert "second row" not in summary.text()
    assert summary.second_cage_speed_ratio is None


def test_each_cage_is_where_its_row_is(ran: Result) -> None:
    play = 1e-3
    np.testing.assert_allclose(ran["body_position"][:, 2, 0], -0.5 * DISTANCE, atol=play)
    np.testing.assert_allclose(ran["second_cage_position"][:, 0], 0.5 * DISTANCE, atol=play)


def test_a_locked_cage_is_where_its_row_is() -> None:
    bodies = {"cage": {"per_row": True, "x": "locked"}}
    engine = BearingEngine(api.check(two_rows(bodies=bodies)))
    now = engine.now()
    assert now["body_position"][2, 0] == -0.5 * DISTANCE
    assert now["second_cage_position"][0] == 0.5 * DISTANCE


def test_slopes_of_both_cages() -> None:
    """Compare the Jacobian of both cages with central differences.

    They are rates of the cages' states, scaled, at balls and bodies somewhat off their start.
    """
    engine = BearingEngine(api.check(two_rows()))
    context, y = engine.context, engine.state()["memory.y"].copy()
    bundle, scale = context.bundle, context.scale
    y += 0.2 * np.random.default_rng(3).uniform(-1.0, 1.0, y.size) * scale

    def rates(state: FloatArray) -> FloatArray:
        found = np.zeros(y.size)
        assert core().evaluate(0.0, state, bundle, found, np.zeros(L.power_count(bundle)), 0) == 1
        return found

    def slope(i: int) -> FloatArray:
        step = np.zeros(y.size)
        step[i] = 1e-5 * scale[i]
        return (rates(y + step) - rates(y - step)) / 2e-5

    exact = np.stack([slope(i) for i in range(y.size)], axis=1) / scale[:, None]
    rates(y)
    assert core().jacobian(0.0, y, bundle, context.blocks) == 1
    ours = dense(context.blocks) * scale[None, :] / scale[:, None]
    first = y.size - bundle.active.size
    cages = [first + i for i, entry in enumerate(bundle.active) if entry >= 2 * L.NS]
    assert len(cages) == 2 * L.NS
    largest = np.abs(exact[cages]).max(axis=1, keepdims=True)
    assert np.all(np.abs(ours - exact)[cages] < 0.02 * largest + 1e-3)


def test_a_machine_moves_as_the_bearing_alone(ran: Result, tmp_path: Path) -> None:
    api.run(long_form(two_rows()).tables, out=tmp_path / "shaft.h5")
    alone, mounted = ran.summary(), api.result(tmp_path / "shaft.h5").summary()
    assert mounted.friction_torque_Nmm == pytest.approx(alone.friction_torque_Nmm, rel=2e-3)
    assert mounted.second_cage_speed_ratio == pytest.approx(alone.second_cage_speed_ratio, rel=1e-3)


def test_a_resumed_motion_is_the_same_bits() -> None:
    model = api.check(two_rows())
    undisturbed, first, second = (BearingEngine(model) for _ in range(3))
    undisturbed.advance(3e-3)
    first.advance(1.1e-3)
    second.restore(first.state())
    second.advance(3e-3)
    assert np.array_equal(undisturbed.now()["second_cage_spin"], second.now()["second_cage_spin"])


@pytest.mark.parametrize(
    ("sections", "words"),
    [
        ({"bearing": {"designation": "SKF 6208"}}, "this one has one row"),
        ({"bodies": {"cage": {"per_row": True, "x": "10 N/um"}}}, "free, locked or a motion"),
        ({"elastic": {"cage": {"orders": 2}}}, "leave out bodies.cage.per_row"),
    ],
)
def test_what_cages_per_row_cannot_be(sections: dict[str, Any], words: str) -> None:
    with pytest.raises(CaseError, match=words):
        api.check(two_rows(**sections))


def test_an_fmu_has_one_cage() -> None:
    for model in (api.check(two_rows()), api.check(long_form(two_rows()).tables)):
        with pytest.raises(UsageError, match="an FMU has one cage in each bearing"):
            freeze(model, "force")


def test_rollers_at_rest_have_no_cage_per_row() -> None:
    """Refuse it at an operating point as for a run."""
    case = two_rows(
        bearing={"designation": "SKF NU 208 ECP"}, loads={"radial": "1 kN"}, bodies={"cage": {"per_row": True}}
    )
    for question in (api.check, api.quasistatic):
        with pytest.raises(CaseError, match="this one has one row") as caught:
            question(case)
        assert str(caught.value).count("per_row") == 1
