"""Assign dissipated power to the nodes of the network."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from lambda_core.analysis.thermal.conductances import effusivity
from lambda_core.domain.arrays import FloatArray
from lambda_core.laws.context import Material
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.settings.resolve_thermal import OWN_NODES

# Sheared oil in or before a contact is less than a micrometre thick: its heat reaches the surfaces within h^2/kappa,
# some microseconds, while it is still between them.
_IN_THE_FILM = ("sliding", "spin", "rolling", "boundary")
_IN_THE_SOLIDS = ("hysteresis", "damping")
Shares = Mapping[str, float]


def surface_shares(one: str, first: Material, other: str, second: Material) -> dict[str, float]:
    """Return two bodies' shares of their contact's heat.

    Both surfaces pass the contact at nearly one speed and have one temperature in it: the heat goes as their
    effusivities, e_1/(e_1 + e_2) (Blok 1937; Jaeger 1942); half and half for equal materials.
    """
    share = effusivity(first) / (effusivity(first) + effusivity(second))
    return {one: share, other: 1.0 - share}


def strain_shares(one: str, first: Material, other: str, second: Material) -> dict[str, float]:
    """Return the shares of strain energy in a contact.

    The shares of both bodies are as (1 - nu^2)/E (Hertz).
    """
    soft = [(1.0 - m.poisson_ratio**2) / m.youngs_modulus for m in (first, second)]
    return {one: soft[0] / sum(soft), other: soft[1] / sum(soft)}


def destinations(model: BearingModel) -> dict[str, Shares]:
    """Return the heat's destinations for each mechanism.

    They tell for LOSSES which node gets what share of the power.

    Drag heats the oil; bending the elastic parts, in equal shares: the sum of their losses is known, not each one.
    """
    ball, cage = model.ball_material, model.cage_material
    rings = {"inner": model.inner_material, "outer": model.outer_material}
    found: dict[str, Shares] = {}
    for name, ring in rings.items():
        node = f"{name}_ring"
        for mechanism in _IN_THE_FILM:
            found[f"{mechanism}_{name}"] = surface_shares(node, ring, "balls", ball)
        for mechanism in _IN_THE_SOLIDS:
            found[f"{mechanism}_{name}"] = strain_shares(node, ring, "balls", ball)
    guide = model.cage.guidance.split()[0]
    land = rings.get(guide)
    found["pocket"] = surface_shares("cage", cage, "balls", ball) if model.depth.cage else {"balls": 1.0}
    if not model.depth.cage:
        found["land"] = {"balls": 1.0}  # balls touch their neighbours
    elif land is None:
        found["land"] = {"cage": 1.0}
    else:
        found["land"] = surface_shares("cage", cage, f"{guide}_ring", land)
    found["drag"] = {"oil": 1.0}
    found["bending"] = {body: 1.0 / len(model.elastic) for body in model.elastic} or {"ambient": 1.0}
    return found


def heat_of(losses: Mapping[str, float], shares: Mapping[str, Shares]) -> FloatArray:
    """Return the heat into the bearing's nodes [W].

    The array has shape (len(OWN_NODES),).

    Parameters
    ----------
    losses : mapping of str to float
        Power by mechanism [W].
    shares : mapping
        From :func:`destinations`.
    """
    heat = np.zeros(len(OWN_NODES))
    for mechanism, power in losses.items():
        for node, share in shares[mechanism].items():
            heat[OWN_NODES.index(node)] += share * power
    return heat
