"""Provide the circuit with the data of a bearing.

These are dimensions, materials, oil and the laws of its films.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from lambda_core.case.electric import Electric, MachineElectric
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.laws.context import Context, Material, Oil
from lambda_core.model.bearing_model import ChosenLaw, ElectricModel
from lambda_core.model.ledger import Ledger
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.settings.resolve_electric import resolve_electric
from lambda_core.results.rolling import is_full_complement

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.results.reader import Result

_SILICON_NITRIDE = re.compile(r"si3n4|silicon.?nitride", re.IGNORECASE)
_PERMITTIVITY = 8.0  # of it, usual value of makers' sheets: it insulates, whether or not the case says so
_SIDES = (("film_inner", "inner"), ("film_outer", "outer"))


@dataclasses.dataclass(frozen=True)
class CircuitBearing:
    """A bearing with its circuit.

    Attributes
    ----------
    name : str
        Of the bearing in its machine.
    case : str
        Name of the case.
    options : Electric
        The section of the case.
    laws : mapping of str to ChosenLaw
        Role to law.
    geometry : mapping of str to float
        By name, SI.
    contexts : tuple of Context
        What laws may look at, of the inner and the outer contact; lengths that change with the load are NaN.
    roughness : float
        Composite rms roughness [m].
    of_lines : bool
        Whether its contacts are lines of rollers.
    full_complement : bool
        Whether its rollers have no cage.
    """

    name: str
    case: str
    options: Electric
    laws: Mapping[str, ChosenLaw]
    geometry: Mapping[str, float]
    contexts: tuple[Context, Context]
    roughness: float
    of_lines: bool = False
    full_complement: bool = False


def electric_model(options: Electric, name: str) -> ElectricModel:
    """Return a circuit with its laws.

    Raises
    ------
    CaseError
        With everything that is wrong with it.
    """
    from lambda_core.discovery.api import registry

    ledger = Ledger()
    found = resolve_electric(options, registry(), ledger)
    ledger.check(name)
    return found


def circuit_bearings(model: BearingModel | MachineModel) -> list[CircuitBearing]:
    """Return the bearings of a model with their circuit.

    A case without the section gets the defaults.
    """
    chosen = model.electric or electric_model(usual_options(on_shaft=any(model.bearing_models)), model.name)
    found = []
    for name, one in model.bearing_models.items():
        own = dataclasses.replace(chosen, options=chosen.options.of_bearing(name))
        materials = {"ball": one.ball_material, "inner": one.inner_material, "outer": one.outer_material}
        bearing = _circuit_bearing(name or "bearing", model.name, own, one.geometry, materials, one.oil, one.roughness)
        of_lines, full = one.rollers is not None, one.full_complement
        found.append(dataclasses.replace(bearing, of_lines=of_lines, full_complement=full))
    return found


def usual_options(*, on_shaft: bool) -> Electric:
    """Return the circuit of a case without the section."""
    return MachineElectric() if on_shaft else Electric()


def of_run(result: Result, options: Electric) -> CircuitBearing:
    """Return the bearing of a run with a circuit.

    Raises
    ------
    CaseError
        With everything that is wrong with the circuit.
    """
    model = result.model
    geometry = Geometry(**model["geometry"])
    materials = {part: Material(**model[f"{part}_material"]) for part in ("ball", "inner", "outer")}
    oil: dict[str, Any] = {
        name: value if name in ("name", "base_type") else float(value) for name, value in model["oil"].items()
    }
    chosen = electric_model(options, str(result.path))
    roughness = float(model["roughness"])
    found = _circuit_bearing("bearing", result.case, chosen, geometry, materials, Oil(**oil), roughness)
    return dataclasses.replace(
        found, of_lines=model.get("rollers") is not None, full_complement=is_full_complement(model)
    )


def _circuit_bearing(
    name: str,
    case: str,
    chosen: ElectricModel,
    geometry: Geometry,
    materials: Mapping[str, Material],
    oil: Oil,
    roughness: float,
) -> CircuitBearing:
    plain: dict[str, Any] = {
        name: float(value) for name, value in dataclasses.asdict(geometry).items() if not isinstance(value, str)
    }
    inner, outer = (
        Context(
            element=element,
            ball_count=geometry.ball_count,
            ball_diameter=geometry.ball_diameter,
            pitch_diameter=geometry.pitch_diameter,
            bore_diameter=geometry.bore_diameter,
            outside_diameter=geometry.outside_diameter,
            width=geometry.width,
            series=geometry.series,
            speed=float("nan"),
            mean_load=float("nan"),
            ball=materials["ball"],
            partner=materials[ring],
            oil=oil,
            groove_radius=plain[f"groove_radius_{ring}"],
            race_diameter=plain[f"race_diameter_{ring}"],
        )
        for element, ring in _SIDES
    )
    options, film = chosen.options, chosen.options.film
    if film.ball_permittivity is None and _SILICON_NITRIDE.search(materials["ball"].name):
        options = options.model_copy(update={"film": film.model_copy(update={"ball_permittivity": _PERMITTIVITY})})
    return CircuitBearing(name, case, options, chosen.laws, plain, (inner, outer), roughness)
