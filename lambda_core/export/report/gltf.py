"""Write a scene with its motion as glTF 2.0.

One node per part, moved by key frames of translation and rotation. Lengths in metres as in the inertial frame;
displacements are true to scale. glTF has y upwards, so the scene hangs under a node that turns z up.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.ball.raceways import row_places
from lambda_core.model.geometry.ring_profile import geometry_of, profiles
from lambda_core.views.scene import Scene

Surface = tuple[FloatArray, NDArray[np.uint32]]  # places, shape (n, 3); triangles, shape (m, 3)
_FLOAT, _INDEX = 5126, 5125  # glTF component types: float32, uint32
_AROUND, _ACROSS = 96, 16  # segments of rings; of a ball half as many as around
_ALONG = 61  # points of a ring along its width
_GLASS = 0.35  # opacity of the rings: loads and balls inside them stay visible
_STEEL, _DARK, _BRASS, _RED = (0.75, 0.76, 0.78), (0.25, 0.27, 0.32), (0.72, 0.55, 0.25), (0.8, 0.15, 0.1)


@dataclass
class _File:
    """Contents of a glTF file."""

    tree: dict[str, Any]
    data: bytearray = field(default_factory=bytearray)

    def accessor(self, values: FloatArray | NDArray[np.uint32], kind: str, *, limits: bool = False) -> int:
        """Append numbers and return the index of their accessor."""
        integer = np.issubdtype(values.dtype, np.integer)
        flat = np.ascontiguousarray(values, dtype=np.uint32 if integer else np.float32)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": flat.nbytes}
        self.data += flat.tobytes()
        self.tree["bufferViews"].append(view)
        accessor: dict[str, Any] = {
            "bufferView": len(self.tree["bufferViews"]) - 1,
            "componentType": _INDEX if integer else _FLOAT,
            "count": flat.shape[0],
            "type": kind,
        }
        if limits:
            columns = flat.reshape(flat.shape[0], -1)
            accessor |= {"min": columns.min(axis=0).tolist(), "max": columns.max(axis=0).tolist()}
        return self._add("accessors", accessor)

    def mesh(self, name: str, surface: Surface, colour: tuple[float, ...], opacity: float = 1.0) -> int:
        """Append a mesh in one colour; returns its index."""
        places, triangles = surface
        material = self._add(
            "materials",
            {
                "name": name,
                "pbrMetallicRoughness": {
                    "baseColorFactor": [*colour, opacity], "metallicFactor": 0.4, "roughnessFactor": 0.5,
                },
                "doubleSided": True,
                **({"alphaMode": "BLEND"} if opacity < 1.0 else {}),
            },
        )  # fmt: skip
        primitive = {
            "attributes": {
                "POSITION": self.accessor(places, "VEC3", limits=True),
                "NORMAL": self.accessor(_normals(places, triangles), "VEC3"),
            },
            "indices": self.accessor(triangles.ravel(), "SCALAR"),
            "material": material,
        }
        return self._add("meshes", {"name": name, "primitives": [primitive]})

    def node(self, name: str, parent: int, **more: Any) -> int:
        """Append a node below another; returns its index."""
        index = self._add("nodes", {"name": name, **more})
        self.tree["nodes"][parent].setdefault("children", []).append(index)
        return index

    def move(self, node: int, path: str, time: int, values: FloatArray) -> None:
        """Append key frames of a node: translation, rotation or scale."""
        animation = self.tree["animations"][0]
        output = self.accessor(values, "VEC4" if path == "rotation" else "VEC3")
        animation["samplers"].append({"input": time, "output": output, "interpolation": "LINEAR"})
        target = {"node": node, "path": path}
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": target})

    def _add(self, kind: str, item: dict[str, Any]) -> int:
        self.tree.setdefault(kind, []).append(item)
        return len(self.tree[kind]) - 1

    def binary(self) -> bytes:
        """Return the file in binary form.

        It has a header, a JSON chunk and a binary chunk (glTF 2.0 specification, section 4).
        """
        self.tree["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.tree, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.data) + b"\0" * (-len(self.data) % 4)
        chunks = [len(text).to_bytes(4, "little"), b"JSON", text, len(data).to_bytes(4, "little"), b"BIN\0", data]
        size = 12 + sum(map(len, chunks))
        return b"".join([b"glTF", (2).to_bytes(4, "little"), size.to_bytes(4, "little"), *chunks])


def glb(scene: Scene, fps: float) -> bytes:
    """Return a scene as a binary glTF file."""
    upright = {"name": scene.title, "rotation": [-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)], "children": []}
    file = _File(
        {
            "asset": {"version": "2.0", "generator": "lambda-bearing"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [upright],
            "bufferViews": [],
            "animations": [{"name": "run", "samplers": [], "channels": []}],
        }
    )
    time = file.accessor(np.arange(scene.frames) / fps, "SCALAR", limits=True)
    _rings(file, scene, time)
    if scene.has_cage:
        _cage(file, scene, time)
    _balls(file, scene, time)
    _loads(file, scene, time)
    return file.binary()


def _rings(file: _File, scene: Scene, time: int) -> None:
    size, shapes = scene.geometry, profiles(geometry_of(dict(scene.geometry)))
    half, groove = 0.5 * size["width"], 0.5 * size["ball_diameter"]
    x = np.linspace(-half, half, _ALONG)
    for body, name, far in ((0, "inner", "bore_diameter"), (1, "outer", "outside_diameter")):
        profile = np.array([shapes[body](float(place)) for place in x])
        if scene.rollers is not None:
            profile = scene.rollers.raceway(name, 0.5 * size[f"race_diameter_{name}"], groove, x)
        back = 0.5 * size[far]
        outline = np.array([(-half, back), *zip(x, profile, strict=True), (half, back)])
        mesh = file.mesh(f"{name} ring", _turned(outline), _STEEL, _GLASS)
        node = file.node(f"{name} ring", 0, mesh=mesh)
        file.move(node, "translation", time, scene.body_position[:, body])
        file.move(node, "rotation", time, _pose(scene, body))
        # A mark that turns with the ring.
        edge = np.array([[half, back, 0.0], [half, profile[-1], 0.0]])
        spot = file.mesh(f"mark of the {name} ring", _tube(edge[0], edge[1], 0.04 * groove), _RED)
        file.node(f"mark of the {name} ring", node, mesh=spot)


def _cage(file: _File, scene: Scene, time: int) -> None:
    """Add two rims with bars between the pockets.

    It is a picture of a cage, not the drawing of this one.
    """
    size, places = scene.geometry, row_places(geometry_of(dict(scene.geometry)))
    count = scene.load.shape[1] // len(places)
    ball, pitch = 0.5 * size["ball_diameter"], 0.5 * size["pitch_diameter"]
    node = file.node("cage", 0)
    high, side = 0.16 * ball, 1.02 * ball
    for place in (places[0] - side - 0.12 * ball, places[-1] + side):
        outline = np.array([(place, pitch - high), (place + 0.12 * ball, pitch - high),
                            (place + 0.12 * ball, pitch + high), (place, pitch + high)])  # fmt: skip
        file.node("rim", node, mesh=file.mesh("rim", _turned(outline), _BRASS))
    gap = max(pitch * math.sin(math.pi / count) - 1.02 * ball, 0.05 * ball)
    for row, place in enumerate(places):  # pockets of two rows stand in turn
        for number in range(count):
            angle = 2.0 * math.pi * (number + 0.5 + 0.5 * row) / count
            middle = np.array([place, pitch * math.cos(angle), pitch * math.sin(angle)])
            reach = np.array([side, 0.0, 0.0])
            file.node("bar", node, mesh=file.mesh("bar", _tube(middle - reach, middle + reach, gap), _BRASS))
    file.move(node, "translation", time, scene.body_position[:, 2])
    file.move(node, "rotation", time, _pose(scene, 2))


def _balls(file: _File, scene: Scene, time: int) -> None:
    radius = 0.5 * scene.geometry["ball_diameter"]
    shape, across, away = _sphere(radius), 0.3 * radius, 0.93 * radius
    if scene.rollers is not None:
        end, taper = 0.5 * scene.rollers.length, math.tan(scene.rollers.half)
        small, large = radius - end * taper, radius + end * taper
        shape, across = _turned(np.array([(-end, 0.0), (-end, large), (end, small), (end, 0.0)])), end
        away = 0.6 * small
    mesh, spot = file.mesh(scene.element, shape, _STEEL), file.mesh("spot", _sphere(0.12 * radius), _DARK)
    for ball in range(scene.load.shape[1]):
        node = file.node(f"{scene.element} {ball + 1}", 0, mesh=mesh)
        for side in (-1.0, 1.0):
            file.node("spot", node, mesh=spot, translation=[across, 0.0, side * away])
        file.move(node, "translation", time, scene.ball_position[:, ball])
        file.move(node, "rotation", time, _continuous(scene.ball_rotation[:, ball]))


def _loads(file: _File, scene: Scene, time: int) -> None:
    """Add an arrow per contact.

    It is along its own x, scaled and turned by its force.
    """
    radius = 0.5 * scene.geometry["ball_diameter"]
    mesh = file.mesh("load", _arrow(radius), _RED)
    vectors, most = scene.load_vectors(), float(scene.load.max()) or 1.0
    for ball in range(scene.load.shape[1]):
        for ring, name in enumerate(("inner", "outer")):
            force = vectors[:, ball, ring]
            size = np.linalg.norm(force, axis=1)
            along = np.divide(force, size[:, None], out=np.zeros_like(force), where=size[:, None] > 0.0)
            node = file.node(f"load of {scene.element} {ball + 1} on the {name} ring", 0, mesh=mesh)
            file.move(node, "translation", time, scene.ball_position[:, ball] + radius * along)
            file.move(node, "rotation", time, _continuous(_from_x(along)))
            file.move(node, "scale", time, np.repeat(size[:, None] / most, 3, axis=1))


# -- orientation, as quaternions x, y, z, w --


def _pose(scene: Scene, body: int) -> FloatArray:
    """Return the orientation of a body.

    It spins about x, then tilts about y, then about z.
    """
    from scipy.spatial.transform import Rotation

    spin = Rotation.from_rotvec(scene.body_angle[:, body, None] * np.array([1.0, 0.0, 0.0]))
    tilt_y, tilt_z = (scene.body_tilt[:, body, k, None] * np.eye(3)[1 + k] for k in range(2))
    return _continuous((Rotation.from_rotvec(tilt_z) * Rotation.from_rotvec(tilt_y) * spin).as_quat())


def _from_x(direction: FloatArray) -> FloatArray:
    """Return the rotations from x to unit vectors.

    It is the identity for zero vectors.
    """
    found = np.stack([np.zeros(len(direction)), -direction[:, 2], direction[:, 1], 1.0 + direction[:, 0]], axis=1)
    size = np.linalg.norm(found, axis=1, keepdims=True)
    identity = np.array([0.0, 0.0, 0.0, 1.0])
    result: FloatArray = np.where(size > 1e-9, found / np.maximum(size, 1e-9), identity)
    return result


def _continuous(quaternions: FloatArray) -> FloatArray:
    """Return orientations without jumps of sign.

    Viewers interpolate between them.
    """
    turned = np.sum(quaternions[1:] * quaternions[:-1], axis=1) < 0.0
    signs = np.cumprod(np.append(1.0, np.where(turned, -1.0, 1.0)))
    found: FloatArray = quaternions * signs[:, None]
    return found


# -- surfaces --


def _turned(outline: FloatArray) -> Surface:
    """Turn a closed outline about the x axis.

    The outline is (x, radius); corners stay sharp.
    """
    following = np.roll(outline, -1, axis=0)
    segments = np.stack([outline, following], axis=1).reshape(-1, 2)
    angle = np.linspace(0.0, 2.0 * math.pi, _AROUND + 1)
    x = np.repeat(segments[:, :1], angle.size, axis=1)
    places = np.stack([x, np.outer(segments[:, 1], np.cos(angle)), np.outer(segments[:, 1], np.sin(angle))], axis=-1)
    strips = [_mesh_of(2, angle.size) + 2 * k * angle.size for k in range(len(outline))]
    return places.reshape(-1, 3), np.concatenate(strips).astype(np.uint32)


def _mesh_of(rows: int, columns: int) -> NDArray[np.int64]:
    """Return the triangles of a grid of points."""
    r, c = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
    a = (r * columns + c).ravel()
    return np.concatenate([np.stack([a, a + 1, a + columns], 1), np.stack([a + 1, a + columns + 1, a + columns], 1)])


def _sphere(radius: float) -> Surface:
    polar, around = np.linspace(0.0, math.pi, _ACROSS + 1), np.linspace(0.0, 2.0 * math.pi, 2 * _ACROSS + 1)
    ring = np.outer(np.sin(polar), np.ones_like(around))
    places = np.stack([np.outer(np.cos(polar), np.ones_like(around)), ring * np.cos(around), ring * np.sin(around)], -1)
    return radius * places.reshape(-1, 3), _mesh_of(polar.size, around.size).astype(np.uint32)


def _tube(begin: FloatArray, end: FloatArray, radius: float) -> Surface:
    """Return a closed round bar between two points."""
    length = float(np.linalg.norm(end - begin))
    places, triangles = _turned(np.array([(0.0, 0.0), (0.0, radius), (length, radius), (length, 0.0)]))
    return _laid(places, (end - begin) / length) + begin, triangles


def _arrow(length: float) -> Surface:
    """Return an arrow along x from the origin."""
    outline = np.array([(0.0, 0.0), (0.0, 0.06), (0.7, 0.06), (0.7, 0.15), (1.0, 0.0)])
    return _turned(length * outline)


def _laid(places: FloatArray, direction: FloatArray) -> FloatArray:
    from scipy.spatial.transform import Rotation

    found: FloatArray = Rotation.from_quat(_from_x(direction[None])[0]).apply(places)
    return found


def _normals(places: FloatArray, triangles: NDArray[np.uint32]) -> FloatArray:
    """Return unit normals at the places.

    They are means of the triangles around each, by area.
    """
    corners = places[triangles]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    found = np.zeros_like(places)
    for k in range(3):
        np.add.at(found, triangles[:, k], flat)
    size = np.linalg.norm(found, axis=1, keepdims=True)
    result: FloatArray = np.where(size > 0.0, found / np.where(size > 0.0, size, 1.0), np.array([1.0, 0.0, 0.0]))
    return result
