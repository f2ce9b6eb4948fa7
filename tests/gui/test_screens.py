"""Test that screens are legible, complete and have help."""

from __future__ import annotations

import math
from contextlib import closing
from pathlib import Path

import pytest
from driving import LARGE, SMALL, checked, screen_text, wait_for
from lambda_db.drawing import Section, section_of
from lambda_gui.app import BuilderApp
from lambda_gui.axes import HEIGHT, WIDTH, axes_sketch
from lambda_gui.derived import Derived
from lambda_gui.help import ABOUT
from lambda_gui.labels import _LABELS, label_of
from lambda_gui.outline import outline
from lambda_gui.plots import labels_of, series_colour
from lambda_gui.sketch import drawn, section_of_geometry
from lambda_gui.theme import DARK, LIGHT
from pydantic import BaseModel
from textual.color import Color
from textual.screen import Screen
from textual.theme import Theme

from lambda_core import api
from lambda_core.case.case import Case
from lambda_core.case.machine import MachineCase
from lambda_core.elements.ball.raceways import row_places

_PAINT = {"background": "#000000", "secondary": "#0000ff", "accent": "#ff0000", "foreground": "#00ff00"}
_SECTIONS = ("bearings", "gears", "discs", "loads", "connections", "bodies", "markers")
_NAMES = {"shaft.sections": ("0",)} | dict.fromkeys(_SECTIONS, ("n",))


def _fields(root: type[BaseModel]) -> list[tuple[str, ...]]:
    """Return the places of all options that have a row."""
    names = {name: known for name, known in _NAMES.items() if root is MachineCase or name == "markers"}
    nodes = (node for top in outline(root, names) for node in top.walk())
    return [keys for node in nodes for group in node.groups for keys in group.fields]


def contrast(one: str, other: str) -> float:
    """Return the contrast ratio of WCAG 2.2, section 1.4.3."""

    def luminance(colour: Color) -> float:
        parts = (part / 255.0 for part in colour.rgb)
        red, green, blue = (p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts)
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue

    low, high = sorted((luminance(Color.parse(one)), luminance(Color.parse(other))))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("theme", [DARK, LIGHT], ids=lambda theme: theme.name)
def test_words_can_be_read_on_every_ground(theme: Theme) -> None:
    """Require a contrast of 4.5 (WCAG 2.2, level AA)."""
    for ground in (theme.background, theme.surface, theme.panel):
        for colour in (theme.foreground, theme.primary, theme.accent, theme.error, theme.success, theme.warning):
            assert contrast(str(colour), str(ground)) >= 4.5, (colour, ground)


def test_series_differ_in_colour() -> None:
    colours = {**{n: str(getattr(DARK, n)) for n in ("primary", "accent", "success", "error", "warning", "secondary")}}
    colours["background"] = str(DARK.background)
    assert len({series_colour(colours, number) for number in range(12)}) == 12


def test_ticks_have_as_many_decimals() -> None:
    assert labels_of([1.0, 1.002, 1.004]) == ["1.000", "1.002", "1.004"]
    assert labels_of([0.0, 500.0, 1000.0]) == ["0", "500", "1000"]


def test_the_section_is_to_scale() -> None:
    geometry = api.check("6208-axial-1300").geometry
    lines = drawn(section_of_geometry(geometry), 20, 80, _PAINT, 14.0).plain.splitlines()
    rows = [line for line in lines if "▀" in line]
    high = 0.5e3 * (geometry.outside_diameter - geometry.bore_diameter)
    assert rows[0].count("▀") / (2 * len(rows)) == pytest.approx(1e3 * geometry.width / high, rel=0.05)


def test_a_section_has_clearance_angle_and_contact_line() -> None:
    deep = drawn(section_of_geometry(api.check("6208-axial-1300").geometry), 20, 80, _PAINT, 14.0)
    assert "clearance 14 um" in deep.plain
    assert "angle" not in deep.plain
    with closing(api.catalogue()) as catalogue:
        single, double, aligning = (section_of(catalogue.bearing(name, "SKF")) for name in ("7208BE", "3208A", "1208E"))
    assert single is not None
    assert double is not None
    assert aligning is not None
    assert "angle 40°" in drawn(single, 20, 80, _PAINT).plain
    pitch = 0.5 * single.pitch
    assert single.is_contact_line(3.0 * math.sin(math.radians(40)), pitch + 3.0 * math.cos(math.radians(40)), 1e-6)
    assert not single.is_contact_line(-1.0, pitch + 1.0, 0.1)
    for section, side in ((double, -1.0), (aligning, 1.0)):  # O: lines meet outside the pitch circle; a sphere: inside
        place = max(row_places(section.geometry)) * 1e3
        assert section.is_contact_line(place + side * 0.1, *_on_the_line(section), 0.05)
        assert not section.is_contact_line(place - side * 0.5, *_on_the_line(section), 0.05)


def _on_the_line(section: Section) -> tuple[float]:
    """Return a radius near the contact line.

    The line of the right row is there 0.1 mm off the centre of its ball.
    """
    angle = section.geometry.contact_angle or section.geometry.resting_angle
    return (0.5 * section.pitch + 0.1 / math.tan(angle),)


def test_labels_are_words() -> None:
    assert label_of(("loads", "radial"), "radial") == "radial load"
    assert label_of(("bearings", "left", "outer"), "outer") == "outer ring sits in"
    assert label_of(("materials", "outer"), "outer") == "outer ring"
    assert label_of(("lubricant", "temperature"), "temperature") == "temperature"
    places = {".".join(keys[-2:]) for root in (Case, MachineCase) for keys in _fields(root)}
    places |= {f"{keys[0]}.{keys[2]}" for keys in _fields(MachineCase) if len(keys) == 3}
    assert [place for place in _LABELS if place not in places | {place.split(".")[-1] for place in places}] == []


def test_axes_stand_inside_their_sketch() -> None:
    lines = axes_sketch({"secondary": "", "accent": "", "primary": ""}).plain.splitlines()
    assert len(lines) == HEIGHT
    assert max(map(len, lines)) <= WIDTH
    assert any("y  0°" in line for line in lines)
    assert "270° down" in lines[-1]


def test_every_screen_has_its_own_help() -> None:
    from lambda_gui import (
        answer_screen,
        catalogue,
        choice,
        dialogs,
        duty_screen,
        fit_screen,
        own_row,
        results_screen,
        run_screen,
        study_screen,
    )

    modules = (
        answer_screen, catalogue, choice, dialogs, duty_screen, fit_screen, own_row, results_screen, run_screen,
        study_screen,
    )  # fmt: skip
    found = {
        name
        for module in modules
        for name, thing in vars(module).items()
        if isinstance(thing, type) and issubclass(thing, Screen) and thing.__module__ == module.__name__
    }
    assert found | {"BuilderScreen"} == set(ABOUT)


async def test_all_numbers_that_follow_fit(hand_written: Path, estimates: None) -> None:
    async with BuilderApp(str(hand_written)).run_test(size=SMALL) as pilot:
        await checked(pilot)
        derived = pilot.app.screen.query_one(Derived)
        await wait_for(pilot, lambda: derived.is_current)
        for size, last in ((SMALL, "run ≈"), (LARGE, "run takes")):
            await pilot.resize_terminal(*size)
            await wait_for(pilot, lambda last=last: last in screen_text(pilot.app))
            assert len(str(derived.visual).splitlines()) <= derived.size.height
