"""Test the README's commands and their output."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core.domain.channels import CHANNELS
from lambda_core.results.averages import INTEGRALS
from lambda_core.results.summary import field_names

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks() -> list[str]:
    """Return the code blocks of the README."""
    return [block.strip() for block in re.findall(r"```\w*\n(.*?)```", README, re.DOTALL)]


def test_the_first_command_sets_up_and_runs_a_6319_case() -> None:
    first = blocks()[0]
    assert first.startswith("python3 -m venv .venv && .venv/bin/pip install")
    assert first.endswith(".venv/bin/lambda-bearing run 6319-cp10-1500")
    assert "\n" not in first


def test_ci_runs_the_second_command() -> None:
    second = blocks()[2]
    assert second.endswith(".venv/bin/python -m tests")
    lines = (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()
    assert lines.count(second) == 1
    assert lines[lines.index(second) + 1] == "suite=$?"


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_ci_runs_what_the_second_command_leaves_out_for_its_cost() -> None:
    options = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["pytest"]["ini_options"]
    assert options["addopts"].endswith("-m 'not slow and not clock and not full'")
    command = r'\.venv/bin/python -m tests -m "full and not slow and not clock" \$\((grep .+)\)\nfull=\$\?\n'
    found = re.search(command, (ROOT / ".ci" / "run").read_text(encoding="utf-8"))
    assert found is not None
    files = subprocess.run(["bash", "-c", found[1]], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert set(files.split()) == {
        path.relative_to(ROOT).as_posix()
        for path in ROOT.glob("tests/**/test_*.py")
        if "pytest.mark.full" in path.read_text(encoding="utf-8")
    }


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
@pytest.mark.parametrize("failing", ["nothing", "-m tests$", "mypy", "smoke", "full and", "anchors"])
def test_ci_fails_when_one_part_fails_and_runs_the_others(failing: str, tmp_path: Path) -> None:
    """Run CI with stand-ins for Python and pip.

    They print how they were called; one of them fails.
    """
    stand_in = f'#!/bin/sh\necho "$0 $@" >> {tmp_path}/calls\nif echo "$@" | grep -q -e "{failing}"; then exit 3; fi\n'
    for place in ("python3", ".venv/bin/python", ".venv/bin/pip", ".ci/run"):
        path = tmp_path / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text((ROOT / place).read_text(encoding="utf-8") if place == ".ci/run" else stand_in)
        path.chmod(0o755)
    path = f"{tmp_path}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run([tmp_path / ".ci" / "run"], env=os.environ | {"PATH": path}, capture_output=True, check=False)
    assert done.returncode == int(failing != "nothing")
    assert len((tmp_path / "calls").read_text().splitlines()) == 10


def test_c2_5_ci_tries_the_pythons_that_are_promised() -> None:
    from smoke import REQUIRED

    assert "python3 tests/smoke.py --others\nsmoke=$?\n" in (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    told = re.findall(
        r"Programming Language :: Python :: (3\.\d+)", (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    )
    assert tuple(told) == REQUIRED
    assert f"With Python {', '.join(REQUIRED[:-1])} or {REQUIRED[-1]}" in README


def test_what_other_pythons_compute_is_computed_here_too(tmp_path: Path) -> None:
    """Compare the script with the solver.

    It puts the solver together by itself and has to follow it.
    """
    from smoke import FORCES

    done = subprocess.run([sys.executable, "-c", FORCES], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    acceleration, power, functions, *_ = done.stdout.split()
    assert float(acceleration) > 0.0
    assert float(power) > 0.0
    assert int(functions) > 500


def test_every_command_that_the_readme_names_exists() -> None:
    from lambda_cli.commands import entries

    named = set(re.findall(r"lambda-bearing (\w+)", README))
    assert named
    assert named <= set(entries())


def test_linked_pages_exist() -> None:
    for link in re.findall(r"\]\(((?!https?:)[^)]+)\)", README):
        assert (ROOT / link.partition("#")[0]).exists(), link


def test_the_output_shown_is_what_a_run_prints(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Compare lines and numbers with a run.

    Numbers of a chaotic motion are left out because they depend on the machine.
    """
    shown = blocks()[1]
    assert {"friction torque", "rating life", "film", "energy residual"} <= set(_labels(shown))
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(ROOT / "docs" / "tools")
    from page_examples import compare

    assert main(["run", "6319-cp10-1500"]) == 0
    printed = capsys.readouterr()
    expected = re.sub(r"(?m)^(energy residual|  scatter|capacitance).*", r"\1 ...", shown).splitlines()
    printed_lines = (printed.err + printed.out).splitlines()
    assert compare([*expected, "..."], printed_lines) is not None, printed.out


def _labels(text: str) -> list[str]:
    """Return the labels of a summary.

    The first words of each line: continued lines are indented.
    """
    return [found[1] for line in text.splitlines() if (found := re.match(r"([a-z][a-z ]*?)  ", line))]


@pytest.mark.parametrize("channel", [*CHANNELS, *INTEGRALS], ids=lambda channel: channel.name)
def test_the_results_page_describes_every_channel(channel: object) -> None:
    from lambda_core.domain.channels import Channel

    assert isinstance(channel, Channel)
    page = (ROOT / "docs" / "results.md").read_text(encoding="utf-8")
    dims = ", ".join(channel.dims) or "-"
    assert f"| `{channel.name}` | {dims} | {channel.unit} | {channel.meaning} |" in page


def test_the_results_page_describes_every_number_of_the_machine_interface() -> None:
    page = (ROOT / "docs" / "results.md").read_text(encoding="utf-8")
    plain = {"interface", "case", "title", "headline", "file", "state", "simulated_s", "wall_s", "equilibrium"}
    plain |= {"solver_statistics", "revolutions_discarded", "revolutions_averaged"}
    for name in set(field_names()) - plain:
        assert f"`{name}`" in page, name
