"""What a plugin author imports: everything here is stable under ROLE_API 1."""

from lambda_core.registry.chart import Arrows, Axis, Field, Mark, Panel, Series, ViewData
from lambda_core.registry.hookspecs import hookimpl
from lambda_core.registry.method import METHOD_API, Method, MethodInputs, MethodRow, MethodTable, NotApplicable
from lambda_core.registry.model import Context, LazyModel, Material, Model, NoParameters, Oil, default_par, model
from lambda_core.registry.roles import ROLE_API
from lambda_core.registry.scene import Scene
from lambda_core.registry.table import Column, StudyTable
from lambda_core.registry.view import VIEW_API, Options, RunData, View
from lambda_core.schema.units import Quantity

__all__ = [
    "METHOD_API",
    "ROLE_API",
    "VIEW_API",
    "Arrows",
    "Axis",
    "Column",
    "Context",
    "Field",
    "LazyModel",
    "Mark",
    "Material",
    "Method",
    "MethodInputs",
    "MethodRow",
    "MethodTable",
    "Model",
    "NoParameters",
    "NotApplicable",
    "Oil",
    "Options",
    "Panel",
    "Quantity",
    "RunData",
    "Scene",
    "Series",
    "StudyTable",
    "View",
    "ViewData",
    "default_par",
    "hookimpl",
    "model",
]
