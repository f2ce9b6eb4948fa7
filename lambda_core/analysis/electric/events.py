"""Hold discharges as a table and count them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lambda_core.analysis.electric import columns as L
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS

if TYPE_CHECKING:
    from lambda_core.analysis.electric.circuit_integrator import BearingSolution
    from lambda_core.analysis.electric.contacts import Contacts

IntArray = NDArray[np.int64]

SECTORS = 36  # of a raceway


@dataclass(frozen=True)
class Events:
    """Breakdowns in the order of time, SI.

    Each film that broke down has one entry.

    Attributes
    ----------
    time : float64[:]
        Of the breakdown [s].
    ball, ring, discharge : int64[:]
        Ball from 1; 0 inner, 1 outer; number of the discharge, to which both films of a ball may belong.
    angle : float64[:]
        Place on the raceway, turning with the ring, 0..2 pi from +y towards +z [rad].
    contact_voltage, bearing_voltage : float64[:]
        At the breakdown, across the film and from the inner to the outer ring [V].
    energy, charge, peak, duration : float64[:]
        Heat in this film [J], charge through it [C], largest current [A], time until its arc died [s].
    film, film_parameter, area : float64[:]
        Central film [m], Lambda [-], Hertzian area [m2] at that time.
    joined : bool[:]
        Whether metal joins the ball's other contact to its ring at that time: then this film is all that stands between
        the rings.
    """

    time: FloatArray
    ball: IntArray
    ring: IntArray
    discharge: IntArray
    angle: FloatArray
    contact_voltage: FloatArray
    bearing_voltage: FloatArray
    energy: FloatArray
    charge: FloatArray
    peak: FloatArray
    duration: FloatArray
    film: FloatArray
    film_parameter: FloatArray
    area: FloatArray
    joined: NDArray[np.bool_]

    def rows(self) -> list[dict[str, float | int | str]]:
        """Return plain rows with units in their names."""
        degrees = np.degrees(self.angle)
        return [
            {
                "time_s": float(self.time[i]),
                "ball": int(self.ball[i]),
                "ring": RINGS[self.ring[i]],
                "discharge": int(self.discharge[i]),
                "raceway_angle_deg": float(degrees[i]),
                "contact_voltage_V": float(self.contact_voltage[i]),
                "bearing_voltage_V": float(self.bearing_voltage[i]),
                "energy_J": float(self.energy[i]),
                "charge_C": float(self.charge[i]),
                "peak_current_A": float(self.peak[i]),
                "duration_s": float(self.duration[i]),
                "film_um": 1e6 * float(self.film[i]),
                "film_parameter": float(self.film_parameter[i]),
                "hertz_area_mm2": 1e6 * float(self.area[i]),
                "other_contact": "metal" if self.joined[i] else "film",
            }
            for i in range(self.time.size)
        ]


def events_of(solution: BearingSolution, contacts: Contacts) -> Events:
    """Return the discharges of an integration.

    They have the state of the contacts that the integration went through.
    """
    table = solution.events
    ball, ring = table[:, L.E_BALL].astype(np.int64), table[:, L.E_RACEWAY].astype(np.int64)
    low = table[:, L.E_SAMPLE].astype(np.int64)
    begin, end = contacts.time[low], contacts.time[low + 1]
    share = (table[:, L.E_TIME] - begin) / (end - begin)

    def at(values: FloatArray, *index: IntArray) -> FloatArray:
        return np.asarray((1.0 - share) * values[(low, *index)] + share * values[(low + 1, *index)])

    nearest = low + (share > 0.5)
    turned = np.where(ring == 0, at(contacts.inner_angle), at(contacts.outer_angle))
    return Events(
        time=table[:, L.E_TIME],
        ball=ball + 1,
        ring=ring,
        discharge=table[:, L.E_DISCHARGE].astype(np.int64),
        angle=np.mod(at(contacts.azimuth, ball) - turned, 2.0 * math.pi),
        contact_voltage=table[:, L.E_CONTACT_VOLTAGE],
        bearing_voltage=table[:, L.E_BEARING_VOLTAGE],
        energy=table[:, L.E_ENERGY],
        charge=table[:, L.E_CHARGE],
        peak=table[:, L.E_PEAK],
        duration=table[:, L.E_DURATION],
        film=at(contacts.film, ball, ring),
        film_parameter=at(contacts.film_parameter, ball, ring),
        area=at(contacts.area, ball, ring),
        joined=contacts.shorted[nearest, ball, 1 - ring],
    )


@dataclass(frozen=True)
class Discharges:
    """Discharges in SI.

    One entry combines the one or two arcs of a discharge.

    A discharge is through when both films of the ball broke down, or one did while metal joined the other contact:
    then the rotor's charge flows, otherwise only the ball's.
    """

    time: FloatArray
    voltage: FloatArray  # of the bearing, absolute, when the last of its films broke down [V]
    energy: FloatArray  # [J]
    peak: FloatArray  # [A]
    through: NDArray[np.bool_]


def discharges_of(events: Events) -> Discharges:
    """Put the arcs of each discharge together."""
    numbers, each = np.unique(events.discharge, return_inverse=True)
    count = numbers.size
    energy = np.bincount(each, events.energy, count).astype(np.float64)
    peak, voltage, time = np.zeros(count), np.zeros(count), np.full(count, np.inf)
    np.maximum.at(peak, each, events.peak)
    np.maximum.at(voltage, each, np.abs(events.bearing_voltage))
    np.minimum.at(time, each, events.time)
    through = (np.bincount(each, minlength=count) > 1) | (np.bincount(each, events.joined, count) > 0)
    return Discharges(time, voltage, energy, peak, through)


def sector_shares(events: Events, ring: int, sectors: int = SECTORS) -> FloatArray:
    """Return the share of breakdowns per raceway sector.

    The shares of one raceway have the shape (sectors,); they are zero without any.
    """
    angles = events.angle[events.ring == ring]
    count, _ = np.histogram(angles, bins=sectors, range=(0.0, 2.0 * math.pi))
    return np.asarray(count / max(angles.size, 1), dtype=np.float64)
