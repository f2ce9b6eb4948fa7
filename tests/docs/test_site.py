"""Test that the site builds without network and warnings."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import break_hook
import package_diagram
import pytest

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
LOADED = re.compile(r"""<(?:script|link|img|iframe)\b[^>]*?(?:src|href)=["']([^"']+)["']""")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(folder)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def test_numbers_and_options_stay_in_one_piece() -> None:
    page = "<p>1 500 000 h of 20 1500: <code>--draw</code></p><pre><code>1 500</code></pre>"
    kept = '<p>1\xa0500\xa0000 h of 20 1500: <code class="whole">--draw</code></p><pre><code>1 500</code></pre>'
    assert break_hook.on_page_content(page) == kept


def test_every_page_is_built_and_in_the_navigation(site: Path) -> None:
    navigation = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    for path in DOCS.rglob("*.md"):
        name = path.relative_to(DOCS)
        assert (site / name.with_suffix(".html")).is_file()
        assert re.search(rf"[ ]{re.escape(name.as_posix())}\n", navigation), (
            f"docs/{name} is not in the navigation: add it to mkdocs.yml"
        )


def test_nothing_is_loaded_from_elsewhere(site: Path) -> None:
    pages = list(site.rglob("*.html"))
    assert len(pages) > 20
    for path in pages:
        for address in LOADED.findall(path.read_text(encoding="utf-8")):
            assert not re.match(r"(https?:)?//", address), f"{path.name} loads {address}"
    for style in site.rglob("*.css"):
        assert not re.search(r"url\(['\"]?(https?:)?//", style.read_text(encoding="utf-8")), style.name


def test_the_picture_of_the_packages_has_the_layers_of_today() -> None:
    assert package_diagram.TARGET.read_text(encoding="utf-8") == package_diagram.drawn(), (
        "run python docs/tools/package_diagram.py"
    )


def test_commands_can_be_copied(site: Path) -> None:
    assert "copy.js" in (site / "install.html").read_text(encoding="utf-8")
    assert (site / "copy.js").is_file()


def test_blocks_are_rendered_as_code(site: Path) -> None:
    """Find no fence of three backticks in the pages.

    A fence that the renderer does not know stays in the text.
    """
    for path in site.rglob("*.html"):
        assert "```" not in path.read_text(encoding="utf-8"), path.name
    assert not (site / "tools").exists()


def test_formulas_are_set_as_formulas(site: Path) -> None:
    """Find MathML for every dollar of the theory.

    Browsers know all its elements.
    """
    found = 0
    for path in (site / "theory").glob("*.html"):
        text = path.read_text(encoding="utf-8")
        assert "$$" not in text, path.name
        assert "<merror" not in text, path.name
        found += text.count("<math ")
    assert found >= 200


def test_no_formula_of_the_theory_is_left_in_plain_text() -> None:
    """Find only commands, Python and case files in code.

    A formula on a theory page stands between dollars.
    """
    for path in (DOCS / "theory").glob("*.md"):
        fenced = False
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            place = f"{path.name}:{number}"
            if line.startswith("```"):
                assert fenced or line != "```", f"{place}: say the block's language"
                fenced = not fenced
            elif not fenced:
                assert not re.match(r" {4}(?!\$\$)\S", line), f"{place}: a formula in plain text: {line}"


def test_the_search_finds_options_by_path_and_by_word(site: Path) -> None:
    entries = json.loads((site / "search" / "search_index.json").read_text(encoding="utf-8"))["docs"]

    def pages(word: str) -> set[str]:
        return {entry["location"].partition("#")[0] for entry in entries if word in entry["text"].split()}

    for word in ("tilt_y", "tilt", "bodies.inner_ring.tilt_y", "clearance_pick", "pick"):
        assert "reference/case.html" in pages(word), word
    assert "errors.html" in pages("converged")


def test_images_exist_and_are_drawings(site: Path) -> None:
    for name in ("axes.svg", "contact.svg"):
        tree = ElementTree.parse(DOCS / "images" / name)
        assert tree.getroot().tag.endswith("svg")
        assert f"images/{name}" in (site / "frames.html").read_text(encoding="utf-8")


def test_every_screen_of_the_builder_has_its_pictures(site: Path) -> None:
    page = (site / "screens.html").read_text(encoding="utf-8")
    named = set(re.findall(r"images/gui/([\w-]+\.png)", page))
    assert named == {path.name for path in (DOCS / "images" / "gui").glob("*.png")}
    assert all(name.replace("80x24", "160x48") in named for name in named)
