"""Sketch a bearing or a shaft as SVG."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any

from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.elements.ball.kinds import kind_of
from lambda_core.elements.roller.roller_bearing import kind_words

_HEIGHT, _MARGIN = 300.0, 60.0  # of the section of a bearing [px]
_WIDE, _ACROSS = 760.0, 120.0  # of a shaft: length, largest diameter [px]
_STYLE = (
    "<style>.b{fill:#e9edf4;stroke:#1a1a1a;stroke-width:1.2}.k{fill:#fff;stroke:#1a1a1a;stroke-width:1.2}"
    ".g{fill:#f3e3c3;stroke:#8a6d1a;stroke-width:1.2}.d{fill:#dfe7dc;stroke:#48663c;stroke-width:1.2}"
    ".a{stroke:#8a8a8a;stroke-width:.8;stroke-dasharray:10 3 2 3;fill:none}.c{stroke:#17408b;stroke-width:1;fill:none}"
    ".f{stroke:#a33617;stroke-width:2.2;fill:none}.h{fill:#a33617}.m{stroke:#5c5c5c;stroke-width:.8;fill:none}"
    "text{font:12px system-ui,Helvetica,Arial,sans-serif;fill:#1a1a1a}.s{fill:#5c5c5c}.r{fill:#a33617}</style>"
)


def bearing_sketch(
    geometry: Mapping[str, Any], loads: Sequence[float] = (), speed: str = "", units: UnitSystem = SI
) -> str:
    """Draw a bearing in section.

    It shows its main dimensions and the load on its inner ring.

    Parameters
    ----------
    geometry : mapping
        Of the resolved model, SI, with `rollers` where it has them.
    loads : sequence of float
        Radial and axial load [N]; empty where they are not known.
    speed : str
        Of the inner ring, as it is written.
    """
    d, big, width = (float(geometry[f"{name}"]) for name in ("bore_diameter", "outside_diameter", "width"))
    scale = (_HEIGHT - 40.0) / big
    x0, y0 = 0.5 * width * scale + _MARGIN + 60.0, 0.5 * _HEIGHT
    total = width * scale + 2.0 * _MARGIN + 250.0

    def at(x: float, r: float) -> str:
        return f"{x0 + x * scale:.2f},{y0 - r * scale:.2f}"

    parts = []
    for side in (1.0, -1.0):
        if "rollers" in geometry:
            parts += _rollers(geometry, side, at)
            continue
        parts += [_ring(geometry, ring, side, scale, at) for ring in ("outer", "inner")]
        parts += _balls(geometry, side, scale, (x0, y0))
    left, right = x0 - 0.5 * width * scale, x0 + 0.5 * width * scale
    parts.append(f'<path class="a" d="M{left - 40:.1f} {y0:.1f}H{right + 60:.1f}"/>')
    parts += _size(left - 18.0, y0, d * scale, f"d {units.value(1e3 * d, 'mm'):.4g}")
    parts += _size(left - 58.0, y0, big * scale, f"D {units.value(1e3 * big, 'mm'):.4g}")
    wide = units.sentence(f"B {1e3 * width:.4g} mm")
    parts.append(f'<text x="{x0:.1f}" y="{_HEIGHT + 4:.1f}" text-anchor="middle">{wide}</text>')
    for i, line in enumerate(_words(geometry)):
        shown = escape(units.sentence(line))
        parts.append(f'<text class="s" x="{right + 70:.1f}" y="{40 + 17 * i}">{shown}</text>')
    if loads:
        parts += _loads(x0, y0, right, loads, speed, units)
    return _svg(total, _HEIGHT + 14.0, parts, "Section of the bearing with its loads")


def _ring(geometry: Mapping[str, Any], ring: str, side: float, scale: float, at: Any) -> str:
    """Return half a ring in section.

    It is a rectangle with the grooves of its rows.
    """
    half, rows = 0.5 * float(geometry["width"]), int(geometry.get("rows", 1))
    apart = float(geometry.get("row_distance", 0.0)) if rows == 2 else 0.0
    rim = 0.5 * float(geometry["outside_diameter" if ring == "outer" else "bore_diameter"])
    race, shoulder = (0.5 * float(geometry[f"{what}_diameter_{ring}"]) for what in ("race", "shoulder"))
    groove = float(geometry[f"groove_radius_{ring}"])
    depth = min(abs(race - shoulder), groove)
    reach = min(math.sqrt(depth * (2.0 * groove - depth)), half)
    path = [f"M{at(-half, side * rim)}"]
    if ring == "outer" and kind_of(geometry).on_sphere:
        edge = math.sqrt(max(race * race - half * half, 0.0))
        arc = f"A{race * scale:.2f},{race * scale:.2f} 0 0 {1 if side > 0 else 0} {at(half, side * edge)}"
        path += [f"L{at(-half, side * edge)}", arc]
    else:
        path.append(f"L{at(-half, side * shoulder)}")
        for middle in (-0.5 * apart, 0.5 * apart) if rows == 2 else (0.0,):
            sweep = (ring == "outer") == (side > 0.0)
            arc = f"A{groove * scale:.2f},{groove * scale:.2f} 0 0 {int(sweep)} {at(middle + reach, side * shoulder)}"
            path += [f"L{at(middle - reach, side * shoulder)}", arc]
        path.append(f"L{at(half, side * shoulder)}")
    return f'<path class="b" d="{"".join(path)}L{at(half, side * rim)}Z"/>'


def _balls(geometry: Mapping[str, Any], side: float, scale: float, centre: tuple[float, float]) -> list[str]:
    """Return the balls of one side.

    The drawing has the lines through their contacts.
    """
    rows = int(geometry.get("rows", 1))
    apart = float(geometry.get("row_distance", 0.0)) if rows == 2 else 0.0
    angle, radius = float(geometry.get("contact_angle", 0.0)), 0.5 * float(geometry["ball_diameter"]) * scale
    y = centre[1] - side * 0.5 * float(geometry["pitch_diameter"]) * scale
    found = []
    for i, middle in enumerate((-0.5 * apart, 0.5 * apart) if rows == 2 else (0.0,)):
        x = centre[0] + middle * scale
        found.append(f'<circle class="k" cx="{x:.2f}" cy="{y:.2f}" r="{radius:.2f}"/>')
        if angle:
            way = -1.0 if rows == 2 and i == 0 and geometry.get("arrangement") != "X" else 1.0
            dx, dy = 1.4 * radius * math.sin(angle) * way, 1.4 * radius * math.cos(angle) * side
            found.append(f'<path class="c" d="M{x - dx:.2f} {y + dy:.2f}L{x + dx:.2f} {y - dy:.2f}"/>')
    return found


def _rollers(geometry: Mapping[str, Any], side: float, at: Any) -> list[str]:
    """Return the rings and the roller of one side.

    Raceways are parallel to the roller's axis; ribs and the taper of the roller are not drawn.
    """
    own, half, middle = geometry["rollers"], 0.5 * float(geometry["width"]), 0.5 * float(geometry["pitch_diameter"])
    radius, reach = 0.5 * float(own["diameter"]), 0.5 * float(own["length"])
    sine, cosine = math.sin(float(own["contact_angle"])), math.cos(float(own["contact_angle"]))
    found = []
    for rim, way in (("outside_diameter", 1.0), ("bore_diameter", -1.0)):
        edge, race, fall = side * 0.5 * float(geometry[rim]), middle + way * radius / cosine, half * sine / cosine
        corners = (at(-half, edge), at(-half, side * (race + fall)), at(half, side * (race - fall)), at(half, edge))
        found.append(f'<path class="b" d="M{"L".join(corners)}Z"/>')
    ends = ((-reach, radius), (reach, radius), (reach, -radius), (-reach, -radius))
    corners = tuple(at(a * cosine + r * sine, side * (middle - a * sine + r * cosine)) for a, r in ends)
    return [*found, f'<path class="k" d="M{"L".join(corners)}Z"/>']


def _words(geometry: Mapping[str, Any]) -> list[str]:
    """Return what the section is of."""
    if own := geometry.get("rollers"):
        angle, kind = float(own["contact_angle"]), str(own["kind"])
        return [
            f"{kind_words(kind)} roller bearing",
            f"{int(own['count'])} rollers of {1e3 * float(own['diameter']):.4g} mm",
            f"{1e3 * float(own['length']):.4g} mm long",
            f"pitch circle {1e3 * float(own['pitch_diameter']):.4g} mm",
            f"contact angle {math.degrees(angle):.3g} deg" if angle else
            f"clearance {1e6 * float(own['clearance']):.3g} um",
        ]  # fmt: skip
    count, rows = int(geometry["ball_count"]), int(geometry.get("rows", 1))
    found = [
        kind_of(geometry).name,
        f"{'2 x ' if rows == 2 else ''}{count} balls of {1e3 * float(geometry['ball_diameter']):.4g} mm",
        f"pitch circle {1e3 * float(geometry['pitch_diameter']):.4g} mm",
        f"clearance {1e6 * float(geometry['clearance']):.3g} um",
    ]
    angle = float(geometry.get("contact_angle", 0.0))
    return [*found, *([f"contact angle {math.degrees(angle):.3g} deg"] if angle else [])]


def _size(x: float, middle: float, size: float, text: str) -> list[str]:
    """Return a dimension line with its number."""
    top, bottom = middle - 0.5 * size, middle + 0.5 * size
    return [
        f'<path class="m" d="M{x:.1f} {top:.1f}V{bottom:.1f}M{x - 4:.1f} {top:.1f}h8M{x - 4:.1f} {bottom:.1f}h8"/>',
        f'<text transform="translate({x - 5:.1f} {middle:.1f}) rotate(-90)" text-anchor="middle">{text}</text>',
    ]


def _loads(x: float, y: float, right: float, loads: Sequence[float], speed: str, units: UnitSystem) -> list[str]:
    """Return arrows of the loads on the inner ring."""
    radial, axial = loads[0], loads[1]
    found = []
    if abs(radial) > 0.0:
        found += [*_arrow(x, y - 46.0, x, y - 6.0), f'<text class="r" x="{x + 8:.1f}" y="{y - 26:.1f}">'
                  f"F_r {units.sentence(_newton(radial))}</text>"]  # fmt: skip
    if abs(axial) > 1e-3 * abs(radial):
        ends = (right + 12.0, right + 56.0) if axial > 0.0 else (right + 56.0, right + 12.0)
        found += [*_arrow(ends[0], y, ends[1], y), f'<text class="r" x="{right + 64:.1f}" y="{y + 4:.1f}">'
                  f"F_a {units.sentence(_newton(axial))}</text>"]  # fmt: skip
    if speed:
        found.append(f'<text x="{x:.1f}" y="{y + 22:.1f}" text-anchor="middle">{escape(speed)}</text>')
    return found


def _newton(force: float) -> str:
    return f"{force / 1e3:.3g} kN" if abs(force) >= 1e3 else f"{force:.3g} N"


def _arrow(x1: float, y1: float, x2: float, y2: float) -> list[str]:
    """Return an arrow with its head at the second point."""
    length = math.hypot(x2 - x1, y2 - y1)
    ux, uy = (x2 - x1) / length, (y2 - y1) / length
    bx, by = x2 - 9.0 * ux, y2 - 9.0 * uy
    return [
        f'<path class="f" d="M{x1:.1f} {y1:.1f}L{bx:.1f} {by:.1f}"/>',
        f'<path class="h" d="M{x2:.1f} {y2:.1f}L{bx - 4.5 * uy:.1f} {by + 4.5 * ux:.1f}'
        f'L{bx + 4.5 * uy:.1f} {by - 4.5 * ux:.1f}Z"/>',
    ]


def shaft_sketch(
    machine: Mapping[str, Any], sizes: Mapping[str, tuple[float, float, float]], units: UnitSystem = SI
) -> str:
    """Draw a shaft in its bearings.

    It shows gears, discs and places of loads.

    Parameters
    ----------
    machine : mapping
        The machine as plain data (see :func:`lambda_core.results.provenance.machine_data`).
    sizes : mapping
        Bore, outside diameter and width of each bearing [m], by name.
    """
    outline = [tuple(map(float, piece)) for piece in machine["outline"]]
    begin, end = min(piece[0] for piece in outline), max(piece[1] for piece in outline)
    wheels = [(str(name), float(place), float(pitch)) for name, place, pitch in machine.get("wheels", ())]
    across = max([*(one[1] for one in sizes.values()), *(piece[2] for piece in outline)])
    tallest = max([across, *(pitch for _, _, pitch in wheels)])
    scale = min(_WIDE / (end - begin), 2.0 * _ACROSS / tallest)
    x0, y0 = 40.0, 0.5 * tallest * scale + 46.0
    width, height = (end - begin) * scale + 2.0 * x0, 2.0 * y0 + 12.0

    def x(place: float) -> float:
        return x0 + (place - begin) * scale

    def box(kind: str, left: float, right: float, low: float, high: float) -> list[str]:
        size = f'width="{(right - left) * scale:.1f}" height="{(high - low) * scale:.1f}"'
        return [
            f'<rect class="{kind}" x="{x(left):.1f}" y="{y0 - high * scale:.1f}" {size}/>',
            f'<rect class="{kind}" x="{x(left):.1f}" y="{y0 + low * scale:.1f}" {size}/>',
        ]

    parts, labels = [], []
    for left, right, diameter, _ in outline:
        size = f'width="{(right - left) * scale:.1f}" height="{diameter * scale:.1f}"'
        parts.append(f'<rect class="b" x="{x(left):.1f}" y="{y0 - 0.5 * diameter * scale:.1f}" {size}/>')
    for name, place, pitch in wheels:
        wide = 0.03 * (end - begin)
        parts += box("g", place - wide, place + wide, _radius(outline, place), 0.5 * pitch)
        labels.append((x(place), y0 - 0.5 * pitch * scale - 8.0, f"gear {name}"))
    for name, place in machine.get("discs", ()):
        wide, high = 0.012 * (end - begin), 0.45 * across
        parts += box("d", float(place) - wide, float(place) + wide, _radius(outline, float(place)), high)
        below = max([high, *(0.5 * pitch for _, at, pitch in wheels if abs(at - float(place)) < 4.0 * wide)])
        labels.append((x(float(place)), y0 + below * scale + 16.0, f"disc {name}"))
    for name, (bore, outside, wide) in sizes.items():
        place = float(machine["bearings"][name]["position"])
        parts += box("k", place - 0.5 * wide, place + 0.5 * wide, 0.5 * bore, 0.5 * outside)
        for side in (-1.0, 1.0):
            middle = y0 + side * 0.25 * (bore + outside) * scale
            radius = 0.13 * (outside - bore) * scale
            parts.append(f'<circle class="b" cx="{x(place):.1f}" cy="{middle:.1f}" r="{radius:.1f}"/>')
        labels.append((x(place), y0 + 0.5 * outside * scale + 16.0, name))
    for name, place in machine.get("load_places", ()):
        if name not in [wheel[0] for wheel in wheels]:
            top = y0 - (_radius(outline, float(place)) + 0.0) * scale
            parts += _arrow(x(float(place)), top - 34.0, x(float(place)), top - 2.0)
            labels.append((x(float(place)), top - 40.0, str(name)))
    parts.append(f'<path class="a" d="M{x0 - 25:.1f} {y0:.1f}H{width - x0 + 25:.1f}"/>')
    parts += [f'<text x="{at:.1f}" y="{up:.1f}" text-anchor="middle">{escape(text)}</text>' for at, up, text in labels]
    long = units.sentence(f"x from the left end; {1e3 * (end - begin):.4g} mm long")
    parts.append(f'<text class="s" x="{x0:.1f}" y="{height - 4:.1f}">{long}</text>')
    return _svg(width, height, parts, "Shaft with its bearings, gears, discs and loads")


def _radius(outline: Iterable[tuple[float, ...]], place: float) -> float:
    """Return the radius of the shaft at a place."""
    return max((0.5 * piece[2] for piece in outline if piece[0] <= place <= piece[1]), default=0.0)


def _svg(width: float, height: float, parts: Sequence[str], label: str) -> str:
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" role="img" '
        f'aria-label="{escape(label)}">{_STYLE}{"".join(parts)}</svg>'
    )


_ROSE = 130.0  # radius of the circle of balls [px]


def load_sketch(contacts: Sequence[Any], units: UnitSystem = SI, element: str = "ball") -> str:
    """Draw the load of each ball or roller.

    They are seen along +x, the load of each at the inner ring is a bar outwards.

    Parameters
    ----------
    contacts : sequence
        With ring, azimuth_deg and load_N.
    """
    inner = [c for c in contacts if c.ring == "inner"]
    most = max((c.load_N for c in inner), default=0.0)
    size = 2.0 * (_ROSE + 110.0)
    middle = 0.5 * size
    parts = [f'<circle class="a" cx="{middle}" cy="{middle}" r="{_ROSE}"/>']
    radius = min(20.0, 0.8 * math.pi * _ROSE / max(len(inner), 1))
    for contact in inner:
        angle = math.radians(contact.azimuth_deg)  # from +y (left, seen along +x) towards +z (up)
        ux, uy = -math.cos(angle), -math.sin(angle)
        x, y = middle + _ROSE * ux, middle + _ROSE * uy
        parts.append(f'<circle class="k" cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}"/>')
        if most > 0.0 and contact.load_N > 0.005 * most:
            length = 60.0 * contact.load_N / most
            reach = _ROSE + radius + length
            start = f"M{middle + (_ROSE + radius) * ux:.1f} {middle + (_ROSE + radius) * uy:.1f}"
            parts.append(f'<path class="f" style="stroke-width:7" d="{start}L{middle + reach * ux:.1f} '
                         f'{middle + reach * uy:.1f}"/>')  # fmt: skip
            if contact.load_N > 0.1 * most:
                at = f'x="{middle + (reach + 18.0) * ux:.1f}" y="{middle + (reach + 14.0) * uy + 4.0:.1f}"'
                parts.append(f'<text {at} text-anchor="middle">{units.sentence(_newton(contact.load_N))}</text>')
    parts.append(f'<text class="s" x="{middle}" y="{middle - 4}" text-anchor="middle">inner ring loads</text>')
    parts.append(f'<text class="s" x="{middle}" y="{middle + 16}" text-anchor="middle">seen along +x, z up</text>')
    parts.insert(0, "<style>text{font-size:16px}</style>")
    return _svg(size, size, parts, f"Loads of the {element}s at the inner ring")
