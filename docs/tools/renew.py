"""Renew the generated pages: ``python docs/tools/renew.py``.

Options: ``[--check] [--examples]``.

Without options every generated page, and every generated part of another page, is written anew. ``--check`` writes
nothing and fails when one is stale. ``--examples`` also runs the examples of all pages and puts today's numbers in.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import page_examples as examples
import page_sources
import reference_errors as errors
from gallery import gallery
from reference_api import api_page
from reference_case import case_page
from reference_cli import cli_page
from reference_models import models_page

from lambda_core import api
from lambda_core.discovery.reference import roles_markdown

DOCS = Path(__file__).parents[1]
PAGES: dict[str, Callable[[], str]] = {
    "reference/case.md": case_page,
    "reference/cli.md": cli_page,
    "reference/models.md": models_page,
    "reference/api.md": api_page,
}
# page -> mark -> lines between <!-- mark:begin --> and <!-- mark:end -->
PARTS: dict[str, dict[str, Callable[[], str]]] = {
    "gallery.md": {"gallery": gallery},
    "kernels.md": {"roles": roles_markdown},
    "errors.md": {
        "codes": lambda: "\n".join(errors.exit_codes()),
        "errors": lambda: "\n".join(errors.errors()),
    },
}


def wanted() -> dict[Path, str]:
    """Return every generated page as wanted.

    It is generated in whole or in part.
    """
    found = {DOCS / name: make() for name, make in PAGES.items()}
    for name, parts in PARTS.items():
        text = (DOCS / name).read_text(encoding="utf-8")
        for mark, make in parts.items():
            begin, end = f"<!-- {mark}:begin -->\n", f"<!-- {mark}:end -->\n"
            head, _, rest = text.partition(begin)
            text = f"{head}{begin}\n{make()}\n{end}{rest.partition(end)[2]}"
        found[DOCS / name] = text
    for path in sorted(DOCS.rglob("*.md")):
        text = found.get(path) or path.read_text(encoding="utf-8")
        if page_sources.taken(text):
            found[path] = page_sources.renewed(text)
    return found


def main(arguments: list[str]) -> int:
    """Renew the pages, or say which are stale."""
    stale = []
    for path, text in wanted().items():
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            stale.append(path)
            if "--check" not in arguments:
                path.write_text(text, encoding="utf-8")
    for path in stale:
        print(f"{'stale' if '--check' in arguments else 'written'}: {path.relative_to(DOCS.parent)}")
    if "--examples" in arguments:
        api.warmup()  # no page shows the sentence that announces a compilation
        for path in examples.pages():
            with tempfile.TemporaryDirectory() as folder:
                path.write_text(examples.renewed(path, Path(folder)), encoding="utf-8")
    if stale and "--check" in arguments:
        print("renew them: python docs/tools/renew.py")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
