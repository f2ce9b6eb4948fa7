"""Compile the solver and every installed law."""

from __future__ import annotations

import time
from collections.abc import Callable

from pydantic import Field

from lambda_core.discovery.api import Registry
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.domain.roles import ROLES
from lambda_core.laws.kernels import cache_folder, compile_kernel
from lambda_core.laws.pack import pack
from lambda_core.results.record import INTERFACE, Record
from lambda_core.solver.core import begin, core, roller_unit
from lambda_core.solver.entry import OF_ROLLERS, ON_DEMAND, UNITS, missing


class Warmup(Record):
    """Compiled and cached code."""

    interface: int = INTERFACE
    folder: str = Field(description="where compiled code is kept")
    solver_parts: int = Field(description="parts that the solver is compiled in")
    solver_parts_compiled: int = Field(description="by this call; the others were there")
    laws: int = Field(description="installed laws")
    laws_compiled: int = Field(description="by this call; the others were there")
    faults: list[str] = Field(description="laws that cannot be compiled, and why")
    seconds: float = Field(description="wall time of this call [s]")

    def text(self) -> str:
        """Return the lines for people."""
        lines = [
            f"solver   {self.solver_parts} parts, {self.solver_parts_compiled} compiled now",
            f"laws     {self.laws}, {self.laws_compiled} compiled now",
            f"kept in  {self.folder}",
            *(f"not compiled: {fault}" for fault in self.faults),
            f"{self.seconds:.1f} s",
        ]
        return "\n".join(lines)


def warmup(models: Registry, announce: Callable[[str], None] | None = None) -> Warmup:
    """Compile the solver and every law.

    It compiles the laws of a registry into the cache on disk.

    Parameters
    ----------
    models : Registry
        What is installed.
    announce : callable, optional
        Called with a sentence before something is compiled.
    """
    start = time.perf_counter()
    absent = missing((*UNITS, *OF_ROLLERS)) if pack() is None else []
    begin(announce, UNITS, has_rollers=True)
    said: list[str] = []  # one sentence per law that was not on disk

    def say(text: str) -> None:
        said.append(text)
        if announce is not None:
            announce(text)

    laws = [(role, name) for role in ROLES for name in models.names(role)]
    faults, compiled = [], 0
    for role, name in laws:
        before = len(said)
        try:
            compile_kernel(models.model(role, name), say)
            compiled += len(said) - before
        except PluginError as error:
            faults.append(str(error))
    solver = core(announce)
    for name in ON_DEMAND:
        solver.find(name)
    for name in OF_ROLLERS:
        roller_unit(solver, name)
    return Warmup(
        folder=str(cache_folder()),
        solver_parts=len(UNITS) + len(OF_ROLLERS),
        solver_parts_compiled=len(absent),
        laws=len(laws),
        laws_compiled=compiled,
        faults=faults,
        seconds=time.perf_counter() - start,
    )
