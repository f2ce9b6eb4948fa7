"""Import names of an api module when asked.

It is the ``api.py`` of a package, or of all of them.

Commands start fast: who takes one name does not import what stands behind the others.
"""

from __future__ import annotations

import re
from pathlib import Path


def lazy_names(file: str) -> list[dict[str, str]]:
    """Return the names that a module offers, with their modules.

    They are what the module imports in its blocks ``if TYPE_CHECKING:``, one dict for each block. So the list stands
    once, where type checkers and readers look for it.
    """
    blocks = Path(file).read_text(encoding="utf-8").split("\nif TYPE_CHECKING:")[1:]
    imports = [re.findall(r"^    from (\S+) import (\([^)]*\)|.*)", block, re.MULTILINE) for block in blocks]
    return [{name: room for room, names in block for name in re.findall(r"\w+", names)} for block in imports]
