"""Define templates: usual oil, load, speed, clearance and seats.

These are starting points to be changed, with their reasons as comments in the file. Seats and clearance follow the
tables of SKF, Rolling bearings, PUB BU/P1 17000 EN (2018): seat tolerances for standard conditions, clearance.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from importlib import resources

_TILT = """\
[bodies.inner_ring]
tilt_y = "locked"         # a shaft in two bearings hardly tilts; "free" if nothing else holds it,
tilt_z = "locked"         # or { stiffness = "20 N m/mrad" } of the shaft
"""
_SEATS = """
[bearing.fits]            # reduce the clearance; omit this section if you know the mounted clearance
shaft = "{shaft}"
housing = "{housing}"

[bearing.temperatures]    # the shaft is warmer
inner_ring = "{inner} degC"
outer_ring = "{outer} degC"
"""
_HUB = """
[bodies.outer_ring]
spin = { mode = "prescribed", motion = "800 rpm" }  # the hub turns, the axle stands still
"""
_ELASTIC = """
[elastic.outer_ring]            # bends in its seat
housing_stiffness = "300 N/um"  # force over displacement of a rigid ring in its seat: measure it, it matters most

[elastic.cage]                  # bends as a ring of its mass; give its section if you know bars and rims:
# section_height = "3 mm"
# section_width = "4 mm"
"""


@dataclass(frozen=True)
class MachineTemplate:
    """One kind of machine.

    Attributes
    ----------
    words : str
        Description; "" for any.
    bearing : str
        Default designation.
    oil, temperature : str
        Lubricant of the catalogue and its temperature [degC].
    load : float
        Radial load over the dynamic rating C.
    thrust : float
        Axial over radial load.
    speed : float
        Of the inner ring [rpm]; at most half the limiting speed of the bearing is written.
    clearance : str
        Class if the designation has none.
    tail : str
        Sections after the operation.
    """

    words: str
    bearing: str
    oil: str
    temperature: int
    load: float
    thrust: float
    speed: float
    clearance: str
    tail: str
    about: tuple[str, str, str] = ("", "", "")  # comments on oil, load and speed


GENERAL = MachineTemplate(
    "", "SKF 6208", "FVA3A", 60, 0.1, 0.0, 1500.0, "CN", _TILT,
    (
        "lambda-bearing db search --lubricants", "acts downwards on the inner ring",
        "inner ring; the outer ring stands still",
    ),
)  # fmt: skip
ROLLERS = replace(GENERAL, oil="FVA3", tail="")  # of a bearing with rollers
MACHINES: dict[str, MachineTemplate] = {
    "electric-motor": MachineTemplate(
        "drive end of an electric motor, grease", "SKF 6308", "arcanol-multi2", 70, 0.05, 0.1, 3000.0, "C3",
        _TILT + _SEATS.format(shaft="k5", housing="H7", inner=75, outer=65),
        ("a grease: lambda-bearing db search --lubricants grease", "rotor and belt or coupling", "two poles at 50 Hz"),
    ),
    "gearbox-shaft": MachineTemplate(
        "shaft of a gearbox, oil bath", "SKF 6208", "mineral-vg220", 80, 0.1, 0.25, 1500.0, "C3",
        _TILT + _SEATS.format(shaft="k5", housing="H7", inner=85, outer=78),
        ("gear oil", "from the teeth", "input shaft"),
    ),
    "spindle": MachineTemplate(
        "spindle, light and fast, oil mist", "SKF 6008", "mineral-vg32", 45, 0.02, 0.5, 9000.0, "C2",
        _TILT,
        ("thin: speed makes the film", "cutting force", "finishing"),
    ),
    "pump": MachineTemplate(
        "centrifugal pump, oil sump", "SKF 6306", "mineral-vg46", 65, 0.06, 0.4, 2950.0, "C3",
        _TILT + _SEATS.format(shaft="k5", housing="H7", inner=70, outer=62),
        ("circulating oil", "from the impeller", "two poles at 50 Hz, with slip"),
    ),
    "wheel": MachineTemplate(
        "wheel or roller on a standing axle, grease", "SKF 6206", "arcanol-load150", 40, 0.12, 0.1, 0.0, "CN",
        _TILT + _HUB,
        ("a grease", "share of the vehicle's weight", "the axle stands still; see the outer ring"),
    ),
    "thin-housing": MachineTemplate(
        "fast shaft in a thin light-metal housing, ring and cage bend", "SKF 6208", "mineral-vg46", 70, 0.08, 0.2,
        6000.0, "C3", _TILT + _ELASTIC,
        ("gear oil, thin", "from the teeth", "electric drive"),
    ),
}  # fmt: skip


def geared_shaft(name: str) -> str:
    """Return the commented case of a geared shaft.

    The shaft called `name` has two bearings and a gear.
    """
    text = resources.files("lambda_core.model").joinpath("templates", "geared-shaft.toml").read_text(encoding="utf-8")
    return text.replace('"NAME"', json.dumps(name), 1)
