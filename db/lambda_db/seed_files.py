"""Read seed folders of CSV and TOML files.

One CSV per table, or TOML files with arrays of tables of the same names and columns.
"""

from __future__ import annotations

import csv
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path

from lambda_core.domain.errors import CatalogueError, Problem, unknown_name
from lambda_core.domain.printable import from_cell
from lambda_db.built import seed_files
from lambda_db.seed_tables import SEED_TABLES

Cells = Mapping[str, object]
# (file, place in the file, table, cells)
Record = tuple[Path, str, str, Cells]


def read_csv(path: Path, table: str | None = None) -> Iterator[Record]:
    """Yield the rows of a CSV file.

    The table is the file's name unless given.
    """
    table = table or path.stem
    if table not in SEED_TABLES:
        raise CatalogueError(str(path), [Problem("", unknown_name("catalogue table", table, SEED_TABLES))])
    try:
        with path.open(newline="", encoding="utf-8-sig") as stream:
            reader = csv.DictReader(stream)
            header = list(reader.fieldnames or ())
            if not header or len(set(header)) < len(header):
                reason = "names a column twice" if header else "is missing: the first line names the columns"
                raise CatalogueError(str(path), [Problem("header", reason)])
            for cells in reader:
                place = f"line {reader.line_num}"
                if None in cells or None in cells.values():
                    raise CatalogueError(str(path), [Problem(place, f"needs {len(header)} cells like the header")])
                yield path, place, table, {name: from_cell(text) for name, text in cells.items()}
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise CatalogueError(str(path), [Problem("", f"cannot be read as CSV: {error}")]) from error


def read_toml(path: Path) -> Iterator[Record]:
    """Yield the rows of a TOML file.

    It has arrays of tables: ``[[bearing]]``, ``[[lubricant]]``...
    """
    try:
        document = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise CatalogueError(str(path), [Problem("", f"cannot be read as TOML: {error}")]) from error
    for table, rows in document.items():
        if table not in SEED_TABLES:
            raise CatalogueError(str(path), [Problem(table, unknown_name("catalogue table", table, SEED_TABLES))])
        if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
            raise CatalogueError(str(path), [Problem(table, f"must be an array of tables: [[{table}]]")])
        for number, row in enumerate(rows, start=1):
            yield path, f"[[{table}]] {number}", table, row


def read_path(path: Path, table: str | None = None) -> Iterator[Record]:
    """Yield the rows of a file or folder.

    A folder yields the rows of all its seed files.
    """
    if path.is_dir():
        for file in seed_files(path):
            yield from read_path(file)
    elif path.suffix == ".toml":
        yield from read_toml(path)
    elif path.suffix == ".csv":
        yield from read_csv(path, table)
    else:
        raise CatalogueError(str(path), [Problem("", "must be a .csv file, a .toml file or a folder of them")])
