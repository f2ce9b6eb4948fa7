"""Test that every built-in law has a literature test."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from lambda_core.discovery.manager import registry
from lambda_core.domain.installed import OWN
from lambda_core.domain.roles import ROLES

FOLDER = Path(__file__).parent
CONTACT, LUBRICANT, FRICTION = "test_models_contact", "test_models_lubricant", "test_models_friction"
LOSSES, CAPACITANCE, SURFACE = "test_models_losses", "test_models_capacitance", "test_models_surface"
CLOSED, MIXED = "test_models_closed_form", "test_models_mixed_friction"
SUPPLY, FILMS = "test_models_supply", "test_models_films"
ROLLING = "test_models_rolling"
SQUEEZED = "test_squeezed_films"
LINES = "test_models_lines"
BLOW, NOTHING = (CLOSED, "test_a_blow_against_a_guide_lasts_half_a_period"), (CLOSED, "test_none_is_nothing")

# role/name of every law: (module, test) that calls it.
CHECKED: dict[str, tuple[str, str]] = {
    "normal_contact/hamrock-brewe": (CONTACT, "test_error_of_the_hamrock_brewe_fit_is_the_stated_one"),
    "normal_contact/hertz-exact": (CONTACT, "test_exact_hertz_meets_the_table_of_dimensionless_numbers"),
    "normal_contact/iso-line": (LINES, "test_two_raceways_in_series_are_iso_16281"),
    "normal_contact/hertz-line": (LINES, "test_the_logarithm_is_lundbergs"),
    "film_thickness/moes-line": (LINES, "test_films_of_lines"),
    "film_thickness/dowson-toyoda": (LINES, "test_films_of_lines"),
    "rolling_resistance/biboulet-houpert-line": (
        LINES,
        "test_rolling_resistance_of_a_light_line_is_dowson_and_higginsons",
    ),
    "elastic_hysteresis/johnson-line": (LINES, "test_hysteresis_is_the_work_on_the_front_half"),
    "damping/squeeze-line": (LINES, "test_squeezed_film_of_a_cylinder"),
    "capacitance/line-gap": (LINES, "test_capacitance_of_the_gap"),
    "damping/cubic": (CLOSED, "test_cubic_damping"),
    "damping/hunt-crossley": (CLOSED, "test_a_blow_rebounds_as_hunt_and_crossley_say"),
    "damping/squeeze-film": (SQUEEZED, "raceway_force"),
    "damping/none": NOTHING,
    "rheology/vogel-dicke": (LUBRICANT, "test_fva3_viscosity"),
    "rheology/bode": (LUBRICANT, "test_bode_viscosity"),
    "rheology/roelands": (LUBRICANT, "test_roelands_meets_its_pole_pressure_and_viscosity"),
    "rheology/barus-limited": (LUBRICANT, "test_generic_oil_passes_its_two_points"),
    "supply/constant": (SUPPLY, "test_half_the_film_costs_rolling_resistance_too"),
    "supply/oil-layer": (SUPPLY, "test_film_of_a_layer"),
    "supply/side-flow": (SUPPLY, "test_decay_on_a_measured_track"),
    "supply/inlet-distance": (SUPPLY, "test_film_of_a_near_inlet"),
    "supply/skf-replenishment": (SUPPLY, "test_replenishment_of_the_6319"),
    "film_thickness/chittenden": (CONTACT, "test_film_of_the_6208"),
    "film_thickness/hamrock-dowson": (CONTACT, "test_film_of_the_6208"),
    "thermal_correction/murch-wilson": (CONTACT, "test_murch_wilson_closed_form"),
    "thermal_correction/zhu-cheng": (CLOSED, "test_zhu_and_chengs_factor"),
    "thermal_correction/none": (CLOSED, "test_no_thermal_correction_leaves_the_film"),
    "contact_temperature/shear-heating": (FRICTION, "test_flash_temperature_of_a_band_source"),
    "contact_temperature/isothermal": (CLOSED, "test_isothermal_film_has_the_inlets_temperature"),
    "traction/ree-eyring": (FRICTION, "test_mean_shear_stress_of_a_typical_traction_curve"),
    "traction/bair-winer": (CLOSED, "test_bair_and_winers_flow_curve"),
    "traction/newtonian": (CLOSED, "test_newtonian_film_is_couette_flow"),
    "rolling_resistance/biboulet-houpert": (FRICTION, "test_rolling_torque_of_the_6319"),
    "rolling_resistance/goksem-hargreaves": (FRICTION, "test_rolling_torque_of_the_6319"),
    "rolling_resistance/biboulet-houpert-point": (ROLLING, "test_point_contacts_end_in_houperts_forms"),
    "rolling_resistance/matsuyama": (ROLLING, "test_matsuyamas_fit"),
    "rolling_resistance/zhou-hoeprich": (ROLLING, "test_zhou_and_hoeprichs_solved_contacts"),
    "rolling_resistance/aihara": (ROLLING, "test_aiharas_moment"),
    "rolling_resistance/matsuyama-line": (LINES, "test_rolling_resistance_of_a_line_by_published_fits"),
    "rolling_resistance/zhou-hoeprich-line": (LINES, "test_rolling_resistance_of_a_line_by_published_fits"),
    "rolling_resistance/aihara-line": (LINES, "test_rolling_resistance_of_a_line_by_published_fits"),
    "rolling_resistance/none": NOTHING,
    "elastic_hysteresis/loss-factor": (FRICTION, "test_loss_factor_is_the_work_on_the_front_half_of_the_contact"),
    "elastic_hysteresis/houpert": (FRICTION, "test_houpert_corresponds_to_published_loss_factors"),
    "elastic_hysteresis/scheuermann": (CLOSED, "test_scheuermanns_power"),
    "elastic_hysteresis/none": NOTHING,
    "asperity_load/zhou-hoeprich": (FRICTION, "test_load_share_of_the_sister_model"),
    "asperity_load/none": NOTHING,
    "boundary_friction/micro-slip": (MIXED, "test_carters_creep_curve"),
    "asperity_load/spikes-olver": (MIXED, "test_transition_of_spikes_and_olver"),
    "boundary_friction/cubic": (CLOSED, "test_teutschs_cubic_coefficient"),
    "boundary_friction/coulomb-regularised": (CLOSED, "test_regularised_coulomb_friction"),
    "mixing/load-share": (MIXED, "test_friction_by_shares_of_the_load"),
    "mixing/contact-area": (MIXED, "test_real_area_of_plates_of_steel"),
    "contact_state/none": NOTHING,
    "cage_contact/spherical-pocket": BLOW,
    "cage_contact/cylindrical-pocket": BLOW,
    "cage_contact/land-guidance": BLOW,
    "cage_contact/ball-ball": BLOW,
    "cage_contact/roller-pocket": (LINES, "test_bars_and_ends_of_a_pocket"),
    "cage_contact/roller-roller": (LINES, "test_two_rollers_push_rub_and_squeeze"),
    "cage_contact/none": NOTHING,
    "fluid_drag/skf-catalogue": (LOSSES, "test_skf_drag_of_the_6319"),
    "fluid_drag/schaeffler-catalogue": (LOSSES, "test_schaeffler_idle_torque_of_the_6319"),
    "fluid_drag/skf-rollers": (LINES, "test_drag_of_rollers_is_that_of_the_catalogue"),
    "fluid_drag/sphere-drag": (LOSSES, "test_standard_drag_curve"),
    "fluid_drag/cavity-mixture": (LOSSES, "test_standard_drag_curve_in_a_mixture"),
    "fluid_drag/none": NOTHING,
    "force_element/bushing": (CLOSED, "test_bushing_is_hooke_and_newton_along_each_axis"),
    "time_function/chirp": (CLOSED, "test_zeros_of_a_chirp"),
    "permittivity/bode": (LUBRICANT, "test_bode_permittivity"),
    "permittivity/constant": (CLOSED, "test_constant_permittivity_is_what_was_given"),
    "capacitance/schneider": (CAPACITANCE, "test_schneider_factor"),
    "capacitance/constant-factor": (CAPACITANCE, "test_constant_factor"),
    "capacitance/gap-integral": (CAPACITANCE, "test_capacitance_of_two_spheres_without_contact_pressure"),
    "surface/none": NOTHING,
    "surface/waviness": (SURFACE, "test_waves_as_many_as_balls_move_the_ring_along_its_axis"),
    "surface/defect": (SURFACE, "test_a_ball_drops_into_a_gap_as_far_as_a_circle_on_two_edges"),
    "breakdown/field": (FILMS, "test_field_of_a_smooth_film"),
    "breakdown/statistical": (FILMS, "test_statistics_of_the_lowest_spot"),
    "breakdown/particles": (FILMS, "test_particles_bridge_the_film_as_often_as_poisson_says"),
    "discharge/resistance": (FILMS, "test_arcs_after_ohm"),
    "discharge/arc-voltage": (FILMS, "test_arcs_after_ohm"),
}


def test_every_built_in_law_is_on_the_list() -> None:
    laws = {
        f"{role}/{name}"
        for role in ROLES
        for name in registry().names(role)
        if registry().origin(role, name).split(" ")[0] == OWN
    }
    assert set(CHECKED) == laws


@pytest.mark.parametrize("label", CHECKED)
def test_the_test_exists_and_names_the_law(label: str) -> None:
    """Find role and name of each law in its test.

    Tables and helpers of the module count.
    """
    module, test = CHECKED[label]
    text = (FOLDER / f"{module}.py").read_text(encoding="utf-8")
    defined = {name: node for node in ast.parse(text).body for name in _names(node)}
    assert test in defined, f"{module} has no {test}"
    used, said = [test], ""
    for name in used:
        node = defined[name]
        said += ast.get_source_segment(text, node) or ""
        said += "".join(ast.get_source_segment(text, each) or "" for each in getattr(node, "decorator_list", []))
        used += [
            each.id
            for each in ast.walk(node)
            if isinstance(each, ast.Name) and each.id in defined and each.id not in used
        ]
    role, name = label.split("/")
    assert role in said
    assert name in said


def _names(node: ast.stmt) -> list[str]:
    """Return the names that a statement of a module defines."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        return [node.name]
    targets = node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []
    return [target.id for target in targets if isinstance(target, ast.Name)]
