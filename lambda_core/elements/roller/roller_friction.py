"""Compute the friction torque of a roller bearing.

Rolling resistance of the inlets, losses in the solids, sliding of the raceways that carries the traction, sliding of
roller ends on ribs, drag of rollers in the oil bath. The cage is left out. Every torque is a dissipated power over the
speed of one ring against the other.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller import line_film
from lambda_core.elements.roller.line_contact import half_width, peak_pressure
from lambda_core.elements.roller.rib import rib_film
from lambda_core.elements.roller.roller_bearing import Rib, Ring, RollerBearing
from lambda_core.elements.roller.roller_drag import bath_drag
from lambda_core.elements.roller.roller_equilibrium import RollerEquilibrium
from lambda_core.elements.roller.roller_motion import RollerMotion
from lambda_core.elements.roller.rolling import flow_shear, rolling_force
from lambda_core.elements.roller.rolling_fits import (
    aihara_rolling_force,
    matsuyama_rolling_force,
    zhou_hoeprich_rolling_force,
)
from lambda_core.elements.roller.slices import slice_positions
from lambda_core.formulas.hertz import HertzContact, hertz_contact

# K_L and K_Z of SKF's friction model (SKF, Rolling bearings, 2018, "Friction"), remembered: K_Z of the replenishment
# factor, both of the drag.
SKF_CONSTANTS = {"cylindrical": (0.65, 5.1), "full complement": (0.7, 6.2), "tapered": (0.7, 6.0), "needle": (0.5, 5.5)}
# B and C of the load share of asperities at ribs (Zhou and Hoeprich): Wingertszahn et al. 2023, Lubricants 11, 369.
RIB_ASPERITIES = (1.90, 0.99)
_CELLS = 24  # of a rib contact along each axis


def _biboulet_houpert(
    load: FloatArray, radius: FloatArray, speed: FloatArray, viscosity: float, _alpha: float, e_eff: float
) -> FloatArray:
    return rolling_force(load, radius, speed, viscosity, e_eff)


_Law = Callable[[FloatArray, FloatArray, FloatArray, float, float, float], FloatArray]
# By the names of the laws of lines in motion: load per length, reduced radius, speed, eta, alpha, E' [SI].
ROLLING_LAWS: dict[str, _Law] = {
    "biboulet-houpert-line": _biboulet_houpert,
    "matsuyama-line": matsuyama_rolling_force,
    "zhou-hoeprich-line": zhou_hoeprich_rolling_force,
    "aihara-line": aihara_rolling_force,
}


def _murch_wilson(speed: FloatArray, _peak: FloatArray, _e_eff: float, oil: OilState) -> FloatArray:
    return line_film.inlet_heat_rolling_film(speed, oil.viscosity, oil.temperature_slope, oil.conductivity)


def _zhu_cheng(speed: FloatArray, peak: FloatArray, e_eff: float, oil: OilState) -> FloatArray:
    return line_film.inlet_heat_film(speed, 0.0, peak, e_eff, oil.viscosity, oil.temperature_slope, oil.conductivity)


# Factors of inlet heating on films of raceways by the names of the laws in motion: speed, peak pressure, E' [SI], oil.
THERMAL_LAWS: dict[str, Callable[[FloatArray, FloatArray, float, OilState], FloatArray]] = {
    "murch-wilson": _murch_wilson,
    "zhu-cheng": _zhu_cheng,
}
FILM_LAWS: dict[str, _Law] = {"moes-line": line_film.moes_line_film, "dowson-toyoda": line_film.dowson_toyoda_film}


@dataclass(frozen=True)
class OilState:
    """The oil at its bulk temperature, SI."""

    viscosity: float  # at ambient pressure [Pa s]
    density: float  # [kg/m3]
    pressure_viscosity: float  # alpha [1/Pa]
    temperature_slope: float  # beta = -d ln(eta)/dT [1/K]
    conductivity: float  # [W/(m K)]

    @property
    def kinematic(self) -> float:
        """Kinematic viscosity [m2/s]."""
        return self.viscosity / self.density


@dataclass(frozen=True)
class FrictionParameters:
    """Friction data apart from the operating point.

    Friction also depends on geometry, load, speed and oil.
    """

    raceway_roughness: float = 0.16e-6  # composite rms [m]: Wingertszahn et al. 2023, Lubricants 11, 369
    rib_roughness: float = 0.24e-6  # composite rms [m]: the same
    asperity_scale: float = RIB_ASPERITIES[0]  # B of the asperities' share at ribs
    asperity_exponent: float = RIB_ASPERITIES[1]  # C
    boundary_friction: float = 0.12  # SKF, Rolling bearings, 2018, "Friction": mu_bl of a running bearing
    eyring_stress: float = 8e6  # [Pa], class value of mineral oils
    limit_ratio: float = 0.065  # limiting shear stress over pressure, class value of mineral oils
    loss_factor: float = 0.03  # of the elastic work, as for balls: the material is the same
    inlet_heat: float = 0.29  # Aihara 1987
    replenishment: float = 3e-8  # SKF's K_rs of oil bath at low level and oil jet; zero: flooded
    oil_height: float = 0.0  # H above the lowest point of the outer raceway [m]; zero: no bath
    drag_factor: float = 1.0  # of the drag in a bath of that height
    rolling_law: str = "biboulet-houpert-line"  # of ROLLING_LAWS
    film_law: str = "moes-line"  # of FILM_LAWS
    thermal_law: str = "murch-wilson"  # of THERMAL_LAWS


@dataclass(frozen=True)
class RollerFriction:
    """Torque and its parts [N m], films and tractions."""

    rolling: dict[str, float] = field(default_factory=dict)  # of the inlets, by ring
    hysteresis: dict[str, float] = field(default_factory=dict)
    sliding: dict[str, float] = field(default_factory=dict)
    rib: float = 0.0
    drag: float = 0.0
    film: dict[str, FloatArray] = field(default_factory=dict)  # central film of every slice [m], (Z, n); NaN unloaded
    contact_film: dict[str, FloatArray] = field(default_factory=dict)  # central film of every contact [m], (Z,)
    minimum_film: dict[str, FloatArray] = field(default_factory=dict)  # the same of the minimum film
    film_parameter: dict[str, float] = field(default_factory=dict)  # smallest Lambda under load by ring
    pressure: dict[str, float] = field(default_factory=dict)  # largest Hertz pressure by ring [Pa]
    rib_film: float = math.nan  # smallest of the loaded ribs [m]
    rib_friction: float = math.nan  # coefficient of the most loaded rib
    rib_pressure: float = 0.0  # largest [Pa]
    heat_factor: float = 1.0  # on rolling resistance
    supply_factor: float = 1.0  # on rolling resistance

    @property
    def raceways(self) -> float:
        """Torque of both raceways [N m]."""
        return sum(sum(part.values()) for part in (self.rolling, self.hysteresis, self.sliding))

    @property
    def total(self) -> float:
        """All parts [N m]."""
        return self.raceways + self.rib + self.drag


def friction(
    bearing: RollerBearing,
    state: RollerEquilibrium,
    motion: RollerMotion,
    oil: OilState,
    given: FrictionParameters | None = None,
) -> RollerFriction:
    """Return the friction torque in an equilibrium.

    Parameters
    ----------
    bearing : RollerBearing
        Geometry.
    state : RollerEquilibrium
        Loads of slices and ribs.
    motion : RollerMotion
        Kinematics; the rings must turn against each other.
    oil : OilState
        At the inlet.
    given : FrictionParameters, optional
        Surfaces, laws' constants and bath.

    Raises
    ------
    ValueError
        When nothing turns.
    """
    if motion.relative == 0.0:
        raise ValueError("a friction torque needs rings that turn against each other: give a speed")
    par = given or FrictionParameters()
    heat = float(
        line_film.inlet_heat_rolling(
            motion.entrainment, oil.viscosity, oil.temperature_slope, oil.conductivity, par.inlet_heat
        )
    )
    supply = replenishment(bearing, motion.relative, oil.kinematic, par.replenishment)
    loads: dict[Ring, FloatArray] = {"inner": state.inner, "outer": state.outer}
    found = {ring: _raceway(bearing, ring, load, motion, oil, par) for ring, load in loads.items()}
    per_speed = 1.0 / abs(motion.relative)
    ribs = [_rib(rib, state.ribs[:, i], bearing, motion, oil, par) for i, rib in enumerate(bearing.ribs)]
    loaded = [rib for rib in ribs if rib is not None]
    worst = max(loaded, key=lambda rib: rib[3].p_max, default=None)
    constants = SKF_CONSTANTS[skf_kind(bearing)]
    bath = bath_drag(bearing, abs(motion.relative), oil.kinematic, par.oil_height, constants)
    return RollerFriction(
        rolling={ring: heat * supply * part.rolling * per_speed for ring, part in found.items()},
        hysteresis={ring: part.hysteresis * per_speed for ring, part in found.items()},
        sliding={ring: part.sliding(heat * supply) * per_speed for ring, part in found.items()},
        rib=sum(rib[0] for rib in loaded) * per_speed,
        drag=par.drag_factor * bath,
        film={ring: part.film for ring, part in found.items()},
        contact_film={ring: part.contact_film for ring, part in found.items()},
        minimum_film={ring: part.minimum_film for ring, part in found.items()},
        film_parameter={
            ring: float(np.nanmin(part.contact_film)) / par.raceway_roughness if np.any(loads[ring] > 0.0) else math.nan
            for ring, part in found.items()
        },
        pressure={ring: float(part.pressure.max()) for ring, part in found.items()},
        rib_film=min((rib[1] for rib in loaded), default=math.nan),
        rib_friction=worst[2] if worst else math.nan,
        rib_pressure=worst[3].p_max if worst else 0.0,
        heat_factor=heat,
        supply_factor=supply,
    )


def skf_kind(bearing: RollerBearing) -> str:
    """Return the name of a bearing in SKF's friction model."""
    if bearing.kind in ("tapered", "needle"):
        return bearing.kind
    return "full complement" if bearing.full_complement else "cylindrical"


def replenishment(bearing: RollerBearing, speed: float, viscosity: float, constant: float) -> float:
    """Return the replenishment factor phi_rs.

    It is exp(-K_rs nu n (d + D) sqrt(K_Z/(2 (D - d)))), with mm, mm2/s and 1/min (SKF 2018, "Friction").
    """
    _, k_z = SKF_CONSTANTS[skf_kind(bearing)]
    d, D = 1e3 * bearing.bore, 1e3 * bearing.outside
    rpm = abs(speed) * 30.0 / math.pi
    return math.exp(-constant * 1e6 * viscosity * rpm * (d + D) * math.sqrt(k_z / (2.0 * (D - d))))


@dataclass(frozen=True)
class _Raceway:
    """Powers [W] of one raceway.

    They lack the factors of heat and supply; what belongs to them is added.
    """

    rolling: float
    hysteresis: float
    film: FloatArray
    contact_film: FloatArray
    minimum_film: FloatArray
    pressure: FloatArray
    traction: FloatArray  # shear force of the contact [N], (Z,), without heat and supply
    ease: FloatArray  # slip per force [m/(s N)], (Z,)
    largest: FloatArray  # shear force that the film can carry [N], (Z,)

    def sliding(self, factor: float) -> float:
        """Return the power of the slip [W].

        The slip carries the traction: force times slip, a Newtonian film.
        """
        return float(np.sum(np.minimum(factor * self.traction, self.largest) ** 2 * self.ease))


def _raceway(
    bearing: RollerBearing, ring: Ring, loads: FloatArray, motion: RollerMotion, oil: OilState, par: FrictionParameters
) -> _Raceway:
    """Return powers and films of one raceway.

    They are computed slice by slice.

    Losses in the solids: the couple (2/(3 pi)) alpha w b per length of a cylinder (Johnson, Contact Mechanics, 1985,
    eq. 9.2 for line contact) against the roller's speed relative to the raceway. The film carries the traction that
    balances the rolling resistance, at most `limit_ratio` of the load. Its slip per length is T over eta_p 2 b/h, the
    flat of the contact with the viscosity at half of the peak pressure (Barus' law, at most 1 MPa s), and
    :func:`flow_shear` around it.
    """
    width = bearing.effective_length / loads.shape[1]
    line_load = loads / width
    carried, modulus = line_load > 0.0, bearing.modulus(ring)
    inlet = load, radius, speed, *_ = _inlets(bearing, ring, line_load, motion, oil)
    force = np.where(carried, ROLLING_LAWS[par.rolling_law](*inlet), 0.0)
    half = np.where(carried, half_width(load, radius, modulus), 0.0)
    peak = np.where(carried, peak_pressure(load, radius, modulus), 0.0)
    film = slice_films(bearing, ring, loads, motion, oil, par)
    of_contact = contact_film(bearing, ring, loads, motion, oil, par)
    couple = 2.0 / (3.0 * math.pi) * par.loss_factor * line_load * half
    thick = np.minimum(oil.viscosity * np.exp(np.minimum(oil.pressure_viscosity * 0.5 * peak, 60.0)), 1e6)
    shear = thick * 2.0 * half / film + flow_shear(radius, oil.viscosity, film)
    per_slip = np.sum(np.where(carried, shear * width, 0.0), axis=1)
    return _Raceway(
        rolling=float(2.0 * np.sum(force * speed) * width),
        hysteresis=float(np.sum(couple) * width * motion.roller_speed(ring)),
        film=film,
        contact_film=of_contact,
        minimum_film=of_contact * line_film.minimum_share(*_even_lines(bearing, ring, loads, motion, oil)),
        pressure=peak,
        traction=np.sum(force, axis=1) * width,
        ease=np.where(per_slip > 0.0, 1.0 / np.where(per_slip > 0.0, per_slip, 1.0), 0.0),
        largest=par.limit_ratio * np.sum(loads, axis=1),
    )


def _inlets(
    bearing: RollerBearing, ring: Ring, line_load: FloatArray, motion: RollerMotion, oil: OilState
) -> tuple[FloatArray, FloatArray, FloatArray, float, float, float]:
    """Return what laws of the inlet take of slices.

    Slices without load stand with 1 N/m.
    """
    along = slice_positions(bearing.effective_length, line_load.shape[1])
    share = 1.0 + along * math.tan(bearing.angles.half) / (0.5 * bearing.diameter)
    load = np.where(line_load > 0.0, line_load, 1.0)
    radius, speed = bearing.radius(ring) * share, motion.entrainment * share
    return load, radius, speed, oil.viscosity, oil.pressure_viscosity, bearing.modulus(ring)


def slice_films(
    bearing: RollerBearing, ring: Ring, loads: FloatArray, motion: RollerMotion, oil: OilState, par: FrictionParameters
) -> FloatArray:
    """Return the central film of every slice [m], (Z, n).

    It is that of the law of the film with inlet heating, and NaN without load.
    """
    line_load = loads * (loads.shape[1] / bearing.effective_length)
    inlet = load, radius, speed, *_, modulus = _inlets(bearing, ring, line_load, motion, oil)
    heat = THERMAL_LAWS[par.thermal_law](speed, peak_pressure(load, radius, modulus), modulus, oil)
    return np.where(line_load > 0.0, FILM_LAWS[par.film_law](*inlet) * heat, np.nan)


def contact_film(
    bearing: RollerBearing, ring: Ring, loads: FloatArray, motion: RollerMotion, oil: OilState, par: FrictionParameters
) -> FloatArray:
    """Return the central film of every contact [m], (Z,).

    It is that of :func:`_even_lines`; NaN without load.
    """
    inlet = _, radius, speed, *_, modulus = _even_lines(bearing, ring, loads, motion, oil)
    peak = peak_pressure(loads.max(axis=1) * (loads.shape[1] / bearing.effective_length), radius, modulus)
    heat = THERMAL_LAWS[par.thermal_law](speed, peak, modulus, oil)
    return np.where(loads.sum(axis=1) > 0.0, FILM_LAWS[par.film_law](*inlet) * heat, np.nan)


def _even_lines(
    bearing: RollerBearing, ring: Ring, loads: FloatArray, motion: RollerMotion, oil: OilState
) -> tuple[FloatArray, FloatArray, FloatArray, float, float, float]:
    """Return what laws of the inlet take of whole contacts.

    Their load lies evenly on the length with the same integral of the root of the load per length, as in motion.
    """
    total, width = loads.sum(axis=1), bearing.effective_length / loads.shape[1]
    carries = total > 0.0
    length = np.where(carries, width * np.sum(np.sqrt(loads), axis=1) ** 2 / np.where(carries, total, 1.0), 1.0)
    even = np.where(carries, total / length, 1.0)
    _, radius, speed, viscosity, pressure_viscosity, modulus = _inlets(bearing, ring, even[:, None], motion, oil)
    return even, radius[0] + 0.0 * even, speed[0] + 0.0 * even, viscosity, pressure_viscosity, modulus


def _rib(
    rib: Rib, loads: FloatArray, bearing: RollerBearing, motion: RollerMotion, oil: OilState, par: FrictionParameters
) -> tuple[float, float, float, HertzContact] | None:
    """Return power [W] and film [m] of ribs.

    The power is that of all rollers, the film the smallest; friction and contact of the most loaded follow. It is None
    without a load.
    """
    if not np.any(loads > 0.0):
        return None
    power, film = 0.0, math.inf
    largest = float(loads.max())
    rates: dict[float, tuple[float, float, float, HertzContact]] = {}
    for load in loads[loads > 1e-9 * largest]:
        key = float(f"{load:.9g}")
        if key not in rates:
            rates[key] = _rib_contact(rib, float(load), bearing, motion, oil, par)
        power, film = power + rates[key][0], min(film, rates[key][1])
    top = rates[float(f"{largest:.9g}")]
    return power, film, top[2], top[3]


def rib_end(
    rib: Rib, load: float, bearing: RollerBearing, motion: RollerMotion, oil: OilState, par: FrictionParameters
) -> tuple[HertzContact, float]:
    """Return ellipse and film [m] of a roller end."""
    modulus = bearing.modulus(rib.ring)
    contact = hertz_contact(load, rib.contact.radius_x, rib.contact.radius_y, modulus)
    entrainment, turning = motion.rib(rib, bearing)
    film = rib_film(load, rib.contact, entrainment, oil.viscosity, oil.pressure_viscosity, modulus)
    heat = line_film.inlet_heat_film(
        entrainment, turning * rib.contact.height, contact.p_max, modulus, oil.viscosity, oil.temperature_slope,
        oil.conductivity,
    )  # fmt: skip
    return contact, film * float(heat)


def _rib_contact(
    rib: Rib, load: float, bearing: RollerBearing, motion: RollerMotion, oil: OilState, par: FrictionParameters
) -> tuple[float, float, float, HertzContact]:
    """Return the friction of one roller end.

    Power [W], film [m], mean friction and Hertz contact.

    Slip is that of two bodies that turn against each other about their common generatrix: omega_rel times the distance
    from it, cell by cell over the ellipse; the axis x of the contact is along sliding. Shear of the film tau_E
    asinh(eta v/(h tau_E)), at most `limit_ratio` p (Ree and Eyring; Barus' viscosity), asperities mu p; shares after
    Zhou and Hoeprich.
    """
    contact, film = rib_end(rib, load, bearing, motion, oil, par)
    _, turning = motion.rib(rib, bearing)
    share = float(line_film.asperity_share(film / par.rib_roughness, par.asperity_scale, par.asperity_exponent))
    middles = 2.0 * (np.arange(_CELLS) + 0.5) / _CELLS - 1.0
    x, y = np.meshgrid(middles, middles)
    inside = x**2 + y**2 < 1.0
    shape = np.sqrt(np.maximum(1.0 - x**2 - y**2, 0.0))
    pressure = load * shape / shape.sum()  # of a cell [N]
    area = 4.0 * contact.semi_a * contact.semi_b / _CELLS**2
    height = rib.contact.height + y * contact.semi_a
    slip = turning * np.hypot(height, x * contact.semi_b)
    local = pressure / area
    viscosity = oil.viscosity * np.exp(oil.pressure_viscosity * local)
    sheared = par.eyring_stress * np.arcsinh(viscosity * slip / (film * par.eyring_stress))
    stress = (1.0 - share) * np.minimum(sheared, par.limit_ratio * local) + share * par.boundary_friction * local
    power = float(np.sum(np.where(inside, stress * slip * area, 0.0)))
    mean = float(np.sum(np.where(inside, stress * area, 0.0))) / load
    return power, film, mean, contact
