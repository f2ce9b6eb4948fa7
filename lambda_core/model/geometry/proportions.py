"""Compare the proportions of a geometry with those in the catalogue.

A geometry may be possible and still a slip of the pen: three balls, an outside diameter of 99 m. The ranges are those
of all ball bearings with known balls in the built-in catalogue; a test computes them anew. Angular contact bearings are
filled over a low shoulder and hold more balls than deep groove ones, whose rings must go apart for it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from lambda_core.model.bearing_model import Geometry

FILLING = (165.0, 198.0)  # angle that the balls span side by side, as at assembly [deg]
ANGULAR_FILLING = (220.0, 325.0)  # of angular contact [deg]
FOUR_POINT_FILLING = (249.0, 340.0)  # of four-point contact, with a split ring [deg]
DOUBLE_ROW_FILLING = (177.0, 200.0)  # of each row of double row angular contact [deg]
ALIGNING_FILLING = (220.0, 301.0)  # of each row of self-aligning bearings, whose rings are swivelled out for it [deg]
FILLINGS = {
    "deep groove": FILLING,
    "angular contact": ANGULAR_FILLING,
    "four-point": FOUR_POINT_FILLING,
    "double row": DOUBLE_ROW_FILLING,
    "self-aligning": ALIGNING_FILLING,
}
WALL = (0.22, 0.61)  # radial wall of a ring under the groove, over the ball diameter
WIDTH = (1.20, 2.21)  # less the distance of two rows, over the ball diameter
# The same of self-aligning bearings: the outer wall is that behind the sphere's middle, the balls fill the width.
ALIGNING_WALL, ALIGNING_WIDTH = (0.21, 0.85), (0.84, 1.22)


def proportion_warnings(g: Geometry) -> Iterator[str]:
    """Yield a sentence for every proportion that no bearing of the catalogue has.

    The angle of filling is 2 (Z - 1) arcsin(D_w/d_m): Z balls that touch each other, from the first centre to the last.
    """
    ball = g.ball_diameter
    angle = 2.0 * (g.ball_count - 1) * math.degrees(math.asin(min(ball / g.pitch_diameter, 1.0)))
    fewest, most = FILLINGS[g.kind]
    walls, broad = (ALIGNING_WALL, ALIGNING_WIDTH) if g.self_aligning else (WALL, WIDTH)
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
