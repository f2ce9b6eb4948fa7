"""Check that bearings, wheels and shaft fit each other.

The check compares bores with diameters, and widths with the space on the shaft.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from lambda_core.case.machine import MachineBearing, MachineCase
from lambda_core.domain.units import show
from lambda_core.model.machine_model import MountedBearing

Outline = Sequence[tuple[float, float, float, float]]  # begin, end, diameter, bore of each section [m]

# Seats of rings, g6 to r7 of ISO 286 at the most, lie within 0.1 mm of the bore up to 100 mm and within 0.1 % beyond;
# more is no fit but another part, as an adapter sleeve.
_SEAT, _SEAT_SHARE = 1e-4, 1e-3  # [m], of the bore
_UNDERCUT = 0.25  # of the width that a groove or a relief may take from a seat
_TOUCHING = 1e-6  # [m] faces that meet, whatever the rounding of sums


@dataclass(frozen=True)
class _Span:
    """Span of a part on the shaft."""

    name: str
    begin: float
    end: float

    def __str__(self) -> str:
        return f"{self.name} ({_mm(self.begin)} to {_mm(self.end)})"


def fitting_warnings(case: MachineCase, bearings: Sequence[MountedBearing], outline: Outline) -> tuple[str, ...]:
    """Return warnings of parts that do not fit.

    A sentence for everything on a shaft that cannot be where it is drawn.

    Nothing of it changes the equilibrium, which knows bearings by their places alone; so it is no mistake of the case:
    sleeves and equivalent diameters are usual.

    Parameters
    ----------
    case : MachineCase
        With positions in place of markers.
    outline : sequence of (float, float, float, float)
        Begin, end, diameter and bore of each section [m]; empty for a shaft from outside, whose shape nobody knows.
    """
    spans = [_span(bearing) for bearing in bearings]
    found: list[str] = []
    for bearing, span in zip(bearings, spans, strict=True):
        if outline:
            found += _on_seat(bearing, case.bearings[bearing.name], span, outline)
            found += _on_shaft(span, outline[0][0], outline[-1][1])
    found += [
        f"{one} and {other} overlap by {_mm(room)}: two bearings cannot be in one place"
        for one, other in combinations(spans, 2)
        if (room := min(one.end, other.end) - max(one.begin, other.begin)) > _TOUCHING
    ]
    return (*found, *_wheels(case, spans, outline))


def _span(bearing: MountedBearing) -> _Span:
    half = 0.5 * bearing.model.geometry.width
    return _Span(bearing.name, bearing.position - half, bearing.position + half)


def _on_seat(bearing: MountedBearing, given: MachineBearing, span: _Span, outline: Outline) -> Iterator[str]:
    """Compare the bore with the shaft under it.

    The piece of the shaft with the largest difference is named.
    """
    bore, width = bearing.model.geometry.bore_diameter, span.end - span.begin
    fit = max(_SEAT, _SEAT_SHARE * bore)
    under = [
        (min(end, span.end) - max(begin, span.begin), diameter, max(begin, span.begin), min(end, span.end))
        for begin, end, diameter, _ in outline
    ]
    thick = [piece for piece in under if piece[0] > _TOUCHING and piece[1] > bore + fit]
    thin = [piece for piece in under if piece[0] > _TOUCHING and piece[1] < bore - fit]
    if thick:
        _, diameter, begin, end = max(thick, key=lambda piece: piece[1])
        yield (
            f"{span.name}: its bore of {_mm(bore)} does not go over the shaft's diameter of {_mm(diameter)} from "
            f"{_mm(begin)} to {_mm(end)}; computed as if it stood there"
        )
    if sum(piece[0] for piece in thin) > _UNDERCUT * width:
        _, diameter, begin, end = min(thin, key=lambda piece: piece[1])
        yield (
            f"{span.name}: its bore of {_mm(bore)} is {_mm(bore - diameter)} wider than the shaft's diameter of "
            f"{_mm(diameter)} from {_mm(begin)} to {_mm(end)}: only a sleeve holds a ring there; it is taken as rigid"
        )
    if given.fits is not None and given.fits.shaft is not None:
        hollow = next((bore for begin, end, _, bore in outline if begin <= bearing.position <= end), 0.0)
        if abs(hollow - given.fits.shaft_bore) > _TOUCHING:
            yield (
                f"{span.name}: fits.shaft_bore is {_mm(given.fits.shaft_bore)}, but the bore of the shaft there is "
                f"{_mm(hollow)}: the fit is computed with the former"
            )


def _on_shaft(span: _Span, left: float, right: float) -> Iterator[str]:
    for beyond, side in ((left - span.begin, "left"), (span.end - right, "right")):
        if beyond > _TOUCHING:
            yield f"{span} stands out {_mm(beyond)} beyond the {side} end of the shaft, {_mm(right - left)} long"


def _wheels(case: MachineCase, spans: Sequence[_Span], outline: Outline) -> Iterator[str]:
    """Compare gears and discs with bearings and shaft.

    Only the middle of a gear is known; a disc may have a shape.
    """
    for name, gear in case.gears.items():
        for span in spans:
            if span.begin + _TOUCHING < gear.place < span.end - _TOUCHING:
                yield f"the gear {name} at {_mm(gear.place)} stands inside the bearing {span}"
        under = _diameter(outline, gear.place)
        if gear.pitch_diameter < under - _TOUCHING:
            yield (
                f"the pitch diameter of {_mm(gear.pitch_diameter)} of the gear {name} is inside the shaft, whose "
                f"diameter there is {_mm(under)}"
            )
    for name, disc in case.discs.items():
        if disc.width is not None:
            own = _Span(name, disc.place - 0.5 * disc.width, disc.place + 0.5 * disc.width)
            for span in spans:
                if (room := min(own.end, span.end) - max(own.begin, span.begin)) > _TOUCHING:
                    yield f"the disc {own} and the bearing {span} overlap by {_mm(room)}"


def _diameter(outline: Outline, place: float) -> float:
    """Return the diameter of the shaft at a place.

    At a step it is the smaller one; it is 0 where the diameter is not known.
    """
    return min((diameter for begin, end, diameter, _ in outline if begin <= place <= end), default=0.0)


def _mm(length: float) -> str:
    return f"{1e3 * length:.4g} mm" if abs(length) >= 1e-4 else show(length, "length", 3)
