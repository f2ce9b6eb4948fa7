"""Spread the load of a roller over its slices."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.domain.errors import SolverError
from lambda_core.elements.roller.slices import SLICES, slice_positions
from lambda_core.laws.par import flat_kernel
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.law_context import ContactFrame, build_context, prepare

_FRAME = ContactFrame((0.0, 0.0), (0.0, 0.0))  # raceways of rollers have one angle everywhere
_HALVINGS = 60
_FARTHEST = 1e-3  # approach that no contact of a bearing reaches [m]


@dataclass(frozen=True)
class LineField:
    """One roller-raceway contact in slices, SI.

    Attributes
    ----------
    place : float64[:]
        Middles of the slices from the roller's middle, along the contact towards +x [m].
    line_load : float64[:]
        Load over length [N/m].
    pressure, half_width : float64[:]
        Largest pressure [Pa] and half width along rolling [m].
    lean : float
        Tilt of the roller against the raceway, outwards at +x [rad].
    """

    place: FloatArray
    line_load: FloatArray
    pressure: FloatArray
    half_width: FloatArray
    lean: float


def lean_of(sample: Mapping[str, FloatArray], roller: int, ring: str) -> float:
    """Return a roller's tilt against a ring [rad].

    It is in the plane of the bearing's axis; it counts outwards at +x.

    Parameters
    ----------
    sample : mapping
        Channel -> array without the time axis (lambda_core.domain.channels).
    roller : int
        From 0.
    """
    azimuth, (about_y, about_z) = sample["ball_azimuth"][roller], sample["body_tilt"][RINGS.index(ring)]
    of_ring = about_z * np.cos(azimuth) - about_y * np.sin(azimuth)
    return float(sample["roller_lean"][roller, 0] - of_ring)


def line_field(model: BearingModel, ring: str, load: float, lean: float) -> LineField:
    """Return the slices of a loaded line contact.

    They carry a load together, by the law and profile of the model.

    The approach of a slice is that of the roller's middle with its lean, less the drop of the profile there; angles are
    small. The approach of the middle follows from the load.

    Parameters
    ----------
    load : float
        On the contact [N], above zero.
    lean : float
        Of :func:`lean_of` [rad].

    Raises
    ------
    SolverError
        When the law refuses, or no approach carries the load.
    """
    rollers, element = model.rollers, f"ball_{ring}"
    assert rollers is not None
    law = model.laws[element]["normal_contact"]
    context = build_context(model, element, _FRAME, model.oil)
    kernel, par, out = flat_kernel(law.model), prepare(law, context), np.zeros(4)
    place, drop = slice_positions(rollers.effective_length, SLICES), rollers.drops(SLICES)
    side = -1.0 if ring == "inner" else 1.0
    taper = rollers.faces * np.tan(rollers.angles.half) / (0.5 * rollers.diameter)
    radii, shift = context.radius_x * (1.0 - taper * place), side * lean * place - drop

    def slices(middle: float) -> FloatArray:
        """Return load, half width and pressure of slices.

        They are load over length, of all slices, (3, n).
        """
        found = np.zeros((3, SLICES))
        for k in np.flatnonzero(middle + shift > 0.0):
            delta = float(middle + shift[k])
            if kernel(delta, float(radii[k]), context.radius_y, context.e_eff, par, out) != 1:
                raise SolverError(f"{law.model.label} gives no load at an approach of {1e6 * delta:.4g} um")
            found[:, k] = out[0] / context.radius_y, out[2], out[3]
        return found

    width = rollers.effective_length / SLICES
    low, high = -float(shift.max()), _FARTHEST
    if not slices(high)[0].sum() * width > load:
        raise SolverError(f"{law.model.label} carries no {load:.5g} N on this contact")
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if slices(middle)[0].sum() * width > load else (middle, high)
    line_load, half_width, pressure = slices(0.5 * (low + high))
    return LineField(place, line_load, pressure, half_width, lean)
