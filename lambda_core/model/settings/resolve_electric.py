"""Resolve the electric circuit and the laws of its films."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.case.electric import MachineElectric
from lambda_core.domain.errors import LambdaError, unknown_name
from lambda_core.domain.roles import ELECTRIC_ROLES, ROLES
from lambda_core.laws.calls import plain_call
from lambda_core.model.bearing_model import BearingModel, ChosenLaw, ElectricModel
from lambda_core.model.laws.given_parameters import given_parameters
from lambda_core.model.laws.law_defaults import default_sentences
from lambda_core.model.laws.law_packages import law_called
from lambda_core.model.ledger import Ledger

if TYPE_CHECKING:
    from lambda_core.case.electric import Electric
    from lambda_core.model.laws.resolve_laws import ModelSource


def resolve_electric(options: Electric, registry: ModelSource, ledger: Ledger) -> ElectricModel:
    """Return the circuit with its laws.

    Complete unless the ledger holds problems.
    """
    laws = {}
    for role in ELECTRIC_ROLES:
        law = _law(role, options, registry, ledger)
        if law is not None:
            laws[role] = law
            ledger.record(
                f"electric.{role}.law",
                law.model.name,
                "",
                law.model.distribution or "built-in",
                "given" if "law" in getattr(options, role).model_fields_set else "default",
            )
    if "discharge" in laws:
        _arcs_can_burn(options, laws["discharge"], ledger)
    return ElectricModel(options, laws)


def resolve_machine_electric(
    options: MachineElectric | None, bearings: Sequence[str], registry: ModelSource, ledger: Ledger
) -> ElectricModel | None:
    """Return the circuit of a machine.

    It includes the laws of all its films; the result is None where the machine has no circuit.
    """
    if options is None:
        return None
    for name in options.bearings:
        if name not in bearings:
            ledger.problem(f"electric.bearings.{name}", unknown_name("bearing", name, bearings))
    return resolve_electric(options.inlined(), registry, ledger)


def with_circuits(models: Mapping[str, BearingModel], circuit: ElectricModel | None) -> dict[str, BearingModel]:
    """Return the bearings with their circuits.

    Each bearing adds its own options to the machine's circuit.
    """
    if circuit is None:
        return dict(models)
    return {
        name: replace(model, electric=replace(circuit, options=circuit.options.of_bearing(name)))
        for name, model in models.items()
    }


def _law(role: str, options: Electric, registry: ModelSource, ledger: Ledger) -> ChosenLaw | None:
    section = getattr(options, role)
    try:
        chosen = law_called(registry, role, section.law, given="law" in section.model_fields_set)
    except LambdaError as error:
        ledger.problem(f"electric.{role}.law", str(error))
        return None
    texts = dict(section.parameters)
    what, where = f"{role} {chosen.name}", f"electric.{role}.parameters"
    parameters = given_parameters(what, chosen.parameters, texts, where, ledger)
    if parameters is None:
        return None
    origins = {key: "case" if key in texts else "default" for key in type(parameters).model_fields}
    return ChosenLaw(chosen, parameters, origins)


def _arcs_can_burn(options: Electric, law: ChosenLaw, ledger: Ledger) -> None:
    """Refuse arcs that cannot burn.

    The least breakdown voltage cannot feed them; R i + U must be below it.
    """
    least = options.breakdown.least_voltage
    if law.model.prepare is not None:
        return  # what it makes of a bearing is seen when there is one
    found = plain_call(law.model.kernel, ROLES["discharge"], [least, 1e-6, 1e-7, law.parameters, np.zeros(3)])
    if found.status != 1:
        return
    out = found.outputs[0]
    needed = float(out[0] * out[2] + out[1])
    if least <= needed:
        ledger.problem(
            "electric.breakdown.least_voltage",
            f"must be above {needed:.4g} V, which the least current of an arc needs "
            f"(voltage + resistance * least current of discharge {law.model.name})",
        )


def assumed(laws: Mapping[str, ChosenLaw]) -> list[str]:
    """Return the defaults of the laws.

    Each value has a sentence.
    """
    return [
        sentence
        for role, law in laws.items()
        for sentence in default_sentences(role, law, law.parameters.model_dump(mode="json"))
    ]
