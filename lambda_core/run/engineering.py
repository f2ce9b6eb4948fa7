"""Life, safety and catalogue friction of a quasi-static solution: the numbers an engineer asks for first."""

from __future__ import annotations

import math
from collections.abc import Mapping

from lambda_core.formulas.life import contamination_range
from lambda_core.results.rating import Rating
from lambda_core.results.verdict import limits_of
from lambda_core.run.compare_methods import comparison_inputs
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
    "schaeffler_torque_Nmm": ("schaeffler", "friction", "total"),
}


def rating_of(found: Equilibrium, methods: Mapping[str, Method]) -> Rating:
    """Ask the installed methods of life and catalogue friction about an equilibrium.

    Parameters
    ----------
    methods : mapping
        Installed comparison methods by name; numbers of one that is not there are None.
    """
    asked = [methods[name] for name in dict.fromkeys(row[0] for row in _ROWS.values()) if name in methods]
    model = found.context.model
    lower, _ = contamination_range("normal cleanliness", model.geometry.pitch_diameter)
    contamination = lower if model.contamination is None else model.contamination
    answers = evaluate_methods(asked, comparison_inputs(found, contamination=contamination, stiffness=False))
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
