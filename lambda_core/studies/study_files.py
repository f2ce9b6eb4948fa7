"""Offer study files to start from."""

from __future__ import annotations

import re
import tomllib
from functools import cache
from importlib import resources
from pathlib import Path

from lambda_core.case.case_writer import save_text
from lambda_core.domain.errors import CaseError, UsageError, unknown_name
from lambda_core.domain.files import check_new
from lambda_core.studies.definition import parse_study

_USUAL, _OF_MACHINES = "friction-map", "machine-map"


@cache
def example_texts() -> dict[str, str]:
    """Return the included study files by name.

    They come with the program.
    """
    found = (entry for entry in resources.files("lambda_core.studies").joinpath("examples").iterdir())
    texts = {entry.name.removesuffix(".toml"): entry for entry in found if entry.name.endswith(".toml")}
    return {name: texts[name].read_text(encoding="utf-8") for name in sorted(texts)}


def study_examples() -> dict[str, str]:
    """Return the included studies with titles.

    They come with the program; each has its name.

    Returns
    -------
    dict of str to str
        What :func:`init_study` can start from.
    """
    return {name: str(tomllib.loads(text)["title"]) for name, text in example_texts().items()}


def init_study(
    name: str,
    start: str | None = None,
    path: str | Path | None = None,
    overwrite: bool = False,
    *,
    case: str | None = None,
) -> Path:
    """Write a commented study file called `name`.

    It starts from one of those that come with the program.

    Parameters
    ----------
    name : str
        Letters, digits, dot, dash and underscore.
    start : str, optional
        Study to start from, see :func:`study_examples`; default: the one called `name`, else friction-map, or
        machine-map where the case is a machine.
    path : path-like, optional
        Default: NAME.toml in the working directory.
    overwrite : bool
        Replace a file that stands there.
    case : str, optional
        Built-in case, or case file from here or from the folder of the study, to put in; the ranges stay those of the
        example and want a look.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    UsageError
        When the file exists, cannot be written, there is no such case or study to start from, or one of both is of one
        bearing and the other of a machine.
    CaseError
        When `name` cannot be a study's name, or the case is not TOML.
    """
    texts = example_texts()
    target = Path(path) if path is not None else Path(f"{name}.toml")
    of_machine = case is not None and _is_machine(case, target.parent)
    chosen = start or (name if name in texts else _OF_MACHINES if of_machine else _USUAL)
    if chosen not in texts:
        raise UsageError(unknown_name("study to start from", chosen, list(texts)))
    if of_machine and chosen != _OF_MACHINES:
        raise UsageError(f"{chosen} is a study of one bearing, and {case} is a machine: start from {_OF_MACHINES}")
    if case is not None and not of_machine and chosen == _OF_MACHINES:
        raise UsageError(f"{chosen} is a study of machines, and {case} is one bearing: start from {_USUAL}")
    text = re.sub(rf"\b{re.escape(chosen)}\b", name, texts[chosen])
    if case is not None:
        text = re.sub(r"^case = .*$", lambda _: f"case = {_quoted(case)}", text, count=1, flags=re.M)
    try:
        parse_study(text, f'new study "{name}"')
    except CaseError as error:
        raise CaseError(f'new study "{name}"', error.problems) from None
    save_text(text, check_new(target, overwrite))
    return target


def _is_machine(case: str, folder: Path) -> bool:
    """Tell whether a study's case is a machine."""
    from lambda_core.case.case_io import is_machine

    return is_machine(folder / case if (folder / case).is_file() else case)


def _quoted(text: str) -> str:
    """Return a text as TOML."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
