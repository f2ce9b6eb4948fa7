"""Test animations.

The scene against the run, its motion against mechanics, files that players can open.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from PIL import Image

from lambda_core import api
from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import UsageError
from lambda_core.export.report.run_scene import scene_of
from lambda_core.views.scene import Scene

if TYPE_CHECKING:
    from lambda_core.results.reader import Result


@pytest.fixture(scope="module")
def scene(radial_run: Result) -> Scene:
    return scene_of(radial_run, start=None, turns=0.5, frames=31)


def test_the_scene_is_the_end_of_the_run(radial_run: Result, scene: Scene) -> None:
    assert scene.time[-1] == radial_run["time"][-1]
    np.testing.assert_allclose(scene.load[-1], radial_run["load"][-1])
    np.testing.assert_allclose(scene.body_position[-1], radial_run["body_position"][-1])
    radius = np.hypot(scene.ball_position[-1, :, 1], scene.ball_position[-1, :, 2])
    np.testing.assert_allclose(radius, radial_run["ball_radius"][-1])
    turned = np.abs(scene.ball_azimuth[-1] - scene.ball_azimuth[0]).mean() / (2.0 * math.pi)
    assert turned == pytest.approx(0.5, rel=1e-3)


def test_load_vectors_hold_the_applied_force(scene: Scene) -> None:
    """Compare load vectors of both rings.

    On the inner ring: 16 kN down is met by the balls, which push up; on the outer ring they push down.
    """
    inner, outer = scene.load_vectors().sum(axis=1)[-1]
    assert inner[2] == pytest.approx(16e3, rel=0.01)
    assert outer[2] == pytest.approx(-16e3, rel=0.02)
    assert np.abs(inner[:2]).max() < 200.0


def test_axial_load_pushes_the_inner_ring_back(combined_run: Result) -> None:
    found = scene_of(combined_run, start=0.0, turns=0.1, frames=3)
    inner, outer = found.load_vectors().sum(axis=1)[-1]
    axial = float(api.case(combined_run.case).loads.axial or 0.0)
    assert axial > 100.0
    assert inner[0] == pytest.approx(-axial, rel=0.05)
    assert outer[0] == pytest.approx(axial, rel=0.05)


def test_balls_turn_as_they_roll(scene: Scene) -> None:
    """Compare rolling with orbit times radii.

    Outer ring at rest: a rolling ball turns by orbit angle times (1 - outer race radius over ball radius).
    """
    from scipy.spatial.transform import Rotation

    geometry = scene.geometry
    ball = int(scene.load[0, :, 1].argmax())
    loaded = scene.load[:, ball, 1] > 0.2 * scene.load.max()
    frames = np.flatnonzero(loaded)[:4]  # under load the ball hardly slides
    steps = (
        Rotation.from_quat(scene.ball_rotation[frames[1:], ball])
        * Rotation.from_quat(scene.ball_rotation[frames[:-1], ball]).inv()
    )
    turned = steps.as_rotvec()[:, 0]
    orbit = np.diff(scene.ball_azimuth[frames, ball])
    expected = orbit * (1.0 - geometry["race_diameter_outer"] / geometry["ball_diameter"])
    np.testing.assert_allclose(turned, expected, rtol=0.01)


def test_pockets_stay_around_their_balls(scene: Scene) -> None:
    count = scene.load.shape[1]
    pocket = scene.body_angle[:, 2, None] + 2.0 * math.pi * np.arange(count) / count
    away = np.abs((scene.ball_azimuth - pocket + math.pi) % (2.0 * math.pi) - math.pi)
    # The centre of the cage moves within its play, and balls within their pockets.
    assert away.max() < 3.0 * scene.cage_play / (0.5 * scene.geometry["pitch_diameter"])


def test_frames_are_drawn_and_differ(scene: Scene) -> None:
    short = scene_frames(scene, 3)
    for frame in short:
        assert frame.shape[0] % 2 == frame.shape[1] % 2 == 0
        assert (frame.min(axis=2) < 200).mean() > 0.05
    assert np.any(short[0] != short[1])


def scene_frames(scene: Scene, count: int) -> list[Any]:
    frames = registry().frames(scene)
    return [next(frames) for _ in range(count)]


def test_a_gif_plays_in_a_loop(radial_run: Result, tmp_path: Path) -> None:
    seen: list[tuple[int, int]] = []
    path = api.animate(
        radial_run.path, tmp_path / "six.gif", turns=0.1, frames=4, fps=20.0, progress=lambda *n: seen.append(n)
    )
    with Image.open(path) as picture:
        assert picture.n_frames == 4  # type: ignore[attr-defined]
        assert picture.info["duration"] == 50
        assert picture.info["loop"] == 0
    assert seen[-1] == (4, 4)
    with pytest.raises(UsageError, match="exists: choose another name"):
        api.animate(radial_run.path, path, frames=4)


@pytest.mark.full
def test_an_mp4_needs_no_ffmpeg_of_the_system(
    combined_run: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    imageio_ffmpeg = pytest.importorskip("imageio_ffmpeg")
    monkeypatch.setenv("PATH", "")
    path = api.animate(combined_run.path, tmp_path / "six.mp4", turns=0.1, frames=6, fps=12.0)
    reader = imageio_ffmpeg.read_frames(str(path))
    facts = next(reader)
    frames = [np.frombuffer(frame, np.uint8).reshape(*facts["size"][::-1], 3) for frame in reader]
    assert facts["codec"].startswith("h264")
    assert facts["fps"] == 12.0
    assert len(frames) == 6
    first = scene_frames(scene_of(combined_run, start=None, turns=0.1, frames=6), 1)[0]
    assert np.abs(frames[0].astype(float) - first).mean() < 4.0  # what was drawn is what is played


def glb_parts(path: Path) -> tuple[dict[str, Any], bytes]:
    data = path.read_bytes()
    assert data[:4] == b"glTF"
    assert int.from_bytes(data[8:12], "little") == len(data)
    length = int.from_bytes(data[12:16], "little")
    assert data[16:20] == b"JSON"
    assert length % 4 == 0
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def test_a_gltf_moves_every_part(radial_run: Result, tmp_path: Path) -> None:
    path = api.animate(radial_run.path, tmp_path / "six.glb", turns=0.5, frames=31)
    tree, data = glb_parts(path)

    def numbers(index: int) -> Any:
        accessor = tree["accessors"][index]
        view = tree["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        kind = {5126: np.float32, 5125: np.uint32}[accessor["componentType"]]
        assert view["byteOffset"] % 4 == 0
        assert view["byteLength"] == 4 * accessor["count"] * width
        return np.frombuffer(data, kind, accessor["count"] * width, view["byteOffset"]).reshape(-1, width)

    assert tree["buffers"][0]["byteLength"] <= len(data)
    for mesh in tree["meshes"]:
        part = mesh["primitives"][0]
        places = numbers(part["attributes"]["POSITION"])
        assert numbers(part["indices"]).max() < len(places)
        np.testing.assert_allclose(np.linalg.norm(numbers(part["attributes"]["NORMAL"]), axis=1), 1.0, atol=1e-5)
    scene = scene_of(radial_run, start=None, turns=0.5, frames=31)
    animation = tree["animations"][0]
    moved = {}
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        time, values = numbers(sampler["input"]), numbers(sampler["output"])
        assert len(time) == len(values) == 31
        name = tree["nodes"][channel["target"]["node"]]["name"]
        moved[name, channel["target"]["path"]] = values
    names = {name for name, _ in moved}
    assert {"inner ring", "outer ring", "cage", "ball 1", "ball 9", "load of ball 5 on the outer ring"} <= names
    np.testing.assert_allclose(moved["ball 3", "translation"], scene.ball_position[:, 2], atol=1e-7)
    for (_, path_name), values in moved.items():
        if path_name == "rotation":
            np.testing.assert_allclose(np.linalg.norm(values, axis=1), 1.0, atol=1e-5)
            assert np.all(np.sum(values[1:] * values[:-1], axis=1) >= 0.0)  # no way the long way round
    largest = max(v.max() for (_, path_name), v in moved.items() if path_name == "scale")
    assert largest == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("name", "options", "words"),
    [
        ("six.avi", {}, r"six\.avi .* allowed are \.gif, \.mp4, \.glb"),
        ("six", {}, "format of animations"),
        ("six.gif", {"frames": 1}, "1 frames are out of range: choose 2 to"),
        ("six.gif", {"fps": 500.0}, "choose 1 to 60"),
        ("six.gif", {"turns": 0.0}, "positive number"),
        ("six.gif", {"turns": math.nan}, "give a finite number"),
        ("six.gif", {"start": 9.0}, "has no moment t = 9 s: it reaches from 0 to"),
        ("six.gif", {"start": math.nan}, "give a finite number"),
    ],
)
def test_animations_without_sense_are_refused(
    radial_run: Result, tmp_path: Path, name: str, options: dict[str, Any], words: str
) -> None:
    with pytest.raises(UsageError, match=words):
        api.animate(radial_run.path, tmp_path / name, **options)
    assert not (tmp_path / name).exists()


def test_without_the_extra_the_way_is_told(radial_run: Result, tmp_path: Path) -> None:
    code = f"""
import sys
sys.modules["imageio_ffmpeg"] = None
from lambda_core import api
try:
    api.animate({str(radial_run.path)!r}, {str(tmp_path / "six.mp4")!r})
except api.UsageError as error:
    print(error)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=600)
    assert 'pip install "lambda-bearing[animation]"' in done.stdout
    assert "a name in .gif" in done.stdout
