"""Compare a bearing's proportions with those in the catalogue.

A geometry may be possible and still a slip of the pen: three balls, an outside diameter of 99 m. The ranges are those
of all ball bearings with known balls in the built-in catalogue; a test computes them anew. Angular contact bearings are
filled over a low shoulder and hold more balls than deep groove ones, whose rings must go apart for it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from lambda_core.elements.ball.geometry import Geometry


def proportion_warnings(g: Geometry) -> Iterator[str]:
    """Yield warnings of unusual proportions.

    No bearing of the catalogue has them.

    The angle of filling is 2 (Z - 1) arcsin(D_w/d_m): Z balls that touch each other, from the first centre to the last.
    """
    ball = g.ball_diameter
    angle = 2.0 * (g.ball_count - 1) * math.degrees(math.asin(min(ball / g.pitch_diameter, 1.0)))
    fewest, most = g.kind.filling
    walls, broad = g.kind.walls, g.kind.width
    if not fewest <= angle <= most:
        yield (
            f"{g.ball_count} balls of {ball * 1e3:.6g} mm side by side span {angle:.0f} deg of the pitch circle: "
            f"bearings of the catalogue are filled to {fewest:g} to {most:g} deg"
        )
    less = " less the distance of the rows" if g.row_distance else ""
    inner = 0.5 * (g.race_diameter_inner - g.bore_diameter)
    outer = 0.5 * (g.outside_diameter - g.race_diameter_outer)
    for what, size, (least, most) in (
        ("the wall of the inner ring under its groove", inner, walls),
        ("the wall of the outer ring under its groove", outer, walls),
        (f"the width{less}", g.width - g.row_distance, broad),
    ):
        if not least * ball <= size <= most * ball:
            yield (
                f"{what}, {size * 1e3:.4g} mm, is {size / ball:.3g} ball diameters: {least:g} to {most:g} in bearings "
                "of the catalogue"
            )
