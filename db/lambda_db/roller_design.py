"""Define the table of roller bearings.

It holds boundary dimensions, ratings and inner geometry of one row of rollers.
"""

from __future__ import annotations

from sqlalchemy.orm import Mapped, mapped_column

from lambda_core.elements.roller.roller_bearing import RIBS
from lambda_db.constraints import GRADES, STATUSES, check, named, one_of, positive
from lambda_db.models import STRICT, Base, Key

_RATIO = "(roller_diameter_mm / pitch_diameter_mm)"


class RollerDesign(Base):
    """Roller bearing of one maker.

    It holds dimensions, ratings and inner geometry.
    """

    __tablename__ = "roller_design"
    __table_args__ = (
        *named("designation", "maker", "catalogue_source", "geometry_source"),
        one_of("kind", tuple(RIBS)),
        *positive("bore_diameter_mm", "width_mm", "dynamic_rating_kN", "static_rating_kN", "fatigue_limit_kN"),
        *positive("limiting_speed_rpm"),
        *positive("roller_diameter_mm", "effective_length_mm", "rib_height_mm", "profile_scale", "profile_length_mm"),
        check(
            "outside_over_bore",
            "outside_diameter_mm > bore_diameter_mm",
            "outside_diameter_mm must be larger than bore_diameter_mm",
        ),
        check("enough_rollers", "roller_count >= 3", "roller_count must be at least 3"),
        check(
            "length_of_contact",
            "effective_length_mm <= roller_length_mm",
            "effective_length_mm must be at most roller_length_mm",
        ),
        check(
            "rollers_fit_on_pitch_circle",
            f"roller_count * ({_RATIO} + {_RATIO} * {_RATIO} * {_RATIO} / 6.0) <= 3.141592653589793",
            "too many rollers: side by side they are longer than the pitch circle",
        ),
        check(
            "rollers_between_bore_and_outside",
            "pitch_diameter_mm - roller_diameter_mm > bore_diameter_mm"
            " AND pitch_diameter_mm + roller_diameter_mm < outside_diameter_mm",
            "the rollers on their pitch circle must lie between bore and outside diameter",
        ),
        check(
            "angle_of_tapered",
            "(kind = 'tapered') = (contact_angle_deg IS NOT NULL) AND coalesce(contact_angle_deg, 10) BETWEEN 1 AND 45",
            "contact_angle_deg, 1 to 45, belongs to tapered rollers, and they need it",
        ),
        check(
            "rib_of_cylindrical",
            "(kind = 'tapered') = (rib_height_mm IS NULL)",
            "rib_height_mm belongs to cylindrical and needle rollers, and they need it",
        ),
        check(
            "profile_complete",
            "(profile_scale IS NULL) = (profile_length_mm IS NULL)",
            "profile_scale and profile_length_mm go together",
        ),
        one_of("catalogue_grade", GRADES),
        one_of("geometry_grade", GRADES),
        one_of("geometry_status", STATUSES),
        STRICT,
    )

    designation: Mapped[Key]
    maker: Mapped[Key]
    series: Mapped[str] = mapped_column(server_default="")
    kind: Mapped[str]
    bore_diameter_mm: Mapped[float]
    outside_diameter_mm: Mapped[float]
    width_mm: Mapped[float]
    dynamic_rating_kN: Mapped[float]
    static_rating_kN: Mapped[float]
    fatigue_limit_kN: Mapped[float | None]
    limiting_speed_rpm: Mapped[float | None]
    catalogue_source: Mapped[str]
    catalogue_grade: Mapped[str]
    roller_count: Mapped[int]
    roller_diameter_mm: Mapped[float]
    roller_length_mm: Mapped[float]
    effective_length_mm: Mapped[float]
    pitch_diameter_mm: Mapped[float]
    contact_angle_deg: Mapped[float | None]
    rib_height_mm: Mapped[float | None]
    profile_scale: Mapped[float | None]  # of the logarithmic profile, over the roller's diameter
    profile_length_mm: Mapped[float | None]
    geometry_source: Mapped[str]
    geometry_grade: Mapped[str]
    geometry_status: Mapped[str]
    layer: Mapped[str] = mapped_column(server_default="core")
