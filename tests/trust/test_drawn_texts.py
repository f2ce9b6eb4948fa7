"""Test that texts of users are drawn as written."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lambda_plugins.views.verbatim import verbatim
from matplotlib.text import Text

from lambda_core import api
from lambda_core.discovery.manager import registry
from lambda_core.export.report.run_scene import scene_of
from lambda_core.plugins import Axis, Mark, Panel, Series, ViewData

CASE = "6208-axial-1300"
HOSTILE = r"$\frac{ $"
X = np.linspace(1.0, 10.0, 5)


def laid_out(figure: Any) -> set[str]:
    """Return the figure's texts as laid out.

    A formula in them would have been read.
    """
    figure.canvas.draw()
    found = set()
    for text in figure.findobj(Text):
        for line in text.get_text().splitlines():
            plain, formula = text._preprocess_math(line)
            if "frac" in plain:
                assert formula is False
                found.add(plain)
    return found


def test_c4_formulas_in_texts_are_not_read() -> None:
    panel = Panel(
        f"1 {HOSTILE}",
        Axis("", categories=tuple(f"{name} {HOSTILE}" for name in "abcde")),
        Axis(f"2 {HOSTILE}"),
        (Series(f"3 {HOSTILE}", np.arange(5.0), X), Series("other", np.arange(5.0), -X)),
        (Mark(f"4 {HOSTILE}", 2.0),),
    )
    figure: Any = registry().figure(None, ViewData("film", f"5 {HOSTILE}", f"6 {HOSTILE}", (panel,), 1, (HOSTILE,)))
    assert laid_out(figure) == {HOSTILE, *(f"{mark} {HOSTILE}" for mark in "123456abcde")}


# Reports draw with the same function.
def test_c4_a_title_like_a_formula_breaks_no_picture(tmp_path: Path) -> None:
    from lambda_plugins.views import animation  # which loads Matplotlib

    case = api.init_case("hostile", CASE, tmp_path / "case.toml")
    text = case.read_text(encoding="utf-8")
    # As TOML writes it: escapes of the terminal, the zero that ends texts elsewhere.
    case.write_text(text.replace('description = "', r'description = "$\\frac{ $ \u0000 \u001b[31m '), encoding="utf-8")
    path = tmp_path / "r.h5"
    api.run(case, ["solver.duration=1 ms"], out=path)
    figure: Any = registry().figure(None, api.view(path, "load-distribution"))
    figure.canvas.draw()
    assert next(animation.frames(scene_of(api.result(path), start=None, turns=1.0, frames=2))).any()


@pytest.mark.parametrize("value", [1, None, ("a", 2), {"b": 1.5}])
def test_what_holds_no_formula_stays(value: object) -> None:
    assert verbatim(value) == value
