"""Test texts of machines.

Lives in one form, units, assumptions of the circuit, options that stand elsewhere.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.unit_systems import US
from lambda_core.domain.wrapping import HEAD
from lambda_core.export.report.chapters import case_chapter, model_inputs
from lambda_core.model.machine_templates import shaft_text
from lambda_core.results.model_band import Band, ModelBand


def box() -> dict[str, Any]:
    return tomllib.loads(shaft_text("geared-shaft", "box"))


@pytest.fixture(scope="module")
def box_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = tmp_path_factory.mktemp("texts") / "box.toml"
    found.write_text(shaft_text("geared-shaft", "box"))
    return found


def test_hold_and_motion_of_a_bearing_name_its_support() -> None:
    tables = box()
    tables["bearings"]["left"] |= {"hold_x": "locked", "motion_tilt_y": {"start": "0 mrad"}}
    with pytest.raises(api.CaseError) as caught:
        api.check(tables)
    assert 'bearings.left.hold_x   is not an option: write support.x = "locked"' in str(caught.value)
    assert "write support.tilt_y = { motion = ... }" in str(caught.value)


def test_both_ends_of_a_band_have_the_chosen_unit() -> None:
    """Convert the low end, too, which has no unit."""
    found = api.quasistatic(box())
    torque = Band(quantity="friction torque", unit="N mm", value=100.0, low=90.4, high=113.0, contributors=[])
    bands = {name: ModelBand(case="box", coverage=0.9, bands=[torque], left_out=[]) for name in found.bearings}
    text = found.with_bands(bands).text(units=US)
    low, high = re.findall(r"^friction torque .*\(model ([\d.]+) \.\. ([\d.]+)\) +of all", text, re.MULTILINE)[0]
    assert float(high) / float(low) == pytest.approx(113.0 / 90.4, rel=0.05)


def test_lives_are_written_in_one_form() -> None:
    """Write lives in one form everywhere.

    Two digits, groups of three, "above" beyond a million hours: of each bearing and in their sum.
    """
    found = api.quasistatic(box())
    text = found.text()
    life = r"(?:above )?\d{1,3}(?: \d{3})* h"
    assert len(re.findall(rf"L_10rh {life}  L_nmrh {life}$", text, re.MULTILINE)) == 2
    assert re.search(rf"^system life +{life} of all bearings", text, re.MULTILINE)
    assert ">" not in text


def heads(lines: list[str]) -> list[str]:
    """Return the heads of lines in their order."""
    return [line[:HEAD].strip() for line in lines if line[:1].isalpha() and line[HEAD - 1 : HEAD] == " "]


def test_a_bearing_has_one_page_alone_and_in_a_machine(box_file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Print the lines of a bearing alone.

    Its place and loads in the machine are between them.
    """
    assert main(["quasistatic", str(box_file), "--bearing", "left", "--band", "none", "--quiet"]) == 0
    page = capsys.readouterr().out.splitlines()
    alone = api.quasistatic("6208-axial-1300", ["operation.speed=3000 rpm"]).text().splitlines()
    own = ["radial load", "axial load", "force on shaft", "moment about", "clearance", "stiffness"]
    assert [head for head in heads(page) if head not in own] == heads(alone)
    assert [head for head in heads(page) if head in own] == own
    assert len([line for line in page if re.fullmatch(r" +\d .* (?:inner|outer) .*", line)]) == 18
    machine = api.quasistatic(box_file).text().split("\nleft: ")[1].split("\n\nright: ")[0].splitlines()
    rest = [line for line in page if not line.startswith(("left: ", " ", "force on shaft", "assumed"))]
    assert set(rest) <= set(machine)


def test_the_answer_about_one_bearing_has_the_numbers_of_the_machine(box_file: Path) -> None:
    machine, one = api.quasistatic(box_file), api.quasistatic(box_file, bearing="right")
    assert dict(one).items() >= dict(machine.bearing("right")).items()
    assert sorted(one.assumptions) == sorted(api.check(box_file).bearings[1].model.assumptions)
    assert one.of_bearing("right") is one
    assert list(one.bearings) == ["right"]
    stronger = one.with_(gears={"wheel": {"power": "20 kW"}})
    assert stronger.radial_load_N > one.radial_load_N


@pytest.mark.parametrize(("case", "name", "words"), [
    ("", "rigth", '"rigth" is not a known bearing; nearest: right'),
    ("6208-axial-1300", "left", 'this case has one bearing: leave out --bearing "left"'),
])  # fmt: skip
def test_a_wrong_bearing_is_refused_before_anything_is_solved(
    box_file: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    case: str,
    name: str,
    words: str,
) -> None:
    monkeypatch.setattr("lambda_core.solver.drivers.machine_statics.solve_machine", None)
    monkeypatch.setattr("lambda_core.solver.drivers.equilibrium.solve", None)
    assert main(["quasistatic", case or str(box_file), "--bearing", name, "--quiet"]) == 2
    said = capsys.readouterr()
    assert (said.out, said.err.strip()) == ("", words)


def test_damping_is_shown_in_other_units_too() -> None:
    assert US.sentence("with 200 N s/m to the ground") == "with 1.14 lbf s/in to the ground"
    assert US.unit("N m s/rad") == "lbf in s/rad"
    assert US.value(175.1268, "N s/m") == pytest.approx(1.0, rel=1e-6)  # lbf s/in = 175.1268 N s/m


def test_a_circuit_without_a_source_names_the_one_that_it_takes() -> None:
    from lambda_core.analysis.electric.circuit_bearing import CircuitBearing, electric_model
    from lambda_core.analysis.electric.outcome import assumptions
    from lambda_core.case.electric import Electric, Sine

    def told(options: Electric) -> str:
        film = options.film.model_copy(update={"ball_permittivity": 8.0})
        laws, insulated = electric_model(options, "case").laws, options.model_copy(update={"film": film})
        nothing: Any = ()
        return " ".join(assumptions(CircuitBearing("left", "case", insulated, laws, {}, nothing, 1e-7)))

    words = "the case names no source: two-level inverter, dc link 800 V"
    assert words in told(Electric())
    assert words not in told(Electric(sine=Sine.model_validate({"amplitude": "1 V", "frequency": "1 kHz"})))


@pytest.fixture(scope="module")
def motor() -> api.MachineModel:
    """Resolve a ball and a roller bearing on one shaft."""
    model = api.check(tomllib.loads(shaft_text("motor-shaft", "motor")))
    assert isinstance(model, api.MachineModel)
    return model


def test_a_check_names_the_laws_and_values_of_every_bearing(motor: api.MachineModel) -> None:
    report = api.describe(motor)
    told = report.text(everything=True)
    assert re.search(r"of fan\n +normal_contact +hamrock-brewe\n", told)
    assert re.search(r"of belt\n +normal_contact +iso-line ", told)
    assert "normal_contact" not in report.text()
    values = {value.path: value.text for value in report.values}
    assert values["bearings.fan.ball_count"] == "8"
    assert values["bearings.belt.rollers.roller_count"] == "14"
    assert values["lubricant.name"] == "arcanol-multi2"
    assert values["bearings.fan.forces.ball_inner.models.normal_contact"] == "hamrock-brewe"
    assert values["bearings.belt.forces.ball_inner.models.normal_contact"] == "iso-line"
    assert len(values) == len(report.values)


def test_bearings_alike_name_their_laws_once() -> None:
    assert "of left, right\n" in api.describe(api.check(box())).text(everything=True)


def test_a_report_has_the_inputs_of_every_bearing(motor: api.MachineModel) -> None:
    """List values, laws and references of both bearings.

    Those of the first stood for all.
    """
    inputs = model_inputs(motor)
    given = {row[0] for row in inputs.given.rows}
    assert {"bearings.fan.ball_count", "bearings.belt.rollers.roller_count", "lubricant.name"} <= given
    sections = {table.caption for table in inputs.values}
    assert {"bearings.fan", "bearings.belt", "bearings.belt.forces", "lubricant"} <= sections
    users = {(role, law): elements for role, law, elements, *_ in inputs.laws.rows}
    assert users["normal_contact", "iso-line"] == "ball inner (belt), ball outer (belt)"
    assert users["rheology", "roelands"] == "ball inner, ball outer, rib outer (belt)"
    references = {one.law for one in inputs.citation.laws}
    assert {"normal_contact/hamrock-brewe", "normal_contact/iso-line"} <= references


def test_a_report_of_a_case_can_be_about_one_of_its_bearings(
    box_file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Leave the shaft and the other bearing out.

    The refusal named a machine of one bearing.
    """
    assert main(["report", str(box_file), "--bearing", "rigth"]) == 2
    assert '"rigth" is not a known bearing; nearest: right' in capsys.readouterr().err
    chapter = case_chapter(api.check(box()), api.quasistatic(box()), bearing="right")
    assert chapter.title == "6206 (SKF), right of box"
    assert [part.name for part in chapter.bearings] == ["right"]
    assert (chapter.sketch, chapter.overview, chapter.reactions) == ("", (), None)
