"""Test states of contacts.

Closed forms, order of the integration, stiff rates, another integrator, samples and resuming.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.discovery import manager
from lambda_core.domain import inline_laws
from lambda_core.domain.errors import CaseError
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.plugins import OK, Parameters, State, law, parameter
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.first_state import first_state

NAME = "6208-axial-1300"
TURN = 3.0  # turns of the spiral over its decay


@pytest.fixture(scope="module", autouse=True)
def untouched() -> Iterator[None]:
    """Take back the inline laws.

    Other tests of this process do not know them.
    """
    before = dict(inline_laws._laws)
    yield
    inline_laws._laws.clear()
    inline_laws._laws.update(before)
    manager.registry.cache_clear()


class Tau(Parameters):
    tau: float = parameter(1e-3, "time constant [s]", gt=0.0)


SPIRAL = (State("rest", "-", "real part", scale=1.0, start=1.0), State("turned", "-", "imaginary part", scale=1.0))


@law("contact_state", "spiral", Tau, role_api=3, reference="own work", states=SPIRAL)
def spiral(t, load, semi_a, semi_b, p_max, u_mean, u_slide, spin, h, Lambda, psi, power, T_film, T_in, par, out):  # type: ignore[no-untyped-def]
    """Write two coupled states.

    dz/dt = -(1 + 3i) z/tau.
    """
    out[0] = (3.0 * par.turned - par.rest) / par.tau
    out[1] = (-3.0 * par.rest - par.turned) / par.tau
    return OK


@law("contact_state", "warmth", role_api=3, reference="own work",
     states=(State("warmth", "K", "temperature over the oil's", scale=1.0),))  # fmt: skip
def warmth(t, load, semi_a, semi_b, p_max, u_mean, u_slide, spin, h, Lambda, psi, power, T_film, T_in, par, out):  # type: ignore[no-untyped-def]
    """Write a lump's heat.

    2e-4 J/K, 0.2 W/K.
    """
    out[0] = (power - 0.2 * par.warmth) / 2e-4
    return OK


@law("traction", "thinner", role_api=3, reference="own work", reads={"warmth": 20.0})
def thinner(slip, p, T, ln_eta, h, par, tau):  # type: ignore[no-untyped-def]
    """Write a temperature-dependent stress.

    It falls by 3 % per kelvin.
    """
    for i in range(tau.size):
        tau[i] = 0.03 * p[i] * slip[i] / (slip[i] + 0.01) / (1.0 + 0.03 * par.warmth)
    return OK


def engine(laws: dict[str, Any], **sections: Any) -> BearingEngine:
    return BearingEngine(api.check(api.case(NAME).with_(models=laws, **sections)))


def spiral_error(step: float, duration: float = 1e-3) -> float:
    """Return the spiral's largest error.

    Distance of all contacts' states from z = exp(-(1 + 3i) t/tau).
    """
    run = engine({"contact_state": spiral}, solver={"tolerance": 1e-2, "max_step": f"{1e6 * step:g} us"})
    run.advance(duration)
    found = run.samples()
    z = np.exp(-(1.0 + 1j * TURN) * found["time"] / 1e-3)[:, None, None]
    return float(np.abs(found["rest"] + 1j * found["turned"] - z).max())


def test_second_order() -> None:
    """Halve the step and quarter the error.

    The states are part of the BDF of order 2; to 10 % at such steps.
    """
    coarse, fine = (spiral_error(step) for step in (20e-6, 10e-6))
    assert coarse / fine == pytest.approx(4.0, rel=0.1)
    assert fine < 5e-4


def test_stiff_rates_neither_ring_nor_cost_steps() -> None:
    """Follow rates ten thousand times faster than steps.

    L-stable: the states reach their rest at once.
    """
    fast = engine({"contact_state": spiral}, parameters={"contact_state": {"tau": 1e-9}})
    fast.advance(2e-3)
    assert np.abs(fast.samples()["rest"][1:]).max() < 1e-9
    assert fast.statistics()["steps"] < 200  # for two million time constants, the fall at the start included


def test_losses_and_states_find_each_other() -> None:
    """Balance heat and power of each contact.

    After eight time constants G (T - T_oil) is the power of the contact.
    """
    run = engine({"contact_state": warmth, "traction": thinner})
    run.advance(8e-3)
    now = run.now()
    np.testing.assert_allclose(0.2 * now["warmth"], now["contact_loss"], rtol=0.01)
    assert np.all(now["warmth"] > 5.0)


def test_resumed_and_paused_runs_are_the_same_bits() -> None:
    laws = {"contact_state": warmth, "traction": thinner}
    undisturbed, first, second = engine(laws), engine(laws), engine(laws)
    undisturbed.advance(3e-3)
    first.advance(1.1e-3)
    second.restore(first.state())
    second.advance(3e-3)
    ours, theirs = undisturbed.now(), second.now()
    assert all(np.array_equal(ours[name], theirs[name], equal_nan=True) for name in ours)
    early, every = first.samples(), undisturbed.samples()
    assert np.array_equal(every["warmth"][: len(early["time"])], early["warmth"])
    assert np.array_equal(second.samples()["warmth"], every["warmth"])  # those that waited at 1.1 ms, too


def test_slopes_of_the_rates() -> None:
    """Compare the block of a contact with derivatives.

    Its rates are linear, so that it is exact but for rounding.
    """
    context = engine({"contact_state": spiral}).context
    y, rates = np.zeros(context.size), np.zeros(L.power_count(context.bundle))
    start = first_state(context)
    assert core().evaluate(0.0, start, context.bundle, y, rates, 0) == 1
    block = 1e3 * np.array([[-1.0, TURN], [-TURN, -1.0]])
    np.testing.assert_allclose(context.bundle.state_slopes, np.tile(block, (18, 1)), rtol=1e-8)


@pytest.mark.slow
@pytest.mark.skipif(importlib.util.find_spec("sksundae") is None, reason="needs the extra sundials")
def test_another_integrator_agrees() -> None:
    case = api.case(NAME).with_(models={"contact_state": warmth, "traction": thinner}, solver={"duration": "2 ms"})
    assert api.cross_check(case).agree


def test_a_result_has_the_channel_and_closes_its_energy(tmp_path: Path) -> None:
    case = api.case(NAME).with_(models={"contact_state": warmth, "traction": thinner})
    result = api.run(case, ["solver.duration=10 ms"], out=tmp_path / "run.h5")
    assert {c.name: (c.unit, c.dims) for c in result.channels}["warmth"] == ("K", ("ball", "ring"))
    assert result["warmth"][0].max() < 1e-12
    assert result["warmth"][-1].min() > 5.0
    assert abs(result.summary().energy_residual) < 1e-3
    assert any("stand at their start: warmth" in sentence for sentence in result.summary().assumptions)


def test_one_raceway_may_keep_what_the_other_does_not() -> None:
    run = engine({}, forces={"ball_inner": {"models": {"contact_state": spiral}}})
    run.advance(1e-4)
    rest = run.now()["rest"]
    assert np.all(rest[:, 0] < 1.0)
    assert np.all(np.isnan(rest[:, 1]))


def test_what_nobody_keeps_cannot_be_read() -> None:
    with pytest.raises(CaseError, match=r"reads the state warmth, which no law keeps at ball_inner: choose a law"):
        api.check(api.case(NAME).with_(models={"traction": thinner}))
    with pytest.raises(CaseError, match=r"no law keeps at ball_inner; .*spiral.* keeps rest, turned"):
        api.check(api.case(NAME).with_(models={"traction": thinner, "contact_state": spiral}))


@pytest.mark.parametrize(
    ("role", "more", "words"),
    [
        ("normal_contact", {"reads": {"warmth": 1.0}}, "reads states, which laws of the role normal_contact cannot"),
        ("traction", {"states": SPIRAL}, "keeps states: only laws of the role contact_state do"),
        ("traction", {"reads": {"load": 1.0}}, "has the state load: the name is taken"),
        ("traction", {"reads": {"warmth": float("nan")}}, "must be a finite number"),
        ("contact_state", {}, "keeps no state: name what every contact keeps"),
        ("contact_state", {"states": (State("a", "-", "a", scale=0.0),)}, "must be a positive number"),
        ("contact_state", {"states": (State("A b", "-", "a", scale=1.0),)}, "in lower case with underscores"),
    ],
)
def test_declarations_that_are_refused(role: str, more: dict[str, Any], words: str) -> None:
    from lambda_core.discovery.collect import law_fault
    from lambda_core.domain.roles import ROLES
    from lambda_core.laws.law import law_of

    arguments = ", ".join(argument.name for argument in ROLES[role].arguments)
    scope: dict[str, Any] = {}
    exec(f"def kernel({arguments}):\n    return 1", scope)
    made = law_of(law(role, "own", role_api=3, reference="own work", **more)(scope["kernel"]))
    assert made is not None
    assert words in law_fault(made)


def test_a_parameter_and_a_state_of_one_name() -> None:
    from lambda_core.laws.law import law_of
    from lambda_core.laws.par import par_layout

    made = law_of(law("traction", "own", Tau, role_api=3, reference="-", reads={"tau": 1.0})(thinner))
    assert made is not None
    with pytest.raises(PluginError, match="has a parameter and a state of one name, tau"):
        par_layout(made)


def test_a_rate_that_is_no_number_is_blamed() -> None:
    @law("contact_state", "broken", role_api=3, reference="own work", states=(State("age", "s", "age", scale=1.0),))
    def broken(t, load, semi_a, semi_b, p_max, u_mean, u_slide, spin, h, Lambda, psi, power, T_film, T_in, par, out):  # type: ignore[no-untyped-def]
        out[0] = 1.0 / (1.0 - par.age * 1e3) if par.age < 0.9e-3 else 1e308 * 1e308
        return OK

    run = engine({"contact_state": broken})
    ended = run.advance(3e-3)
    assert not ended.ok
    assert "contact_state/broken" in ended.message
    assert "ball 1, ball - inner" in ended.message


DEPTH = State("wear_depth", "m", "depth worn off", scale=1e-9, lower=0.0)


@law("contact_state", "worn", role_api=3, reference="own work", states=(DEPTH,))
def worn(t, load, semi_a, semi_b, p_max, u_mean, u_slide, spin, h, Lambda, psi, power, T_film, T_in, par, out):  # type: ignore[no-untyped-def]
    """Write a wear rate of both signs.

    It starts at zero, is polished away for half a millisecond, and grows then.
    """
    out[0] = -1e-6 if t < 0.5e-3 else 1e-9 * power / (1e-9 + par.wear_depth)
    return OK


@law("traction", "rough", role_api=3, reference="own work", reads={"wear_depth": 1e-9})
def rough(slip, p, T, ln_eta, h, par, tau):  # type: ignore[no-untyped-def]
    """Write a stress by a depth's root.

    No number where the depth is below zero.
    """
    for i in range(tau.size):
        tau[i] = 0.03 * p[i] * slip[i] / (slip[i] + 0.01) / (1.0 + par.wear_depth**0.5)
    return OK


def test_a_state_stays_within_its_bounds_where_laws_read_it() -> None:
    """Keep a state above its lower bound.

    The rate points below it for half a millisecond; the root of the state stays a number.
    """
    run = engine({"contact_state": worn, "traction": rough})
    ended = run.advance(1e-3)
    assert ended.ok, ended.message
    found = run.samples()
    early = found["time"] < 0.45e-3
    assert np.all(found["wear_depth"][early] == 0.0)
    assert found["wear_depth"].min() == 0.0
    assert found["wear_depth"][-1].max() > 0.0


def test_check_tries_readers_of_states_at_their_start() -> None:
    @law("traction", "divides", role_api=3, reference="own work", reads={"wear_depth": 1e-9})
    def divides(slip, p, T, ln_eta, h, par, tau):  # type: ignore[no-untyped-def]
        for i in range(tau.size):
            tau[i] = 1e-12 * p[i] * slip[i] / par.wear_depth
        return OK

    (problem,) = api.law_problems(api.check(api.case(NAME).with_(models={"contact_state": worn, "traction": divides})))
    assert problem.where == "models.traction"
    assert "par.wear_depth = 0" in problem.message


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"lower": 2.0, "upper": 1.0}, "lower must be below upper"),
        ({"lower": 2.0}, "starts at 0; allowed: 2 to inf -"),
    ],
)
def test_bounds_that_are_refused(more: dict[str, float], words: str) -> None:
    from dataclasses import replace

    from lambda_core.discovery.collect import law_fault
    from lambda_core.laws.context import Context
    from lambda_core.laws.law import law_of
    from lambda_core.laws.par import make_par
    from lambda_core.laws.parameter import NoParameters

    made = law_of(worn)
    assert made is not None
    made = replace(made, states=(State("wear_depth", "-", "depth", scale=1.0, **more),))
    if fault := law_fault(made):
        assert words in fault
        return
    context: Any = Context
    with pytest.raises(PluginError, match=words):
        make_par(made, NoParameters(), context)
