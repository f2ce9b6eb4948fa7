"""Hash what is executed of sources.

Docstrings, comments and line breaks are left out: machine code does not depend on them, and whoever improves a sentence
need not compile the solver again. Reading Python takes a quarter of a second for the solver's sources, so what was
found of a text is kept on disk, under the hash of all its bytes.
"""

from __future__ import annotations

import ast
import contextlib
import hashlib
import json
import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

_FORM = 1  # of the table on disk: another for each change of :func:`executed`
_MOST = 2000  # texts in the table
_DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


def executable_key(table: Path, *places: Path) -> str:
    """Return the hash of what is executed.

    Hex, of every ``*.py`` among and below `places`, names included.

    Parameters
    ----------
    table : pathlib.Path
        Folder in which earlier answers are kept; one that cannot be written is only slower.
    """
    path = table / f"executable-{_FORM}-{sys.version_info[0]}.{sys.version_info[1]}.json"
    known, digest, fresh = _read(path), hashlib.sha256(), dict[str, str]()
    for name, data in sources(*places):
        content = hashlib.sha256(data).hexdigest()
        if content not in known:
            known[content] = fresh[content] = executed(data)
        digest.update(f"{name} {known[content]}\n".encode())
    if fresh:
        _write(path, known)
    return digest.hexdigest()


def sources(*places: Path) -> Iterator[tuple[str, bytes]]:
    """Yield every ``*.py`` among and below places.

    Each has its name from the place on, and its bytes.
    """
    for place in places:
        for path in [place] if place.is_file() else sorted(place.rglob("*.py")):
            yield path.relative_to(place.parent).as_posix(), path.read_bytes()


def executed(data: bytes) -> str:
    """Return the hash of a module's code without docstrings.

    What is no Python counts byte by byte.
    """
    try:
        tree = ast.parse(data)
    except (SyntaxError, ValueError):
        return hashlib.sha256(data).hexdigest()
    for node in ast.walk(tree):
        if isinstance(node, _DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            del node.body[0]
    return hashlib.sha256(ast.dump(tree).encode("utf-8", "surrogatepass")).hexdigest()


def _read(path: Path) -> dict[str, str]:
    """Return the table, without what is no hash."""
    try:
        found = json.loads(path.read_bytes())
    except (OSError, ValueError):
        return {}
    pairs = found.items() if isinstance(found, dict) else ()
    return {content: key for content, key in pairs if isinstance(key, str) and len(key) == len(content) == 64}


def _write(path: Path, known: Mapping[str, str]) -> None:
    """Keep the newest entries of a table."""
    made = path.with_name(f"{path.name}.{os.getpid()}")
    with contextlib.suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        made.write_text(json.dumps(dict(list(known.items())[-_MOST:])), encoding="utf-8")
        os.replace(made, path)
