"""Define roller profiles of plugins.

The hook is ``lambda_profiles``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from pydantic import BaseModel

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.plugin_errors import PluginError, blamed
from lambda_core.laws.parameter import NoParameters, default_fault

PROFILE_API = 1
_POINTS = 201  # of the table from the middle to the end, closer towards the end: twice the finest slices


@dataclass(frozen=True)
class RollerShape:
    """A roller as profiles see it, SI."""

    diameter: float  # mean diameter D_we [m]
    effective_length: float  # of the raceway contacts L_we [m]
    half_angle: float = 0.0  # half of the cone's angle [rad]; 0: cylindrical


_TRIAL = RollerShape(11e-3, 11e-3)  # about that of an NU 208


@dataclass(frozen=True)
class RollerProfile:
    """A profile of rollers.

    Attributes
    ----------
    name : str
        Short and unique: "my-profile"; ``bearing.rollers.profile`` of a case.
    title : str
        One line for people.
    drop : callable
        ``drop(x, roller, parameters)`` returns the drop below cylinder or cone [m], shape of `x`, zero or more and even
        in x: the distance from the middle along the contact line [m], up to half of ``roller.effective_length``.
    reference : str
        Publication and equation numbers, "own work" where there is none.
    parameters : type of Parameters
        Its parameters; a case gives them in ``bearing.rollers.profile_parameters``.
    profile_api : int
        Version of this interface that it is written for, as a number: 1.
    """

    name: str
    title: str
    drop: Callable[[FloatArray, RollerShape, Any], Any] = field(repr=False)
    reference: str
    parameters: type[BaseModel] = NoParameters
    profile_api: int = 0
    distribution: str = ""  # filled by the registry


def profile_fault(item: object) -> str:
    """Say what keeps a profile from being registered, or nothing."""
    if not isinstance(item, RollerProfile):
        return f"lambda_profiles registers a {type(item).__name__}: wrap it in RollerProfile(name, title, ...)"
    label = f"the profile {item.name}"
    if item.profile_api != PROFILE_API:
        if not item.profile_api:
            return f"{label} does not say for which version it is written: write profile_api={PROFILE_API}"
        return f"{label} is written for version {item.profile_api} of the interface; this is {PROFILE_API}"
    if not callable(item.drop):
        return f"{label} calls a {type(item.drop).__name__}, not a function"
    if not item.reference.strip():
        return f'{label} has no reference: name its source ("own work" is one)'
    if not (isinstance(item.parameters, type) and issubclass(item.parameters, BaseModel)):
        return f"the parameters of {label} are not a pydantic BaseModel class"
    if fault := default_fault(item.parameters):
        return f"{label}: {fault}"
    if not any(info.is_required() for info in item.parameters.model_fields.values()):
        try:
            profile_points(item, _TRIAL, item.parameters())
        except PluginError as error:
            return str(error)
    return ""


def profile_points(profile: RollerProfile, roller: RollerShape, parameters: Any) -> tuple[tuple[float, float], ...]:
    """Return the table of a profile.

    Distance from the middle and drop [m], from zero to the end of the contact.

    Raises
    ------
    PluginError
        When its function fails, or returns what no roller can have.
    """
    what = f'the profile "{profile.name}" ({profile.distribution})'.replace(" ()", "")
    x = 0.5 * roller.effective_length * np.sin(np.linspace(0.0, 0.5 * np.pi, _POINTS))
    with blamed(what):
        drop, mirrored = (np.asarray(profile.drop(side, roller, parameters), dtype=np.float64) for side in (x, -x))
    if drop.shape != x.shape or mirrored.shape != x.shape:
        raise PluginError(f"{what} returns an array of the shape {drop.shape} for positions of the shape {x.shape}")
    for bad, words in (
        (~np.isfinite(drop + mirrored), "which is not finite"),
        (drop < 0.0, "below zero"),
        (~np.isclose(drop, mirrored, rtol=1e-9, atol=1e-15), "and another drop at the opposite side: it must be even"),
    ):
        if bad.any():
            first = int(np.argmax(bad))
            raise PluginError(f"{what} returns {drop[first]:g} m at {1e3 * x[first]:.3g} mm from the middle, {words}")
    return tuple(zip(x.tolist(), drop.tolist(), strict=True))
