"""Cases: reading, editing, checking and writing what an engineer says about a bearing."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.errors import CaseError, Problem, UsageError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from lambda_core.physics.describe import CaseReport
    from lambda_core.physics.model import BearingModel
    from lambda_core.registry.catalogue import Catalogue
    from lambda_core.schema.case import Case
    from lambda_core.schema.draft import Draft


def case(source: str | Path, overrides: Iterable[str] = ()) -> Case:
    """Read a case from a TOML file or by the name of a built-in one.

    Parameters
    ----------
    source : str or Path
        File, or built-in name such as "6319-cp10-1500".
    overrides : iterable of str
        Changes ``path=value``, as ``--set`` takes them.

    Returns
    -------
    Case
        Values in SI; what the file leaves open has its default.

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
    """Return the names of the built-in cases and what each is.

    Returns
    -------
    dict of str to str
    """
    from lambda_core.schema.case_io import builtin_cases

    return builtin_cases()


def save(case: Case, path: str | Path) -> None:
    """Write a case as TOML; comments of the file that stands there are kept.

    Parameters
    ----------
    case : Case
        What to write: options at their default are left out.
    path : path-like
        The file.

    Raises
    ------
    UsageError
        When the file cannot be written; what stood there is untouched.
    """
    from lambda_core.schema.case_writer import save_case

    save_case(case, path)


def init_case(
    name: str,
    start: str | None = None,
    path: str | Path | None = None,
    overwrite: bool = False,
    *,
    bearing: str | None = None,
) -> Path:
    """Write a commented case called `name` that starts from another, or from a bearing of the catalogue.

    Parameters
    ----------
    name : str
        Letters, digits, dot, dash and underscore.
    start : str, optional
        Built-in case or case file to start from; default: 6319-cp10-1500.
    path : path-like, optional
        Default: NAME.toml in the working directory.
    overwrite : bool
        Replace a file that stands there.
    bearing : str, optional
        Instead of `start`: a bearing of the catalogue, "6319", "SKF 6208" or "SKF 6208-2RS1/C3".

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    UsageError
        When the file exists, cannot be written, there is no such case to start from, or both a case and a
        bearing are given.
    CatalogueError
        When the bearing is unknown, or several makers have one of that name.
    CaseError
        When `name` cannot be a case's name.
    """
    from contextlib import closing

    from lambda_core.schema.case_writer import new_case, write_new

    target = Path(path) if path is not None else Path(f"{name}.toml")
    if bearing is None:
        return new_case(name, start or "6319-cp10-1500", target, overwrite)
    if start is not None:
        raise UsageError("a new case starts from a case or from a bearing, not from both")
    from lambda_core.physics.fresh_case import fresh_case
    from lambda_core.registry.designation import designated
    from lambda_core.schema.case_io import parse_case

    with closing(catalogue()) as opened:
        text = fresh_case(name, *designated(opened, bearing))
    return write_new(parse_case(text, f"case {name}"), text, target, overwrite)


def schema() -> dict[str, Any]:
    """Return the JSON schema of a case file.

    Returns
    -------
    dict
        JSON Schema, draft 2020-12.
    """
    from lambda_core.schema.case_io import case_json_schema

    return case_json_schema()


def draft(source: str | Path | None = None) -> Draft:
    """Open a case for editing: a file, a copy of a built-in case, or one that says nothing yet.

    Parameters
    ----------
    source : str or Path, optional
        File or built-in name; None for an empty draft.

    Returns
    -------
    Draft
        Plain tables that may be wrong, with undo.

    Raises
    ------
    UsageError
        When there is no such file or built-in case.
    CaseError
        When the file is not TOML; any other mistake may stand in a draft.
    """
    from lambda_core.schema.draft import new_draft, open_draft

    return new_draft() if source is None else open_draft(source)


def check(
    source: str | Path | Mapping[str, Any] | Case,
    overrides: Iterable[str] = (),
    *,
    folder: Path | None = None,
    catalogue: Catalogue | None = None,
) -> BearingModel:
    """Read and resolve a case without running it.

    Parameters
    ----------
    source : str, Path, mapping or Case
        File, built-in name, plain tables as they stand in a file, or a case.
    overrides : iterable of str
        Changes ``path=value``.
    folder : pathlib.Path, optional
        Where file names in plain tables are looked up; default: the working directory.
    catalogue : Catalogue, optional
        An open catalogue to look things up in; default: one is opened for this call.

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
            loaded = validate_case(source, str(source.get("name", "case")), folder)
        else:
            loaded = source if isinstance(source, Case) else case(source)
        return resolve(apply_overrides(loaded, changes) if changes else loaded, catalogue)
    except InvalidCase as error:
        if error.remainder is None:
            raise
        try:
            resolve(error.remainder, catalogue)
        except CaseError as more:
            raise error.joined(more.problems) from None
        raise


def resolve(case: Case, catalogue: Catalogue | None = None) -> BearingModel:
    """Freeze a case into the model of a run: every value in SI with its origin.

    Parameters
    ----------
    case : Case
        What the engineer wrote.
    catalogue : Catalogue, optional
        An open catalogue to look things up in; default: one is opened for this call.

    Returns
    -------
    BearingModel
        Immutable: values, laws, assumptions.

    Raises
    ------
    CaseError
        With everything that is unknown, missing, contradictory or impossible.
    """
    from contextlib import closing

    from lambda_core.physics.resolve import resolve as freeze
    from lambda_core.registry.manager import registry

    models = registry()
    if catalogue is not None:
        return freeze(case, models, catalogue)
    with closing(models.catalogue()) as opened:
        return freeze(case, models, opened)


def problems(source: Mapping[str, Any] | Case) -> tuple[Problem, ...]:
    """Return every mistake of a case or of plain tables; for forms that check while one types.

    Parameters
    ----------
    source : mapping or Case
        Plain tables as they stand in a file, or a case.

    Returns
    -------
    tuple of Problem
        Place and sentence of each; empty when the case is fine.
    """
    try:
        check(source)
    except CaseError as error:
        return error.problems
    return ()


def describe(model: BearingModel) -> CaseReport:
    """Say what a resolved model is: headline, bodies, models, assumptions, every value with its origin.

    Parameters
    ----------
    model : BearingModel
        From :func:`check` or :func:`resolve`.

    Returns
    -------
    CaseReport
        ``text()`` are the lines for people.
    """
    from lambda_core.physics.describe import describe as report

    return report(model)


def catalogue() -> Catalogue:
    """Open the catalogue of bearings, lubricants, materials and cages.

    Returns
    -------
    Catalogue
        The caller closes it.

    Raises
    ------
    PluginError
        When no installed plugin provides one.
    """
    from lambda_core.registry.manager import registry

    return registry().catalogue()


def model_of(
    source: str | Path | Mapping[str, Any] | Case | BearingModel, overrides: Iterable[str] = ()
) -> BearingModel:
    """Return the resolved model of whatever a function of this package takes as a case."""
    from lambda_core.physics.model import BearingModel

    if not isinstance(source, BearingModel):
        return check(source, overrides)
    if list(overrides):
        raise UsageError("a resolved model takes no overrides: change the case and resolve it")
    return source
