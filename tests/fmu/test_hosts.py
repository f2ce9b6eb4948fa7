"""The examples of hosts, each where its package is installed: FMPy, OMSimulator, Exudyn; and the text for Modelica."""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api

HOSTS = Path(__file__).parents[2] / "examples" / "hosts"
Export = Callable[[int, str], Path]


@pytest.fixture
def example(monkeypatch: pytest.MonkeyPatch) -> Callable[[str], Any]:
    """Return a function that imports an example."""
    monkeypatch.syspath_prepend(str(HOSTS))
    return importlib.import_module


def test_fmpy_at_two_temperatures(exported: Export, example: Callable[[str], Any]) -> None:
    pytest.importorskip("fmpy", reason="FMPy is not installed: pip install fmpy")
    module = example("bearing_in_fmpy")
    cold, warm = (module.at(str(exported(2, "force")), 273.15 + t, end=2e-3)[-1] for t in (40.0, 55.0))
    assert 0.4 * cold["bearing.film_minimum"] < warm["bearing.film_minimum"] < 0.8 * cold["bearing.film_minimum"]
    assert warm["inner_ring.x"] == pytest.approx(cold["inner_ring.x"], rel=1e-2)


def test_omsimulator(exported: Export, example: Callable[[str], Any]) -> None:
    pytest.importorskip("OMSimulator", reason="OMSimulator is not installed: pip install omsimulator")
    pushed = example("bearing_in_omsimulator").push(str(exported(2, "force")), -250.0, end=5e-3)
    bearing = api.iterate("6208-axial-1300", ("solver.duration=0.2 s", "loads.radial=250 N"), exact=True)
    assert pushed == pytest.approx(float(bearing.step_to(5e-3)["body_position"][0, 2]), rel=2e-2)


def rotor_inside(module: Any, end: float, step: float) -> Any:
    """Return heights of one bearing that owns half of the rotor."""
    mass = 0.5 * module.MASS
    alone = api.check(module.CASE, module.CHANGES).inner_ring.mass
    more = (f"bodies.inner_ring.shaft_mass={mass - alone} kg", "solver.accuracy=vibration", "solver.tolerance=1e-4")
    held = [f"bodies.inner_ring.{dof}.mode=locked" for dof in ("tilt_y", "tilt_z")]
    bearing = api.iterate(module.CASE, (*module.CHANGES, *more, *held), exact=True)
    heights = []
    for k in range(round(end / step)):
        bearing.push((0.0, 0.0, 0.5 * module.PUSH if k * step >= module.PUSHED_AT - 1e-12 else 0.0))
        heights.append(bearing.step_to((k + 1) * step)["body_position"][0, 2])
    return np.array(heights)


@pytest.mark.slow
def test_a_rotor_on_two_bearings_in_exudyn(example: Callable[[str], Any], tmp_path: Path, c_compiler: Any) -> None:
    """Against one bearing that owns half of it; through the FMU the same to the digits that signals keep."""
    pytest.importorskip("exudyn", reason="Exudyn is not installed: pip install exudyn")
    module, led = example("rotor_in_exudyn"), example("led_bearing")
    end, step = 2e-3, 1e-5
    found = module.rotor(lambda: led.FromPython(module.CASE, module.CHANGES), end, step)[:, 1]
    way = abs(found[-1] - found[0])
    assert way > 4e-6  # [m]
    inside = rotor_inside(module, end, step)
    assert np.abs(found[1:] - inside).max() < 0.03 * way
    pytest.importorskip("fmpy", reason="FMPy is not installed: pip install fmpy")
    file = api.export_fmu(module.CASE, module.CHANGES, out=tmp_path / "led.fmu", couple="motion", processor="native")
    through = module.rotor(lambda: led.FromUnit(file), end, step)[:, 1]
    assert np.abs(through - found).max() < 1e-9 * way


def test_a_step_is_repeated_until_both_sides_agree(exported: Export, example: Callable[[str], Any]) -> None:
    """Iterate by rollback: the speed at the end of a step as the reaction there wants it."""
    pytest.importorskip("fmpy", reason="FMPy is not installed: pip install fmpy")
    bearing, still = example("led_bearing").FromUnit(exported(2, "motion")), np.zeros(5)
    step, mass, load = 5e-6, 2.0, np.array([1300.0, 0.0, -500.0])
    first = bearing.again(step, [(bearing.pose, still, still)] * 2)
    acceleration, changes, answer = still.copy(), [], first
    for _ in range(6):
        wanted = still.copy()
        wanted[:3] = (0.5 * (answer[:3] - load * [1, 0, 0]) + load) / mass
        changes.append(float(np.abs(wanted - acceleration).max()))
        acceleration = wanted
        answer = bearing.again(step, [(bearing.pose, still, acceleration)])
    assert changes[-1] < 1e-3 * changes[0]
    assert bearing.again(2 * step, [(bearing.pose, still, still)]) is not None


def test_the_text_for_modelica_names_what_is_there(host: Any, exported: Export, tmp_path: Path) -> None:
    unit = host.Unit(exported(2, "motion"), tmp_path)
    text = (HOSTS / "RotorOnBearing.mo").read_text()
    named = set(re.findall(r"bearing\.(inner_ring\.\w+)", text))
    assert len(named) == 12
    assert named <= set(unit.references)
    x0 = float(re.search(r"x0 = ([\d.e-]+)", text)[1])  # type: ignore[index]
    assert x0 == pytest.approx(float(unit.variables["inner_ring.x"][0].get("start")), rel=1e-3)
