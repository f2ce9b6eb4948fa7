"""Time searches in the catalogue while a user types."""

from __future__ import annotations

import os
import statistics
import tempfile
import time
from pathlib import Path

from benchmarks.tables import Cell, Section, Table
from benchmarks.timing import Effort

QUERIES = ("6", "62", "620", "6208", "6208 s", "40", "62 40", "d=40 C>30", "skf series=618", "width 18", "x")
USER_ROWS = 2000


def _times(catalogue: object, repeats: int) -> dict[str, float]:
    """Return the median seconds per query."""
    found = {}
    for text in QUERIES:
        seconds = []
        for _ in range(repeats):
            started = time.perf_counter()
            catalogue.bearings(text)  # type: ignore[attr-defined]
            seconds.append(time.perf_counter() - started)
        found[text] = statistics.median(seconds)
    return found


def search_benchmark(repeats: int = 20) -> dict[str, float]:
    """Time searches.

    Returns
    -------
    dict of str to float
        ``open_s`` (opening a built catalogue), ``search_ms_worst`` and ``search_ms_median`` over the queries with the
        built-in rows, and ``search_ms_worst_own_rows`` with 2000 rows of the user's own in front of them.
    """
    from lambda_db.catalogue import open_catalogue
    from lambda_db.transfer import import_rows

    with tempfile.TemporaryDirectory() as folder:
        before = {name: os.environ.get(name) for name in ("LAMBDA_BEARING_CACHE", "LAMBDA_BEARING_DATA")}
        os.environ.update(LAMBDA_BEARING_CACHE=f"{folder}/cache", LAMBDA_BEARING_DATA=f"{folder}/data")
        try:
            open_catalogue().close()
            started = time.perf_counter()
            catalogue = open_catalogue()
            opened = time.perf_counter() - started
            built_in = _times(catalogue, repeats)
            common = {"maker": "bench", "width_mm": 18, "dimensions_source": "benchmark", "dimensions_grade": "C"}
            rows = (
                (
                    Path("bench"),
                    str(i),
                    "bearing",
                    {"designation": f"B{i}", "bore_diameter_mm": 10 + i % 90, "outside_diameter_mm": 120, **common},
                )
                for i in range(USER_ROWS)
            )
            import_rows(catalogue, rows)
            own = _times(catalogue, repeats)
            catalogue.close()
        finally:
            for name, value in before.items():
                if value is None:
                    os.environ.pop(name, None)
                else:
                    os.environ[name] = value
    return {
        "open_s": opened,
        "search_ms_median": 1e3 * statistics.median(built_in.values()),
        "search_ms_worst": 1e3 * max(built_in.values()),
        "search_ms_worst_own_rows": 1e3 * max(own.values()),
    }


def measure(effort: Effort) -> Section:
    """Time searches in the catalogue."""
    found = search_benchmark(effort.pick(5, 20))
    rows: tuple[tuple[Cell, ...], ...] = (
        ("opening the built catalogue", 1e3 * found["open_s"]),
        ("a search, median", found["search_ms_median"]),
        ("a search, slowest", found["search_ms_worst"]),
        (f"a search, slowest, with {USER_ROWS} user rows", found["search_ms_worst_own_rows"]),
    )
    return Section("catalogue", (Table("Catalogue", ("what", "ms"), rows),))
