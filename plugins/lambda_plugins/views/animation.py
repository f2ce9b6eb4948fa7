"""Draw frames of a moving bearing.

Balls, cage and load vectors, seen along the axis.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Annulus, Circle
from numpy.typing import NDArray

from lambda_core.plugins import FloatArray, Scene
from lambda_plugins.views.style import INK, RC, ROLES, SOFT
from lambda_plugins.views.verbatim import verbatim

_SIZE, _DPI = (12.8, 7.2), 80  # inch, dots per inch: 1024 x 576
_RING, _CAGE = "#e9e9e9", ROLES["cage"].colour
_LONGEST = 0.42  # length of the longest load vector over the radial room of a ring and a ball
_FORCE = 0.35  # the same of pocket forces, over the ball's diameter
_DARKEST = 0.72  # of the greys: arrows and spots stay visible on a loaded ball
_LAND = 0.32  # height of the cage's bars over the ball's diameter
_SPOT = 0.72  # distance of a ball's spot from its centre over the radius


def frames(scene: Scene) -> Iterator[NDArray[np.uint8]]:
    """Yield the frames of a scene as RGB images."""
    scene = verbatim(scene)
    with matplotlib.rc_context(RC):
        figure = Figure(figsize=_SIZE, dpi=_DPI)
        canvas: Any = FigureCanvasAgg(figure)
        parts = _parts(figure, scene)
    for frame in range(scene.frames):
        with matplotlib.rc_context(RC):
            for part in parts:
                part(frame)
            canvas.draw()
        yield np.asarray(canvas.buffer_rgba())[:, :, :3].copy()


def _parts(figure: Figure, scene: Scene) -> list[Any]:
    """Draw the fixed parts and return the moving ones.

    Each moving part is a function of the frame.
    """
    figure.text(0.02, 0.955, scene.title, fontsize=15, weight="bold", color=INK)
    figure.text(0.02, 0.915, scene.source, fontsize=10.5, color=SOFT)
    bearing: Any = figure.add_axes((0.02, 0.06, 0.54, 0.84))
    parts = [*_bearing(bearing, scene), _clock(figure, scene)]
    loads: Any = figure.add_axes((0.66, 0.60, 0.31, 0.27))
    parts.append(_loads(loads, scene))
    if scene.has_cage:
        orbit: Any = figure.add_axes((0.70, 0.085, 0.23, 0.38))
        parts.append(_orbit(orbit, scene))
    return parts


# -- the bearing, seen from +x --


def _bearing(axes: Any, scene: Scene) -> list[Any]:
    size = {name: 1e3 * float(scene.geometry[f"{name}_diameter"]) for name in ("bore", "outside", "ball", "pitch")}
    races = [1e3 * float(scene.geometry[f"race_diameter_{ring}"]) for ring in ("inner", "outer")]
    reach = 0.5 * size["outside"] * 1.05
    axes.set_xlim(-reach, reach)
    axes.set_ylim(-reach, reach)
    axes.set_aspect("equal")
    axes.axis("off")
    for middle, inside, outside in (
        (scene.body_position[0, 0], size["bore"], races[0]),
        (scene.body_position[0, 1], races[1], size["outside"]),
    ):
        ring = Annulus(
            (1e3 * middle[1], 1e3 * middle[2]), 0.5 * outside, 0.5 * (outside - inside), fc=_RING, ec=SOFT, lw=1.0
        )
        axes.add_patch(ring)
    parts = [_spoke(axes, scene, size["bore"], races[0])]
    if scene.has_cage:
        parts.append(_cage(axes, scene, size["ball"], size["pitch"]))
    return [*parts, _balls(axes, scene, size["ball"]), _vectors(axes, scene, races, size["ball"])]


def _spoke(axes: Any, scene: Scene, inside: float, outside: float) -> Any:
    """Draw the mark of the inner ring's rotation."""
    (line,) = axes.plot([], [], color=INK, linewidth=3.0, solid_capstyle="butt", zorder=2)

    def move(frame: int) -> None:
        direction = _unit(scene.body_angle[frame, 0])
        ends = 0.5 * np.array([inside + 0.06 * outside, outside - 0.02 * outside])
        line.set_data(ends * direction[0], ends * direction[1])

    return move


def _cage(axes: Any, scene: Scene, ball: float, pitch: float) -> Any:
    """Draw the bars of the cage between its pockets.

    The orbit shows displacements of micrometres.
    """
    count = scene.load.shape[1]
    half_gap = math.asin(min(0.5 * ball * 1.06 / (0.5 * pitch), 1.0))
    step = 2.0 * math.pi / count
    inside, outside = 0.5 * (pitch - _LAND * ball), 0.5 * (pitch + _LAND * ball)
    bars = [axes.fill([], [], fc=_CAGE, ec=INK, lw=0.8, zorder=3)[0] for _ in range(count)]

    def move(frame: int) -> None:
        for number, bar in enumerate(bars):
            begin = scene.body_angle[frame, 2] + number * step + half_gap
            angle = np.linspace(begin, begin + step - 2.0 * half_gap, 12)
            edge = np.concatenate([outside * _unit(angle).T, inside * _unit(angle[::-1]).T])
            bar.set_xy(edge)

    return move


def _balls(axes: Any, scene: Scene, ball: float) -> Any:
    """Draw the balls, darker under load.

    Each has two spots that turn with it.
    """
    from scipy.spatial.transform import Rotation

    top = 1e-3 * float(scene.load.max()) or 1.0
    greys = ListedColormap(matplotlib.colormaps["Greys"](np.linspace(0.0, _DARKEST, 256)))
    centres = 1e3 * scene.ball_position[:, :, 1:]
    balls = PatchCollection(
        [Circle((0.0, 0.0), 0.5 * ball) for _ in range(centres.shape[1])],
        cmap=greys, norm=Normalize(0.0, top), edgecolor=INK, linewidth=0.9, zorder=4,
    )  # fmt: skip
    axes.add_collection(balls)
    spots = axes.scatter([], [], s=26, facecolor="white", edgecolor=INK, linewidth=0.8, zorder=5)
    bar = axes.figure.colorbar(balls, cax=axes.inset_axes((0.30, 0.485, 0.40, 0.03)), orientation="horizontal")
    bar.set_label(f"largest load of the {scene.element} [kN]")
    body = np.array([[0.35, 0.0, _SPOT], [0.35, 0.0, -_SPOT]])  # of the ball's radius, towards the viewer

    def move(frame: int) -> None:
        balls.set_paths([Circle((c[0], c[1]), 0.5 * ball) for c in centres[frame]])
        balls.set_array(1e-3 * scene.load[frame].max(axis=1))
        turned = np.concatenate([Rotation.from_quat(scene.ball_rotation[frame]).apply(spot) for spot in body])
        places = np.tile(centres[frame], (2, 1)) + 0.5 * ball * turned[:, 1:]
        spots.set_offsets(places[turned[:, 0] > 0.0])

    return move


def _vectors(axes: Any, scene: Scene, races: list[float], ball: float) -> Any:
    """Draw the forces on the rings and balls.

    They are those of the balls on the rings and of the cage on the balls.
    """
    force = 1e-3 * scene.load_vectors()[..., 1:]
    sizes = np.linalg.norm(force, axis=-1)
    most, push = float(sizes.max()) or 1.0, np.linalg.norm(scene.pocket_force[..., 1:], axis=-1)
    room = 0.5 * min(
        races[0] - 1e3 * scene.geometry["bore_diameter"], 1e3 * scene.geometry["outside_diameter"] - races[1]
    )
    length, hardest = (room + ball) * _LONGEST / most, float(push.max())
    lines = [
        LineCollection([], colors=ROLES[ring].colour, linewidths=3.2, zorder=6, clip_on=False)
        for ring in ("inner", "outer")
    ]
    lines.append(LineCollection([], colors=_CAGE, linewidths=3.2, zorder=7))
    heads = [
        axes.scatter(
            [],
            [],
            s=38,
            marker=mark,
            color=line.get_colors(),
            edgecolor="white",
            linewidth=0.6,
            zorder=8,
            clip_on=False,
        )
        for line, mark in zip(lines, "osD", strict=True)
    ]
    for line in lines:
        axes.add_collection(line)
    names = [f"{scene.element} on inner ring, radial part, longest {most:.3g} kN", f"{scene.element} on outer ring"]
    names += [f"cage on {scene.element}, longest {hardest:.3g} N"] if scene.has_cage and hardest > 0.0 else []
    axes.figure.legend(heads[: len(names)], names, loc="lower left", ncols=3, fontsize=10, columnspacing=1.2)

    def move(frame: int) -> None:
        angle = scene.ball_azimuth[frame]
        for ring, (line, head) in enumerate(zip(lines[:2], heads[:2], strict=True)):
            start = 0.5 * races[ring] * _unit(angle).T
            _arrows(line, head, start, length * force[frame, :, ring], sizes[frame, :, ring] > 1e-3 * most)
        if hardest > 0.0:
            start = 1e3 * scene.ball_position[frame, :, 1:]
            shift = _FORCE * 2.0 * ball / hardest * scene.pocket_force[frame, :, 1:]
            _arrows(lines[2], heads[2], start, shift, push[frame] > 1e-3 * hardest)

    return move


def _arrows(line: Any, head: Any, start: FloatArray, shift: FloatArray, shown: NDArray[np.bool_]) -> None:
    start, end = start[shown], (start + shift)[shown]
    line.set_segments(list(np.stack([start, end], axis=1)))
    head.set_offsets(end)


def _clock(figure: Figure, scene: Scene) -> Any:
    text = figure.text(0.66, 0.955, "", fontsize=12, color=INK)

    def move(frame: int) -> None:
        shaft = (scene.body_angle[frame, 0] - scene.body_angle[0, 0]) / (2.0 * math.pi)
        text.set_text(f"t = {1e3 * scene.time[frame]:8.2f} ms    inner ring {shaft:+.2f} turns")

    return move


def _unit(angle: Any) -> FloatArray:
    return np.array([np.cos(angle), np.sin(angle)])


# -- at the side --


def _loads(axes: Any, scene: Scene) -> Any:
    """Draw the load of every ball over its azimuth.

    Faint points show all frames, and a marker the present one.
    """
    azimuth, load = np.degrees(scene.ball_azimuth) % 360.0, 1e-3 * scene.load
    points = []
    for ring, name in enumerate(("inner", "outer")):
        look = ROLES[name]
        axes.plot(azimuth.ravel(), load[:, :, ring].ravel(), ".", color=look.colour, alpha=0.12, markersize=2.5)
        style = {"markersize": 5.0} if look.filled else {"markersize": 9.0, "markerfacecolor": "none"}
        (point,) = axes.plot([], [], look.marker, color=look.colour, label=f"{name} ring", **style)
        points.append(point)
    axes.set_xlim(0.0, 360.0)
    axes.set_xticks(range(0, 361, 90))
    axes.set_ylim(0.0, 1.1 * float(load.max()) or 1.0)
    axes.set_xlabel("azimuth [deg]")
    axes.set_ylabel(f"{scene.element} load [kN]")
    axes.legend(loc="upper left", ncols=2, bbox_to_anchor=(0.0, 1.22), borderaxespad=0.0, handlelength=1.2)

    def move(frame: int) -> None:
        for ring, point in enumerate(points):
            point.set_data(azimuth[frame], load[frame, :, ring])

    return move


def _orbit(axes: Any, scene: Scene) -> Any:
    """Draw the centre of the cage in the outer ring.

    The orbit has its own scale.
    """
    away = 1e6 * (scene.body_position[:, 2, 1:] - scene.body_position[:, 1, 1:])
    axes.plot(away[:, 0], away[:, 1], color=_CAGE, linewidth=1.0, alpha=0.5)
    (point,) = axes.plot([], [], "^", color=_CAGE, markersize=9)
    reach = 1.15 * float(np.abs(away).max()) or 1.0
    if math.isfinite(scene.cage_play):
        play = 1e6 * scene.cage_play
        axes.add_patch(Circle((0.0, 0.0), play, fill=False, ec=ROLES["reference"].colour, lw=1.1))
        reach = max(reach, 1.15 * play)
    axes.set_xlim(-reach, reach)
    axes.set_ylim(-reach, reach)
    axes.set_aspect("equal")
    axes.set_xlabel("y [um]")
    axes.set_ylabel("z [um]")
    axes.set_title("centre of the cage, free play")

    def move(frame: int) -> None:
        point.set_data(away[frame : frame + 1, 0], away[frame : frame + 1, 1])

    return move
