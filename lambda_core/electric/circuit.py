"""The circuit around the films, and the bearing as a meter sees it: capacitance, impedance, voltage ratio."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.electric.contacts import VACUUM_PERMITTIVITY
from lambda_core.electric.march import Circuit, Films

if TYPE_CHECKING:
    from collections.abc import Mapping

    from lambda_core.case.electric import Electric


def bearing_capacitance(films: Films) -> FloatArray:
    """Return the capacitance of the balls in parallel, the two films of a ball in series, shape (n,) [F].

    C_b = sum C_i C_o/(C_i + C_o): without leaks a ball takes the potential U C_i/(C_i + C_o).
    """
    inner, outer = films.capacitance[:, :, 0], films.capacitance[:, :, 1]
    return np.asarray((inner * outer / (inner + outer)).sum(axis=1))


def impedance(films: Films, rings: float, frequency: FloatArray) -> NDArray[np.complex128]:
    """Return the impedance between the rings, as a meter sees it while the bearing turns, shape (n, frequencies) [Ohm].

    Each film is a capacitance beside a conductance, the films of a ball are in series, balls and the direct
    capacitance of the rings [F] in parallel. Valid where the period is short against the passage of a ball.
    """
    omega = 2.0 * math.pi * np.asarray(frequency)
    total = np.zeros((films.time.size, omega.size), dtype=np.complex128)
    total += 1j * omega * rings
    for ball in range(films.capacitance.shape[1]):
        each = films.conductance[:, ball, :, None] + 1j * omega * films.capacitance[:, ball, :, None]
        inner, outer = each[:, 0], each[:, 1]
        total += inner * outer / (inner + outer)
    return np.asarray(1.0 / total)


def shoulders_capacitance(geometry: Mapping[str, float]) -> float:
    """Return the capacitance of the two rings past the balls [F]: coaxial cylinders 2 pi eps_0 B/ln(D_2/d_1) in air.

    d_1 and D_2 are the diameters of the shoulders, B the width. Cage, seals and oil raise it.
    """
    inner, outer = geometry["shoulder_diameter_inner"], geometry["shoulder_diameter_outer"]
    return 2.0 * math.pi * VACUUM_PERMITTIVITY * geometry["width"] / math.log(outer / inner)


def circuit_of(options: Electric, films: Films, geometry: Mapping[str, float]) -> Circuit:
    """Return the circuit that a bearing stands in; another bearing like it counts with its mean capacitance."""
    machine, grounding = options.machine, options.grounding
    rings = options.film.surroundings
    rings = shoulders_capacitance(geometry) if rings is None else rings
    others = machine.other_bearings
    others = float(bearing_capacitance(films).mean()) + rings if others is None else others
    bridge = math.inf
    if grounding.insulation is not None:
        bridge = 1.0 / grounding.insulation_resistance
        bridge += 1.0 / grounding.shunt if grounding.shunt is not None else 0.0
    return Circuit(
        winding=machine.winding_rotor,
        rotor=machine.rotor_frame + others,
        rings=rings,
        brush=1.0 / grounding.brush if grounding.brush is not None else 0.0,
        coating=grounding.insulation or 0.0,
        bridge=bridge,
    )


def voltage_ratio(circuit: Circuit, capacitance: float) -> float:
    """Return BVR = C_wr/(C_wr + C_rf + C_b1 + C_b2), bearing over common-mode voltage without leaks (Muetze, Binder).

    Parameters
    ----------
    capacitance : float
        Of this bearing's balls [F]; an insulation is in series with the bearing.
    """
    whole = capacitance + circuit.rings
    if not circuit.insulated:
        return circuit.winding / (circuit.winding + circuit.rotor + whole)
    series = whole * circuit.coating / (whole + circuit.coating)
    return circuit.winding / (circuit.winding + circuit.rotor + series) * circuit.coating / (whole + circuit.coating)
