"""Test the user's own rows.

In front of the built-in ones, safe with several writers, harmless when damaged.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import sqlite3
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from lambda_cli.main import main
from lambda_db import overlay, user
from lambda_db.catalogue import SqlCatalogue, open_catalogue
from lambda_db.paths import user_database
from lambda_db.transfer import add_row, export_rows, rows_of
from sqlalchemy.exc import OperationalError

from lambda_core import api
from lambda_core.domain.errors import CatalogueError
from lambda_core.model.bearing_model import BearingModel

if TYPE_CHECKING:
    from conftest import Meanwhile
    from warm import Warm

ROW: dict[str, object] = {
    "designation": "6208",
    "maker": "NSK",
    "bore_diameter": "40 mm",
    "outside_diameter": "80 mm",
    "width": "18 mm",
    "source": "my own drawing",
    "grade": "B",
}
NAME = "6208'); DROP TABLE bearing; --"


def test_a_user_row_stands_in_front(catalogue: SqlCatalogue) -> None:
    add_row(catalogue, "bearing", ROW | {"mass": "0.4 kg"})
    mine = catalogue.bearing("6208", "NSK")
    assert mine.layer == "user"
    assert mine.mass is not None
    assert mine.mass.value == 0.4
    assert mine.dynamic_rating is None, "nothing of the row behind it shines through"
    assert mine.candidates == ()
    assert [row.maker for row in catalogue.bearings("6208", 10)] == ["KOYO", "NSK", "SKF", "Syla2026"]
    assert catalogue.bearing("6208", "SKF").layer == "core"


def test_another_case_of_the_key_is_the_same_key(catalogue: SqlCatalogue) -> None:
    add_row(catalogue, "bearing", ROW | {"maker": "nsk"})
    assert catalogue.bearing("6208", "NSK").layer == "user"
    with pytest.raises(CatalogueError, match="you have a row with this key already; --replace"):
        add_row(catalogue, "bearing", ROW)
    assert add_row(catalogue, "bearing", ROW, replace=True).replaced == {"bearing": 1}


def test_missing_inner_geometry_is_estimated(catalogue: SqlCatalogue) -> None:
    rated = {"dynamic_rating": "29.1 kN", "static_rating": "17.9 kN", "rating_type": "ISO 281"}
    add_row(catalogue, "bearing", ROW | rated | {"maker": "FAG"})
    row = catalogue.bearing("6208", "FAG")
    assert row.ball_count is not None
    assert row.ball_diameter is not None
    assert (row.ball_count.value, row.ball_count.status) == (9, "derived")
    assert row.ball_diameter.value == pytest.approx(11.906e-3, rel=1e-12)
    assert row.groove_radius_inner is not None
    assert row.groove_radius_inner.status == "assumed"
    assert len(row.candidates) == 5


def test_parameters_of_a_third_law_join_a_built_in_oil(catalogue: SqlCatalogue) -> None:
    cells = {"lubricant": "FVA3", "role": "traction", "model": "my-law", "name": "k", "value": 3.5, "unit": ""}
    add_row(catalogue, "lubricant_parameter", cells | {"source": "own test", "grade": "B"})
    oil = catalogue.lubricant("FVA3")
    assert oil.parameters["traction"]["my-law"]["k"].value == 3.5
    assert "tau_eyring" in oil.parameters["traction"]["ree-eyring"]


def test_an_own_set_of_parameters_replaces_the_complete_set(catalogue: SqlCatalogue) -> None:
    cells = {"lubricant": "FVA3", "role": "traction", "model": "ree-eyring", "name": "tau_eyring"}
    add_row(catalogue, "lubricant_parameter", cells | {"value": 8, "unit": "MPa", "source": "own test", "grade": "B"})
    own = catalogue.lubricant("FVA3").parameters["traction"]["ree-eyring"]
    assert {name: p.value for name, p in own.items()} == {"tau_eyring": 8.0}


MEASURED = {
    "lubricant": "FVA3",
    "role": "traction",
    "model": "ree-eyring",
    "name": "tau_eyring",
    "value": 8,
    "unit": "MPa",
    "source": "own test",
    "grade": "B",
    "status": "measured",
}


def test_a_value_of_ones_own_is_a_measured_one(catalogue: SqlCatalogue, capsys: pytest.CaptureFixture[str]) -> None:
    """Keep the status in catalogue, case and results."""
    add_row(catalogue, "bearing", ROW | {"status": "measured", "mass": "0.4 kg", "dynamic_rating": "33 kN"})
    add_row(catalogue, "lubricant_parameter", MEASURED)
    rating = catalogue.bearing("6208", "NSK").dynamic_rating
    assert rating is not None
    assert rating.status == "measured"
    catalogue.close()
    model = api.check("6208-axial-1300", ["lubricant.name=FVA3"])
    assert isinstance(model, BearingModel)
    (stress,) = [one for one in model.values if one.path == "forces.ball_inner.parameters.traction.tau_eyring"]
    assert (stress.value, stress.status) == ("8 MPa", "measured")
    assert "own test, measured, grade B" in stress.source
    assert main(["db", "show", "FVA3"]) == 0
    assert "measured  B      own test" in capsys.readouterr().out


def test_a_catalogue_without_measured_values_takes_them(
    catalogue: SqlCatalogue, caplog: pytest.LogCaptureFixture
) -> None:
    """Migrate version 7 without renewing its seal."""
    add_row(catalogue, "lubricant_parameter", {**MEASURED, "status": None})
    catalogue.close()
    with sqlite3.connect(user_database()) as connection:
        columns = "lubricant, role, model, name, value, unit, source, grade"
        connection.execute(f"CREATE TABLE older AS SELECT {columns} FROM lubricant_parameter")
        connection.execute("DROP TABLE lubricant_parameter")
        connection.execute("ALTER TABLE older RENAME TO lubricant_parameter")
        connection.execute("PRAGMA user_version = 7")
    again = open_catalogue()
    assert again.lubricant("FVA3").parameters["traction"]["ree-eyring"]["tau_eyring"].status is None
    add_row(again, "lubricant_parameter", MEASURED, replace=True)
    assert again.lubricant("FVA3").parameters["traction"]["ree-eyring"]["tau_eyring"].status == "measured"
    again.close()
    assert not caplog.text


def test_sql_in_a_name_stays_a_name(catalogue: SqlCatalogue) -> None:
    add_row(catalogue, "bearing", ROW | {"designation": NAME, "maker": 'a"b;--'})
    assert catalogue.bearing(NAME).maker == 'a"b;--'
    assert [row.designation for row in catalogue.bearings(NAME.split()[0], 5)] == [NAME]
    assert len(catalogue.bearings("6208", 50)) == 5
    assert catalogue.bearings("%", 50) == []  # a wildcard of LIKE is a letter here


WRITER = """
import sys
from lambda_db.catalogue import open_catalogue
from lambda_db.transfer import add_row
catalogue = open_catalogue()
for i in range(25):
    add_row(catalogue, "bearing", {"designation": f"P{sys.argv[1]}-{i}", "maker": "test", "bore_diameter": "40 mm",
            "outside_diameter": "80 mm", "width": "18 mm", "source": "test", "grade": "B"})
"""


@pytest.mark.full
def test_four_processes_adding_rows_lose_none(user_folder: Path, tmp_path: Path, warm: Warm) -> None:
    """Start four writers together on an empty folder.

    They build the core database and create the user's at the same moment.
    """
    warm.ready()
    running = [warm.start(WRITER, str(n), env={"LAMBDA_BEARING_CACHE": str(tmp_path / "cache")}) for n in range(4)]
    outcomes = [(process.communicate()[1], process.returncode) for process in running]
    assert outcomes == [("", 0)] * 4
    catalogue = open_catalogue()
    assert len(catalogue.bearings("maker=test", 1000)) == 100
    catalogue.close()


def test_a_writer_holds_the_write_lock_before_its_first_row(user_folder: Path) -> None:
    """Keep a second writer out from the beginning.

    A transaction that first reads fails where another has written before it writes.
    """
    engine = user.open_user_database(user_database())
    with contextlib.closing(sqlite3.connect(user_database(), timeout=0.0, isolation_level=None)) as other:
        with engine.begin(), pytest.raises(sqlite3.OperationalError, match="locked"):
            other.execute("BEGIN IMMEDIATE")
        other.execute("BEGIN IMMEDIATE")
    engine.dispose()


def test_a_reader_sees_rows_written_meanwhile(catalogue: SqlCatalogue) -> None:
    add_row(catalogue, "bearing", ROW)
    other = open_catalogue()
    add_row(other, "bearing", ROW | {"designation": "X2"})
    other.close()
    assert catalogue.bearing("X2").layer == "user"


def test_a_row_added_while_the_catalogue_is_opened_is_no_foreign_change(
    catalogue: SqlCatalogue, meanwhile: Meanwhile, caplog: pytest.LogCaptureFixture
) -> None:
    """Commit rows from another connection during each opening.

    Each row comes before the opener reads the user's bearings.
    """
    add_row(catalogue, "bearing", ROW)
    names = ["6208"]

    def add() -> None:
        names.append(f"N{len(names)}")
        add_row(catalogue, "bearing", ROW | {"designation": names[-1]})

    with meanwhile(" FROM user.bearing", add):
        other = open_catalogue()
    assert len(names) > 1
    assert caplog.records == []
    assert [row["designation"] for row in rows_of(other, "bearing", mine=True)] == names
    other.close()


@pytest.mark.parametrize("leftovers", [(), ("-wal", "-shm")], ids=["alone", "with the log's files"])
def test_c3_an_emptied_file_is_named(
    leftovers: tuple[str, ...], catalogue: SqlCatalogue, caplog: pytest.LogCaptureFixture
) -> None:
    add_row(catalogue, "bearing", ROW)
    catalogue.close()
    user_database().write_bytes(b"")
    for ending in leftovers:
        user_database().with_name(user_database().name + ending).touch()
    again = open_catalogue()
    assert "it is empty" in caplog.text
    assert again.bearing("6208", "NSK").layer == "core"
    again.close()


@pytest.mark.parametrize("content", [b"this is no database", b"SQLite format 3\x00" + bytes(range(256)) * 40])
def test_a_damaged_file_leaves_the_core_working(
    user_folder: Path, content: bytes, caplog: pytest.LogCaptureFixture
) -> None:
    user_folder.mkdir()
    user_database().write_bytes(content)
    catalogue = open_catalogue()
    assert catalogue.bearing("6208", "SKF").layer == "core"
    open_catalogue().close()
    assert caplog.text.count("cannot be read") == 1
    assert "only the built-in catalogue is used" in caplog.text
    with pytest.raises(CatalogueError, match=r"(?s)catalogue.sqlite.*the file is damaged .*move it away"):
        add_row(catalogue, "bearing", ROW)
    catalogue.close()


def test_a_file_cut_short_leaves_the_core_working(catalogue: SqlCatalogue, caplog: pytest.LogCaptureFixture) -> None:
    for i in range(40):
        add_row(catalogue, "bearing", ROW | {"designation": f"N{i}"})
    path = user_database()
    copy = path.with_name("copy.sqlite")
    with sqlite3.connect(path) as complete, sqlite3.connect(copy) as target:
        complete.backup(target)
    catalogue.close()
    content = copy.read_bytes()
    shutil.rmtree(path.parent)
    path.parent.mkdir()
    path.write_bytes(content[: len(content) // 2])
    again = open_catalogue()
    assert again.bearing("6208", "SKF").layer == "core"
    assert "cannot be read" in caplog.text
    again.close()


@pytest.mark.parametrize(
    ("found", "put"),
    [(b"my own drawing", b"my \xc3wn drawing"), (b"bearing", b"b\xffaring"), (b"mass_kg", b"mast_kg")],
    ids=["text", "table", "column"],
)
def test_c3_flipped_bytes_are_named_and_leave_the_core_working(
    found: bytes, put: bytes, catalogue: SqlCatalogue, caplog: pytest.LogCaptureFixture
) -> None:
    add_row(catalogue, "bearing", ROW)
    catalogue.close()
    path = user_database()
    with contextlib.closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA journal_mode = DELETE")
    content = path.read_bytes()
    assert found in content
    path.write_bytes(content.replace(found, put))
    again = open_catalogue()
    assert again.bearing("6208", "NSK").layer == "core"
    (said,) = [record.getMessage() for record in caplog.records]
    assert str(path) in said
    assert "cannot be read" in said
    assert "move it away and import your rows again" in said
    with pytest.raises(CatalogueError, match=r"the file is damaged .*move it away"):
        add_row(again, "bearing", ROW | {"designation": "X9"})
    with pytest.raises(CatalogueError, match="nothing is exported"):
        export_rows(again, path.with_name("mine.toml"), ["bearing"], mine=True)
    again.close()


def test_a_newer_schema_is_left_alone(catalogue: SqlCatalogue, caplog: pytest.LogCaptureFixture) -> None:
    add_row(catalogue, "bearing", ROW)
    catalogue.close()
    with sqlite3.connect(user_database()) as connection:
        connection.execute("PRAGMA user_version = 99")
    again = open_catalogue()
    assert again.bearing("6208", "NSK").layer == "core"
    assert "written by a newer version of this program" in caplog.text
    with pytest.raises(CatalogueError, match="newer version"):
        add_row(again, "bearing", ROW | {"designation": "X9"})
    again.close()


def test_an_older_schema_is_migrated(catalogue: SqlCatalogue) -> None:
    """Migrate versions 1 and 2.

    Version 1 had no table of suffixes, version 2 no seal.
    """
    add_row(catalogue, "bearing", ROW)
    catalogue.close()
    with sqlite3.connect(user_database()) as connection:
        connection.execute("DROP TABLE suffix")
        connection.execute("DROP TABLE seal")
        connection.execute("PRAGMA user_version = 1")
    again = open_catalogue()
    assert again.bearing("6208", "NSK").layer == "user"
    add_row(again, "suffix", {"written": "QQ7", "kind": "cage", "meaning": "brass cage", "value": "brass-machined"})
    assert {suffix.written for suffix in again.suffixes()} >= {"QQ7", "C3"}
    with sqlite3.connect(user_database()) as connection:
        assert connection.execute("PRAGMA user_version").fetchone() == (user.SCHEMA_VERSION,)
    again.close()


@pytest.fixture
def unprivileged_folder(monkeypatch: pytest.MonkeyPatch) -> object:
    """Return a folder with effective file modes.

    The tests may run as root.
    """
    folder = Path(tempfile.mkdtemp(dir="/tmp"))
    folder.chmod(0o755)
    monkeypatch.setenv("LAMBDA_BEARING_DATA", str(folder / "data"))
    (folder / "data").mkdir()
    if os.geteuid() == 0:
        os.chown(folder / "data", 65534, 65534)
    yield folder
    shutil.rmtree(folder)


@pytest.mark.skipif(os.name != "posix", reason="needs file modes")
def test_a_read_only_file_gives_a_clear_message(unprivileged_folder: Path) -> None:
    catalogue = open_catalogue()
    add_row(catalogue, "bearing", ROW)  # also loads everything that is imported late
    catalogue.close()
    data = unprivileged_folder / "data"
    for path in (*data.iterdir(), data):
        path.chmod(0o555 if path.is_dir() else 0o444)
    privileged = os.geteuid() == 0
    reader = open_catalogue()
    if privileged:
        os.seteuid(65534)
    try:
        reader.refresh()
        assert reader.bearing("6208", "NSK").layer == "user", "reading goes on"
        with pytest.raises(CatalogueError, match="read-only; make it writable or set LAMBDA_BEARING_DATA"):
            add_row(reader, "bearing", ROW | {"designation": "X2"})
        assert reader.bearing("6208", "SKF").layer == "core"
    finally:
        if privileged:
            os.seteuid(0)
        reader.close()
        data.chmod(0o755)


def _edit(statement: str) -> None:
    with contextlib.closing(sqlite3.connect(user_database())) as connection, connection:
        connection.execute(statement)


@pytest.mark.parametrize(
    ("statement", "told"),
    [
        ("UPDATE bearing SET width_mm = 19", "bearing 6208 NSK is changed"),
        ("DELETE FROM bearing", "bearing 6208 NSK is gone"),
        ("UPDATE bearing SET maker = 'NSL'", "bearing 6208 NSK is gone, bearing 6208 NSL is new"),
        ("UPDATE seal SET digest = replace(digest, '0', '1')", "is changed"),
    ],
)
def test_c3_a_row_changed_by_others_is_named_until_it_is_accepted(
    statement: str, told: str, catalogue: SqlCatalogue, caplog: pytest.LogCaptureFixture
) -> None:
    add_row(catalogue, "bearing", ROW)
    catalogue.close()
    _edit(statement)
    again = open_catalogue()
    (said,) = [record.getMessage() for record in caplog.records]
    assert told in said
    assert str(user_database()) in said
    assert "lambda-bearing db accept" in said
    assert again.bearing("6208", "NSK").layer == "core"
    with pytest.raises(CatalogueError, match="changed, but not by this program"):
        add_row(again, "bearing", ROW | {"designation": "X9"})
    assert user.accept(user_database())
    again.refresh()
    assert again.has_user_rows
    add_row(again, "bearing", ROW | {"designation": "X9"})
    assert user.accept(user_database()) == []
    again.close()


def test_a_row_changed_between_opening_and_writing_is_not_sealed(
    catalogue: SqlCatalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Change a row between the check and the write.

    Another program makes the change.
    """
    add_row(catalogue, "bearing", ROW)
    checked = user.open_user_database

    def opened(path: Path, *, changed: bool = False) -> Any:
        engine = checked(path, changed=changed)
        _edit("UPDATE bearing SET width_mm = 19")
        return engine

    monkeypatch.setattr(user, "open_user_database", opened)
    with pytest.raises(CatalogueError, match="bearing 6208 NSK is changed"):
        add_row(catalogue, "bearing", ROW | {"designation": "X9"})


def test_a_catalogue_that_is_locked_is_not_read_without_its_newest_rows(
    catalogue: SqlCatalogue, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Name and leave out a locked catalogue.

    Read as an unchanging file it would lack the rows in SQLite's log.
    """
    add_row(catalogue, "bearing", ROW)
    tried: list[str] = []
    uri = overlay.file_uri

    def locked(connection: Any, *_: Any) -> None:
        raise OperationalError("SELECT", {}, sqlite3.OperationalError("database is locked"))

    def noted(path: Path, mode: str) -> str:
        tried.append(mode)
        return uri(path, mode)

    monkeypatch.setattr(overlay, "file_uri", noted)
    monkeypatch.setattr(overlay, "_check", locked)
    other = open_catalogue()
    other.close()
    assert tried == ["ro"]
    assert "database is locked" in caplog.records[0].getMessage()


def test_nothing_is_accepted_of_a_damaged_catalogue(catalogue: SqlCatalogue) -> None:
    with pytest.raises(CatalogueError, match="no user catalogue yet"):
        user.accept(user_database())
    user_database().parent.mkdir(exist_ok=True)
    user_database().write_bytes(b"not a database, but long enough to be read as one" * 10)
    with pytest.raises(CatalogueError, match="the file is damaged"):
        user.accept(user_database())


@pytest.mark.parametrize(("table", "column"), [("roller_design", "kind"), ("bearing", "width_mm")])
def test_a_column_whose_case_changed_is_read_by_its_name(table: str, column: str, catalogue: SqlCatalogue) -> None:
    """Read columns whatever the case of their names.

    A changed byte in the file renamed `kind` to `kiNd`, which ended every command with an AttributeError.
    """
    add_row(catalogue, "bearing", ROW)
    catalogue.close()
    _edit(f"ALTER TABLE {table} RENAME COLUMN {column} TO {column.replace('i', 'I')}")
    again = open_catalogue()
    assert again.bearing("6208", "NSK").width.value == pytest.approx(0.018)
    assert {row.kind for row in again.rollers()} >= {"NU", "tapered"}
    again.close()
