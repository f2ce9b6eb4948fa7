"""Tell whether a case is that of a result."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lambda_core.domain.elements import ALONE
from lambda_core.model.machine_model import MachineModel
from lambda_core.results.provenance import differences, machine_data, model_data

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.results.reader import Result


def named_models(model: BearingModel | MachineModel) -> dict[str, BearingModel]:
    """Return the models of all bearings as results name them."""
    return {name or ALONE: own for name, own in model.bearing_models.items()}


def changed_values(result: Result, model: BearingModel | MachineModel) -> dict[str, list[str]]:
    """Return the values that a case has changed since.

    Returns
    -------
    dict of str to list of str
        Paths of the changed values by the bearing's name, with "" for the machine; nothing for what is as it was.
    """
    models = named_models(model)
    if tuple(models) != result.bearing_names:
        return {"": ["bearings"]}
    found = {name: differences(own.model, model_data(models[name])) for name, own in result.bearings.items()}
    if isinstance(model, MachineModel):
        found[""] = differences(result.machine, machine_data(model))
    return {name: paths for name, paths in found.items() if paths}
