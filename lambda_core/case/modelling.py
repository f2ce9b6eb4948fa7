"""Declare the sections for models and numerical settings.

These are models, parameters, forces, depth, solver and output.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import AfterValidator, create_model

from lambda_core.case.option import Section, option
from lambda_core.domain.elements import ELEMENTS, RIBS
from lambda_core.domain.role import Role
from lambda_core.domain.roles import DEFAULT_MODELS, MOTION_ROLES
from lambda_core.domain.units import Frequency, Time


def _finite(given: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """Refuse infinities and NaN.

    No law uses them, and no result file can hold them.
    """
    for role, values in given.items():
        for name, value in values.items():
            if isinstance(value, float) and not math.isfinite(value):
                raise ValueError(f"{role}.{name}: {value} is not a finite number")
    return given


# role -> parameter -> value; observer or event -> parameter -> value
Parameters = Annotated[dict[str, dict[str, Any]], AfterValidator(_finite)]


def _help(role: Role) -> str:
    """Return the meaning of a role's option."""
    return role.summary + ('; "auto": the law it has data for' if DEFAULT_MODELS[role.name] == "auto" else "")


if TYPE_CHECKING:

    class Models(Section):
        """Model by role.

        The fields are the roles of the domain.
        """

        def __getattr__(self, role: str) -> str | None: ...

else:
    Models = create_model(
        "Models",
        __base__=Section,
        __doc__="Model by role, for every force element that has the role; absent: the built-in default.",
        __module__=__name__,
        **{role.name: (str | None, option(None, _help(role))) for role in MOTION_ROLES.values()},
    )


class ForceElement(Section):
    """Models and parameters of one force element.

    They precede those of the whole bearing.
    """

    models: Models = option({}, "models by role")
    parameters: Parameters = option({}, "parameters by role")


if TYPE_CHECKING:

    class Forces(Section):
        """Force elements between the bodies.

        The fields are the elements of the domain.
        """

else:
    Forces = create_model(
        "Forces",
        __base__=Section,
        __doc__="Force elements between the bodies.",
        __module__=__name__,
        **{name: (ForceElement, option({}, meaning)) for name, meaning in (ELEMENTS | RIBS).items()},
    )


class Depth(Section):
    """Modelling depth.

    It sets which parts move, and how finely a contact is divided.
    """

    cage: bool = option(True, "the cage is a body; off: neighbours touch each other instead")
    strips: int = option(31, "strips across the contact ellipse, along its major axis", ge=3, le=201)
    rows: int = option(1, "cells along rolling in each strip; 1 is the slice model", ge=1, le=201)


class Solver(Section):
    """Integrator and averages."""

    tolerance: float = option(1e-3, "error tolerance per step, on the absolute scales of the states", gt=0.0, le=0.1)
    accuracy: Literal["auto", "averages", "vibration"] = option(
        "auto",
        "what has to be true: averages (loss, speeds, loads), or vibrations too, at four to eight times the cost; "
        "auto: vibrations where a raceway is not nominal or something shakes faster than the shaft turns",
    )
    resolve: Frequency | None = option(
        None, "highest frequency of vibrations to resolve; absent: 2 kHz, or twice an excitation", gt=0.0
    )
    duration: Time | None = option(None, "simulated time; absent: until converged", gt=0.0)
    max_duration: Time | None = option(None, "longest simulated time; absent: 30 turns of the cage", gt=0.0)
    discard_revolutions: float = option(1.0, "cage revolutions before averaging starts", ge=0.0)
    average_revolutions: float = option(4.0, "cage revolutions that are averaged at least", gt=0.0)
    max_step: Time | None = option(
        None,
        "longest step; by default 1/20 of an excitation at most, 1/6 of the shortest period to resolve; absent: 1/400 "
        "of a cage turn, 1/100 for vibrations",
        gt=0.0,
    )
    max_wall: Time | None = option(
        None,
        "wall time, preparation included, after which a run stops; resume continues without it; absent: no limit",
        gt=0.0,
    )


class Output(Section):
    """Contents of the output."""

    interval: Time | None = option(None, "simulated time between samples; absent: 1/100 of a cage turn", gt=0.0)
    checkpoint_interval: Time = option("10 s", "wall time between checkpoints", gt=0.0)
