"""Compute life, safety and catalogue friction of an equilibrium."""

from __future__ import annotations

import math
from collections.abc import Mapping

from lambda_core.analysis.rating.compare_methods import comparison_inputs
from lambda_core.model.settings.contamination import known_contamination
from lambda_core.results.rating import Rating
from lambda_core.results.verdict import limits_of
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.views.method import Method, evaluate_methods

# Field of the rating -> method that answers it, group and name of the row.
_ROWS: dict[str, tuple[str, str, str]] = {
    "basic_life_h": ("iso-281", "life", "basic rating life, hours"),
    "reference_life_h": ("iso-ts-16281", "life", "reference rating life, hours"),
    "modified_life_h": ("iso-281", "life", "modified rating life, hours"),
    "modified_reference_life_h": ("iso-ts-16281", "life", "reference modified rating life, hours"),
    "life_factor": ("iso-281", "life", "life modification factor"),
    "equivalent_load_N": ("iso-281", "life", "equivalent load"),
    "static_safety": ("iso-281", "rating", "static safety"),
    "viscosity_ratio": ("iso-281", "life", "viscosity ratio"),
    "skf_torque_Nmm": ("skf", "friction", "total"),
    "skf_torque_without_step_Nmm": ("skf", "friction", "total, continuous"),
    "schaeffler_torque_Nmm": ("schaeffler", "friction", "total"),
}


def rating_of(found: Equilibrium, methods: Mapping[str, Method], loads: tuple[float, float] | None = None) -> Rating:
    """Ask the installed methods about an equilibrium of balls.

    They are the methods of life and catalogue friction.

    Parameters
    ----------
    methods : mapping
        Installed comparison methods by name; numbers of one that is not there are None.
    loads : (float, float), optional
        Sizes of the radial and axial load [N]; default: those of the bearing's case. A bearing of a machine carries
        what the equilibrium of its shaft says.
    """
    asked = [methods[name] for name in dict.fromkeys(row[0] for row in _ROWS.values()) if name in methods]
    model = found.context.model
    contamination = known_contamination(model.contamination, model.geometry.pitch_diameter)
    answers = evaluate_methods(
        asked, comparison_inputs(found, contamination=contamination, stiffness=False, loads=loads)
    )
    rows = {
        (answer.method.name, str(row.group), row.name): row.value
        for answer in answers
        if answer.table is not None
        for row in answer.table.rows
        if math.isfinite(row.value)
    }
    notes = [f"{answer.method.title}: {answer.reason}" for answer in answers if answer.reason]
    return Rating(
        **{name: rows.get(key) for name, key in _ROWS.items()},
        contamination=contamination,
        contamination_given=model.contamination is not None,
        limits=limits_of(model),
        notes=notes,
    )
