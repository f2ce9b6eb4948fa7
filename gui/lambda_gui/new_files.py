"""Write new files into the folder of the case.

These are studies, duty cycles and cases of results.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.domain.errors import LambdaError

if TYPE_CHECKING:
    from textual.screen import Screen


def save_new(screen: Screen[None], text: str, path: str) -> Path | None:
    """Write text into a file that does not stand yet.

    Parameters
    ----------
    screen : Screen
        Which says why nothing was written.
    text : str
        What the file holds.
    path : str
        Where, as a person types it.

    Returns
    -------
    pathlib.Path or None
        The file; None when nothing was written.
    """
    from lambda_core.api import save_text

    target = Path(path).expanduser()
    if target.exists():
        screen.notify(f"{target} exists: choose another name", severity="error")
        return None
    try:
        save_text(text, target)
    except LambdaError as error:
        screen.notify(str(error), severity="error")
        return None
    return target


def save_next_to_case(screen: Screen[None], tables: Mapping[str, Any], text: str | None, command: str) -> None:
    """Write tables into a new TOML file.

    Report the command that takes it.

    Parameters
    ----------
    screen : Screen
        Which says what came of it.
    tables : mapping
        What the file holds.
    text : str or None
        Where; None when the person has thought better of it.
    command : str
        Of the shell, before the name of the file.
    """
    import tomlkit

    if text is None:
        return
    target = save_new(screen, tomlkit.dumps(tables), text)
    if target is not None:
        screen.notify(f"saved {target}; in a shell: {command} {target.name}", timeout=8)
