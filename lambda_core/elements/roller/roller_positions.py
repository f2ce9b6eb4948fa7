"""Solve a roller bearing over one pitch."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.roller_equilibrium import RollerEquilibrium, balance
from lambda_core.elements.roller.roller_friction import RollerFriction
from lambda_core.elements.roller.slices import SLICES

# Places in pitches from the load's direction. Under a radial load the largest of all loads stands at the first.
PLACES = (0.0, 0.25, 0.5, 0.75)
_SAME = 1e-9  # of the largest load: what differs by less does not depend on the place


def over_a_pitch(
    bearing: RollerBearing,
    loads: FloatArray,
    *,
    held: tuple[bool, bool, bool, bool, bool],
    displacement: FloatArray | None = None,
    inertial: FloatArray | None = None,
    support: FloatArray | None = None,
    slices: int = SLICES,
    places: Sequence[float] = PLACES,
) -> tuple[RollerEquilibrium, ...]:
    """Return the equilibria over one pitch.

    The rollers are at even places; the first one is enough where all are alike.

    In the first a roller stands where the radial load presses, or the displacement of a held ring.

    Parameters
    ----------
    bearing, loads, held, displacement, inertial, support, slices
        As for :func:`balance`, which raises what this raises.
    places : sequence of float
        In pitches from there.
    """
    given = np.zeros(5) if displacement is None else displacement
    drawn = np.zeros(5) if support is None else support
    y, z = (float(given[i] if held[i] and drawn[i] == 0.0 else loads[i]) for i in (1, 2))
    toward = math.atan2(z, y) if y or z else 0.0
    found: list[RollerEquilibrium] = []
    for place in places:
        found.append(
            balance(
                bearing,
                loads,
                held=held,
                displacement=displacement,
                inertial=inertial,
                slices=slices,
                first_angle=toward + 2.0 * math.pi * place / bearing.count,
                near=found[-1] if found else None,
                support=support,
            )
        )
        carried = found[0].inner.sum(axis=1)
        if np.ptp(carried) <= _SAME * float(carried.max(initial=0.0)):
            break
    return tuple(found)


def mean_friction(found: Sequence[RollerFriction]) -> RollerFriction:
    """Return mean torques and extreme pressures and films.

    They are taken over places of the rollers.

    Films of slices, friction of a rib and factors are those of the first.
    """
    first = found[0]

    def mean(name: str) -> dict[str, float]:
        return {ring: sum(getattr(one, name)[ring] for one in found) / len(found) for ring in getattr(first, name)}

    ratios = {ring: [one.film_parameter[ring] for one in found] for ring in first.film_parameter}
    films = [one.rib_film for one in found if not math.isnan(one.rib_film)]
    return replace(
        first,
        rolling=mean("rolling"),
        hysteresis=mean("hysteresis"),
        sliding=mean("sliding"),
        rib=sum(one.rib for one in found) / len(found),
        film_parameter={ring: float(np.nanmin([*values, math.inf])) for ring, values in ratios.items()},
        pressure={ring: max(one.pressure[ring] for one in found) for ring in first.pressure},
        rib_film=min(films, default=math.nan),
        rib_pressure=max(one.rib_pressure for one in found),
    )
