"""Test roller bearings from the command line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api

CASE = """\
name = "{name}"
[bearing]
designation = "{designation}"
clearance_pick = "middle"
[lubricant]
name = "FVA3"
temperature = "60 degC"
[loads]
radial = "6 kN"
axial = "{axial}"
[operation]
speed = "3000 rpm"
"""


def case(folder: Path, designation: str, axial: str = "0 N", more: str = "") -> str:
    path = folder / "case.toml"
    path.write_text(CASE.format(name="case", designation=designation, axial=axial) + more)
    return str(path)


@pytest.mark.parametrize(
    ("designation", "axial"),
    [
        ("SKF NU 208 ECP", "0 N"),
        ("32216 J2/Q", "3 kN"),
        ("NJ 208", "500 N"),
        ("NA 4905", "0 N"),
        ("NCF 3008 CV", "0 N"),
    ],
)
def test_quasistatic(designation: str, axial: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["quasistatic", case(tmp_path, designation, axial), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["bearings"]["bearing"]
    assert found["friction_torque_Nmm"] == pytest.approx(sum(found["friction_breakdown_Nmm"].values()))
    assert found["loaded_elements"] >= 3
    assert found["rating"]["basic_life_h"] > 0.0
    assert (found["rollers"]["rib_load_N"] > 0.0) == (axial != "0 N")
    assert (found["rollers"]["axial_limit_N"] is not None) == designation.startswith(("NJ", "NCF"))


def test_lives_with_a_iso(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Compare a_ISO with ISO 281:2007, 9.3.3.3.

    0.1 [1 - (1.5859 - 1.2348/kappa^0.071739) (e_C C_u/P)^0.4]^-9.185 for 1 <= kappa <= 4.
    """
    path = case(tmp_path, "NU 208")
    assert main(["quasistatic", path, "--json", "--set", "life.contamination=0.3"]) == 0
    found = json.loads(capsys.readouterr().out)["bearings"]["bearing"]
    film = 1.5859 - 1.2348 / found["rating"]["viscosity_ratio"] ** 0.071739
    expected = 0.1 * (1.0 - film * (0.3 * 6.7e3 / found["rating"]["equivalent_load_N"]) ** 0.4) ** -9.185
    assert found["rating"]["life_factor"] == pytest.approx(expected, rel=1e-6)
    assert found["rating"]["modified_life_h"] == pytest.approx(expected * found["rating"]["basic_life_h"])
    of_laminae = found["rating"]["modified_reference_life_h"] / found["rating"]["reference_life_h"]
    assert 1.0 < of_laminae < found["rating"]["life_factor"]  # edges carry more
    assert main(["quasistatic", path]) == 0
    assert "e_C 0.5: normal cleanliness, the case gives none" in capsys.readouterr().out


def test_a_iso_ends_where_its_formula_does(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Give no a_ISO below kappa = 0.1.

    The standard ends there.
    """
    slow = ["--set", 'operation.speed="5 rpm"', "--set", 'lubricant.temperature="100 degC"']
    assert main(["quasistatic", case(tmp_path, "NU 208"), "--json", *slow]) == 0
    found = json.loads(capsys.readouterr().out)["bearings"]["bearing"]
    assert found["rating"]["viscosity_ratio"] < 0.1
    assert found["rating"]["modified_life_h"] is None
    assert found["rating"]["basic_life_h"] > 0.0


def test_no_tilt_has_no_sign(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["quasistatic", case(tmp_path, "NU 208")]) == 0
    assert "-0.0000" not in capsys.readouterr().out


def test_the_text_names_shares_and_lives(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["quasistatic", case(tmp_path, "32216", "3 kN")]) == 0
    out = capsys.readouterr().out
    for words in ("raceways 9", "ribs", "ISO/TS 16281", "static C0/P0", "rollers loaded"):
        assert words in out


def test_too_much_thrust_is_a_warning_and_not_within_limits(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["quasistatic", case(tmp_path, "NJ 208", "3 kN")]) == 0
    out = capsys.readouterr().out
    assert "above the permissible" in out
    assert "NOT MET: axial load 229 % of 1 308 N" in out
    assert main(["quasistatic", case(tmp_path, "NJ 208", "1 kN"), "--json"]) == 0
    verdict = json.loads(capsys.readouterr().out)["bearings"]["bearing"]["verdict"]
    margins = {margin["name"]: margin for margin in verdict["margins"]}
    assert margins["axial load"]["met"]
    assert margins["axial load"]["limit"] == pytest.approx(1308.0, rel=1e-3)


def test_thrust_alone_has_no_radial_load(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Ignore radial forces of 1e-12 N from rounding.

    They are no load: no life and no static safety follow from them.
    """
    changes = ["--set", 'loads.radial="0 N"', "--set", "gravity.z=0 m/s2"]
    assert main(["quasistatic", case(tmp_path, "NJ 208", "500 N"), "--json", *changes]) == 0
    found = json.loads(capsys.readouterr().out)
    own = found["bearings"]["bearing"]
    assert "radial 0 N, axial 500 N" in found["headline"]
    assert own["rating"]["equivalent_load_N"] == 0.0
    assert own["rating"]["static_safety"] is None


@pytest.mark.parametrize("verb", ["check", "quasistatic"])
def test_a_speed_above_the_limiting_one_is_a_warning(
    verb: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([verb, case(tmp_path, "NU 208"), "--set", 'operation.speed="60000 rpm"']) == 0
    assert "60000 rpm is above the limiting speed of the bearing in the catalogue, 11000 rpm" in capsys.readouterr().out
    assert main([verb, case(tmp_path, "NU 208"), "--set", 'operation.speed="10000 rpm"']) == 0
    assert "limiting" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("designation", "axial", "more", "message"),
    [
        ("NU 208", "1 kN", "", "takes no thrust"),
        ("NU 208-XYZ", "0 N", "", '1 error\n  bearing.designation    "XYZ" is not a known suffix'),
        ("NU 208-XYZ", "0 N", '[bearing.rollers]\nend_play = "9 um"\n', '1 error\n  bearing.designation    "XYZ" is'),
        ("32216", "0 N", "", "needs thrust"),
        ("NU 208", "0 N", "[bearing.rollers]\nroller_count = 40\n", "do not fit"),
        ("NU 208", "0 N", '[bodies.inner_ring]\nx = "20 N/um"\n', "free or locked"),
    ],
)
def test_what_cannot_be(
    designation: str, axial: str, more: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for verb in ("check", "quasistatic"):
        assert main([verb, case(tmp_path, designation, axial, more)]) == 3
        assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("designation", "axial", "more", "message"),
    [
        ("32216", "0 N", "", "needs thrust on the inner ring along x"),
        ("NU 208", "500 N", "", "takes no thrust in this direction"),
        ("NCF 3008", "0 N", "[depth]\ncage = true\n", "a full complement without a cage"),
        ("NCF 3008", "0 N", '[models]\ncage_contact = "roller-pocket"\n', "contradicts depth.cage = false"),
        ("NU 208", "0 N", '[models]\ncage_contact = "roller-roller"\n', "it needs depth.cage = false"),
        ("NU 208", "0 N", "[forces.ball_ball.parameters.cage_contact]\nmu_s = 0.1\n", "needs depth.cage = false"),
        ("NCF 3008", "0 N", '[forces.ball_ball.models]\ncage_contact = "ball-ball"\n', "is a law of balls"),
        ("NCF 3008", "0 N", "[forces.ball_ball.parameters.cage_contact]\nx = 1\n", "forces.ball_ball.parameters"),
        ("NCF 3008", "0 N", "[forces.ball_ball.parameters.supply]\nx = 1\n", "ball_ball has no such role"),
        ("NU 208", "0 N", "[parameters.film_thickness]\nx = 1\n", "parameters.film_thickness"),
        ("NU 208", "0 N", '[models]\nfluid_drag = "skf-catalogue"\n', "is a law of balls"),
        ("NU 208", "0 N", '[models]\ncage_contact = "spherical-pocket"\n', "is a law of balls"),
        ("NU 208", "0 N", "[forces.ball_inner.parameters.damping]\nx = 1\n", "forces.ball_inner.parameters.damping"),
        ("NU 208", "0 N", '[models]\nfilm_thickness = "chittenden"\n', "is a law of balls"),
        ("NU 208", "0 N", "[elastic.outer_ring]\norders = 4\n", "elastic.outer_ring.housing_stiffness"),
    ],
)
def test_motion_says_what_it_does_not_follow(
    designation: str, axial: str, more: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Refuse it in `check`, too."""
    path = case(tmp_path, designation, axial, more)
    for verb in ("check", "run"):
        assert main([verb, path]) == 3
        assert message in capsys.readouterr().err


def test_a_moment_on_a_locked_tilt_is_a_warning(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = case(tmp_path, "NU 208")
    assert main(["quasistatic", path, "--set", "loads.moment_z=5 N m"]) == 0
    assert "tilt_z is locked" in capsys.readouterr().out
    assert main(["quasistatic", path, "--set", "loads.moment_z=5 N m", "--set", "bodies.inner_ring.tilt_z=free"]) == 0
    assert "tilt_z is locked" not in capsys.readouterr().out


def test_a_slip_in_a_designation_names_the_nearest(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["quasistatic", case(tmp_path, "NU 2O8")]) == 3
    assert "NU 208" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("designation", "words"),
    [
        ("NU 208 X", '"X" is not a known suffix of NU 208; known are: EC, ECP'),
        ("NU 208 ECQ", '"ECQ" is not a known suffix of NU 208; nearest: EC, ECP'),
        ("32216 C3", '"C3" is not a known suffix of 32216'),
    ],
)
def test_suffixes_of_another_kind_of_rollers_are_unknown(
    designation: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Refuse X at cylindrical bearings, clearance classes at tapered ones."""
    out = tmp_path / "new.toml"
    assert main(["init", "new", "--bearing", designation, "--out", str(out)]) == 3
    assert words in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.parametrize(
    ("designation", "change", "words"),
    [
        ("NU 208", "bearing.contact_angle=20 deg", "is that of ball bearings; of tapered rollers write"),
        ("NU 208", "bearing.axial_clearance=20 um", "rollers have bearing.rollers.end_play"),
        ("32216", "bearing.clearance=C3", "a tapered roller bearing has none before it is mounted"),
    ],
)
def test_options_that_rollers_do_not_have_are_refused(
    designation: str, change: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Refuse them in all commands.

    They had no effect, and `check` printed the clearance of balls at that angle.
    """
    path = case(tmp_path, designation, "3 kN")
    for verb in ("check", "quasistatic"):
        assert main([verb, path, "--set", change]) == 3
        assert words in capsys.readouterr().err


@pytest.mark.parametrize("option", ["type", "kind"])
def test_a_kind_of_bearing_is_decided_by_its_designation(
    option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Say so; the nearest option by name was bodies.cage.type."""
    assert main(["check", case(tmp_path, "NU 208"), "--set", f"bearing.{option}=cylindrical"]) == 3
    told = capsys.readouterr().err
    assert f"bearing.{option}" in told
    assert 'the designation decides it ("7208B", "NU 208")' in told
    assert "cage" not in told


def test_check_warns_of_thrust_that_leaves_cone_and_cup_apart(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Name the least thrust in the words of the equilibrium."""
    path, sentence = case(tmp_path, "32216", "1 kN"), "a thrust of 1000 N does not hold cone and cup together"
    assert main(["check", path]) == 0
    assert sentence in " ".join(capsys.readouterr().out.split())
    assert main(["quasistatic", path]) == 4
    assert sentence in capsys.readouterr().err
    held = ["--set", 'bodies.inner_ring.x="locked"', "--set", "loads.axial=0 N"]
    assert main(["check", path, *held]) == 0
    assert sentence not in " ".join(capsys.readouterr().out.split())
    assert main(["check", case(tmp_path, "32216", "3 kN")]) == 0
    assert sentence[:12] not in capsys.readouterr().out


def test_rollers_have_the_minimum_load_of_rollers(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Compare with SKF: 0.02 C, P = F_r.

    The words were those of balls, 0.01 C.
    """
    path = case(tmp_path, "NU 208")
    for radial, expected in (("1 kN", True), ("1.3 kN", False)):
        assert main(["check", path, "--set", f"loads.radial={radial}", "--json"]) == 0
        (told,) = json.loads(capsys.readouterr().out)["warnings"] or ("",)
        assert ("below the minimum load of roller bearings, 0.02 C = 1.24 kN: rollers may skid" in told) == expected
        assert "ball" not in told


def test_shafts_take_rollers(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "shaft.toml"
    path.write_text(
        """\
name = "rollers"
operation = { speed = "3000 rpm" }
lubricant = { name = "FVA3", temperature = "70 degC" }
shaft = { sections = [{ length = "170 mm", diameter = "40 mm" }] }
bearings = { left = { designation = "SKF 6208", at = "21 mm" }, right = { designation = "NU 208", at = "148 mm" } }
""",
        encoding="utf-8",
    )
    assert main(["compare", str(path), "--bearing", "right"]) == 0
    assert "rib [N mm]" in capsys.readouterr().out
    path.write_text(path.read_text(encoding="utf-8").replace('"NU 208"', '"NCF 3008", takes = "+x"'), encoding="utf-8")
    assert main(["check", str(path)]) == 0
    assert "neighbouring rollers touch; they leave 3.51 mm" in " ".join(capsys.readouterr().out.split())


def test_own_rollers(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "own.toml"
    path.write_text(
        """\
name = "own"
[bearing.geometry]
bore_diameter = "40 mm"
outside_diameter = "80 mm"
width = "18 mm"
[bearing.rollers]
kind = "N"
roller_count = 14
roller_diameter = "11 mm"
effective_length = "9.6 mm"
pitch_diameter = "60.5 mm"
rib_height = "2 mm"
profile = "logarithmic"
profile_scale = 4e-4
profile_length = "10 mm"
[bearing]
clearance = "20 um"
[lubricant]
name = "FVA3"
temperature = "60 degC"
[loads]
radial = "4 kN"
[operation]
speed = "1500 rpm"
"""
    )
    assert main(["quasistatic", str(path), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert any("ISO 76" in sentence for sentence in found["assumptions"])


def test_methods_stand_side_by_side(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", case(tmp_path, "32216", "3 kN"), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    totals = {
        method["name"]: number["value"]
        for method in found["methods"]
        for number in method["numbers"]
        if (number["group"], number["name"]) == ("friction", "total")
    }
    assert set(totals) == {"quasi-static", "skf", "schaeffler", "houpert"}
    assert all(value > 0.0 for value in totals.values())


@pytest.mark.parametrize("bearing", ["SKF 32216", "NU 208 ECP/C3", "NCF 3008", "Timken LM12749"])
def test_a_case_starts_from_the_catalogue(
    bearing: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["init", "start", "--bearing", bearing]) == 0
    assert main(["check", "start.toml"]) == 0
    assert "32 slices" in capsys.readouterr().out
    assert main(["quasistatic", "start.toml"]) == 0
    capsys.readouterr()
    assert main(["check", "start.toml", "--json"]) == 0
    assert "bearing.rollers.roller_count" in {v["path"] for v in json.loads(capsys.readouterr().out)["values"]}
    assert main(["init", "other", "--bearing", bearing, "--template", "pump"]) == 2


def test_raceways_pockets_and_drag_of_rollers_have_their_own_numbers(tmp_path: Path) -> None:
    """Read numbers of single elements; they count in motion."""
    changes = (
        "parameters.elastic_hysteresis.loss_factor=0.02",
        "forces.ball_outer.parameters.elastic_hysteresis.loss_factor=0.04",
        "parameters.cage_contact.film_width=0.1",
        "forces.ball_cage.parameters.cage_contact.mu_s=0.1",
        "parameters.fluid_drag.k_l=0.5",
        "parameters.supply.k_z=7",
    )
    laws = api.check(case(tmp_path, "NU 208"), changes).laws
    found = [laws[raceway]["elastic_hysteresis"].parameters.loss_factor for raceway in ("ball_inner", "ball_outer")]
    pocket = laws["ball_cage"]["cage_contact"].parameters
    assert found == [0.02, 0.04]
    assert (pocket.film_width, pocket.mu_s) == (0.1, 0.1)
    assert laws["fluid_drag"]["fluid_drag"].parameters.k_l == 0.5
    assert laws["ball_inner"]["supply"].parameters.k_z == 7.0


@pytest.mark.parametrize(
    ("change", "where"),
    [
        ("forces.ball_outer.parameters.elastic_hysteresis.los_factor=1", "elastic_hysteresis.los_factor"),
        ("forces.ball_outer.models.film_thickness=hamrock-dowson", "forces.ball_outer.models.film_thickness"),
        ("forces.ball_cage.parameters.traction.tau_eyring=1", "forces.ball_cage.parameters.traction"),
        ("parameters.fluid_drag.volume=1", "parameters.fluid_drag.volume"),
    ],
)
def test_check_finds_mistakes_in_laws_of_rollers(
    change: str, where: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", case(tmp_path, "NU 208"), "--set", change]) == 3
    assert where in capsys.readouterr().err


@pytest.mark.parametrize("verb", ["check", "quasistatic"])
@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("models.rolling_resistance=matsuyama", "is a law of balls: choose one of rollers"),
        ("models.rolling_resistance=nonsense", "is not a rolling_resistance model"),
        ("models.traction=nonsense", "is not a traction model"),
        ("parameters.nonsense.x=1", "is not a known role"),
        ("parameters.cage_contact.nonsense=1", "nonsense"),
    ],
)
def test_unknown_laws_of_rollers_are_refused(
    verb: str, change: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([verb, case(tmp_path, "NU 208"), "--set", change]) == 3
    told = capsys.readouterr().err
    assert message in told
    assert change.partition("=")[0].removesuffix(".x") in told


def test_a_run_rates_rollers_as_rollers(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Compare lives with the quasi-static answer.

    It leaves out the ring's weight; the summary has no value that only balls have.
    """
    monkeypatch.chdir(tmp_path)
    path = case(tmp_path, "SKF NU 208 ECP")
    assert main(["quasistatic", path, "--json"]) == 0
    alone = json.loads(capsys.readouterr().out)["bearings"]["bearing"]["rating"]
    main(["run", path, "--set", "solver.duration=2 ms"])
    capsys.readouterr()
    assert main(["show", "case.h5", "--json"]) in (0, 5)
    bearing = next(iter(json.loads(capsys.readouterr().out)["bearings"].values()))
    for name in ("basic_life_h", "reference_life_h", "static_safety", "viscosity_ratio", "equivalent_load_N"):
        assert bearing["rating"][name] == pytest.approx(alone[name], rel=0.05), name
    modified = "modified_reference_life_h"
    assert bearing["rating"][modified] == pytest.approx(alone[modified], rel=0.1)
    assert bearing["verdict"]["met"]
    assert bearing["shoulders"] == []
    assert min(bearing["contact_capacitance_pF"]) > 0.0
    life = bearing["rating"]["reference_life_h"]
    assert bearing["reference_life_h_band"] == pytest.approx([life, life])  # the clearance is known
    limits = {margin["name"]: margin["limit"] for margin in bearing["verdict"]["margins"]}
    assert (limits["p"], limits["tilt"]) == (4.0, 1.2)
    main(["show", "case.h5"])
    shown = capsys.readouterr().out
    assert "ISO 281" in shown
    assert "shoulders" not in shown
    assert "capacitance" in shown
    assert "32 slices" in shown
    asked = ["compare", path, "--set", "solver.duration=2 ms", "--result", "case.h5", "--json"]
    assert main(asked) == 0
    methods = {one["name"]: one["numbers"] for one in json.loads(capsys.readouterr().out)["methods"]}
    drag = {
        name: number["value"]
        for name, numbers in methods.items()
        for number in numbers
        if (number["group"], number["name"]) == ("friction", "drag")
    }
    assert drag["simulation"] == pytest.approx(drag["quasi-static"], rel=0.1)
    asked = ["compare", path, "--set", "loads.radial=1 kN", "--result", "case.h5"]
    assert main(asked) == 2
    assert "is of another case" in capsys.readouterr().err


def test_the_speed_of_the_outer_ring_counts_without_motion(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Count the speed of a turning outer ring.

    It was left out silently, so that such a bearing had no friction.
    """
    path, torque = case(tmp_path, "NU 208"), []
    for inner, outer in (("0 rpm", "3000 rpm"), ("3000 rpm", "3000 rpm"), ("1500 rpm", "-1500 rpm")):
        speeds = ("--set", f"operation.speed={inner}", "--set", f"bodies.outer_ring.spin.motion={outer}")
        assert main(["quasistatic", path, "--json", *speeds]) == 0
        torque.append(json.loads(capsys.readouterr().out)["bearings"]["bearing"]["friction_torque_Nmm"])
    assert torque[0] > 50.0
    assert torque[1] is None
    assert torque[2] == pytest.approx(torque[0], rel=0.2)


def test_the_weight_of_a_given_mass_loads_the_rollers(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Load the rollers with the weight of a mass.

    A shaft of a tonne changed nothing; the weight acts downwards. That of a ring whose mass is estimated was left out,
    but not in motion.
    """
    path, found = case(tmp_path, "NU 208"), []
    for changes in (
        ("bodies.inner_ring.mass=1 kg", "bodies.inner_ring.shaft_mass=199 kg", "gravity.z=-10 m/s2"),
        ("gravity.z=0 m/s2", "loads.radial=8 kN"),
        ("gravity.z=0 m/s2",),
        ("gravity.z=-10 m/s2",),
    ):
        assert main(["quasistatic", path, "--json", *(part for one in changes for part in ("--set", one))]) == 0
        found.append(json.loads(capsys.readouterr().out)["bearings"]["bearing"])
    assert found[0]["max_load_N"] == pytest.approx(found[1]["max_load_N"], rel=1e-9)
    weight = api.check(path).inner_ring.mass * 10.0
    assert found[3]["rating"]["equivalent_load_N"] - found[2]["rating"]["equivalent_load_N"] == pytest.approx(weight)


def test_a_large_clearance_of_rollers_is_no_matter_of_grooves(tmp_path: Path) -> None:
    """Accept clearances that no groove of balls allows.

    The balls that prepare a run of rollers refused it by the contact angle of their grooves.
    """
    model = api.check(case(tmp_path, "SKF NCF 3008 CV"), ["bearing.clearance=0.5 mm"])
    assert model.bearing_models[""].geometry.clearance == pytest.approx(0.5e-3)


def test_a_load_that_no_ring_holds_has_no_equilibrium(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Say so as for balls.

    It was the answer of an outer ring at rest.
    """
    path, free = case(tmp_path, "NJ 208"), ["--set", "bodies.outer_ring.z=free"]
    assert main(["quasistatic", path, *free]) == 4
    assert "lock bodies.outer_ring.z" in capsys.readouterr().err
    assert main(["run", path, *free, "--out", str(tmp_path / "loose.h5")]) == 4  # the rings fell together
    assert "lock bodies.outer_ring.z" in capsys.readouterr().err
    assert main(["quasistatic", path, *free, "--set", "bodies.inner_ring.z=locked", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["bearings"]["bearing"]["max_load_N"] < 10.0  # of the centrifugal force


def test_a_cup_that_tilts_is_a_cone_that_tilts(tmp_path: Path) -> None:
    """Let the outer ring follow.

    It was held whatever the case said.
    """
    path = case(tmp_path, "32216", "6 kN")
    cup, cone = (api.quasistatic(path, [f"bodies.{ring}.tilt_y=free"]) for ring in ("outer_ring", "inner_ring"))
    straight = api.quasistatic(path)
    assert abs(cup.rollers.inner_ring_moment_Nm[0]) < 1e-3 * abs(straight.rollers.inner_ring_moment_Nm[0])
    assert cup.max_load_N == pytest.approx(cone.max_load_N, rel=1e-6)
    assert cup.inner_ring_tilt_mrad == pytest.approx(cone.inner_ring_tilt_mrad, rel=1e-6)


@pytest.mark.parametrize("held", ["free", "locked"])
def test_an_elastic_support_of_the_outer_ring_gives_way(held: str, tmp_path: Path) -> None:
    """Compare a soft support with a rigid one.

    It counted in motion only. A held inner ring carries what the spring does.
    """
    path, weightless = case(tmp_path, "NU 208"), "gravity.z=0 m/s2"
    rigid = api.quasistatic(path, [weightless])
    options = [weightless, "bodies.outer_ring.z=20 N/um", f"bodies.inner_ring.z={held}"]
    options += ["loads.outer_ring.force_z=500 N"]
    if held == "free":
        soft = api.quasistatic(path, options)
        moved = soft.inner_ring_displacement_um[2] - rigid.inner_ring_displacement_um[2]
        assert moved == pytest.approx(-(6000.0 - 500.0) / 20.0, rel=1e-6)
        assert soft.max_load_N == pytest.approx(rigid.max_load_N, rel=1e-9)
        return
    soft = api.quasistatic(path, [*options, "loads.outer_ring.force_z=6 kN"])
    assert soft.inner_ring_displacement_um[2] == pytest.approx(0.0, abs=1e-6)
    there = 6000.0 - 20.0 * rigid.inner_ring_displacement_um[2]  # the spring and the rollers together
    soft = api.quasistatic(path, [*options, f"loads.outer_ring.force_z={there!r} N"])
    assert soft.max_load_N == pytest.approx(rigid.max_load_N, rel=1e-6)
