"""Test runs that are killed at every write.

A killed process leaves what stands in its file at that moment: the file is copied at each of these moments.
"""

from __future__ import annotations

import functools
import os
import shutil
import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.results import file_format, hdf5
from lambda_core.results.opening import ResultError
from lambda_core.results.run_status import Status
from lambda_core.results.writer import ResultWriter
from lambda_core.runs import loop, session
from lambda_core.runs.launch import relaunch
from lambda_core.runs.run_engine import BearingsInMotion

if TYPE_CHECKING:
    from warm import Warm

SINGLE = "6208-axial-1300"
# A record of the grid, and the end between two of them; before and after each call of these the run is killed.
WRITES: tuple[tuple[Any, str], ...] = (
    *((ResultWriter, name) for name in ("_put_status", "flush", "save", "close")), (hdf5, "copy"), (os, "replace"),
)  # fmt: skip
KILLED = """
import os, sys
from lambda_core import api
from lambda_core.runs import session
session.Session._asks_for_modes = lambda session, state: state != "running" and os._exit(9)
api.run(sys.argv[1], ["solver.duration=" + sys.argv[3]], out=sys.argv[2])
"""

Content = dict[str, bytes]


@dataclass(frozen=True)
class Kind:
    """A case to be run and killed."""

    name: str
    source: Any
    duration: str
    check: Callable[[Any, list[str]], BearingModel | MachineModel]

    def model(self) -> BearingModel | MachineModel:
        """Return the model of the complete run.

        A checkpoint follows every record.
        """
        found = self.check(self.source, [f"solver.duration={self.duration}"])
        if isinstance(found, BearingModel):
            return replace(found, output=replace(found.output, checkpoint_interval=0.0))
        often = [
            replace(one, model=replace(one.model, output=replace(one.model.output, checkpoint_interval=0.0)))
            for one in found.bearings
        ]
        return replace(found, bearings=tuple(often))


@pytest.fixture(scope="module", params=["one bearing", pytest.param("two bearings", marks=pytest.mark.full)])
def kind(request: pytest.FixtureRequest) -> Kind:
    if request.param == "one bearing":
        return Kind("one", SINGLE, "1.5 ms", api.check)
    return Kind("two", tomllib.loads(shaft_text("geared-shaft", "box")), "1.5 ms", resolve_machine)


@pytest.fixture(autouse=True)
def dead(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take this process, whose file is copied, for dead."""
    monkeypatch.setattr(Status, "alive", lambda status: False)


@pytest.fixture(scope="module")
def undisturbed(kind: Kind, tmp_path_factory: pytest.TempPathFactory) -> Content:
    path = tmp_path_factory.mktemp("undisturbed") / "run.h5"
    api.run(kind.model(), out=path)
    return content(path)


@pytest.fixture(scope="module")
def finished(kind: Kind, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a short run that nobody changes."""
    path = tmp_path_factory.mktemp("finished") / "run.h5"
    api.run(kind.source, ["solver.duration=0.1 ms"], out=path)
    return path


@pytest.fixture
def short(finished: Path, tmp_path: Path) -> Path:
    """Return a copy of the short run."""
    return Path(shutil.copy(finished, tmp_path / "run.h5"))


def content(path: Path) -> Content:
    """Return everything that a run appends to, by dataset."""
    with hdf5.open_for_reading(path) as file:
        items = file_format.objects(file).items()
        return {name: item[()].tobytes() for name, item in items if file_format.grows(item)}


@contextmanager
def copied(path: Path, moments: tuple[tuple[Any, str], ...]) -> Iterator[dict[str, Path]]:
    """Copy a file at each moment.

    A moment may find it changed: yield the copies by moment.
    """
    found: dict[str, Path] = {}
    last: list[bytes] = []

    def copy(moment: str) -> None:
        now = path.read_bytes() if path.exists() else b""
        if now and now not in last:
            last[:] = [now]
            name = f"{len(found)} {moment}"
            found[name] = Path(shutil.copy(path, path.with_name(f"{len(found)}.h5")))

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


@pytest.fixture
def without_modes() -> Iterator[Callable[[], None]]:
    """Return a function that leaves out modes.

    From then on: runs end without them. They are not compared and take most of the time.
    """
    with pytest.MonkeyPatch.context() as patch:
        yield lambda: patch.setattr(session.Session, "_asks_for_modes", lambda session, state: False)


def wrong(copies: dict[str, Path], model: BearingModel | MachineModel, undisturbed: Content) -> list[str]:
    """Return the moments with wrong continuations.

    Every copy goes on: the result must be that of the undisturbed run.
    """
    found = []
    for moment, path in copies.items():
        try:
            with one_blas_thread():  # as the run was computed
                relaunch(path, model)
        except loop.NothingLeftError:
            pass
        if content(path) != undisturbed or api.result(path).status().state != "finished":
            found.append(moment)
    return found


@pytest.mark.full
def test_a_run_killed_at_any_moment_goes_on_as_the_undisturbed_one(
    kind: Kind, undisturbed: Content, without_modes: Callable[[], None], tmp_path: Path
) -> None:
    model = kind.model()
    with copied(
        tmp_path / "run.h5", (*WRITES, (BearingsInMotion, "integrals"), (session.Session, "_asks_for_modes"))
    ) as copies:
        api.run(model, out=tmp_path / "run.h5")
    assert {moment.split(" ", 1)[1] for moment in copies} > {"after save", "after _put_status"}
    assert len(copies) > 12
    without_modes()
    assert not wrong(copies, model, undisturbed)


@pytest.mark.full
@pytest.mark.parametrize("kind", ["one bearing"], indirect=True)  # of two: killed from the start, and at the end
def test_a_continuation_killed_at_any_moment_goes_on_as_the_undisturbed_one(
    kind: Kind, undisturbed: Content, without_modes: Callable[[], None], tmp_path: Path
) -> None:
    path = tmp_path / "run.h5"
    api.run(kind.source, ["solver.duration=0.2 ms"], out=path)
    with copied(path, WRITES) as copies:
        api.resume(path, [f"solver.duration={kind.duration}"])
    assert len(copies) > 4
    without_modes()
    assert not wrong(copies, kind.model(), undisturbed)


def test_a_process_killed_before_its_last_word_goes_on_as_the_undisturbed_one(
    warm: Warm, kind: Kind, undisturbed: Content, tmp_path: Path
) -> None:
    """Kill a process between checkpoint and last message.

    It looks for the modes at the end at that moment.
    """
    source = SINGLE
    if kind.name == "two":
        source = str(tmp_path / "box.toml")
        Path(source).write_text(shaft_text("geared-shaft", "box"))
    process = warm.start(KILLED, source, str(tmp_path / "run.h5"), kind.duration)
    _, errors = process.communicate()
    assert process.returncode == 9, errors
    assert not wrong({"modes": tmp_path / "run.h5"}, kind.model(), undisturbed)


def test_the_stored_case_runs_again_bit_for_bit(kind: Kind, undisturbed: Content, tmp_path: Path) -> None:
    """Run the complete case of a result again."""
    api.run(kind.source, [f"solver.duration={kind.duration}"], out=tmp_path / "one.h5")
    (tmp_path / "again.toml").write_text(api.result(tmp_path / "one.h5").case_toml)
    api.run(tmp_path / "again.toml", out=tmp_path / "two.h5")
    assert content(tmp_path / "one.h5") == content(tmp_path / "two.h5") == undisturbed


def test_a_duration_is_kept(kind: Kind, tmp_path: Path) -> None:
    """Keep the duration of a resumed run.

    It holds when the command does not name another.
    """
    path = tmp_path / "run.h5"
    api.run(kind.source, ["solver.duration=3 ms", "solver.max_wall=1e-6 s"], out=path)
    assert api.result(path).status().state == "stopped"
    assert api.resume(path).simulated_s == pytest.approx(3e-3, abs=5e-4)
    with pytest.raises(loop.NothingLeftError):
        api.resume(path)


@pytest.mark.parametrize("part", ["load", "integrals/input", "inputs/model_json", "ball"])
def test_a_missing_part_is_damage(part: str, short: Path) -> None:
    with h5py.File(short, "r+") as file:
        first = next(iter(file["bearings"]))
        del file[f"bearings/{first}/{part}"]
        if part in file:
            del file[part]
    with pytest.raises(api.UsageError, match=r"is damaged|is not a known channel"):
        summed(short, first)


def summed(path: Path, bearing: str) -> None:
    """Ask a result for everything that a summary needs."""
    api.result(path, bearing).summary()
    api.result(path).summary()


@pytest.mark.parametrize("what", ["texts for numbers", "an empty text"])
def test_a_part_of_another_kind_is_damage(what: str, short: Path) -> None:
    """Report an empty array in place of a text.

    It made HDF5 crash when the run went on.
    """
    with h5py.File(short, "r+") as file:
        first = next(iter(file["bearings"]))
        if what == "an empty text":
            file[f"bearings/{first}/load"].attrs["long_name"] = np.empty(0)
        else:
            group = file[f"bearings/{first}/revolutions"]
            del group["time"]
            group["time"] = ["a"]
    with pytest.raises(api.UsageError, match=r"is damaged|is not a text"):
        asked_and_gone_on(short, first)


def asked_and_gone_on(path: Path, bearing: str) -> None:
    """Do what reads every part of a result."""
    summed(path, bearing)
    api.resume(path, ["solver.duration=0.2 ms"])


@pytest.mark.parametrize("name", ["axis", "time"])
def test_a_bearing_has_the_name_of_a_dimension(name: str, tmp_path: Path) -> None:
    source = tmp_path / "box.toml"
    source.write_text(shaft_text("geared-shaft", "box").replace("bearings.right", f"bearings.{name}"))
    api.run(source, ["solver.duration=0.1 ms"], out=tmp_path / "run.h5")
    assert api.result(tmp_path / "run.h5", name)["load"].shape[1:] == (9, 2)


def test_other_code_does_not_go_on(short: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("lambda_core.laws.pack.code", lambda: "pack linux x86-64-v3 numba 0.0")
    with pytest.raises(ResultError, match="cannot go on: it was computed by other machine code"):
        api.resume(short, ["solver.duration=0.2 ms"])


def test_overwriting_keeps_every_other_file(kind: Kind, short: Path) -> None:
    (short.parent / "measurement.h5").write_text("x")
    api.run(kind.source, ["solver.duration=0.1 ms"], out=short, overwrite=True)
    assert {file.name: file.stat().st_size > 1000 for file in short.parent.iterdir()} == {
        "run.h5": True, "measurement.h5": False,
    }  # fmt: skip
