"""Test that `plugins new` writes a working package."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from lambda_core.discovery.scaffold import new_plugin
from lambda_core.domain.errors import UsageError

from .conftest import Installation, pip_install


@pytest.fixture(scope="module")
def sources(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("new")
    new_plugin("ferry-law", root)
    return root / "ferry-law"


@pytest.fixture(scope="module")
def site(install: Callable[..., Installation], sources: Path) -> Installation:
    return install([sources], pip_install)


@pytest.mark.full
def test_own_tests_pass(site: Installation, sources: Path, tmp_path: Path) -> None:
    code = "import sys, pytest; raise SystemExit(pytest.main(sys.argv[1:]))"
    options = ["-q", "-p", "no:cacheprovider", "--import-mode=importlib", f"--rootdir={tmp_path}", "-c", "/dev/null"]
    answer = site.forked(code, *options, str(sources / "tests"))
    assert answer.code == 0, answer.out + answer.err


@pytest.mark.full
def test_law_rows_method_and_command_are_found(site: Installation) -> None:
    answer = site.program("plugins", "check", "ferry-law", "--json")
    assert answer.code == 0
    assert [card["role"] for card in answer.data["models"]] == ["traction", "method", "view"]
    assert all(card["ok"] for card in answer.data["models"])
    items = site.program("plugins", "list", "--json").data["items"]
    assert {i["kind"] for i in items if i["distribution"] == "ferry-law 0.1.0"} == {
        "model",
        "method",
        "view",
        "data",
        "command",
    }
    checked = site.program("check", "6319-cp10-1500", "--all", "--set", "models.traction=ferry-law")
    assert checked.code == 0
    assert "traction ferry-law: limit_ratio 0.065, lubricant FVA3A" in checked.out
    curve = site.program("ferry-law", "--json").data
    assert curve["tau_MPa"][-1] == pytest.approx(2.0 * 70.0 / 72.0)  # eta v/h = 2 MPa against a limit of 70 MPa


@pytest.mark.parametrize("name", ["Ferry", "ferry_law", "1law", "class", "ferry law", ""])
def test_names_that_cannot_be(name: str, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="cannot name a plugin"):
        new_plugin(name, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_names_that_are_taken(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match='"numpy" is the name of an installed package'):
        new_plugin("numpy", tmp_path)
    new_plugin("twice", tmp_path)
    with pytest.raises(UsageError, match="twice exists already"):
        new_plugin("twice", tmp_path)


def test_the_name_of_a_built_in_law_is_taken(tmp_path: Path) -> None:
    """Refuse the name of a built-in law.

    Cases could not choose between the two.
    """
    with pytest.raises(UsageError, match='"ree-eyring" is the name of the law traction/ree-eyring: choose another'):
        new_plugin("ree-eyring", tmp_path)
    assert not (tmp_path / "ree-eyring").exists()


def test_a_workflow_tests_and_checks_the_package(sources: Path) -> None:
    text = (sources / ".github/workflows/test.yml").read_text()
    assert "${{ matrix.python }}" in text
    assert f"lambda-bearing plugins check {sources.name}" in text


def test_every_file_of_the_template_is_text_without_leftovers(sources: Path) -> None:
    for path in (path for path in sources.rglob("*") if path.is_file() and path.suffix != ".pyc"):
        assert "$" not in path.read_text().replace("${{", ""), path
