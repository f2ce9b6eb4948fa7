"""Test that the example packages install and work."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from .conftest import Installation

EXAMPLES = Path(__file__).parents[2] / "examples"
PACKAGES = sorted(path.parent.name for path in EXAMPLES.glob("*/pyproject.toml"))


@pytest.fixture(scope="module")
def site(install: Callable[..., Installation]) -> Installation:
    return install([EXAMPLES / name for name in PACKAGES])


@pytest.mark.full
def test_own_tests_pass(site: Installation, tmp_path: Path) -> None:
    code = "import sys, pytest; sys.dont_write_bytecode = True; raise SystemExit(pytest.main(sys.argv[1:]))"
    options = ["-q", "-p", "no:cacheprovider", "--import-mode=importlib", f"--rootdir={tmp_path}", "-c", "/dev/null"]
    # A package's tests need pytest alone: without what else is installed it starts in a tenth of the time.
    folders = [str(EXAMPLES / name / "tests") for name in PACKAGES]
    answer = site.forked(code, *options, "-vv", *folders, PYTEST_DISABLE_PLUGIN_AUTOLOAD="1")
    assert answer.code == 0, answer.out + answer.err
    files = [path.name for name in PACKAGES for path in (EXAMPLES / name / "tests").glob("test_*.py")]
    assert len(set(files)) == len(files) >= len(PACKAGES)
    for file in files:  # pytest writes no folder of theirs: the root is elsewhere
        assert re.search(rf"/{file}::.* PASSED", answer.out), file


@pytest.mark.full
def test_no_package_brings_a_fault(site: Installation) -> None:
    answer = site.program("plugins", "check", *PACKAGES)
    assert answer.code == 0, answer.out + answer.err
    assert answer.err == ""


@pytest.mark.full
def test_a_law_is_chosen_with_the_parameters_that_the_package_gives_to_an_oil(site: Installation) -> None:
    case = ["check", "6319-cp10-1500", "--all", "--set", "models.traction=gecim-winer"]
    answer = site.program(*case)
    assert answer.code == 0, answer.err
    assert "traction             gecim-winer" in answer.out
    assert "traction gecim-winer: slope 0.065, lubricant FVA3A" in answer.out
    refused = site.program(*case, LAMBDA_BEARING_NO_PLUGIN="limiting-shear")
    assert refused.code == 3
    assert '"gecim-winer" is not a traction model' in refused.err
    assert "not in use: limiting-shear 0.1.0" in refused.err


@pytest.mark.timeout(900)  # the first test of a session that needs the solver compiles it
def test_a_law_of_a_stranger_runs_and_changes_the_torque(site: Installation, tmp_path: Path) -> None:
    def torque(name: str) -> float:
        out = tmp_path / f"{name}.h5"
        answer = site.program(
            "run", "6319-cp10-3000", "--duration", "4 ms", "--quiet", "--json", "--out", str(out),
            "--set", f"models.traction={name}",
        )  # fmt: skip
        assert answer.code == 5, answer.err  # a few milliseconds cannot converge
        return float(answer.data["friction_torque_Nmm"])

    limited, default = torque("gecim-winer"), torque("ree-eyring")
    # Without Eyring's shear thinning the film is stiffer: more sliding friction, but no more than the limit allows.
    assert limited > 1.02 * default


def test_a_law_of_an_afternoon_is_at_most_15_lines() -> None:
    source = (EXAMPLES / "limiting-shear" / "limiting_shear" / "__init__.py").read_text()
    law = source[source.index("def gecim_winer") : source.index("@hookimpl")]
    assert len([line for line in law.splitlines() if line.strip()]) <= 15


@pytest.mark.parametrize(
    "name", ["sliding-wear", "cage-whirl", "magnetic-pull", "spring-damper", "warm-contact", "shock-pulse"]
)
def test_a_package_with_its_test_is_at_most_60_lines(name: str) -> None:
    files = [path for path in (EXAMPLES / name).rglob("*.py") if "__pycache__" not in path.parts]
    assert len(files) == 2
    lines = [line for path in files for line in path.read_text().splitlines()]
    assert len([line for line in lines if line.strip()]) <= 60


def settings_on_the_page() -> list[str]:
    """Return the page's settings of packages.

    Those of docs/plugin-reference.md for cases, as ``--set`` takes them.
    """
    page = (EXAMPLES.parent / "docs" / "plugin-reference.md").read_text()
    below = page[page.index("## Channels and events of your own") :]
    return [
        line for text in re.findall(r"^```toml\n(.*?)^```$", below, re.M | re.S) for line in flat(tomllib.loads(text))
    ]


def flat(table: dict[str, Any], path: str = "") -> Iterator[str]:
    for name, value in table.items():
        if isinstance(value, dict) and "kind" not in value:
            yield from flat(value, f"{path}{name}.")
        else:
            yield f"{path}{name}={value if isinstance(value, str) else inline(value)}"


def inline(value: Any) -> str:
    """Write a value as TOML on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{name} = {inline(each)}" for name, each in value.items()) + "}"
    return "[" + ", ".join(map(inline, value)) + "]" if isinstance(value, list) else json.dumps(value)


def test_show_has_every_law_of_a_package_or_a_file(site: Installation, tmp_path: Path) -> None:
    package = site.program("plugins", "show", "warm-contact", "--json").data["models"]
    assert {(card["role"], card["name"]) for card in package} == {
        ("traction", "warm-eyring"),
        ("contact_state", "warm"),
    }
    assert {card["role"]: card["reads"] for card in package}["traction"] == ["contact_temperature"]
    text = (EXAMPLES / "spring-damper" / "spring_damper" / "__init__.py").read_text()
    (tmp_path / "own.py").write_text(text.replace('"spring-damper"', '"own-spring"'))
    file = site.program("plugins", "show", str(tmp_path / "own.py"))
    assert file.code == 0, file.err
    assert file.out.startswith("force_element/own-spring   own.py")
    parts = site.program("plugins", "show", "sliding-wear").out
    assert "observer/sliding-wear   sliding-wear" in parts
    assert "view/sliding-wear   sliding-wear" in parts
    assert "reference" in parts


@pytest.mark.full
def test_all_of_them_in_one_run_close_their_energy(site: Installation, tmp_path: Path) -> None:
    out = tmp_path / "all.h5"
    used = settings_on_the_page()
    assert {"observers", "events", "elements", "models"} <= {line.partition(".")[0] for line in used}
    used += ["events.cage-whirl.action=record", "elements.s.law=spring-damper", "elements.s.second=inner_ring"]
    changes = [word for change in used for word in ("--set", change)]
    answer = site.program(
        "run", "6208-axial-1300", "--duration", "10 ms", "--quiet", "--json", "--out", str(out), *changes
    )
    assert answer.code == 5, answer.err  # ten milliseconds cannot converge
    assert abs(answer.data["energy_residual"]) < 1e-3
    drawn = site.program("view", str(out), "sliding-wear", "--out", str(tmp_path))
    assert drawn.code == 0, drawn.err


def test_bearing_oil_method_and_command_of_a_maker(site: Installation) -> None:
    changes = ["bearing.designation=NW6208", "bearing.maker=Northwind", "lubricant.name=northwind-spindle"]
    answer = site.program(
        "check", "6208-axial-1300", "--all", *(word for change in changes for word in ("--set", change))
    )
    assert answer.code == 0, answer.err
    assert "\nNW6208 (Northwind)  9 x 11.906 mm" in answer.out
    assert "northwind-spindle at 40 degC" in answer.out
    items = site.program("plugins", "list", "--json").data["items"]
    assert {(i["kind"], i["name"]) for i in items if i["distribution"] == "northwind-bearings 0.2.0"} == {
        ("method", "stribeck"),
        ("view", "load-share"),
        ("data", "rows"),
        ("command", "northwind"),
    }
    case = site.program("check", "northwind-spindle")
    assert case.code == 0, case.err
    assert "\nNW6208 (Northwind)" in case.out
    assert site.program("--no-plugin", "northwind-bearings", "check", "northwind-spindle").code == 2
    bearings = site.program("northwind", "--bore", "40", "--json").data["bearings"]
    assert bearings == [{"designation": "NW6208", "bore_mm": 40.0, "dynamic_rating_kN": 29.1}]
    listed = site.program("--help", COLUMNS="200")
    assert "northwind" in listed.out
    assert "From northwind-bearings 0.2.0." in listed.out
