"""Test the examples of hosts where their packages are installed."""

from __future__ import annotations

import importlib
import re
import shlex
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


@pytest.mark.full
def test_fmpy_at_two_temperatures(exported: Export, example: Callable[[str], Any]) -> None:
    pytest.importorskip("fmpy", reason="FMPy is not installed: pip install fmpy")
    module = example("bearing_in_fmpy")
    cold, warm = (module.at(str(exported(2, "force")), 273.15 + t, end=2e-3)[-1] for t in (40.0, 55.0))
    assert 0.4 * cold["bearing.film_minimum"] < warm["bearing.film_minimum"] < 0.8 * cold["bearing.film_minimum"]
    assert warm["inner_ring.x"] == pytest.approx(cold["inner_ring.x"], rel=1e-2)


@pytest.mark.full
def test_fmpy_pushes_a_shaft(machine_unit_file: Path, example: Callable[[str], Any], tmp_path: Path) -> None:
    pytest.importorskip("fmpy", reason="FMPy is not installed: pip install fmpy")
    module = example("shaft_in_fmpy")
    found = module.pushed(str(machine_unit_file), end=7e-3)
    before, after = (found["gears.wheel.z"][found["time"] < module.PUSH[0]][-1], found["gears.wheel.z"].min())
    assert after < before - 10e-6
    module.draw(found, str(tmp_path / "shaft-fmu.png"))


@pytest.mark.full
def test_omsimulator(exported: Export, example: Callable[[str], Any]) -> None:
    pytest.importorskip("OMSimulator", reason="OMSimulator is not installed: pip install omsimulator")
    pushed = example("bearing_in_omsimulator").push(str(exported(2, "force")), -250.0, end=5e-3)
    bearing = api.iterate("6208-axial-1300", ("solver.duration=0.2 s", "loads.radial=250 N"), exact=True)
    assert pushed == pytest.approx(float(bearing.step_to(5e-3)["body_position"][0, 2]), rel=2e-2)


def rotor_inside(module: Any, end: float, step: float) -> tuple[Any, Any]:
    """Return places and speeds with a rotor.

    One bearing owns half of it.
    """
    mass = 0.5 * module.MASS
    alone = api.check(module.CASE, module.CHANGES).inner_ring.mass
    held = [f"bodies.inner_ring.{dof}.mode=locked" for dof in ("tilt_y", "tilt_z")]
    more = (f"bodies.inner_ring.shaft_mass={mass - alone} kg", *held)
    bearing = api.iterate(module.CASE, (*module.CHANGES, *more), exact=True)
    found = []
    for k in range(round(end / step)):
        begin, after = (0.5 * module.push(time) for time in (k * step, (k + 1) * step))
        bearing.give("inner_ring.force_z", begin, (after - begin) / step)
        at = bearing.step_to((k + 1) * step)
        found.append((at["body_position"][0].copy(), at["body_velocity"][0].copy()))
    places, speeds = map(np.array, zip(*found, strict=True))
    return places, speeds


def test_a_rotor_on_two_bearings_in_exudyn(example: Callable[[str], Any], tmp_path: Path, c_compiler: Any) -> None:
    """Compare with one bearing that owns half the rotor.

    0.033 % and 1.3e-4 at 20 us, order 2; through the FMU the same bits.
    """
    pytest.importorskip("exudyn", reason="Exudyn is not installed: pip install exudyn")
    pytest.importorskip("fmpy", reason="FMPy is not installed: pip install fmpy")
    module, prescribed = example("rotor_in_exudyn"), example("prescribed_bearing")
    file = api.export_fmu(
        module.CASE, module.CHANGES, out=tmp_path / "prescribed.fmu", couple="motion", processor="native"
    )
    end, step = 2e-3, 1e-5
    places, speeds = rotor_inside(module, end, step)
    way = np.linalg.norm(places - places[0], axis=1).max()
    assert way > 4e-6  # [m]
    off = {}
    for every in (2, 8):
        path = module.rotor(lambda: prescribed.FromUnit(file), end, every * step)
        off[every] = float(np.linalg.norm(path.places[1:] - places[every - 1 :: every], axis=1).max() / way)
        if every > 2:
            continue
        forces = path.reactions.sum(axis=1)[:, :3]
        flow = np.abs((0.5 * (forces[1:] + forces[:-1]) * np.diff(path.places, axis=0)).sum(axis=1)).sum()
        energy, inside = (0.5 * module.MASS * (v**2).sum(axis=1) for v in (path.speeds[1:], speeds[1::2]))
        assert np.abs(energy - inside).max() < 1e-3 * flow
        python = module.rotor(lambda: prescribed.FromPython(module.CASE, module.CHANGES), 0.2 * end, every * step)
        assert np.array_equal(python.reactions, path.reactions[: len(python.time)])
    assert off[2] < 1e-3
    assert off[8] > 10.0 * off[2]  # a fourth of the step is at least a tenth of the error: order 1.7 and more


def test_the_command_in_the_example_exports_its_case(example: Callable[[str], Any]) -> None:
    """Export the case of the example by its command.

    An FMU of another case begins elsewhere, and the rotor falls without a message.
    """
    module = example("rotor_in_exudyn")
    words = shlex.split(re.search(r"``(lambda-bearing .*?)``", module.__doc__, re.DOTALL)[1])  # type: ignore[index]
    assert words[1:6] == ["export", "fmu", module.CASE, "--couple", "motion"]
    said, due = (dict(text.split("=") for text in texts) for texts in (words[7::2], module.CHANGES))
    assert float(said.pop("loads.radial").split()[0]) == pytest.approx(float(due.pop("loads.radial").split()[0]))
    assert said == due


@pytest.mark.full
def test_a_step_is_repeated_until_both_sides_agree(exported: Export, example: Callable[[str], Any]) -> None:
    """Iterate by rollback until the speeds agree.

    The speed at the end of a step follows from the reactions at both ends.
    """
    pytest.importorskip("fmpy", reason="FMPy is not installed: pip install fmpy")
    module, prescribed = example("rotor_in_exudyn"), example("prescribed_bearing")
    element = module.Element(prescribed.FromUnit(exported(2, "motion")))
    step, mass, load = 2e-5, 2.0, np.array([1300.0, 0.0, -500.0])
    before, rate, changes = element.reaction, np.zeros(5), []
    for _ in range(8):
        mean = 0.5 * (before + element.force(step, rate))[:3]
        wanted = step * (mean + load) / mass
        changes.append(float(np.abs(wanted - rate[:3]).max()))
        rate[:3] = wanted
    assert changes[-1] < 1e-6 * changes[0]
    found = element.force(step, rate)
    assert np.array_equal(element.force(step, rate), found)
    pose = element.pose + 0.5 * step * rate
    element.accept(step, pose, rate)
    assert element.force(2 * step, rate)[2] > found[2]  # further down it is pushed up harder


def bearing_for_modelica(names: set[str]) -> str:
    """Return a Modelica model of a spring.

    It has the names of an FMU.
    """
    given = {name for name in names if "reaction" not in name}
    inputs = "\n".join(f"  input Real {name};" for name in sorted(given))
    outputs = "\n".join(f"  output Real {name};" for name in sorted(names - given))
    rest = {"x": "1.507e-4", "y": "0", "z": "0"}
    law = "\n".join(f"  reaction_force_{a} = -2e8*({a} - {at}) - 1e4*{a}_rate;" for a, at in rest.items())
    ring = f"model Ring\n{inputs}\n{outputs}\nequation\n{law}\nend Ring;\n"
    return f"{ring}model Bearing\n  Ring inner_ring;\nend Bearing;\n"


UNITS_OF_MODELICA = """package Modelica package Units package SI
type Mass = Real(unit="kg"); type Force = Real(unit="N"); type Position = Real(unit="m");
type Velocity = Real(unit="m/s"); type Acceleration = Real(unit="m/s2");
end SI; end Units; end Modelica;"""


def test_the_text_for_modelica_is_a_model() -> None:
    """Parse, flatten, sort and solve the Modelica text.

    A spring of 200 N/um replaces the FMU: 500 N are 2.5 um.
    """
    modelica = pytest.importorskip("modelica.sim", reason="modelica is not installed: pip install modelica[sim]")
    from modelica.lang import parse

    named = set(re.findall(r"bearing\.inner_ring\.(\w+)", (HOSTS / "RotorOnBearing.mo").read_text()))
    texts = [UNITS_OF_MODELICA, bearing_for_modelica(named), (HOSTS / "RotorOnBearing.mo").read_text()]
    system = modelica.causalize(modelica.flatten([parse(text) for text in texts], "RotorOnBearing"))
    found = modelica.simulate(system, stop=0.01)
    assert found["r[3]"][-1] == pytest.approx(-2.5e-6, rel=1e-3)


@pytest.mark.full
def test_the_text_for_modelica_names_what_is_there(host: Any, exported: Export, tmp_path: Path) -> None:
    unit = host.Unit(exported(2, "motion"), tmp_path)
    text = (HOSTS / "RotorOnBearing.mo").read_text()
    named = set(re.findall(r"bearing\.(inner_ring\.\w+)", text))
    assert len(named) == 12
    assert named <= set(unit.references)
    x0 = float(re.search(r"x0 = ([\d.e-]+)", text)[1])  # type: ignore[index]
    assert x0 == pytest.approx(float(unit.variables["inner_ring.x"][0].get("start")), rel=1e-3)
