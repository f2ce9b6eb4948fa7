"""Test that generated pages are complete and up to date."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import page_sources
import pytest
import reference_errors
from lambda_cli.commands import entries
from lambda_cli.main import _command as load
from pydantic import BaseModel

from lambda_core.case import signals
from lambda_core.case.case import Case
from lambda_core.discovery import hookspecs
from lambda_core.discovery.manager import registry
from lambda_core.domain.channels import CHANNELS
from lambda_core.domain.elements import BODIES, DOFS, ELEMENTS, RIBS
from lambda_core.domain.installed import OWN
from lambda_core.domain.option_tree import option_paths
from lambda_core.domain.roles import ROLES
from lambda_core.domain.units import UNITS
from lambda_core.results.summary import Summary, field_names

DOCS = Path(__file__).parents[2] / "docs"


def page(name: str) -> str:
    return (DOCS / name).read_text(encoding="utf-8")


def test_the_pages_are_those_of_today() -> None:
    command = [sys.executable, str(DOCS / "tools" / "renew.py"), "--check"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.full
def test_a_stale_page_is_found(tmp_path: Path) -> None:
    """Rename an option on a copy of the pages."""
    import shutil

    copy = tmp_path / "docs"
    shutil.copytree(DOCS, copy)
    (tmp_path / "examples").symlink_to(DOCS.parent / "examples")
    stale = copy / "reference" / "case.md"
    stale.write_text(stale.read_text().replace("`depth.strips`", "`depth.slices`"))
    command = [sys.executable, str(copy / "tools" / "renew.py"), "--check"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "stale: docs/reference/case.md" in done.stdout


def test_code_of_examples_on_pages_follows_the_files() -> None:
    shown = [file for path in DOCS.rglob("*.md") for file, _ in page_sources.taken(path.read_text(encoding="utf-8"))]
    packages = {file.split("/")[1] for file in shown}
    assert packages == {"sliding-wear", "cage-whirl", "magnetic-pull", "spring-damper", "warm-contact", "shock-pulse"}
    block = f"<!-- from {shown[0]}: RATE VOLUME -->\n```python\nRATE = 1\n```\n"
    assert 'VOLUME = Integral("wear_volume"' in page_sources.renewed(block)
    with pytest.raises(ValueError, match="defines no Archart"):
        page_sources.renewed(block.replace("RATE VOLUME", "Archart"))


def _described(path: str) -> str:
    """Return an option's name on the page.

    Tables of several places are described once.
    """
    path = re.sub(rf"^forces\.({'|'.join(ELEMENTS | RIBS)})\.models\.", "models.", path)
    path = re.sub(rf"^forces\.({'|'.join(ELEMENTS | RIBS)})\.", "forces.ELEMENT.", path)
    path = re.sub(rf"^loads\.({'|'.join(BODIES)})\.", "loads.BODY.", path)
    path = re.sub(r"^materials\.(inner|outer|balls|cage)\.", "materials.PART.", path)
    path = re.sub(r"^elastic\.(inner|outer)_ring\.", "elastic.RING.", path)
    match = re.fullmatch(rf"bodies\.({'|'.join(BODIES)})\.({'|'.join(DOFS)})\.(\w+)", path)
    if match:
        dof = {"y": "x", "z": "x", "tilt_z": "tilt_y"}.get(match[2], match[2])
        body = "inner_ring" if (match[1], dof) == ("inner_ring", "spin") else "BODY"
        path = f"bodies.{body}.{dof}.{match[3]}"
    return path


def test_every_option_of_a_case_is_described() -> None:
    text = page("reference/case.md")
    keyed = {"parameters": "`parameters.ROLE.NAME`", "markers": "`markers.NAME.body`"}
    keyed |= {"observers": "`observers.NAME.PARAMETER`", "events": "`events.NAME.action`"}
    keyed["elements"] = "`elements.NAME.law`"
    names = {path: _described(path) for path in option_paths(Case)}
    assert len(names) > 300
    assert [path for path, name in names.items() if keyed.get(name, f"| `{name}` |") not in text] == []


def test_every_option_has_a_meaning_and_every_unit_is_listed() -> None:
    rows = [line.split(" | ") for line in page("reference/case.md").splitlines() if line.startswith("| `")]
    assert len(rows) > 150
    for row in rows:
        assert row[-1].strip(" |") not in ("", "-"), row
    for units in UNITS.values():
        assert all(f"`{unit}`" in page("reference/case.md") for unit in units)
    for kind in signals.SIGNAL_KINDS:
        assert f'`kind = "{kind}"`' in page("reference/case.md")


def _built_in_laws() -> list[str]:
    models = registry()
    return [
        f"{role}/{name}" for role in ROLES for name in models.names(role) if models.origin(role, name).startswith(OWN)
    ]


def test_every_law_is_described_with_all_its_parameters() -> None:
    text = page("reference/models.md")
    missing = {}
    for label in _built_in_laws():
        law = registry().model(*label.split("/"))
        part = re.search(rf"^### {label}\n(.*?)(?=^##|\Z)", text, re.M | re.S)
        words = [*(f"| `{name}` |" for name in law.parameters.model_fields), *law.errors.values()]
        words += [law.reference] * (law.reference != "-")
        missing[label] = [word for word in words if word not in part[1]] if part else ["its part of the page"]
    assert len(missing) > 70
    assert {label: words for label, words in missing.items() if words} == {}


def test_every_method_and_view_is_listed() -> None:
    text = page("reference/models.md")
    for kind, named in (("method", registry().methods), ("view", registry().views)):
        for name in named:
            if registry().origin(kind, name).startswith(OWN):
                assert f"| `{name}` |" in text


@pytest.mark.parametrize("name", [entry.name for entry in entries().values() if entry.panel == "Commands"])
def test_every_command_and_option_is_described(name: str) -> None:
    text = page("reference/cli.md")

    def described(path: str, command: object) -> None:
        part = re.search(rf"^##+ `{path}`\n(.*?)(?=^##|\Z)", text, re.M | re.S)
        assert part is not None, path
        for parameter in command.params:  # type: ignore[attr-defined]
            for option in parameter.opts:
                if parameter.param_type_name == "option" and not option.endswith(("-completion", "--help")):
                    assert f"`{option}`" in part[1], f"{path} {option}"
        for child, below in getattr(command, "commands", {}).items():
            described(f"{path} {child}", below)

    described(name, load(entries()[name]))


def test_every_hook_is_described() -> None:
    hooks = [name for name in vars(hookspecs) if name.startswith("lambda_")]
    assert hooks
    for hook in hooks:
        assert f"`{hook}`" in page("plugin-reference.md")


def test_every_error_and_exit_code_is_described() -> None:
    text = page("errors.md")
    classes = reference_errors.error_classes()
    assert {error.exit_code for error in classes} <= set(reference_errors.MEANINGS)
    for error in classes:
        assert f"| `{error.__name__}` | `{error.__module__}` | {error.exit_code} |" in text
        assert error.__doc__
    for code in reference_errors.MEANINGS:
        assert re.search(rf"^\| {code} \| \w", text, re.M), code
    # Each code that an input can lead to is shown by an example that runs.
    for code in (2, 3, 4, 5):
        assert f"$ echo $?\n{code}\n" in text


def test_every_environment_variable_is_described() -> None:
    """Find every variable that the program reads on a page."""
    root = DOCS.parent
    folders = ("lambda_core", "plugins", "db", "gui", "cli")
    sources = [path.read_text(encoding="utf-8") for folder in folders for path in (root / folder).rglob("*.py")]
    names = {name for source in sources for name in re.findall(r"\bLAMBDA_BEARING_[A-Z_]+\b", source)}
    assert names
    pages = "".join(path.read_text(encoding="utf-8") for path in DOCS.rglob("*.md"))
    assert not [name for name in names if name not in pages]


def test_results_and_their_summary_are_described() -> None:
    text = page("results.md")
    for channel in CHANNELS:
        assert f"`{channel.name}`" in text
    for field in ("converged", "reasons", "friction_torque_Nmm", "energy_residual", "contacts"):
        assert f"`{field}`" in text
    reference = page("reference/api.md")
    for name in field_names():
        assert f"| `{name}` |" in reference
    assert issubclass(Summary, BaseModel)
