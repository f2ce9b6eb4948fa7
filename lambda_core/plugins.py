"""Provide the stable names for plugin authors under ROLE_API 3."""

from typing import TYPE_CHECKING

from lambda_core.discovery.api import built_in, hookimpl
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import Channel
from lambda_core.domain.roles import OK, ROLE_API
from lambda_core.domain.units import Quantity
from lambda_core.elements.roller.line_film import dowson_toyoda_film, inlet_heat_rolling, moes_line_film
from lambda_core.elements.roller.roller_drag import bath_drag_terms
from lambda_core.elements.roller.rolling import rolling_force, rolling_regime
from lambda_core.elements.roller.rolling_fits import (
    aihara_rolling_force,
    matsuyama_rolling_force,
    zhou_hoeprich_rolling_force,
)
from lambda_core.formulas.gap_capacitance import VACUUM_PERMITTIVITY, gap_capacitance
from lambda_core.formulas.hertz import hertz_shape
from lambda_core.laws.context import Context, Material, Oil
from lambda_core.laws.law import Law, LazyLaw, law
from lambda_core.laws.parameter import NoParameters, Parameters, parameter
from lambda_core.laws.state import State
from lambda_core.laws.vector_math import asinh, asinh_of, asinh_quotient, exp, log, log1p, power
from lambda_core.views.chart import Arrows, Axis, Field, Mark, Panel, Series, ViewData
from lambda_core.views.method import (
    METHOD_API,
    Method,
    MethodInputs,
    MethodRow,
    MethodTable,
    NotApplicable,
    RollerMethodInputs,
)
from lambda_core.views.observer import EVENT_API, OBSERVER_API, Event, Integral, Number, Observer, Samples
from lambda_core.views.roller_profile import PROFILE_API, RollerProfile, RollerShape
from lambda_core.views.scene import Scene
from lambda_core.views.section import SECTION_API, ReportTable, Section
from lambda_core.views.table import Column, StudyTable
from lambda_core.views.view import VIEW_API, Figure, MachineData, Options, RunData, View

if not TYPE_CHECKING:  # with it, any name would do
    from lambda_core.laws.old_form import __getattr__  # noqa: F401

__all__ = [
    "EVENT_API",
    "METHOD_API",
    "OBSERVER_API",
    "OK",
    "PROFILE_API",
    "ROLE_API",
    "SECTION_API",
    "VACUUM_PERMITTIVITY",
    "VIEW_API",
    "Arrows",
    "Axis",
    "Channel",
    "Column",
    "Context",
    "Event",
    "Field",
    "Figure",
    "FloatArray",
    "Integral",
    "Law",
    "LazyLaw",
    "MachineData",
    "Mark",
    "Material",
    "Method",
    "MethodInputs",
    "MethodRow",
    "MethodTable",
    "NoParameters",
    "NotApplicable",
    "Number",
    "Observer",
    "Oil",
    "Options",
    "Panel",
    "Parameters",
    "Quantity",
    "ReportTable",
    "RollerMethodInputs",
    "RollerProfile",
    "RollerShape",
    "RunData",
    "Samples",
    "Scene",
    "Section",
    "Series",
    "State",
    "StudyTable",
    "View",
    "ViewData",
    "aihara_rolling_force",
    "asinh",
    "asinh_of",
    "asinh_quotient",
    "bath_drag_terms",
    "built_in",
    "dowson_toyoda_film",
    "exp",
    "gap_capacitance",
    "hertz_shape",
    "hookimpl",
    "inlet_heat_rolling",
    "law",
    "log",
    "log1p",
    "matsuyama_rolling_force",
    "moes_line_film",
    "parameter",
    "power",
    "rolling_force",
    "rolling_regime",
    "zhou_hoeprich_rolling_force",
]
