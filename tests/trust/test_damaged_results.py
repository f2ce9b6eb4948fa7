"""Test damaged result files.

Refused in a sentence, never a hang, a dead process or a traceback.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.results import file_format as layout
from lambda_core.results import hdf5
from lambda_core.results.opening import ResultError, opened

SIGNATURE = b"GCOL\x01\x00\x00\x00"


@pytest.fixture(scope="module")
def complete(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("result") / "r.h5"
    api.run("6208-axial-1300", ["solver.duration=1 ms"], out=path)
    return path


@pytest.fixture
def file(complete: Path, tmp_path: Path) -> Path:
    return Path(shutil.copy(complete, tmp_path / "r.h5"))


def replace_text(path: Path, name: str, text: str) -> None:
    with h5py.File(path, "r+") as stream:
        group = stream[f"bearings/bearing/{layout.INPUTS_GROUP}"]
        del group[name]
        group[name] = text


@pytest.mark.parametrize("size", [b"\x00", b"\xff"])
def test_c3_a_damaged_heap_of_texts_is_refused_not_walked_for_ever(
    file: Path, size: bytes, capsys: pytest.CaptureFixture[str]
) -> None:
    data = bytearray(file.read_bytes())
    place, found = data.find(SIGNATURE), 0
    assert place >= 0
    while place >= 0:
        data[place + 16 : place + 64], found = size * 48, found + 1
        place = data.find(SIGNATURE, place + 1)
    file.write_bytes(data)
    for arguments in (["show", str(file)], ["cite", str(file)], ["resume", str(file)]):
        assert main(arguments) == 2
        assert "is damaged" in capsys.readouterr().err


@pytest.mark.parametrize(
    "damage",
    [
        lambda model: "{",
        lambda model: "[]",
        lambda model: json.dumps({**model, "geometry": {}}),
        lambda model: json.dumps({**model, "solver": {**model["solver"], "tolerance": "x"}}),
        lambda model: json.dumps({key: value for key, value in model.items() if key != "depth"}),
    ],
)
def test_c4_a_damaged_model_is_refused(file: Path, damage: Callable[[dict[str, object]], str]) -> None:
    replace_text(file, "model_json", damage(api.result(file).model))
    with pytest.raises(ResultError, match="is damaged"):
        api.result(file).summary()


def test_c4_bytes_that_are_no_text_are_written_out(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with h5py.File(file, "r+") as stream:
        stream.attrs.create("title", b"bear\xfbing", dtype=h5py.string_dtype())
    assert main(["show", str(file), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["title"] == "bear\\udcfbing"


def test_a_result_without_samples_is_named_by_views(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with h5py.File(file, "r+") as stream:
        status = json.loads(bytes(stream[layout.STATUS][()]))
        status["rows"]["samples"] = 0
        stream[layout.STATUS][()] = json.dumps(status).encode()
    for arguments in (["view", str(file), "film"], ["show", str(file)]):
        assert main(arguments) == 2
        assert "holds no samples yet" in capsys.readouterr().err


def test_a_damaged_place_of_an_open_file_is_not_read_for_ever(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Stop reading a damaged place of an open file.

    A killed run leaves a file that is read as one being written: HDF5 would try again, for longer each time.
    """
    killed = tmp_path / "killed.h5"
    with h5py.File(file, "r") as source, h5py.File(killed, "w", libver="latest") as target:
        for name in source:
            source.copy(name, target)
        target.attrs.update(source.attrs)
    stream = h5py.File(killed, "r+", libver="latest")
    stream.swmr_mode = True
    data = bytearray(killed.read_bytes())  # as it stands while it is open
    stream.close()
    headers = [place for place in range(len(data)) if data.startswith(b"OHDR", place)]
    for place in headers:
        data[place + 12] ^= 0xFF
    killed.write_bytes(data)
    assert main(["show", str(killed)]) == 2
    assert "is damaged" in capsys.readouterr().err


def test_a_damaged_root_is_named(
    file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Name a damaged root of the file.

    HDF5 has errors of several kinds for a header that cannot be read.
    """

    def refuse(*_: object, **__: object) -> None:
        raise RuntimeError("Can't deserialize object header prefix (bad object header chunk size)")

    monkeypatch.setattr(hdf5.h5py, "File", refuse)
    monkeypatch.setattr(hdf5.h5py.h5f, "open", refuse)
    assert main(["show", str(file)]) == 2
    assert "bad object header chunk size" in capsys.readouterr().err


def test_ctrl_c_inside_the_library_of_files_is_no_damage(file: Path) -> None:
    """Raise an interruption.

    A lock of h5py turned it into another error.
    """
    with pytest.raises(KeyboardInterrupt), opened(file):
        raise SystemError("returned a result with an exception set") from KeyboardInterrupt()


def test_a_part_that_is_missing_is_named_in_words_of_our_own(file: Path) -> None:
    with h5py.File(file, "r+") as stream:
        del stream["ring"]
    with pytest.raises(ResultError, match="is damaged: a part of it is missing, or of another kind"):
        api.result(file)
