"""Test roller bearings in the builder, by keyboard."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from driving import LARGE, SMALL, checked, go_to, move_to, screen_text, wait_for
from lambda_gui.app import BuilderApp
from lambda_gui.choice import Choice, PickList
from lambda_gui.derived import Derived, between
from lambda_gui.outline import outline
from lambda_gui.profiles import ProfileRow
from reading import cut_on
from textual.pilot import Pilot
from textual.widgets import DataTable

from lambda_core import api
from lambda_core.case.case import Case
from lambda_core.discovery import local_files, manager
from lambda_core.domain.installed import ON_VARIABLE

CASE = """\
name = "gearbox"
[bearing]
designation = "SKF NU 208 ECP"
[lubricant]
name = "FVA3"
temperature = "60 degC"
[loads]
radial = "5 kN"
[operation]
speed = "3000 rpm"
"""
PLUGIN = """\
from lambda_core.plugins import Parameters, RollerProfile, hookimpl, parameter

class Edge(Parameters):
    power: float = parameter(4.0, "exponent", ge=2.0)

def drop(x, roller, parameters):
    return 8e-6 * abs(2.0 * x / roller.effective_length) ** parameters.power

@hookimpl
def lambda_profiles(register):
    register(RollerProfile("power", "A power", drop, "own work", Edge, profile_api=1))
"""


@pytest.fixture
def gearbox(work_folder: Path) -> Path:
    """Write a case of a cylindrical roller bearing."""
    path = work_folder / "gearbox.toml"
    path.write_text(CASE, encoding="utf-8")
    return path


@pytest.fixture
def power(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Take the file of a profile into use."""
    monkeypatch.setenv(ON_VARIABLE, "")
    known = dict(local_files._texts)
    (tmp_path / "power.py").write_text(PLUGIN)
    api.use_plugin(tmp_path / "power.py")
    yield
    local_files._texts.clear()
    local_files._texts.update(known)
    monkeypatch.undo()
    manager.registry.cache_clear()


async def choose(pilot: Pilot[None], profile: str) -> None:
    """Choose a profile from the list."""
    await go_to(pilot, "bearing.rollers.profile")
    await pilot.press("enter")
    screen = pilot.app.screen
    assert isinstance(screen, PickList)
    entries = screen._entries
    at = next(number for number, entry in enumerate(entries) if entry.value == profile)
    await pilot.press("home", *["down"] * at, "enter")
    await wait_for(pilot, lambda: pilot.app.screen.query_one(ProfileRow).place.get() == profile)


def test_one_number_of_two_reads_as_one() -> None:
    assert [between(ends, 1) for ends in ([2.29], [2.29, 2.31], [2.0, 3.0])] == ["2.3", "2.3", "2.0..3.0"]


def test_options_of_balls_stand_under_their_own_heading() -> None:
    bearing = next(node for node in outline(Case) if node.key == "bearing")
    geometry = next(node for node in bearing.children if node.key == "bearing.geometry")
    shared, balls = geometry.groups
    assert (shared.title, balls.title) == ("", "Balls")
    text = CASE.replace("[lubricant]", '[bearing.geometry]\nwidth = "18 mm"\nball_count = 14\n[lubricant]')
    told = {one.where for one in api.problems(tomllib.loads(text))}
    assert told == {"bearing.geometry.ball_count"}  # the program takes of rollers what stands under no heading
    assert "width" in shared.names
    assert "ball_count" in balls.names


async def test_a_roller_bearing_comes_from_the_catalogue(hand_written: Path) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        await pilot.press("f2", *"tapered 322 grade=b")
        await wait_for(pilot, lambda: "32208" in screen_text(pilot.app))
        await wait_for(pilot, lambda: pilot.app.screen.query_one(DataTable).row_count == 2)
        assert "17 x 10 " in screen_text(pilot.app)
        assert cut_on(pilot.app) == []
        await pilot.press("down", "enter")
        draft = pilot.app.builder.draft  # type: ignore[attr-defined]
        await wait_for(pilot, lambda: draft.get("bearing", "designation") == "32216")
        assert draft.get("bearing", "maker") == "SKF"


async def test_numbers_that_follow_are_those_of_rollers(gearbox: Path, estimates: None) -> None:
    async with BuilderApp(str(gearbox)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await wait_for(pilot, lambda: pilot.app.screen.query_one(Derived).is_current)
        text = screen_text(pilot.app)
        assert "14 x 11.00 x 11 mm" in text
        assert "friction torque" in text
        assert "largest contact angle" not in text


async def test_the_profile_is_chosen_with_its_options(gearbox: Path, power: None) -> None:
    """Choose a profile of the program, then a plugin's.

    Options of the one before go with it; those that a profile does not take have no row.
    """
    async with BuilderApp(str(gearbox)).run_test(size=LARGE) as pilot:
        await checked(pilot)
        await move_to(pilot, "bearing.rollers")
        await go_to(pilot, "bearing.rollers.profile")
        row = pilot.app.screen.query_one(ProfileRow)
        listed = [entry.value for entry in row.query_one(Choice).entries]
        assert listed == ["", "iso", "logarithmic", "crowned", "two-radii", "tabulated", "none", "power"]
        draft = pilot.app.builder.draft  # type: ignore[attr-defined]
        await choose(pilot, "crowned")
        await go_to(pilot, "bearing.rollers.profile_radius")
        await pilot.press(*"4 m", "enter")
        await checked(pilot)
        assert "profile scale" not in screen_text(pilot.app)
        assert draft.get("bearing", "rollers") == {"profile": "crowned", "profile_radius": "4 m"}
        await choose(pilot, "power")
        await go_to(pilot, "bearing.rollers.profile_parameters.power")
        await pilot.press("3", "enter")
        await checked(pilot)
        assert draft.get("bearing", "rollers") == {"profile": "power", "profile_parameters": {"power": 3}}
        assert not pilot.app.builder.check.problems  # type: ignore[attr-defined]
        assert cut_on(pilot.app) == []
        assert "own work" in screen_text(pilot.app)
