"""Declare the rollers of a case."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Literal

from lambda_core.case.option import Section, option
from lambda_core.domain.units import Angle, Length, SmallLength
from lambda_core.elements.roller.slices import SLICES

# Options that each profile of the program takes; the others are refused.
PROFILE_OPTIONS: Mapping[str, tuple[str, ...]] = MappingProxyType({
    "iso": (),
    "logarithmic": ("profile_scale", "profile_length"),
    "crowned": ("profile_radius",),
    "two-radii": ("profile_length", "profile_radius", "profile_middle_radius"),
    "tabulated": ("profile_points",),
    "none": (),
})  # fmt: skip

# What a roller bearing takes of [bearing.geometry]; the rest describes balls.
SHARED_GEOMETRY = ("bore_diameter", "outside_diameter", "width", "dynamic_rating", "static_rating")


class InlineRollers(Section):
    """Inner geometry of a roller bearing.

    With a designation it replaces single catalogue values.
    """

    kind: Literal["NU", "NJ", "NUP", "N", "NCF", "needle", "tapered"] | None = option(
        None,
        "which ribs guide the rollers: NU, N, NJ, NUP with a cage, NCF full complement, needle or tapered rollers",
        reference="ISO 5593; SKF, Rolling bearings, 2018",
    )
    roller_count: int | None = option(None, "number of rollers Z", ge=3, le=200)
    roller_diameter: Length | None = option(None, "mean roller diameter D_we", gt=0.0)
    roller_length: Length | None = option(None, "length of a roller", gt=0.0)
    effective_length: Length | None = option(None, "length of the raceway contacts L_we", gt=0.0)
    pitch_diameter: Length | None = option(None, "pitch diameter D_pw at the middle of the rollers", gt=0.0)
    contact_angle: Angle | None = option(None, "angle of the outer raceway of tapered rollers", gt=0.0, le=0.7853981634)
    rib_height: Length | None = option(None, "height of the ribs of cylindrical rollers above the raceway", gt=0.0)
    contact_height: Length | None = option(
        None,
        "tapered: height of the rib contact above the inner raceway's line; absent: a sixth of the large end",
        gt=0.0,
    )
    end_radius: Length | None = option(
        None, "radius of the end faces; absent: 0.9 of the distance to the apex of tapered rollers", gt=0.0
    )
    end_play: SmallLength = option(
        "50 um", "axial play of a roller between two ribs", reference="0.02 to 0.1 mm are usual", ge=0.0
    )
    rib_roughness: SmallLength = option(
        "0.24 um",
        "composite rms roughness of roller ends and ribs",
        reference="Wingertszahn et al. 2023, Lubricants 11, 369",
        gt=0.0,
    )
    profile: Literal["iso", "logarithmic", "crowned", "two-radii", "tabulated", "none"] | str | None = option(
        None,
        'profile of the rollers: "iso" (ISO 16281), "logarithmic", "crowned", "two-radii", "tabulated" (by the options '
        "below), \"none\" or a plugin's; absent: the catalogue's, else iso",
    )
    profile_scale: float | None = option(
        None, "scale of the logarithmic profile over the roller diameter", gt=0.0, lt=0.01, reference="Teutsch 2005"
    )
    profile_length: Length | None = option(
        None, "length of the logarithmic profile; of two-radii: length of the middle", gt=0.0
    )
    profile_radius: Length | None = option(None, "radius of the crown; of two-radii: of both ends", gt=0.0)
    profile_middle_radius: Length | None = option(None, "of two-radii: radius of the middle; absent: straight", gt=0.0)
    profile_points: list[tuple[Length, SmallLength]] | None = option(
        None, 'of tabulated: distance from the middle and drop, [["0 mm", "0 um"], ["5.5 mm", "8 um"]]'
    )
    profile_parameters: dict[str, Any] | None = option(None, "parameters of a plugin's profile")
    slices: int = option(
        SLICES,
        "laminae of a contact at an operating point; in motion 32",
        ge=30,
        le=200,
        reference="ISO 16281 asks for 30 and more",
    )
