"""Test runs from the builder.

An empty model to a result by keyboard, the queue, cancel, and what can go wrong.
"""

from __future__ import annotations

import asyncio
import os
import resource
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from driving import LARGE, SMALL, builder, checked, find, go_to, screen_text, wait_for, write
from lambda_gui import runs
from lambda_gui.app import BuilderApp
from lambda_gui.builder import BuilderScreen
from lambda_gui.catalogue import CatalogueScreen
from lambda_gui.dialogs import AskText, OpenCase
from lambda_gui.helper import Helper
from lambda_gui.results_screen import ResultsScreen
from lambda_gui.run_screen import RunScreen
from lambda_gui.runs import open_queue
from textual.widgets import DataTable

from lambda_core import api

# Prints what a run prints, and ends on request or after the number of steps in "steps".
FAKE = """
import json, signal, sys, time, pathlib
stopped = []
signal.signal(signal.SIGINT, lambda *_: stopped.append(1))
steps = int(pathlib.Path("../../../steps").read_text())
for n in range(steps):
    if stopped:
        sys.exit(130)
    print(json.dumps({"event": "progress", "time_s": n, "percent": 100 * n / steps, "cage_revolutions": 5 * n / steps,
        "cage_revolutions_wanted": 5.0, "averaged": 0, "friction_torque_Nmm": 270.0, "friction_torque_ci_Nmm": 1.0,
        "friction_torque_now_Nmm": 270.0 + n % 3, "cage_speed_ratio": 0.4, "energy_residual": 1e-5,
        "inner_loads_N": [550.0] * 9, "wall_s": 0.1 * n, "left_s": 1.0}), file=sys.stderr, flush=True)
    time.sleep(0.05)
"""


@pytest.fixture
def fake_program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[int], None]:
    """Replace the simulation by messages.

    The program only reports; return what sets its steps.
    """
    script = tmp_path / "fake.py"
    script.write_text(FAKE, encoding="utf-8")
    monkeypatch.setattr(runs, "_PROGRAM", (runs.sys.executable, str(script)))
    folder = tmp_path / "data" / "builder"

    def steps(number: int) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "steps").write_text(str(number), encoding="utf-8")
        (tmp_path / "data" / "steps").write_text(str(number), encoding="utf-8")

    return steps


def settle(queue: api.RunQueue, run: api.QueuedRun, seconds: float = 200.0) -> None:
    """Poll until a run has ended."""
    end = time.monotonic() + seconds
    while run.state in ("waiting", "running"):
        assert time.monotonic() < end, run
        queue.poll()
        time.sleep(0.02)


async def test_from_an_empty_model_to_a_result_by_keyboard(work_folder: Path, fresh_helper: None) -> None:
    """Build and run the paper's 6208 by keyboard.

    1300 N (Syla et al. 2026, Fig. 7), 5 ms.
    """
    async with BuilderApp().run_test(size=SMALL) as pilot:
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, OpenCase))
        await pilot.press("enter")  # the empty model
        await checked(pilot)
        assert len(builder(pilot).check.problems) == 4
        await pilot.press("f2")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
        await write(pilot, "6208 syla")
        await wait_for(pilot, lambda: pilot.app.screen.query_one(DataTable).row_count == 1)
        await pilot.press("enter")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, BuilderScreen))
        for path, begin, text in (
            ("bearing.clearance", "bearing.cl", "14 um"),
            ("lubricant.name", "lubricant.n", "bode-m"),  # Enter takes the name that is proposed
            ("lubricant.temperature", "lubricant.t", "40"),
            ("solver.duration", "solver.d", "5 m"),
            ("loads.axial", "loads.a", "1300"),
            ("operation.speed", "operation.s", "2750"),
        ):
            await find(pilot, path, begin)
            await write(pilot, text)
            await pilot.press("enter")
        await checked(pilot)
        assert not builder(pilot).check.problems
        await pilot.press("ctrl+s")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, AskText))
        await pilot.press("ctrl+a", "ctrl+k")
        await write(pilot, "mine")
        await pilot.press("enter")
        await wait_for(pilot, lambda: Path("mine.toml").exists())
        await pilot.press("f5")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, RunScreen))
        queue = pilot.app.queue
        await wait_for(pilot, lambda: queue.runs[0].state not in ("waiting", "running"))
        assert queue.runs[0].state == "done", queue.runs[0].message
        await pilot.press("enter")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, ResultsScreen))
        await wait_for(pilot, lambda: "friction torque" in screen_text(pilot.app))
        result = queue.runs[0].result
    written = api.case("mine.toml")
    assert written.loads.axial == 1300.0
    assert written.bearing.maker == "Syla2026"
    summary = api.summary(result)
    assert summary.simulated_s == pytest.approx(0.005, rel=0.05)
    assert summary.max_pressure_GPa is not None
    assert 1.5 < summary.max_pressure_GPa < 1.75  # 1.62 GPa from the equilibrium of the same case


def test_runs_wait_for_each_other(work_folder: Path, fake_program: Callable[[int], None]) -> None:
    fake_program(10)
    ended: list[api.QueuedRun] = []
    queue = open_queue(ended.append)
    first, second = (queue.add("case", "name = 'case'", work_folder) for _ in range(2))
    assert (first.state, second.state) == ("running", "waiting")
    assert first.result != second.result
    settle(queue, second)
    assert ended == [first, second]
    assert [run.message for run in ended] == ["converged"] * 2
    assert len(first.history) == 10


def test_a_cancelled_run_stops_itself(work_folder: Path, fake_program: Callable[[int], None]) -> None:
    fake_program(2000)
    queue = open_queue(lambda run: None)
    run, waiting = (queue.add("case", "name = 'case'", work_folder) for _ in range(2))
    while not run.history:
        queue.poll()
        time.sleep(0.02)
    waiting.cancel()
    run.cancel()
    settle(queue, run)
    assert run.state == "stopped"
    assert waiting.state == "stopped"


def test_a_run_outlives_the_builder(work_folder: Path, fake_program: Callable[[int], None]) -> None:
    fake_program(2000)
    first = open_queue(lambda run: None)
    run = first.add("case", "name = 'case'", work_folder)
    second = open_queue(lambda run: None)
    second.find_earlier()
    (found,) = second.runs
    assert found.result == run.result
    while not found.history:
        second.poll()
        time.sleep(0.02)
    assert found.is_active
    found.cancel()
    settle(first, run)  # its parent takes the process off the system's list
    second.poll()
    assert found.state != "running"


@pytest.mark.full
async def test_traces_are_drawn_and_a_resize_in_the_middle_does_no_harm(
    hand_written: Path, fake_program: Callable[[int], None]
) -> None:
    fake_program(4000)  # for longer than anything below takes
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await pilot.press("f5")
        await wait_for(pilot, lambda: pilot.app.queue.runs and len(pilot.app.queue.runs[0].history) > 5)
        for size in (LARGE, (60, 18), SMALL):
            await pilot.resize_terminal(*size)
            assert "drive-end" in screen_text(pilot.app)
        await wait_for(pilot, lambda: "friction torque [N mm]" in screen_text(pilot.app))
        assert pilot.app.queue.runs[0].is_active
        await pilot.press("escape")
        await go_to(pilot, "loads.axial")  # a run does not keep one from working
        await pilot.press("f7", "c")
        await wait_for(pilot, lambda: pilot.app.queue.runs[0].state == "stopped")


async def test_a_result_that_is_deleted_is_said_and_nothing_else(
    hand_written: Path, fake_program: Callable[[int], None]
) -> None:
    fake_program(1)
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await pilot.press("f5")
        await wait_for(pilot, lambda: pilot.app.queue.runs and pilot.app.queue.runs[0].state == "done")
        await pilot.press("enter")
        await wait_for(pilot, lambda: any("does not exist" in note.message for note in pilot.app._notifications))
        assert pilot.app.is_running


@pytest.mark.full
async def test_a_file_that_is_no_result_is_said(hand_written: Path) -> None:
    Path("broken.h5").write_bytes(b"not HDF5 at all")
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await pilot.press("f6")
        await wait_for(pilot, lambda: "is not a result file" in screen_text(pilot.app))
        Path("broken.h5").unlink()
        await wait_for(pilot, lambda: "no result files here" in screen_text(pilot.app))


@pytest.mark.full
async def test_a_full_disk_loses_nothing(hand_written: Path) -> None:
    before = hand_written.read_text(encoding="utf-8")
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        builder(pilot).draft.set("loads", "radial", value="9 kN")
        soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (16, hard))
        try:
            pilot.app.save_case()
            builder(pilot)._keep()
            with pytest.raises(api.UsageError, match="cannot write"):
                pilot.app.queue.add("case", "x" * 100, hand_written.parent)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        assert builder(pilot).draft.is_changed()
        assert hand_written.read_text(encoding="utf-8") == before
        assert [path.name for path in hand_written.parent.iterdir()] == [hand_written.name]
        pilot.app.save_case()
        assert api.case(hand_written).loads.radial == 9000.0


@pytest.mark.full
async def test_a_disk_that_fills_up_during_a_run_is_said(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, hard))  # the run inherits it
        try:
            await pilot.press("f5")
            await wait_for(pilot, lambda: pilot.app.queue.runs)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        run = pilot.app.queue.runs[0]
        await wait_for(pilot, lambda: run.state not in ("waiting", "running"))
        assert run.state == "failed"
        assert "File too large" in run.message or "cannot write" in run.message
        await wait_for(pilot, lambda: run.message[:30] in screen_text(pilot.app))
        await pilot.press("escape")
        assert not builder(pilot).check.problems


@pytest.mark.full
async def test_a_run_does_not_keep_one_from_working(hand_written: Path) -> None:
    """Measure the longest block of the event loop.

    In seconds of the processor, while the solver runs and is watched.
    """
    longest = 0.0

    async def probe() -> None:
        nonlocal longest
        before = time.thread_time()
        while True:
            await asyncio.sleep(0.005)
            now = time.thread_time()
            longest, before = max(longest, now - before), now

    async with BuilderApp(str(hand_written)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        builder(pilot).draft.set("solver", "duration", value="0.2 s")
        await checked(pilot)
        await pilot.press("f5")
        queue = pilot.app.queue
        await wait_for(pilot, lambda: queue.runs and queue.runs[0].history)
        await pilot.press("escape")
        await go_to(pilot, "loads.axial")
        typing = asyncio.create_task(probe())
        await pilot.press("ctrl+a", "ctrl+k")
        await write(pilot, "250 N")
        await checked(pilot)
        typing.cancel()
        assert builder(pilot).draft.get("loads", "axial") == "250 N"
        await pilot.press("f7")
        await wait_for(pilot, lambda: "element loads" in screen_text(pilot.app) or not queue.active)
        watching = asyncio.create_task(probe())
        await wait_for(pilot, lambda: not queue.active)
        watching.cancel()
        assert queue.runs[0].state == "done", queue.runs[0].message
    print(f"longest piece of work: {1e3 * longest:.0f} ms")
    assert longest < 0.2


@pytest.mark.skipif(os.name != "posix", reason="needs file modes")
async def test_a_read_only_folder_is_said(hand_written: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        builder(pilot).draft.set("loads", "radial", value="9 kN")
        await checked(pilot)
        if os.geteuid() == 0:  # root may write everywhere: a folder of the kernel is not writable by anybody
            builder(pilot).draft.path = Path("/proc/drive-end.toml")
        else:
            hand_written.parent.chmod(0o555)
        try:
            pilot.app._write(None, None)
            assert builder(pilot).draft.is_changed()
            monkeypatch.setattr(os, "access", lambda *_: False)
            with pytest.raises(api.UsageError, match="not writable"):
                pilot.app.queue.add("case", "", hand_written.parent)
        finally:
            if os.geteuid() != 0:
                hand_written.parent.chmod(0o755)
            builder(pilot).draft.path = hand_written
        assert pilot.app.is_running


async def test_who_waits_for_a_helper_that_is_closed_is_cancelled() -> None:
    """Cancel calls to a closed helper.

    The screen that asked is gone, so that nothing could show an error.
    """
    helper = Helper(lambda text: None)
    waiting = asyncio.create_task(helper.ask("views", subject="result"))
    while helper._process is None:
        await asyncio.sleep(0.01)
    await helper.close()
    with pytest.raises(asyncio.CancelledError):
        await waiting


async def test_a_helper_that_is_closed_while_it_starts_leaves_no_process(monkeypatch: pytest.MonkeyPatch) -> None:
    started, start = [], asyncio.base_events.BaseEventLoop.subprocess_exec

    async def slowly(self: asyncio.base_events.BaseEventLoop, *what: Any, **options: Any) -> Any:
        await helper.close()
        started.append(await start(self, *what, **options))
        return started[0]

    monkeypatch.setattr(asyncio.base_events.BaseEventLoop, "subprocess_exec", slowly)
    helper = Helper(lambda text: None)
    with pytest.raises(asyncio.CancelledError):
        await helper.ask("views", subject="result")
    assert started[0][0].get_returncode() is not None


async def test_who_ends_a_helper_and_is_cancelled_leaves_no_process() -> None:
    """Leave no process behind a cancelled end.

    The builder ends while a screen ends its helper, whose loop is closed by then.
    """
    helper = Helper(lambda text: None)
    waiting = asyncio.create_task(helper.ask("views", subject="result"))
    while helper._process is None:
        await asyncio.sleep(0.01)
    transport, closing = helper._transport, asyncio.create_task(helper.close())
    await asyncio.sleep(0)
    for task in (waiting, closing):
        task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await closing
    assert transport is not None
    assert transport.is_closing()
