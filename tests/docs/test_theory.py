"""Test that the theory names every built-in law."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from lambda_core.discovery.manager import registry
from lambda_core.domain.installed import OWN
from lambda_core.domain.roles import ROLES

THEORY = Path(__file__).parents[2] / "docs" / "theory"
TEXT = {path.stem: path.read_text(encoding="utf-8") for path in sorted(THEORY.glob("*.md"))}
_SOURCE = re.compile(r"([A-Z][A-Za-z]+)[^;]*?\(?(1[89]\d\d|20\d\d)")


def _laws() -> list[str]:
    models = registry()
    return [
        f"{role}/{name}"
        for role in ROLES
        for name in models.names(role)
        if models.origin(role, name).split(" ")[0] == OWN
    ]


@pytest.mark.parametrize("label", _laws())
def test_every_law_is_in_the_theory_with_its_source(label: str) -> None:
    found = [text for text in TEXT.values() if f"`{label}`" in text]
    assert found or label.endswith("/none"), f"{label} stands on no page of the theory"
    reference = registry().model(*label.split("/")).reference
    first = _SOURCE.search(reference)
    if first is not None and found:
        author, year = first.groups()
        assert any(author in text and year in text for text in found), f"{author} {year} is missing next to {label}"


def test_no_law_is_in_the_theory_that_does_not_exist() -> None:
    known = set(_laws())
    for text in TEXT.values():
        for role, name in re.findall(r"`([a-z_]+)/([a-z0-9-]+)`", text):
            assert role not in ROLES or f"{role}/{name}" in known, f"{role}/{name}"


def test_every_role_has_a_page() -> None:
    everything = "".join(TEXT.values())
    for role in ROLES:
        assert f"Role `{role}`" in everything, role


def test_every_method_is_in_the_theory() -> None:
    for name in registry().methods:
        if registry().origin("method", name).split(" ")[0] == OWN:
            assert f"| `{name}` |" in TEXT["methods"]


def test_subjects_that_have_to_be_there() -> None:
    assert set(TEXT) == {
        "index",
        "geometry",
        "contact",
        "lubricant",
        "friction",
        "cage",
        "fluid",
        "capacitance",
        "electric",
        "equilibrium",
        "dynamics",
        "methods",
        "thermal",
    }
    for name in set(TEXT) - {"index"}:
        assert f"({name}.md)" in TEXT["index"]
