"""Test the version of the interface that a plugin names."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from lambda_core.case.cards import field_card
from lambda_core.discovery import collect
from lambda_core.discovery.collect import law_fault
from lambda_core.laws.law import Law
from lambda_core.plugins import OK, Method, MethodTable, Parameters, View, built_in, law, parameter
from lambda_core.testing import assert_limit
from lambda_core.views import view as views

ROOT = Path(__file__).parents[2]
PLACES = ("docs/*.md", "examples/**/*.py", "lambda_core/discovery/template/**/*.tmpl", "plugins/**/*.py")
CALLS = {
    r"@law\(\s*\"": r"role_api=\d",
    r"\bMethod\(\s*(?:\"|name=)": r"method_api=\d",
    r"\bView\(\s*\"": r"view_api=\d",
    r"\bObserver\(\s*\"": r"observer_api=\d",
    r"\bEvent\(\s*\"": r"event_api=\d",
}


def calls(text: str, start: str) -> list[str]:
    """Return every call with a beginning.

    Up to the bracket that closes it.
    """
    found = []
    for match in re.finditer(start, text):
        depth, end = 0, match.start()
        for end in range(match.start(), len(text)):
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            if text[end] == ")" and depth == 0:
                break
        found.append(text[match.start() : end + 1])
    return found


def test_versions_are_numbers_wherever_an_author_looks() -> None:
    seen = 0
    for path in sorted(path for pattern in PLACES for path in ROOT.glob(pattern)):
        text = path.read_text(encoding="utf-8")
        for start, wanted in CALLS.items():
            for call in calls(text, start):
                seen += 1
                assert re.search(wanted, call), f"{path}: {call}"
    assert seen > 50


def fine(Lambda: float, par: Any, out: Any) -> int:
    out[0] = 0.5
    return OK


def test_a5_a_law_of_today_is_refused_by_the_next_version(monkeypatch: pytest.MonkeyPatch) -> None:
    written_today = Law("asperity_load", "fine", fine, role_api=3, reference="own work")
    assert law_fault(written_today) == ""
    monkeypatch.setattr(collect, "ROLE_API", 4)
    assert "is written for version 3 of the role interface; this program has 4" in law_fault(written_today)


def test_a5_a_method_and_a_view_of_today_are_refused_by_the_next_version(monkeypatch: pytest.MonkeyPatch) -> None:
    method = Method("fine", "", "own work", lambda inputs: MethodTable(()), method_api=1)
    view = View("fine", "", "result", lambda subject, options: None, view_api=1)  # type: ignore[arg-type,return-value]
    assert (collect._method_fault(method), views.view_fault(view)) == ("", "")
    monkeypatch.setattr(collect, "METHOD_API", 2)
    monkeypatch.setattr(views, "VIEW_API", 2)
    assert collect._method_fault(method) == "the method fine is written for version 1 of the interface; this is 2"
    assert views.view_fault(view) == "the view fine is written for version 1 of the interface; this is 2"


def test_a2_a_law_builds_on_one_of_ours() -> None:
    ours = built_in("asperity_load/zhou-hoeprich")
    share = ours.kernel

    @law("asperity_load", "half", ours.parameters, role_api=3, reference="own work", prepare=ours.prepare)
    def half(Lambda: float, par: Any, out: Any) -> int:
        status = share(Lambda, par, out)
        out[0] *= 0.5
        return status

    assert_limit(half, "Lambda", 0.0, 0.5, rtol=1e-6)


def test_a2_lists_are_shown_with_their_defaults() -> None:
    class Table(Parameters):
        knots: list[float] = parameter([1.0, 2.5], "knots")

    assert field_card(Table, "knots").default == "[1, 2.5]"
