"""Convert states to channels of a result."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import SHORTED
from lambda_core.domain.elements import BODIES
from lambda_core.domain.errors import SolverError
from lambda_core.model.laws.state_channels import arc_channels
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import Core
from lambda_core.solver.drivers.contact_memory import channels_of_states
from lambda_core.solver.drivers.element_forces import element_forces, named_forces
from lambda_core.solver.drivers.equilibrium import fault_sentence
from lambda_core.solver.drivers.ring_values import contacts_by_ring, loads_of_ribs, losses_by_ring
from lambda_core.solver.drivers.roller_tables import spin_in_space
from lambda_core.solver.drivers.row_cages import cage_values
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.drivers.tables import running
from lambda_core.solver.drivers.wave_tables import wave_values
from lambda_core.solver.records import CONTACT_CHANNELS


class Scratch(NamedTuple):
    """Memory for compiled observation of n samples.

    See compiled.observe.observe.
    """

    contacts: FloatArray
    pockets: FloatArray
    lands: FloatArray
    extra: FloatArray
    shared: FloatArray
    rates: FloatArray
    dydt: FloatArray

    @classmethod
    def of(cls, n: int, context: SolverContext) -> Scratch:
        """Allocate for `n` samples."""
        z, powers = int(context.bundle.system["balls"][0]), L.power_count(context.bundle)
        shapes = (
            (n, z, int(context.bundle.rows["raceways"].max()), len(CONTACT_CHANNELS)),
            (n, z, 3),
            (n, 2 * len(context.assembly.bearings), 3),
            (n, powers + 2),
            (n, context.bundle.shared.size),
            (n, powers),
            (context.size,),
        )
        return cls(*(np.zeros(shape) for shape in shapes))


def observe(core_: Core, context: SolverContext, times: FloatArray, states: FloatArray) -> dict[str, FloatArray]:
    """Return every channel at given states.

    Parameters
    ----------
    times : float64[:], shape (n,)
    states : float64[:, :], shape (at least n, size)

    Raises
    ------
    SolverError
        When a kernel refuses, with its name.
    """
    scratch = Scratch.of(times.size, context)
    ok = core_.observe(times, states, context.bundle, core_.evaluate_pointer, SHORTED, *scratch)
    return channels_of(ok, context, times, states, scratch)


def channels_of(
    ok: int, context: SolverContext, times: FloatArray, states: FloatArray, scratch: Scratch
) -> dict[str, FloatArray]:
    """Return observed samples by channel name.

    The samples were written before.
    """
    if ok != 1:
        raise SolverError(fault_sentence(context))
    n, geometry = times.size, context.model.geometry
    contacts, pockets, lands, extra, flat, rates, _ = scratch
    everything = flat.view(R.BODY_STATE)
    bodies = everything[:, : len(BODIES)]
    balls = L.elements_in(context.bundle, states[:n])
    totals = extra[:, : R.floats_of(R.TOTALS)].view(R.TOTALS)[:, 0]
    channels: dict[str, FloatArray] = {
        "time": times.copy(),
        "body_position": bodies["position"],
        "body_velocity": bodies["velocity"],
        "body_tilt": np.stack([-bodies["tilt"][:, :, 1], bodies["tilt"][:, :, 0]], axis=2),
        "body_tilt_velocity": bodies["tilt_velocity"],
        "body_spin_angle": bodies["angle"],
        "body_spin": bodies["spin"],
        "ball_axial": balls["x"].copy(),
        "ball_radius": balls["radius"].copy(),
        "ball_azimuth": balls["azimuth"].copy(),
        "ball_velocity": balls["velocity"].copy(),
        "ball_spin": spin_in_space(context.model.rollers, balls["spin"]),
        "pocket_force": pockets,
        "land_force": lands,
        "bearing_capacitance": totals["capacitance"].copy(),
        "input_torque": totals["torque"].copy(),
        "loss": losses_by_ring(geometry, rates[:, : -L.NOT_LOST]).copy(),
        "support_power": running(rates)["support"].copy(),
        "input_power": running(rates)["input"].copy(),
        "stored_energy": totals["stored_energy"].copy(),
    }
    by_ring = contacts_by_ring(geometry, contacts)
    for i, name in enumerate(CONTACT_CHANNELS):
        channels[name] = by_ring[:, :, :, i].copy()
    for channel in arc_channels(context.model):
        i = CONTACT_CHANNELS.index(channel.name.removeprefix("arc_"))
        channels[channel.name] = contacts[:, :, :, i].copy()
    if context.model.rollers is not None:
        channels["roller_lean"] = balls["tilt"].copy()
        channels["rib_load"] = loads_of_ribs(geometry, contacts)
    tails = states[:n, context.size - context.bundle.states.size :]
    channels |= channels_of_states(context.model, tails) | wave_values(everything, context.model)
    channels |= cage_values(everything, context.model)
    if context.assembly.links:
        wrenches, powers = element_forces(context, times, flat)
        channels |= named_forces("element", wrenches, powers)
    return channels
