"""Test citation, changelog and contributing notes against the package."""

from __future__ import annotations

import re
from importlib.metadata import metadata
from pathlib import Path

import yaml

from lambda_core import __version__
from lambda_core.discovery.manager import registry
from lambda_core.elements.ball.kinds import kinds
from lambda_core.elements.roller.roller_kinds import roller_kinds
from lambda_core.plugins import METHOD_API, ROLE_API, VIEW_API
from lambda_core.results import citation
from lambda_core.results.file_format import LAYOUT
from lambda_core.results.record import INTERFACE

ROOT = Path(__file__).parents[2]


def test_the_citation_file_is_that_of_this_version() -> None:
    found = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert found["cff-version"] == "1.2.0"
    assert {"message", "title", "authors", "version", "license", "type"} <= found.keys()
    assert str(found["version"]) == __version__ == metadata("lambda-bearing")["Version"]
    assert found["license"] == metadata("lambda-bearing")["License-Expression"] == "BSD-3-Clause"
    assert found["title"] == citation.TITLE
    reference = found["references"][0]
    assert reference["doi"] in citation.METHOD
    assert reference["title"] in citation.METHOD


def test_the_changelog_knows_this_version_and_these_interfaces() -> None:
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.search(rf"^## {re.escape(__version__)}\b", text, re.M)
    said = f"`ROLE_API` {ROLE_API}, `METHOD_API` {METHOD_API}, `VIEW_API` {VIEW_API}, result layout {LAYOUT}"
    assert f"{said}, machine interface {INTERFACE}" in " ".join(text.split())


def test_every_command_is_in_the_changelog() -> None:
    from lambda_cli.commands import entries

    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    for entry in entries().values():
        if entry.panel == "Commands":
            assert f"`{entry.name}`" in text


def test_links_between_the_files_of_the_root_hold() -> None:
    for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md"):
        for target in re.findall(r"\]\((?!https?:)([^)#]+)", (ROOT / name).read_text(encoding="utf-8")):
            assert (ROOT / target).exists(), f"{name}: {target}"


def test_the_architecture_page_names_every_package() -> None:
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    for name in ("lambda_core", "lambda_plugins", "lambda_syla2026", "lambda_db", "lambda_gui", "lambda_cli"):
        assert name in text
    packages = {path.name for path in (ROOT / "lambda_core").iterdir() if (path / "__init__.py").exists()}
    for package in packages:
        assert f"`{package}" in text, package


def test_the_first_pages_name_every_kind_of_bearing() -> None:
    """Name every kind in README and home page.

    Both named only deep-groove ball bearings when there were angular contact ones.
    """
    counts = ("none", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")
    balls, rollers = kinds(), {kind.title.split()[0].lower() for kind in roller_kinds().values()}
    index = (ROOT / "docs" / "index.md").read_text(encoding="utf-8")
    readme = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    rows = dict(re.findall(r"^\| (ball|roller) bearings \| (.*) \|$", index, re.M))
    assert f"[{counts[len(balls)]} kinds]" in rows["ball"]
    assert not [name for name in balls if name not in rows["ball"]]
    assert f"{counts[len(balls)]} kinds of ball bearings" in readme
    for text in (rows["roller"], readme):
        assert not [kind for kind in rollers if kind not in text]
    catalogued = {row.kind for row in registry().catalogue().bearings("", 10_000)}
    assert catalogued == set(balls)
    page = re.sub(r"[ -]+", " ", (ROOT / "docs" / "kinds.md").read_text(encoding="utf-8").lower())
    assert not [name for name in balls if name.replace("-", " ") not in page]
    words = (ROOT / "pyproject.toml").read_text(encoding="utf-8") + readme + index
    assert not re.search(r"ball bearings only|only (deep[- ]groove )?ball bearings", words, re.I)
