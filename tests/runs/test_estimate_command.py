"""Test the estimated processor time of a run."""

from __future__ import annotations

import json
import time
import tomllib

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.model.machine_templates import shaft_text
from lambda_core.solver.drivers.machine_motion import machine_engine


def test_an_estimate_of_a_machine_is_about_what_its_run_takes() -> None:
    """Compare the estimate with a run's time.

    To a factor of three: the trial is 2.5 ms of 100 ms.
    """
    tables = tomllib.loads(shaft_text("geared-shaft", "box"))
    found = api.estimate(tables, ["solver.duration=0.1 s"])
    assert found.simulated_s == 0.1
    engine = machine_engine(api.check(tables))
    begin = time.process_time()
    assert engine.advance(0.1).ok
    assert found.processor_s == pytest.approx(time.process_time() - begin, rel=2.0)
    assert found.processor_s > (time.process_time() - begin) / 3.0
    equilibrium = api.quasistatic(tables, ["solver.duration=0.1 s"], band=False)
    assert found.equilibrium.model_dump() == equilibrium.model_dump()
    assert found.basis.startswith("solver.duration of the case; a trial of 2.5")


def test_without_a_duration_a_run_is_the_shortest_that_can_converge() -> None:
    """Plan five turns of the slowest cage.

    `solver.max_duration` may end the run earlier.
    """
    tables = tomllib.loads(shaft_text("geared-shaft", "box"))
    found = api.estimate(tables)
    assert 5.0 / 50.0 / 0.45 < found.simulated_s < 5.0 / 50.0 / 0.35  # cages turn at 0.35 to 0.45 of 50 1/s
    assert "5 turns of the slowest cage" in found.basis


def test_the_command_says_time_and_basis(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["estimate", "6208-axial-1300", "--duration", "0.2 s", "-q"]) == 0
    assert "a run of 0.2 s takes" in capsys.readouterr().out
    assert main(["estimate", "6208-axial-1300", "--set", "operation.speed=0 rpm", "--duration", "1 ms", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["simulated_s"] == 1e-3
