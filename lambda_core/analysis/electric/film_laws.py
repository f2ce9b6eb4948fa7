"""Compile the breakdown laws of films with their parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.laws.check import check_choice
from lambda_core.laws.kernels import CompiledKernel, compile_kernel
from lambda_core.laws.law import Law

if TYPE_CHECKING:
    from lambda_core.laws.context import Context
    from lambda_core.model.bearing_model import ChosenLaw


@dataclass(frozen=True)
class FilmLaw:
    """A law of the role breakdown or discharge.

    Attributes
    ----------
    law : Law
    kernel : CompiledKernel
        Keeps the code alive that compiled code calls.
    par : float64[:, :], shape (2, parameters)
        What the kernel reads, for the inner and the outer ring.
    """

    law: Law
    kernel: CompiledKernel
    par: FloatArray


def film_laws(
    laws: Mapping[str, ChosenLaw], contexts: tuple[Context, Context], announce: Any = None
) -> tuple[FilmLaw, FilmLaw]:
    """Compile the laws of breakdown and discharge.

    They are tried out before compiled code calls them.

    Raises
    ------
    PluginError
        With the first law that does not keep the contract of its role.
    """
    from lambda_core.model.laws.law_context import prepare

    found = []
    for role in ("breakdown", "discharge"):
        chosen = laws[role]
        kernel = compile_kernel(chosen.model, announce)
        parameters = np.ascontiguousarray(np.stack([prepare(chosen, context) for context in contexts]))
        check_choice(chosen.model, parameters[0], kernel)
        found.append(FilmLaw(chosen.model, kernel, parameters))
    return found[0], found[1]
