"""Test that the tutorial works to the letter."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from warm import Warm

from lambda_core.discovery import hookspecs
from lambda_core.discovery.reference import renewed

DOCS = Path(__file__).parents[2] / "docs"
TUTORIAL = (DOCS / "plugins.md").read_text()
REFERENCE = (DOCS / "plugin-reference.md").read_text()
FILES = re.findall(r"^`([^`\s]+)`:\n\n```\w+\n(.*?)^```$", TUTORIAL, re.M | re.S)
CONSOLE = re.findall(r"^```console\n(.*?)^```$", TUTORIAL, re.M | re.S)
TEST_CODE = re.findall(r"^```python\n(from hyperbolic_limit.*?)^```$", TUTORIAL, re.M | re.S)


def steps() -> list[tuple[str, list[str]]]:
    """Return the page's commands and outputs.

    Each command with the output lines printed below it.
    """
    found: list[tuple[str, list[str]]] = []
    for line in "".join(CONSOLE).splitlines():
        if line.startswith("$ "):
            found.append((line[2:], []))
        else:
            found[-1][1].append(line)
    return found


@pytest.fixture(scope="module")
def followed(tmp_path_factory: pytest.TempPathFactory, warm: Warm) -> tuple[Path, dict[str, str], dict[str, str]]:
    """Follow the page from top to bottom.

    Return folder, environment and the output of each command.
    """
    root = tmp_path_factory.mktemp("tutorial")
    for name, text in FILES:
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)
    bin_folder = Path(sys.executable).parent
    # pip puts packages into a folder of this test, without network; PIP_NO_BUILD_ISOLATION=0 means "not isolated".
    environment = os.environ | {
        "PATH": os.pathsep.join([str(warm.ready().path), str(bin_folder), os.environ["PATH"]]),
        "PYTHONPATH": str(root / "site"),
        "PIP_TARGET": str(root / "site"),
        "PIP_NO_DEPS": "1",
        "PIP_NO_INDEX": "1",
        "PIP_NO_BUILD_ISOLATION": "0",
        "PIP_QUIET": "1",
    }
    said: dict[str, str] = {}
    for command, _ in steps():
        done = subprocess.run(
            shlex.split(command), cwd=root, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
        said[command] = done.stdout
    return root, environment, said


def test_there_is_something_to_follow() -> None:
    assert {Path(name).name for name, _ in FILES} == {"pyproject.toml", "hyperbolic_limit.py", "capped.py"}
    assert len(steps()) >= 8
    assert len(TEST_CODE) == 1


@pytest.mark.full
def test_every_command_works_and_says_what_the_page_prints(
    followed: tuple[Path, dict[str, str], dict[str, str]],
) -> None:
    _, _, said = followed
    for command, printed in steps():
        for line in printed:
            parts = [part.strip() for part in line.split("...")]  # of a line that is shown in part
            assert all(part in said[command] for part in parts), command
    resolved = next(text for command, text in said.items() if command.startswith("lambda-bearing check"))
    assert "traction             hyperbolic-limit" in resolved


@pytest.mark.full
def test_the_tests_on_the_page_pass(followed: tuple[Path, dict[str, str], dict[str, str]]) -> None:
    root, environment, _ = followed
    (root / "test_page.py").write_text(TEST_CODE[0])
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", f"--rootdir={root}", "-c", "/dev/null"]
    done = subprocess.run(
        [*command, str(root / "test_page.py")], env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_module_has_at_most_10_lines() -> None:
    module = dict(FILES)["hyperbolic-limit/hyperbolic_limit.py"]
    assert len([line for line in module.splitlines() if line.strip()]) <= 10


def test_every_hook_is_on_the_page() -> None:
    hooks = [name for name in vars(hookspecs) if name.startswith("lambda_")]
    assert hooks
    for hook in hooks:
        assert f"`{hook}`" in REFERENCE


@pytest.mark.parametrize("name", ["kernels.md", "plugin-reference.md"])
def test_roles_and_quantities_on_the_pages_are_those_of_the_code(name: str) -> None:
    page = (DOCS / name).read_text()
    assert ":begin -->" in page
    assert page == renewed(page), f"run: python -m lambda_core.discovery.reference docs/{name}"
