"""Define the catalogue that the core expects.

Every value has its source and grade.

The store behind it (SQLite, in ``lambda_db``) is plugged in through the hook
``lambda_catalogue``; the core never imports it.
"""

from __future__ import annotations

from typing import Literal, Protocol, runtime_checkable

from pydantic import BaseModel, ConfigDict

from lambda_core.catalogue.suffixes import Suffix
from lambda_core.domain.value_status import RowStatus
from lambda_core.elements.ball.kinds import kinds


class Frozen(BaseModel):
    """Base of catalogue rows: immutable, no unknown fields."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)


class Value(Frozen):
    """One number with its source.

    `value` is in SI units.
    """

    value: float
    source: str
    grade: str  # A published and cross-read, B good, C weak, D not to be used
    status: RowStatus = "published"


class Parameter(Frozen):
    """Parameter of a lubricant for one model.

    It is in the unit it was published in.
    """

    value: float
    unit: str  # "" for a plain number
    source: str
    grade: str
    status: RowStatus | None = None  # None: its source tells

    def text(self) -> str | float:
        """Return what a case file would say for this parameter."""
        return f"{self.value!r} {self.unit}" if self.unit else self.value


class Design(Frozen):
    """Candidate for an unpublished inner geometry (SI)."""

    ball_count: int
    ball_diameter: float  # [m]
    pitch_diameter: float  # [m]
    score: float  # weighted sum of squared residuals, smaller is better
    filling_angle: float  # [rad]
    weight: float  # relative likelihood among the ranked candidates, 0..1


class BearingRow(Frozen):
    """A ball bearing: boundary dimensions, ratings and inner geometry (SI)."""

    designation: str
    maker: str
    series: str
    bore_diameter: Value
    outside_diameter: Value
    width: Value
    chamfer: Value | None = None
    dynamic_rating: Value | None = None  # C [N]
    static_rating: Value | None = None  # C0 [N]
    fatigue_limit: Value | None = None  # Cu [N]
    rating_type: str = ""
    kind: str = "deep groove"  # "angular contact", "four-point", "double row", "self-aligning"
    reference_speed: Value | None = None  # [rad/s]
    limiting_speed: Value | None = None  # [rad/s]
    mass: Value | None = None  # [kg]
    ball_count: Value | None = None
    ball_diameter: Value | None = None
    pitch_diameter: Value | None = None
    race_diameter_inner: Value | None = None  # at the groove's bottom
    race_diameter_outer: Value | None = None
    groove_radius_inner: Value | None = None
    groove_radius_outer: Value | None = None
    shoulder_diameter_inner: Value | None = None
    shoulder_diameter_outer: Value | None = None
    contact_angle: Value | None = None  # free one, of every kind but deep groove [rad]
    row_distance: Value | None = None  # between the planes of the balls of double row angular contact [m]
    candidates: tuple[Design, ...] = ()
    layer: Literal["core", "plugin", "user"] = "core"

    @property
    def needs_thrust(self) -> bool:
        """True where radial load alone opens the bearing."""
        return kinds()[self.kind].needs_thrust


class RollerRow(Frozen):
    """Roller bearing of one row.

    It holds boundary dimensions, ratings and inner geometry (SI).
    """

    designation: str
    maker: str
    series: str
    kind: str  # "NU", "NJ", "NUP", "N", "NCF", "needle", "tapered"
    bore_diameter: Value
    outside_diameter: Value
    width: Value
    dynamic_rating: Value  # C [N]
    static_rating: Value  # C0 [N]
    fatigue_limit: Value | None = None  # Cu [N]
    limiting_speed: Value | None = None  # [rad/s]
    roller_count: Value
    roller_diameter: Value  # mean
    roller_length: Value
    effective_length: Value  # of the contacts
    pitch_diameter: Value  # at the rollers' middle
    contact_angle: Value | None = None  # of the outer raceway of tapered bearings [rad]
    rib_height: Value | None = None  # of cylindrical rollers
    profile_scale: Value | None = None  # of a logarithmic profile, over the roller's diameter
    profile_length: Value | None = None
    layer: Literal["core", "plugin", "user"] = "core"


class ClearanceRow(Frozen):
    """Limits of radial internal clearance, SI.

    They are those of one class for one bore (ISO 5753-1).
    """

    clearance_class: str
    minimum: float  # [m]
    maximum: float  # [m]
    source: str
    grade: str


class MaterialRow(Frozen):
    """A ring, ball or cage material (SI)."""

    name: str
    youngs_modulus: Value
    poisson_ratio: Value
    density: Value
    thermal_conductivity: Value
    specific_heat: Value
    thermal_expansion: Value
    permittivity: Value | None = None
    note: str = ""


class CageRow(Frozen):
    """Cage type in SI.

    It holds guidance, clearances and the constants of its mass formula.
    """

    name: str
    suffix: str
    guidance: str  # "ball", "outer ring", "inner ring"
    material: str  # name of a MaterialRow
    pocket_clearance_ratio: Value  # diametral, over ball diameter
    land_clearance_ratio: Value | None = None  # diametral, over ball diameter
    # Ring-shaped body: mass = density * fill * pi * pitch * (radial * D_w) * (axial * D_w)
    fill: Value
    radial_ratio: Value  # radial thickness over ball diameter
    axial_ratio: Value  # width over ball diameter
    friction: Value | None = None
    maximum_temperature: Value | None = None
    note: str = ""


class LubricantRow(Frozen):
    """Lubricant with properties and model parameters.

    General properties (SI) and the parameters of every model that knows it.
    """

    name: str
    base_type: str
    rheology: str  # the model that "auto" stands for
    properties: dict[str, Value]  # density_15, kinematic_viscosity_40, thermal_conductivity, ...
    parameters: dict[str, dict[str, dict[str, Parameter]]]  # role -> model -> name -> parameter
    note: str = ""
    layer: Literal["core", "plugin", "user"] = "core"


class Shadow(Frozen):
    """Row of a plugin that replaces another one.

    It may also be the key of a source.
    """

    table: str  # "lubricant_parameter"
    key: tuple[str, ...]  # of the row, or of the group of rows that is replaced at once
    folder: str  # where the row in front lies
    over: str  # where the one behind lies, "" for the built-in rows
    title: str = ""  # of a source: what it stands for now
    before: str = ""  # of a source: what it stood for


@runtime_checkable
class Catalogue(Protocol):
    """Look-ups that the core needs.

    An unknown name raises CatalogueError with the nearest ones.
    """

    def bearing(self, designation: str, maker: str | None = None) -> BearingRow:
        """Return one bearing.

        Several makers and none given is an error that lists them.
        """

    def bearings(self, text: str = "", limit: int = 50) -> list[BearingRow]:
        """Return the bearings that match `text`.

        The text may be a designation, bore, series or maker; the best come first.
        """

    def rollers(self) -> list[RollerRow]:
        """Return every roller bearing, by designation and maker."""

    def lubricant(self, name: str) -> LubricantRow:
        """Return one lubricant by name or alias."""

    def lubricants(self, text: str = "", limit: int = 50) -> list[LubricantRow]:
        """Return the lubricants that match `text`."""

    def material(self, name: str) -> MaterialRow:
        """Return one material."""

    def cage(self, name: str) -> CageRow:
        """Return one cage type."""

    def clearance(self, bore_diameter: float, clearance_class: str) -> ClearanceRow:
        """Return the limits for bore [m] and class.

        A class is for example "CN".
        """

    def suffixes(self) -> tuple[Suffix, ...]:
        """Return every suffix that may stand behind a designation."""

    def names(self, kind: Literal["bearing", "lubricant", "material", "cage", "clearance_class"]) -> list[str]:
        """Return every valid name of one kind."""

    def shadows(self) -> tuple[Shadow, ...]:
        """Return the plugin rows that replace others."""

    def close(self) -> None:
        """Release the files behind the catalogue."""
