"""Name the packages of the laws that a case uses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from lambda_core.case.case_writer import tables_toml
from lambda_core.domain.errors import LambdaError
from lambda_core.domain.installed import OWN, project_of
from lambda_core.laws.law import Law

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.laws.resolve_laws import ModelSource


def law_called(registry: ModelSource, role: str, name: str, *, given: bool) -> Law:
    """Return the law of a name.

    The program's own law fills an open choice, whatever else has that name by now.

    Raises
    ------
    LambdaError
        When there is none, or a case gives a name that several packages have.
    """
    if not given:
        with suppress(LambdaError):
            return registry.model(role, f"{OWN}:{name}")
    return registry.model(role, name)


def packaged_toml(tables: Mapping[str, Any], registry: ModelSource) -> str:
    """Write tables of a case with qualified law names.

    Every law of a plugin gets a name such as "carreau-traction:carreau".

    So it means the same law in years, whatever else has that name by then. Names that cannot be found stay. The case is
    one of a bearing or of a machine.
    """
    found: dict[str, Any] = _packaged(tables, registry)
    parts = [(role, part) for role, part in _tables(found.get("electric"))]
    parts += [("force_element", part) for name in ("elements", "connections") for _, part in _tables(found.get(name))]
    for role, part in parts:
        if isinstance(part, dict) and "law" in part:
            part["law"] = _qualified(registry, role, part["law"])
    return tables_toml(found)


def _packaged(value: Any, registry: ModelSource) -> Any:
    """Return a part of a case with renamed laws.

    They are those of its tables of models and of its time functions.
    """
    if isinstance(value, list):
        return [_packaged(each, registry) for each in value]
    if not isinstance(value, Mapping):
        return value
    found = {key: _packaged(each, registry) for key, each in value.items()}
    if value.get("kind") == "law" and "law" in value:
        found["law"] = _qualified(registry, "time_function", value["law"])
    for role, name in _tables(value.get("models")):
        found["models"][role] = _qualified(registry, role, name)
    return found


def _tables(section: Any) -> Iterator[tuple[str, Any]]:
    yield from section.items() if isinstance(section, Mapping) else ()


def _qualified(registry: ModelSource, role: str, name: Any) -> Any:
    """Return the qualified name of a law of a plugin."""
    if not isinstance(name, str) or name.startswith(f"{OWN}:"):
        return name
    try:
        return registry.model(role, name).qualified
    except LambdaError:
        return name


def foreign_laws(model: BearingModel) -> list[Law]:
    """Return a model's laws of plugins, once each."""
    circuit = model.electric.laws if model.electric is not None else {}
    laws = [law.model for roles in (*model.laws.values(), circuit) for law in roles.values()]
    found = {law.label: law for law in laws if project_of(law.distribution) not in ("", OWN)}
    return list(found.values())


def laws_line(model: BearingModel) -> str:
    """Return the line about laws of plugins.

    It names each with its origin, "" when there are none.
    """
    named = [f"{law.role} {law.name} ({law.distribution})" for law in foreign_laws(model)]
    return f"laws of others: {', '.join(named)}" if named else ""
