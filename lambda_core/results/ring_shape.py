"""Declare the shape of an elastic ring in the equilibrium."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from pydantic import Field

from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.elastic.ring import shape
from lambda_core.formulas.loading import Ring
from lambda_core.results.record import Record

_PLACES = 720  # round a ring, where its shape is looked at


class RingShape(Record):
    """Shape of an elastic ring, own frame."""

    ring: Ring
    orders: list[int] = Field(description="numbers of waves round the ring")
    cosine_um: list[float] = Field(description="amplitude of cos(n azimuth) of each, outwards")
    sine_um: list[float] = Field(description="amplitude of sin(n azimuth) of each, outwards")
    outwards_um: float = Field(description="farthest displacement outwards")
    outwards_deg: float = Field(description="azimuth where that is")
    inwards_um: float = Field(description="farthest displacement inwards")
    inwards_deg: float = Field(description="azimuth where that is")


def ring_shape(ring: Ring, orders: Iterable[int], amplitudes: FloatArray) -> RingShape:
    """Return the shape of a ring.

    It follows from the amplitudes [m], (orders, 2).
    """
    azimuths = np.linspace(0.0, 2.0 * np.pi, _PLACES, endpoint=False)
    bent = shape(amplitudes, azimuths)
    return RingShape(
        ring=ring,
        orders=list(orders),
        cosine_um=(1e6 * amplitudes[:, 0]).tolist(),
        sine_um=(1e6 * amplitudes[:, 1]).tolist(),
        outwards_um=1e6 * float(bent.max()),
        outwards_deg=math.degrees(azimuths[int(bent.argmax())]),
        inwards_um=-1e6 * float(bent.min()),
        inwards_deg=math.degrees(azimuths[int(bent.argmin())]),
    )
