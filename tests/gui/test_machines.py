"""Test that every machine has the same screens."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from driving import SMALL, builder, checked, go_to, screen_text, wait_for, write
from lambda_gui.answer_screen import QUESTIONS, AnswerScreen
from lambda_gui.app import BuilderApp
from lambda_gui.duty_screen import DutyScreen
from lambda_gui.duty_values import columns_of
from lambda_gui.helper import Helper
from lambda_gui.helper_process import answer
from lambda_gui.study_screen import StudyScreen
from lambda_gui.study_values import study_tables
from reading import cut_on

from lambda_core import api

CASES = ["6208-axial-1300", "geared-shaft"]


def draft_of(case: str) -> api.Draft:
    return api.draft(template=case) if case in api.templates() else api.draft(case)


@pytest.fixture
def case_file(request: pytest.FixtureRequest, work_folder: Path) -> Path:
    """Write the case into a file."""
    return draft_of(request.param).save(work_folder / "case.toml")


@pytest.mark.parametrize("case_file", CASES, indirect=True)
async def test_the_same_keys_lead_to_answers_study_and_duty_cycle(
    case_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[dict[str, Any]] = []

    async def ask(self: Helper, work: str, **arguments: Any) -> Any:
        asked.append({"work": work, **arguments})
        return ("found so far\n" + "word " * 40, []) if work == "answer" else "1 point"

    monkeypatch.setattr(Helper, "ask", ask)
    async with BuilderApp(str(case_file)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        assert cut_on(pilot.app) == []
        await pilot.press("f10")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, AnswerScreen))
        for number, question in enumerate(QUESTIONS):
            await wait_for(
                pilot, lambda number=number: len(asked) > number and "found so far" in screen_text(pilot.app)
            )
            assert asked[-1]["question"] == question
            assert asked[-1]["tables"] == builder(pilot).draft.tables
            assert cut_on(pilot.app) == []
            await pilot.press("right")
        await pilot.press("escape", "f4")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, DutyScreen))
        assert cut_on(pilot.app) == []
        await pilot.press("escape")
        await go_to(pilot, "operation.speed")
        await pilot.press("f3")
        await wait_for(pilot, lambda: isinstance(pilot.app.screen, StudyScreen))
        screen = pilot.app.screen
        assert isinstance(screen, StudyScreen)
        assert screen.values["0", "path"] == "operation.speed"
        await wait_for(pilot, lambda: screen.is_fine)
        assert cut_on(pilot.app) == []


async def test_a_case_with_mistakes_has_no_answers(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await go_to(pilot, "lubricant.temperature")
        await write(pilot, "hot")
        await checked(pilot)
        await pilot.press("f10", "f3", "f4", "f5")
        await wait_for(pilot, lambda: len(pilot.app._notifications) >= 4)
        assert {note.message for note in pilot.app._notifications} >= {"correct 1 mistake first: F8"}
        assert pilot.app.screen is builder(pilot)


@pytest.mark.parametrize("case_file", ["geared-shaft"], indirect=True)
def test_phases_and_studies_of_a_shaft_are_of_what_stands_on_it(case_file: Path) -> None:
    draft = api.draft(case_file)
    draft.set("loads", "belt", value={"at": "10 mm", "force_z": "-300 N", "moment_y": "1 N m"})
    paths = [column.key for column in columns_of(draft, 160)]
    assert paths == [
        "name", "time", "gears.wheel.power", "loads.belt.force_z", "loads.belt.moment_y", "operation.speed",
        "lubricant.temperature",
    ]  # fmt: skip
    narrow = columns_of(draft, 80)
    assert [column.key for column in narrow if column.key in ("operation.speed", "lubricant.temperature")]
    assert sum(column.width + 1 for column in narrow) <= 80
    assert all(len(column.head) <= column.width for column in narrow)
    model = api.check(draft.tables)
    screen = StudyScreen(draft, model, ["gears.wheel.power", "bearings.left.preload"], "gears.wheel.power", "15 kW")
    study = study_tables(screen.values, screen._usual)
    assert study["parameters"][0] | {"points": 0} == {
        "path": "gears.wheel.power", "range": ["7.5 kW", "30 kW"], "points": 0, "label": "power",
    }  # fmt: skip
    assert {"system_life_h", "left.min_film_parameter", "right.skf/friction/total"} <= set(study["responses"])


@pytest.mark.full
@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("question", QUESTIONS)
def test_every_machine_has_every_answer(case: str, question: str) -> None:
    """Ask the helper process for every answer.

    Words or pictures name bearings and temperatures.
    """
    text, views = answer(lambda _: None, question, draft_of(case).tables, None, "si")
    words = {
        "equilibrium": "N mm (model ",
        "temperatures": "outer ring",
        "currents": "discharges",
        "friction": "quasi-static",
        "assumptions": "clearance",
    }[question]
    assert words in text
    assert all(view.panels for view in views)
    assert views or question not in ("temperatures", "friction")
    if case == "geared-shaft":
        assert "left" in text
        assert "right" in text
