"""Name bodies, degrees of freedom and force elements."""

from __future__ import annotations

from typing import Literal

ALONE = "bearing"  # name of the bearing of a case that has one bearing only
BodyName = Literal["inner_ring", "outer_ring", "cage"]
BODIES: dict[BodyName, str] = {
    "inner_ring": "inner ring with shaft",
    "outer_ring": "outer ring with housing",
    "cage": "cage",
}
TRANSLATIONS = {"x": "axial", "y": "horizontal", "z": "vertical"}
TILTS = {"tilt_y": "rotation about y", "tilt_z": "rotation about z"}
SPIN = "spin"
DOFS = (*TRANSLATIONS, *TILTS, SPIN)
POSE = (*TRANSLATIONS, *TILTS)  # of one ring against another [m, rad]
INNER, OUTER, CAGE = range(len(BODIES))  # places of a bearing's bodies in every table of bodies

# Keys of case files say ball since the first cases, and mean every rolling element.
RACEWAYS = {"ball_inner": "rolling elements and inner raceway", "ball_outer": "rolling elements and outer raceway"}
RIBS = {"rib_inner": "ends of rollers and inner ribs", "rib_outer": "ends of rollers and outer ribs"}
POCKETS = {"ball_cage": "rolling elements and cage pockets"}
NEIGHBOURS = {"ball_ball": "neighbouring rolling elements, where there is no cage"}
LANDS = {"cage_inner": "cage and inner ring's land", "cage_outer": "cage and outer ring's land"}
OIL = {"fluid_drag": "oil on the rolling elements"}
# Force elements of plugins, each under a name of its own in the section [elements] of a case.
LINKS = {"elements": "between two bodies, or a body and the ground"}
# Loads, speeds and motions whose course over time a law gives.
TIMES = {"time": "a load, speed or motion over time"}
# Parts of an electric circuit; no force elements.
FILMS = {"film_inner": "films of the inner raceway", "film_outer": "films of the outer raceway"}
ELEMENTS = RACEWAYS | POCKETS | NEIGHBOURS | LANDS | OIL
