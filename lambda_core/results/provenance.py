"""Record the provenance of a result.

It consists of case, values, laws, versions and plugins.
"""

from __future__ import annotations

import json
import math
import platform
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, fields, is_dataclass
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from pydantic import BaseModel

from lambda_core import __version__
from lambda_core.domain.section_roles import FILMS
from lambda_core.laws.law import Law
from lambda_core.results.rating import Rating
from lambda_core.system.bearing import BearingModel
from lambda_core.views.observer import Event, Observer

_LIBRARIES = ("numpy", "scipy", "numba", "llvmlite", "h5py", "pydantic")
# Of the model these stand in datasets of their own, or follow from the case and are part of the geometry.
_APART = ("values", "assumptions", "case_toml", "plugins", "mounting", "thermal", "contradictions")


@cache
def _of_libraries() -> dict[str, str]:
    """Return the versions of what is installed: looked up on disk, once for all runs of a process."""
    found = {}
    for name in _LIBRARIES:
        with suppress(PackageNotFoundError):
            found[name] = version(name)
    return found


@dataclass(frozen=True)
class Provenance:
    """The fixed part of a result file."""

    model: BearingModel
    kernel_keys: Mapping[str, str]  # "element/role/model", or a part of the core -> hash of the code
    rating: Rating | None = None  # what standards and catalogues say of the equilibrium that it starts from
    part_of: tuple[str, str] | None = None  # of a shaft's run: its mark, and the bearing's name there

    def versions(self) -> dict[str, str]:
        """Return versions of the program, Python, the libraries, and the platform."""
        ours = {"lambda-bearing": __version__, "python": platform.python_version(), "platform": platform.platform()}
        return ours | _of_libraries()

    def laws(self) -> list[dict[str, str]]:
        """Return one row per force element, or film of the circuit, and role: the model and its parameters."""
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
        """Return one row per resolved value, numbers in SI, written exactly; `type` says "number" or "text"."""
        return [
            {field.name: str(getattr(value, field.name)) for field in fields(value)}
            | {"type": "text" if isinstance(value.value, str) else "number"}
            for value in self.model.values
        ]

    def model_json(self) -> str:
        """Return the resolved model as JSON (see :func:`model_data`)."""
        return json.dumps(model_data(self.model), ensure_ascii=False)

    def created(self) -> str:
        """Return the time now, ISO 8601, UTC."""
        return datetime.now(UTC).isoformat(timespec="seconds")


def model_data(model: BearingModel) -> dict[str, Any]:
    """Return the resolved model as plain data, SI; infinite and undefined numbers as text."""
    return {field.name: plain(getattr(model, field.name)) for field in fields(model) if field.name not in _APART}


# What may change when a run goes on: when it ends, and how it is written.
_FREE = ("solver.duration", "solver.max_duration", "solver.max_wall", "output.checkpoint_interval")


def differences(before: Mapping[str, Any], after: Mapping[str, Any]) -> list[str]:
    """Return the paths at which two resolved models would not run the same, sorted."""
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
    if isinstance(value, Law):
        return {"role": value.role, "name": value.name, "distribution": value.distribution}
    if isinstance(value, Observer | Event):
        return {"name": value.name, "distribution": value.distribution}
    if isinstance(value, BaseModel):
        return {name: plain(getattr(value, name)) for name in type(value).model_fields}
    if is_dataclass(value):
        return {field.name: plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return value
