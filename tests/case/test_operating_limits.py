"""Test the warnings that precede any solution.

They concern speeds, loads, tilt, oils and surfaces beyond their limits.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.case.case_io import builtin_cases
from lambda_core.domain.errors import SolverError
from lambda_core.model.checks.operating_limits import applied_load, heating_factor, operating_warnings
from lambda_core.results.quasistatic import QuasiStatic
from lambda_core.results.verdict import limits_of

MOTOR = """\
name = "motor"
bearing = { designation = "6308 C3", maker = "SKF" }
lubricant = { name = "FVA3A", temperature = "70 degC" }
loads = { radial = "2.5 kN", axial = "0.5 kN" }
operation = { speed = "6000 rpm" }
"""
TILTED = 'bodies.inner_ring.tilt_y={ mode = "prescribed", motion = "4 mrad" }'


@pytest.fixture
def motor(tmp_path: Path) -> Path:
    path = tmp_path / "motor.toml"
    path.write_text(MOTOR, encoding="utf-8")
    return path


@pytest.mark.parametrize("name", sorted(builtin_cases()))
def test_the_published_cases_are_within_their_limits(name: str) -> None:
    assert operating_warnings(api.check(name)) == []


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        # SKF: C 42.3 kN, C0 24 kN, limiting speed 11 000 1/min
        (["operation.speed=30000 rpm"], "30000 rpm is above the limiting speed of the bearing in the catalogue, 11000"),
        (["loads.radial=0 N", "loads.axial=0 N"], "below the minimum load of ball bearings, 0.01 C = 423 N"),
        (["loads.radial=400 N", "loads.axial=0 N"], "the load P = 402 N is below the minimum load"),
        (["loads.radial=30 kN"], "P0 = 30 kN is above the static load rating C0 = 24 kN"),
        (["loads.radial=22 kN"], "above C/2 = 21.1 kN: ISO 281 gives no life there"),
        ([TILTED], "tilts the rings against each other by 4 mrad: deep-groove ball bearings take up to 2.9 mrad"),
        (["lubricant.temperature=300 degC"], "outside -40 to 200 degC"),
        (["lubricant.temperature=-40 degC"], "heating in the inlet leaves 0.0033 of the film"),
        (["surface.roughness=0.3 mm"], "the roughness sigma = 300 um is above 1 um"),
    ],
)
def test_what_lies_beyond_is_said_by_check(
    motor: Path, changes: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert operating_warnings(api.check(motor)) == []
    options = [part for change in changes for part in ("--set", change)]
    assert main(["check", str(motor), *options, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["warnings"]
    assert any(words in sentence for sentence in found), found
    assert main(["check", str(motor), *options]) == 0
    text = capsys.readouterr().out
    assert words in text
    assert f"no errors, {len(found)} warning" in text


def test_loads_that_motion_decides_are_not_judged(motor: Path) -> None:
    pressed = ["loads.axial=0 N", 'bodies.inner_ring.x={ mode = "prescribed", motion = "20 um" }']
    assert applied_load(api.check(motor, pressed)) is None
    assert operating_warnings(api.check(motor, [*pressed, "loads.radial=30 kN"])) == []


@pytest.mark.parametrize(
    "held",
    [["bearing.clearance=-5 um"], ["bodies.inner_ring.y=locked", "bodies.inner_ring.z=locked"]],
    ids=["preloaded", "locked"],
)
def test_balls_that_preload_presses_need_no_minimum_load(motor: Path, held: list[str]) -> None:
    """Accept preloaded balls without an external load.

    The check took the ring's weight for the load: "P = 1.05 N is below the minimum load".
    """
    unloaded = api.check(motor, ["loads.radial=0 N", "loads.axial=0 N", *held])
    assert operating_warnings(unloaded) == []


def test_the_verdict_asks_a_preloaded_bearing_for_no_minimum_load(motor: Path) -> None:
    unloaded = api.check(motor, ["loads.radial=0 N", "loads.axial=0 N"])
    assert limits_of(unloaded).minimum_load_N == pytest.approx(423.0)
    assert limits_of(api.check(motor, ["bearing.clearance=-5 um"])).minimum_load_N is None


def test_an_impossible_load_is_the_reason_why_no_equilibrium_is_found(motor: Path) -> None:
    """Blame the load, not the support of the ring.

    The message asked whether the ring is held.
    """
    with pytest.raises(SolverError, match=r"P0 = 1e[+]13 N is above the static load rating C0 = 24 kN"):
        api.quasistatic(motor, ["loads.radial=1e13 N"], band=False)


def test_the_heating_factor_is_that_of_the_law_at_epicyclic_rolling(motor: Path) -> None:
    """Compare with Murch and Wilson 1975 by hand.

    3.94/(3.94 + L^0.62), L = eta0 beta u^2/k, with the oil's own viscosity.
    """
    model = api.check(motor, ["models.thermal_correction=murch-wilson"])
    factor = heating_factor(model)
    assert factor is not None
    g = model.geometry
    gamma = g.ball_diameter / g.pitch_diameter
    rolling = 0.25 * g.pitch_diameter * (1.0 - gamma**2) * 6000.0 * math.pi / 30.0
    thermal = (3.94 * (1.0 / factor - 1.0)) ** (1.0 / 0.62)
    product = thermal * model.oil.thermal_conductivity / rolling**2  # eta0 beta
    # FVA3A at 70 degC: 22 to 28 mPa s, and 0.03 to 0.04 1/K
    assert 0.022 * 0.03 < product < 0.028 * 0.04
    assert heating_factor(api.check(motor, ["models.thermal_correction=none"])) is None
    colder = [heating_factor(api.check(motor, [f"lubricant.temperature={t} degC"])) for t in (40, 20, 0, -20)]
    assert colder == sorted(colder, reverse=True)  # type: ignore[type-var]


def test_a_free_tilt_is_an_assumption_where_the_loads_tilt_the_ring(motor: Path) -> None:
    def said(*changes: str) -> list[str]:
        return [a for a in api.check(motor, changes).assumptions if a.startswith("the inner ring is free to tilt")]

    assert "tilt_y and tilt_z" in said()[0]
    assert "(tilt_y)" in said("bodies.inner_ring.tilt_z=locked")[0]
    locked = ("bodies.inner_ring.tilt_y=locked", "bodies.inner_ring.tilt_z=locked")
    assert said(*locked) == []
    assert said("bodies.inner_ring.tilt_y=free", "bodies.inner_ring.tilt_z=free") == []
    assert said("loads.axial=0 N") == []  # radial load alone leaves the rings parallel
    assert said("loads.radial=0 N") == []
    assert said("loads.axial=0 N", "loads.moment_z=1 N m") != []


def test_a_case_begun_for_a_bearing_holds_the_tilt_by_a_line(tmp_path: Path) -> None:
    path = api.init_case("fan", None, tmp_path / "fan.toml", bearing="SKF 6308 C3")
    text = path.read_text(encoding="utf-8")
    assert 'tilt_y = "locked"' in text
    assert 'tilt_z = "locked"' in text
    model = api.check(path, ["loads.axial=0.5 kN"])
    assert {model.inner_ring.dofs[dof].mode for dof in ("tilt_y", "tilt_z")} == {"locked"}
    sprung = api.check(path, ['bodies.inner_ring.tilt_y={ stiffness = "20 N m/mrad" }'])  # as its comment says
    assert sprung.inner_ring.dofs["tilt_y"].stiffness == pytest.approx(2e4)


def test_an_operating_point_of_rollers_warns_of_oil_too_thick() -> None:
    """Warn of rollers as of balls.

    `check` warned; `quasistatic` printed a rolling resistance of 0.0 N mm without a word.
    """
    found = api.quasistatic(
        {
            "name": "cold",
            "bearing": {"designation": "SKF NU 208 ECP"},
            "loads": {"radial": "2 kN"},
            "operation": {"speed": "9000 rpm"},
            "lubricant": {"name": "mineral-vg32", "temperature": "-15 degC"},
        }
    )
    assert isinstance(found, QuasiStatic)
    assert sum("heating in the inlet leaves 0.14 of the film" in warning for warning in found.warnings) == 1
