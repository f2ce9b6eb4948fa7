"""Find plugin rows that hide others.

They have the same key in another folder, or a source whose text differs.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from lambda_core.catalogue.protocol import Shadow
from lambda_db.built import BUILT_IN
from lambda_db.records import key_columns
from lambda_db.seed_files import read_path
from lambda_db.seed_tables import CHILDREN

_Key = tuple[str, tuple[str, ...]]  # table and key, case ignored


def shadows(folders: tuple[Path, ...]) -> tuple[Shadow, ...]:
    """Return every row that replaces an earlier one.

    A row of a folder may replace a built-in one, or one of a folder before it.

    Parameters
    ----------
    folders : tuple of pathlib.Path
        Of plugins, in the order in which they are laid over the built-in rows.
    """
    if not folders:
        return ()
    known: dict[_Key, tuple[str, str]] = dict(_built_in())
    found: dict[_Key, Shadow] = {}
    for folder in folders:
        for key, title, written in _rows(folder):
            before = known.get(key)
            if before is not None and before[0] != str(folder) and (key[0] != "source" or before[1] != title):
                found[key] = Shadow(
                    table=key[0], key=written, folder=str(folder), over=before[0], title=title, before=before[1]
                )
            known[key] = (str(folder), title)
    return tuple(found.values())


@lru_cache(maxsize=1)
def _built_in() -> tuple[tuple[_Key, tuple[str, str]], ...]:
    return tuple((key, ("", title)) for key, title, _ in _rows(BUILT_IN))


def _rows(folder: Path) -> Iterator[tuple[_Key, str, tuple[str, ...]]]:
    """Yield the keys and titles of all rows.

    Key, title (of sources) and the key as it is written, of every row or group of rows.
    """
    for _, _, table, cells in read_path(folder):
        columns = CHILDREN[table][2] if table in CHILDREN else tuple(key_columns(table))
        written = tuple(" ".join(str(cells.get(column) or "").split()) for column in columns)
        yield (table, tuple(map(str.casefold, written))), str(cells.get("title") or ""), written
