"""Test the refusal of inputs that shafts do not support."""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.case.written import merged
from lambda_core.formulas.elastic.body import ElasticBody
from lambda_core.formulas.elastic.reduced import write_reduced
from lambda_core.formulas.elastic.whirl import craig_bampton
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine


def tables(**changes: Any) -> dict[str, Any]:
    """Return the case that init writes, with changes."""
    return merged(tomllib.loads(shaft_text("geared-shaft", "box")), changes)


@pytest.fixture
def ross(monkeypatch: pytest.MonkeyPatch) -> None:
    """Stand in for the package ross.

    It is refused before anything of it is used.
    """
    monkeypatch.setitem(sys.modules, "ross", ModuleType("ross"))


def alone() -> ElasticBody:
    """Return the shaft without its disc.

    The disc is a free body.
    """
    return resolve_machine(tables(discs=None)).body


@pytest.mark.usefixtures("ross")
def test_ross_has_no_shafts_from_outside(tmp_path: Path) -> None:
    body = alone()
    write_reduced(craig_bampton(body, [0.0, 0.021, 0.085, 0.148, 0.17], 0), tmp_path / "shaft.json")
    model = resolve_machine(tables(shaft={"reduced": "shaft.json", "sections": None}, discs=None), folder=tmp_path)
    with pytest.raises(api.UsageError, match="an imported shaft has no sections"):
        api.ross_rotor(model)


@pytest.mark.usefixtures("ross")
@pytest.mark.parametrize("way", ["to the body", "from the body"])
def test_ross_has_no_springs_to_bodies(way: str) -> None:
    body = {"x": "85 mm", "mass": "9 kg", "polar_inertia": "1 kg m2", "transverse_inertia": "1 kg m2"}
    connections: dict[str, Any] = {"mount": {"at": "foot", "z": "50 N/um"}}
    if way == "to the body":
        connections["seal"] = {"at": "100 mm", "to": "box", "z": "1 N/um"}
    else:
        connections["seal"] = {"at": "inside", "to": "shaft", "z": "1 N/um"}
    markers = {"foot": {"body": "box", "x": "10 mm"}, "inside": {"body": "box", "x": "100 mm"}}
    model = resolve_machine(tables(bodies={"box": body}, markers=markers, connections=connections))
    with pytest.raises(api.UsageError, match="ROSS has no springs between the shaft and other bodies: remove them"):
        api.ross_rotor(model)


def test_ross_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ross", None)
    with pytest.raises(api.UsageError, match="pip install ross-rotordynamics"):
        api.ross_rotor(resolve_machine(tables()))


def test_points_of_the_shaft_have_no_prescribed_motion() -> None:
    """Refuse prescribed motions that do not exist.

    A motion over time has a name of its own; the shaft has none, a body none about x. Each has its path.
    """
    prescribed = {"kind": "harmonic", "amplitude": "1 um", "frequency": "50 Hz"}
    body = {"x": "85 mm", "mass": "9 kg", "polar_inertia": "1 kg m2", "transverse_inertia": "1 kg m2"}
    body["support"] = {"z": prescribed, "tilt_x": {"motion": "1 mrad"}}
    changes = {
        "bearings": {"left": {"support": {"y": prescribed}}},
        "bodies": {"box": body},
        "shaft": {"z": prescribed},
    }
    with pytest.raises(api.CaseError) as found:
        resolve_machine(tables(**changes))
    said = {problem.where: problem.message for problem in found.value.problems}
    places = ["bearings.left.support.y", "bodies.box.support.tilt_x.motion", "bodies.box.support.z", "shaft.z"]
    assert sorted(said) == places
    for where in ("bearings.left.support.y", "bodies.box.support.z"):
        assert "{ motion = { kind = ... } }" in said[where]
    assert "is not an option here" in said["shaft.z"]


def test_what_of_a_housing_is_left_out_is_said(tmp_path: Path) -> None:
    """State neglected parts of a housing.

    Damping counts; mass, gyroscopic matrix and lumps are assumptions of the result.
    """
    body = craig_bampton(alone(), [0.021, 0.148], 0)
    held = body.stiffness + np.diag(np.tile([1e8, 1e8, 1e8, 1e5, 1e5, 1e5], 2))
    turning = np.zeros_like(held)
    turning[4, 5], turning[5, 4] = 0.01, -0.01
    complete = ElasticBody(body.positions, held, body.mass, turning, lumps=(0,), damping=1e-5 * held)
    write_reduced(complete, tmp_path / "housing.json")
    model = resolve_machine(tables(housing={"reduced": "housing.json"}), folder=tmp_path)
    told = " ".join(model.assumptions)
    for what in ("the mass", "the gyroscopic matrix", "the lumps"):
        assert f"{what} of the elastic housing" in told
    assert model.housing_damping is not None
    assert np.abs(model.housing_damping).max() > 1.0
    quiet = ElasticBody(body.positions, held, 0.0 * body.mass, 0.0 * turning)
    write_reduced(quiet, tmp_path / "housing.json")
    model = resolve_machine(tables(housing={"reduced": "housing.json"}), folder=tmp_path)
    assert not any("elastic housing" in sentence for sentence in model.assumptions)


@pytest.mark.parametrize(
    ("changes", "where", "said"),
    [
        ({"connections": {"s": {"at": "85 mm", "z": "1e30 N/m"}}}, "connections.s.z", "1000000000 N/um"),
        (
            {"connections": {"s": {"at": "85 mm", "y": {"damping": "1e30 N s/m"}}}},
            "connections.s.y.damping",
            "1e+15 N s/m",
        ),
        ({"bearings": {"left": {"support": {"y": "1e30 N/m"}}}}, "bearings.left.support.y", 'or write "locked"'),
        ({"gears": {"wheel": {"power": "1e300 kW"}}}, "gears.wheel.power", "more than 1000 times the"),
        (
            {"loads": {"belt": {"at": "5 mm", "force_z": "-1e12 N"}}},
            "loads.belt.force_z",
            "acts with 1e+12 N, more than 1000 times the",
        ),
    ],
)
def test_what_no_part_bears_is_refused_at_once(changes: dict[str, Any], where: str, said: str) -> None:
    """Refuse a structure that rounding made singular.

    Rounding removed its other parts, and the solver pressed balls through rings for a minute.
    """
    with pytest.raises(api.CaseError) as found:
        resolve_machine(tables(**changes))
    (problem,) = found.value.problems
    assert problem.where == where
    assert said in problem.message
