"""List the source files that determine results.

They name compiled code on disk, and tell whether other code continues a run.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

from lambda_core.laws.kernels import sources_key

_SOLVER = Path(__file__).parent
_DRIVERS = "drivers"  # Python around the compiled code: what it does is in no machine code
_ROLLER = "roller"  # called by pointer: in no other code


def compiled_sources() -> tuple[Path, ...]:
    """Return the sources of every machine's code.

    They are files and folders of compiled Python.
    """
    others = (_DRIVERS, _ROLLER)
    return tuple(
        path
        for path in sorted(_SOLVER.iterdir())
        if path.name not in others and (path.suffix == ".py" or path.is_dir())
    )


def roller_sources() -> tuple[Path, ...]:
    """Return the sources of rollers' code.

    They are files and folders of compiled Python for machines with rollers.
    """
    return (*compiled_sources(), _SOLVER / _ROLLER)


def physics_sources() -> tuple[Path, ...]:
    """Return the folders of the physics.

    They lead from a case to forces and motion.
    """
    return tuple(_SOLVER.parent / room for room in ("domain", "formulas", "elements", "model", "solver"))


@cache
def physics_key() -> str:
    """Return the hash of the physics.

    It is that which this process found first: what is edited later runs in the next process.
    """
    return sources_key(*physics_sources())
