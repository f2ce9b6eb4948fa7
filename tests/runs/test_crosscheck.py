"""Test the integrator against CVODE."""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.runs.beginning import with_locked_cage
from lambda_core.runs.cvode import integrate
from lambda_core.solver.drivers.dynamics import bearing_start
from lambda_core.solver.drivers.equilibrium import solve


@pytest.fixture
def sundials() -> None:
    pytest.importorskip("sksundae", reason="CVODE comes with the extra sundials")


@pytest.mark.full
@pytest.mark.usefixtures("sundials")
@pytest.mark.parametrize(
    ("case", "tolerance"), [("6208-axial-1300", 1e-3), ("6319-cp10-1500", 5e-4), ("6319-cp6.5-1500", 5e-4)]
)
def test_same_trajectory_with_a_locked_cage(case: str, tolerance: float) -> None:
    """Compare trajectories within 10 tolerances.

    Dissipated power within 0.02 % (requirement).

    Unloaded balls have a neutral azimuth, in which errors of either integrator add up.
    """
    found = api.cross_check(case, [f"solver.tolerance={tolerance}", "solver.duration=50 ms"])
    assert found.cage == "locked"
    assert abs(found.power_deviation) < 2e-4
    assert found.deviation is not None
    assert found.deviation < 10.0
    assert found.agree


@pytest.mark.usefixtures("sundials")
@pytest.mark.parametrize("case", [pytest.param("6319-cp10-3000", marks=pytest.mark.full), "6319-cp6.5-500"])
def test_trajectories_at_the_default_tolerance(case: str) -> None:
    """Compare trajectories where vibrations and creep are hard.

    Nothing damps the inner ring of the 6319 at 3000 1/min along the load: 11 tolerances in its speed, 5.5 in the
    shorter steps that dry contacts of unloaded balls take; power is 4e-5 off.
    """
    found = api.cross_check(case, ["solver.duration=50 ms"])
    assert found.tolerance == 1e-3
    assert found.deviation is not None
    assert found.cvode_deviation is not None
    assert found.deviation < 15.0
    assert found.cvode_deviation < 10.0
    assert abs(found.power_deviation) < 2e-4


@pytest.mark.usefixtures("sundials")
@pytest.mark.parametrize("case", ["6319-cp10-3000", "6319-cp6.5-500"])
def test_powers_meet_as_the_tolerance_shrinks(case: str) -> None:
    """Compare powers at shrinking tolerance, for CVODE too.

    The bound is 0.02 %.
    """
    found = api.cross_check(case, ["solver.tolerance=1e-4", "solver.duration=20 ms"])
    assert found.reference is not None
    assert abs(found.power_deviation) < 2e-4
    assert found.cvode.power_W == pytest.approx(found.reference.power_W, rel=2e-4)


@pytest.mark.usefixtures("sundials")
def test_the_bound_of_the_power_is_no_narrower_than_the_tolerances() -> None:
    """Compare powers with errors of the tolerances.

    6208, 100 N radial: the program is 0.06 % off, CVODE 0.03 %; both agree at a hundredth of the tolerance.
    """
    case = "6208-axial-1300", ["loads.axial=0 N", "loads.radial=100 N"]
    found = api.cross_check(case[0], [*case[1], "solver.duration=2 ms"])
    assert found.power_bound is not None
    assert 2e-4 < abs(found.power_deviation) < found.power_bound < 2e-3
    assert found.agree
    finer = api.cross_check(case[0], [*case[1], "solver.duration=2 ms", "solver.tolerance=1e-5"])
    assert abs(finer.power_deviation) < 1e-4


@pytest.mark.full
@pytest.mark.usefixtures("sundials")
@pytest.mark.parametrize(
    ("case", "options"),
    [
        ("6319-cp10-3000", ["solver.duration=1.8 s"]),
        # Over eighty turns the interval is as narrow as errors of integration at the default tolerance.
        pytest.param("6319-cp10-1500", ["solver.duration=8 s", "solver.tolerance=1e-4"], marks=pytest.mark.slow),
    ],
)
def test_mean_powers_meet_with_a_free_cage(case: str, options: list[str]) -> None:
    """Compare mean powers within their joint interval.

    The 95 % interval is below 1 % of the power: a wide one would show nothing.

    Over dozens of turns of the cage: its wandering is slow, and the interval of the shortest run is wide or too narrow.
    """
    found = api.cross_check(case, options, free_cage=True)
    assert found.cage == "free"
    assert found.agree
    for one in (found.ours, found.cvode):
        assert one.power_ci_W is not None
        assert one.power_ci_W < 0.01 * one.power_W


@pytest.mark.usefixtures("sundials")
def test_a_wrong_equation_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Change the viscosity of one side by a hundredth.

    The trajectories no longer agree, so that the check can fail.
    """
    from lambda_core.runs import crosscheck

    def elsewhere(start: object, times: object, tolerance: float) -> object:
        other = api.check("6208-axial-1300", ["lubricant.temperature=40.2 degC"])
        prescribed = with_locked_cage(other, solve(other))
        return integrate(bearing_start(solve(prescribed), prescribed), times, tolerance)  # type: ignore[arg-type]

    monkeypatch.setattr(crosscheck, "integrate", elsewhere)
    found = api.cross_check("6208-axial-1300", ["solver.duration=10 ms"])
    assert not found.agree
    assert abs(found.power_deviation) > 1e-3


@pytest.mark.usefixtures("sundials")
def test_cvode_finds_the_same_with_its_own_jacobian() -> None:
    """Use CVODE's own Jacobian.

    The result does not depend on ours, which Newton's method needs only to converge.
    """
    model = api.check("6319-cp10-1500")
    start = bearing_start(solve(model), model)
    times = np.array([0.0, 5e-3])
    given, own = (integrate(start, times, 1e-5, own_jacobian=own).dissipated()[-1] for own in (False, True))
    assert own == pytest.approx(given, rel=1e-4)


@pytest.mark.usefixtures("sundials")
def test_what_cannot_be_compared_is_said() -> None:
    with pytest.raises(SolverError, match="at least 3 are needed"):
        api.cross_check("6319-cp10-3000", ["solver.duration=0.1 s"], free_cage=True)
    with pytest.raises(SolverError, match="stand still"):
        api.cross_check("6319-cp10-3000", ["operation.speed=0 rpm", "solver.duration=0.1 s"])


def test_without_the_extra_it_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sksundae.cvode", None)
    with pytest.raises(UsageError, match=r"lambda-bearing\[sundials\]"):
        api.cross_check("6208-axial-1300", ["solver.duration=1 ms"])


def test_the_prescribed_cage_turns_with_the_balls() -> None:
    model = api.check("6208-axial-1300")
    start = solve(model)
    dofs = with_locked_cage(model, start).cage_body.dofs
    assert {dofs[name].mode for name in ("y", "z", "tilt_y", "tilt_z")} == {"locked"}
    (term,) = dofs["spin"].motion.terms
    assert term.values[0] == start.orbit
    assert math.isclose(start.orbit, 0.4 * 2750.0 * math.pi / 30.0, rel_tol=0.05)


@pytest.mark.usefixtures("sundials")
def test_a_shaft_in_two_bearings_moves_as_cvode_moves_it(tmp_path: Path) -> None:
    """Compare a shaft in two bearings with CVODE.

    Both bearings and the shaft between them have one trajectory.
    """
    box = api.init_case("box", template="geared-shaft", path=tmp_path / "box.toml")
    found = api.cross_check(box, ["solver.duration=4 ms"])
    assert found.agree
    assert found.ours.calls > 50
    lost = sum(bearing.power_loss_W for bearing in api.quasistatic(box).bearings.values())
    assert found.ours.power_W == pytest.approx(lost, rel=0.1)
