"""What a plugin registers: a model (role, kernel, parameters) and the context its set-up sees."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from lambda_core.registry.roles import ROLE_API

FloatArray = NDArray[np.float64]


class NoParameters(BaseModel):
    """Parameters of a model that has none."""

    model_config = ConfigDict(extra="forbid")


@dataclass(frozen=True)
class Material:
    """Solid properties of one body, SI."""

    name: str
    youngs_modulus: float  # [Pa]
    poisson_ratio: float  # [-]
    density: float  # [kg/m3]
    thermal_conductivity: float  # [W/(m K)]
    specific_heat: float  # [J/(kg K)]


@dataclass(frozen=True)
class Oil:
    """Properties of the lubricant at the run's bulk temperature, SI.

    The first block comes from the catalogue; the second is derived by the host from the
    chosen rheology kernel and is NaN in the context handed to that kernel's own `prepare`.
    """

    name: str
    base_type: str  # "mineral", "PAO", ...
    temperature: float  # bulk and inlet temperature [K]
    thermal_conductivity: float  # [W/(m K)]
    specific_heat: float  # [J/(kg K)]
    viscosity: float = float("nan")  # at ambient pressure [Pa s]
    density: float = float("nan")  # at ambient pressure [kg/m3]
    alpha_p: float = float("nan")  # d ln(eta)/dp at p = 0 [1/Pa]
    beta: float = float("nan")  # -d ln(eta)/dT [1/K]


@dataclass(frozen=True)
class Context:
    """Everything a model's `prepare` may look at: frozen geometry, materials and oil, SI.

    Lengths that a force element does not have are NaN (a cage contact has no groove).
    """

    element: str  # "ball_inner", "ball_outer", "ball_cage", "ball_ball", "cage_inner", "cage_outer", "fluid_drag"
    ball_count: int  # Z
    ball_diameter: float  # [m]
    pitch_diameter: float  # [m]
    bore_diameter: float  # [m]
    outside_diameter: float  # [m]
    width: float  # [m]
    series: str  # "60", "62", "63", "64", "618", "619" or "" when unknown
    speed: float  # |Omega_i - Omega_o| at the start or its largest planned value [rad/s]
    mean_load: float  # mean normal load of the loaded contacts at equilibrium [N]
    ball: Material  # of the balls
    partner: Material  # ring or cage
    oil: Oil  # at the bulk temperature
    contact_angle: float = float("nan")  # at which R_x is frozen [rad]
    groove_radius: float = float("nan")  # [m]
    race_diameter: float = float("nan")  # at the groove's bottom [m]
    radius_x: float = float("nan")  # reduced radius along rolling [m]
    radius_y: float = float("nan")  # reduced radius across rolling [m]
    e_eff: float = float("nan")  # E' with 2/E' = sum (1-nu^2)/E [Pa]
    pocket_clearance: float = float("nan")  # diametral clearance of ball and pocket [m]
    land_clearance: float = float("nan")  # diametral clearance of cage and land [m]
    land_diameter: float = float("nan")  # diameter of the guiding land [m]
    cage_width: float = float("nan")  # [m]
    oil_level: float = float("nan")  # height of the oil above the lowest point of the pitch circle [m]


Prepare = Callable[[Any, Context], FloatArray]


def _no_errors() -> Mapping[int, str]:
    return MappingProxyType({})


@dataclass(frozen=True)
class Model:
    """One law for one role.

    Attributes
    ----------
    role, name : str
        Which stage of the pipeline it fills; how a case names it.
    kernel : callable
        Plain Python function with the role's signature (:mod:`lambda_core.registry.roles`).
    parameters : type of pydantic.BaseModel
        Fields with units, ranges and sources; rendered in files, help and forms.
    prepare : callable or None
        ``prepare(parameters, context) -> float64[:]``; None means the fields in order, SI.
    reference : str
        Paper and equation number.
    summary : str
        One line for people.
    validity : str
        Range in which the law was established.
    errors : mapping of int to str
        Sentences for the kernel's own status codes (2 and up).
    role_api : int
        Version of the role interface that it is written for.
    """

    role: str
    name: str
    kernel: Callable[..., int]
    parameters: type[BaseModel]
    reference: str
    summary: str = ""
    validity: str = ""
    prepare: Prepare | None = None
    errors: Mapping[int, str] = field(default_factory=_no_errors)
    role_api: int = ROLE_API
    distribution: str = ""  # filled by the registry

    @property
    def label(self) -> str:
        """Role, name and distribution as messages show them."""
        return f"{self.role}/{self.name} ({self.distribution})" if self.distribution else f"{self.role}/{self.name}"


@dataclass(frozen=True)
class LazyModel:
    """A law that is named now and imported when somebody chooses it.

    A package with many laws registers these, so that starting the program, or running
    a case that uses other laws, does not import its modules.

    Attributes
    ----------
    role, name : str
        As in the model itself.
    target : str
        ``"package.module:attribute"``, where the attribute is the :class:`Model`.
    """

    role: str
    name: str
    target: str


def model(
    role: str,
    name: str,
    kernel: Callable[..., int],
    parameters: type[BaseModel] = NoParameters,
    *,
    reference: str,
    summary: str = "",
    validity: str = "",
    prepare: Prepare | None = None,
    errors: Mapping[int, str] | None = None,
    role_api: int = ROLE_API,
) -> Model:
    """Describe a law for `role`; pass the result to ``register`` in ``lambda_models``.

    Parameters
    ----------
    role, name : str
        A role of :data:`lambda_core.registry.roles.ROLES`; the name by which a case chooses the law.
    kernel : callable
        Plain Python function with the role's arguments; returns 1, or one of `errors`.
    parameters : type of pydantic.BaseModel
        Fields with defaults, units, limits and sources; the kernel finds them in order in ``par``, SI.
    reference : str
        Publication and equation numbers, "-" where there is nothing to cite.
    summary, validity : str
        One line about the law (default: first line of the kernel's docstring); range in which it was established.
    prepare : callable, optional
        ``prepare(parameters, context) -> float64[:]``: what the kernel gets as ``par``, made once per run.
    errors : mapping of int to str, optional
        A sentence for each status of the kernel from 2 on.
    role_api : int
        Version of the role interface that the law is written for.

    Returns
    -------
    Model
        Frozen; it is checked when it is registered and when it is chosen.
    """
    doc = (kernel.__doc__ or "").strip().splitlines()
    return Model(
        role,
        name,
        kernel,
        parameters,
        reference,
        summary or (doc[0] if doc else ""),
        validity,
        prepare,
        MappingProxyType(dict(errors or {})),
        role_api,
    )


def default_par(parameters: BaseModel) -> FloatArray:
    """Return the fields of `parameters` in order: what a kernel without `prepare` gets as ``par``.

    Parameters
    ----------
    parameters : pydantic.BaseModel
        An instance; every field a number, SI.

    Returns
    -------
    float64[:], shape (number of fields,)
    """
    return np.array([float(getattr(parameters, name)) for name in type(parameters).model_fields], dtype=np.float64)
