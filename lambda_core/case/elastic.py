"""Declare the section elastic."""

from __future__ import annotations

from lambda_core.case.option import Section, option
from lambda_core.domain.units import Length, Stiffness
from lambda_core.formulas.elastic.ring import MOST_ORDERS


class BendingRing(Section):
    """Ring that bends in its plane.

    It bends as waves round it, in a housing or on a shaft of a given stiffness.
    """

    housing_stiffness: Stiffness = option(
        description="radial stiffness of what the ring lies in: force over the displacement of the undeformed ring, "
        "pi R k of a bedding with k per length; 0 N/m: a ring that nothing backs",
        ge=0.0,
    )
    orders: int = option(6, "highest wave number round the ring in the model; an ellipse has 2", ge=2, le=MOST_ORDERS)
    damping_ratio: float = option(
        0.02,
        "damping of every wave, over critical",
        ge=0.0,
        lt=1.0,
        reference="an assumption: welded steel below half of its yield point has 2 to 3 % (Newmark and Hall 1982, "
        "Earthquake Spectra and Design)",
    )
    section_height: Length | None = option(
        None, "radial height of the ring's section; absent: from its seat to the raceway", gt=0.0
    )
    section_width: Length | None = option(None, "axial width of the section; absent: the bearing's", gt=0.0)


class BendingCage(Section):
    """Cage that bends in its plane.

    It bends as waves round it, pushed by balls or rollers and guiding lands.
    """

    orders: int = option(4, "highest wave number round the cage in the model; an ellipse has 2", ge=2, le=MOST_ORDERS)
    damping_ratio: float = option(
        0.02,
        "damping of every wave, over critical",
        ge=0.0,
        lt=1.0,
        reference="an assumption: below half of its yield point welded steel has 2 to 3 %, riveted steel 5 to 7 % "
        "(Newmark and Hall 1982, Earthquake Spectra and Design)",
    )
    section_height: Length | None = option(
        None, "radial height of the cage's section; absent: the cage's radial thickness", gt=0.0
    )
    section_width: Length | None = option(
        None,
        "axial width of the section that bends; absent: the width of a ring without pockets that has the cage's mass",
        gt=0.0,
    )


class Elastic(Section):
    """Elastic parts of the bearing.

    Absent ones are rigid.
    """

    inner_ring: BendingRing | None = option(None, "the inner ring bends; absent: it is rigid")
    outer_ring: BendingRing | None = option(None, "the outer ring bends; absent: it is rigid")
    cage: BendingCage | None = option(None, "the cage bends; absent: it is rigid")
