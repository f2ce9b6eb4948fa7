"""Name directions in which a load moves both rings."""

from __future__ import annotations

from lambda_core.domain.elements import POSE
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.time_functions import initial

_NEGLIGIBLE = 1e-9  # of all loads: what rounding leaves


def loose_directions(model: BearingModel) -> tuple[str, ...]:
    """Return translations along which nothing holds the rings.

    A load acts along each at t = 0, weights included; connections between bodies may hold rings and are not followed.
    """
    if model.links:
        return ()
    rings, found = (model.inner_ring, model.outer_ring), []
    loads = [sum(initial(ring.force[i]) + ring.mass * model.gravity[i] for ring in rings) for i in range(3)]
    for name, load in zip(POSE, loads, strict=False):
        held = any(ring.dofs[name].mode != "free" or ring.dofs[name].stiffness > 0.0 for ring in rings)
        if not held and abs(load) > _NEGLIGIBLE * max(map(abs, loads)):
            found.append(name)
    return tuple(found)


def loose_sentence(name: str, along: str) -> str:
    """Return the error of loose rings and its remedy."""
    return (
        f"{name}: no quasi-static equilibrium: a load acts along {along} and nothing holds the rings there: "
        f"lock bodies.outer_ring.{along} or give it a support"
    )
