"""Test that every built-in law keeps its role's contract."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import lambda_plugins
import numpy as np
import pytest
from lambda_plugins import lambda_laws

from lambda_core.discovery.manager import registry
from lambda_core.discovery.survey import split_label
from lambda_core.domain.roles import DEFAULT_MODELS, ROLES
from lambda_core.laws.calls import handed_over
from lambda_core.laws.check import check_model, parameters_of
from lambda_core.laws.kernels import compile_kernel
from lambda_core.laws.par import make_par
from lambda_core.laws.probe import draw, trial_context
from lambda_core.plugins import OK
from lambda_core.solver.status import Status

from ..literature.oils import REQUIRED  # noqa: TID252

NAMES = {
    "normal_contact": {"hamrock-brewe", "hertz-exact", "hertz-line", "iso-line"},
    "damping": {"cubic", "hunt-crossley", "squeeze-film", "squeeze-line", "none"},
    "rheology": {"vogel-dicke", "bode", "roelands", "barus-limited"},
    "film_thickness": {"chittenden", "hamrock-dowson", "moes-line", "dowson-toyoda"},
    "thermal_correction": {"murch-wilson", "zhu-cheng", "none"},
    "supply": {"constant", "skf-replenishment", "inlet-distance", "oil-layer", "side-flow"},
    "contact_temperature": {"shear-heating", "isothermal"},
    "traction": {"ree-eyring", "bair-winer", "newtonian"},
    "rolling_resistance": {
        "biboulet-houpert",
        "biboulet-houpert-point",
        "biboulet-houpert-line",
        "goksem-hargreaves",
        "matsuyama",
        "zhou-hoeprich",
        "aihara",
        "matsuyama-line",
        "zhou-hoeprich-line",
        "aihara-line",
        "none",
    },
    "elastic_hysteresis": {"loss-factor", "houpert", "scheuermann", "johnson-line", "none"},
    "asperity_load": {"zhou-hoeprich", "spikes-olver", "none"},
    "boundary_friction": {"micro-slip", "cubic", "coulomb-regularised"},
    "mixing": {"load-share", "contact-area"},
    "contact_state": {"none"},
    "cage_contact": {
        "spherical-pocket",
        "cylindrical-pocket",
        "land-guidance",
        "ball-ball",
        "roller-pocket",
        "roller-roller",
        "none",
    },
    "fluid_drag": {"skf-catalogue", "schaeffler-catalogue", "skf-rollers", "sphere-drag", "cavity-mixture", "none"},
    "force_element": {"bushing"},
    "time_function": {"chirp"},
    "permittivity": {"bode", "constant"},
    "capacitance": {"schneider", "constant-factor", "gap-integral", "line-gap"},
    "surface": {"none", "waviness", "defect"},
    "breakdown": {"statistical", "field", "particles"},
    "discharge": {"resistance", "arc-voltage"},
}
LABELS = [f"{role}/{name}" for role in ROLES for name in sorted(NAMES[role])]


def test_every_role_has_the_agreed_models() -> None:
    found: dict[str, set[str]] = {role: set() for role in ROLES}
    lambda_laws(lambda law: found[law.role].add(law.name))
    assert found == NAMES
    for role, name in DEFAULT_MODELS.items():
        assert name == "auto" or name in NAMES[role]


@pytest.mark.parametrize("label", LABELS)
def test_contract(label: str) -> None:
    law = registry().model(*split_label(label))
    report = check_model(law, REQUIRED.get(label), samples=60)
    assert report.faults == ()
    assert (law.role, law.name) == split_label(label)


@pytest.mark.parametrize("label", LABELS)
def test_says_where_it_comes_from(label: str) -> None:
    law = registry().model(*split_label(label))
    assert law.summary.endswith(".")
    assert law.name == "none" or law.reference
    for name, field in law.parameters.model_fields.items():
        assert field.description, f"{label} {name} has no description"
        extra = field.json_schema_extra
        assert isinstance(extra, dict)
        assert extra["status"] in ("published", "unconfirmed", "assumed", "numerical", "lubricant")
        if extra["status"] in ("published", "unconfirmed", "assumed"):
            assert extra.get("source"), f"{label} {name} has no source"


@pytest.mark.parametrize("label", LABELS)
def test_published_ranges_are_valid_and_hold_the_default(label: str) -> None:
    law = registry().model(*split_label(label))
    required = REQUIRED.get(label, {})
    default = law.parameters.model_validate(required)
    for name, field in law.parameters.model_fields.items():
        extra = field.json_schema_extra
        ends = extra.get("published_range") if isinstance(extra, dict) else None
        if not isinstance(ends, list):
            continue
        low, high = (getattr(law.parameters.model_validate({**required, name: end}), name) for end in ends)
        value = getattr(default, name)
        assert low < high
        assert value is None or low <= value <= high, f"{label} {name}"


def test_naming_the_laws_imports_none_of_them() -> None:
    code = (
        "import sys, lambda_plugins; lambda_plugins.lambda_laws(lambda law: None);"
        "heavy = [m for m in sys.modules if m.split('.')[0] in ('scipy', 'numba') or m == 'lambda_plugins.traction'];"
        "sys.exit(str(heavy) if heavy else 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


# What a bad trial state can make NaN, role by role: the host rejects the step by what it sees in the outputs.
STATE = {
    "normal_contact": ("delta",),
    "damping": ("delta_dot",),  # the law of the load has refused a penetration that is no number
    "rheology": ("p", "T"),
    "film_thickness": ("u_mean", "load"),
    "thermal_correction": ("u_mean",),
    "supply": (),
    "contact_temperature": ("T_in",),
    "traction": ("slip", "ln_eta", "p"),
    "rolling_resistance": ("u_mean", "load"),
    "elastic_hysteresis": ("load",),
    "asperity_load": ("Lambda",),
    "boundary_friction": ("slip",),
    "mixing": ("psi",),
    "contact_state": (),
    "cage_contact": (),
    "fluid_drag": ("v_orbit", "omega_spin"),
    "force_element": ("place", "tilt", "v_rel", "omega_rel"),
    "time_function": (),
    "permittivity": (),
    "capacitance": ("C_hertz",),
    "surface": ("azimuth",),
    "breakdown": (),
    "discharge": (),
}
LAWS = [label for label in LABELS if not label.endswith("/none")]


@pytest.mark.parametrize("label", LAWS)
def test_nan_is_never_swallowed(label: str) -> None:
    law = registry().model(*split_label(label))
    role = ROLES[law.role]
    par = make_par(law, parameters_of(law, REQUIRED.get(label)), trial_context(role.elements[0]))
    dispatcher = compile_kernel(law).dispatcher
    names = [argument.name for argument in role.arguments]
    for name in STATE[law.role]:
        arguments = draw(role, par, 4, np.random.default_rng(7))
        place = names.index(name)
        arguments[place] = arguments[place] * np.nan
        dispatcher(*handed_over(role, arguments))
        outputs = [value for argument, value in zip(role.arguments, arguments, strict=True) if argument.output]
        assert any(np.isnan(value).any() for value in outputs), name


LAW_MODULES = sorted(Path(lambda_plugins.__file__).parent.glob("*.py"))


@pytest.mark.parametrize("path", LAW_MODULES, ids=lambda path: path.stem)
def test_built_in_laws_use_the_door_of_every_plugin(path: Path) -> None:
    nodes = [node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.ImportFrom)]
    imported = {node.module for node in nodes if (node.module or "").startswith("lambda_core")}
    assert imported <= {"lambda_core.plugins"}


def test_the_word_of_kernels_is_the_number_of_the_solver() -> None:
    assert Status.OK == OK
