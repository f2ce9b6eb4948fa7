"""Declare the case of one bearing."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from lambda_core.case.elastic import Elastic
from lambda_core.case.electric import Electric
from lambda_core.case.fitted import FitOrigin
from lambda_core.case.modelling import Depth, Forces, Models, Output, Parameters, Solver
from lambda_core.case.motion import BetweenBodies, Bodies, Gravity, Loads, Marker, Operation
from lambda_core.case.option import option
from lambda_core.case.parts import Bearing, Lubricant, Materials, Surface
from lambda_core.case.requirements import Life, Requirements
from lambda_core.case.salvage import SHARED_STAND_INS, StandIns
from lambda_core.case.thermal import Thermal
from lambda_core.case.written import Written


class Case(Written):
    """Case file of one bearing.

    Values are in SI, written as unit strings.

    Build one with :func:`lambda_core.case.case_io.read_case`; change one with :meth:`with_`. Every field is declared
    once, with help and limits.
    """

    INSTEAD: ClassVar[Mapping[str, str]] = dict.fromkeys(
        ("bearings", "shaft", "discs", "gears", "connections", "housing"),
        "only machines have it; lambda-bearing init NAME --from FILE --as-machine writes this case as a machine",
    )
    STAND_INS: ClassVar[StandIns] = {**SHARED_STAND_INS, ("bearing",): {}}

    bearing: Bearing = option(description="the bearing")
    materials: Materials = option({}, "materials of the parts")
    lubricant: Lubricant = option(description="the oil")
    surface: Surface = option({}, "surfaces")
    loads: Loads = option({}, "external loads")
    operation: Operation = option(description="what drives the bearing")
    bodies: Bodies = option({}, "masses and boundary conditions")
    life: Life = option({}, "what modified rating lives need")
    requirements: Requirements = option({}, "what the bearing has to reach")
    thermal: Thermal = option({}, "thermal network of the bearing and its surroundings")
    markers: dict[str, Marker] = option({}, "named points whose motion is written")
    models: Models = option({}, "model by role")
    parameters: Parameters = option({}, "parameters by role, for every force element with that role")
    forces: Forces = option({}, "models and parameters of single force elements")
    elements: dict[str, BetweenBodies] = option({}, "additional force elements between bodies")
    elastic: Elastic = option({}, "parts of the bearing that bend")
    gravity: Gravity = option({}, "acceleration of gravity")
    depth: Depth = option({}, "modelling depth")
    solver: Solver = option({}, "integrator and averages")
    output: Output = option({}, "what is written")
    electric: Electric | None = option(None, "the bearing in the circuit of an electric machine")
    observers: Parameters = option({}, "channels that plugins add to the result: a table per observer, its parameters")
    events: Parameters = option(
        {}, "what plugins look out for: a table per event, action stop (default) or record, and its parameters"
    )
    fit: FitOrigin | None = option(None, "where fitted values come from; written by the command fit")
