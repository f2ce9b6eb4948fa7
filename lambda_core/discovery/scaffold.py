"""Create a plugin package that passes its tests."""

from __future__ import annotations

import keyword
import re
from importlib.metadata import distributions
from pathlib import Path
from string import Template

from lambda_core.domain.errors import UsageError

_TEMPLATE = Path(__file__).parent / "template"
_NAME = re.compile(r"[a-z][a-z0-9]*(?:-[a-z0-9]+)*")


def new_plugin(name: str, parent: Path) -> list[Path]:
    """Write the sources of a plugin package into ``parent/name``.

    Parameters
    ----------
    name : str
        Of the distribution and of what it brings: lower case, words joined by hyphens.
    parent : pathlib.Path
        Folder in which the package's folder is made.

    Returns
    -------
    list of pathlib.Path
        The files that were written.

    Raises
    ------
    UsageError
        When the name is not of that form, is taken by an installed package, or the folder exists.
    """
    module = name.replace("-", "_")
    if keyword.iskeyword(module):
        raise UsageError(f'"{name}" cannot name a plugin: it is a word of Python; for example "my-{name}"')
    if not _NAME.fullmatch(name):
        raise UsageError(f'"{name}" cannot name a plugin: use lower case and hyphens, for example "my-traction"')
    if any((found.name or "").replace("_", "-").lower() == name for found in distributions()):
        raise UsageError(f'"{name}" is the name of an installed package: choose another')
    if label := _law_called(name):
        raise UsageError(f'"{name}" is the name of the law {label}: choose another, for example "my-{name}"')
    target = parent / name
    if target.exists():
        raise UsageError(f"{target} exists already: choose another name")
    written = []
    try:
        for source in sorted(_TEMPLATE.rglob("*.tmpl")):
            place = Path(*(module if part == "module" else part for part in source.relative_to(_TEMPLATE).parts))
            path = target / place.with_suffix("")
            path.parent.mkdir(parents=True, exist_ok=True)
            text = Template(source.read_text(encoding="utf-8")).substitute(name=name, module=module)
            path.write_text(text, encoding="utf-8")
            written.append(path)
    except OSError as error:
        raise UsageError(f"cannot write {target}: {error.strerror}") from None
    return written


def _law_called(name: str) -> str:
    """Return "role/name" of an installed law.

    It is found by its name; the text is empty where there is none.
    """
    from lambda_core.discovery.manager import registry
    from lambda_core.domain.roles import ROLES

    return next((f"{role}/{name}" for role in ROLES if name in registry().names(role)), "")
