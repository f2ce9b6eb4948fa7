"""Test killed studies, and studies with endless numbers."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.studies.job import Outcome
from lambda_core.studies.store import Manifest

STUDY = {
    "name": "two",
    "case": "6208-axial-1300",
    "responses": ["max_load_N"],
    "parameters": [{"path": "operation.speed", "values": ["1000 rpm", "2000 rpm"]}],
}


@pytest.fixture(scope="module")
def executor() -> Executor:
    return ThreadPoolExecutor(1)


@pytest.fixture
def study(executor: Executor, tmp_path: Path) -> Path:
    folder = tmp_path / "two"
    assert api.study_run(STUDY, folder, executor=executor).done == 2
    return folder


def test_c4_what_a_killed_study_left_half_made_is_removed(study: Path, executor: Executor) -> None:
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    runs = study / "runs"
    runs.mkdir()
    own = [".note", "0a1b.h5", f".0a1b.h5.{os.getpid()}", ".0a1b.h5.backup", f".0a1b.txt.{dead.pid}"]
    for name in (*own, f".0a1b.h5.{dead.pid}"):
        (runs / name).touch()
    api.study_resume(study, executor=executor)
    assert sorted(path.name for path in runs.iterdir()) == sorted(own)


@pytest.mark.full
@pytest.mark.parametrize(
    ("found", "put"),
    [
        (b"6208, axial", b"62\xff8, axial"),
        (b'{"max_load_N"', b'["max_load_N"'),
        (b"largest", b"l\xc3rgest"),
        (b"CREATE", b"C"),
    ],
    ids=["case", "row", "heading", "page"],
)
def test_c4_a_damaged_manifest_is_named(
    found: bytes, put: bytes, study: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = study / "manifest.sqlite"
    content = path.read_bytes()
    assert found in content
    path.write_bytes(content.replace(found, put))
    refused = {command: main(["study", command, str(study)]) for command in ("show", "status", "resume")}
    said = capsys.readouterr().err.splitlines()
    assert refused["resume"] == 2
    assert set(refused.values()) <= {0, 2}  # what does not look at the damage works
    assert len(said) == list(refused.values()).count(2)
    assert all(f"{path} is damaged" in line and "start the study again" in line for line in said)


def test_c4_an_infinite_response_is_shown(study: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    with closing(Manifest(study, write=True)) as manifest:
        manifest.keep([Outcome(0, "done", "", "", {"max_load_N": math.inf}, "", 0.0)])
    capsys.readouterr()

    def refuse(name: str) -> float:
        raise AssertionError(f"{name} is no JSON")

    assert main(["study", "show", str(study), "--json"]) == 0
    first, second = json.loads(capsys.readouterr().out, parse_constant=refuse)["points"]
    assert first["max_load_N"] is None
    assert second["max_load_N"] > 0.0
    assert main(["study", "status", str(study), "--json"]) == 0
    json.loads(capsys.readouterr().out, parse_constant=refuse)
    assert main(["study", "show", str(study), "--csv"]) == 0
    assert ",inf," in capsys.readouterr().out
    assert main(["study", "show", str(study)]) == 0
    for name, data in api.view_all(study):
        if not isinstance(data, api.LambdaError):
            json.dumps(data.as_dict(), allow_nan=False)
            api.draw(data, tmp_path, name, ["png"])


def test_c4_escapes_of_a_strangers_study_do_not_reach_the_terminal(
    study: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with closing(Manifest(study, write=True)) as manifest:
        manifest.write_meta("title", "harmless\x1b]0;owned\x07")
        manifest.keep([Outcome(0, "failed", "because\x1b[2J", "", {}, "", 0.0)])
    for command in (["status"], ["show"], ["show", "--csv"], ["status", "--json"]):
        main(["study", command[0], str(study), *command[1:]])
        said = capsys.readouterr()
        assert "\x1b]0" not in said.out + said.err, command
        assert "\x1b[2J" not in said.out + said.err, command
