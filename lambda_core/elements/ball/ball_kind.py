"""Define the questions that a kind of ball bearing answers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from lambda_core.elements.kind import BearingKind

if TYPE_CHECKING:
    from lambda_core.elements.ball.geometry import Geometry
    from lambda_core.formulas.kind_clearance import KindClearance
    from lambda_core.formulas.tolerances import Limits


class Angles(NamedTuple):
    """Angles and clearances of a bearing.

    It holds angles [rad], radial clearance as bought, diametral [m], arrangement and distance of two rows [m].
    """

    free: float
    resting: float
    bought: Limits
    arrangement: str = ""
    distance: float = 0.0


@dataclass(frozen=True)
class Given:
    """Given data of a bearing.

    The case and the catalogue give them; the kind of the bearing adds what follows.

    Attributes
    ----------
    bearing : case.parts.Bearing
        The section of the case.
    inline : case.parts.InlineGeometry
        Its geometry, empty where there is none.
    row : catalogue.protocol.BearingRow or None
        Of the catalogue.
    centres : float
        Distance of the groove centres [m].
    bore : float
        [m]
    ledger : model.ledger.Ledger
        Takes numbers, assumptions and problems.
    class_of : callable
        Returns the limits of the clearance class of a table [m], from the table and the path of the clearance; None
        after a problem.
    picked : callable
        Returns the one of some limits that the case takes.
    named_class : str or None
        The clearance of the case where that is a class.
    """

    bearing: Any
    inline: Any
    row: Any
    centres: float
    bore: float
    ledger: Any
    class_of: Callable[[KindClearance, str], Limits | None]
    picked: Callable[[Limits], float]
    named_class: str | None


@dataclass(frozen=True)
class Shoulders:
    """Default heights of shoulders over the raceway.

    They are in ball diameters by ring, and hold where nothing is known of the shoulders.
    """

    heights: Mapping[str, float]
    what: str
    whose: str


def single_groove(_: Geometry, __: int) -> tuple[int, ...]:
    """Return the thrusts of grooves in a row.

    One groove of a ring takes both directions.
    """
    return (0,)


def angle_alone(_: Geometry, free: str) -> str:
    """Return the words of the free contact angle alone."""
    return free


@dataclass(frozen=True)
class BallKind(BearingKind):
    """A kind of ball bearing.

    Attributes
    ----------
    belongs : callable
        Tells from the fields of a Geometry whether a bearing is of this kind; only one kind says so.
    filling : tuple of float
        Angle that the balls of a row span side by side in bearings of the catalogue [deg].
    tilt : float
        Largest angle between the rings [rad].
    tilt_words : str
        What makers say of it.
    written : callable, optional
        Tells from a case's inline geometry whether it writes this kind. None: what no other kind is.
    resolve : callable, optional
        Returns angles and clearance from what is given. None: those of one groove that faces another.
    thrusts : callable
        Returns from geometry and row which thrusts of the shaft the grooves of a ring take, +1, -1, 0 for both.
    rows, arcs : int
        Rows of balls; grooves of each ring for one row.
    arrangement : str
        Usual one of two rows.
    arrangements : tuple of str
        Those that a case may write for this kind.
    on_sphere : bool
        Whether the outer raceway is a sphere about the bearing's centre, which holds no tilt.
    one_sided : bool
        Whether each groove has a shoulder on the loaded side alone.
    walls, width : tuple of float
        Wall of a ring under its groove, and width less the distance of two rows, over the ball diameter.
    shoulders : Shoulders, optional
        None: of deep groove bearings.
    outer_shoulder : callable, optional
        Returns the diameter at which the outer raceway ends, where that follows [m].
    with_clearance : callable, optional
        Returns the geometry for a clearance [m]. None: both raceways take half.
    least_thrust : float
        Axial over radial load from which on the balls run as they should.
    thrust_words : str
        What happens below.
    axial_clearance : str
        An axial clearance that a new case shows; "" where the kind has a radial one.
    words : callable
        Returns what a summary says of it, from the geometry and the words of its free contact angle.
    """

    belongs: Callable[[Mapping[str, Any]], bool]
    filling: tuple[float, float]
    tilt: float
    tilt_words: str
    written: Callable[[Any], bool] | None = None
    resolve: Callable[[Given], Angles | None] | None = None
    thrusts: Callable[[Geometry, int], tuple[int, ...]] = single_groove
    rows: int = 1
    arcs: int = 1
    arrangement: str = ""
    arrangements: tuple[str, ...] = ()
    on_sphere: bool = False
    one_sided: bool = False
    walls: tuple[float, float] = (0.22, 0.61)
    width: tuple[float, float] = (1.20, 2.21)
    shoulders: Shoulders | None = None
    outer_shoulder: Callable[[Geometry], float] | None = None
    with_clearance: Callable[[Geometry, float], Geometry] | None = None
    least_thrust: float = 0.0
    thrust_words: str = ""
    axial_clearance: str = ""
    words: Callable[[Geometry, str], str] = angle_alone

    @property
    def is_radial(self) -> bool:
        """True of one row that takes thrust both ways."""
        return self.rows * self.arcs == 1 and not (self.one_sided or self.on_sphere)

    @property
    def needs_thrust(self) -> bool:
        """True of one row that radial load opens."""
        return self.one_sided and self.rows == 1
