"""Test that hostile or unexpected files do no harm."""

from __future__ import annotations

import csv
import os
import shutil
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.errors import CaseError, PartialResultError, UsageError
from lambda_core.domain.files import check_target, read_bytes
from lambda_core.domain.printable import cell_text, from_cell, printable
from lambda_core.results.opening import ResultError
from lambda_core.results.reader import Result

CASE = "6208-axial-1300"
LONG = ["solver.duration=1 s"]  # long enough to show progress before the end
SHORT = ["solver.duration=1 ms"]
SECRET = "the words of another file"


@pytest.fixture(scope="module")
def original(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("original") / "r.h5"
    api.run(CASE, SHORT, out=path)
    return path


@pytest.fixture
def stranger(original: Path, tmp_path: Path) -> Path:
    """Return a copy of a result, to be tampered with."""
    return Path(shutil.copy(original, tmp_path / "stranger.h5"))


def odd_files(folder: Path) -> dict[str, Path]:
    """Return irregular files and links to them."""
    os.mkfifo(folder / "pipe")
    (folder / "folder").mkdir()
    (folder / "link").symlink_to(folder / "pipe")
    found = {"a pipe": folder / "pipe", "a folder": folder / "folder", "pipe": folder / "link"}
    if os.geteuid() == 0:  # a null device of the test's own: the system's is nobody's to lose
        try:
            os.mknod(folder / "null", 0o666 | stat.S_IFCHR, os.makedev(1, 3))
        except OSError:  # a container without that right
            return found
        found["a device"] = folder / "null"
    return found


@pytest.mark.skipif(os.name == "nt", reason="pipes and devices of POSIX")
def test_c2_1_only_regular_files_are_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for kind, path in odd_files(tmp_path).items():
        before = path.stat()
        with pytest.raises(UsageError, match=kind):
            check_target(path)
        with pytest.raises(UsageError, match="folder" if path.is_dir() else "only regular files"):
            api.run(CASE, SHORT, out=path, overwrite=True)
        assert main(["init", CASE, "--out", str(path), "--force"]) == 2, path
        assert main(["report", CASE, "--out", str(path), "--force"]) == 2, path
        assert "has a bug" not in capsys.readouterr().err
        assert (path.stat().st_mode, path.stat().st_ino) == (before.st_mode, before.st_ino)


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root makes devices")
def test_c2_1_a_device_of_the_tests_own_is_among_them(tmp_path: Path) -> None:
    try:
        os.mknod(tmp_path / "probe", 0o666 | stat.S_IFCHR, os.makedev(1, 3))
    except OSError as error:
        pytest.skip(f"no devices can be made here: {error.strerror}")
    assert "a device" in odd_files(tmp_path)


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="a folder that takes no new file")
@pytest.mark.parametrize(
    "arguments",
    [
        ["run", CASE, "--out", "/proc/x.h5"],
        ["report", "RESULT", "--out", "/proc/x.html"],
        ["animate", "RESULT", "--out", "/proc/x.gif"],
        ["view", "RESULT", "--out", "/proc/x"],
        ["study", "run", "s.toml", "--out", "/proc/x/y"],
        ["electric-map", CASE, "--out", "/proc/x.csv"],
        ["electric-map", CASE, "--draw", "/proc/x"],
        ["thermal", CASE, "--draw", "/proc/x"],
        ["stribeck", CASE, "--draw", "/proc/x"],
        ["reproduce", "table4", "--out", "/proc/x"],
        ["init", "mine", "--out", "/proc/x.toml"],
        ["db", "export", "/proc/x.toml"],
    ],
    ids=" ".join,
)
def test_a_place_that_takes_no_file_is_refused_before_the_work(
    arguments: list[str], original: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def worked(*_: object, **__: object) -> None:
        raise AssertionError("the work has begun")

    for place in (
        "runs.beginning.solve",
        "solver.drivers.equilibrium.solve",
        "export.report.page.run_chapter",
        "discovery.shown.data_of",
    ):
        monkeypatch.setattr(f"lambda_core.{place}", worked)
    assert main([str(original) if word == "RESULT" else word for word in arguments]) == 2
    assert "/proc" in (said := capsys.readouterr().err)
    assert "cannot" in said


@pytest.mark.full
def test_c2_3_nothing_is_imported_from_the_working_directory(tmp_path: Path) -> None:
    """Import nothing from the working directory.

    Workers that compile, helpers of the builder and workers of studies would import it.
    """
    for name in ("json", "multiprocessing", "lambda_core", "numba", "random"):
        (tmp_path / f"{name}.py").write_text("open('imported', 'a').write(__name__)\n", encoding="utf-8")
    script = Path(sys.executable).parent / "lambda-bearing"
    (tmp_path / "s.toml").write_text(
        f'name = "two"\ncase = "{CASE}"\nmode = "quasi-static"\nresponses = ["max_load_N"]\n\n'
        '[[parameters]]\npath = "loads.axial"\nvalues = ["1 kN", "2 kN"]\n',
        encoding="utf-8",
    )
    for arguments in (["plugins", "check", "damping"], ["study", "run", "s.toml", "--workers", "1", "--quiet"]):
        done = subprocess.run(
            [script, *arguments], cwd=tmp_path, capture_output=True, text=True, timeout=800, check=False
        )
        assert done.returncode == 0, done.stderr
    assert not (tmp_path / "imported").exists()


def external_link(file: h5py.File, path: Path) -> None:
    del file["inputs/case_toml"]
    file["inputs/case_toml"] = h5py.ExternalLink(str(path), "/secret")


def external_storage(file: h5py.File, path: Path) -> None:
    del file["inputs/case_toml"]
    file.create_dataset("inputs/case_toml", (1,), "S24", external=[(str(path), 0, 24)])


def soft_link(file: h5py.File, path: Path) -> None:
    file["inputs/more"] = h5py.SoftLink("/status")


def virtual(file: h5py.File, path: Path) -> None:
    layout = h5py.VirtualLayout((1,), "f8")
    layout[:] = h5py.VirtualSource(str(path), "x", shape=(1,))
    file.create_virtual_dataset("inputs/more", layout)


@pytest.mark.parametrize("tamper", [external_link, external_storage, soft_link, virtual])
def test_c3_a_strangers_result_shows_nothing_of_other_files(
    tamper: Callable[[h5py.File, Path], None], stranger: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    secret = tmp_path / "secret"
    secret.write_text(SECRET, encoding="utf-8")
    with h5py.File(stranger, "r+") as file:
        tamper(file, secret)
    with pytest.raises(ResultError, match="not a result of a run"):
        Result(stranger)
    assert main(["show", str(stranger), "--assumptions"]) == 2
    said = capsys.readouterr()
    assert SECRET not in said.out + said.err


def test_c4_escapes_of_a_strangers_result_do_not_reach_the_terminal(
    stranger: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with h5py.File(stranger, "r+") as file:
        file.attrs["title"] = "harmless\x1b]0;owned\x07"
    assert Result(stranger).title == "harmless\\x1b]0;owned\\x07"
    main(["show", str(stranger)])
    said = capsys.readouterr()
    assert "\x1b]0" not in said.out + said.err


def test_c4_spreadsheets_compute_nothing_and_rows_come_back() -> None:
    for text in ("=cmd|' /C calc'!A0", "@SUM(1)", "+x", "-x"):
        assert cell_text(text) == f"'{text}"
        assert from_cell(cell_text(text)) == text
    for text in ("-1.5e-3", "+2", "SKF", "'quoted'"):
        assert cell_text(text) == text == from_cell(text)
    assert printable("a\tb\nµ") == "a\tb\nµ"


@pytest.mark.parametrize(
    "sign", ["\x00", "\x07", "\r", "\x1b", "\x7f", "\x80", "\x9b", "\x9f", "\u202e", "\u2069", "\udc9b"]
)
def test_c4_what_drives_a_terminal_is_escaped(sign: str) -> None:
    assert printable(f"a{sign}b") == "a" + sign.encode("unicode_escape").decode().replace("\\r", "\\x0d") + "b"


def test_c4_exported_rows_hold_no_formula(tmp_path: Path, user_folder: Path) -> None:
    from lambda_db.transfer import _write_csv

    _write_csv(tmp_path / "bearing.csv", "bearing", [{"designation": "=1+1", "maker": None}])
    with (tmp_path / "bearing.csv").open(newline="", encoding="utf-8") as stream:
        assert list(csv.reader(stream))[1][0] == "'=1+1"


@pytest.mark.skipif(os.name == "nt", reason="pipes and devices of POSIX")
def test_c3_table_files_are_regular_and_bounded(tmp_path: Path) -> None:
    from lambda_core.case.pairs import read_pairs

    os.mkfifo(tmp_path / "pipe")
    for path, words in ((Path("/dev/zero"), "a device"), (tmp_path / "pipe", "a pipe"), (tmp_path, "folder|directory")):
        with pytest.raises(ValueError, match=words):
            read_pairs(path, "force")
    large = tmp_path / "large.csv"
    large.write_bytes(b"time [s],value [N]\n" + b"1,2\n" * 100_001)
    with pytest.raises(ValueError, match="at most 100000"):
        read_pairs(large, "force")
    with pytest.raises(OSError, match="larger than"):
        read_bytes(large, 1000)


@pytest.mark.full
def test_c3_of_two_runs_into_one_file_the_later_wins_and_the_other_says_so(tmp_path: Path) -> None:
    path, begun = tmp_path / "r.h5", []

    def meanwhile(_: object) -> None:
        if not begun:
            begun.append(True)
            api.run(CASE, SHORT, out=path, overwrite=True)

    with pytest.raises(PartialResultError, match="deleted, renamed or replaced"):
        api.run(CASE, LONG, out=path, overwrite=True, progress=meanwhile)
    assert api.result(path).status().state == "finished"
    assert [file.name for file in tmp_path.iterdir()] == ["r.h5"]


@pytest.mark.full
def test_c4_a_result_deleted_meanwhile_is_not_called_kept(tmp_path: Path) -> None:
    path = tmp_path / "r.h5"
    with pytest.raises(PartialResultError, match="is no longer there"):
        api.run(CASE, LONG, out=path, progress=lambda _: path.unlink(missing_ok=True))


@pytest.mark.parametrize("text", ["a = " + "[" * 5000, "a" + ".a" * 5000 + " = 1"])
def test_c4_deep_documents_are_refused(text: str, tmp_path: Path) -> None:
    path = tmp_path / "deep.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(CaseError, match="nested too deeply"):
        api.check(path)


def test_c4_deep_changes_on_the_command_line_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    for change in ("loads.radial=" + "[" * 5000, "a" + ".a" * 5000 + "=1"):
        assert main(["check", CASE, "--set", change]) == 3
        assert "has a bug" not in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [["check", "x" * 5000], ["run", CASE, "--out", "y" * 5000 + ".h5"],
                                       ["db", "search", "6208", "--limit", "99999999999999999999"]])  # fmt: skip
def test_c4_long_names_and_numbers_are_refused(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(arguments) == 2
    assert "has a bug" not in capsys.readouterr().err
