"""Measure a plugin's traction law against the built-in law."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import lambda_plugins.traction

from benchmarks.cases import MIDDLE, Point
from benchmarks.handle import Handle
from benchmarks.parts import trajectory, unit_costs
from benchmarks.passage import Horizon, Passage, passage, wall
from benchmarks.tables import Cell, Section, Table, Target
from benchmarks.timing import Effort
from lambda_core.discovery.manager import registry
from lambda_core.laws.kernels import compile_kernel
from lambda_core.solver.drivers.equilibrium import solve

_PLUGIN = '''
"""Two traction laws from another distribution."""

import math
from dataclasses import replace

from lambda_core.plugins import OK, hookimpl, law

import benchmark_traction


@law("traction", "benchmark-plain", benchmark_traction.ReeEyring, role_api=3, reference="own work")
def plain_eyring(slip, p, T, ln_eta, h, par, tau):
    """The same law as a newcomer would write it, with the functions of the standard library."""
    for i in range(tau.size):
        film = max(h[i], 1e-10)
        viscosity = math.exp(min(max(ln_eta[i], -60.0), 60.0))
        stress = par.tau_eyring * math.asinh(viscosity * slip[i] / (film * par.tau_eyring))
        limit = max(par.limit_ratio * p[i], 0.0)
        width = 0.1 * limit
        held = min(stress, limit + width)
        inside = max(held - (limit - width), 0.0)
        tau[i] = held - inside * inside / (4.0 * width + 1e-300)
    return OK


@hookimpl
def lambda_laws(register):
    register(replace(benchmark_traction.ree_eyring.lambda_law, name="benchmark-eyring"))
'''
_METADATA = "Metadata-Version: 2.1\nName: benchmark-laws\nVersion: 0.1\n"
_ENTRY = "[lambda_bearing.plugins]\nlaws = benchmark_laws\n"


@contextmanager
def installed() -> Iterator[None]:
    """Install a distribution with a copied law.

    The copy of the built-in law is in a file of its own, for this process.
    """
    with tempfile.TemporaryDirectory() as folder:
        site = Path(folder)
        source = Path(lambda_plugins.traction.__file__).read_text(encoding="utf-8")
        (site / "benchmark_traction.py").write_text(source, encoding="utf-8")
        (site / "benchmark_laws.py").write_text(_PLUGIN, encoding="utf-8")
        info = site / "benchmark_laws-0.1.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(_METADATA, encoding="utf-8")
        (info / "entry_points.txt").write_text(_ENTRY, encoding="utf-8")
        sys.path.insert(0, str(site))
        registry.cache_clear()
        try:
            yield
        finally:
            sys.path.remove(str(site))
            registry.cache_clear()


def compile_seconds(name: str) -> float:
    """Return the time of a compilation [s].

    Of a law where nothing is on disk.
    """
    law = registry().model("traction", name)
    before = os.environ.get("LAMBDA_BEARING_CACHE")
    with tempfile.TemporaryDirectory() as folder:
        os.environ["LAMBDA_BEARING_CACHE"] = folder
        try:
            return compile_kernel(law).seconds
        finally:
            if before is None:
                del os.environ["LAMBDA_BEARING_CACHE"]
            else:
                os.environ["LAMBDA_BEARING_CACHE"] = before


def measure(effort: Effort) -> Section:
    """Integrate the same case with the three laws, repeats interleaved."""
    laws = ("ree-eyring", "benchmark-eyring", "benchmark-plain")
    titles = ("built-in", "the same from another distribution", "the same, written with math.exp and math.asinh")
    horizon = Horizon(0.0, 1.0)
    with installed():
        seconds = [compile_seconds(name) for name in laws]
        models = [Point("", MIDDLE.case, (f"models.traction={name}",)).model() for name in laws]
        starts = [solve(model) for model in models]
        repeats: list[list[Passage]] = [[] for _ in laws]
        for _ in range(effort.repeats + 2):
            for model, start, found in zip(models, starts, repeats, strict=True):
                found.append(passage(model, start, horizon))
        parts = [
            unit_costs(Handle(start.context), *trajectory(model, start, 2))
            for model, start in zip(models, starts, strict=True)
        ]
    cost = [wall(found) / found[0].simulated for found in repeats]
    rows: list[tuple[Cell, ...]] = [
        (
            title,
            1e6 * parts[i]["rhs"],
            cost[i],
            cost[i] / cost[0],
            repeats[i][0].outcome.raceway_power,
            seconds[i],
        )
        for i, title in enumerate(titles)
    ]
    table = Table(
        f"A traction law as a plugin, {MIDDLE.name}",
        ("law", "right-hand side us", "wall s/s", "over built-in", "raceway loss W", "compile s"),
        tuple(rows),
    )
    targets = (
        Target("third-party traction law over the built-in one", "times", cost[1] / cost[0], 1.1),
        Target("third-party traction law, compilation", "s", max(seconds[1:]), 1.0),
    )
    return Section("foreign-law", (table,), targets)
