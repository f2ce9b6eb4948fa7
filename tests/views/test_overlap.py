"""Test that no texts of a picture overlap."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from collisions import collisions, no_collision
from lambda_plugins.views.drawing import draw

from lambda_core.discovery.manager import registry
from lambda_core.export.report.gallery import data_of
from lambda_core.views.chart import Axis, Mark, Panel, Series, ViewData

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

OF_A_RESULT = [name for name, view in registry().views.items() if view.subject == "result" and view.offered is None]


@pytest.mark.full
@pytest.mark.parametrize("name", OF_A_RESULT)
def test_texts_of_a_view_keep_apart(combined_run: Result, name: str) -> None:
    """Find no overlap of texts in a view.

    Tests of figures do the same for the other run, whose views they draw.
    """
    no_collision(data_of(registry().view(name), combined_run, {}))


def test_texts_of_a_comparison_keep_apart(radial_run: Result, combined_run: Result) -> None:
    no_collision(data_of(registry().view("comparison"), [radial_run, combined_run], {}))


def test_a_legend_leaves_measured_points_and_the_band_free() -> None:
    """Place the legend below a band with points.

    It covered the band of a study that filled the picture.
    """
    x = np.linspace(0.0, 1.0, 9)
    line = Series("torque", x, 0.0 * x, "line", low=x - 1.0, high=1.0 - x, band="90 % band")
    points = Series("measured", np.repeat(x, 2), np.tile([-1.0, 1.0], 9), "points")
    figure: Any = draw(ViewData("own", "Own", "", (Panel("", Axis("speed"), Axis("torque"), (line, points)),)))
    figure.canvas.draw()
    (axes,) = figure.axes
    assert not axes.get_legend().get_window_extent().overlaps(axes.get_window_extent())


def test_labels_of_close_marks_keep_apart() -> None:
    """Write the second label below the first.

    "BPFI - shaft" hid "2 BSF" where their frequencies were close.
    """
    marks = tuple(Mark(name, at, "x") for name, at in (("BPFI", 135.0), ("2 BSF", 118.0), ("BPFI - shaft", 110.0)))
    line = Series("", np.array([0.0, 500.0]), np.array([0.0, 1.0]), "line")
    figure: Any = draw(ViewData("own", "Own", "", (Panel("", Axis("frequency", "Hz"), Axis("y"), (line,), marks),)))
    figure.canvas.draw()
    first, second, third = (text.get_window_extent() for text in figure.axes[0].texts)
    assert first.x0 < second.x0 < third.x0
    assert not first.overlaps(second)
    assert third.y1 == pytest.approx(first.y1, abs=1.0)


def test_an_outer_legend_leaves_the_other_panels_room() -> None:
    """Give a panel with ten curves its own line.

    Its legend stood between two columns: the titles of the second ran out of the picture.
    """
    x = np.array([0.0, 1.0])
    curves = tuple(Series(f"temperature of body {k}", x, k * x, "line") for k in range(10))
    one = Series("", x, x, "line")
    panels = tuple(Panel("smallest film under load", Axis("x"), Axis("y"), s) for s in (curves, (one,), (one,)))
    figure: Any = draw(ViewData("own", "Own", "", panels, 2))
    assert not collisions(figure)
    warm, left, right = (axes.get_window_extent() for axes in figure.axes)
    assert warm.y0 > left.y1
    assert left.y0 == right.y0
    assert all(axes.get_title(loc="left") for axes in figure.axes)
    assert max(axes._left_title.get_window_extent().x1 for axes in figure.axes) < figure.bbox.x1


def test_a_collision_is_found() -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure: Any = Figure()
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.set_title("slip", loc="left")
    axes.plot([0, 1], label="no slip along rolling")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.0)
    assert collisions(figure) == ["title of panel 0 and legend of panel 0"]
