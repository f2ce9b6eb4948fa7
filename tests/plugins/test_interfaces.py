"""Test that all user interfaces show example packages.

None of them has a line of code for a package.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from .conftest import Installation

ROOT = Path(__file__).parents[2]
PACKAGES = ("limiting-shear", "northwind-bearings")
CHANGES = (
    "bearing.designation=NW6208", "bearing.maker=Northwind", "lubricant.name=northwind-spindle",
    "loads.axial=0 N", "loads.radial=2 kN", "models.traction=gecim-winer", "parameters.traction.slope=0.06",
)  # fmt: skip

# Drives the builder by keyboard in a process that sees the packages; prints what it saw.
BUILDER = """
import asyncio, json, sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from driving import HAND_WRITTEN, LARGE, builder, checked, go_to, hear_every_key, screen_text, wait_for, write
from lambda_gui.app import BuilderApp
from lambda_gui.catalogue import CatalogueScreen
from lambda_gui.choice import PickList
from lambda_gui.results_screen import ResultsScreen
from textual.widgets import DataTable, OptionList
import pytest

hear_every_key(pytest.MonkeyPatch())
Path("case.toml").write_text(HAND_WRITTEN, encoding="utf-8")
seen = {}

async def drive():
    async with BuilderApp("case.toml").run_test(size=LARGE) as pilot:
        await checked(pilot)
        await go_to(pilot, "models.traction")
        await pilot.press("enter")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, PickList))
        seen["laws"] = screen_text(pilot.app)
        await pilot.press("escape")
        builder(pilot).draft.set("models", "traction", value="gecim-winer")
        await checked(pilot)
        await wait_for(pilot, lambda: "slope" in screen_text(pilot.app))
        seen["law"] = screen_text(pilot.app)
        seen["problems"] = [str(problem) for problem in builder(pilot).check.problems]
        await pilot.press("f2")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, CatalogueScreen))
        await write(pilot, "northwind")
        await wait_for(pilot, lambda: "NW6208" in screen_text(pilot.app))
        seen["catalogue"] = screen_text(pilot.app)
        await pilot.press("escape")
        pilot.app.push_screen(ResultsScreen(Path.cwd(), Path("run.h5")))
        await wait_for(pilot, lambda: pilot.app.screen.query("#views"))
        views = pilot.app.screen.query_one("#views", OptionList)
        await wait_for(pilot, lambda: views.option_count > 5)
        names = [str(views.get_option_at_index(i).id) for i in range(views.option_count)]
        views.highlighted = next(i for i, name in enumerate(names) if "load-share" in name)
        await wait_for(pilot, lambda: "Stribeck, no clearance" in screen_text(pilot.app))
        seen["view"] = screen_text(pilot.app)

asyncio.run(drive())
print(json.dumps(seen))
"""


@pytest.fixture(scope="module")
def site(install: Callable[..., Installation]) -> Installation:
    return install([ROOT / "examples" / name for name in PACKAGES])


@pytest.fixture(scope="module")
def run(site: Installation, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a short run with foreign law.

    The maker's bearing and oil with the stranger's law.
    """
    path = tmp_path_factory.mktemp("foreign") / "run.h5"
    changes = [word for change in CHANGES for word in ("--set", change)]
    answer = site.program("run", "6208-axial-1300", *changes, "--duration", "4 ms", "--quiet", "--out", str(path))
    assert answer.code == 5, answer.err  # a few milliseconds cannot converge
    return path


@pytest.mark.full
@pytest.mark.timeout(900)
def test_in_the_builder(site: Installation, run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(run.parent)
    answer = site.forked(BUILDER, str(ROOT / "tests" / "gui"), LAMBDA_BEARING_DATA=str(run.parent / "data"))
    assert answer.code == 0, answer.err[-3000:]
    seen = answer.data
    assert "gecim-winer  (limiting-shear 0.1.0)" in seen["laws"]
    assert "from limiting-shear 0.1.0" in seen["law"]
    assert "Gecim" in seen["law"], "the reference of the law"
    assert seen["problems"] == []
    assert "Northwind" in seen["catalogue"]
    assert "Load share" in seen["view"]


@pytest.mark.full
@pytest.mark.timeout(900)
def test_in_the_report(site: Installation, run: Path) -> None:
    page = run.with_suffix(".html")
    answer = site.program("report", str(run), "--full", "--out", str(page))
    assert answer.code == 0, answer.err
    text = page.read_text(encoding="utf-8").replace("<wbr>", "")
    for words in (
        "gecim-winer", "Gecim", "limiting-shear 0.1.0", "NW6208", "northwind-spindle", "Load share",
        "Northwind example data",
    ):  # fmt: skip
        assert words in text, words


@pytest.mark.full
@pytest.mark.timeout(900)
def test_on_the_command_line(site: Installation, run: Path) -> None:
    views = site.program("view", "--list")
    assert "load-share" in views.out, views.err
    drawn = site.program("view", str(run), "load-share", "--out", str(run.parent), "--format", "svg")
    assert drawn.code == 0, drawn.err
    assert (run.parent / "run-load-share.svg").stat().st_size > 1000
    changes = [word for change in CHANGES for word in ("--set", change)]
    compared = site.program("compare", "6208-axial-1300", *changes, "--result", str(run), "--json")
    assert compared.code == 0, compared.err
    assert "stribeck" in {table["name"] for table in compared.data["methods"]}
    cited = site.program("cite", str(run))
    assert "traction/gecim-winer" in cited.out
    assert "[limiting-shear 0.1.0]" in cited.out
