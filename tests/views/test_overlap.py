"""Test that no texts of a picture overlap."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from collisions import collisions, no_collision

from lambda_core.discovery.manager import registry
from lambda_core.export.report.gallery import data_of

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
