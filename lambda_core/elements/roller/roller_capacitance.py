"""Compute the capacitance of rollers in equilibrium.

Every contact with a raceway has the capacitance that the law of line contacts gives for the flats of its slices, with
the gaps at their sides; an open one has that of its gap. Ends of rollers on ribs count where they carry, as points. It
is the sum of compiled code (solver.roller.capacitance) with the film of every contact.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import SHORTED
from lambda_core.elements.roller.line_contact import ISO_EXPONENT, half_width, peak_pressure
from lambda_core.elements.roller.roller_bearing import Rib, Ring, RollerBearing
from lambda_core.elements.roller.roller_equilibrium import (
    RollerEquilibrium,
    carry_of,
    single_contact_constant,
    single_springs,
)
from lambda_core.elements.roller.roller_friction import FrictionParameters, OilState, contact_film, rib_end
from lambda_core.elements.roller.roller_motion import RollerMotion
from lambda_core.formulas.between_rings import between_rings
from lambda_core.formulas.gap_capacitance import VACUUM_PERMITTIVITY

_MEAN = 0.25 * np.pi  # mean over the maximum of Hertz's pressure across a line
# Mean over an ellipse by Gauss' rule over the share of its area: pressure there over the largest, and weight.
_NODES, _TWICE = np.polynomial.legendre.leggauss(6)
_DEPTHS, _WEIGHTS = np.sqrt(0.5 * (1.0 - _NODES)), 0.5 * _TWICE


@dataclass(frozen=True)
class Dielectric:
    """Oil between the surfaces, and laws of contacts.

    Attributes
    ----------
    permittivity : callable
        Relative permittivity over pressure [Pa], at the bulk temperature; arrays.
    line, point : callable
        Capacitance [F] of a contact with a raceway and with a rib: from C_Hertz [F], film, semi-axes across and along
        rolling, R_x, R_y [m], U, G, W and the permittivity without pressure, as the laws of the role `capacitance`.
    """

    permittivity: Callable[[FloatArray], FloatArray]
    line: Callable[..., float]
    point: Callable[..., float]


@dataclass(frozen=True)
class RollerCapacitance:
    """Capacitances of one place of the rollers.

    Attributes
    ----------
    contacts : float64[:, :], shape (Z, 2)
        Of every roller with inner and outer ring [F], raceway and ribs together; inf where asperities short it.
    """

    contacts: FloatArray

    @property
    def bearing(self) -> float:
        """Capacitance between the rings [F]."""
        return between_rings(self.contacts)


def capacitance(
    bearing: RollerBearing,
    state: RollerEquilibrium,
    motion: RollerMotion,
    oil: OilState,
    given: FrictionParameters,
    dielectric: Dielectric,
) -> RollerCapacitance:
    """Return the capacitances of an equilibrium.

    A contact less deep than the roughness has at least the capacitance of one that just touches: the film of a contact
    whose nearest slice is as deep as the roughness stands for lighter ones and, where it is the larger one, for the gap
    of open ones. So the capacitance is continuous where a roller lifts off.

    Parameters
    ----------
    bearing, state, motion, oil, given
        As for :func:`friction`; the rings must turn against each other.
    dielectric : Dielectric
        Of oil and contacts.
    """
    ambient, columns = float(dielectric.permittivity(np.zeros(1))[0]), []
    for ring, deep in penetrations(bearing, state).items():
        loads = state.inner if ring == "inner" else state.outer
        films = contact_film(bearing, ring, loads, motion, oil, given)
        nearest = deep.max(axis=1)
        closed = np.maximum(deep - nearest[:, None] + given.raceway_roughness, 0.0)
        first = (
            single_contact_constant(bearing.effective_length, bearing.modulus(ring))
            / deep.shape[1]
            * closed**ISO_EXPONENT
        )
        touching = contact_film(bearing, ring, first, motion, oil, given)
        contact = _Contact(bearing, motion, oil, given, dielectric, ambient)
        own = [(i, rib) for i, rib in enumerate(bearing.ribs) if rib.ring == ring]
        columns.append(
            [
                contact.of_raceway(ring, loads[j], float(films[j]), float(nearest[j]), float(touching[j]))
                + sum(contact.of_rib(rib, float(state.ribs[j, i])) for i, rib in own)
                for j in range(bearing.count)
            ]
        )
    return RollerCapacitance(np.array(columns).T)


def penetrations(bearing: RollerBearing, state: RollerEquilibrium) -> dict[Ring, FloatArray]:
    """Return the approach of every slice [m], (Z, n).

    A negative one is a gap.
    """
    n = state.inner.shape[1]
    springs, ring = single_springs(bearing, n), np.append(state.ring, state.waves)
    plane = np.einsum("zpq,q->zp", carry_of(state.azimuths, bearing), ring)
    deep = state.rollers @ springs.roller.T + plane @ springs.ring.T - springs.gap
    return {"inner": deep[:, n : 2 * n], "outer": deep[:, :n]}


@dataclass(frozen=True)
class _Contact:
    """Inputs that all contacts share."""

    bearing: RollerBearing
    motion: RollerMotion
    oil: OilState
    given: FrictionParameters
    dielectric: Dielectric
    ambient: float  # permittivity without pressure

    def of_rib(self, rib: Rib, load: float) -> float:
        """Return the capacitance of a roller end [F]."""
        if load <= 0.0:
            return 0.0
        given, oil, shape, e_eff = self.given, self.oil, rib.contact, self.bearing.modulus(rib.ring)
        contact, film = rib_end(rib, load, self.bearing, self.motion, oil, given)
        if film < SHORTED * given.rib_roughness:
            return np.inf
        mean = float(self.dielectric.permittivity(contact.p_max * _DEPTHS) @ _WEIGHTS)
        plates = VACUUM_PERMITTIVITY * mean * np.pi * contact.semi_a * contact.semi_b
        speed = oil.viscosity * self.motion.rib(rib, self.bearing)[0] / (e_eff * shape.radius_x)
        return self.dielectric.point(
            plates / film, film, contact.semi_a, contact.semi_b, shape.radius_x, shape.radius_y, speed,
            oil.pressure_viscosity * e_eff, load / (e_eff * shape.radius_x**2), self.ambient,
        )  # fmt: skip

    def of_raceway(self, ring: Ring, loads: FloatArray, film: float, deep: float, touching: float) -> float:
        """Return the capacitance of a line [F].

        Parameters
        ----------
        loads : array
            Of the slices [N].
        film : float
            Of the contact [m].
        deep : float
            Approach of the nearest slice [m], negative for a gap.
        touching : float
            Film at first touch [m].
        """
        least, roughness = 0.0, self.given.raceway_roughness
        if deep < roughness:
            least = self._line(ring, 0.0, max(-deep, touching, roughness), 0.0, 0.0)
        if deep <= 0.0:
            return least
        carried = loads > 0.0
        width = self.bearing.effective_length / len(loads)
        radius, e_eff = self.bearing.radius(ring), self.bearing.modulus(ring)
        line = loads[carried] / width
        half, peak = half_width(line, radius, e_eff), peak_pressure(line, radius, e_eff)
        plates = self.dielectric.permittivity(_MEAN * peak) * 2.0 * half * width
        if film < SHORTED * roughness:
            return np.inf
        found = self._line(
            ring, VACUUM_PERMITTIVITY * float(np.sum(plates)) / film, film, float(half.max()), float(loads.sum())
        )
        return max(found, least)

    def _line(self, ring: Ring, hertz: float, film: float, half: float, load: float) -> float:
        radius, length, e_eff = self.bearing.radius(ring), self.bearing.effective_length, self.bearing.modulus(ring)
        speed = self.oil.viscosity * self.motion.entrainment / (e_eff * radius)
        material, weight = self.oil.pressure_viscosity * e_eff, load / (e_eff * radius * length)
        return self.dielectric.line(
            hertz, film, 0.5 * length, half, radius, length, speed, material, weight, self.ambient
        )
