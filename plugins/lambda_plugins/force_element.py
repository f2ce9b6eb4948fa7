"""Define the force elements between two bodies."""

from __future__ import annotations

from typing import Annotated

from lambda_core.plugins import OK, FloatArray, Parameters, Quantity, law, parameter

Stiffness = Annotated[float, Quantity("stiffness")]
Damping = Annotated[float, Quantity("damping")]
Turning = Annotated[float, Quantity("angular_stiffness")]
Resisting = Annotated[float, Quantity("angular_damping")]
Force = Annotated[float, Quantity("force")]

_ABSENT = "absent unless the case gives it"


class Bushing(Parameters):
    """Stiffness and damping of a bushing.

    Along and about the axes, with a force at rest.
    """

    stiffness_x: Stiffness = parameter(
        "0 N/m", "against displacement along x", source=_ABSENT, status="assumed", ge=0.0
    )
    stiffness_y: Stiffness = parameter(
        "0 N/m", "against displacement along y", source=_ABSENT, status="assumed", ge=0.0
    )
    stiffness_z: Stiffness = parameter(
        "0 N/m", "against displacement along z", source=_ABSENT, status="assumed", ge=0.0
    )
    damping_x: Damping = parameter("0 N s/m", "against velocity along x", source=_ABSENT, status="assumed", ge=0.0)
    damping_y: Damping = parameter("0 N s/m", "against velocity along y", source=_ABSENT, status="assumed", ge=0.0)
    damping_z: Damping = parameter("0 N s/m", "against velocity along z", source=_ABSENT, status="assumed", ge=0.0)
    tilt_stiffness: Turning = parameter(
        "0 N m/rad", "against tilt about y and z", source=_ABSENT, status="assumed", ge=0.0
    )
    tilt_damping: Resisting = parameter(
        "0 N m s/rad", "against angular velocity about y and z", source=_ABSENT, status="assumed", ge=0.0
    )
    spin_damping: Resisting = parameter(
        "0 N m s/rad", "against angular velocity about x", source=_ABSENT, status="assumed", ge=0.0
    )
    preload_x: Force = parameter("0 N", "force along x where nothing is displaced", source=_ABSENT, status="assumed")


@law(
    "force_element",
    "bushing",
    Bushing,
    role_api=3,
    reference="linear spring and damper along and about each axis (Kelvin-Voigt)",
    validity="small displacements and tilts; the axes are the inertial ones",
)
def bushing(
    t: float,
    place: FloatArray,
    tilt: FloatArray,
    v_rel: FloatArray,
    omega_rel: FloatArray,
    par: Bushing,
    out: FloatArray,
) -> int:
    """Linear springs and dampers along and about the axes.

    F = F_0 - k r - c v along the axes, M = -k_t phi - c_t omega about them.
    """
    out[0] = par.preload_x - par.stiffness_x * place[0] - par.damping_x * v_rel[0]
    out[1] = -par.stiffness_y * place[1] - par.damping_y * v_rel[1]
    out[2] = -par.stiffness_z * place[2] - par.damping_z * v_rel[2]
    out[3] = -par.spin_damping * omega_rel[0]
    out[4] = -par.tilt_stiffness * tilt[1] - par.tilt_damping * omega_rel[1]
    out[5] = -par.tilt_stiffness * tilt[2] - par.tilt_damping * omega_rel[2]
    return OK
