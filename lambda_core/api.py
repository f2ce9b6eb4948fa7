"""The one door: everything that a face, a script or a plugin may ask of the program.

Heavy libraries are loaded inside the functions that need them.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.errors import CaseError, LambdaError, Problem, UsageError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from lambda_core.physics.describe import CaseReport
    from lambda_core.physics.model import BearingModel
    from lambda_core.schema.case import Case

__all__ = [
    "CaseError",
    "LambdaError",
    "UsageError",
    "builtin_cases",
    "case",
    "check",
    "describe",
    "init_case",
    "problems",
    "resolve",
    "save",
    "schema",
]


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


def init_case(
    name: str, start: str = "6319-cp10-1500", path: str | Path | None = None, overwrite: bool = False
) -> Path:
    """Write a commented case called `name` that starts from another; return its file (default NAME.toml).

    Raises
    ------
    UsageError
        When the file exists, cannot be written, or there is no such case to start from.
    CaseError
        When `name` cannot be a case's name.
    """
    from lambda_core.schema.case_writer import new_case

    return new_case(name, start, Path(path) if path is not None else Path(f"{name}.toml"), overwrite)


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


def check(source: str | Path | Mapping[str, Any] | Case, overrides: Iterable[str] = ()) -> BearingModel:
    """Read and resolve a case without running it.

    Parameters
    ----------
    source : str, Path, mapping or Case
        File, built-in name, plain tables as they stand in a file, or a case.
    overrides : iterable of str
        Changes ``path=value``.

    Returns
    -------
    BearingModel
        With its assumptions and the origin of every value.

    Raises
    ------
    CaseError
        With every mistake at once: those of the file itself and those that only the catalogue, the
        registry and the geometry can show.
    """
    from collections.abc import Mapping

    from lambda_core.schema.case import Case
    from lambda_core.schema.case_io import apply_overrides, validate_case
    from lambda_core.schema.salvage import InvalidCase

    changes = list(overrides)
    try:
        if isinstance(source, Mapping):
            loaded = validate_case(source)
        else:
            loaded = source if isinstance(source, Case) else case(source)
        return resolve(apply_overrides(loaded, changes) if changes else loaded)
    except InvalidCase as error:
        if error.remainder is None:
            raise
        try:
            resolve(error.remainder)
        except CaseError as more:
            raise error.joined(more.problems) from None
        raise


def problems(source: Mapping[str, Any] | Case) -> tuple[Problem, ...]:
    """Return every mistake of a case or of plain tables, none if it is fine; for forms that check while one types."""
    try:
        check(source)
    except CaseError as error:
        return error.problems
    return ()


def describe(model: BearingModel) -> CaseReport:
    """Say what a resolved model is: headline, bodies, models, assumptions, every value with its origin."""
    from lambda_core.physics.describe import describe as report

    return report(model)
