"""Merge short pieces of a shaft into sections.

An element takes a section of its own however short it is, so a contour that was sampled finely would fill the memory.
Pieces shorter than a fiftieth of their diameter, and of nearly one diameter, are merged up to a twentieth of it. Over
such a length the moment is constant, so compliances in series add, L/(E I) = sum l/(E I) (Timoshenko 1955, Strength of
Materials, chapter 5).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import groupby

from lambda_core.formulas.elastic.sections import RoundSection

SHORT = 0.02  # of the diameter: a piece that is merged with its neighbours
MERGED = 0.05  # of the diameter: longest merged piece
ALIKE = 1.1  # largest over smallest diameter of the parts of a merged piece

Piece = tuple[float, RoundSection]


def merged_sections(sections: Sequence[Piece]) -> list[Piece]:
    """Return the sections of a shaft with short neighbours merged.

    Parameters
    ----------
    sections : sequence of (float, RoundSection)
        Length [m] and section of each, from left to right.

    Returns
    -------
    list of (float, RoundSection)
        The same length in all. A merged piece has the bending compliance of its parts and their mean bore; its mass
        differs from theirs by the square of the differences of their diameters.
    """
    found: list[Piece] = []
    for is_short, run in groupby(sections, key=lambda piece: piece[0] < SHORT * piece[1].outside_diameter):
        pieces = list(run)
        found += [_one(group) for group in _groups(pieces)] if is_short else pieces
    return found


def _groups(pieces: Sequence[Piece]) -> Iterator[list[Piece]]:
    """Yield neighbours that are merged into one piece."""
    group: list[Piece] = []
    for piece in pieces:
        together = [*group, piece]
        diameters = [section.outside_diameter for _, section in together]
        is_long = sum(length for length, _ in together) > MERGED * min(diameters)
        if group and (is_long or max(diameters) > ALIKE * min(diameters)):
            yield group
            group = []
        group.append(piece)
    yield group


def _one(pieces: list[Piece]) -> Piece:
    if len(pieces) == 1:
        return pieces[0]
    length = math.fsum(length for length, _ in pieces)
    bore = math.fsum(part * section.bore for part, section in pieces) / length
    moment = length / math.fsum(part / section.second_moment for part, section in pieces)
    diameter = (64.0 * moment / math.pi + bore**4) ** 0.25
    return length, RoundSection(diameter, bore, pieces[0][1].material)
