"""Write animations as MP4, GIF and glTF."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.discovery.api import Registry
from lambda_core.domain.errors import UsageError
from lambda_core.domain.files import check_target
from lambda_core.views.scene import Scene

Image = NDArray[np.uint8]
Report = Callable[[int, int], None]
FORMATS = (".gif", ".mp4", ".glb")
MOST_FRAMES, FASTEST = 20_000, 60.0
_COLOURS = 64  # of a GIF


def check_format(path: Path) -> str:
    """Return the format by a file's name.

    UsageError when there is none such, or it cannot be made.
    """
    name = path.suffix.lower()
    if name not in FORMATS:
        allowed = ", ".join(FORMATS)
        raise UsageError(
            f"{path.name} has no known format of animations; allowed are {allowed}: give the file one of these endings"
        )
    if name == ".mp4":
        _encoder()
    return name


def check_pace(turns: float, frames: int, fps: float) -> None:
    """Refuse numbers of frames out of range.

    Raises
    ------
    UsageError
        With what is allowed.
    """
    if not 0.0 < turns < np.inf:
        raise UsageError(f"{turns:g} revolutions of the cage cannot be shown: choose a positive number")
    if not 2 <= frames <= MOST_FRAMES:
        raise UsageError(f"{frames} frames are out of range: choose 2 to {MOST_FRAMES}")
    if not 1.0 <= fps <= FASTEST:
        raise UsageError(f"{fps:g} frames per second cannot be played: choose 1 to {FASTEST:g}")


def write_animation(registry: Registry, scene: Scene, path: Path, fps: float, report: Report | None = None) -> Path:
    """Write a scene in the file name's format.

    Parameters
    ----------
    fps : float
        Frames per second of the film.
    report : callable, optional
        Called with the number of frames done and of all.

    Raises
    ------
    UsageError
        For an unknown format, or a file that cannot be written.
    """
    name = check_format(path)
    check_target(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if name == ".glb":
            from lambda_core.export.report.gltf import glb

            path.write_bytes(glb(scene, fps))
        else:
            frames = _counted(registry.frames(scene), scene.frames, report)
            (_gif if name == ".gif" else _mp4)(frames, path, fps)
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror or error}") from None
    return path


def _counted(frames: Iterator[Image], total: int, report: Report | None) -> Iterator[Image]:
    for number, frame in enumerate(frames, 1):
        yield frame
        if report is not None:
            report(number, total)


def _encoder() -> Any:
    """Return the module that brings an ffmpeg of its own."""
    try:
        return import_module("imageio_ffmpeg")
    except ImportError:
        raise UsageError(
            'MP4 needs an encoder: pip install "lambda-bearing[animation]"; a GIF needs nothing: give a name in .gif'
        ) from None


def _mp4(frames: Iterator[Image], path: Path, fps: float) -> None:
    """Encode H.264 that browsers and slides play.

    The film has 4:2:0 sampling and its index in front.
    """
    first = next(frames)
    height, width = first.shape[:2]
    writer = _encoder().write_frames(
        str(path), (width, height), fps=fps, codec="libx264", pix_fmt_out="yuv420p", quality=7, macro_block_size=2,
        output_params=["-movflags", "+faststart"],
    )  # fmt: skip
    writer.send(None)
    try:
        writer.send(np.ascontiguousarray(first))
        for frame in frames:
            writer.send(np.ascontiguousarray(frame))
    finally:
        writer.close()


def _gif(frames: Iterator[Image], path: Path, fps: float) -> None:
    """Write a GIF that repeats.

    All frames share the colours of the first, so that nothing flickers.
    """
    from PIL import Image as Picture

    first = Picture.fromarray(next(frames)).quantize(_COLOURS, dither=Picture.Dither.NONE)
    rest = (Picture.fromarray(frame).quantize(palette=first, dither=Picture.Dither.NONE) for frame in frames)
    first.save(path, save_all=True, append_images=rest, duration=round(1e3 / fps), loop=0, optimize=False)
