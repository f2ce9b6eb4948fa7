"""Define a law: kernel, role, parameters and source."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import KW_ONLY, dataclass, field
from types import FunctionType, MappingProxyType
from typing import Any, Literal, Required, TypedDict, TypeVar, Unpack, overload

from pydantic import BaseModel

from lambda_core.domain.inline_laws import MARK
from lambda_core.domain.installed import OWN, project_of
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.domain.roles import ROLE_API
from lambda_core.laws import kernel_types as types
from lambda_core.laws.context import Context
from lambda_core.laws.parameter import NoParameters
from lambda_core.laws.state import State

Prepare = Callable[[Any, Context], Any]
Kernel = TypeVar("Kernel", bound=Callable[..., int])
Given = type[BaseModel]


def _no_errors() -> Mapping[int, str]:
    return MappingProxyType({})


def _no_states() -> Mapping[str, float]:
    return MappingProxyType({})


Contact = Literal["point", "line", "any"]


@dataclass(frozen=True)
class Law:
    """One law for one role.

    Attributes
    ----------
    role, name : str
        Which stage of the pipeline it fills; how a case names it.
    kernel : callable
        Plain Python function with the role's arguments (:mod:`lambda_core.domain.roles`).
    parameters : type of pydantic.BaseModel
        Fields with units, ranges and sources; rendered in files, help and forms.
    role_api : int
        Version of the role interface that it is written for.
    reference : str
        Paper and equation number.
    summary : str
        One line for people; the first line of the kernel's docstring if not given.
    validity : str
        Range in which the law was established.
    prepare : callable or None
        ``prepare(parameters, context)`` returns the record that the kernel reads as ``par`` and is annotated with its
        type; None means the fields of `parameters`, SI.
    errors : mapping of int to str
        Sentences for the kernel's own status codes (2 and up).
    bibtex : str
        The reference as BibTeX, where it is to be cited in other words than `reference` says it.
    states : tuple of State
        What every contact keeps, for laws of the role ``contact_state``; the kernel reads it as ``par.NAME``.
    reads : mapping of str to float
        States of the contact that the kernel reads as ``par.NAME``, each with a value to try the law with.
    contact : {"point", "line", "any"}
        Shape of the contacts that it is about, in the roles of :data:`lambda_core.domain.roles.DEFAULT_LINE_MODELS`:
        ellipses, lines of rollers, or either.
    distribution : str
        Package that brought it, with its version; filled in when it is registered.
    """

    role: str
    name: str
    kernel: Callable[..., int]
    parameters: type[BaseModel] = NoParameters
    _: KW_ONLY
    role_api: int
    reference: str
    summary: str = ""
    validity: str = ""
    prepare: Prepare | None = None
    errors: Mapping[int, str] = field(default_factory=_no_errors)
    bibtex: str = ""
    states: tuple[State, ...] = ()
    reads: Mapping[str, float] = field(default_factory=_no_states)
    contact: Contact = "point"
    distribution: str = ""

    def __post_init__(self) -> None:
        """Take the summary from the kernel.

        Errors and states become read-only.
        """
        doc = (self.kernel.__doc__ or "").strip().splitlines()
        object.__setattr__(self, "summary", self.summary or (doc[0] if doc else ""))
        object.__setattr__(self, "errors", MappingProxyType(dict(self.errors)))
        object.__setattr__(self, "reads", MappingProxyType(dict(self.reads)))

    @property
    def label(self) -> str:
        """Role, name and distribution as messages show them."""
        return f"{self.role}/{self.name} ({self.distribution})" if self.distribution else f"{self.role}/{self.name}"

    @property
    def qualified(self) -> str:
        """Name with its package before it.

        No other package can take it, for example "carreau-traction:carreau".
        """
        project = project_of(self.distribution)
        return f"{project}:{self.name}" if project and project != OWN else self.name


@dataclass(frozen=True)
class LazyLaw:
    """Law that is imported when chosen.

    Its name is known before.

    A package with many laws registers these, so that starting the program, or running
    a case that uses other laws, does not import its modules.

    Attributes
    ----------
    role, name : str
        As in the law itself.
    target : str
        ``"package.module:function"``, where :func:`law` stands above the function.
    """

    role: str
    name: str
    target: str


class LawWords(TypedDict, total=False):
    """Keywords of :func:`law`."""

    role_api: Required[int]
    reference: Required[str]
    summary: str
    validity: str
    prepare: Prepare | None
    errors: Mapping[int, str] | None
    bibtex: str
    states: tuple[State, ...]
    reads: Mapping[str, float] | None
    contact: Contact


_NormalContactKernel = TypeVar("_NormalContactKernel", bound=types.NormalContactKernel)
_RheologyKernel = TypeVar("_RheologyKernel", bound=types.RheologyKernel)
_FilmThicknessKernel = TypeVar("_FilmThicknessKernel", bound=types.FilmThicknessKernel)
_ThermalCorrectionKernel = TypeVar("_ThermalCorrectionKernel", bound=types.ThermalCorrectionKernel)
_SupplyKernel = TypeVar("_SupplyKernel", bound=types.SupplyKernel)
_ContactTemperatureKernel = TypeVar("_ContactTemperatureKernel", bound=types.ContactTemperatureKernel)
_TractionKernel = TypeVar("_TractionKernel", bound=types.TractionKernel)
_RollingResistanceKernel = TypeVar("_RollingResistanceKernel", bound=types.RollingResistanceKernel)
_ElasticHysteresisKernel = TypeVar("_ElasticHysteresisKernel", bound=types.ElasticHysteresisKernel)
_AsperityLoadKernel = TypeVar("_AsperityLoadKernel", bound=types.AsperityLoadKernel)
_BoundaryFrictionKernel = TypeVar("_BoundaryFrictionKernel", bound=types.BoundaryFrictionKernel)
_MixingKernel = TypeVar("_MixingKernel", bound=types.MixingKernel)
_ContactStateKernel = TypeVar("_ContactStateKernel", bound=types.ContactStateKernel)
_CageContactKernel = TypeVar("_CageContactKernel", bound=types.CageContactKernel)
_FluidDragKernel = TypeVar("_FluidDragKernel", bound=types.FluidDragKernel)
_PermittivityKernel = TypeVar("_PermittivityKernel", bound=types.PermittivityKernel)
_CapacitanceKernel = TypeVar("_CapacitanceKernel", bound=types.CapacitanceKernel)
_SurfaceKernel = TypeVar("_SurfaceKernel", bound=types.SurfaceKernel)
_ForceElementKernel = TypeVar("_ForceElementKernel", bound=types.ForceElementKernel)
_TimeFunctionKernel = TypeVar("_TimeFunctionKernel", bound=types.TimeFunctionKernel)
_BreakdownKernel = TypeVar("_BreakdownKernel", bound=types.BreakdownKernel)
_DischargeKernel = TypeVar("_DischargeKernel", bound=types.DischargeKernel)


# A kernel with other arguments than its role has is an error for type checkers.
@overload
def law(
    role: Literal["normal_contact"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_NormalContactKernel], _NormalContactKernel]: ...
@overload
def law(
    role: Literal["rheology"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_RheologyKernel], _RheologyKernel]: ...
@overload
def law(
    role: Literal["film_thickness"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_FilmThicknessKernel], _FilmThicknessKernel]: ...
@overload
def law(
    role: Literal["thermal_correction"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_ThermalCorrectionKernel], _ThermalCorrectionKernel]: ...
@overload
def law(
    role: Literal["supply"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_SupplyKernel], _SupplyKernel]: ...
@overload
def law(
    role: Literal["contact_temperature"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_ContactTemperatureKernel], _ContactTemperatureKernel]: ...
@overload
def law(
    role: Literal["traction"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_TractionKernel], _TractionKernel]: ...
@overload
def law(
    role: Literal["rolling_resistance"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_RollingResistanceKernel], _RollingResistanceKernel]: ...
@overload
def law(
    role: Literal["elastic_hysteresis"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_ElasticHysteresisKernel], _ElasticHysteresisKernel]: ...
@overload
def law(
    role: Literal["asperity_load"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_AsperityLoadKernel], _AsperityLoadKernel]: ...
@overload
def law(
    role: Literal["boundary_friction"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_BoundaryFrictionKernel], _BoundaryFrictionKernel]: ...
@overload
def law(
    role: Literal["mixing"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_MixingKernel], _MixingKernel]: ...
@overload
def law(
    role: Literal["contact_state"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_ContactStateKernel], _ContactStateKernel]: ...
@overload
def law(
    role: Literal["cage_contact"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_CageContactKernel], _CageContactKernel]: ...
@overload
def law(
    role: Literal["fluid_drag"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_FluidDragKernel], _FluidDragKernel]: ...
@overload
def law(
    role: Literal["permittivity"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_PermittivityKernel], _PermittivityKernel]: ...
@overload
def law(
    role: Literal["capacitance"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_CapacitanceKernel], _CapacitanceKernel]: ...
@overload
def law(
    role: Literal["surface"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_SurfaceKernel], _SurfaceKernel]: ...
@overload
def law(
    role: Literal["force_element"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_ForceElementKernel], _ForceElementKernel]: ...
@overload
def law(
    role: Literal["time_function"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_TimeFunctionKernel], _TimeFunctionKernel]: ...
@overload
def law(
    role: Literal["breakdown"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_BreakdownKernel], _BreakdownKernel]: ...
@overload
def law(
    role: Literal["discharge"], name: str, parameters: Given = ..., **words: Unpack[LawWords]
) -> Callable[[_DischargeKernel], _DischargeKernel]: ...
@overload
def law(role: str, name: str, parameters: Given = ..., **words: Unpack[LawWords]) -> Callable[[Kernel], Kernel]: ...
def law(
    role: str,
    name: str,
    parameters: type[BaseModel] = NoParameters,
    *,
    role_api: int | None = None,
    reference: str,
    summary: str = "",
    validity: str = "",
    prepare: Prepare | None = None,
    errors: Mapping[int, str] | None = None,
    bibtex: str = "",
    states: tuple[State, ...] = (),
    reads: Mapping[str, float] | None = None,
    contact: Contact = "point",
) -> Callable[[Kernel], Kernel]:
    """Make the function below a law.

    The function itself stays as it is: other kernels may call it. Laws in the module that an entry point names are
    registered by themselves; from other modules by ``register(function)`` in ``lambda_laws``.

    Parameters
    ----------
    role, name : str
        A role of :data:`lambda_core.domain.roles.ROLES`; the name by which a case chooses the law.
    parameters : type of pydantic.BaseModel
        Fields with defaults, units, limits and sources; the kernel reads them by name from ``par``, SI.
    role_api : int
        Version of the role interface that the law is written for, as a number: 3. Without it the law is refused.
    reference : str
        Publication and equation numbers, "-" where there is nothing to cite.
    summary, validity : str
        One line about the law (default: first line of the docstring); range in which it was established.
    prepare : callable, optional
        ``prepare(parameters, context)``, annotated with the record type that it returns (a NamedTuple or dataclass of
        numbers and arrays): what the kernel reads as ``par``, made once per run and force element.
    errors : mapping of int to str, optional
        A sentence for each status of the kernel from 2 on.
    bibtex : str, optional
        Entries for ``cite --bibtex``; without it they are read from `reference`.
    states : tuple of State, optional
        Of a law of the role ``contact_state``: what every contact keeps.
    reads : mapping of str to float, optional
        States that the kernel reads as ``par.NAME``, each with a value to try the law with.
    contact : {"point", "line", "any"}
        Shape of the contacts that the law is about. To a law of lines R_y is the contact's length, semi_a its half,
        semi_b the half width; loads, forces and moments are those of the whole length.

    Examples
    --------
    >>> from lambda_core.plugins import OK, Parameters, law, parameter
    >>> class Limit(Parameters):
    ...     limit_ratio: float = parameter(0.07, "limiting shear stress over pressure")
    >>> @law("traction", "plastic", Limit, role_api=3, reference="own work")
    ... def plastic(slip, p, T, ln_eta, h, par, tau):
    ...     for i in range(tau.size):
    ...         tau[i] = par.limit_ratio * p[i] if slip[i] > 0.0 else 0.0
    ...     return OK

    Returns
    -------
    callable
        A decorator that turns the kernel into a law.

    Raises
    ------
    PluginError
        When the description of the law contradicts its kernel or its parameters.
    """

    if role_api is None:
        raise PluginError(
            f"{role}/{name} does not say for which version of the roles it is written: "
            f"write role_api={ROLE_API}, the number itself"
        )

    def decorate(kernel: Kernel) -> Kernel:
        made = Law(
            role,
            name,
            kernel,
            parameters,
            role_api=role_api,
            reference=reference,
            summary=summary,
            validity=validity,
            prepare=prepare,
            errors=errors or {},
            bibtex=bibtex,
            states=states,
            reads=reads or {},
            contact=contact,
        )
        if not isinstance(kernel, FunctionType):
            raise PluginError(
                f"{made.label}: the kernel is a {type(kernel).__name__}: write a plain Python function "
                "without a decorator, the program compiles it"
            )
        kernel.__dict__[MARK] = made
        return kernel

    return decorate


def law_of(item: object) -> Law | None:
    """Return the law of an object.

    The object is a law, or the kernel of one; None for any other object.
    """
    found = item if isinstance(item, Law) else getattr(item, MARK, None)
    return found if isinstance(found, Law) else None
