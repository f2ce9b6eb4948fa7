"""Hold contact values constant between samples."""

from __future__ import annotations

import math

from lambda_core.analysis.electric.compiled.array_types import helper, shared_helper
from lambda_core.analysis.electric.compiled.patches import NO_PATCH


@helper
def _between(table, i, x, out):
    """Write an interpolated row of a sample table.

    It is linear between samples i and i + 1.
    """
    for j in range(out.shape[0]):
        for ring in range(2):
            out[j, ring] = (1.0 - x) * table[i, j, ring] + x * table[i + 1, j, ring]


@helper
def _closed(film, i, out):
    """Remove films that exist at one end only.

    Half a film would break down at once.
    """
    for j in range(out.shape[0]):
        for ring in range(2):
            if film[i, j, ring] <= 0.0 or film[i + 1, j, ring] <= 0.0:
                out[j, ring] = 0.0


@shared_helper
def hold(i, part, substeps, t, tables, held, known):
    """Write the contacts of one part of the interval.

    The interval follows sample i.
    """
    middle = (part + 0.5) / substeps
    _between(tables.capacitance, i, middle, held.capacitance)
    _between(tables.conductance, i, middle, held.conductance)
    _between(tables.film, i, middle, held.film)
    _closed(tables.film, i, held.film)
    _between(tables.thinnest, i, middle, held.thinnest)
    _between(tables.area, i, middle, held.area)
    _between(tables.rolled, i, part / substeps, held.rolled)
    for j in range(held.rate.shape[0]):
        for ring in range(2):
            held.rate[j, ring] = (tables.rolled[i + 1, j, ring] - tables.rolled[i, j, ring]) / (t[i + 1] - t[i])
    known[:, :] = NO_PATCH


@helper
def longest(held):
    """Return a step within one patch of every contact [s].

    No contact that may break down rolls over more than one patch.
    """
    fastest = 0.0
    for j in range(held.film.shape[0]):
        for ring in range(2):
            if held.film[j, ring] > 0.0:
                fastest = max(fastest, abs(held.rate[j, ring]))
    return 1.0 / fastest if fastest > 0.0 else math.inf
