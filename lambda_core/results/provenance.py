"""Record the provenance of a result.

It consists of case, values, laws, versions and plugins.
"""

from __future__ import annotations

import json
import math
import platform
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields, is_dataclass
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

from lambda_core import __version__
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import ALONE
from lambda_core.domain.section_roles import FILMS
from lambda_core.laws.law import Law
from lambda_core.model.bearing_model import BearingModel
from lambda_core.results.model_band import ModelBand
from lambda_core.results.rating import Rating
from lambda_core.views.observer import Event, Observer

if TYPE_CHECKING:
    from lambda_core.model.machine_model import MachineModel

_LIBRARIES = ("numpy", "scipy", "numba", "llvmlite", "h5py", "pydantic")
# Of the model these stand in datasets of their own, or follow from the case and are part of the geometry.
_APART = (
    "values", "assumptions", "case_toml", "plugins", "mounting", "thermal", "contradictions",
    "contamination", "requirements", "found_temperatures",
)  # fmt: skip


@cache
def _of_libraries() -> dict[str, str]:
    """Return the versions of installed libraries.

    Looked up on disk, once for all runs of a process.
    """
    found = {}
    for name in _LIBRARIES:
        with suppress(PackageNotFoundError):
            found[name] = version(name)
    return found


@dataclass(frozen=True)
class BearingOrigin:
    """Fixed part of a result for one bearing."""

    model: BearingModel
    kernel_keys: Mapping[str, str]  # "element/role/model", or a part of the core -> hash of the code
    rating: Rating | None = None  # what standards and catalogues say of the equilibrium that it starts from
    headline: str = ""  # of a bearing in a machine: under the load that it carries there; otherwise that of its model
    band: ModelBand | None = None  # of the equilibrium, where it was asked for
    warnings: tuple[str, ...] = ()  # of the start, besides limits that case or state pass

    def laws(self) -> list[dict[str, str]]:
        """Return one row per law.

        Each force element or film of the circuit has one for each role, with the model and its parameters.
        """
        circuit = self.model.electric
        films = dict.fromkeys(FILMS, circuit.laws) if circuit is not None else {}
        return [
            {
                "element": element,
                "role": role,
                "model": law.model.name,
                "distribution": law.model.distribution,
                "reference": law.model.reference,
                "bibtex": law.model.bibtex,
                "parameters": json.dumps(plain(law.parameters)),
                "origins": json.dumps(dict(law.origins)),
                "kernel_key": self.kernel_keys.get(f"{element}/{role}/{law.model.name}", ""),
            }
            for element, roles in {**self.model.laws, **films}.items()
            for role, law in roles.items()
        ]

    def values(self) -> list[dict[str, str]]:
        """Return one row per resolved value.

        Numbers are in SI and written exactly; `type` is "number" or "text".
        """
        return [
            {field.name: str(getattr(value, field.name)) for field in fields(value)}
            | {"type": "text" if isinstance(value.value, str) else "number"}
            for value in self.model.values
        ]

    def model_json(self) -> str:
        """Return the resolved model as JSON (see :func:`model_data`)."""
        return json.dumps(model_data(self.model), ensure_ascii=False)


@dataclass(frozen=True)
class MachineOrigin:
    """Fixed part of a result for a machine.

    It is that of shaft and bodies.

    Attributes
    ----------
    headline : str
        Lines that say what the machine is.
    model : mapping
        The machine as plain data, without its bearings (see :func:`machine_data`).
    numbers : mapping
        Further numbers of the equilibrium that the run starts from, SI.
    labels : mapping
        Dimension -> names or places [m] of the bodies, markers and lumps.
    assumptions, warnings : tuple of str
        One sentence each.
    """

    headline: str
    model: Mapping[str, Any]
    numbers: Mapping[str, float]
    labels: Mapping[str, Sequence[str] | FloatArray]
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]


@dataclass(frozen=True)
class Provenance:
    """The fixed part of a result file.

    Attributes
    ----------
    name, title : str
        Of the case.
    case_toml : str
        The case, complete: it runs again as it stands.
    bearings : mapping
        Name of the bearing -> what it has for itself, in the order of the machine.
    machine : MachineOrigin, optional
        Of a case that is a machine; None: one bearing alone.
    """

    name: str
    title: str
    case_toml: str
    bearings: Mapping[str, BearingOrigin]
    machine: MachineOrigin | None = None

    @classmethod
    def alone(
        cls,
        model: BearingModel,
        kernel_keys: Mapping[str, str],
        rating: Rating | None = None,
        warnings: tuple[str, ...] = (),
    ) -> Provenance:
        """Return that of a run of one bearing."""
        origin = BearingOrigin(model, kernel_keys, rating, warnings=warnings)
        return cls(model.name, model.title, model.case_toml, {ALONE: origin})

    @property
    def models(self) -> list[BearingModel]:
        """Models of the bearings."""
        return [origin.model for origin in self.bearings.values()]

    @property
    def plugins(self) -> tuple[str, ...]:
        """Distribution and version of every used plugin.

        A bearing was resolved with it.
        """
        return tuple(dict.fromkeys(name for model in self.models for name in model.plugins))

    def versions(self) -> dict[str, str]:
        """Return all versions.

        They are those of the program, Python, the libraries and the platform.
        """
        ours = {"lambda-bearing": __version__, "python": platform.python_version(), "platform": platform.platform()}
        return ours | _of_libraries()

    def created(self) -> str:
        """Return the time now, ISO 8601, UTC."""
        return datetime.now(UTC).isoformat(timespec="seconds")


def machine_data(model: MachineModel) -> dict[str, Any]:
    """Return a machine without its bearings as plain data, SI.

    Each array is replaced by its shape and two sums over its numbers, enough to tell whether it has changed.
    """
    apart = (
        "bearings",
        "electric",
        "case_toml",
        "assumptions",
        "warnings",
        "heat",
        "awaits_temperatures",
        "found_temperatures",
    )  # they are found before
    found = {field.name: plain(getattr(model, field.name)) for field in fields(model) if field.name not in apart}
    seats = {one.name: {**vars(one), "model": one.name} for one in model.bearings}
    return {**found, "bearings": plain(seats)}


def _sums(values: NDArray[Any]) -> dict[str, Any]:
    """Return shape and sums of an array.

    The sums have the digits that do not depend on the order of additions.
    """
    flat = np.abs(values.astype(np.float64).ravel())
    weights = 1.0 + np.arange(flat.size) % 997 / 997.0
    return {"shape": list(values.shape), "sum": f"{flat.sum():.9g}", "weighted": f"{(flat * weights).sum():.9g}"}


def model_data(model: BearingModel) -> dict[str, Any]:
    """Return the resolved model as plain data.

    The data are in SI; infinite and undefined numbers are text.
    """
    return {field.name: plain(getattr(model, field.name)) for field in fields(model) if field.name not in _APART}


# What may change when a run goes on: when it ends, and how it is written.
_FREE = ("solver.duration", "solver.max_duration", "solver.max_wall", "output.checkpoint_interval")


def differences(before: Mapping[str, Any], after: Mapping[str, Any]) -> list[str]:
    """Return the paths of two models' differences.

    There they would not run the same; sorted.
    """
    old, new = dict(_leaves("", before)), dict(_leaves("", after))
    paths = {path for path in old.keys() | new.keys() if old.get(path) != new.get(path)}
    silent = ("name", "title", *_FREE)
    return sorted(path for path in paths if path not in silent and ".origins" not in path)


def _leaves(path: str, value: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(value, Mapping):
        for key, item in value.items():
            yield from _leaves(f"{path}.{key}" if path else key, item)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from _leaves(f"{path}[{index}]", item)
    else:
        yield path, value


def plain(value: Any) -> Any:
    """Return `value` as what JSON can say."""
    if isinstance(value, float):
        return value if math.isfinite(value) else str(value)
    if value is None or isinstance(value, str | int):
        return value
    if isinstance(value, Law):
        return {"role": value.role, "name": value.name, "distribution": value.distribution}
    if isinstance(value, Observer | Event):
        return {"name": value.name, "distribution": value.distribution}
    if isinstance(value, BaseModel):
        return {name: plain(getattr(value, name)) for name in type(value).model_fields}
    if isinstance(value, np.ndarray):
        return _sums(value)
    if is_dataclass(value):
        return {field.name: plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return value
