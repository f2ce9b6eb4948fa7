"""Test that states of contacts that run away are named."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
from lambda_cli.main import main

from lambda_core.discovery import local_files, manager, survey
from lambda_core.domain.installed import ON_VARIABLE
from lambda_core.laws import check
from lambda_core.laws.state import State, state_fault
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.runs import law_blame
from lambda_core.runs.law_blame import BlamingEngine
from lambda_core.solver.drivers.machine_motion import machine_start

LAWS = """
from lambda_core.plugins import OK, State, law

HEAT = State("heat", "J", "heat of a contact", scale=1.0)
WARMTH = State("warmth", "K", "warmth of a contact", scale=1.0)

@law("contact_state", "feeding", role_api=3, reference="none", states=(HEAT,))
def feeding(t, load, semi_a, semi_b, p_max, u_mean, u_slide, spin, h, Lambda, psi, power, T_film, T_in, par, out):
    out[0] = 3e4 * (1.0 + par.heat)
    return OK

@law("contact_state", "stiff", role_api=3, reference="none", states=(WARMTH,))
def stiff(t, load, semi_a, semi_b, p_max, u_mean, u_slide, spin, h, Lambda, psi, power, T_film, T_in, par, out):
    out[0] = 1e9 * (20.0 - par.warmth) + load
    return OK

@law("traction", "asking", role_api=3, reference="none", reads={"heta": 1.0})
def asking(slip, p, T, ln_eta, h, par, tau):
    for i in range(slip.size):
        tau[i] = 0.05 * p[i] * par.heta / (1.0 + par.heta) if slip[i] > 0.0 else 0.0
    return OK
"""


@pytest.fixture(autouse=True)
def laws(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Any:
    """Take the file of laws into use for one test."""
    file = tmp_path / "states.py"
    file.write_text(LAWS)
    monkeypatch.setenv(ON_VARIABLE, str(file))
    monkeypatch.setattr(local_files, "_texts", {})
    manager.registry.cache_clear()
    yield file
    monkeypatch.undo()
    manager.registry.cache_clear()


def test_a_state_that_feeds_itself_is_told_by_the_check_and_a_stiff_one_is_not() -> None:
    report = check.check_model(manager.registry().model("contact_state", "feeding"))
    (warning,) = report.warnings
    assert "its state heat runs away" in warning
    assert " J after " in warning
    assert report.ok
    assert check.check_model(manager.registry().model("contact_state", "stiff")).warnings == ()


def test_a_state_that_no_law_keeps_is_told_with_the_nearest(monkeypatch: pytest.MonkeyPatch) -> None:
    (card,) = survey.check_installed(manager.registry(), ["traction/asking"])
    assert card.ok
    assert any('"heta" is not a known state; nearest: heat' in text for text in card.warnings), card.warnings


@pytest.mark.parametrize("unit", ["K", "m3", "J/m2", "W/(m K)", "1/s", "-", "N s/m", "kg/(m2 s)"])
def test_units_of_states(unit: str) -> None:
    assert not faulty(unit)


@pytest.mark.parametrize(("unit", "nearest"), [("Kelvn", ""), ("m/sec", "nearest: "), ("", "no unit"), ("degrees", "")])
def test_what_is_no_unit_is_refused(unit: str, nearest: str) -> None:
    assert nearest in faulty(unit)
    assert f'"{unit}", which is no unit' in faulty(unit)


def faulty(unit: str) -> str:
    from dataclasses import replace

    law = manager.registry().model("contact_state", "stiff")
    return state_fault(replace(law, states=(State("warmth", unit, "of a contact", scale=1.0),)))


@pytest.mark.full
@pytest.mark.timeout(900)
def test_a_run_ends_with_the_state_that_ran_away(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """Name the state that ran away.

    It e-folds in 33 us, so that after 0.9 ms no bound is left: the message does not name the time step.
    """
    out = ["--duration", "3 ms", "--out", str(tmp_path / "run.h5"), "--quiet"]
    assert main(["run", "6208-axial-1300", "--set", "models.contact_state=feeding", *out]) == 4
    said = capsys.readouterr().err
    assert "contact_state/feeding (states.py " in said
    assert "its state heat runs away" in said


@pytest.mark.timeout(900)
def test_a_machine_ends_with_the_bearing_whose_state_ran_away(monkeypatch: pytest.MonkeyPatch) -> None:
    """Name the bearing of the state too.

    The other bearing has the same state, but its contacts came first.

    Steps become smaller as the state grows: a hundred times its scale is far enough here.
    """
    monkeypatch.setattr(law_blame, "FAR", 100.0)
    machine = resolve_machine(tomllib.loads(shaft_text("geared-shaft", "box")), ["models.contact_state=feeding"])
    found = BlamingEngine(machine_start(machine).motion).advance(3e-3)
    assert not found.ok
    assert found.message.startswith("left: contact_state/feeding (states.py "), found.message
    assert "its state heat runs away" in found.message
