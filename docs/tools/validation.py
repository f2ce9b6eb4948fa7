"""Write the tables of docs/validation.md: ``python docs/tools/validation.py RESULT.json``.

RESULT.json is the output of ``lambda-bearing reproduce all --json``, of one experiment, or of
``lambda-bearing measured compare --json``. The tables between the
marks are renewed; the text is written by hand.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

from lambda_syla2026.session import Chapter, Reproduction, chapters
from tables import cell, table

from lambda_core.export.report.page import Table

PAGE = Path(__file__).parents[1] / "validation.md"
# In full only on the page that reproduce writes.
_PLACES = ["Table 4", "Catalogue", "Fig. 5", "Fig. 7"]
LEFT_OUT = ("blind parameter set", "boundary of altered running")


def summary(found: list[Chapter]) -> list[str]:
    """Return the limits of all experiments as one table."""
    rows = []
    for chapter in found:
        for bar in chapter.bars:
            verdict, _, what = bar.partition(": ")
            if verdict.startswith(("met", "missed")):
                rows.append([chapter.title.partition(":")[0], cell(what), verdict])
    return table(("experiment", "result and limit", "verdict"), rows)


def read(data: dict[str, Any]) -> Reproduction:
    """Return a reproduction, also from the output of one experiment."""
    if "workers" not in data:
        general = {name: data.pop(name) for name in ("files", "effort", "failed")}
        data = {general["effort"][0]["experiment"]: data, **general, "unconverged": {}, "workers": 1}
    return Reproduction.model_validate(data)


def merged(text: str, found: list[Chapter]) -> list[str]:
    """Return the limits with new rows.

    They are those of the experiments found.
    """
    new = summary(found)
    named = {chapter.title.partition(":")[0] for chapter in found}
    old = [line for line in text.splitlines() if line.startswith("| ")][1:]
    kept = [line for line in old if line.split("|")[1].strip() not in named]
    rows = [*kept, *new[2:-1]]
    order = list(dict.fromkeys(_PLACES + [row.split("|")[1].strip() for row in rows]))
    return [*new[:2], *sorted(rows, key=lambda row: order.index(row.split("|")[1].strip()))]


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


def measured(compared: list[dict[str, Any]]) -> list[str]:
    """Return a row for every measured series."""
    rows = []
    for one in compared:
        series, points = one["series"], len(one["points"])
        errors = one["reason"]
        if points:
            largest = max((p["predicted"] / p["measured"] - 1.0 for p in one["points"]), key=abs)
            errors = (
                f"mean {one['mean_error_pct']:+.1f} %, mean size {one['mean_absolute_error_pct']:.1f} %, "
                f"largest {100.0 * largest:+.0f} %"
            )
        inside = "no band" if one["inside"] is None else f"{one['inside']} of {points} inside"
        rows.append([cell(text) for text in (
            series["name"], series["title"], series["source"], series["uncertainty"], errors, inside if points else "-",
        )])  # fmt: skip
    return table(("series", "content", "source", "uncertainty", "error without a fit", "90 % model band"), rows)


def put(text: str, mark: str, lines: list[str]) -> str:
    """Return the page with a part replaced.

    Other lines are between its marks.
    """
    begin, end = f"<!-- {mark}:begin -->\n", f"<!-- {mark}:end -->\n"
    head, _, rest = text.partition(begin)
    return f"{head}{begin}\n" + "\n".join(lines).rstrip() + f"\n\n{end}{rest.partition(end)[2]}"


def main(arguments: list[str]) -> int:
    """Write the parts of the page that the result has."""
    given = json.loads(Path(arguments[0]).read_text(encoding="utf-8"))
    text = PAGE.read_text(encoding="utf-8")
    if "compared" in given:
        PAGE.write_text(put(text, "measured", measured(given["compared"])), encoding="utf-8")
        return 0
    found = chapters(read(given))
    for mark in ("bars", *(c.name for c in found)):
        chapter = [c for c in found if c.name == mark]
        between = text.partition(f"<!-- {mark}:begin -->\n")[2].partition(f"<!-- {mark}:end -->\n")[0]
        text = put(text, mark, part(chapter[0]) if chapter else merged(between, found))
    PAGE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
