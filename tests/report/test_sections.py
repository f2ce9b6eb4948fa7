"""Test sections that plugins add to reports."""

from __future__ import annotations

import copy
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from lambda_core.discovery.collect import Collection, Entry
from lambda_core.discovery.manager import registry
from lambda_core.export.report.page import Cover, document, run_chapter
from lambda_core.results.reader import Result
from lambda_core.views.method import NotApplicable
from lambda_core.views.section import ReportTable, Section

TABLE = ReportTable("classes", ("class", "limit <um>"), (("A", "1.5"), ("B", "3")))


def largest(run: Any) -> list[Any]:
    return [f"The largest load is {run['load'].max():.0f} N & no more.", TABLE]


def section(content: Callable[[Any], Any] = largest, **changes: Any) -> Section:
    made = Section("noise", "Noise class", content, "own work", section_api=1, distribution="guest 1.0")
    return replace(made, **changes)


def page(result: Result, found: Section) -> str:
    models = copy.copy(registry())
    models.sections = {found.name: found}
    cover = Cover(appendices=("tables",))  # without the views, which take seconds to draw
    return document([run_chapter(models, result, cover)], cover)


def test_texts_and_tables_stand_in_the_page(radial_run: Result) -> None:
    text = page(radial_run, section())
    assert '<h2 id="section-noise">Noise class</h2>' in text
    assert f"<p>The largest load is {radial_run['load'].max():.0f} N &amp; no more.</p>" in text
    assert "limit &lt;um&gt;" in text
    assert "own work [guest 1.0]" in text


def nothing(run: Any) -> Any:
    raise NotApplicable("no noise")


def fails(run: Any) -> Any:
    raise KeyError("noise")


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (fails, "Not shown: the section &#34;noise&#34; (guest 1.0) fails: KeyError"),
        (lambda run: [3], "returns a int, not a text or a ReportTable"),
        (lambda run: [replace(TABLE, rows=(("A",),))], "is not as long as its head"),
    ],
)
def test_one_that_fails_is_named_and_the_page_is_complete(
    radial_run: Result, content: Callable[[Any], Any], words: str
) -> None:
    text = page(radial_run, section(content))
    assert words in text
    assert "energy residual" in text
    assert "damping added" in text or "damped by the integration" in text


def test_one_that_has_nothing_to_say_is_left_out(radial_run: Result) -> None:
    assert "Noise class" not in page(radial_run, section(nothing))


@pytest.mark.parametrize(
    ("item", "words"),
    [
        (section(section_api=0), "add section_api=1"),
        (section(section_api=2), "is written for version 2"),
        (section(reference=""), "has no reference"),
        (section(3), "calls a int, not a function"),  # type: ignore[arg-type]
        ("text", "registers a str"),
    ],
)
def test_one_that_cannot_be_is_named(item: Any, words: str) -> None:
    assert words in Collection().take([Entry("lambda_sections", "guest 1.0", item)])
