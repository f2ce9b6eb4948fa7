"""Define the circuit around the films.

It has the bearing as a meter sees it: capacitance, impedance and voltage ratio.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lambda_core.analysis.electric.circuit_integrator import Circuit, Films, Surroundings
from lambda_core.case.electric import Electric
from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.gap_capacitance import VACUUM_PERMITTIVITY

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


def bearing_capacitance(films: Films) -> FloatArray:
    """Return the capacitance of all balls in parallel [F].

    The two films of a ball are in series; shape (n,).

    C_b = sum C_i C_o/(C_i + C_o): without leaks a ball takes the potential U C_i/(C_i + C_o).
    """
    inner, outer = films.capacitance[:, :, 0], films.capacitance[:, :, 1]
    return np.asarray((inner * outer / (inner + outer)).sum(axis=1))


def impedance(films: Films, around: Surroundings, frequency: FloatArray) -> NDArray[np.complex128]:
    """Return the impedance between the rings [Ohm].

    A meter measures it while the bearing turns; the array has shape (n, frequencies).

    Each film is a capacitance in parallel with a conductance, the films of a ball are in series, balls and the direct
    capacitance of the rings in parallel; a cage that conducts joins the balls. Valid where the period is short against
    the passage of a ball.
    """
    omega = 2.0 * math.pi * np.asarray(frequency)
    shape = (films.time.size, omega.size)
    total = np.zeros(shape, dtype=np.complex128) + 1j * omega * around.rings
    pocket = 1j * omega * around.pocket
    # With the outer ring at 0 and the inner at 1 V: charge balance of each ball, then of the cage.
    onto_cage = np.zeros(shape, dtype=np.complex128) + 1j * omega * around.cage_inner
    from_cage = np.zeros(shape, dtype=np.complex128) + 1j * omega * (around.cage_inner + around.cage_outer)
    for ball in range(films.capacitance.shape[1]):
        each = films.conductance[:, ball, :, None] + 1j * omega * films.capacitance[:, ball, :, None]
        inner, outer = each[:, 0], each[:, 1]
        node = inner + outer + pocket
        total += inner * (outer + pocket) / node
        onto_cage += pocket * inner / node
        from_cage += pocket * (inner + outer) / node
    if around.pocket > 0.0:
        total += 1j * omega * around.cage_inner - onto_cage * onto_cage / from_cage
    return np.asarray(1.0 / total)


def shoulders_capacitance(geometry: Mapping[str, float]) -> float:
    """Return the capacitance of the rings without balls [F].

    It is that of coaxial cylinders in air, 2 pi eps_0 B/ln(D_2/d_1).

    d_1 and D_2 are the diameters of the shoulders, B the width. Cage, seals and oil raise it.
    """
    inner, outer = geometry["shoulder_diameter_inner"], geometry["shoulder_diameter_outer"]
    return 2.0 * math.pi * VACUUM_PERMITTIVITY * geometry["width"] / math.log(outer / inner)


def surroundings(options: Electric, geometry: Mapping[str, float]) -> Surroundings:
    """Return what surrounds the films of a bearing."""
    grounding, cage = options.grounding, options.cage
    rings = options.film.surroundings
    rings = (shoulders_capacitance(geometry) if rings is None else rings) + options.film.seals
    bridge = math.inf
    if grounding.insulation is not None:
        bridge = 1.0 / grounding.insulation_resistance
        bridge += 1.0 / grounding.shunt if grounding.shunt is not None else 0.0
    return Surroundings(
        rings=rings,
        coating=grounding.insulation or 0.0,
        bridge=bridge,
        pocket=cage.pocket if cage is not None else 0.0,
        cage_inner=cage.inner if cage is not None else 0.0,
        cage_outer=cage.outer if cage is not None else 0.0,
    )


def circuit_of(options: Electric, bearings: Sequence[Surroundings]) -> Circuit:
    """Return the circuit of a shaft's bearings."""
    machine, grounding = options.machine, options.grounding
    return Circuit(
        winding=machine.winding_rotor,
        rotor=machine.rotor_frame + (machine.other_bearings or 0.0),
        bearings=tuple(bearings),
        brush=1.0 / grounding.brush if grounding.brush is not None else 0.0,
        twins=options.twins,
    )


def voltage_ratio(circuit: Circuit, capacitances: Sequence[float], bearing: int = 0) -> float:
    """Return the bearing voltage ratio BVR.

    BVR = C_wr/(C_wr + C_rf + sum C_b), bearing over common-mode voltage without leaks (Muetze, Binder 2007).

    Parameters
    ----------
    capacitances : sequence of float
        Of the balls of each bearing [F]; an insulation is in series with its bearing. A cage is left out.
    bearing : int
        Whose voltage is asked for.
    """
    around, bare, behind = circuit.bearings[bearing], *_seen(circuit.bearings[bearing], capacitances[bearing])
    rotor = circuit.rotor + circuit.twins * bare
    for k, (other, capacitance) in enumerate(zip(circuit.bearings, capacitances, strict=True)):
        rotor += _seen(other, capacitance)[1] if k != bearing else 0.0
    ratio = circuit.winding / (circuit.winding + rotor + behind)
    return ratio * around.coating / (bare + around.coating) if around.insulated else ratio


def _seen(around: Surroundings, capacitance: float) -> tuple[float, float]:
    """Return a bearing's capacitance, bare and insulated [F].

    The second one is in series with its insulation.
    """
    bare = capacitance + around.rings
    return bare, bare * around.coating / (bare + around.coating) if around.insulated else bare


def rotor_capacitance(circuit: Circuit, capacitances: Sequence[float]) -> float:
    """Return the rotor's capacitance to its surroundings [F].

    `capacitances` are those of the balls.

    An insulation is in series with its bearing; a cage is left out.
    """
    total = circuit.winding + circuit.rotor
    for around, capacitance in zip(circuit.bearings, capacitances, strict=True):
        bare, behind = _seen(around, capacitance)
        total = total + circuit.twins * bare + behind
    return total
