"""List what the literature suite checks: ``python docs/tools/literature.py [--check]``.

The suite in tests/literature is run, and every published or exact value that it compares with is noted with its
source, tolerance and the reason for the tolerance. The list stands in docs/validation.md; ``--check`` writes nothing
and fails when it is stale.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from tables import cell, table

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "validation.md"
BEGIN, END = "<!-- literature:begin -->\n", "<!-- literature:end -->\n"
AT_LEAST = 40


class Recorder:
    """Plugin that notes checked published values.

    Every value of class Published that a passing test checks.
    """

    def __init__(self) -> None:
        self.found: dict[tuple[str, str, str, str], str] = {}
        self._classes: set[type] = set()

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """Put a note-taker in front of the check."""
        for item in session.items:
            published = getattr(getattr(item, "module", None), "Published", None)
            if published is not None and published not in self._classes:
                self._classes.add(published)
                published.check = self._noting(published.check)

    def _noting(self, check: Any) -> Any:
        def noted(value: Any, computed: float) -> None:
            check(value, computed)
            allowed = f"{100.0 * value.rel:g} %" if value.rel else f"{value.abs:g}"
            key = (value.source, f"{value.value:.6g}", allowed, value.reason)
            self.found.setdefault(key, f"{computed:.6g}")

        return noted


def lines() -> list[str]:
    """Run the suite and return the list.

    RuntimeError when a test fails or there are too few values.
    """
    recorder = Recorder()
    folder = str(ROOT / "tests" / "literature")
    code = pytest.main(["-q", "--no-header", "-W", "ignore", folder], [recorder])
    if code != 0:
        raise RuntimeError(f"the literature suite ends with code {code}")
    rows = sorted(recorder.found)
    if len(rows) < AT_LEAST:
        raise RuntimeError(f"the literature suite checks {len(rows)} values, at least {AT_LEAST} are promised")
    sources = {source for source, *_ in rows}
    head = [f"{len(rows)} values of {len(sources)} sources.", ""]
    return head + table(("source", "values (SI)", "tolerance", "reason"), _by_source(rows))


def _by_source(rows: list[tuple[str, str, str, str]]) -> list[list[str]]:
    """Join values of one source.

    They share tolerance and reason; one line, in order of size.
    """
    together: dict[tuple[str, str, str], list[str]] = {}
    for source, value, allowed, reason in rows:
        together.setdefault((source, allowed, reason), []).append(value)
    return [
        [cell(part) for part in (source, ", ".join(sorted(values, key=float)), allowed, reason)]
        for (source, allowed, reason), values in together.items()
    ]


def main(arguments: list[str]) -> int:
    """Renew the list, or say that it is stale."""
    text = PAGE.read_text(encoding="utf-8")
    head, _, rest = text.partition(BEGIN)
    new = f"{head}{BEGIN}\n" + "\n".join(lines()) + f"\n{END}{rest.partition(END)[2]}"
    if "--check" in arguments:
        print("docs/validation.md is stale" if new != text else "docs/validation.md is of today")
        return int(new != text)
    PAGE.write_text(new, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
