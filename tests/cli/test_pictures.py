"""Test `view --show`.

Pictures in terminals that can show them, a sentence in those that cannot.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from lambda_cli import pictures, view
from lambda_cli.main import main
from PIL import Image

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

pytest.importorskip("textual_image")


def test_a_pipe_gets_no_picture_and_no_file(
    radial_run: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["view", str(radial_run.path), "film", "--show"]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert "neither kitty's graphics nor sixel" in said.err
    assert "leave --show out for files" in said.err
    assert list(tmp_path.iterdir()) == []


def test_without_the_package_it_is_named(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(pictures, "find_spec", lambda name: None)
    assert main(["view", __file__, "--show"]) == 2
    assert 'pip install "lambda-bearing[pictures]"' in capsys.readouterr().err


def test_a_view_is_printed_as_a_picture(
    radial_run: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    printed: list[tuple[int, int]] = []

    def note(path: Path, kind: object) -> None:
        with Image.open(path) as picture:
            printed.append(picture.size)

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(view, "picture_kind", lambda: object())
    monkeypatch.setattr(view, "print_picture", note)
    assert main(["view", str(radial_run.path), "film", "--show"]) == 0
    ((width, height),) = printed
    assert width > 400
    assert height > 200
    assert list(tmp_path.iterdir()) == []


def test_sixel_is_what_such_a_terminal_gets(tmp_path: Path) -> None:
    from rich.console import Console
    from textual_image.renderable import SixelImage

    path = tmp_path / "red.png"
    Image.new("RGB", (40, 20), "red").save(path)
    console = Console(force_terminal=True, width=20)
    with console.capture() as taken:
        console.print(SixelImage(path, width="100%", height="auto"))
    assert "\x1bP" in taken.get()
