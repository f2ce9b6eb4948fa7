"""List the tables of seeds and their dependent rows."""

from __future__ import annotations

from lambda_db.models import (
    Alias,
    Base,
    Bearing,
    Cage,
    Clearance,
    Lubricant,
    LubricantParameter,
    LubricantProperty,
    Material,
    Source,
    Suffix,
)
from lambda_db.roller_design import RollerDesign

# Tables that people bring rows for, in the order in which they are read.
SEED_TABLES: dict[str, type[Base]] = {
    model.__tablename__: model
    for model in (
        Source,
        Alias,
        Bearing,
        RollerDesign,
        Clearance,
        Material,
        Cage,
        Suffix,
        Lubricant,
        LubricantProperty,
        LubricantParameter,
    )
}

# Child table -> (parent table, {parent column: child column}, columns of the group that one layer replaces whole).
CHILDREN: dict[str, tuple[str, dict[str, str], tuple[str, ...]]] = {
    "candidate": ("bearing", {"designation": "designation", "maker": "maker"}, ("designation", "maker")),
    "lubricant_property": ("lubricant", {"name": "lubricant"}, ("lubricant", "name")),
    "lubricant_parameter": ("lubricant", {"name": "lubricant"}, ("lubricant", "role", "model")),
}
# All of them with what is derived from them: what a database of rows has.
VIEWED = (*SEED_TABLES, "candidate")
