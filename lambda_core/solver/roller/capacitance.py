"""Compute the capacitance of roller contacts.

Flats of slices with the gaps on their sides, and open gaps.

A line that carries has the capacitance that its law gives for the flat of all slices. One that is open has that of the
law without a flat, at the distance of the nearest slice. Ribs count where they carry.
"""

from __future__ import annotations

import numpy as np

from lambda_core.solver.arrays.fault_roles import CAPACITANCE
from lambda_core.solver.contact.contact_capacitance import bulk_permittivity, contact_capacitance
from lambda_core.solver.faults import report
from lambda_core.solver.layout import cells_of, grid_of, helper, part, raceway_laws
from lambda_core.solver.records import LINE
from lambda_core.solver.roller.line import line_wrench


@helper
def _touching_film(raceway, kin, delta, bundle):
    """Return the film [m] at first touch.

    The nearest slice just touches as deep as the roughness, or -1; writes over scratch.
    """
    contact, penetration, velocity = bundle.scratch[0].contact[0], kin.penetration, kin.normal_velocity
    kin.penetration, kin.normal_velocity = penetration + raceway.roughness - delta, 0.0
    found = line_wrench(raceway, 0, bundle)
    film = contact.film_central
    kin.penetration, kin.normal_velocity = penetration, velocity
    return film if found == 1 else -1.0


@helper
def open_line(raceway, kin, delta, bundle):
    """Return the capacitance [F] of an open line.

    A light line has the least one and other lines have 0; return -1 on a fault.

    Open lines come no closer than the film that the oil would leave where they touched, so that the capacitance is
    continuous where they do. Call it before the wrench of the contact in scratch.
    """
    if raceway.kind != LINE or delta >= raceway.roughness:
        return 0.0
    film = 0.0
    if delta > -raceway.reach:
        film = _touching_film(raceway, kin, delta, bundle)
        if film < -0.5:
            return -1.0
    laws, out = raceway_laws(bundle.laws.raceways, raceway.laws), bundle.scratch[0].out[:]
    gap, bulk, oil = max(-delta, film, raceway.roughness), bulk_permittivity(raceway, laws, bundle), raceway.oil
    u = oil.viscosity * abs(kin.entrainment_t) / (raceway.modulus * raceway.radius_x)
    out[0] = np.nan
    status = laws.capacitance(
        0.0, gap, 0.5 * raceway.radius_y, 0.0, raceway.radius_x, raceway.radius_y, u, oil.alpha_p * raceway.modulus,
        0.0, bulk, part(bundle.par, raceway.parameters.capacitance), out,
    )  # fmt: skip
    if status != 1 or not abs(out[0]) < np.inf:
        report(bundle.scratch[0].fault, CAPACITANCE, status, raceway.number, 0.0, gap, 0.0, 0.0)
        return -1.0
    return out[0]


@helper
def loaded_capacitance(raceway, kin, bundle, shorted, touching, sample):
    """Write the loaded contact's capacitance.

    The contact is in scratch; return 1, or 0 on a fault.
    """
    laws = raceway_laws(bundle.laws.raceways, raceway.laws)
    if raceway.kind == LINE:
        grid, cells = grid_of(bundle.slices), cells_of(bundle.line_cells, 0, 1, bundle.slices.shape[1])
        return contact_capacitance(raceway, kin, laws, bundle, grid, cells, shorted, touching, sample)
    grid, cells = grid_of(bundle.grid), cells_of(bundle.cells, 0, 1, bundle.grid.shape[1])
    return contact_capacitance(raceway, kin, laws, bundle, grid, cells, shorted, touching, sample)


@helper
def in_series(one, other):
    """Return a roller's capacitance between rings [F].

    Inf stands for a ring that asperities short.
    """
    if one <= 0.0 or other <= 0.0:
        return 0.0
    return 1.0 / (1.0 / one + 1.0 / other)
