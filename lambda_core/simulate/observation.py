"""States as channels of a result: what compiled code writes about samples, by name."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lambda_core.errors import SolverError
from lambda_core.physics.assembly import Assembly
from lambda_core.physics.compiled import layout as L
from lambda_core.physics.compiled.entry import Core
from lambda_core.physics.compiled.observe import CONTACT_CHANNELS
from lambda_core.physics.equilibrium import fault_sentence

# Asperities that carry more than this share of the load short the contact electrically.
SHORTED = 0.01


FloatArray = NDArray[np.float64]


class Scratch(NamedTuple):
    """What compiled code writes about n samples; see compiled.observe.observe."""

    contacts: FloatArray
    pockets: FloatArray
    lands: FloatArray
    extra: FloatArray
    shared: FloatArray
    rates: FloatArray
    dydt: FloatArray

    @classmethod
    def of(cls, n: int, assembly: Assembly) -> Scratch:
        """Allocate for `n` samples."""
        z = assembly.model.geometry.ball_count
        shapes = ((n, z, 2, 16), (n, z, 3), (n, 2, 3), (n, L.NI + 2), (n, 3 * L.NS), (n, L.NI), (assembly.size,))
        return cls(*(np.zeros(shape) for shape in shapes))


def observe(core_: Core, assembly: Assembly, times: FloatArray, states: FloatArray) -> dict[str, FloatArray]:
    """Return every channel at given states.

    Parameters
    ----------
    times : float64[:], shape (n,)
    states : float64[:, :], shape (at least n, 9 Z + n_active)

    Raises
    ------
    SolverError
        When a kernel refuses, with its name.
    """
    scratch = Scratch.of(times.size, assembly)
    ok = core_.observe(times, states, assembly.bundle, core_.evaluate_pointer, SHORTED, *scratch)
    return channels_of(ok, assembly, times, states, scratch)


def channels_of(
    ok: int, assembly: Assembly, times: FloatArray, states: FloatArray, scratch: Scratch
) -> dict[str, FloatArray]:
    """Return what was written about samples by the names of the channels."""
    if ok != 1:
        raise SolverError(fault_sentence(assembly))
    n, z = times.size, assembly.model.geometry.ball_count
    contacts, pockets, lands, extra, flat, rates, _ = scratch
    shared = flat.reshape(n, 3, L.NS)
    balls = states[:n, : L.NB * z].reshape(n, z, L.NB)
    channels: dict[str, FloatArray] = {
        "time": times.copy(),
        "body_position": shared[:, :, L.SX : L.SX + 3],
        "body_velocity": shared[:, :, L.SVX : L.SVX + 3],
        "body_tilt": np.stack([-shared[:, :, L.SAZ], shared[:, :, L.SAY]], axis=2),
        "body_tilt_velocity": shared[:, :, L.SWY : L.SWY + 2],
        "body_spin_angle": shared[:, :, L.STHETA],
        "body_spin": shared[:, :, L.SSIGMA],
        "ball_axial": balls[:, :, L.BX].copy(),
        "ball_radius": balls[:, :, L.BR].copy(),
        "ball_azimuth": balls[:, :, L.BPSI].copy(),
        "ball_velocity": balls[:, :, L.BVX : L.BVX + 3].copy(),
        "ball_spin": balls[:, :, L.BWX : L.BWX + 3].copy(),
        "pocket_force": pockets,
        "land_force": lands,
        "bearing_capacitance": extra[:, 1].copy(),
        "input_torque": extra[:, 2].copy(),
        "loss": rates[:, : L.NL].copy(),
        "input_power": rates[:, L.I_INPUT].copy(),
        "stored_energy": extra[:, 0].copy(),
    }
    for i, name in enumerate(CONTACT_CHANNELS):
        channels[name] = contacts[:, :, :, i].copy()
    return channels
