"""Test the reports of geometric conflicts and exceeded limits."""

from __future__ import annotations

import json
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lambda_cli.main import main
from lambda_gui.checking import Checker

from lambda_core import api
from lambda_core.case.case_writer import tables_toml
from lambda_core.case.machine import MachineCase
from lambda_core.case.written import merged
from lambda_core.domain.errors import Problem
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.results.limits import warnings


def tables(**changes: Any) -> dict[str, Any]:
    """Return the case that init writes, with changes."""
    return merged(tomllib.loads(shaft_text("geared-shaft", "box")), changes)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            {"bearings": {"left": {"designation": "SKF 6319", "at": "25 mm"}}},
            ("its bore of 95 mm is 55 mm wider than the shaft's diameter of 40 mm from 2.5 mm to 30 mm",),
        ),
        (
            {"bearings": {"left": {"at": "24 mm"}}},
            ("left: its bore of 40 mm does not go over the shaft's diameter of 48 mm from 30 mm to 33 mm",),
        ),
        (
            {"bearings": {"right": {"at": "165 mm"}}},
            ("right (157 mm to 173 mm) stands out 3 mm beyond the right end of the shaft, 170 mm long",),
        ),
        (
            {"bearings": {"left": {"at": "8 mm"}}},
            ("left (-1 mm to 17 mm) stands out 1 mm beyond the left end of the shaft",),
        ),
        (
            {"bearings": {"next": {"designation": "SKF 6208", "at": "9 mm"}}},
            ("next (0 mm to 18 mm) and left (12 mm to 30 mm) overlap by 6 mm",),
        ),
        (
            {"gears": {"wheel": {"at": "29 mm"}}},
            ("the gear wheel at 29 mm stands inside the bearing left (12 mm to 30 mm)",),
        ),
        (
            {"gears": {"wheel": {"pitch_diameter": "45 mm"}}},
            ("the pitch diameter of 45 mm of the gear wheel is inside the shaft, whose diameter there is 48 mm",),
        ),
        (
            {"discs": {"rotor": {"at": "120 mm", "diameter": "90 mm", "width": "50 mm"}}},
            ("the disc rotor (95 mm to 145 mm) and the bearing right (140 mm to 156 mm) overlap by 5 mm",),
        ),
        ({"bearings": {"left": {"fits": {"shaft": "k5", "shaft_bore": "12 mm"}}}}, ("shaft_bore is 12 mm, but",)),
        # two bearings face to face: only the end of the shaft is too short
        ({"bearings": {"next": {"designation": "SKF 6208", "at": "3 mm"}}}, ("next (-6 mm to 12 mm) stands",)),
        ({}, ()),
    ],
)
def test_what_cannot_stand_there(changes: dict[str, Any], said: tuple[str, ...]) -> None:
    found = resolve_machine(tables(**changes)).warnings
    assert len(found) == len(said), found
    for sentence, words in zip(found, said, strict=True):
        assert words in sentence


def test_an_undercut_takes_no_seat() -> None:
    """Compare grooves of 3 and 6 mm.

    3 mm below a ring of 18 mm are usual, 6 mm are a third of the seat.
    """
    for width, count in ((3.0, 0), (6.0, 1)):
        sections = tables()["shaft"]["sections"]
        first = [{"length": f"{30.0 - width} mm", "diameter": "40 mm"}, {"length": f"{width} mm", "diameter": "38 mm"}]
        found = resolve_machine(tables(shaft={"sections": [*first, *sections[1:]]})).warnings
        assert len(found) == count, found


def test_it_is_said_everywhere(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Report it in `check`, `--json` and the builder.

    No loads are reported before they are known.
    """
    changed = tables(bearings={"left": {"designation": "SKF 6319", "at": "25 mm"}})
    case = tmp_path / "box.toml"
    case.write_text(tables_toml(changed))
    (sentence,) = api.model_warnings(resolve_machine(case))
    assert main(["check", str(case), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["warnings"] == [sentence]
    assert main(["check", str(case)]) == 0
    assert f"WARNING {sentence}" in " ".join(capsys.readouterr().out.split())
    checker = Checker(MachineCase)
    assert checker.check(changed, None).warnings == (sentence,)
    checker.close()


def test_it_is_said_of_a_run(tmp_path: Path) -> None:
    """Keep the sentences in the file of a run."""
    model = replace(resolve_machine(tables()), warnings=("one", "two"))
    found = api.run(model, out=tmp_path / "r.h5")
    assert found.summary().warnings[:2] == ["one", "two"]


def test_laws_are_tried_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Report a failing plugin law once for all bearings.

    `check` does the same for one bearing.
    """
    monkeypatch.setattr(api, "law_problems", lambda model: (Problem("models.traction", "gives no number"),))
    (tmp_path / "box.toml").write_text(shaft_text("geared-shaft", "box"))
    assert main(["check", str(tmp_path / "box.toml")]) == 3
    said = capsys.readouterr().err.splitlines()
    assert said[0].endswith("1 error")
    assert "gives no number" in said[1]


def test_far_beyond_limits() -> None:
    """Name each limit of a 6208 and 6206.

    The meshing force is 106 kN.
    """
    found = api.quasistatic(resolve_machine(tables(gears={"wheel": {"power": "2000 kW"}})))
    for bearing, static in zip(found.bearings.values(), (19.0, 11.2), strict=True):
        told = " ".join(bearing.warnings)
        load = np.hypot(*bearing.force_N[1:])
        assert load > 2e3 * static
        for words in (
            f"is above the static load rating C0 = {static:g} kN",
            "is above C/2 =",
            f"the contact pressure of {bearing.max_pressure_GPa:.3g} GPa is beyond 4.2 GPa, where steel yields",
            "over the inner ring's shoulder",
        ):
            assert words in told, (words, told)
        assert "the case tilts" not in told  # rings are held at their poses to be looked at
    lines = found.text().splitlines()
    assert sum(line.startswith("WARNING ") for line in lines) == sum(len(b.warnings) for b in found.bearings.values())
    assert not any(line.split()[1:] == ["0", "0"] for line in lines if line.startswith("L_10h"))  # short is not nothing


def test_pressure_of_self_aligning_bearings() -> None:
    """Use 4600 MPa for self-aligning bearings.

    ISO 76: all other ball bearings have 4200 MPa.
    """
    assert warnings(4.5e9, [], 0.0, "self-aligning") == []
    assert len(warnings(4.7e9, [], 0.0, "self-aligning")) == 1
    assert len(warnings(4.3e9, [], 0.0)) == 1


def test_tilt_on_a_shaft() -> None:
    """Name no option of a single bearing."""
    (said,) = warnings(1e9, [], 4e-3, on_shaft=True)
    assert said.startswith("the inner ring tilts by 4 mrad: deep-groove ball bearings take up to 2.9 mrad")
    assert "bodies." not in said
