"""Define templates: usual oil, load, speed, clearance and seats.

These are starting points to be changed, with their reasons as comments in the file. Seats and clearance follow the
tables of SKF, Rolling bearings, PUB BU/P1 17000 EN (2018): seat tolerances for standard conditions, clearance.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from importlib import resources
from string import Template


def start_text(template: str, **values: str) -> str:
    """Return a start text with values for its $words."""
    text = resources.files("lambda_core.model").joinpath("templates", f"{template}.toml").read_text(encoding="utf-8")
    return Template(text).substitute(values)


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
    parts : tuple of str
        Start texts after the operation.
    warm : tuple of int
        Temperatures of inner and outer ring [degC], where there are seats.
    """

    words: str
    bearing: str
    oil: str
    temperature: int
    load: float
    thrust: float
    speed: float
    clearance: str
    parts: tuple[str, ...]
    about: tuple[str, str, str] = ("", "", "")  # comments on oil, load and speed
    warm: tuple[int, int] = (0, 0)

    @property
    def tail(self) -> str:
        """Sections after the operation."""
        inner, outer = map(str, self.warm)
        return "".join(start_text(part, inner=inner, outer=outer) for part in self.parts)


GENERAL = MachineTemplate(
    "", "SKF 6208", "FVA3A", 60, 0.1, 0.0, 1500.0, "CN", ("tilt",),
    (
        "lambda-bearing db search --lubricants", "acts downwards on the inner ring",
        "inner ring; the outer ring stands still",
    ),
)  # fmt: skip
ROLLERS = replace(GENERAL, oil="FVA3", parts=())  # of a bearing with rollers
MACHINES: dict[str, MachineTemplate] = {
    "electric-motor": MachineTemplate(
        "drive end of an electric motor, grease", "SKF 6308", "arcanol-multi2", 70, 0.05, 0.1, 3000.0, "C3",
        ("tilt", "seats"),
        ("a grease: lambda-bearing db search --lubricants grease", "rotor and belt or coupling", "two poles at 50 Hz"),
        warm=(75, 65),
    ),
    "gearbox-shaft": MachineTemplate(
        "shaft of a gearbox, oil bath", "SKF 6208", "mineral-vg220", 80, 0.1, 0.25, 1500.0, "C3",
        ("tilt", "seats"),
        ("gear oil", "from the teeth", "input shaft"),
        warm=(85, 78),
    ),
    "spindle": MachineTemplate(
        "spindle, light and fast, oil mist", "SKF 6008", "mineral-vg32", 45, 0.02, 0.5, 9000.0, "C2",
        ("tilt",),
        ("thin: speed makes the film", "cutting force", "finishing"),
    ),
    "pump": MachineTemplate(
        "centrifugal pump, oil sump", "SKF 6306", "mineral-vg46", 65, 0.06, 0.4, 2950.0, "C3",
        ("tilt", "seats"),
        ("circulating oil", "from the impeller", "two poles at 50 Hz, with slip"),
        warm=(70, 62),
    ),
    "wheel": MachineTemplate(
        "wheel or roller on a standing axle, grease", "SKF 6206", "arcanol-load150", 40, 0.12, 0.1, 0.0, "CN",
        ("tilt", "hub"),
        ("a grease", "share of the vehicle's weight", "the axle stands still; see the outer ring"),
    ),
    "thin-housing": MachineTemplate(
        "fast shaft in a thin light-metal housing, ring and cage bend", "SKF 6208", "mineral-vg46", 70, 0.08, 0.2,
        6000.0, "C3", ("tilt", "elastic-parts"),
        ("gear oil, thin", "from the teeth", "electric drive"),
    ),
}  # fmt: skip

SHAFTS = {
    "geared-shaft": "shaft in two bearings with a helical gear: SKF 6208, SKF 6206",
    "motor-shaft": "shaft of a motor with rotor and belt: SKF 6308, SKF NU 208 ECP",
    "tapered-shaft": "gearbox shaft in two tapered roller bearings, X arrangement: SKF 32208",
}


def shaft_text(template: str, name: str) -> str:
    """Return the commented case of one of SHAFTS.

    It is called `name`.
    """
    return start_text(template, name=json.dumps(name)[1:-1])
