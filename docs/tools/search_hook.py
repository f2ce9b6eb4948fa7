"""Index options by their path and their words.

The index takes ``bodies.inner_ring.tilt_y`` for one word. Its parts are added when the site has been built.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

_PATH = re.compile(r"[A-Za-z]\w*(?:\.\w+)+|[A-Za-z]+(?:_\w+)+")


def on_post_build(config: Any, **_: Any) -> None:
    """Add the parts of paths to the index.

    Mkdocs calls it after the site has been written.
    """
    index = Path(config["site_dir"]) / "search" / "search_index.json"
    data = json.loads(index.read_text(encoding="utf-8"))
    for entry in data["docs"]:
        words = sorted({part for path in _PATH.findall(entry["text"]) for part in parts(path)})
        entry["text"] = f"{entry['text']} {' '.join(words)}".strip()
    index.write_text(json.dumps(data), encoding="utf-8")


def parts(path: str) -> set[str]:
    """Return the searchable parts of a path.

    Its end, its names and their words.
    """
    names = path.split(".")
    ends = {".".join(names[index:]) for index in range(1, len(names))}
    return ends | set(names) | {word for name in names for word in name.split("_") if len(word) > 1}
