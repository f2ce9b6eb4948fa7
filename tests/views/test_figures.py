"""Test figures of views.

Every one is drawn from a real run, the same each time, and readable without colour.
"""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from collisions import collisions

from lambda_core import api
from lambda_core.discovery.manager import discover, registry
from lambda_core.domain.installed import Source
from lambda_core.export.report.gallery import data_of
from lambda_core.plugins import Axis, Field, Mark, Options, Panel, RunData, Series, View, ViewData, hookimpl

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

OF_A_RESULT = [name for name, view in registry().views.items() if view.subject == "result" and view.offered is None]


def drawn(data: ViewData) -> Any:
    return registry().figure(registry().view(data.view), data)


@pytest.mark.parametrize("name", OF_A_RESULT)
def test_every_view_is_drawn(radial_run: Result, name: str) -> None:
    data = data_of(registry().view(name), radial_run, {})
    figure = drawn(data)
    assert not collisions(figure)
    pixels = np.asarray(figure.canvas.buffer_rgba())[:, :, :3].astype(float)
    assert (pixels.min(axis=2) < 200).mean() > 0.005, "an empty picture"
    # Nothing sticks out: the outermost pixels are background.
    for edge in (pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]):
        assert edge.min() == 255.0
    plain = [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]
    assert len(plain) == len(data.panels)
    for axes, panel in zip(plain, data.panels, strict=True):
        text = (axes.get_xlabel() + axes.get_ylabel()).replace("\n", " ")
        for axis in (panel.x, panel.y):
            assert axis.text in text or not axis.label
        width, height = axes.get_window_extent().size
        assert width > 120
        assert height > 120


def test_equal_data_give_equal_files(radial_run: Result) -> None:
    data = data_of(registry().view("film"), radial_run, {})
    found = []
    for _ in range(2):
        buffer = BytesIO()
        drawn(data).savefig(buffer, format="svg")
        found.append(buffer.getvalue())
    assert found[0] == found[1]


def luminance(colour: str) -> float:
    red, green, blue = (int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
    return 0.299 * red + 0.587 * green + 0.114 * blue


def test_looks_differ_without_colour() -> None:
    from lambda_plugins.views.style import CYCLE, ROLES

    looks = list(ROLES.values())
    for looked in (looks, list(CYCLE)):
        for i, one in enumerate(looked):
            for other in looked[i + 1 :]:
                grey = abs(luminance(one.colour) - luminance(other.colour))
                shapes = (one.dash, one.marker, one.hatch, one.width) != (
                    other.dash,
                    other.marker,
                    other.hatch,
                    other.width,
                )
                assert grey > 0.1 or shapes
    inner, outer = ROLES["inner"], ROLES["outer"]
    assert abs(luminance(inner.colour) - luminance(outer.colour)) > 0.3
    assert inner.marker != outer.marker
    assert inner.dash != outer.dash
    for one, other in pairwise(CYCLE):  # neighbours in a stack
        assert one.hatch != other.hatch
        assert abs(luminance(one.colour) - luminance(other.colour)) > 0.1


def test_a_series_without_a_role_does_not_look_like_a_ring() -> None:
    """Draw oil in a colour of its own.

    The oil of a warm-up had the blue line of the inner ring.
    """
    from lambda_plugins.views.panels import _looks

    at = np.zeros(2)
    names = (("inner", "inner"), ("outer", "outer"), ("balls", "ball"), ("oil", ""), ("shaft", ""), ("housing", ""))
    looks = _looks(tuple(Series(name, at, at, "line", role) for name, role in names))
    assert len({(look.colour, str(look.dash)) for look in looks}) == len(looks)


def test_files_are_written_where_one_asks(radial_run: Result, tmp_path: Path) -> None:
    data = api.view(radial_run.path, "pressure")
    files = api.draw(data, tmp_path / "new", "case", ("svg", "png"))
    assert [file.name for file in files] == ["case-pressure.svg", "case-pressure.png"]
    assert files[1].read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    with pytest.raises(api.UsageError, match='"jpg" is not a known format'):
        api.draw(data, tmp_path, "case", ("jpg",))


def chart(panel: Panel) -> ViewData:
    return ViewData("film", "A title", "a source", (panel,), 1, ("a note",))


X = np.linspace(1.0, 10.0, 5)


@pytest.mark.parametrize(
    "panel",
    [
        Panel("log", Axis("x", log=True), Axis("y", "N", log=True), (Series("a", X, X**2),)),
        Panel("nothing but marks in range", Axis("x"), Axis("y"), (Series("a", X, X),), (Mark("far", 1e9),)),
        Panel("one value", Axis("x"), Axis("y", least=1.0), (Series("a", X[:1], X[:1], "points"),)),
        Panel("gaps", Axis("x"), Axis("y"), (Series("a", X, np.where(X > 4, np.nan, X), "line", "", X - 1, X + 1),)),
        Panel("negative", Axis("", categories=tuple("abcde")), Axis("y"), (Series("a", X, -X, "bars"),)),
        Panel("areas", Axis("x"), Axis("y"), tuple(Series(n, X, X, "area") for n in "abcdefg"), stacked=True),
        Panel(
            "circle", Axis("a"), Axis("r"), (Series("a", X * 36, X), Series("b", X * 36, X, "points")), shape="polar"
        ),
        Panel("hole", Axis("x"), Axis("y"), field=Field("f", "u", *np.meshgrid(X, X), np.full((5, 5), np.nan))),
        Panel(
            "signed",
            Axis("x"),
            Axis("y"),
            field=Field("f", "u", *np.meshgrid(X, X), np.outer(X, X) - 30.0, levels=(0.0,), signed=True),
        ),
    ],
)
def test_odd_panels_are_drawn(panel: Panel) -> None:
    figure = drawn(chart(panel))
    figure.canvas.draw()
    assert figure.axes[0].get_window_extent().width > 150


def test_a_strangers_view_is_drawn_by_the_house_or_by_itself(radial_run: Result) -> None:
    class Choice(Options):
        factor: float = 2.0

    def torque(run: RunData, options: Choice) -> ViewData:
        values = options.factor * run["input_torque"]
        panel = Panel("", Axis("time", "s"), Axis("torque", "N m"), (Series("drive", run["time"], values),))
        return ViewData("stranger", "Torque", run.title, (panel,))

    class Own:
        def savefig(self, fname: Any, *, format: str, **options: Any) -> None:
            Path(fname).write_text(f"own {format}")

    def plugin(figure: Callable[[ViewData], Any] | None) -> Any:
        from types import ModuleType

        module = ModuleType("stranger")

        @hookimpl
        def lambda_views(register: Callable[[View], None]) -> None:
            register(View("stranger", "torque of the drive", "result", torque, Choice, figure, view_api=1))

        module.lambda_views = lambda_views  # type: ignore[attr-defined]
        return module

    import lambda_plugins

    house = Source("lambda-bearing", "0", "builtin", lambda: lambda_plugins)
    for figure, kind in ((None, "HouseFigure"), (lambda data: Own(), "Own")):
        known = discover([house, Source("stranger", "1", "main", lambda figure=figure: plugin(figure))])
        assert known.faults == ()
        view = known.view("stranger")
        assert view.distribution == "stranger 1"
        data = data_of(view, radial_run, {"factor": "3"})
        np.testing.assert_allclose(data.panels[0].series[0].y, 3.0 * radial_run["input_torque"])
        assert type(known.figure(view, data)).__name__ == kind


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"view_api": 7}, "written for version 7"),
        ({"view_api": None}, "does not say for which version it is written: write view_api=1"),
        ({"subject": "movie"}, 'looks at "movie"'),
        ({"data": 3}, "the data of the view x is a int"),
        ({"figure": 3}, "the figure of the view x is a int"),
        ({"options": dict}, "not a subclass of Options"),
    ],
)
def test_views_that_do_not_fit_are_named(changes: dict[str, Any], words: str) -> None:
    from lambda_core.views.view import view_fault

    given: dict[str, Any] = {"name": "x", "title": "t", "subject": "result", "data": len, "view_api": 1, **changes}
    assert words in view_fault(View(**given))


def test_numbers_of_an_axis_are_plain_text_and_their_power_is_a_formula() -> None:
    import matplotlib
    from lambda_plugins.views.frame import Numbers
    from lambda_plugins.views.style import RC
    from matplotlib.figure import Figure

    with matplotlib.rc_context(RC):
        figure = Figure()
        axes = figure.add_subplot()
        axes.plot([0.0, 1.0], [-2e-6, 3e-6])
        axes.yaxis.set_major_formatter(Numbers())
        figure.draw_without_rendering()
    labels = [label.get_text() for label in axes.get_yticklabels()]
    assert {"−2", "0", "3"} <= {label.removesuffix(".0") for label in labels}
    assert not any("$" in label for label in labels)
    assert "10^{−6}" in axes.yaxis.get_offset_text().get_text()
