"""What a plugin author imports: everything here is stable under ROLE_API 1."""

from lambda_core.registry.hookspecs import hookimpl
from lambda_core.registry.method import METHOD_API, Method, MethodInputs, MethodRow, MethodTable, NotApplicable
from lambda_core.registry.model import Context, LazyModel, Material, Model, NoParameters, Oil, default_par, model
from lambda_core.registry.roles import ROLE_API
from lambda_core.schema.units import Quantity

__all__ = [
    "METHOD_API",
    "ROLE_API",
    "Context",
    "LazyModel",
    "Material",
    "Method",
    "MethodInputs",
    "MethodRow",
    "MethodTable",
    "Model",
    "NoParameters",
    "NotApplicable",
    "Oil",
    "Quantity",
    "default_par",
    "hookimpl",
    "model",
]
