"""Define drag on each ball as on a sphere."""

from __future__ import annotations

import math
from typing import NamedTuple

from lambda_core.plugins import OK, Context, FloatArray, Parameters, law, parameter
from lambda_plugins.immersion import OilBath, immersion, oil_geometry

_KIRCHHOFF = 16.0 * math.pi


class SphereDrag(Parameters):
    """Parameters of the single sphere."""

    entrainment: float = parameter(
        0.0,
        "speed of the oil around the ball over the ball's orbital speed",
        source="assumption: the oil is at rest; in a narrow, flooded bearing the oil turns with the cage",
        status="assumed",
        published_range=(0.0, 1.0),
        ge=0.0,
        le=1.0,
    )


class Stream(NamedTuple):
    """The oil that a ball meets."""

    bath: OilBath
    entrainment: float  # speed of the oil over the ball's


def prepare(parameters: SphereDrag, context: Context) -> Stream:
    """Return the oil bath and how it turns."""
    return Stream(oil_geometry(context), parameters.entrainment)


def drag_of_sphere(share: float, v: float, R: float, nu: float, rho: float) -> float:
    """Return the drag [N] of a sphere.

    The sphere has the radius R and the speed v, with `share` of it in the fluid; the drag is finite at rest.

    Clift, Grace and Weber 1978, eq. 5-8: the formula is that of :func:`sphere_drag`.
    """
    Re = 2.0 * R * abs(v) / nu
    # C_D Re, finite at rest: Stokes' part and the bluff body's part
    inertial = 0.42 * Re / (1.0 + 42500.0 * (Re + 1e-9) ** -1.16)
    force: float = share * 0.25 * math.pi * rho * nu * R * v * (24.0 * (1.0 + 0.15 * Re**0.687) + inertial)
    return force


def churning_of_sphere(share: float, omega: float, R: float, nu: float, rho: float) -> float:
    """Return the churning moment [N m] of a sphere.

    It acts against its spin, with `share` of it in the fluid.

    Kirchhoff 1876 and Sawatzki 1970: the formula is that of :func:`sphere_drag`.
    """
    Re = abs(omega) * R * R / nu
    boundary_layer = 32.1 + 6.45 * math.sqrt(Re)
    # C_M Re: the larger of both laws with a smooth corner at Re = 8
    joined: float = (_KIRCHHOFF**16 + boundary_layer**16) ** 0.0625
    return share * 0.5 * rho * nu * R**3 * omega * joined


@law(
    "fluid_drag",
    "sphere-drag",
    SphereDrag,
    role_api=3,
    reference="Clift, Grace and Weber 1978, eq. 5-8; Sawatzki 1970, Acta Mech. 9, 159; Kirchhoff 1876",
    validity="single sphere; drag Re < 3e5, spin Re < 4e4; neighbours, cage and rings left out",
    prepare=prepare,
)
def sphere_drag(
    v_orbit: float, omega_spin: float, azimuth: float, nu: float, rho: float, par: Stream, out: FloatArray
) -> int:
    """Drag and churning of a sphere by its immersion.

    It is the drag and the moment of a spinning sphere, times the submerged share of the ball.

    F = C_D rho v^2 pi R^2/2, C_D = 24/Re (1 + 0.15 Re^0.687) + 0.42/(1 + 42500 Re^-1.16), Re = 2 R v/nu < 3e5: Schiller
    and Naumann 1933; Clift and Gauvin 1970; Clift, Grace and Weber 1978, Bubbles, Drops and Particles, eq. 5-8.
    M = C_M rho omega^2 R^5/2, Re = omega R^2/nu: C_M = 16 pi/Re (Kirchhoff 1876) and 6.45/sqrt(Re) + 32.1/Re for Re 20
    to 4e4 (Sawatzki 1970, Acta Mech. 9, 159; Dennis, Singh and Ingham 1980, J. Fluid Mech. 101, 257), joined smoothly.
    No influence of neighbours, cage and rings, of which a bearing has plenty: an independent order of magnitude.
    """
    wet = immersion(azimuth, par.bath)
    R = par.bath.ball_radius
    out[0] = drag_of_sphere(wet, (1.0 - par.entrainment) * v_orbit, R, nu, rho)
    out[1] = churning_of_sphere(wet, omega_spin, R, nu, rho)
    return OK
