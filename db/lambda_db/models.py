"""Define the tables with types and constraints.

SQLAlchemy 2, STRICT; a CHECK constraint contains the sentence of its error.

Columns hold the numbers as their source prints them; the unit is the end of the column's name
(:mod:`lambda_db.units`). Keys ignore case. Rows reach each other by natural keys, so that a user's row can
stand in front of a built-in one without renumbering. A `*_source` is a key of `source` or a citation in full.
"""

from __future__ import annotations

from typing import Annotated

from sqlalchemy import Float, Integer, Text
from sqlalchemy.dialects.sqlite import REAL
from sqlalchemy.orm import DeclarativeBase, Mapped, mapped_column

from lambda_db.constraints import check, grade, graded, kinds, named, one_of, positive, positive_names, status, together

Key = Annotated[str, mapped_column(Text(collation="NOCASE"), primary_key=True)]
Rank = Annotated[int, mapped_column(Integer, primary_key=True)]


class Base(DeclarativeBase):
    """Base of every table.

    Python types map to the only type names that a STRICT table accepts.
    """

    type_annotation_map = {str: Text(), float: Float().with_variant(REAL(), "sqlite"), int: Integer()}  # noqa: RUF012


STRICT = {"sqlite_strict": True}


class Source(Base):
    """A citation that rows name by its key."""

    __tablename__ = "source"
    __table_args__ = (*named("key", "title"), STRICT)

    key: Mapped[Key]
    title: Mapped[str]


class Alias(Base):
    """Another spelling of a lubricant, material or cage."""

    __tablename__ = "alias"
    __table_args__ = (one_of("kind", ("lubricant", "material", "cage")), *named("alias", "name"), STRICT)

    kind: Mapped[Key]
    alias: Mapped[Key]
    name: Mapped[str]


_GEOMETRY = ("ball_count", "ball_diameter_mm", "pitch_diameter_mm")
_RACES = ("race_diameter_inner_mm", "race_diameter_outer_mm")
_GROOVES = ("groove_radius_inner_mm", "groove_radius_outer_mm")
_RATIO = "(ball_diameter_mm / pitch_diameter_mm)"
_SHOULDERS = ("shoulder_diameter_inner_mm", "shoulder_diameter_outer_mm")
_CATALOGUE = ("reference_speed_rpm", "limiting_speed_rpm", "mass_kg")


class Bearing(Base):
    """Bearing of one maker.

    It holds dimensions, ratings, speeds, mass and, where known, inner geometry.
    """

    __tablename__ = "bearing"
    __table_args__ = (
        *named("designation", "maker"),
        *positive("bore_diameter_mm", "width_mm", "chamfer_mm", "dynamic_rating_kN", "static_rating_kN"),
        *positive("fatigue_limit_kN", *_CATALOGUE),
        check(
            "outside_over_bore",
            "outside_diameter_mm > bore_diameter_mm",
            "outside_diameter_mm must be larger than bore_diameter_mm",
        ),
        check("chamfer_within_width", "2 * chamfer_mm < width_mm", "two chamfers must fit into width_mm"),
        together("dynamic_rating", ("dynamic_rating_kN",)),
        together("static_rating", ("static_rating_kN", "fatigue_limit_kN")),
        together("catalogue", _CATALOGUE),
        together("geometry", (*_GEOMETRY, *_RACES)),
        together("groove", _GROOVES),
        together("shoulder", _SHOULDERS),
        *kinds(),
        check(
            "design_complete",
            "(ball_count IS NULL) = (ball_diameter_mm IS NULL) AND (ball_count IS NULL) = (pitch_diameter_mm IS NULL)",
            "ball_count, ball_diameter_mm and pitch_diameter_mm go together",
        ),
        check("enough_balls", "ball_count >= 3", "ball_count must be at least 3"),
        *positive("ball_diameter_mm"),
        # asin(x) > x + x^3/6: the balls side by side must not pass the full pitch circle (SQLite may lack asin)
        check(
            "balls_fit_on_pitch_circle",
            f"ball_count * ({_RATIO} + {_RATIO} * {_RATIO} * {_RATIO} / 6.0) <= 3.141592653589793",
            "too many balls: side by side they are longer than the pitch circle",
        ),
        check(
            "balls_between_bore_and_outside",
            "pitch_diameter_mm - ball_diameter_mm > bore_diameter_mm"
            " AND pitch_diameter_mm + ball_diameter_mm < outside_diameter_mm",
            "the balls on their pitch circle must lie between bore and outside diameter",
        ),
        check(
            "races_between_bore_and_outside",
            "race_diameter_inner_mm > bore_diameter_mm AND race_diameter_outer_mm < outside_diameter_mm"
            " AND race_diameter_inner_mm < race_diameter_outer_mm",
            "raceway diameters must satisfy bore < inner race < outer race < outside diameter",
        ),
        check(
            "races_match_balls",
            "abs(race_diameter_outer_mm - race_diameter_inner_mm - 2 * ball_diameter_mm) <= 0.05 * ball_diameter_mm",
            "the gap between the raceways must be two ball diameters within 5 %",
        ),
        check(
            "grooves_wider_than_ball",
            "groove_radius_inner_mm > 0.5 * ball_diameter_mm AND groove_radius_outer_mm > 0.5 * ball_diameter_mm",
            "a groove radius must be larger than the ball's radius",
        ),
        check(
            "shoulders_between_bore_and_outside",
            "shoulder_diameter_inner_mm > bore_diameter_mm AND shoulder_diameter_outer_mm < outside_diameter_mm"
            " AND shoulder_diameter_inner_mm < shoulder_diameter_outer_mm",
            "shoulder diameters must satisfy bore < inner shoulder < outer shoulder < outside diameter",
        ),
        *graded(),
        STRICT,
    )

    designation: Mapped[Key]
    maker: Mapped[Key]
    series: Mapped[str] = mapped_column(server_default="")
    bore_diameter_mm: Mapped[float]
    outside_diameter_mm: Mapped[float]
    width_mm: Mapped[float]
    chamfer_mm: Mapped[float | None]
    dimensions_source: Mapped[str]
    dimensions_grade: Mapped[str]
    dynamic_rating_kN: Mapped[float | None]
    dynamic_rating_source: Mapped[str | None]
    dynamic_rating_grade: Mapped[str | None]
    dynamic_rating_status: Mapped[str | None]
    static_rating_kN: Mapped[float | None]
    fatigue_limit_kN: Mapped[float | None]
    static_rating_source: Mapped[str | None]
    static_rating_grade: Mapped[str | None]
    static_rating_status: Mapped[str | None]
    rating_type: Mapped[str] = mapped_column(server_default="")
    reference_speed_rpm: Mapped[float | None]
    limiting_speed_rpm: Mapped[float | None]
    mass_kg: Mapped[float | None]
    catalogue_source: Mapped[str | None]
    catalogue_grade: Mapped[str | None]
    ball_count: Mapped[int | None]
    ball_diameter_mm: Mapped[float | None]
    pitch_diameter_mm: Mapped[float | None]
    race_diameter_inner_mm: Mapped[float | None]
    race_diameter_outer_mm: Mapped[float | None]
    geometry_source: Mapped[str | None]
    geometry_grade: Mapped[str | None]
    geometry_status: Mapped[str | None]
    groove_radius_inner_mm: Mapped[float | None]
    groove_radius_outer_mm: Mapped[float | None]
    groove_source: Mapped[str | None]
    groove_grade: Mapped[str | None]
    groove_status: Mapped[str | None]
    shoulder_diameter_inner_mm: Mapped[float | None]
    shoulder_diameter_outer_mm: Mapped[float | None]
    shoulder_source: Mapped[str | None]
    shoulder_grade: Mapped[str | None]
    kind: Mapped[str | None]  # none: deep groove
    contact_angle_deg: Mapped[float | None]
    angle_source: Mapped[str | None]
    angle_grade: Mapped[str | None]
    row_distance_mm: Mapped[float | None]
    row_distance_source: Mapped[str | None]
    row_distance_grade: Mapped[str | None]
    row_distance_status: Mapped[str | None]
    layer: Mapped[str] = mapped_column(server_default="core")


class Candidate(Base):
    """Ranked design for an unpublished inner geometry.

    The build writes it; it is never imported.
    """

    __tablename__ = "candidate"
    __table_args__ = (STRICT,)

    designation: Mapped[Key]
    maker: Mapped[Key]
    rank: Mapped[Rank]
    ball_count: Mapped[int]
    ball_diameter_mm: Mapped[float]
    pitch_diameter_mm: Mapped[float]
    score: Mapped[float]
    filling_angle_deg: Mapped[float]
    weight: Mapped[float]


class Clearance(Base):
    """Limits of radial internal clearance.

    They are those of one class over a range of bores.
    """

    __tablename__ = "clearance"
    __table_args__ = (
        *named("clearance_class", "source"),
        check("bore_range", "0 <= bore_over_mm AND bore_over_mm < bore_to_mm", "bore_over_mm must be below bore_to_mm"),
        check(
            "clearance_range",
            "0 <= minimum_um AND minimum_um < maximum_um",
            "clearance limits must satisfy 0 <= minimum_um < maximum_um",
        ),
        grade(),
        STRICT,
    )

    clearance_class: Mapped[Key]
    bore_over_mm: Mapped[float] = mapped_column(primary_key=True)
    bore_to_mm: Mapped[float]
    minimum_um: Mapped[float]
    maximum_um: Mapped[float]
    source: Mapped[str]
    grade: Mapped[str]


_SOLID = ("youngs_modulus_GPa", "density_kg_m3", "thermal_conductivity_W_mK", "specific_heat_J_kgK")


class Material(Base):
    """A material of rings, balls or cages."""

    __tablename__ = "material"
    __table_args__ = (
        *named("name", "source"),
        *positive(*_SOLID, "permittivity"),
        check("poisson_range", "poisson_ratio > 0 AND poisson_ratio < 0.5", "poisson_ratio must lie between 0 and 0.5"),
        grade(),
        STRICT,
    )

    name: Mapped[Key]
    youngs_modulus_GPa: Mapped[float]
    poisson_ratio: Mapped[float]
    density_kg_m3: Mapped[float]
    thermal_conductivity_W_mK: Mapped[float]
    specific_heat_J_kgK: Mapped[float]
    thermal_expansion_1e6_K: Mapped[float]
    permittivity: Mapped[float | None]
    source: Mapped[str]
    grade: Mapped[str]
    note: Mapped[str] = mapped_column(server_default="")


class Cage(Base):
    """A type of cage; lengths relative to the ball's diameter."""

    __tablename__ = "cage"
    __table_args__ = (
        *named("name", "material", "source"),
        one_of("guidance", ("ball", "outer ring", "inner ring")),
        *positive("pocket_clearance_ratio", "land_clearance_ratio", "fill", "radial_ratio", "axial_ratio"),
        check("friction_range", "friction >= 0 AND friction < 1", "friction must lie between 0 and 1"),
        check(
            "land_with_ring_guidance",
            "(guidance = 'ball') = (land_clearance_ratio IS NULL)",
            "land_clearance_ratio belongs to ring guidance, and ring guidance needs it",
        ),
        grade(),
        status(),
        together("temperature", ("maximum_temperature_degC",)),
        STRICT,
    )

    name: Mapped[Key]
    suffix: Mapped[str] = mapped_column(server_default="")
    guidance: Mapped[str]
    material: Mapped[str]
    pocket_clearance_ratio: Mapped[float]
    land_clearance_ratio: Mapped[float | None]
    fill: Mapped[float]
    radial_ratio: Mapped[float]
    axial_ratio: Mapped[float]
    friction: Mapped[float | None]
    source: Mapped[str]
    grade: Mapped[str]
    status: Mapped[str]
    maximum_temperature_degC: Mapped[float | None]
    temperature_source: Mapped[str | None]
    temperature_grade: Mapped[str | None]
    note: Mapped[str] = mapped_column(server_default="")


class Suffix(Base):
    """Suffix of a designation or family of suffixes.

    It also has what a case takes from it.
    """

    __tablename__ = "suffix"
    __table_args__ = (
        *named("written", "meaning"),
        one_of("kind", ("clearance", "cage", "balls", "design", "note")),
        STRICT,
    )

    written: Mapped[Key]
    makers: Mapped[str] = mapped_column(server_default="")
    kind: Mapped[str]
    meaning: Mapped[str]
    value: Mapped[str] = mapped_column(server_default="")
    pattern: Mapped[str] = mapped_column(server_default="")


class Lubricant(Base):
    """A lubricant; its numbers are rows of :class:`LubricantProperty` and :class:`LubricantParameter`."""

    __tablename__ = "lubricant"
    __table_args__ = (*named("name", "base_type", "rheology"), STRICT)

    name: Mapped[Key]
    base_type: Mapped[str]
    rheology: Mapped[str]
    note: Mapped[str] = mapped_column(server_default="")
    layer: Mapped[str] = mapped_column(server_default="core")


class LubricantProperty(Base):
    """General property of a lubricant.

    It is in the unit of its source.
    """

    __tablename__ = "lubricant_property"
    __table_args__ = (
        *named("lubricant", "name", "source"),
        grade(),
        status(),
        *positive_names(),
        check("permittivity_range", "name <> 'permittivity' OR value >= 1", "permittivity must be at least 1"),
        STRICT,
    )

    lubricant: Mapped[Key]
    name: Mapped[Key]
    value: Mapped[float]
    unit: Mapped[str] = mapped_column(server_default="")
    source: Mapped[str]
    grade: Mapped[str]
    status: Mapped[str] = mapped_column(server_default="published")


class LubricantParameter(Base):
    """Parameter of one model for a lubricant.

    A new law brings rows, not a migration.
    """

    __tablename__ = "lubricant_parameter"
    __table_args__ = (
        *named("lubricant", "role", "model", "name", "source"),
        grade(),
        status(),
        *positive_names(),
        check("eps_r_range", "name <> 'eps_r' OR value >= 1", "eps_r must be at least 1"),
        STRICT,
    )

    lubricant: Mapped[Key]
    role: Mapped[Key]
    model: Mapped[Key]
    name: Mapped[Key]
    value: Mapped[float]
    unit: Mapped[str] = mapped_column(server_default="")
    source: Mapped[str]
    grade: Mapped[str]
    status: Mapped[str | None]
