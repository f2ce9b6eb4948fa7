"""A shaft's run that is killed at any write, or at its end: gone on with, it is the undisturbed one, bit for bit.

What a killed process leaves is what stands in its files at that moment: the folder is copied at each of these moments.
"""

from __future__ import annotations

import functools
import os
import shutil
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import pytest

from lambda_core import api
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.results import hdf5
from lambda_core.results.run_status import Status
from lambda_core.results.writer import ResultWriter
from lambda_core.run import whole_run
from lambda_core.shaft.machine_motion import MachineEngine
from lambda_core.shaft.whole_file import WHOLE, WholeFile, WholeWriter
from lambda_core.system.machine import Machine
from lambda_core.system.machine_templates import geared_shaft
from lambda_core.system.resolve_machine import check_shaft

if TYPE_CHECKING:
    from warm import Warm

DURATION = 1.5e-3  # a record of the grid, and the end between two of them [s]
MOMENTS: tuple[tuple[Any, str], ...] = (
    *((ResultWriter, "_put_status"), (ResultWriter, "close"), (hdf5, "copy"), (os, "replace")),
    *((WholeWriter, "flush"), (WholeWriter, "save"), (WholeWriter, "close"), (MachineEngine, "modes")),
)  # before and after each call of these
KILLED = """
import os, sys
from lambda_core import api
from lambda_core.shaft.machine_motion import MachineEngine, machine_engine
MachineEngine.modes = lambda engine: os._exit(9)
api.shaft_run(sys.argv[1], out=sys.argv[2], duration=float(sys.argv[3]))
"""

Content = dict[str, bytes]


@pytest.fixture(scope="module")
def model() -> Machine:
    return check_shaft(tomllib.loads(geared_shaft("box")))


@pytest.fixture(autouse=True)
def often(monkeypatch: pytest.MonkeyPatch) -> None:
    """Write a checkpoint behind every record; take this process, whose files are copied, for dead."""
    monkeypatch.setattr(whole_run, "_SAVE_AFTER", 0.0)
    monkeypatch.setattr(Status, "alive", lambda status: False)


@pytest.fixture(scope="module")
def undisturbed(model: Machine, tmp_path_factory: pytest.TempPathFactory) -> Content:
    folder = tmp_path_factory.mktemp("undisturbed") / "run"
    api.shaft_run(model, out=folder, duration=DURATION)
    return content(folder)


def content(folder: Path) -> Content:
    """Return everything that a run appends to, by file and dataset."""
    found: Content = {}

    def keep(file: str, name: str, item: object) -> None:
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and item.chunks:
            found[f"{file}/{name}"] = item[()].tobytes()

    for path in sorted(folder.glob("*.h5")):
        with hdf5.open_for_reading(path) as file:
            file.visititems(functools.partial(keep, path.name))
    return found


@contextmanager
def copied(folder: Path, moments: tuple[tuple[Any, str], ...] = MOMENTS) -> Iterator[dict[str, Path]]:
    """Copy a folder whenever a moment finds it changed; yield the copies by moment."""
    found: dict[str, Path] = {}
    last: list[Any] = []

    def copy(moment: str) -> None:
        now = {path.name: path.read_bytes() for path in folder.iterdir()} if folder.exists() else {}
        if now and now not in last:
            last[:] = [now]
            name = f"{len(found)} {moment}"
            found[name] = Path(shutil.copytree(folder, folder.with_name(str(len(found)))))

    def watched(name: str, function: Any) -> Any:
        @functools.wraps(function)
        def call(*arguments: Any, **options: Any) -> Any:
            copy(f"before {name}")
            answer = function(*arguments, **options)
            copy(f"after {name}")
            return answer

        return call

    with pytest.MonkeyPatch.context() as patch:
        for owner, name in moments:
            patch.setattr(owner, name, watched(name, getattr(owner, name)))
        yield found


def wrong(copies: dict[str, Path], model: Machine, undisturbed: Content) -> list[str]:
    """Go on with every copy; return the moments after which it is not the undisturbed run."""
    found = []
    for moment, folder in copies.items():
        try:
            with one_blas_thread():  # as the run was computed
                whole_run.resume_whole(folder, model, whole_run.Ends(DURATION), report=None, announce=None)
        except api.UsageError as refused:
            if "nothing is left to do" not in str(refused):
                raise
        if content(folder) != undisturbed or WholeFile(folder).status().state != "finished":
            found.append(moment)
    return found


@pytest.mark.full
def test_a_run_killed_at_any_moment_goes_on_as_the_undisturbed_one(
    model: Machine, undisturbed: Content, tmp_path: Path
) -> None:
    """From the first checkpoint on; before it there is none to go on from, and that is said."""
    with copied(tmp_path / "run") as copies:
        api.shaft_run(model, out=tmp_path / "run", duration=DURATION)
    begun = {}
    for moment, folder in copies.items():
        if (folder / WHOLE).exists() and any(slot.any() for slot in _slots(folder)):
            begun[moment] = folder
        else:
            with pytest.raises(api.UsageError, match=r"no checkpoint|damaged|does not exist"):
                api.shaft_resume(folder)
    assert {moment.split(" ", 1)[1] for moment in begun} > {"after save", "after _put_status", "after copy"}
    assert not wrong(begun, model, undisturbed)


def _slots(folder: Path) -> Any:
    with hdf5.open_for_reading(folder / WHOLE) as file:
        return file["slots"][()]


@pytest.mark.full
def test_a_continuation_killed_at_any_moment_goes_on_as_the_undisturbed_one(
    model: Machine, undisturbed: Content, tmp_path: Path
) -> None:
    api.shaft_run(model, out=tmp_path / "run", duration=0.2e-3)
    with copied(tmp_path / "run", ((os, "replace"),)) as copies:
        api.shaft_resume(tmp_path / "run", duration=DURATION)
    assert len(copies) > 2 * 3  # the three files are replaced by copies to go on in, two of them by packed ones
    assert not wrong(copies, model, undisturbed)


def test_a_process_killed_while_it_looks_at_its_modes_goes_on_as_the_undisturbed_one(
    warm: Warm, model: Machine, undisturbed: Content, tmp_path: Path
) -> None:
    (tmp_path / "box.toml").write_text(geared_shaft("box"))
    process = warm.start(KILLED, str(tmp_path / "box.toml"), str(tmp_path / "run"), str(DURATION))
    _, errors = process.communicate()
    assert process.returncode == 9, errors
    assert not wrong({"modes": tmp_path / "run"}, model, undisturbed)


@pytest.mark.full
def test_a_continuation_looks_for_convergence_where_a_revolution_ends(
    model: Machine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the midst of a revolution the undisturbed run does not look, and a shorter run would have other averages."""
    api.shaft_run(model, out=tmp_path / "run", duration=DURATION)
    with h5py.File(tmp_path / "run" / WHOLE, "r+") as file:
        killed = Status.from_bytes(file["status"][()])
        file["status"][()] = Status(**{**vars(killed), "state": "running"}).to_bytes(8192)
    monkeypatch.setattr(whole_run, "are_converged", lambda *of: True)
    assert api.shaft_resume(tmp_path / "run", max_wall=1e-3).state == "stopped"
