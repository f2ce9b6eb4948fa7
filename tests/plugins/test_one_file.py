"""Test laws without a package.

From one file, from a folder, from a program that hands them over.
"""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from warm import PROGRAM, Warm

from lambda_core import api
from lambda_core.discovery import local_files, manager
from lambda_core.domain import inline_laws
from lambda_core.domain.installed import ON_VARIABLE
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.plugins import OK, law

LAW = """from math import exp
from lambda_core.plugins import OK, law

@law("traction", "short", role_api=3, reference="own work")
def traction(slip, p, T, ln_eta, h, par, tau):
    for i in range(slip.size):
        newtonian = exp(min(ln_eta[i], 40.0)) * slip[i] / h[i]
        tau[i] = newtonian * 0.07 * p[i] / (newtonian + 0.07 * p[i] + 1e-300)
    return OK
"""
CHOICE = ["models.traction=short"]


@law("traction", "handed", role_api=3, reference="own work")
def by_hand(slip: Any, p: Any, T: Any, ln_eta: Any, h: float, par: Any, tau: Any) -> int:
    for i in range(slip.size):
        tau[i] = 0.05 * p[i] if slip[i] > 0.0 else 0.0
    return OK


@pytest.fixture(autouse=True)
def untouched(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    """Leave the process as it was.

    No file named, no law passed.
    """
    monkeypatch.setenv(ON_VARIABLE, "")
    monkeypatch.setenv(manager.OFF_VARIABLE, "")
    monkeypatch.setattr(local_files, "user_folder", lambda: tmp_path / "config" / "plugins")
    monkeypatch.setattr(local_files, "_texts", {})
    monkeypatch.setattr(inline_laws, "_laws", {})
    manager.registry.cache_clear()
    yield
    monkeypatch.undo()
    manager.registry.cache_clear()


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "short.py"
    path.write_text(LAW)
    return path


def traction(case: Any, changes: list[str] = CHOICE) -> Any:
    return api.check(case, changes).laws["ball_inner"]["traction"].model


def test_a_minimal_law_is_at_most_10_lines() -> None:
    assert len(LAW.splitlines()) <= 10


def test_a_file_is_used_once_it_is_named(file: Path) -> None:
    with pytest.raises(api.CaseError, match='"short" is not a traction model'):
        api.check("6319-cp10-1500", CHOICE)
    api.use_plugin(file)
    found = traction("6319-cp10-1500")
    assert found.distribution == f"short.py {inline_laws.digest_of(LAW.encode())}"
    assert 'traction = "short.py:short"' in api.check("6319-cp10-1500", CHOICE).case_toml


def test_a_default_is_published_only_where_a_source_is_named(tmp_path: Path) -> None:
    text = """from lambda_core.plugins import OK, Parameters, law, parameter
class Mine(Parameters):
    guess: float = parameter(0.07, "a guess")
    known: float = parameter(0.05, "a finding", source="Bair 2019, eq. 7.3")
"""
    file = tmp_path / "graded.py"
    file.write_text(text + LAW.split("\n\n")[1].replace('"short",', '"graded", Mine,').replace("exp(", "1.0 * ("))
    api.use_plugin(file)
    said = api.check("6319-cp10-1500", ["models.traction=graded"]).assumptions
    assert any("guess 0.07, default (a guess; assumed)" in line for line in said)
    assert any("known 0.05, default (Bair 2019, eq. 7.3; published)" in line for line in said)


def test_an_edited_file_is_another_text(file: Path) -> None:
    api.use_plugin(file)
    before = traction("6319-cp10-1500").distribution
    file.write_text(LAW.replace("0.07", "0.08"))
    assert traction("6319-cp10-1500").distribution == before  # one process runs one text
    api.use_plugin(file)
    assert traction("6319-cp10-1500").distribution != before


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("def law(", r"bad.py \w+ \(.*bad.py\): cannot be imported: SyntaxError.*line 1"),
        ("import helpers_beside_it", "cannot be imported: ModuleNotFoundError: No module named 'helpers_beside_it'"),
        ("x = 1\n", "has no law and implements no hook"),
        (LAW.replace(", role_api=3", ""), r"does not say for which version of the roles it is written: write role_api"),
    ],
)
def test_a_file_that_cannot_be_used_says_why(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "bad.py"
    path.write_text(text)
    (tmp_path / "helpers_beside_it.py").write_text("")
    with pytest.raises(PluginError, match=words):
        api.use_plugin(path)


def test_only_what_is_named_is_read(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(file.parent)
    monkeypatch.setenv(ON_VARIABLE, os.pathsep.join([".", "short.py"]))
    manager.registry.cache_clear()
    found = manager.registry()
    assert [fault.message for fault in found.faults] == [
        f"{ON_VARIABLE} names files and folders by their whole path"
    ] * 2
    assert "short" not in found.names("traction")
    monkeypatch.setenv(ON_VARIABLE, str(file.parent))
    manager.registry.cache_clear()
    assert traction("6319-cp10-1500").name == "short"


def test_files_of_the_users_folder_are_in_use(file: Path, tmp_path: Path) -> None:
    folder = tmp_path / "config" / "plugins"
    folder.mkdir(parents=True)
    file.rename(folder / "short.py")
    manager.registry.cache_clear()
    assert traction("6319-cp10-1500").name == "short"


def test_a_law_is_handed_over_as_the_function_itself() -> None:
    case = api.case("6319-cp10-1500").with_(models={"traction": by_hand})
    assert case.models.traction == "test_one_file.py:handed"
    found = traction(case, [])
    assert found.kernel is by_hand
    assert found.distribution.startswith("test_one_file.py ")
    assert traction(api.case("6319-cp10-1500").written() | {"models": {"traction": by_hand}}, []).kernel is by_hand


@pytest.mark.full
def test_a_pickled_case_brings_its_laws(tmp_path: Path) -> None:
    """Resolve a pickled case in another process.

    The process knows neither this file nor its law, and finds the same law.
    """
    code = (
        "import pickle, sys; from lambda_core import api; from lambda_core.model.resolve import case_hash; "
        "print(case_hash(api.check(pickle.load(open(sys.argv[1], 'rb')))))"
    )
    source = (
        f"import pickle, sys\nfrom lambda_core import api\nfrom lambda_core.model.resolve import case_hash\n{LAW}\n"
        "case = api.case('6319-cp10-1500').with_(models={'traction': traction})\n"
        "pickle.dump(case, open(sys.argv[1], 'wb'))\nprint(case_hash(api.check(case)))\n"
    )
    said = [
        subprocess.run(
            [sys.executable, "-c", text, str(tmp_path / "case.bin")], capture_output=True, text=True, check=True
        )
        for text in (source, code)
    ]
    assert said[0].stdout == said[1].stdout != ""


def test_workers_get_the_files_and_laws_of_the_director(file: Path) -> None:
    """Send files and laws to workers in each task.

    They make the registry of another process the same, even when the file is gone by then.
    """
    api.use_plugin(file)
    case = api.case("6319-cp10-1500").with_(models={"traction": by_hand})
    guests = local_files.guests()
    file.unlink()
    local_files._texts.clear()
    inline_laws._laws.clear()
    manager.registry.cache_clear()
    manager.as_guests_of(guests)
    assert traction("6319-cp10-1500").distribution.startswith("short.py ")
    assert traction(case, []).kernel.__code__.co_code == by_hand.__code__.co_code
    assert local_files.guests() == guests or pickle.loads(guests)[0] == pickle.loads(local_files.guests())[0]


@pytest.mark.full
@pytest.mark.timeout(900)  # the first test of a session that needs the solver compiles it
def test_a_study_works_with_a_file_and_its_law(file: Path, tmp_path: Path) -> None:
    api.use_plugin(file)
    study = {
        "name": "own", "case": "6208-axial-1300", "set": {"models.traction": "short"},
        "responses": ["friction_torque_Nmm"], "parameters": [{"path": "loads.axial", "values": ["300 N", "600 N"]}],
    }  # fmt: skip
    status = api.study_run(study, tmp_path / "own", workers=1)
    assert (status.done, status.failed) == (2, 0), status.reasons


@pytest.mark.timeout(900)
def test_a_result_names_the_file_that_its_law_came_from(file: Path, tmp_path: Path) -> None:
    """Name a law's file in `resume` and `cite`.

    Without the file ``resume`` names it; with another text it reports the change.
    """
    api.use_plugin(file)
    out = tmp_path / "r.h5"
    result = api.run("6208-axial-1300", [*CHOICE, "solver.duration=0.2 ms"], out=out)
    origin = f"short.py {inline_laws.digest_of(LAW.encode())}"
    assert result.headline.splitlines()[-1] == f"laws of others: traction short ({origin})"
    assert [law.distribution for law in api.cite(out).laws if law.law == "traction/short"] == [origin]
    longer = ["solver.duration=0.3 ms"]
    file.write_text(LAW + "# a word more\n")
    api.use_plugin(file)
    with pytest.raises(api.LambdaError, match=rf"traction/short is of short.py \w+ now, it was of {origin}"):
        api.resume(out, longer)
    manager.switch_off(["short.py"])
    with pytest.raises(api.CaseError, match=rf"(?s)not a traction model.*its laws came from {origin}"):
        api.resume(out, longer)


@pytest.mark.timeout(900)
def test_from_saved_file_to_result(file: Path, tmp_path: Path, warm: Warm) -> None:
    """Pass a file of laws to the commands.

    `--json` stays one object, and the result names the law's file.
    """

    def program(*arguments: str) -> tuple[int | None, str, str]:
        process = warm.start(PROGRAM, *arguments, cwd=tmp_path, env={ON_VARIABLE: ""})
        out, said = process.communicate()
        return process.returncode, out, said

    _, checked, said = program("plugins", "check", "short.py", "--json")
    assert [card["ok"] for card in json.loads(checked)["models"]] == [True], said
    _, found, said = program("quasistatic", "6208-axial-1300", "--set", CHOICE[0], "--plugin", "short.py", "--json")
    assert "laws of others: traction short (short.py " in json.loads(found)["headline"], said
    assert program("check", "6208-axial-1300", "--set", CHOICE[0])[:2] == (3, "")
    code, _, missing = program("check", "6208-axial-1300", "--plugin", "none.py")
    assert (code, missing.strip()) == (2, '"none.py" is not a file: give the path of a plugin, FILE.py')


def test_a_file_that_cannot_be_used_is_an_answer_in_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "never.py"
    path.write_text('raise ValueError("no")\n', encoding="utf-8")
    from lambda_cli.main import main

    assert main(["plugins", "check", str(path), "--json"]) == 3
    (fault,) = json.loads(capsys.readouterr().out)["faults"]
    assert "ValueError: no (never.py, line 1)" in fault["message"]
