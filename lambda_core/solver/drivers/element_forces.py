"""Compute forces and powers of elements at samples."""

from __future__ import annotations

from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.solver import records as R
from lambda_core.solver.drivers.assembly import GROUND
from lambda_core.solver.drivers.solver_context import SolverContext

ROLE = "force_element"


def element_forces(context: SolverContext, times: FloatArray, flat: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return every force element's wrench.

    It acts on the second of its bodies; the order is that of the assembly.

    Parameters
    ----------
    times : float64[:], shape (n,)
        [s]
    flat : float64[:, :], shape (n, 12 bodies)
        The whole shared state of the samples.

    Returns
    -------
    wrenches : float64[:, :, :], shape (n, elements, 6)
        Force [N] and couple [N m] on the second body at the element's point of it.
    powers : float64[:, :], shape (n, elements)
        What the element puts into its bodies [W]; negative: what it takes out of them.
    """
    bodies, links = flat.view(R.BODY_STATE), context.assembly.links
    wrenches, powers = np.zeros((times.size, len(links), 6)), np.zeros((times.size, len(links)))
    for row in context.bundle.links:
        number = int(row["number"])
        first = np.zeros(times.size, R.BODY_STATE) if row["first"] == GROUND else bodies[:, row["first"]]
        place, tilt, velocity, rotation = _apart(first, bodies[:, row["second"]], row)
        link = links[number]
        law = context.assembly.bearings[link.bearing].kernels.compiled[link.element, ROLE].dispatcher
        par = context.bundle.par[slice(*row["parameters"])]
        for i, time in enumerate(times):
            out = np.full(6, np.nan)
            if law(float(time), place[i], tilt[i], velocity[i], rotation[i], par, out) == 1:
                wrenches[i, number] = out
            else:
                wrenches[i, number] = np.nan
        own = wrenches[:, number]
        powers[:, number] = (own[:, :3] * velocity).sum(axis=1) + (own[:, 3:] * rotation).sum(axis=1)
    return wrenches, powers


def named_forces(dim: str, wrenches: FloatArray, powers: FloatArray) -> dict[str, FloatArray]:
    """Return forces and powers by channel name.

    `dim` is the dimension that counts the elements.
    """
    found = {f"{dim}_force": wrenches[:, :, :3], f"{dim}_moment": wrenches[:, :, 3:], f"{dim}_power": powers}
    return {name: np.ascontiguousarray(values) for name, values in found.items()}


def _apart(first: np.ndarray, second: np.ndarray, row: Any) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return the second point's relative state.

    Place, tilt, velocity and angular velocity are seen from the first body; each has shape (n, 3).

    As the compiled :func:`lambda_core.solver.motion.links.link_state`, for all samples at once.
    """
    (axes_1, omega_1), (axes_2, omega_2) = _turning(first), _turning(second)
    arm_1, arm_2 = axes_1 @ row["first_place"], axes_2 @ row["second_place"]
    apart = second["position"] + row["apart"] + arm_2 - first["position"]
    velocity = second["velocity"] + np.cross(omega_2, arm_2) - first["velocity"] - np.cross(omega_1, apart)
    tilt = np.cross(axes_1[:, :, 0], axes_2[:, :, 0])
    found = apart - arm_1, tilt, velocity, omega_2 - omega_1
    return tuple(np.ascontiguousarray(values) for values in found)  # type: ignore[return-value]


def _turning(body: np.ndarray) -> tuple[FloatArray, FloatArray]:
    """Return the turning frame and its velocity.

    Return axis, radial and tangential direction as columns, shape (n, 3, 3), and the angular velocity, (n, 3).
    """
    (ay, az), (wy, wz) = body["tilt"].T, body["tilt_velocity"].T
    ax = np.sqrt(np.maximum(1.0 - ay * ay - az * az, 1e-12))
    axis = np.stack([ax, ay, az], axis=1)
    omega = np.stack([-(wy * ay + wz * az) / ax, wy, wz], axis=1) + body["spin"][:, None] * axis
    y = np.stack([-ay, 1.0 - ay * ay / (1.0 + ax), -ay * az / (1.0 + ax)], axis=1)
    z = np.stack([-az, -ay * az / (1.0 + ax), 1.0 - az * az / (1.0 + ax)], axis=1)
    c, s = np.cos(body["angle"])[:, None], np.sin(body["angle"])[:, None]
    return np.stack([axis, c * y + s * z, c * z - s * y], axis=2), omega
