"""Test the core database.

Built once, found by the seeds' hash, built again when damaged, never required to be on disk.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from lambda_db import build
from lambda_db.built import BUILT_IN, fingerprint
from lambda_db.catalogue import open_catalogue
from lambda_db.engine import WRITTEN
from lambda_db.models import Base
from lambda_db.paths import cache_folder
from lambda_db.shadows import shadows

from lambda_core.domain.errors import CatalogueError

if TYPE_CHECKING:
    from warm import Warm


@pytest.fixture
def cache(tmp_path: Path, user_folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "cache"
    monkeypatch.setenv("LAMBDA_BEARING_CACHE", str(folder))
    return folder


@pytest.fixture
def built(user_folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the built database in its cache.

    It is alone in a cache of this test, and comes from the cache of all tests.
    """
    open_catalogue().close()
    (found,) = cache_folder().glob(f"catalogue-{fingerprint([BUILT_IN])}-*.sqlite")
    folder = tmp_path / "cache"
    folder.mkdir()
    monkeypatch.setenv("LAMBDA_BEARING_CACHE", str(folder))
    return Path(shutil.copy(found, folder))


def test_built_once_and_named_by_the_seeds(cache: Path) -> None:
    open_catalogue().close()
    (built,) = cache.iterdir()
    assert built.name.startswith(f"catalogue-{fingerprint([BUILT_IN])}-")
    written = built.stat().st_mtime_ns
    open_catalogue().close()
    (again,) = cache.iterdir()
    assert again.stat().st_mtime_ns == written


def test_the_name_follows_every_seed(tmp_path: Path) -> None:
    folder = tmp_path / "seeds"
    folder.mkdir()
    (folder / "alias.csv").write_text("kind,alias,name\n", encoding="utf-8")
    first = fingerprint([BUILT_IN, folder])
    (folder / "alias.csv").write_text("kind,alias,name\ncage,x,pa66\n", encoding="utf-8")
    assert fingerprint([BUILT_IN, folder]) != first


def nothing_left(content: bytes) -> bytes:
    return b""


def cut_short(content: bytes) -> bytes:
    return content[: len(content) // 2]


def pages_lost(content: bytes) -> bytes:
    return content[:4096] + os.urandom(20000 - 4096) + content[20000:]


def one_number_changed(content: bytes) -> bytes:
    place = content.index(b"6208SKF")
    return content[:place] + b"6209" + content[place + 4 :]


@pytest.mark.full
@pytest.mark.parametrize("damage", [nothing_left, cut_short, pages_lost, one_number_changed])
def test_c3_a_damaged_cache_of_the_catalogue_is_built_again(
    damage: Callable[[bytes], bytes], built: Path, caplog: pytest.LogCaptureFixture
) -> None:
    complete = built.read_bytes()
    built.write_bytes(damage(complete))
    catalogue = open_catalogue()
    assert catalogue.bearing("6208", "SKF")
    assert "is damaged; building it again" in caplog.text
    catalogue.close()
    (again,) = built.parent.iterdir()
    assert len(again.read_bytes()) == len(complete)


def test_no_cache_folder_means_in_memory(
    cache: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    cache.write_text("a file where the folder should be", encoding="utf-8")
    catalogue = open_catalogue()
    assert catalogue.bearing("6208", "NSK").layer == "core"
    assert catalogue.clearance(0.04, "CN")
    assert "building it in memory" in caplog.text
    catalogue.close()


def test_only_the_last_databases_are_kept(cache: Path) -> None:
    cache.mkdir()
    for i in range(12):
        path = cache / f"catalogue-{i:016d}.sqlite"
        path.touch()
        os.utime(path, (i, i))
    open_catalogue().close()
    assert len(list(cache.glob("catalogue-*.sqlite"))) == 8
    assert list(cache.glob(f"catalogue-{fingerprint([BUILT_IN])}-*.sqlite"))


FIRST_USE = "from lambda_db.catalogue import open_catalogue; print(len(open_catalogue().bearings(limit=1000)))"


@pytest.mark.full
def test_four_first_uses_at_once(cache: Path, warm: Warm) -> None:
    warm.ready()
    running = [warm.start(FIRST_USE) for _ in range(4)]
    assert [(*process.communicate(), process.returncode) for process in running] == [("751\n", "", 0)] * 4
    assert [path.suffix for path in cache.iterdir()] == [".sqlite"]


PLUGIN_BEARING = (
    "designation,maker,bore_diameter_mm,outside_diameter_mm,width_mm,dimensions_source,dimensions_grade\n"
    "6208,NSK,40,80,18,a plugin,B\n7208,ACME,40,80,18,a plugin,B\n"
)


@pytest.fixture
def plugin(tmp_path: Path) -> Path:
    folder = tmp_path / "plugin"
    folder.mkdir()
    (folder / "bearing.csv").write_text(PLUGIN_BEARING, encoding="utf-8")
    (folder / "lubricant_parameter.csv").write_text(
        "lubricant,role,model,name,value,unit,source,grade\n"
        "FVA3,traction,new-law,k,1.5,,a plugin,B\nFVA3,traction,ree-eyring,tau_eyring,9,MPa,a plugin,B\n",
        encoding="utf-8",
    )
    return folder


def test_plugin_rows_stand_in_front_of_the_core(cache: Path, plugin: Path) -> None:
    catalogue = open_catalogue([plugin])
    assert catalogue.bearing("7208").layer == "plugin"
    assert catalogue.bearing("6208", "NSK").layer == "plugin"
    assert catalogue.bearing("6208", "NSK").candidates == ()
    assert len(catalogue.bearings("6208")) == 4
    traction = catalogue.lubricant("FVA3").parameters["traction"]
    assert traction["new-law"]["k"].value == 1.5
    assert set(traction["ree-eyring"]) == {"tau_eyring"}
    assert traction["ree-eyring"]["tau_eyring"].value == 9
    catalogue.close()
    without = open_catalogue()
    assert without.bearing("6208", "NSK").layer == "core"
    without.close()


def test_user_rows_stand_in_front_of_plugins(cache: Path, plugin: Path) -> None:
    from lambda_db.transfer import add_row

    catalogue = open_catalogue([plugin])
    cells = {"designation": "7208", "maker": "ACME", "bore_diameter": "40 mm", "outside_diameter": "80 mm"}
    add_row(catalogue, "bearing", cells | {"width": "18 mm", "source": "mine", "grade": "A"})
    assert catalogue.bearing("7208").layer == "user"
    assert len(catalogue.bearings("7208 ACME")) == 1
    catalogue.close()


def test_a_bad_plugin_folder_names_every_bad_row(cache: Path, plugin: Path) -> None:
    with (plugin / "bearing.csv").open("a", encoding="utf-8") as stream:
        stream.write("B1,ACME,80,40,18,a plugin,B\nB2,ACME,x,40,18,a plugin,B\n")
    with pytest.raises(CatalogueError) as error:
        open_catalogue([plugin])
    assert "bearing.csv line 4" in str(error.value)
    assert "bearing.csv line 5" in str(error.value)
    assert list(cache.glob("*.sqlite")) == []
    assert list(cache.glob("*.tmp")) == []


def test_a_missing_plugin_folder_is_named(cache: Path, tmp_path: Path) -> None:
    with pytest.raises(CatalogueError, match="not a folder"):
        open_catalogue([tmp_path / "nowhere"])


def test_statements_are_written_once_for_all_openings(user_folder: Path) -> None:
    """Write the catalogue's statements only once.

    Each check of a case opens the catalogue, and writing the statements takes as long as running them.
    """
    for opening in range(2):
        catalogue = open_catalogue()
        assert catalogue.bearings("6208")
        catalogue.close()
        if opening == 0:
            written = set(WRITTEN.keys())
    assert written
    assert set(WRITTEN.keys()) == written


@pytest.mark.clock
def test_opening_is_quick(cache: Path) -> None:
    """Open the catalogue within a few milliseconds.

    The limit allows for a loaded machine; the best of five tries counts.
    """
    open_catalogue().close()
    best = 1.0
    for _ in range(5):
        started = time.perf_counter()
        open_catalogue().close()
        best = min(best, time.perf_counter() - started)
    assert best < 0.3


def test_no_seed_is_read_where_no_plugin_brings_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[Path] = []
    monkeypatch.setattr("lambda_db.shadows._built_in", lambda: read.append(BUILT_IN) or ())
    assert shadows(()) == ()
    assert not read


def test_the_hook_is_light() -> None:
    code = "import sys, lambda_db.hooks; print([m for m in ('sqlalchemy', 'scipy', 'numba') if m in sys.modules])"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "[]"


def test_paths_come_from_the_environment(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert cache_folder() == cache
    monkeypatch.delenv("LAMBDA_BEARING_CACHE")
    assert "lambda-bearing" in str(cache_folder())


def test_on_windows_a_catalogue_that_another_process_reads_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Keep an open catalogue, which Windows cannot replace.

    The file has the name of a digest, so that its content is the same anyway.
    """
    monkeypatch.setattr(build, "fill", lambda connection, folders: Base.metadata.create_all(connection))
    first = build.build_file(tmp_path, "catalogue-x", [])

    def refused(source: str | Path, target: str | Path) -> None:
        raise PermissionError(13, "the process cannot access the file because it is being used by another process")

    monkeypatch.setattr(os, "replace", refused)
    assert build.build_file(tmp_path, "catalogue-x", []) == first
    assert [path.name for path in tmp_path.iterdir()] == [first.name]
    first.unlink()
    with pytest.raises(PermissionError):
        build.build_file(tmp_path, "catalogue-x", [])
