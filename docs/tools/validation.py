"""Put the numbers of a reproduction into docs/validation.md: ``python docs/tools/validation.py RESULT.json``.

RESULT.json is what ``lambda-bearing reproduce all --json`` prints. Bars and tables between the marks are written anew;
what is said about them is written by hand.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from lambda_syla2026.session import Chapter, Reproduction, chapters
from tables import cell, table

from lambda_core.report.page import Table

PAGE = Path(__file__).parents[1] / "validation.md"
# In full only on the page that reproduce writes.
LEFT_OUT = ("blind parameter set", "boundary of altered running")


def summary(found: list[Chapter]) -> list[str]:
    """Return every bar of every experiment as one table."""
    rows = []
    for chapter in found:
        for bar in chapter.bars:
            verdict, _, what = bar.partition(": ")
            if verdict.startswith(("met", "missed")):
                rows.append([chapter.title.partition(":")[0], cell(what), verdict])
    return table(("experiment", "bar and what was found", "verdict"), rows)


def part(chapter: Chapter) -> list[str]:
    """Return the tables of one experiment with their captions."""
    lines: list[str] = []
    for data in chapter.tables:
        if data.caption not in LEFT_OUT:
            rows = ([cell(text) for text in row] for row in data.rows)
            lines += [f"**{_sentence(data)}**", "", *table(data.head, rows)]
    return lines[:-1]


def _sentence(data: Table) -> str:
    return data.caption[:1].upper() + data.caption[1:]


def main(arguments: list[str]) -> int:
    """Write the parts that the result has."""
    found = chapters(Reproduction.model_validate_json(Path(arguments[0]).read_text(encoding="utf-8")))
    text = PAGE.read_text(encoding="utf-8")
    for mark, lines in {"bars": summary(found), **{c.name: part(c) for c in found}}.items():
        begin, end = f"<!-- {mark}:begin -->\n", f"<!-- {mark}:end -->\n"
        head, _, rest = text.partition(begin)
        text = f"{head}{begin}\n" + "\n".join(lines).rstrip() + f"\n\n{end}{rest.partition(end)[2]}"
    PAGE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
