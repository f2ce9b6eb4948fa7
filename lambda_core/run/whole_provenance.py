"""Record the provenance of the results of a shaft run."""

from __future__ import annotations

import dataclasses
import tomllib

from lambda_core.case.case_writer import tables_toml
from lambda_core.laws.kernels import sources_key
from lambda_core.laws.pack import code
from lambda_core.shaft.machine_motion import MachineEngine
from lambda_core.solver.code_files import physics_sources
from lambda_core.system.bearing import BearingModel, TimeFunction
from lambda_core.system.state_channels import result_channels


def channels_of_bearings(engine: MachineEngine) -> list[tuple]:  # type: ignore[type-arg]
    """Return the channels of every bearing's result."""
    return [result_channels(bearing.context.model) for bearing in engine.bearings]


def kernel_keys(engine: MachineEngine, i: int) -> dict[str, str]:
    """Return the hashes of the laws of a bearing and of the core's own code."""
    return {**engine.bearings[i].context.kernels.keys(), "core": sources_key(*physics_sources()), "code": code()}


def code_of(engine: MachineEngine) -> str:
    """Return what has to be the same for a run to go on: code, laws, and what the whole starts from."""
    import hashlib

    keys = [
        f"{key}={value}" for i in range(len(engine.bearings)) for key, value in sorted(kernel_keys(engine, i).items())
    ]
    numbers = engine.fingerprint()
    return hashlib.sha256("\n".join(keys).encode() + numbers).hexdigest()


def bearing_alone(engine: MachineEngine, i: int) -> BearingModel:
    """Return a bearing as its own result says it: under the load that it has in the equilibrium of the whole."""
    model, reaction = engine.machine.bearings[i].model, engine.start.state.reactions[i]
    name = engine.bearings[i].name
    force = tuple(TimeFunction.constant(-float(f)) for f in reaction[:3])
    inner = dataclasses.replace(model.inner_ring, force=force)  # type: ignore[arg-type]
    shaft = engine.machine.name
    tables = tomllib.loads(model.case_toml)
    tables["name"] = f"{shaft}-{name}"
    loads = zip(("force_x", "force_y", "force_z"), reaction[:3], strict=True)
    tables["loads"] = {"inner_ring": {key: f"{-float(f):.6g} N" for key, f in loads}}
    tables["bodies"] = {**tables.get("bodies", {}), "inner_ring": {"tilt_y": "locked", "tilt_z": "locked"}}
    note = (
        f"a bearing of the shaft {shaft}: its rings move with shaft and housing, and the energy balance covers all of "
        "them; this case has the bearing alone under the load at the start"
    )
    return dataclasses.replace(
        model, name=f"{shaft}-{name}", title=f"{model.title}, {name} of {shaft}", inner_ring=inner,
        case_toml=tables_toml(tables), assumptions=(*model.assumptions, note),
    )  # fmt: skip
