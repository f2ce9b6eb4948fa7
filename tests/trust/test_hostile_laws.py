"""Test that laws at fault are found before a run."""

from __future__ import annotations

import json
import re
import time
import tomllib
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.discovery import local_files, manager
from lambda_core.domain.errors import SolverError
from lambda_core.domain.installed import ON_VARIABLE
from lambda_core.laws import check, tried
from lambda_core.laws.jit.reach import UnreachableError, reach
from lambda_core.laws.kernels import compile_kernel
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.runs.law_blame import BlamingEngine, naming_laws
from lambda_core.solver.drivers.dynamics import MotionEngine, bearing_start
from lambda_core.solver.drivers.engine import Advance
from lambda_core.solver.drivers.machine_motion import machine_start

LAWS = """
import math
import numpy as np
import scipy.special as special
from scipy.special import erf
from lambda_core.plugins import OK, law

def plain(slip, p, tau):
    for i in range(slip.size):
        tau[i] = 0.05 * p[i] if slip[i] > 0.0 else 0.0

@law("traction", "outside", role_api=3, reference="none")
def outside(slip, p, T, ln_eta, h, par, tau):
    plain(slip, p, tau)
    for i in range(slip.size):
        if 1.2e9 < p[i] < 1.2005e9:
            tau[i + 40] = 1e300
    return OK

@law("traction", "often-outside", role_api=3, reference="none")
def often_outside(slip, p, T, ln_eta, h, par, tau):
    plain(slip, p, tau)
    for i in range(slip.size):
        if p[i] > 1.0e9:
            tau[i + 3] = 1e300
    return OK

@law("traction", "gap", role_api=3, reference="none")
def gap(slip, p, T, ln_eta, h, par, tau):
    plain(slip, p, tau)
    for i in range(slip.size):
        if 1.2 < p[i] * 1e-9 < 1.2005:
            tau[i] = math.nan
    return OK

@law("traction", "driving", role_api=3, reference="none")
def driving(slip, p, T, ln_eta, h, par, tau):
    plain(slip, p, tau)
    for i in range(slip.size):
        if 1.2e9 < p[i] < 1.2005e9:
            tau[i] = -1e9
    return OK

@law("traction", "lurking", role_api=3, reference="none")
def lurking(slip, p, T, ln_eta, h, par, tau):
    plain(slip, p, tau)
    for i in range(slip.size):
        while 1.2e9 < p[i] < 1.2005e9:
            tau[i] = 1.0
    return OK

@law("traction", "vectors", role_api=3, reference="none")
def vectors(slip, p, T, ln_eta, h, par, tau):
    tau[:] = np.exp(-slip) * slip
    return OK

@law("traction", "special", role_api=3, reference="none")
def of_scipy(slip, p, T, ln_eta, h, par, tau):
    for i in range(tau.size):
        tau[i] = erf(slip[i])
    return OK

@law("traction", "special-two", role_api=3, reference="none")
def of_scipy_too(slip, p, T, ln_eta, h, par, tau):
    for i in range(tau.size):
        tau[i] = special.erf(slip[i])
    return OK

@law("traction", "sound", role_api=3, reference="none")
def sound(slip, p, T, ln_eta, h, par, tau):
    plain(slip, p, tau)
    return OK

@law("force_element", "rope", role_api=3, reference="none", errors={7: "the rope has torn"})
def rope(t, place, tilt, v_rel, omega_rel, par, out):
    for i in range(6):
        out[i] = 0.0
    return 7 if place[2] < -1e-6 else OK
"""
FOUND = {
    "outside": "reads or writes outside its arrays: IndexError.*hostile.py, line 17",
    "gap": "leaves shear stress .* unwritten or returns NaN",
    "driving": r"returns shear stress .* = -1e\+09; allowed: 0 to inf",
    "lurking": "does not come to an end",
    "vectors": "cannot be compiled: it makes an array or a list.*hostile.py., line 54",
    "special": '"erf", used by of_scipy, is a ufunc: a kernel may use numbers',
    "special-two": '"special.erf", used by of_scipy_too, is a ufunc',
}
CASE = "6208-axial-1300"


@pytest.fixture(autouse=True)
def hostile(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Any:
    """Use the file of hostile laws.

    For one test.
    """
    file = tmp_path / "hostile.py"
    file.write_text(LAWS)
    monkeypatch.setenv(ON_VARIABLE, str(file))
    monkeypatch.setattr(local_files, "_texts", {})
    manager.registry.cache_clear()
    yield file
    monkeypatch.undo()
    manager.registry.cache_clear()


def law(name: str) -> Any:
    return manager.registry().model("traction", name)


@pytest.mark.parametrize("name", FOUND)
def test_a4_a_law_is_refused_wherever_it_goes_wrong(name: str) -> None:
    (fault,) = check.check_model(law(name)).faults
    assert fault.startswith(f"traction/{name} (hostile.py ")
    assert re.search(FOUND[name], fault), fault


def test_a4_a_sound_law_among_them_is_not() -> None:
    assert check.check_model(law("sound")).ok


@pytest.mark.parametrize("name", ["outside", "driving", "lurking", "special"])
def test_a4_check_tries_the_laws_of_a_case(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Try the laws of a case in `check`.

    ``check CASE`` ends as ``run`` does, with exit code 3 and the law's name, and --json stays one object.
    """
    assert main(["check", CASE, "--set", f"models.traction={name}", "--json"]) == 3
    (error,) = json.loads(capsys.readouterr().out)["errors"]
    assert error["where"] == "models.traction"
    assert f"traction/{name} (hostile.py " in error["message"]


def test_a4_check_of_a_sound_law_goes_through(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", CASE, "--set", "models.traction=sound"]) == 0
    assert "laws of others: traction sound (hostile.py " in capsys.readouterr().out


def test_a4_a_kernel_that_calls_itself_through_scipy_is_a_sentence() -> None:
    with pytest.raises(UnreachableError, match="is a ufunc"):
        reach(law("special").kernel)


def test_a4_laws_of_others_raise_at_a_wrong_index() -> None:
    """Raise at a wrong index of foreign laws.

    Their machine code writes neither behind its arrays nor into the cells of the next contact.
    """
    room = np.zeros(100)
    compiled = compile_kernel(law("outside")).dispatcher
    pressure = np.ones(60)
    pressure[7] = 1.2002e9
    with pytest.raises(IndexError):
        compiled(np.ones(60), pressure, np.ones(60), np.ones(60), np.full(60, 1e-7), np.zeros(1), room[:60])
    assert not (room == 1e300).any()


@pytest.mark.timeout(900)
def test_a4_an_index_that_is_wrong_in_a_run_alone_ends_it_with_the_name_of_the_law(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """End a run at an index wrong there alone.

    The trials are left out, as if no draw had met a pressure at which the index is wrong.
    """
    monkeypatch.setattr(tried, "check_choice", lambda *_: None)
    out = ["--duration", "1 ms", "--out", str(tmp_path / "run.h5"), "--quiet"]
    assert main(["run", CASE, "--set", "models.traction=often-outside", *out]) == 4
    said = capsys.readouterr().err
    assert "traction/often-outside (hostile.py " in said
    assert "1e+300" not in said


@pytest.mark.timeout(900)
def test_a4_a_step_that_becomes_too_small_is_told_with_the_law_behind_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blame the law behind a tiny step.

    The program first examines the shear stress at the state where the integration stopped.
    """
    from lambda_core.solver.drivers.equilibrium import solve

    model = api.check(CASE, ["models.traction=sound"])
    engine = BlamingEngine(bearing_start(solve(model), model))
    stuck = Advance(ok=False, message="the time step fell below 1e-14 s at t = 0 s")
    monkeypatch.setattr(MotionEngine, "advance", lambda *_: stuck)
    assert "laws of others took part: traction/sound (hostile.py " in engine.advance(1.0).message

    def drives(slip: Any, p: Any, T: Any, ln_eta: Any, h: float, par: Any, tau: Any) -> int:
        tau[:] = -0.05 * p
        return 1

    kernels = engine.context.kernels.compiled
    monkeypatch.setitem(kernels, ("ball_inner", "traction"), SimpleNamespace(dispatcher=drives))
    said = engine.advance(1.0).message
    assert said.startswith(f"{stuck.message}; traction/sound (hostile.py ")
    assert "returns a shear stress of -" in said
    assert "ball - inner (slip = " in said


@pytest.mark.timeout(900)
def test_a4_a_failure_of_a_machine_names_law_and_bearing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Name law and bearing of a failed machine.

    As for one bearing, with the name of the bearing whose contacts are driven.
    """
    machine = resolve_machine(tomllib.loads(shaft_text("geared-shaft", "box")), ["models.traction=sound"])
    engine = BlamingEngine(machine_start(machine).motion)
    stuck = Advance(ok=False, message="the time step fell below 1e-14 s at t = 0 s")
    monkeypatch.setattr(MotionEngine, "advance", lambda *_: stuck)
    assert "laws of others took part: traction/sound (hostile.py " in engine.advance(1.0).message

    def drives(slip: Any, p: Any, T: Any, ln_eta: Any, h: float, par: Any, tau: Any) -> int:
        tau[:] = -0.05 * p
        return 1

    kernels = engine.bearings[0].context.kernels.compiled
    monkeypatch.setitem(kernels, ("ball_outer", "traction"), SimpleNamespace(dispatcher=drives))
    said = engine.advance(1.0).message
    assert said.startswith(f"{stuck.message}; left: traction/sound (hostile.py "), said
    assert "ball - outer (slip = " in said


def test_a4_an_equilibrium_that_is_not_found_names_the_laws_of_others() -> None:
    model = api.check(CASE, ["models.traction=sound"])
    with pytest.raises(SolverError, match=r"no equilibrium; laws of others took part: traction/sound \(hostile.py"):
        raise_within(model, "no equilibrium")
    with pytest.raises(SolverError, match=r"^traction/sound \(.* returned NaN$"):
        raise_within(model, f"{law('sound').label} returned NaN")


def raise_within(model: Any, sentence: str) -> None:
    with naming_laws(model):
        raise SolverError(sentence)


def test_a4_trying_at_thresholds_takes_a_moment() -> None:
    """Limit the delay of trials to a second.

    The run chose the law of a stranger.
    """
    from lambda_core.laws.par import make_par
    from lambda_core.laws.probe import trial_context

    sound = law("sound")
    par = make_par(sound, sound.parameters(), trial_context("ball_inner"))
    check.check_choice(sound, par)  # compiled by now
    begun = time.process_time()
    check.check_choice(sound, par)
    assert time.process_time() - begun < 10.0  # takes a tenth of a second


def test_a_force_element_that_refuses_in_the_equilibrium_says_why() -> None:
    """Report the status of a refusing force element.

    The message blamed supports and lost the sentence of its status.
    """
    changes = ["loads.radial=2 kN", "elements.line.law=rope", "elements.line.second=inner_ring"]
    with pytest.raises(SolverError, match=r"force_element/rope .*: the rope has torn \(elements.line; t 0, place"):
        api.quasistatic(CASE, changes)
