"""Define a progressive spring with a damper between bodies."""

from typing import Annotated

from lambda_core.plugins import OK, Parameters, Quantity, law, parameter


class Support(Parameters):
    stiffness: Annotated[float, Quantity("stiffness")] = parameter("5 N/um", "at rest", status="assumed", ge=0.0)
    hardening: float = parameter(0.0, "stiffness gained per square of displacement [N/m3]", status="assumed", ge=0.0)
    damping: Annotated[float, Quantity("damping")] = parameter("0 N s/m", "of the damper", status="assumed", ge=0.0)


@law("force_element", "spring-damper", Support, role_api=3, reference="Duffing's spring k r + k_3 r^3, Kelvin-Voigt")
def spring_damper(t, place, tilt, v_rel, omega_rel, par, out):
    """Spring with damper and cubic stiffness.

    F = -(k + k_3 r^2) r - c v, against displacement and velocity, without a couple.
    """
    square = place[0] * place[0] + place[1] * place[1] + place[2] * place[2]
    for i in range(3):
        out[i] = -(par.stiffness + par.hardening * square) * place[i] - par.damping * v_rel[i]
        out[3 + i] = 0.0
    return OK
