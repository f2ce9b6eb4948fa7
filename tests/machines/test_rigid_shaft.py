"""Test the rigid shaft of a single bearing.

What it carries, and what it refuses.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from lambda_cli.main import main
from lambda_plugins.views import operating_point

from lambda_core import api


def machine(**changes: Any) -> dict[str, Any]:
    """Return a machine of one bearing.

    Its shaft has no sections.
    """
    tables: dict[str, Any] = {
        "name": "rigid",
        "bearings": {"b": {"designation": "SKF 6208", "at": "9 mm"}},
        "discs": {"rotor": {"at": "b", "mass": "2 kg"}},
        "loads": {"belt": {"at": "b", "radial": "2 kN"}},
        "shaft": {"support": {"tilt_y": "locked", "tilt_z": "locked"}},
        "operation": {"speed": "1300 rpm"},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    }
    return tables | changes


def test_weight_and_load_reach_the_bearing() -> None:
    found = api.quasistatic(machine())
    (bearing,) = found.bearings.values()
    ring = api.check(machine()).bearings[0].model.inner_ring.mass
    assert bearing.force_N[2] == pytest.approx(2000.0 + (2.0 + ring) * 9.80665, abs=0.01)
    assert "the shaft is rigid" in found.text()
    assert "bending moment" not in found.text()


def test_friction_is_neglected_where_the_shaft_stands_and_not_in_its_loads() -> None:
    """Name friction neglected for pose, not for loads.

    The report called it neglected in the equilibrium too, which counts it.
    """
    assert "bearing friction is neglected in the displacement of the shaft" in api.check(machine()).assumptions
    sections = {"sections": [{"length": "200 mm", "diameter": "40 mm"}]}
    pair = {"bearings": BEARINGS, "loads": {}, "discs": {}, "shaft": sections}
    assert "bearing friction is neglected in the equilibrium of the shaft" in api.check(machine(**pair)).assumptions


def test_one_bearing_is_no_plural() -> None:
    assert "1 bearing" in api.describe(api.check(machine())).headline[1].split("   ")


def test_a_disc_decides_the_natural_frequency() -> None:
    """Halve the frequency by four times the mass.

    As far as the inner ring's own mass allows.
    """
    light = machine(discs={"rotor": {"at": "b", "mass": "2 kg"}}, gravity={"z": "0 m/s2"})
    heavy = machine(discs={"rotor": {"at": "b", "mass": "8 kg"}}, gravity={"z": "0 m/s2"})
    one, other = (
        min(mode.frequency_Hz for mode in api.modes(each).modes if mode.kind == "lateral") for each in (light, heavy)
    )
    assert one / other == pytest.approx(2.0, rel=0.06)


def test_modes_of_one_bearing_are_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["modes", "6208-axial-1300", "--draw", str(tmp_path), "-q"]) == 0
    assert "6208-axial-1300-whirl.svg" in capsys.readouterr().err


def test_a_view_that_fails_is_named(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Say why a picture is missing.

    Only the exit code told it.
    """
    monkeypatch.setattr(operating_point, "_ROLES", {})
    assert main(["modes", "6208-axial-1300", "--draw", str(tmp_path), "-q"]) == 3
    assert 'the view "whirl" (lambda-bearing ' in caplog.text
    assert not list(tmp_path.iterdir())


BEARINGS = {"b": {"designation": "SKF 6208", "at": "9 mm"}, "c": {"designation": "SKF 6208", "at": "90 mm"}}
ALIGNING = {"b": {"designation": "SKF 1208 EKTN9", "at": "9 mm"}}


@pytest.mark.parametrize(
    ("changes", "where", "words"),
    [
        ({"loads": {"belt": {"at": "20 mm", "radial": "2 kN"}}}, "loads.belt.at", "is not the place of the bearing"),
        ({"bearings": BEARINGS}, "shaft.sections", "only the shaft of a single bearing can be rigid"),
        (
            {"shaft": {"support": {"spin": {"damping": "1 N m s/rad"}}}},
            "shaft.support.spin.damping",
            "operation.torque",
        ),
        ({"bearings": ALIGNING, "shaft": {}}, "shaft.support.tilt_y", "a self-aligning bearing holds no tilt"),
    ],
)
def test_what_a_rigid_shaft_refuses(changes: dict[str, Any], where: str, words: str) -> None:
    with pytest.raises(api.CaseError) as refused:
        api.check(machine(**changes))
    assert any(problem.where == where and words in problem.message for problem in refused.value.problems)


def test_a_stiffness_holds_the_tilts_of_a_self_aligning_bearing() -> None:
    support = {"tilt_y": "1000 N m/rad", "tilt_z": {"motion": "1 mrad"}}
    (bearing,) = api.quasistatic(machine(bearings=ALIGNING, shaft={"support": support})).bearings.values()
    assert bearing.misalignment_mrad == pytest.approx([0.0, 1.0], abs=1e-3)
