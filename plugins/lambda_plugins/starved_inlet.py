"""Compute film and rolling resistance of a starved inlet.

One thing links the three: the place of the meniscus. Film and rolling resistance of one contact therefore fall
together, and both are exactly 1 for a flooded contact.
"""

from __future__ import annotations

from lambda_plugins.shapes import at_least, at_most

ROLLING = "Biboulet and Houpert 2010, Proc. IMechE J 224, Part 1, eq. 44"
CHEVALIER = "Chevalier, Lubrecht, Cann, Colin and Dalmaz 1998, J. Tribol. 120, 126"
INLET = "Wolveridge, Baglin and Archard 1971, Proc. IMechE 185, 1159"


def starved_rolling(inlet: float) -> float:
    """Return the starved over the flooded rolling resistance.

    It is F/F* = (S^2 + 162.8 S)/(S^2 + 193.1 S + 1257).

    S is the thickness of the oil at the meniscus over the flooded minimum film. Biboulet and Houpert 2010, Proc. IMechE
    J 224 (Part 1, line contacts, doi 10.1243/13506501JET790), eq. 44: 0 without oil, 1 for endless oil.
    """
    s = at_most(at_least(inlet, 0.0), 1e9)
    factor = (s * s + 162.8 * s) / (s * s + 193.1 * s + 1257.0)
    return 1.0 if inlet > 1e9 else factor


def starved_film(layer: float, gamma: float) -> float:
    """Return the starved over the flooded film.

    It is r/(1 + r^gamma)^(1/gamma), for a layer r times as thick as the flooded film.

    Chevalier et al. 1998: all of a thin layer goes through the contact, of a thick one as much as a flooded film takes.
    """
    if layer > 1.0:
        return float((1.0 + layer**-gamma) ** (-1.0 / gamma))
    return float(layer * (1.0 + at_least(layer, 0.0) ** gamma) ** (-1.0 / gamma))


def meniscus(film: float) -> float:
    """Return the meniscus gap over the flooded film.

    It follows from the film over the flooded one, 0..1.

    Grubin's inlet: outside Hertz's ellipse the gap grows with the power 3/2 of the distance, and whatever the film is,
    Reynolds' equation has to raise the reduced pressure from nothing at the meniscus to the same 1/alpha. Hence
    f^(4/3) = J(T)/J(inf), J(T) = int_0^T t^1.5/(1 + t^1.5)^3 dt, where the gap is f (1 + T^1.5): the starved inlet of
    Wolveridge, Baglin and Archard 1971, Proc. IMechE 185, 1159, for line contacts.

    T^1.5 is 0.78765 f^0.8 for small f and (1.3956/(1 - f))^0.75 near 1, both exact; the polynomial between them is a
    numerical form of the integral, within 0.34 %.
    """
    f = at_least(film, 0.0)
    if f >= 1.0:
        return 1e300
    power, left = f**0.8, (1.0 - f) ** 0.75
    between = 1.0 + 0.78547 * power - 1.47375 * f + 1.31841 * (1.0 - left)
    return float(f * (1.0 + 0.787654 * power / left * between))
