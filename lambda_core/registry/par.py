"""From validated parameters to the array that a kernel reads: `prepare`, run once and checked."""

from __future__ import annotations

from typing import Any

import numpy as np
from pydantic import BaseModel

from lambda_core.registry.faults import PluginError, describe
from lambda_core.registry.model import Context, FloatArray, Model, default_par


def make_par(model: Model, parameters: BaseModel, context: Context) -> FloatArray:
    """Return the `par` of a model's kernel for one run and force element.

    Parameters
    ----------
    model : Model
        The law.
    parameters : pydantic.BaseModel
        Instance of ``model.parameters``, SI.
    context : Context
        Geometry, materials and oil of the force element.

    Returns
    -------
    ndarray of float64, shape (n,)
        Contiguous and finite.

    Raises
    ------
    PluginError
        When ``prepare`` raises or returns anything else; the sentence names model and distribution.
    """
    try:
        made: Any = model.prepare(parameters, context) if model.prepare else default_par(parameters)
    except Exception as error:
        raise PluginError(f"{model.label}: the parameters cannot be prepared: {describe(error)}") from error
    if not isinstance(made, np.ndarray) or made.dtype != np.float64 or made.ndim != 1:
        raise PluginError(f"{model.label}: prepare returns {_kind(made)}; a one-dimensional float64 array is due")
    if not np.isfinite(made).all():
        index = int(np.flatnonzero(~np.isfinite(made))[0])
        raise PluginError(f"{model.label}: prepare returns {made[index]} at index {index}; finite numbers are due")
    return np.array(made, order="C")


def _kind(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype} with {value.ndim} dimensions"
    return f"a {type(value).__name__}"
