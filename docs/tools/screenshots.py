"""Draw screens of the builder: ``python docs/tools/screenshots.py [SCREEN ...]``.

Works in a temporary folder with data and runs of its own, at 80 x 24 and at 160 x 48. Needs ``rsvg-convert``
(librsvg), Pillow and the DejaVu fonts. Pictures go to docs/images/gui, or to the folder after ``--to``.
"""

from __future__ import annotations

import argparse
import asyncio
import html
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, cast

from lambda_gui.answer_screen import AnswerScreen
from lambda_gui.app import BuilderApp
from lambda_gui.derived import Derived
from lambda_gui.dialogs import Ask, OpenCase
from lambda_gui.duty_screen import DutyScreen
from lambda_gui.fit_screen import FitScreen
from lambda_gui.results_screen import ResultsScreen
from lambda_gui.run_screen import RunScreen
from lambda_gui.study_screen import StudyScreen
from lambda_gui.tree import ModelTree
from rich.cells import cell_len
from textual.widgets import DataTable, OptionList

if TYPE_CHECKING:
    from textual.pilot import Pilot

    Script = Callable[[Pilot[None]], Awaitable[None]]

TARGET = Path(__file__).parent.parent / "images" / "gui"
SIZES = {"80x24": (80, 24), "160x48": (160, 48)}
# Drawn sign by sign: their glyphs are as wide as a cell only in a terminal's font.
_SINGLE = "\u2500-\u259f\u2800-\u28ff\u25cf"
# Part of a cell that a block covers: left, top, width, height. Glyphs of fonts leave gaps between cells.
_BLOCKS = {"\u2580": (0, 0, 1, 0.5), "\u2584": (0, 0.5, 1, 0.5), "\u2588": (0, 0, 1, 1), "\u258c": (0, 0, 0.5, 1)}
_LINE, _RISE = 24.4, 18.5  # height of a line, from its top to the base of its letters, as Textual exports it
_WORDS = re.compile(rf"[{_SINGLE}]|[^\u00a0 {_SINGLE}]+")


@dataclass(frozen=True)
class Scene:
    """Actions before one picture.

    A case to begin with, and the next actions.
    """

    case: str | None
    play: Script
    light: bool = False


async def until(pilot: Pilot[None], what: Callable[[], object], seconds: float = 120.0) -> None:
    """Let the builder work until something is so."""
    end = time.monotonic() + seconds
    while not what():
        if time.monotonic() > end:
            raise TimeoutError
        await pilot.pause(0.05)


def app_of(pilot: Pilot[None]) -> BuilderApp:
    """Return the builder."""
    return cast(BuilderApp, pilot.app)


async def checked(pilot: Pilot[None]) -> None:
    """Wait for the first check."""
    builder = app_of(pilot).builder
    await until(pilot, lambda: builder.check.model or builder.check.problems)


async def estimated(pilot: Pilot[None]) -> None:
    """Wait for the numbers that follow."""
    await checked(pilot)
    await until(pilot, lambda: pilot.app.screen.query_one(Derived).is_current)


async def settled(pilot: Pilot[None]) -> None:
    """Wait until nothing is being read or drawn."""
    await pilot.pause(0.3)
    await until(pilot, lambda: not any(worker.is_running for worker in pilot.app.workers))


async def node(pilot: Pilot[None], key: str) -> None:
    """Show the form of a node and go into it."""
    app_of(pilot).builder.query_one(ModelTree).go_to(key)
    builder = app_of(pilot).builder
    await until(pilot, lambda: builder.form is not None and builder.form.node.key == key and builder.form.is_ready)
    await pilot.pause(0.1)
    await pilot.press("enter")


async def opening(pilot: Pilot[None]) -> None:
    await until(pilot, lambda: isinstance(pilot.app.screen, OpenCase))
    await checked(pilot)


async def builder(pilot: Pilot[None]) -> None:
    await estimated(pilot)
    await node(pilot, "bearing")


async def boundary(pilot: Pilot[None]) -> None:
    await estimated(pilot)
    await node(pilot, "boundary.outer_ring")


async def law(pilot: Pilot[None]) -> None:
    await estimated(pilot)
    await node(pilot, "forces.ball_inner.traction")
    await pilot.press("down")


async def solver(pilot: Pilot[None]) -> None:
    await estimated(pilot)
    await node(pilot, "solver")


async def mistakes(pilot: Pilot[None]) -> None:
    await opening(pilot)
    await pilot.press("enter")
    await checked(pilot)
    await pilot.press("f8", "f8")


async def choice(pilot: Pilot[None]) -> None:
    await estimated(pilot)
    await node(pilot, "models.traction")
    await pilot.press("enter")
    await pilot.press("down", "down")


async def palette(pilot: Pilot[None]) -> None:
    await estimated(pilot)
    await pilot.press("ctrl+p", *"radial")
    await pilot.pause(1.0)


async def bearings(pilot: Pilot[None]) -> None:
    await checked(pilot)
    await pilot.press("f2", *"6208")
    await until(pilot, lambda: pilot.app.screen.query_one(DataTable).row_count < 20)


async def estimated_row(pilot: Pilot[None]) -> None:
    await bearings(pilot)
    await pilot.press(*" skf")
    await pilot.pause(0.3)


async def oils(pilot: Pilot[None]) -> None:
    await checked(pilot)
    await pilot.press("f2", "f2")


async def own_row(pilot: Pilot[None]) -> None:
    await bearings(pilot)
    await pilot.press("f4")


async def running(pilot: Pilot[None]) -> None:
    await checked(pilot)
    app = app_of(pilot)
    app.builder.draft.set("solver", "duration", value="6 s")
    app.builder.draft.set("solver", "average_revolutions", value=20)
    before = app.builder.check
    app.builder.edited()
    await until(pilot, lambda: app.builder.check is not before)
    await pilot.press("f5")
    await until(pilot, lambda: isinstance(pilot.app.screen, RunScreen))
    await pilot.press("escape", "f5")
    await until(pilot, lambda: isinstance(pilot.app.screen, RunScreen))
    await pilot.press("up")
    await until(pilot, lambda: app.queue.runs[0].last is not None and app.queue.runs[0].last.percent > 45.0)


async def no_runs(pilot: Pilot[None]) -> None:
    await checked(pilot)
    await pilot.press("f7")


def results(view: str | None = None, *, marked: int = 0) -> Script:
    """Return the actions for a result's view.

    Of several when some are marked.
    """

    async def play(pilot: Pilot[None]) -> None:
        await checked(pilot)
        await pilot.press("f6")
        await until(pilot, lambda: isinstance(pilot.app.screen, ResultsScreen))
        screen = cast(ResultsScreen, pilot.app.screen)
        views = screen.query_one("#views", OptionList)
        await until(pilot, lambda: views.option_count > 1)
        if marked:
            await pilot.press("tab", *["space", "down"] * marked, "tab")
            await pilot.pause(0.5)
        if view is not None:
            await until(pilot, lambda: any(option.id == view for option in views.options))
            views.highlighted = views.get_option_index(view)
        await settled(pilot)

    return play


async def study(pilot: Pilot[None]) -> None:
    await estimated(pilot)
    await node(pilot, "motion")
    await pilot.pause(0.3)
    app_of(pilot).builder.go_to(("operation", "speed"))
    await pilot.pause(0.5)
    await pilot.press("f3")
    await until(pilot, lambda: isinstance(pilot.app.screen, StudyScreen))
    screen = cast(StudyScreen, pilot.app.screen)
    await until(pilot, lambda: screen.is_fine)


async def duty(pilot: Pilot[None]) -> None:
    await estimated(pilot)
    await pilot.press("f4")
    await until(pilot, lambda: isinstance(pilot.app.screen, DutyScreen))
    await pilot.pause(0.3)
    await pilot.press(*"start", "tab", *"30 min", "tab", *"4 k", "tab", "tab", "tab", *"20", "enter")
    await pilot.press("ctrl+n")
    await pilot.pause(0.3)
    await pilot.press(*"work", "tab", *"7.5", "tab", *"1.5 k", "tab", "tab", "tab", "delete")
    await pilot.press("ctrl+n")
    await pilot.pause(0.3)
    await pilot.press(*"rest", "tab", *"16", "tab", "delete", "tab", "tab", *"0 rpm", "f5")
    await settled(pilot)


async def fitting(pilot: Pilot[None]) -> None:
    """Fit the six torques of docs/fit.md."""
    guide = (TARGET.parents[1] / "fit.md").read_text(encoding="utf-8")
    Path("rig.csv").write_text(guide.partition("`rig.csv`:\n\n```\n")[2].partition("```")[0], encoding="utf-8")
    await estimated(pilot)
    await pilot.press("ctrl+f")
    await until(pilot, lambda: isinstance(pilot.app.screen, FitScreen))
    screen = cast(FitScreen, pilot.app.screen)
    await pilot.press(*"rig", "enter", *"loss_f", "enter", *"tau_e", "enter", "f5")
    await until(pilot, lambda: screen.report is not None)
    await settled(pilot)


async def answers(pilot: Pilot[None]) -> None:
    await estimated(pilot)
    await pilot.press("f10")
    await until(pilot, lambda: isinstance(pilot.app.screen, AnswerScreen))
    screen = cast(AnswerScreen, pilot.app.screen)
    await until(pilot, lambda: screen.is_answered)
    await settled(pilot)


async def study_curves(pilot: Pilot[None]) -> None:
    await study(pilot)
    await pilot.press("f5")
    queue = app_of(pilot).queue
    await until(pilot, lambda: queue.runs and queue.runs[-1].is_complete)
    await pilot.press("enter")
    await until(pilot, lambda: isinstance(pilot.app.screen, ResultsScreen))
    views = pilot.app.screen.query_one("#views", OptionList)
    await until(pilot, lambda: views.option_count > 1)
    await pilot.press("down")
    await settled(pilot)


async def no_results(pilot: Pilot[None]) -> None:
    await checked(pilot)
    Path("empty").mkdir(exist_ok=True)
    app_of(pilot).show_result(None, Path("empty"))
    await until(pilot, lambda: pilot.app.screen.query("#title"))
    await until(pilot, lambda: "no result" in str(pilot.app.screen.query_one("#title").render()))


def helped(before: Script) -> Script:
    """Return what leads to the help of a screen."""

    async def play(pilot: Pilot[None]) -> None:
        await before(pilot)
        await pilot.press("f1")

    return play


async def unsaved(pilot: Pilot[None]) -> None:
    await checked(pilot)
    app_of(pilot).builder.draft.set("loads", "axial", value="900 N")
    app_of(pilot).builder.edited()
    await pilot.press("ctrl+q")
    await until(pilot, lambda: isinstance(pilot.app.screen, Ask))


VIEWS = ("load-distribution", "contact-map", "friction-breakdown", "cage-orbit", "capacitance")
_6208, _6319 = "6208-axial-1300", "6319-cp10-1500"
SCENES: dict[str, Scene] = {
    "open": Scene(None, opening),
    "builder": Scene(_6208, builder),
    "builder-light": Scene(_6208, builder, light=True),
    "boundary": Scene("6220-excited", boundary),
    "law": Scene(_6208, law),
    "choice": Scene(_6208, choice),
    "solver": Scene(_6208, solver),
    "mistakes": Scene(None, mistakes),
    "palette": Scene(_6208, palette),
    "bearings": Scene(_6208, bearings),
    "shaft": Scene("box.toml", estimated),
    "estimated": Scene(_6208, estimated_row),
    "oils": Scene(_6208, oils),
    "own-row": Scene(_6208, own_row),
    "run": Scene(_6319, running),
    "run-light": Scene(_6319, running, light=True),
    "no-runs": Scene(_6208, no_runs),
    "results": Scene(_6208, results()),
    "results-light": Scene(_6208, results(), light=True),
    **{view: Scene(_6208, results(view)) for view in VIEWS},
    "comparison": Scene(_6208, results("comparison", marked=2)),
    "differences": Scene(_6208, results("what differs", marked=2)),
    "answers": Scene("box.toml", answers),
    "study": Scene(_6208, study),
    "duty": Scene(_6208, duty),
    "fit": Scene(_6319, fitting),
    "study-curves": Scene(_6208, study_curves),
    "no-results": Scene(_6208, no_results),
    "help": Scene(_6208, helped(builder)),
    "help-run": Scene(_6208, helped(no_runs)),
    "unsaved": Scene(_6208, unsaved),
}


async def shoot(scene: Scene, size: tuple[int, int]) -> str:
    """Return one screen as SVG."""
    app = BuilderApp(scene.case)
    async with app.run_test(size=size) as pilot:
        await pilot.pause(0.2)
        if scene.light:
            app.action_toggle_theme()
        await scene.play(pilot)
        await pilot.pause(0.6)
        picture = app.export_screenshot(title="lambda-bearing gui")
        for run in reversed(app.queue.active):
            run.cancel()
        while app.queue.active:
            app.queue.poll()
            await asyncio.sleep(0.05)
        for run in app.queue.runs:
            shutil.rmtree(run.result) if run.result.is_dir() else run.result.unlink(missing_ok=True)
        return picture


def _block(attributes: str, sign: str, at: float, step: float) -> str:
    """Return a block sign as rectangle.

    It touches its neighbours.
    """
    left, top, width, height = _BLOCKS[sign]
    base, style = re.search(r' y="([\d.]+)"', attributes), re.search(r' class="[^"]+"', attributes)
    assert base is not None
    assert style is not None
    y = float(base[1]) - _RISE + top * _LINE
    place = f'x="{at + left * step:.2f}" y="{y:.2f}"'
    size = f'width="{width * step + 0.3:.2f}" height="{height * _LINE + 0.3:.2f}"'
    return f'<rect{style[0]} {place} {size} shape-rendering="crispEdges"/>'


def placed(svg: str) -> str:
    """Return the picture with placed words.

    Every word has its own place: renderers stretch spaces in their own ways.
    """

    def words(match: re.Match[str]) -> str:
        attributes, text = match.group(1), html.unescape(match.group(2))
        x, length = (re.search(rf' {name}="([\d.]+)"', attributes) for name in ("x", "textLength"))
        if x is None or length is None:
            return match.group(0)
        step = float(length[1]) / max(cell_len(text), 1)
        found = []
        for word in _WORDS.finditer(text):
            at = float(x[1]) + cell_len(text[: word.start()]) * step
            if word[0] in _BLOCKS:
                found.append(_block(attributes, word[0], at, step))
                continue
            own = attributes.replace(length[0], f' textLength="{cell_len(word[0]) * step:.1f}"')
            found.append(f"<text{own.replace(x[0], f' x={chr(34)}{at:.2f}{chr(34)}')}>{html.escape(word[0])}</text>")
        return "".join(found)

    return re.sub(r"<text([^>]*)>([^<]*)</text>", words, svg).replace("Fira Code", "DejaVu Sans Mono")


def write(svg: str, target: Path, width: int) -> None:
    """Write a picture as small PNG.

    Few colours, and the same where nothing has changed.
    """
    from PIL import Image

    done = subprocess.run(
        ["rsvg-convert", "-w", str(width)], input=placed(svg).encode(), check=True, capture_output=True
    )
    picture = Image.open(io.BytesIO(done.stdout)).convert("RGB")
    picture.quantize(128, dither=Image.Dither.NONE).save(target, optimize=True)


def main() -> None:
    """Draw the screens named on the command line, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", metavar="SCREEN", help=f"one of {', '.join(SCENES)}; all without")
    parser.add_argument("--to", type=Path, default=TARGET)
    parser.add_argument("--size", choices=SIZES, action="append")
    wanted = parser.parse_args()
    target = wanted.to.resolve()
    target.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.environ["LAMBDA_BEARING_DATA"] = str(Path(folder) / "data")
        start = ["init", "box", "--template", "geared-shaft"]
        subprocess.run([sys.executable, "-m", "lambda_cli", *start], check=True, capture_output=True)
        for case in (_6319, "6208-axial-2000", _6208):
            command = [sys.executable, "-m", "lambda_cli", "run", case, "--quiet"]
            subprocess.run(command, check=True, capture_output=True)
        for name in wanted.names or SCENES:
            for size in wanted.size or SIZES:
                file = target / f"{name}-{size}.png"
                write(asyncio.run(shoot(SCENES[name], SIZES[size])), file, 9 * SIZES[size][0])
                print(file.name, flush=True)


if __name__ == "__main__":
    main()
