"""Test help, exit codes, init, check and schema."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from lambda_cli import commands, main

from lambda_core import api
from lambda_core.case.builtin import builtin_cases
from lambda_core.case.case_io import bearing_case
from lambda_core.domain.errors import PartialResultError, SolverError
from lambda_core.domain.units import parse
from lambda_core.model.checks.operating_limits import operating_warnings
from lambda_core.model.machine_templates import MACHINES

HEAVY = ("numba", "h5py", "sqlalchemy", "matplotlib", "scipy", "textual", "xarray")
Call = Callable[..., tuple[int, str, str]]


@pytest.fixture
def call(capsys: pytest.CaptureFixture[str]) -> Call:
    """Run the program in this process.

    Return exit code, stdout, stderr.
    """

    def run(*arguments: str) -> tuple[int, str, str]:
        code = main.main(list(arguments))
        out, err = capsys.readouterr()
        return code, out, err

    return run


def test_help_names_every_command_and_loads_nothing_heavy() -> None:
    code = "import sys; from lambda_cli.main import main; main(['--help'])\n"
    code += f"print([m for m in {HEAVY} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
    for name in commands.entries():
        assert name in done.stdout


def test_every_listed_command_loads_and_has_help(call: Call) -> None:
    for name in commands.entries():
        code, out, _ = call(name, "--help")
        assert code == 0, name
        assert "Usage" in out
        assert "<bool>" not in out, name  # a switch takes no value


def loaded() -> Iterator[Any]:
    """Yield every command and subcommand as the program loads it."""
    waiting = [main._command(entry) for entry in commands.entries().values()]
    while waiting:
        command = waiting.pop()
        waiting += getattr(command, "commands", {}).values()
        yield command


def test_help_is_broken_into_lines_by_the_terminal_and_loses_no_word() -> None:
    """Keep brackets and switches in wrapped help texts.

    Markup would swallow brackets, and a switch must not seem to take a value.
    """
    for command in loaded():
        texts = [command.help, *(getattr(parameter, "help", None) or "" for parameter in command.params)]
        for text in texts:
            assert not re.search(r"\[[a-z/]", text), text
        assert not re.search(r"[^\n]\n[^\n]", command.help), command.name
        for parameter in command.params:
            if getattr(parameter, "is_flag", False):
                assert parameter.metavar == "", (command.name, parameter.name)


def test_a_case_and_a_study_are_told_apart(call: Call, tmp_path: Path) -> None:
    root = Path(__file__).parents[2]
    study = root / "lambda_core" / "studies" / "examples" / "friction-map.toml"
    code, _, err = call("check", str(study))
    assert code == 3
    assert err.splitlines()[1:] == ["  is a study, not a case: lambda-bearing study run friction-map.toml"]
    case = tmp_path / "fan.toml"
    assert call("init", "fan", "--out", str(case))[0] == 0
    code, _, err = call("study", "run", str(case))
    assert code == 3
    assert 'is a case, not a study; a study names it: case = "fan.toml"' in err


def test_the_ending_of_a_file_left_out_is_said(call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert call("init", "fan")[0] == 0
    code, _, err = call("check", "fan")
    assert code == 2
    assert err.strip() == '"fan" is neither a file nor a built-in case; the file is fan.toml'


def test_the_name_of_a_file_is_taken_as_that_of_its_case(
    call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert call("init", "pump.toml", "--bearing", "SKF 6208")[0] == 0
    assert [file.name for file in tmp_path.iterdir()] == ["pump.toml"]
    assert bearing_case(tmp_path / "pump.toml").name == "pump"


def test_version(call: Call) -> None:
    code, out, _ = call("--version")
    assert (code, out.split()[0]) == (0, "lambda-bearing")


def test_check_says_what_a_case_is(call: Call) -> None:
    code, out, err = call("check", "6319-cp10-1500")
    assert (code, err) == (0, "")
    first, _, second, *_ = out.splitlines()
    assert first.startswith("6319-cp10-1500: no errors, ")
    assert second.startswith("6319 (Syla2026)  9 x 30.000 mm  pitch 147.5 mm  clearance 24 um (middle of CN, assumed)")
    assert "radial 16 kN   inner ring 1500 rpm   strips 1x31   cage on" in out
    assert "clearance 24 um: middle of CN (12 to 36 um)" in out
    assert len(out.splitlines()) < 25
    assert "load and life: " in out
    assert "numerical)" not in out
    everything = call("check", "6319-cp10-1500", "--all")[1]
    assert "traction             ree-eyring" in everything
    assert "numerical)" in everything


@pytest.mark.parametrize("name", sorted(builtin_cases()))
def test_check_accepts_every_builtin_case_and_prints_json(call: Call, name: str) -> None:
    code, out, err = call("check", name, "--json")
    report = json.loads(out)
    assert (code, err) == (0, "")
    assert (report["valid"], report["version"], report["name"]) == (True, 1, name)
    assert report["assumptions"]


def test_check_lists_all_mistakes_and_exits_3(call: Call, tmp_path: Path) -> None:
    path = tmp_path / "my.toml"
    text = '[bearing]\ndesignation = "6391"\n[loads]\nradial = "16,5 kN"\n[models]\ntraction = "ree-eyrng"\n'
    path.write_text(
        'name = "my"\n' + text + '[lubricant]\nname = "FVA3"\ntemperature = "60 degC"\n[operation]\nspeed = "9 rpm"\n'
    )
    code, out, err = call("check", str(path))
    assert (code, out) == (3, "")
    lines = err.splitlines()
    assert lines[0] == "my.toml: 3 errors"
    assert lines[1] == '  loads.radial           "16,5 kN": write a decimal point: "16.5 kN"'
    assert lines[2].startswith('  bearing.designation    "6391" is not a known bearing; nearest:')
    assert lines[3].startswith(
        '  models.traction        "ree-eyrng" is not a traction model; nearest: ree-eyring; available:'
    )
    code, out, _ = call("check", str(path), "--json")
    assert code == 3
    found = json.loads(out)
    assert found["valid"] is False
    assert [e["where"] for e in found["errors"]] == ["loads.radial", "bearing.designation", "models.traction"]


def test_set_changes_the_case(call: Call) -> None:
    code, out, _ = call("check", "6319-cp10-1500", "--set", "loads.radial=20 kN", "--set", "depth.cage=false")
    assert code == 0
    assert "radial 20 kN   inner ring 1500 rpm   strips 1x31   cage off" in out


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        ((), 2, ""),
        (("chek",), 2, "No such command 'chek'. Did you mean 'check'"),
        (("check",), 2, "Missing argument"),
        (("check", "6319-cp10-150"), 2, "nearest built-in cases: 6319-cp10-1500"),
        (("check", "6319-cp10-1500", "--set", "loads.radial"), 2, "write path=value"),
        (("check", "6319-cp10-1500", "--st", "a=b"), 2, "No such option"),
        (("check", "6319-cp10-1500", "--set", "loads.radial=20"), 3, 'write "20 N"'),
        (("check", "6319-cp10-1500", "--set", "loads.raidal=20 N"), 3, "nearest: radial"),
        (("--no-plugin", "nothing", "check", "6319-cp10-1500"), 2, "nothing"),
        (("init", "a b"), 3, "letters, digits"),
        (("init", "x", "--from", "nowhere"), 2, "neither a file nor a built-in case"),
        (("init", "x", "--bearing", "62099"), 3, "nearest: 6209"),
        (("init", "x", "--bearing", "6208"), 3, "several makers; choose one: KOYO, NSK, SKF"),
        (("init", "x", "--bearing", "XX 6208"), 3, '"XX" is not a maker of 6208'),
        (("init", "x", "--bearing", "SKF 6208", "--from", "6319-cp10-1500"), 2, "not from both"),
        (("init", "x", "--template", "pump", "--from", "6319-cp10-1500"), 2, "from a template, not from both"),
        (("init", "x", "--template", "pmp"), 2, '"pmp" is not a known template; nearest: pump'),
        (("check", "6319-cp10-1500", "--set", "bearing.designation=6391"), 3, 'bearing.designation    "6391" is not'),
        (("check", "6319-cp10-1500", "--set", "bearing.maker=XX"), 3, 'bearing.maker          "XX" is not a maker'),
    ],
)
def test_mistakes_on_the_command_line(
    call: Call, arguments: tuple[str, ...], code: int, said: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    found, out, err = call(*arguments)
    assert found == code
    assert said in err
    assert "Traceback" not in out + err
    assert list(tmp_path.iterdir()) == []


def test_init_writes_a_commented_case_that_checks(call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    code, out, err = call("init", "drive-end", "--from", "6208-axial-1300")
    assert (code, out) == (0, "")
    assert "lambda-bearing check drive-end.toml" in err
    text = (tmp_path / "drive-end.toml").read_text()
    assert text.count("#") >= 5
    assert bearing_case(tmp_path / "drive-end.toml").name == "drive-end"
    assert call("check", "drive-end.toml")[0] == 0
    code, _, err = call("init", "drive-end")
    assert (code, "exists" in err) == (2, True)
    assert call("init", "drive-end", "--force")[0] == 0
    assert call("init", "other", "--out", "sub/x.toml")[0] == 2


@pytest.mark.parametrize("machine", sorted(MACHINES))
def test_init_starts_from_a_machine(call: Call, machine: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Check every template without errors and warnings.

    It has a bearing from the catalogue or a user's own.
    """
    monkeypatch.chdir(tmp_path)
    assert call("init", "one", "--template", machine)[0] == 0
    model = api.check("one.toml")
    assert operating_warnings(model) == []
    assert model.geometry.clearance > 0.0
    assert call("init", "two", "--template", machine, "--bearing", "SKF 6206-2Z/C4")[0] == 0
    text = Path("two.toml").read_text()
    assert 'designation = "6206-2Z/C4"' in text
    assert '# clearance = "C4"' in text
    assert "of C = " in text
    api.check("two.toml")


@pytest.mark.parametrize("bearing", ["SKF 6208", "6208 skf"])
def test_init_starts_from_a_bearing_of_the_catalogue(
    call: Call, bearing: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert call("init", "drive-end", "--bearing", bearing)[0] == 0
    text = (tmp_path / "drive-end.toml").read_text()
    assert text.count("#") >= 5
    assert 'radial = "3.25 kN"        # a tenth of C = 32.5 kN' in text
    code, out, _ = call("check", "drive-end.toml")
    assert code == 0
    assert out.splitlines()[2].startswith("6208 (SKF)")


def test_init_takes_load_speed_and_oil_on_its_line(call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    given = ("--radial", "3 kN", "--axial", "400 N", "--speed", "2900 rpm", "--oil", "FVA3A")
    given += ("--temperature", "75 degC")
    assert call("init", "fan", "--bearing", "SKF 6208", *given)[0] == 0
    model = api.check("fan.toml")
    assert isinstance(model, api.BearingModel)
    assert model.oil.name == "FVA3A"
    assert 'temperature = "75 degC"' in Path("fan.toml").read_text(encoding="utf-8")
    assert "radial 3 kN   axial 400 N   inner ring 2900 rpm" in call("check", "fan.toml")[1]
    assert "# inner ring; the outer ring stands still" in Path("fan.toml").read_text(encoding="utf-8")
    code, _, err = call("init", "box", "--template", "geared-shaft", "--speed", "10 rpm")
    assert code == 2
    assert "add --bearing" in err


@pytest.mark.parametrize("bearing", ["SKF 6208", "SKF NU 208 ECP"])
def test_init_refuses_an_oil_that_is_unknown(
    bearing: str, call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    code, _, err = call("init", "fan", "--bearing", bearing, "--oil", "FVA33")
    assert code == 3
    assert '"FVA33" is not a known lubricant; nearest: FVA3' in err
    assert not Path("fan.toml").exists()


@pytest.mark.parametrize("bearing", ["SKF 7208 BEP", "SKF 32208"])
def test_the_axial_load_of_a_new_case_follows_from_a_given_radial_one(
    bearing: str, call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Derive the axial load from the given radial load.

    It was derived from a tenth of C, and the comment called the given load a tenth of C.
    """
    monkeypatch.chdir(tmp_path)
    assert call("init", "usual", "--bearing", bearing)[0] == 0
    assert call("init", "light", "--bearing", bearing, "--radial", "500 N")[0] == 0
    text = Path("light.toml").read_text(encoding="utf-8")
    assert "a tenth of C" not in text
    files = [tomllib.loads(Path(f"{name}.toml").read_text(encoding="utf-8")) for name in ("usual", "light")]
    axial, radial = ([parse(file["loads"][name], "force") for file in files] for name in ("axial", "radial"))
    assert radial[1] == pytest.approx(500.0)
    ratios = [one / other for one, other in zip(axial, radial, strict=True)]
    assert ratios[0] == pytest.approx(ratios[1], rel=0.02)


@pytest.mark.parametrize("name", ["../x.toml", "a/b.toml", "a\\b"])
def test_a_path_as_the_name_of_a_case_is_told_the_option(
    name: str, call: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    code, _, err = call("init", name)
    assert code == 2
    assert f'"{name}" is a path: give a name alone, and the file with --out "{name}"' in err
    assert not list(tmp_path.iterdir())


def test_a_load_that_points_up_is_said_to(call: Call) -> None:
    assert "radial 3 kN upwards" in call("check", "6319-cp10-1500", "--set", "loads.radial=-3 kN")[1]
    assert "radial 3 kN  " in call("check", "6319-cp10-1500", "--set", "loads.radial=3 kN")[1]


def test_schema_describes_case_files(call: Call, tmp_path: Path) -> None:
    code, out, _ = call("schema")
    schema = json.loads(out)
    assert code == 0
    single, several = (schema["$defs"][kind["$ref"].rpartition("/")[2]] for kind in (schema["then"], schema["else"]))
    assert single["properties"].keys() >= {"bearing", "loads", "operation", "bodies", "models", "solver"}
    assert several["properties"].keys() >= {"bearings", "loads", "operation", "bodies", "models", "solver", "gears"}
    assert not single["additionalProperties"]
    assert not several["additionalProperties"]
    target = tmp_path / "case.schema.json"
    assert call("schema", "--out", str(target))[:2] == (0, "")
    assert json.loads(target.read_text()) == schema
    assert call("schema", "--out", str(tmp_path / "no" / "x.json"))[0] == 2


@pytest.mark.parametrize(
    ("error", "code", "said"),
    [
        (SolverError("the step went to zero"), 4, "the step went to zero"),
        (PartialResultError("stopped early"), 5, "stopped early"),
        (KeyboardInterrupt(), 130, "interrupted"),
        (ZeroDivisionError("one by\nzero"), 1, "lambda-bearing has a bug: ZeroDivisionError: one by zero"),
    ],
)
def test_one_error_handler(
    call: Call, monkeypatch: pytest.MonkeyPatch, error: BaseException, code: int, said: str
) -> None:
    def fail(*_: Any, **__: Any) -> None:
        raise error

    monkeypatch.setattr("lambda_core.api.check", fail)
    found, out, err = call("check", "6319-cp10-1500")
    assert (found, out) == (code, "")
    assert said in err
    assert "Traceback" not in err


def test_a_bug_shows_its_place_on_request(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any, **__: Any) -> None:
        raise ZeroDivisionError("oops")

    monkeypatch.setattr("lambda_core.api.check", fail)
    monkeypatch.setenv("LAMBDA_BEARING_DEBUG", "1")
    code, _, err = call("check", "6319-cp10-1500")
    assert code == 1
    assert "Traceback" in err


def test_a_closed_pipe_is_no_error() -> None:
    command = f"{sys.executable} -m lambda_cli check 6319-cp10-1500 | head -1; echo ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "0"
    assert done.stderr == ""


def test_a_missing_module_is_not_listed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(commands.COMMANDS, "ghost", ("lambda_cli.ghost:ghost", "Not there."))
    assert "ghost" not in commands.entries()
    assert {"init", "check", "schema"} <= set(commands.entries())
