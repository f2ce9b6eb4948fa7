"""List all installed models, methods, views and faults.

It gives plain data for faces and documentation; `check_installed` tries every model out.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import Any, Literal

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from lambda_core.case.cards import FieldCard, field_card
from lambda_core.discovery.registry import OtherKind, Registry
from lambda_core.domain.errors import UsageError, nearest, unknown_name
from lambda_core.domain.installed import COMMANDS, in_use, project_of
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.domain.roles import DEFAULT_MODELS, ROLE_API, ROLES
from lambda_core.laws.check import ModelReport, check_model
from lambda_core.laws.law import Law
from lambda_core.laws.parameter import NoParameters
from lambda_core.laws.state import ROLE as STATES

Kind = Literal["model", "method", "view", "observer", "event", "section", "profile", "data", "command"]


class ParameterCard(FieldCard):
    """One parameter of a model, as people read it."""

    published_range: list[str]
    source: str
    status: str


class ModelCard(BaseModel):
    """One model with its origin and parameters."""

    version: int = 1  # of this form
    role: str  # stage of the pipeline
    name: str
    distribution: str
    summary: str  # one line for people
    reference: str
    validity: str  # range in which the law was established
    default: bool  # whether it fills the role when a case says nothing
    elements: list[str]  # force elements that carry the role
    outputs: list[str]  # what the kernel writes, with units
    errors: dict[int, str]  # sentence of each status from 2 on
    parameters: list[ParameterCard]  # with units, limits, defaults and sources
    states: list[str] = []  # what every contact keeps by it, with units
    reads: list[str] = []  # states of the contact that it reads


class PartCard(BaseModel):
    """Part of a plugin besides laws, with its parameters."""

    version: int = 1  # of this form
    kind: OtherKind  # "view", "profile", ...
    name: str
    title: str
    distribution: str
    reference: str
    parameters: list[FieldCard]  # with units, limits and defaults


class Item(BaseModel):
    """One line of the list of everything installed."""

    kind: Kind
    role: str  # "" unless it is a model
    name: str
    distribution: str
    reference: str


class FaultCard(BaseModel):
    """Plugin, or one of its models, with a fault.

    It cannot be used.
    """

    distribution: str
    entry_point: str  # name of the entry point, or "role/name" of the model
    message: str  # one sentence
    is_broken: bool = True  # False when it was switched off on purpose


class NoteCard(BaseModel):
    """Note about a plugin that is in use.

    It is about another name or a slow import, for example.
    """

    distribution: str
    message: str


class Inventory(BaseModel):
    """Everything installed."""

    version: int = 1  # of this form
    items: list[Item]  # models, methods, views, observers, events, data folders, commands
    faults: list[FaultCard]  # plugins that are not in use, and why
    notes: list[NoteCard] = []  # what people should know of plugins that are in use


class CheckCard(BaseModel):
    """Result of a test of one model."""

    role: str  # stage of the pipeline
    name: str
    distribution: str
    ok: bool  # whether the model may be used
    faults: list[str]  # sentences that keep it from being used
    warnings: list[str]  # sentences that do not (slow)
    not_tried: str  # why, when no parameters were at hand
    nanoseconds: float | None  # per call, or per cell of an elementwise role


class Verdict(BaseModel):
    """Results of model tests, and unloadable plugins."""

    version: int = 1  # of this form
    models: list[CheckCard]
    faults: list[FaultCard]


def inventory(registry: Registry) -> Inventory:
    """List everything that plugins offer.

    Every model, method, view and data folder, and every plugin that is not in use.
    """
    items, faults = [], [FaultCard(**vars(fault)) for fault in registry.faults]
    for role in ROLES:
        for name in registry.names(role):
            origin = registry.origin(role, name)
            try:
                found = registry.model(role, name)
            except PluginError as error:
                faults.append(FaultCard(distribution=origin, entry_point=f"{role}/{name}", message=str(error)))
                continue
            items.append(Item(kind="model", role=role, name=name, distribution=origin, reference=found.reference))
    for kind, named in registry.by_kind().items():
        for name, item in named.items():
            reference = str(getattr(item, "reference", ""))
            items.append(
                Item(kind=kind, role="", name=name, distribution=registry.origin(kind, name), reference=reference)
            )
    for distribution, folder in registry.data_folders:
        items.append(Item(kind="data", role="", name=folder.name, distribution=distribution, reference=str(folder)))
    for source in in_use(COMMANDS):
        items.append(Item(kind="command", role="", name=source.name, distribution=source.distribution, reference=""))
    notes = [NoteCard(distribution=note.distribution, message=note.message) for note in registry.notes]
    return Inventory(items=items, faults=faults, notes=notes)


def part_cards(registry: Registry, kind: OtherKind) -> list[PartCard]:
    """Return everything installed of one kind.

    Kinds other than laws; options are the parameters of a view.
    """
    found = []
    for item in registry.by_kind()[kind].values():
        parameters = getattr(item, "parameters", getattr(item, "options", NoParameters))
        found.append(
            PartCard(
                kind=kind, name=item.name, title=item.title, distribution=registry.origin(kind, item.name),
                reference=item.reference, parameters=[field_card(parameters, name) for name in parameters.model_fields],
            )
        )  # fmt: skip
    return found


def model_card(registry: Registry, label: str) -> ModelCard:
    """Return everything about one model.

    It is named "role/name", or by its name where one role alone has it.

    Raises
    ------
    UsageError
        When there is no such role, no such model, or models of several roles have the name.
    PluginError
        When the role has no such model, or it cannot be imported.
    """
    role, name = split_label(label if "/" in label else _label_of(registry, label))
    found = registry.model(role, name)
    return ModelCard(
        role=role,
        name=name,
        distribution=found.distribution,
        summary=found.summary,
        reference=found.reference,
        validity=found.validity,
        default=DEFAULT_MODELS.get(role) == name,
        elements=list(ROLES[role].elements),
        outputs=list(ROLES[role].outputs),
        errors=dict(found.errors),
        parameters=[_parameter(found, field, info) for field, info in found.parameters.model_fields.items()],
        states=[f"{state.name} [{state.unit}], {state.meaning}" for state in found.states],
        reads=list(found.reads),
    )


def _label_of(registry: Registry, name: str) -> str:
    """Return "role/name" of a unique name.

    UsageError when no model or several have it.
    """
    labels = [f"{role}/{known}" for role in ROLES for known in registry.names(role)]
    found = [label for label in labels if label.partition("/")[2] == name]
    if len(found) > 1:
        raise UsageError(f'models of several roles are called "{name}", choose one: {", ".join(found)}')
    if not found:
        near = nearest(name, {label.partition("/")[2] for label in labels})
        close = [label for known in near for label in labels if label.partition("/")[2] == known]
        raise UsageError(
            f'"{name}" is not a known model; '
            + (f"nearest: {', '.join(close)}" if close else "write ROLE/NAME, for example traction/ree-eyring")
        )
    return found[0]


def split_label(label: str) -> tuple[str, str]:
    """Split "role/name".

    UsageError when it is not of that form or the role does not exist.
    """
    role, slash, name = label.partition("/")
    if not slash:
        raise UsageError(f'"{label}" is not of the form ROLE/NAME, for example traction/ree-eyring')
    if role not in ROLES:
        raise UsageError(unknown_name("role", role, ROLES))
    return role, name


def check_installed(registry: Registry, wanted: Sequence[str] = ()) -> Iterator[CheckCard]:
    """Test models one after the other.

    Compiling takes a moment each.

    Parameters
    ----------
    registry : Registry
        What is installed.
    wanted : sequence of str
        Distributions, roles, or "role/name"; all models when empty.

    Yields
    ------
    CheckCard
        In order of the pipeline. A model whose parameters have no defaults is tried with
        those of the first lubricant in the catalogue that has them.
    """
    asked = list(chosen(registry, wanted))
    lubricants: dict[tuple[str, str], dict[str, Any]] | None = None
    for role, name in asked:
        try:
            found = registry.model(role, name)
        except PluginError as error:
            yield _card(ModelReport(_absent(role, name, registry), (str(error),)))
            continue
        required = [field for field, info in found.parameters.model_fields.items() if info.is_required()]
        if not required:
            yield _card(check_model(found), warnings=_unknown_states(registry, found))
            continue
        if lubricants is None:
            lubricants = _lubricant_parameters(registry)
        if (role, name) in lubricants:
            yield _card(check_model(found, lubricants[role, name]), warnings=_unknown_states(registry, found))
        else:
            yield _card(ModelReport(found), f"has no defaults for {', '.join(required)} and no lubricant brings them")


def broken(registry: Registry, wanted: Sequence[str] = ()) -> list[FaultCard]:
    """Return what could not be taken into use.

    It covers the distributions `wanted` (all when empty), rows included.
    """
    rows = []
    if any(not wanted or project_of(distribution) in wanted for distribution, _ in registry.data_folders):
        registry.catalogue().close()
        for distribution, _ in registry.data_folders:
            told = [text for text in registry.set_aside.get("lambda_data", ()) if f" {distribution} " in text]
            if not wanted or project_of(distribution) in wanted:
                rows += [FaultCard(distribution=distribution, entry_point="lambda_data", message=text) for text in told]
    return rows + [
        FaultCard(**vars(fault))
        for fault in registry.faults
        if fault.is_broken and (not wanted or project_of(fault.distribution) in wanted)
    ]


def chosen(registry: Registry, wanted: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Return role and name of the chosen models.

    Distributions, roles or "role/name" choose them; anything else raises a UsageError.
    """
    return (pair for pair in _chosen(registry, wanted) if pair[0] in ROLES)


def chosen_others(registry: Registry, wanted: Sequence[str]) -> list[tuple[str, str]]:
    """Return kind and name of other chosen entries.

    They are methods, views, observers, events, sections and profiles.
    """
    return [pair for pair in _chosen(registry, wanted) if pair[0] not in ROLES]


def _chosen(registry: Registry, wanted: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Return role or kind and name of everything chosen.

    Distributions, roles, kinds or "role/name" choose it.
    """
    every = [(role, name) for role in ROLES for name in registry.names(role)]
    every += [(kind, name) for kind, named in registry.by_kind().items() for name in named]
    known: dict[str, list[tuple[str, str]]] = {kind: [] for kind in registry.by_kind()}
    for role, name in every:
        for word in (role, f"{role}/{name}", project_of(registry.origin(role, name))):
            known.setdefault(word, []).append((role, name))
    for distribution in (*registry.distributions, *(fault.distribution for fault in registry.faults)):
        known.setdefault(project_of(distribution), [])
    for word in wanted:
        if word not in known:
            raise UsageError(unknown_name("distribution, role or ROLE/NAME", word, known))
    keep = {pair for word in wanted for pair in known[word]}
    return (pair for pair in every if not wanted or pair in keep)


def _absent(role: str, name: str, registry: Registry) -> Law:
    """Return a stand-in for a failed model.

    It names a model which could not be imported.
    """

    def kernel() -> int:
        return 0

    return Law(role, name, kernel, role_api=ROLE_API, reference="", distribution=registry.origin(role, name))


def _lubricant_parameters(registry: Registry) -> dict[tuple[str, str], dict[str, Any]]:
    """Return the first lubricant's parameters by (role, model).

    They have the form that a case would have.
    """
    found: dict[tuple[str, str], dict[str, Any]] = {}
    catalogue = registry.catalogue()
    try:
        for row in catalogue.lubricants(limit=10_000):
            for role, models in row.parameters.items():
                for name, values in models.items():
                    found.setdefault((role, name), {key: value.text() for key, value in values.items()})
    finally:
        catalogue.close()
    return found


def _unknown_states(registry: Registry, law: Law) -> list[str]:
    """Report states that no installed law keeps.

    A law reads them.
    """
    if not law.reads:
        return []
    kept: list[str] = []
    for name in registry.names(STATES):
        with suppress(PluginError):
            kept += [state.name for state in registry.model(STATES, name).states]
    return [
        f"{law.label}: {unknown_name('state', name, kept)}; laws of the role {STATES} that are installed keep no such"
        for name in law.reads
        if name not in kept
    ]


def _card(report: ModelReport, not_tried: str = "", warnings: Sequence[str] = ()) -> CheckCard:
    tried = report.seconds == report.seconds
    return CheckCard(
        role=report.model.role,
        name=report.model.name,
        distribution=report.model.distribution,
        ok=report.ok,
        faults=list(report.faults),
        warnings=[*report.warnings, *warnings],
        not_tried=not_tried,
        nanoseconds=report.seconds * 1e9 if tried else None,
    )


def _parameter(model: Law, name: str, info: FieldInfo) -> ParameterCard:
    extra = info.json_schema_extra if isinstance(info.json_schema_extra, dict) else {}
    published = extra.get("published_range", [])
    return ParameterCard(
        **field_card(model.parameters, name).model_dump(),
        published_range=[str(end) for end in published] if isinstance(published, list) else [],
        source=str(extra.get("source", "")),
        status=str(extra.get("status", "")),
    )
