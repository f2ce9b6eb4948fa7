"""Write the model description of FMI 2.0 and 3.0."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass

from lambda_core.export.fmu.interface_units import UNITS
from lambda_core.export.fmu.variables import Kind, Variable

VERSIONS = {2: "2.0", 3: "3.0"}
_CAUGHT = {"logStatusError": "steps and values that are refused", "logStatusWarning": "what deserves a look"}


@dataclass(frozen=True)
class About:
    """Head of a description.

    Attributes
    ----------
    name : str
        Of the bearing.
    text : str
        A sentence about it.
    identifier : str
        Name of the library's file.
    token : str
        By which the library knows its description.
    tool : str
        Program and version.
    end, step : float
        What a host may simulate [s].
    """

    name: str
    text: str
    identifier: str
    token: str
    tool: str
    end: float
    step: float


def description(about: About, variables: Sequence[Variable], fmi: int) -> bytes:
    """Return modelDescription.xml."""
    root = ET.Element("fmiModelDescription", fmiVersion=VERSIONS[fmi], modelName=about.name)
    root.set("guid" if fmi == 2 else "instantiationToken", about.token)
    root.set("description", about.text)
    root.set("generationTool", about.tool)
    root.set("variableNamingConvention", "structured")
    if fmi == 2:
        root.set("numberOfEventIndicators", "0")
    ET.SubElement(root, "CoSimulation", _abilities(about, fmi))
    _units(root)
    categories = ET.SubElement(root, "LogCategories")
    for name, text in _CAUGHT.items():
        ET.SubElement(categories, "Category", name=name, description=text)
    ET.SubElement(root, "DefaultExperiment", startTime="0.0", stopTime=repr(about.end), stepSize=repr(about.step))
    model = ET.SubElement(root, "ModelVariables")
    for reference, variable in enumerate(variables):
        _variable(model, variable, reference, fmi)
    _structure(root, variables, fmi)
    ET.indent(root)
    written: bytes = ET.tostring(root, encoding="UTF-8", xml_declaration=True)
    return written + b"\n"


def _abilities(about: About, fmi: int) -> dict[str, str]:
    yes = {
        2: (
            "canHandleVariableCommunicationStepSize", "canNotUseMemoryManagementFunctions", "canGetAndSetFMUstate",
            "canSerializeFMUstate", "providesDirectionalDerivative",
        ),
        3: (
            "canHandleVariableCommunicationStepSize", "canGetAndSetFMUState", "canSerializeFMUState",
            "providesDirectionalDerivatives",
        ),
    }  # fmt: skip
    return {"modelIdentifier": about.identifier, **dict.fromkeys(yes[fmi], "true")}


def _units(root: ET.Element) -> None:
    units = ET.SubElement(root, "UnitDefinitions")
    for name, unit in UNITS.items():
        element = ET.SubElement(units, "Unit", name=name)
        ET.SubElement(element, "BaseUnit", {base: str(power) for base, power in unit.base.items()})
        if unit.shown:
            shown, factor, added = unit.shown
            more = {"name": shown, "factor": repr(factor)} | ({"offset": repr(added)} if added else {})
            ET.SubElement(element, "DisplayUnit", more)


def _variable(model: ET.Element, variable: Variable, reference: int, fmi: int) -> None:
    counts = variable.kind is Kind.COUNT
    head = {"name": variable.name, "valueReference": str(reference), "description": variable.text}
    changes = "tunable" if variable.tunable else "discrete" if counts else "continuous"
    head |= {"causality": variable.causality, "variability": changes}
    more = {} if counts else {"unit": variable.unit}
    shown = UNITS[variable.unit].shown if variable.unit else None
    if shown and not (variable.unit == "rad/s" and variable.name.endswith("_rate")):
        more["displayUnit"] = shown[0]
    if variable.kind is Kind.VARIED:
        more |= dict(zip(("min", "max"), map(repr, variable.limits), strict=True))
    if variable.given:
        more["start"] = repr(variable.start)
    if fmi == 2:
        scalar = ET.SubElement(model, "ScalarVariable", head)
        ET.SubElement(scalar, "Integer" if counts else "Real", more)
    else:
        ET.SubElement(model, "Int64" if counts else "Float64", head | more)


def _structure(root: ET.Element, variables: Sequence[Variable], fmi: int) -> None:
    """Mark the outputs of the model.

    Each depends on all inputs, and is available at the start.
    """
    structure = ET.SubElement(root, "ModelStructure")
    outputs = [i for i, variable in enumerate(variables) if variable.causality == "output"]
    if fmi == 3:
        for name in ("Output", "InitialUnknown"):
            for i in outputs:
                ET.SubElement(structure, name, valueReference=str(i))
        return
    for name in ("Outputs", "InitialUnknowns"):
        group = ET.SubElement(structure, name)
        for i in outputs:
            ET.SubElement(group, "Unknown", index=str(i + 1))
