"""The one door: everything that a face, a script or a plugin may ask of the program.

Heavy libraries are loaded inside the functions that need them.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.errors import CaseError, LambdaError, UsageError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from lambda_core.physics.model import BearingModel
    from lambda_core.schema.case import Case

__all__ = ["CaseError", "LambdaError", "UsageError", "builtin_cases", "case", "check", "resolve", "save", "schema"]


def case(source: str | Path, overrides: Iterable[str] = ()) -> Case:
    """Read a case from a TOML file or by the name of a built-in one.

    Parameters
    ----------
    source : str or Path
        File, or built-in name such as "6319-cp10-1500".
    overrides : iterable of str
        Changes ``path=value``, as ``--set`` takes them.

    Raises
    ------
    UsageError
        When there is no such file or name, or an override has no ``=``.
    CaseError
        With every problem of the case.
    """
    from lambda_core.schema.case_io import apply_overrides, load_case

    loaded, changes = load_case(source), list(overrides)
    return apply_overrides(loaded, changes) if changes else loaded


def builtin_cases() -> dict[str, str]:
    """Return the names of the built-in cases and what each is."""
    from lambda_core.schema.case_io import builtin_cases

    return builtin_cases()


def save(case: Case, path: str | Path) -> None:
    """Write a case as TOML; comments of the file that stands there are kept."""
    from lambda_core.schema.case_writer import save_case

    save_case(case, path)


def schema() -> dict[str, Any]:
    """Return the JSON schema of a case file."""
    from lambda_core.schema.case_io import case_json_schema

    return case_json_schema()


def resolve(case: Case) -> BearingModel:
    """Freeze a case into the model of a run: every value in SI with its origin.

    Raises
    ------
    CaseError
        With everything that is unknown, missing, contradictory or impossible.
    """
    from contextlib import closing

    from lambda_core.physics.resolve import resolve as freeze
    from lambda_core.registry.manager import registry

    models = registry()
    with closing(models.catalogue()) as catalogue:
        return freeze(case, models, catalogue)


def check(source: str | Path | Case, overrides: Iterable[str] = ()) -> BearingModel:
    """Read and resolve a case without running it: the model with its assumptions, or every error."""
    from lambda_core.schema.case import Case

    loaded = source if isinstance(source, Case) else case(source, overrides)
    return resolve(loaded)
