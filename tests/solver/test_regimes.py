"""Test hard regimes.

The run goes through, what it is named after happens, and the energy balance closes.
"""

from __future__ import annotations

import numpy as np
import pytest

from benchmarks.regime_list import AXIAL, RADIAL, REFUSED, REGIMES, Regime
from benchmarks.regimes import BOUND, refusal, run
from benchmarks.roller_regimes import ROLLER_REGIMES
from lambda_core import api
from lambda_core.domain.channels import LOSSES
from lambda_core.solver.drivers.dynamics import BearingEngine

LONG = {"stop"}  # half a minute of one of them: run by name, and by the page of regimes


@pytest.mark.parametrize(
    "regime",
    [
        *(pytest.param(regime, marks=[pytest.mark.slow] * (regime.name in LONG), id=regime.name) for regime in REGIMES),
        *(pytest.param(regime, marks=pytest.mark.full, id=regime.name) for regime in ROLLER_REGIMES),
    ],
)
def test_regime(regime: Regime) -> None:
    """Balance energy within 1e-3 in every regime.

    Kinetic, elastic, dissipated and external energy; each dissipator dissipates.
    """
    found = run(regime)
    assert found.reached, found.message
    assert regime.seen(found.samples)
    assert all(np.all(np.isfinite(values)) for name, values in found.samples.items() if "capacitance" not in name)
    assert found.least_loss >= 0.0
    assert abs(found.residual) < BOUND


@pytest.mark.parametrize("name", REFUSED)
def test_what_has_no_answer_is_refused_with_the_reason(name: str) -> None:
    changes, words = REFUSED[name]
    assert words in refusal(changes)


@pytest.mark.full
def test_a_whirling_cage_is_no_error_of_integration() -> None:
    """Compare a whirling cage at two tolerances.

    A coarse tolerance shakes the cage into a whirl; a fine one started there finds the same whirl and the same loss.

    From its equilibrium the same bearing stays quiet, with less than half the loss. In oiled pockets nothing whirls.
    """
    dry = "parameters.cage_contact.film_width=0"
    loose, fine = (BearingEngine(api.check(AXIAL, [f"solver.tolerance={value}", dry])) for value in ("5e-2", "1e-4"))
    assert loose.advance(0.06).ok
    shaken, own = loose.state(), fine.state()
    shaken["memory.weight"] = own["memory.weight"]
    for entry in ("tolerance", "leak_floor"):
        shaken["memory.control"][entry] = own["memory.control"][entry]
    quiet = _loss(fine, 0.005)
    fine.restore(shaken)
    assert _loss(fine, 0.065) > 2.0 * quiet
    assert _loss(fine, 0.085) == pytest.approx(_loss(loose, 0.085), rel=0.05)


def _loss(engine: BearingEngine, until: float) -> float:
    """Return the mean dissipated power from now on [W]."""
    began, before = engine.time, engine.integrals()
    assert engine.advance(until).ok
    after = engine.integrals()
    return sum(after[f"loss.{name}"] - before[f"loss.{name}"] for name in LOSSES) / (engine.time - began)


def test_rest_costs_no_more_steps_than_running() -> None:
    """Count steps with friction at rest.

    It is nearly a sign function: a Newton iteration without convergence takes 100 000 steps a second.
    """
    engine = BearingEngine(api.check(RADIAL, ["operation.speed=0 rpm", "solver.duration=1 s", "solver.tolerance=1e-4"]))
    assert engine.advance(0.01).ok
    assert engine.statistics()["steps"] < 1000.0


@pytest.mark.parametrize(
    ("designation", "oil", "temperature", "load"),
    [("6016", "minr-vg320", "25 degC", "5810 N"), ("6013", "FVA3A", "60 degC", "6 kN")],
)
def test_what_the_first_steps_leave_does_not_chatter(designation: str, oil: str, temperature: str, load: str) -> None:
    """Count steps at the default tolerance.

    The first steps' iterates, left at 0.3 of it, took 10 000 steps a millisecond here.
    """
    case = {
        "name": "rest",
        "bearing": {"designation": designation, "maker": "SKF"},
        "lubricant": {"name": oil, "temperature": temperature},
        "loads": {"radial": load},
        "operation": {"speed": "0 rpm"},
        "solver": {"duration": "1 s"},
    }
    engine = BearingEngine(api.check(case))
    assert engine.advance(0.003).ok
    assert engine.statistics()["steps"] < 500.0


@pytest.mark.parametrize("case", [RADIAL, AXIAL])
def test_equilibrium_down_to_one_rpm(case: str) -> None:
    """Compare neighbours down to 1 1/min.

    Friction of full films, without asperities, rises with speed, and the balls' orbit hardly changes.

    Newton's method alone runs astray at these speeds; where the continuation is wrong, neighbours do not fit together.
    """
    smooth, speeds = "models.asperity_load=none", (1, 3, 5, 10, 20, 40, 60, 100)
    found = [api.quasistatic(case, [smooth, f"operation.speed={speed} rpm"]) for speed in speeds]
    torques = [one.friction_torque_Nmm for one in found]
    ratios = [one.orbit_speed_ratio for one in found]
    assert torques == sorted(torques)  # type: ignore[type-var]
    assert np.ptp(np.array(ratios, dtype=float)) < 5e-4


def test_balls_heavier_than_their_load_have_an_equilibrium_to_start_from() -> None:
    assert BearingEngine(api.check(RADIAL, ["loads.radial=200 N"])).equilibrium()["converged"]


def test_a_free_ring_starts_at_its_speed() -> None:
    changes = ("bodies.inner_ring.spin=free", "operation.speed=500 rpm", "operation.torque=1 N m")
    engine = BearingEngine(api.check(RADIAL, changes))
    assert engine.advance(1e-4).ok
    assert engine.samples()["body_spin"][0, 0] == pytest.approx(500.0 * np.pi / 30.0)


def test_samples_are_spaced_for_the_speed_to_come() -> None:
    ramp = [
        "operation.speed.kind=ramp",
        "operation.speed.start=0 rpm",
        "operation.speed.end=1500 rpm",
        "operation.speed.end_time=20 ms",
    ]
    rising, running = (BearingEngine(api.check(RADIAL, changes)) for changes in (ramp, []))
    assert rising.sample_interval == pytest.approx(running.sample_interval, rel=0.02)
