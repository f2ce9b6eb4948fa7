"""Resolve the case of one bearing for a run."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from lambda_core.domain.errors import CaseError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from lambda_core.case.case import Case
    from lambda_core.case.case_io import Source
    from lambda_core.catalogue.protocol import Catalogue
    from lambda_core.model.bearing_model import BearingModel


def check_bearing(
    source: Source,
    overrides: Iterable[str] = (),
    *,
    folder: Path | None = None,
    catalogue: Catalogue | None = None,
    is_static: bool = False,
) -> BearingModel:
    """Read and resolve the case of one bearing.

    It works as :func:`lambda_core.api.check`, which takes machines, too.
    """
    from lambda_core.case.case_io import bearing_case
    from lambda_core.case.salvage import InvalidCase

    try:
        return resolve(bearing_case(source, overrides, folder), catalogue, is_static=is_static)
    except InvalidCase as error:
        if error.remainder is None:
            raise
        try:
            resolve(error.remainder, catalogue, is_static=is_static)
        except CaseError as more:
            raise error.joined(more.problems) from None
        raise


def resolve(
    case: Case,
    catalogue: Catalogue | None = None,
    *,
    is_static: bool = False,
    place: Callable[[str], str] = str,
) -> BearingModel:
    """Freeze a case into the model of a run.

    Every value is in SI with its origin.

    Parameters
    ----------
    case : Case
        What the engineer wrote.
    catalogue : Catalogue, optional
        An open catalogue to look things up in; default: one is opened for this call.
    is_static : bool
        Whether only an equilibrium is wanted: a case in which nothing turns then needs no duration.
    place : callable
        Where in the file stands what stands at a path of the case: a machine has several bearings.

    Returns
    -------
    BearingModel
        Immutable: values, laws, assumptions.

    Raises
    ------
    CaseError
        With everything that is unknown, missing, contradictory or impossible.
    """
    from contextlib import closing

    from lambda_core.discovery.api import registry
    from lambda_core.model.resolve import resolve as freeze

    models = registry()
    if catalogue is not None:
        return freeze(case, models, catalogue, is_static=is_static, place=place)
    with closing(models.catalogue()) as opened:
        return freeze(case, models, opened, is_static=is_static, place=place)
