"""Copy code of the example packages into the pages.

Above a block of code stands ``<!-- from FILE: NAME NAME ... -->``: the block then holds the definitions of these names
in the file, in this order, with their decorators. The file is named from the root of the repository.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
_TAKEN = re.compile(r"^<!-- from (?P<file>\S+): (?P<names>[\w ]+) -->\n```python\n(?P<body>.*?)^```$", re.M | re.S)


def taken(page: str) -> list[tuple[str, tuple[str, ...]]]:
    """Return (file, names) of included blocks.

    The page takes every such block from a file.
    """
    return [(found["file"], tuple(found["names"].split())) for found in _TAKEN.finditer(page)]


def renewed(page: str) -> str:
    """Return a page with included blocks renewed.

    They are as the files are today.

    Raises
    ------
    ValueError
        When a file has no such name.
    """

    def block(found: re.Match[str]) -> str:
        code = definitions((ROOT / found["file"]).read_text(encoding="utf-8"), found["names"].split(), found["file"])
        return f"<!-- from {found['file']}: {found['names']} -->\n```python\n{code}```"

    return _TAKEN.sub(block, page)


def definitions(source: str, names: list[str], file: str) -> str:
    """Return the lines that define the names.

    Of a module; two blank lines around functions and classes.
    """
    lines = source.splitlines()
    known = {name: statement for statement in ast.parse(source).body for name in _defined(statement)}
    text = ""
    before: ast.stmt | None = None
    for name in names:
        if name not in known:
            raise ValueError(f"{file} defines no {name}, which a page shows")
        now = known[name]
        if before is not None:
            text += "" if isinstance(before, ast.Assign) and isinstance(now, ast.Assign) else "\n\n"
        first = min([now.lineno, *(each.lineno for each in getattr(now, "decorator_list", ()))])
        text += "\n".join(lines[first - 1 : now.end_lineno]) + "\n"
        before = now
    return text


def _defined(statement: ast.stmt) -> list[str]:
    if isinstance(statement, ast.FunctionDef | ast.ClassDef):
        return [statement.name]
    if isinstance(statement, ast.Assign):
        return [target.id for target in statement.targets if isinstance(target, ast.Name)]
    return []
