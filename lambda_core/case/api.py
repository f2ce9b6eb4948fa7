"""Read, list, write and declare cases."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

    from lambda_core.case.case import Case
    from lambda_core.case.machine import MachineCase


def case(source: str | Path | Mapping[str, Any], overrides: Iterable[str] = ()) -> Case | MachineCase:
    """Read the case of a bearing or a machine.

    Parameters
    ----------
    source : str, Path or mapping
        File, built-in name such as "6319-cp10-1500", or plain tables as they stand in a file.
    overrides : iterable of str
        Changes ``path=value``, as ``--set`` takes them.

    Returns
    -------
    Case or MachineCase
        Of one bearing, or of a machine. Values in SI; what the file leaves open has its default.

    Raises
    ------
    UsageError
        When there is no such file or name, or an override has no ``=``.
    CaseError
        With every problem of the case.
    """
    from lambda_core.case.case_io import read_case

    return read_case(source, overrides)


def builtin_cases() -> dict[str, str]:
    """Return the built-in cases with a few words each.

    Returns
    -------
    dict of str to str
    """
    from lambda_core.case.builtin import builtin_cases

    return builtin_cases()


def save(case: Case | MachineCase, path: str | Path) -> None:
    """Write a case as TOML and keep the file's comments.

    Parameters
    ----------
    case : Case or MachineCase
        What to write: options at their default are left out.
    path : path-like
        The file.

    Raises
    ------
    UsageError
        When the file cannot be written; what stood there is untouched.
    """
    from lambda_core.case.case_writer import save_case

    save_case(case, path)


def schema() -> dict[str, Any]:
    """Return the JSON schema of case files.

    Returns
    -------
    dict
        JSON Schema, draft 2020-12.
    """
    from pydantic.json_schema import models_json_schema

    from lambda_core.case.case import Case
    from lambda_core.case.machine import MachineCase

    kinds, parts = models_json_schema([(Case, "validation"), (MachineCase, "validation")], title="lambda-bearing case")
    one, several = kinds[Case, "validation"], kinds[MachineCase, "validation"]
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return {**head, "if": {"required": ["bearing"]}, "then": one, "else": several, **parts}
