"""Keep tests away from the user's own catalogue and cache."""

from __future__ import annotations

import gc
import os
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from hypothesis import settings

# Helpers of all tests are modules next to this file.
sys.path.insert(0, str(Path(__file__).parent))

from second_try import DURATIONS

# The same examples on every day: a suite that finds another fault by luck says nothing about the change it is run for.
# What is drawn anew each time are the campaigns of tests/attacks.
settings.register_profile("suite", derandomize=True, max_examples=40)
settings.load_profile("suite")

# What takes longest comes first: one file of half a minute at the end keeps one process while the others are done.
# Where times are kept of an earlier run (tests/second_try.py), they decide; elsewhere this list.
LONGEST = (
    "tests/studies/test_session.py",
    "tests/studies/test_examples.py",
    "tests/cli/test_imports.py",
    "tests/cli/test_roller_command.py",
    "tests/fitting/test_band.py",
    "tests/docs/test_examples.py",
    "tests/studies/test_workers.py",
    "tests/fitting/test_measured.py",
    "tests/cli/test_view_study_report_commands.py",
    "tests/report/test_page.py",
    "tests/electric/test_machine_electric.py",
    "tests/fmu/test_fmu.py",
    "tests/plugins/test_tutorial.py",
    "tests/thermal/test_machine_network.py",
    "tests/fitting/test_fit_case.py",
    "tests/machines/test_every_question.py",
    "tests/plugins/test_installed.py",
    "tests/gui/test_nothing_is_cut.py",
    "tests/gui/test_studies.py",
    "tests/gui/test_runs.py",
    "tests/gui/test_builder.py",
    "tests/syla2026/test_full_path.py",
    "tests/machines/test_motion.py",
    "tests/case/test_short_form.py",
    "tests/docs/test_reference.py",
    "tests/views/test_figures.py",
    "tests/plugins/",
    "tests/gui/",
    "tests/runs/",
    "tests/fitting/",
    "tests/electric/",
    "tests/thermal/",
    "tests/trust/",
    "tests/discovery/",
    "tests/db/",
    "tests/literature/test_models_surface.py",
    "tests/report/",
    "tests/cli/",
    "tests/syla2026/",
    "tests/views/",
    "tests/benchmarks/",
    "tests/machines/",
    "tests/solver/",
)

if TYPE_CHECKING:
    from lambda_db.catalogue import SqlCatalogue
    from warm import Warm

    from lambda_core.results.reader import Result


def pytest_configure() -> None:
    """Collect garbage seldom.

    Each pass over all loaded objects takes a third of the time of some tests.
    """
    gc.set_threshold(100_000, 50, 50)


def pytest_collection_finish() -> None:
    """Take what has been collected as there to stay."""
    gc.freeze()


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Put the longest files first."""
    cache = getattr(config, "cache", None)  # there is none with -p no:cacheprovider
    known = {} if cache is None else cache.get(DURATIONS, {})
    seconds: Counter[Path] = Counter()
    for item in items:
        seconds[item.path] += known.get(item.nodeid, 0.0)
    items.sort(key=lambda item: (-seconds[item.path], [not item.nodeid.startswith(name) for name in LONGEST]))


@pytest.fixture(scope="session", autouse=True)
def own_folders(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Point cache and user data at test folders.

    Compiled code is kept in pytest's own cache: it is named by its content, and compiling anew in every session and in
    every worker would take longer than the tests. Without that cache it is kept where the environment says.
    """
    root = tmp_path_factory.mktemp("lambda-bearing")
    cache = getattr(request.config, "cache", None)
    folder = root.joinpath if cache is None else cache.mkdir
    with pytest.MonkeyPatch.context() as patch:
        named = os.environ.get("LAMBDA_BEARING_CACHE") if cache is None else None
        patch.setenv("LAMBDA_BEARING_CACHE", named or str(folder("lambda-bearing")))
        patch.setenv("LAMBDA_BEARING_DATA", str(root / "data"))
        patch.setenv("MPLCONFIGDIR", str(folder("matplotlib")))  # the list of this machine's fonts
        yield root


@pytest.fixture
def user_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Give this test an empty user folder.

    It is for the user's own catalogue.
    """
    folder = tmp_path / "data"
    monkeypatch.setenv("LAMBDA_BEARING_DATA", str(folder))
    return folder


@pytest.fixture
def catalogue(user_folder: Path) -> Iterator[SqlCatalogue]:
    """Open the built-in catalogue without user rows."""
    from lambda_db.catalogue import open_catalogue

    opened = open_catalogue()
    yield opened
    opened.close()


@pytest.fixture(scope="session")
def warm(own_folders: Path, shared_folder: Path) -> Iterator[Warm]:
    """Start programs without waiting for their imports."""
    from warm import Warm

    server = Warm(shared_folder)
    yield server
    server.close()


@pytest.fixture(scope="session")
def shared_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder of all processes of this session."""
    from made_once import CAN_SHARE

    base = tmp_path_factory.getbasetemp()
    return base.parent if CAN_SHARE and "PYTEST_XDIST_WORKER" in os.environ else base


@pytest.fixture(scope="session")
def once(shared_folder: Path) -> Callable[[str, Callable[[Path], object]], Path]:
    """Return a function that fills a folder.

    Once for all processes of this session; nobody changes it later.
    """
    from made_once import made_once

    return lambda name, fill: made_once(shared_folder / "once" / name, fill)


@pytest.fixture(scope="session")
def radial_run(once: Callable[[str, Callable[[Path], object]], Path]) -> Result:
    """Run the 6319 under radial load.

    Until it has converged; views and reports are drawn from it.
    """
    from lambda_core import api

    return api.result(once("radial", lambda to: api.run("6319-cp10-1500", out=to / "radial.h5")) / "radial.h5")


@pytest.fixture(scope="session")
def combined_run(once: Callable[[str, Callable[[Path], object]], Path]) -> Result:
    """Run the 6208 under combined load.

    For a short time: every ball loaded, contact angles of 15 degrees.
    """
    from lambda_core import api

    changes = ["loads.radial=0.4 kN", "solver.duration=0.05 s"]
    folder = once("combined", lambda to: api.run("6208-axial-1300", changes, out=to / "combined.h5"))
    return api.result(folder / "combined.h5")
