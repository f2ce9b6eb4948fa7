"""The circuit around the films, and the bearing as a meter sees it: capacitance, impedance, voltage ratio."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.gap_capacitance import VACUUM_PERMITTIVITY
from lambda_core.electric.circuit_integrator import Circuit, Films

if TYPE_CHECKING:
    from collections.abc import Mapping

    from lambda_core.case.electric import Electric


def bearing_capacitance(films: Films) -> FloatArray:
    """Return the capacitance of the balls in parallel, the two films of a ball in series, shape (n,) [F].

    C_b = sum C_i C_o/(C_i + C_o): without leaks a ball takes the potential U C_i/(C_i + C_o).
    """
    inner, outer = films.capacitance[:, :, 0], films.capacitance[:, :, 1]
    return np.asarray((inner * outer / (inner + outer)).sum(axis=1))


def impedance(films: Films, circuit: Circuit, frequency: FloatArray) -> NDArray[np.complex128]:
    """Return the impedance between the rings, as a meter sees it while the bearing turns, shape (n, frequencies) [Ohm].

    Each film is a capacitance in parallel with a conductance, the films of a ball are in series, balls and the direct
    capacitance of the rings in parallel; a cage that conducts joins the balls. Valid where the period is short against
    the passage of a ball.
    """
    omega = 2.0 * math.pi * np.asarray(frequency)
    shape = (films.time.size, omega.size)
    total = np.zeros(shape, dtype=np.complex128) + 1j * omega * circuit.rings
    pocket = 1j * omega * circuit.pocket
    # With the outer ring at 0 and the inner at 1 V: charge balance of each ball, then of the cage.
    onto_cage = np.zeros(shape, dtype=np.complex128) + 1j * omega * circuit.cage_inner
    from_cage = np.zeros(shape, dtype=np.complex128) + 1j * omega * (circuit.cage_inner + circuit.cage_outer)
    for ball in range(films.capacitance.shape[1]):
        each = films.conductance[:, ball, :, None] + 1j * omega * films.capacitance[:, ball, :, None]
        inner, outer = each[:, 0], each[:, 1]
        node = inner + outer + pocket
        total += inner * (outer + pocket) / node
        onto_cage += pocket * inner / node
        from_cage += pocket * (inner + outer) / node
    if circuit.pocket > 0.0:
        total += 1j * omega * circuit.cage_inner - onto_cage * onto_cage / from_cage
    return np.asarray(1.0 / total)


def shoulders_capacitance(geometry: Mapping[str, float]) -> float:
    """Return the capacitance of the two rings past the balls [F]: coaxial cylinders 2 pi eps_0 B/ln(D_2/d_1) in air.

    d_1 and D_2 are the diameters of the shoulders, B the width. Cage, seals and oil raise it.
    """
    inner, outer = geometry["shoulder_diameter_inner"], geometry["shoulder_diameter_outer"]
    return 2.0 * math.pi * VACUUM_PERMITTIVITY * geometry["width"] / math.log(outer / inner)


def circuit_of(options: Electric, geometry: Mapping[str, float]) -> Circuit:
    """Return the circuit that a bearing stands in; another bearing like it counts with this one's capacitance."""
    machine, grounding = options.machine, options.grounding
    rings = options.film.surroundings
    rings = (shoulders_capacitance(geometry) if rings is None else rings) + options.film.seals
    bridge = math.inf
    if grounding.insulation is not None:
        bridge = 1.0 / grounding.insulation_resistance
        bridge += 1.0 / grounding.shunt if grounding.shunt is not None else 0.0
    cage = options.cage
    return Circuit(
        winding=machine.winding_rotor,
        rotor=machine.rotor_frame + (machine.other_bearings or 0.0),
        rings=rings,
        brush=1.0 / grounding.brush if grounding.brush is not None else 0.0,
        coating=grounding.insulation or 0.0,
        bridge=bridge,
        twins=1.0 if machine.other_bearings is None else 0.0,
        pocket=cage.pocket if cage is not None else 0.0,
        cage_inner=cage.inner if cage is not None else 0.0,
        cage_outer=cage.outer if cage is not None else 0.0,
    )


def voltage_ratio(circuit: Circuit, capacitance: float) -> float:
    """Return BVR = C_wr/(C_wr + C_rf + C_b1 + C_b2), bearing over common-mode voltage without leaks (Muetze, Binder).

    Parameters
    ----------
    capacitance : float
        Of this bearing's balls [F]; an insulation is in series with the bearing. A cage is left out.
    """
    whole = capacitance + circuit.rings
    rotor = circuit.rotor + circuit.twins * whole
    if not circuit.insulated:
        return circuit.winding / (circuit.winding + rotor + whole)
    series = whole * circuit.coating / (whole + circuit.coating)
    return circuit.winding / (circuit.winding + rotor + series) * circuit.coating / (whole + circuit.coating)
