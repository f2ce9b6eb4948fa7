"""Say which thrust a roller bearing takes and needs."""

from __future__ import annotations

import math

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.roller_bearing import RollerBearing


def thrust_problem(bearing: RollerBearing, thrust: float) -> str:
    """Explain a thrust that the bearing cannot take.

    It acts on the inner ring along x [N]; the text is "" where ribs or cones take it.
    """
    if bearing.kind == "tapered":
        wrong = thrust <= 0.0
        return "a tapered roller bearing needs thrust on the inner ring along x, above zero" if wrong else ""
    if thrust == 0.0:
        return ""
    rings = {(rib.ring, rib.end) for rib in bearing.ribs}
    end = -1 if thrust > 0.0 else 1
    if {("inner", end), ("outer", -end)} <= rings:
        return ""
    return f"a roller bearing of kind {bearing.kind} takes no thrust in this direction; NJ: along x, NUP: both"


def takes_one_side(bearing: RollerBearing) -> bool:
    """Tell whether the bearing takes one-sided thrust only.

    Ribs or cones take it.
    """
    return bool(thrust_problem(bearing, 1.0)) != bool(thrust_problem(bearing, -1.0))


def least_thrust(bearing: RollerBearing, radial: float, centrifugal: float = 0.0) -> float:
    """Return the thrust that a tapered bearing must exceed [N].

    sum Q_o sin(a_o) = F_a and sum Q_o cos(a_o) cos(psi) = F_r at the outer raceway. A roller that the inner raceway
    leaves lies on outer raceway and rib, whose force has the components n_a, n_r along the axis and outwards: Q_o is at
    least Q_c = F_c/(cos(a_o) - sin(a_o) n_r/n_a) of its centrifugal force. The least sum has one roller with more:

        F_a >= F_r tan(a_o) + Z Q_c sin(a_o).

    Zero where another kind takes the thrust.

    Parameters
    ----------
    bearing : RollerBearing
        Geometry; the free ring is the inner one.
    radial : float
        F_r [N].
    centrifugal : float
        F_c of one roller [N].
    """
    if not _needs_thrust(bearing):
        return 0.0
    return radial * math.tan(bearing.angles.outer) + _against_centrifugal(bearing, centrifugal)


def scarce_thrust(radial: float, axial: float, least: float) -> str:
    """Say that thrust does not hold a tapered bearing together."""
    return (
        f"a thrust of {axial:.4g} N does not hold cone and cup together under a radial load of {radial:.4g} N: it must "
        f"be above F_r tan(a_o), with the centrifugal force of the rollers above {least:.4g} N"
    )


def refuse_scarce_thrust(
    bearing: RollerBearing, loads: FloatArray, held: tuple[bool, ...], centrifugal: float = 0.0
) -> None:
    """Refuse thrust that nothing takes.

    Parameters
    ----------
    bearing, loads, held
        As for the equilibrium.
    centrifugal : float
        Of one roller [N].

    Raises
    ------
    ValueError
        For thrust that the kind of bearing does not take.
    ArithmeticError
        For too little thrust on a tapered bearing.
    """
    problem = "" if held[0] else thrust_problem(bearing, float(loads[0]))
    if problem:
        raise ValueError(problem)
    radial = math.hypot(loads[1], loads[2])
    least = 0.0 if any(held[:3]) else least_thrust(bearing, radial, centrifugal)
    if least > 0.0 and loads[0] <= least:
        raise ArithmeticError(f"no equilibrium of the rollers: {scarce_thrust(radial, float(loads[0]), least)}")


def thrust_advice(bearing: RollerBearing, loads: FloatArray, held: tuple[bool, ...], centrifugal: float = 0.0) -> str:
    """Say what to do when no equilibrium is found."""
    if _needs_thrust(bearing) and not any(held[:3]):
        # two rollers that share the load press at half their pitch from its line: Q_o cos(a_o) cos(pi/Z) = F_r/2 each
        radial = least_thrust(bearing, math.hypot(loads[1], loads[2])) / math.cos(math.pi / bearing.count)
        turning = _against_centrifugal(bearing, centrifugal)
        plenty = radial / 0.8 + turning  # F_r/(2 Y) with Y = 0.4 cot(alpha): half of the rollers carry (ISO 281)
        if loads[0] < plenty:
            return (
                f"a thrust of {loads[0]:.4g} N hardly holds cone and cup together: between two rollers it must be "
                "above F_r tan(a_o)/cos(pi/Z), with the centrifugal force of the rollers above "
                f"{radial + turning:.4g} N; raise it to {plenty:.4g} N, at which half of the rollers carry"
            )
    return "check loads, clearance and what holds the inner ring"


def _needs_thrust(bearing: RollerBearing) -> bool:
    """Tell whether thrust alone holds a bearing together."""
    return bearing.is_conical and all(rib.ring == "inner" for rib in bearing.ribs)


def _against_centrifugal(bearing: RollerBearing, force: float) -> float:
    """Return the thrust that holds turning rollers [N]."""
    (along, outwards), outer = bearing.ribs[0].normal, bearing.angles.outer
    least = force / (math.cos(outer) - math.sin(outer) * outwards / along)
    return bearing.count * least * math.sin(outer)
