"""Read the cells of a CSV file.

The only reader of measurements, tables over time, voltages and load spectra.

Commas separate cells, or semicolons or tabs where the first line has them. Empty lines, those with
empty cells only, as spreadsheets write them, and those that begin with # are left out.
"""

from __future__ import annotations

import csv
import re

Rows = list[tuple[int, list[str]]]  # number of the line, cells
_LINES = re.compile("\r\n|\r|\n")  # as editors count them: other separators of str.splitlines are text
_LONGEST = 20_000  # characters of a line
Mistakes = list[tuple[int, str]]  # number of the line, what is wrong


def csv_rows(text: str) -> tuple[Rows, Mistakes]:
    """Return the cells of every line.

    Also return the lines that cannot be read.
    """
    rows: Rows = []
    mistakes: Mistakes = []
    delimiter = ""
    for line, content in enumerate(_LINES.split(text.removeprefix("\ufeff")), 1):
        if not content.strip() or content.lstrip().startswith("#"):
            continue
        delimiter = delimiter or next((mark for mark in (";", "\t") if mark in content), ",")
        if content.count('"') % 2:
            where = content.index('"') + 1
            mistakes.append((line, f'has a single quote mark at character {where}: remove the "'))
            continue
        if len(content) > _LONGEST:
            mistakes.append((line, f"has {len(content)} characters: a line has at most {_LONGEST}"))
            continue
        try:
            (cells,) = csv.reader([content], delimiter=delimiter, strict=True)
        except (csv.Error, ValueError) as error:
            mistakes.append((line, f'{error}: remove the " marks, numbers need none'))
            continue
        if any(map(str.strip, cells)):
            rows.append((line, [cell.strip() for cell in cells]))
    return rows, mistakes
