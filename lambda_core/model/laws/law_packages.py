"""Name the packages of the laws that a case uses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from lambda_core.domain.errors import LambdaError
from lambda_core.domain.installed import OWN, project_of
from lambda_core.laws.law import Law

if TYPE_CHECKING:
    from lambda_core.case.case import Case
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


def with_packages(case: Case, registry: ModelSource) -> Case:
    """Return the case with qualified law names.

    Every law of a plugin gets a name such as "carreau-traction:carreau".

    So it means the same law in years, whatever else has that name by then. Names that cannot be found stay.
    """
    written = case.written()
    changes: dict[str, Any] = {}
    if general := _renamed(written.get("models", {}), registry):
        changes["models"] = general
    own = {name: _renamed(force.get("models", {}), registry) for name, force in written.get("forces", {}).items()}
    if any(own.values()):
        changes["forces"] = {name: {"models": models} for name, models in own.items() if models}
    circuit = {role: part.get("law") for role, part in _tables(written.get("electric")) if isinstance(part, Mapping)}
    if films := _renamed({role: law for role, law in circuit.items() if law}, registry):
        changes["electric"] = {role: {"law": law} for role, law in films.items()}
    links = {name: _name(part.get("law"), "force_element", registry) for name, part in _tables(written.get("elements"))}
    if any(links.values()):
        changes["elements"] = {name: {"law": law} for name, law in links.items() if law}
    for section in ("loads", "operation", "bodies"):
        if (renamed := _courses(written.get(section), registry)) != written.get(section):
            changes[section] = renamed
    return case.with_(**changes) if changes else case


def _courses(value: Any, registry: ModelSource) -> Any:
    """Return a part of a case with renamed laws.

    They are the laws of its time functions.
    """
    if isinstance(value, list):
        return [_courses(each, registry) for each in value]
    if not isinstance(value, Mapping):
        return value
    found = {key: _courses(each, registry) for key, each in value.items()}
    if value.get("kind") == "law":
        found["law"] = _name(value.get("law"), "time_function", registry) or value.get("law")
    return found


def _name(name: Any, role: str, registry: ModelSource) -> str:
    """Return the qualified name of a law.

    "" where it is the one it is called by.
    """
    return _renamed({role: name}, registry).get(role, "") if name else ""


def _tables(section: Any) -> Iterator[tuple[str, Any]]:
    yield from section.items() if isinstance(section, Mapping) else ()


def _renamed(models: Mapping[str, str], registry: ModelSource) -> dict[str, str]:
    """Return the roles whose law is renamed.

    Its qualified name differs from the one it is called by.
    """
    found = {}
    for role, name in models.items():
        try:
            qualified = registry.model(role, name).qualified
        except LambdaError:
            continue
        if qualified != name and not name.startswith(f"{OWN}:"):
            found[role] = qualified
    return found


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
