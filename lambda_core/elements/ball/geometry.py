"""Describe the inner geometry of a ball bearing."""

from __future__ import annotations

from dataclasses import dataclass

from lambda_core.elements.ball.ball_kind import BallKind
from lambda_core.elements.ball.kinds import kind_of


@dataclass(frozen=True)
class Geometry:
    """Inner geometry of the bearing at operating clearance, SI."""

    ball_count: int
    ball_diameter: float  # [m]
    pitch_diameter: float  # [m]
    race_diameter_inner: float  # at the groove's bottom, after clearance was set [m]
    race_diameter_outer: float  # [m]
    groove_radius_inner: float  # [m]
    groove_radius_outer: float  # [m]
    shoulder_diameter_inner: float  # [m]
    shoulder_diameter_outer: float  # [m]
    clearance: float  # operating radial internal clearance, diametral measure [m]
    bore_diameter: float  # [m]
    outside_diameter: float  # [m]
    width: float  # [m]
    series: str
    contact_angle: float = 0.0  # free one of an angular contact bearing, which ratings go by; 0: radial contact [rad]
    # Contact angle of a ball that touches without clearance while the rings are centred: of four-point contact, which
    # one row has with it, and of the rows of a double row bearing; 0: the grooves of both rings face each other [rad]
    resting_angle: float = 0.0
    rows: int = 1  # of balls; ball_count is that of one row
    row_distance: float = 0.0  # between the planes of the balls' centres [m]
    # Of two rows: "O" back to back, "X" face to face, "spherical" on one sphere of the outer ring, whose raceway
    # diameter is the sphere's
    arrangement: str = ""
    ribs: str = ""  # of rollers: ring and end of every rib that guides them, "inner-x outer+x"

    @property
    def balls(self) -> int:
        """Number of balls of all rows."""
        return self.rows * self.ball_count

    @property
    def kind(self) -> BallKind:
        """Kind of bearing as in the catalogue."""
        return kind_of(vars(self))

    @property
    def rated_rows(self) -> int:
        """Rows by which the standards rate the bearing.

        Each pair of arcs of four-point contact counts as one.
        """
        return self.rows * self.kind.arcs
