"""Provide small study files and an executor without processes."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import Any

MAP = """
name = "small-map"
title = "A small map"
case = "6319-cp10-1500"
responses = ["friction_torque_Nmm", "friction_breakdown_Nmm", "max_pressure_GPa", "min_film_parameter"]

[[parameters]]
path = "operation.speed"
range = ["500 rpm", "3000 rpm"]
points = 3
label = "speed"

[[parameters]]
path = "loads.radial"
values = ["16 kN", "24600 N"]
label = "radial load"
"""

RUNS = """
name = "small-runs"
case = "6208-axial-1300"
mode = "dynamic"
responses = ["friction_torque_Nmm", "friction_breakdown_Nmm", "cage_speed_deviation", "bearing_capacitance_nF"]

[set]
"solver.duration" = "{duration}"

[[parameters]]
path = "operation.speed"
range = ["2000 rpm", "3000 rpm"]
points = {speeds}

[[parameters]]
path = "loads.radial"
range = ["0.1 kN", "1 kN"]
points = {loads}
"""


class Inline(Executor):
    """Does every task at once, in this process."""

    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(function(*args, **kwargs))
        except BaseException as error:
            future.set_exception(error)
        return future
