"""Test a case while it is being edited.

Values that may be wrong, undo, files that diff well.
"""

from __future__ import annotations

import difflib
import tomllib
from pathlib import Path

import pytest

from lambda_core import api
from lambda_core.case.draft import Draft, draft_of

HAND_WRITTEN = """\
# Drive end of the fan.
name = "drive-end"

[bearing]
designation = "6208"   # from the parts list
maker = "SKF"

[lubricant]
name = "FVA3"
temperature = "62.5 degC"

[loads]
radial = "1.5 kN"      # belt
axial = "200 N"

[operation]
speed = "1500 rpm"
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "drive-end.toml"
    path.write_text(HAND_WRITTEN, encoding="utf-8")
    return path


def changed_lines(before: str, after: str) -> list[str]:
    lines = difflib.unified_diff(before.splitlines(), after.splitlines(), lineterm="", n=0)
    return [line for line in lines if line[0] in "+-" and not line.startswith(("+++", "---"))]


def test_one_changed_value_is_one_changed_line(file: Path) -> None:
    draft = api.draft(file)
    draft.set("loads", "radial", value="1800 N")
    draft.save()
    after = file.read_text(encoding="utf-8")
    assert changed_lines(HAND_WRITTEN, after) == ['-radial = "1.5 kN"      # belt', '+radial = "1800 N"      # belt']


def test_saving_without_a_change_leaves_every_byte(file: Path) -> None:
    api.draft(file).save()
    assert file.read_text(encoding="utf-8") == HAND_WRITTEN


def test_mistakes_may_stand_in_a_draft_and_in_its_file(file: Path) -> None:
    draft = api.draft(file)
    draft.set("loads", "radial", value="lots")
    draft.set("operation", "sped", value="3 rpm")
    draft.save()
    again = api.draft(file)
    assert again.get("loads", "radial") == "lots"
    assert {problem.where for problem in api.problems(again.tables)} == {"loads.radial", "operation.sped"}


def test_changes_of_one_place_are_undone_together_until_sealed(file: Path) -> None:
    draft = api.draft(file)
    for text in ("2", "2 k", "2 kN"):
        draft.set("loads", "radial", value=text)
    draft.seal()
    draft.set("loads", "radial", value="3 kN")
    assert draft.undo() == ("loads", "radial")
    assert draft.get("loads", "radial") == "2 kN"
    assert draft.undo() == ("loads", "radial")
    assert draft.get("loads", "radial") == "1.5 kN"
    assert draft.undo() is None
    assert not draft.is_changed()
    assert draft.redo() == ("loads", "radial")
    assert draft.redo() == ("loads", "radial")
    assert draft.redo() is None
    assert draft.get("loads", "radial") == "3 kN"


def test_a_new_change_forgets_what_was_undone(file: Path) -> None:
    draft = api.draft(file)
    draft.set("loads", "axial", value="1 N")
    draft.undo()
    draft.set("operation", "speed", value="1 rpm")
    assert draft.redo() is None


def test_the_last_value_takes_its_table_with_it(file: Path) -> None:
    draft = api.draft(file)
    draft.set("loads", "radial", value=None)
    assert "loads" in draft.tables
    draft.set("loads", "axial", value=None)
    assert "loads" not in draft.tables
    draft.set("bearing", "fits", "shaft", value="k5")
    draft.set("bearing", "fits", "shaft", value=None)
    assert draft.get("bearing", "fits") is None


def test_a_degree_of_freedom_is_short_while_it_only_has_a_mode(file: Path) -> None:
    draft = api.draft(file)
    place = ("bodies", "inner_ring", "x")
    draft.set(*place, "mode", value="locked")
    assert draft.tables["bodies"]["inner_ring"]["x"] == "locked"
    assert draft.get(*place, "mode") == "locked"
    draft.set(*place, value="free")
    draft.set(*place, "stiffness", value="1 N/um")
    assert draft.tables["bodies"]["inner_ring"]["x"] == {"mode": "free", "stiffness": "1 N/um"}
    draft.set(*place, "stiffness", value=None)
    assert draft.tables["bodies"]["inner_ring"]["x"] == "free"
    assert draft.is_changed(*place, "mode")
    assert draft.is_changed(*place)


def test_a_draft_knows_what_differs_from_the_file(file: Path) -> None:
    draft = api.draft(file)
    draft.set("loads", "radial", value="2 kN")
    assert draft.is_changed("loads", "radial")
    assert draft.is_changed("loads")
    assert not draft.is_changed("loads", "axial")
    draft.set("loads", "radial", value="1.5 kN")
    assert not draft.is_changed()


def test_a_file_that_somebody_else_wrote_is_noticed(file: Path) -> None:
    draft = api.draft(file)
    assert not draft.changed_on_disk()
    file.write_text(HAND_WRITTEN + "# and more\n", encoding="utf-8")
    assert draft.changed_on_disk()
    draft.save()
    assert not draft.changed_on_disk()
    file.unlink()
    assert draft.changed_on_disk()


def test_an_empty_draft_becomes_a_case(tmp_path: Path) -> None:
    draft = api.draft()
    for keys, value in {
        ("bearing", "designation"): "6208",
        ("bearing", "maker"): "SKF",
        ("lubricant", "name"): "FVA3",
        ("lubricant", "temperature"): "40 degC",
        ("loads", "radial"): "1 kN",
        ("operation", "speed"): "1500 rpm",
    }.items():
        draft.set(*keys, value=value)
    path = draft.save(tmp_path / "new.toml")
    assert api.case(path).written() == draft.tables
    assert draft.path == path
    assert draft.folder == tmp_path


def test_a_built_in_case_is_a_copy_without_a_file() -> None:
    draft = api.draft("6208-axial-1300")
    assert draft.path is None
    assert "# Deep-groove ball bearing 6208" in draft.text()
    with pytest.raises(api.UsageError, match="no file yet"):
        draft.save()


def test_unreadable_files_are_named(tmp_path: Path) -> None:
    with pytest.raises(api.UsageError, match="neither a file nor a built-in case"):
        api.draft(tmp_path / "missing.toml")
    broken = tmp_path / "broken.toml"
    broken.write_text("name = \n", encoding="utf-8")
    with pytest.raises(api.CaseError, match="line 1"):
        api.draft(broken)
    broken.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(api.UsageError, match="UTF-8"):
        api.draft(broken)


def test_replacing_everything_can_be_undone(file: Path) -> None:
    draft: Draft = api.draft(file)
    draft.replace({"name": "other", "loads": {"axial": "1 N"}})
    assert draft.tables == {"name": "other", "loads": {"axial": "1 N"}}
    while draft.undo():
        pass
    assert not draft.is_changed()


@pytest.mark.parametrize(
    "changes",
    [
        {("bearing", "geometry", "ball_count"): 9},
        {("bearing", "clearance"): None},
        {("bearing", "fits"): None, ("bearing", "temperatures"): None},
        {("bearing", "fits", "shaft"): None, ("bearing", "designation"): "6208"},
        {("bearing",): None},
        {("bearing", "clearance"): "14 um", ("bearing", "clearance_pick"): None, ("loads", "axial"): "3 N"},
    ],
)
def test_tables_that_go_on_further_down_are_changed_too(changes: dict[tuple[str, ...], object]) -> None:
    """Change `[bearing.fits]` below `[operation]` and keep the comments."""
    draft = api.draft(template="electric-motor")
    for keys, value in changes.items():
        draft.set(*keys, value=value)
    assert tomllib.loads(draft.text()) == draft.tables
    assert "# two poles at 50 Hz" in draft.text()


def test_a_renamed_table_keeps_its_comments(tmp_path: Path) -> None:
    """Rename a table, its subtables and its values.

    Other tables stay as they are.
    """
    text = (
        'name = "box"\n\n# the left one\n[bearings.left]\nat = "20 mm"  # its middle\n'
        '[bearings.left.geometry]  # own\nball_count = 9\n\n# the right one\n[bearings.right]\nat = "150 mm"\n'
    )
    path = tmp_path / "box.toml"
    path.write_text(text)
    draft = draft_of(text, path)
    tables = draft.get("bearings")
    draft.set("bearings", value={"drive-side" if name == "left" else name: table for name, table in tables.items()})
    assert draft.text() == text.replace("bearings.left", "bearings.drive-side")
    draft.set("bearings", "drive-side", "at", value="25 mm")
    assert draft.text() == text.replace("bearings.left", "bearings.drive-side").replace('"20 mm"', '"25 mm"')


def test_two_renamed_tables_that_also_change_keep_their_comments() -> None:
    """Give two tables new names and values.

    Each new name replaces its old one in place.
    """
    text = (
        'name = "box"\n# the left one\n[bearings.left]\nat = "20 mm"  # its middle\n'
        'support.x = "free"  # floats\n'
        '\n# the right one\n[bearings.right]\nat = "150 mm"  # also\n'
    )
    draft = draft_of(text, None)
    draft.set("bearings", value={"a": {"at": "21 mm", "support": {"x": "free"}}, "b": {"at": "151 mm"}})
    new = text.replace("left]", "a]").replace("right]", "b]").replace('"20 mm"', '"21 mm"').replace('"150', '"151')
    assert draft.text() == new


@pytest.mark.parametrize(
    "text",
    [
        '# all\n[markers]\nfoot = { body = "box", x = "1 mm" }  # the foot\n# more\nhead.x = "2 mm"  # the head\n',
        '[markers]  # all\n"foot".body = "box"  # one\nfoot.x = "1 mm"  # two\n[shaft]\ntwists = true\n',
        'markers.foot.x = "1 mm"  # the foot\nmarkers.head.x = "2 mm"\n[shaft]\ntwists = true\n',
        '[markers.foot]  # the foot\nx = "1 mm"\n[shaft]\nfoot = "1 mm"  # no marker\n',
    ],
)
def test_a_table_is_renamed_however_it_is_written(text: str) -> None:
    """Rename tables below headers, inline, dotted and quoted.

    Other items of that name keep it.
    """
    draft = draft_of(text, None)
    draft.set(
        "markers", value={"toe" if name == "foot" else name: table for name, table in draft.get("markers").items()}
    )
    new = draft.text()
    assert tomllib.loads(new) == draft.tables
    if "[markers.foot]" not in text:
        text = text.replace('"foot"', "foot").replace("foot =", "toe =")
    assert new == text.replace("foot.", "toe.").replace("markers.foot]", "markers.toe]")
