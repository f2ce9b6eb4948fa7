"""The folder of a shaft's run: cut, mixed up, in use by two; what a bearing's own result says of its shaft."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import h5py
import pytest
from lambda_cli.main import main

from lambda_core.domain.files import held
from lambda_core.results.reader import Result
from lambda_core.system import operating_limits
from lambda_core.system.machine_templates import geared_shaft


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a run of a millisecond."""
    found = tmp_path_factory.mktemp("folder")
    (found / "box.toml").write_text(geared_shaft("box"))
    arguments = ["--quiet", "--out", str(found / "run"), "--duration", "1 ms"]
    assert main(["run", str(found / "box.toml"), *arguments]) == 5
    return found / "run"


@pytest.fixture
def run(made: Path, tmp_path: Path) -> Path:
    """Return a copy to spoil."""
    return Path(shutil.copytree(made, tmp_path / "run"))


@pytest.mark.full
@pytest.mark.parametrize("share", [0.05, 0.5, 0.99])
@pytest.mark.parametrize("name", ["shaft.h5", "left.h5"])
def test_a_cut_file_is_seen(name: str, share: float, run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """HDF5 reads what is missing as zeros where it takes the file for one that another process still writes."""
    file = run / name
    os.truncate(file, int(share * file.stat().st_size))
    capsys.readouterr()
    for command in (["show", str(run)], ["resume", str(run), "--quiet", "--duration", "2 ms"]):
        assert main(command) == 2
        said = capsys.readouterr()
        assert f"{name} cannot be read: it is cut: its end is missing" in " ".join(said.err.split())
        assert not said.out


def test_results_in_each_other_s_place(run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (run / "left.h5").rename(run / "old")
    (run / "right.h5").rename(run / "left.h5")
    (run / "old").rename(run / "right.h5")
    for command in (["show", str(run)], ["resume", str(run), "--quiet", "--duration", "2 ms"]):
        assert main(command) == 2
        assert 'left.h5 is the result of "right", not of "left"' in " ".join(capsys.readouterr().err.split())


def test_a_result_of_another_run(run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with h5py.File(run / "right.h5", "r+") as file:
        file.attrs["shaft_run"] = "another"
    assert main(["show", str(run)]) == 2
    assert "right.h5 belongs to another run than" in " ".join(capsys.readouterr().err.split())


@pytest.mark.full
def test_a_folder_goes_on_once(run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A second one that comes before the first has marked its files is refused, and nothing is lost."""
    pytest.importorskip("fcntl")
    again = ["resume", str(run), "--quiet", "--duration", "1.2 ms"]
    with held(run):
        assert main(again) == 2
        assert "is in use: another process writes into it" in " ".join(capsys.readouterr().err.split())
    assert main(again) == 5


def test_a_folder_does_not_go_on_under_other_code(
    run: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("lambda_core.laws.pack.code", lambda: "pack linux x86-64-v3 numba 0.0")
    assert main(["resume", str(run), "--quiet", "--duration", "1.2 ms"]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "cannot go on: it was computed by other machine code (native; this is pack linux" in said
    assert "set LAMBDA_BEARING_CODE=native" in said


def test_a_bearing_on_a_shaft_names_no_option_of_one_bearing(made: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    said = "more than it takes"
    monkeypatch.setitem(operating_limits._TILTS, "deep groove", (1e-12, said))
    result = Result(made / "left.h5")
    assert result.part_of is not None
    (warning,) = (one for one in result.summary().warnings if said in one)
    assert "bodies." not in warning


def again(run: Path) -> int:
    """Run the case of a folder once more into it."""
    arguments = ["--quiet", "--force", "--out", str(run), "--duration", "0.1 ms"]
    return main(["run", str(run.parent / "box.toml"), *arguments])


@pytest.mark.full
def test_overwriting_a_run_keeps_every_file_of_others(run: Path) -> None:
    """Of HDF5 files too: one of the user's, and the result of another run that was copied into the folder."""
    (run.parent / "box.toml").write_text(geared_shaft("box"))
    (run / "measurement.h5").write_text("x")
    shutil.copy(run / "left.h5", run / "kept.h5")
    before = Result(run / "left.h5").part_of
    assert again(run) == 5
    assert (run / "measurement.h5").read_text() == "x"
    assert Result(run / "kept.h5").part_of == before != Result(run / "left.h5").part_of


def test_overwriting_a_run_removes_the_bearings_that_it_named(run: Path) -> None:
    (run.parent / "box.toml").write_text(geared_shaft("box").replace("[bearings.left", "[bearings.first"))
    assert again(run) == 5
    assert sorted(path.name for path in run.glob("*.h5")) == ["first.h5", "right.h5", "shaft.h5"]


@pytest.mark.parametrize("name", ["left.h5", "shaft.h5"])
@pytest.mark.parametrize("kind", ["text", "hdf5", "result"])
def test_a_file_that_no_run_of_a_shaft_wrote_is_not_overwritten(
    name: str, kind: str, run: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (run.parent / "box.toml").write_text(geared_shaft("box"))
    if kind == "text":
        (run / name).write_text("x")
    else:
        shutil.copy(run / "right.h5", run / "other")
        with h5py.File(run / "other", "r+") as file:
            for mark in ("shaft_run", "shaft_bearing") if kind == "result" else list(file.attrs):
                del file.attrs[mark]
        (run / "other").replace(run / name)
    before = {path: path.read_bytes() for path in run.iterdir()}
    assert again(run) == 2
    assert f"{name} was not written by a run of a shaft and is not overwritten" in " ".join(
        capsys.readouterr().err.split()
    )
    assert before == {path: path.read_bytes() for path in run.iterdir()}
