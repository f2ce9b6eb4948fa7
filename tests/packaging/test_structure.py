"""Test names, sizes and directions of modules."""

from __future__ import annotations

import ast
import re
from collections import Counter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CORE = sorted((ROOT / "lambda_core").rglob("*.py"))
OURS = [*CORE, *(path for folder in ("plugins", "db", "gui", "cli") for path in sorted((ROOT / folder).rglob("*.py")))]
LONGEST = 500  # lines of a module


def found(pattern: str, paths: list[Path]) -> list[str]:
    """Return where a pattern occurs."""
    return [
        f"{path.relative_to(ROOT)}:{number}"
        for path in paths
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if re.search(pattern, line)
    ]


def test_modules_of_one_package_have_names_of_their_own() -> None:
    names = Counter((path.relative_to(ROOT / "lambda_core").parts[0], path.name) for path in CORE)
    assert [name for name, count in names.items() if count > 1 and name[1] not in ("__init__.py", "api.py")] == []


def test_no_module_is_long() -> None:
    counts = {str(path.relative_to(ROOT)): len(path.read_text(encoding="utf-8").splitlines()) for path in OURS}
    assert len(counts) > 500
    assert {path: count for path, count in counts.items() if count > LONGEST} == {}


def test_laws_read_their_parameters_by_name() -> None:
    pages = [*(ROOT / "docs").rglob("*.md"), *(ROOT / "examples").rglob("*.py")]
    assert found(r"\bpar\[[0-9]+\]", [*OURS, *pages]) == []


def test_no_array_is_read_by_a_constant_that_stands_for_a_name() -> None:
    assert found(r"\w\[[A-Z]{1,2}_[A-Z0-9_]+\b", CORE) == []


def test_roles_are_declared_once() -> None:
    places = {place.split(":")[0] for place in found('"elastic_hysteresis"', CORE)}
    # Compiled code keeps some inputs of a law that refuses; their names stand next to it. Type checkers read literals.
    copies = {"lambda_core/solver/drivers/fault_inputs.py", "lambda_core/laws/law.py"}
    assert places == {"lambda_core/domain/roles.py", *copies}
    assert len(found(r"FloatArray = N[D]Array", OURS)) == 1


def test_processes_are_started_in_few_places() -> None:
    """Start processes in the engine, compiler and check.

    The batch engine, the compile step, and the separate check of plugins.
    """
    places = {place.split(":")[0] for place in found(r"ProcessPoolExecutor|subprocess\.Popen", OURS)}
    assert places == {
        "lambda_core/studies/pool.py",
        "lambda_core/discovery/apart.py",
        "lambda_core/solver/entry.py",
    }


def test_what_numba_does_not_promise_stands_in_one_room() -> None:
    outside = [path for path in CORE if "jit" not in path.parts]
    places = found(r"numba\.(core|experimental|extending|misc|typed|np)\b|numba import cloudpickle", outside)
    # Functions of a notebook are packed as Numba's copy of cloudpickle packs them; cases, below the laws, carry them.
    assert [place.split(":")[0] for place in places] == ["lambda_core/domain/inline_laws.py"]


def test_packages_have_other_names_than_functions() -> None:
    """Give packages and functions different names.

    The import of a package sets its name in the package above: ``lb.run`` would be a module from then on.
    """
    import lambda_core as lb

    packages = {path.stem for path in (ROOT / "lambda_core").iterdir() if path.is_dir() or path.suffix == ".py"}
    assert packages.isdisjoint(lb.__all__)
    old = found(r"lambda_core[.](run|study|fit)[.]", [*OURS, *sorted((ROOT / "tests").rglob("*.py"))])
    assert old == [], "the packages are runs, studies, fitting"


# Circles of imports that are left: none may be added, and one that is gone leaves the list.
CIRCLES = {
    "results": {
        "bearing_summary convergence currents machine_numbers observed quasistatic reader "
        "ring_deformation run_text summary text",
        "bibtex citation",
    },
    "analysis/electric": {"outcome simulation"},
    "case": set(),
}


def imports_of(folder: Path) -> dict[str, set[str]]:
    """Return the imports of each module.

    Within a package, in functions and for type checkers, too.
    """
    prefix = ".".join(folder.relative_to(ROOT).parts)
    paths = {f"{prefix}.{'.'.join(p.relative_to(folder).with_suffix('').parts)}": p for p in folder.rglob("*.py")}
    graph: dict[str, set[str]] = {}
    for name, path in paths.items():
        graph[name] = set()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                graph[name] |= {alias.name for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.module:
                graph[name] |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        graph[name] &= paths.keys() - {name}
    return graph


def circles(graph: dict[str, set[str]]) -> set[str]:
    """Return import circles.

    Groups of modules that reach each other, as their last names.
    """
    reached = {}
    for name in graph:
        found, left = set(), [name]
        while left:
            new = graph[left.pop()] - found
            found |= new
            left += new
        reached[name] = found
    groups = {frozenset(o for o in graph if name in reached[o] and o in reached[name]) for name in graph}
    return {" ".join(sorted(name.rpartition(".")[2] for name in group)) for group in groups if len(group) > 1}


def test_circles_of_imports_are_found() -> None:
    assert circles({"p.a": {"p.b"}, "p.b": {"p.c"}, "p.c": {"p.a"}, "p.d": {"p.a"}, "p.e": set()}) == {"a b c"}


@pytest.mark.parametrize("folder", CIRCLES)
def test_circles_of_imports_only_get_fewer(folder: str) -> None:
    assert circles(imports_of(ROOT / "lambda_core" / folder)) == CIRCLES[folder]
