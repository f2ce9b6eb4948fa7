"""List the operating points that are measured."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

from lambda_core import api
from lambda_core.model.bearing_model import BearingModel

FINE_GRID = ("depth.strips=21", "depth.rows=11")
DEFAULT = "6319-cp10-3000"
BALLS = 9  # of the 6319


@dataclass(frozen=True)
class Point:
    """Named case.

    Everything else is the default model: cage of six degrees of freedom, 1x31, all stages on.
    """

    name: str
    case: str
    changes: tuple[str, ...] = ()

    def model(self) -> BearingModel:
        """Return the resolved model."""
        return api.check(self.case, self.changes)


MIDDLE = Point("6319, 3000 1/min", DEFAULT)
SLOW = Point("6319, 500 1/min", "6319-cp10-500")
FAST = Point("6319, 10 000 1/min", DEFAULT, ("operation.speed=10000 rpm",))
FINE = Point("6319, 3000 1/min, 11x21", DEFAULT, FINE_GRID)
POINTS = (
    SLOW,
    MIDDLE,
    FAST,
    Point("6208 axial, 2750 1/min", "6208-axial-1300"),
    Point("6220 excited, 1500 1/min", "6220-excited"),
    FINE,
)


def with_tolerance(model: BearingModel, tolerance: float) -> BearingModel:
    """Return the same model, integrated to another tolerance."""
    return dataclasses.replace(model, solver=dataclasses.replace(model.solver, tolerance=tolerance))


def without_samples(model: BearingModel) -> BearingModel:
    """Return the same model without output on the way."""
    return dataclasses.replace(model, output=dataclasses.replace(model.output, interval=1e3))


def with_balls(count: int) -> BearingModel:
    """Return the 6319 with other ball count.

    As densely set, as fast along their orbit, as heavily loaded.

    The pitch diameter grows with the number of balls, the radial load with it, the speed falls with it.
    """
    growth = count / BALLS
    base = api.check(DEFAULT).geometry
    pitch, extra = base.pitch_diameter * growth, base.pitch_diameter * (growth - 1.0)
    lengths = {
        "ball_diameter": base.ball_diameter,
        "pitch_diameter": pitch,
        "groove_radius_inner": base.groove_radius_inner,
        "groove_radius_outer": base.groove_radius_outer,
        "shoulder_diameter_inner": base.shoulder_diameter_inner + extra,
        "shoulder_diameter_outer": base.shoulder_diameter_outer + extra,
        "bore_diameter": base.bore_diameter + extra,
        "outside_diameter": base.outside_diameter + extra,
        "width": base.width,
    }
    geometry: dict[str, object] = {name: f"{1e3 * value:.9g} mm" for name, value in lengths.items()}
    changed = {
        "name": f"{count}-balls",
        "bearing": {
            "geometry": {**geometry, "ball_count": count, "series": "63"},
            "clearance": f"{1e6 * base.clearance:.9g} um",
        },
        "lubricant": {"name": "FVA3A", "temperature": "62.5 degC", "oil_level": "0 mm"},
        "loads": {"radial": f"{16.0 * growth:.9g} kN"},
        "operation": {"speed": f"{3000.0 / growth:.9g} rpm"},
        "bodies": {"cage": {"type": "brass-machined"}},
    }
    return api.check(changed)
