"""Provide the public API for shafts in equilibrium."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from lambda_core.domain.blas_threads import one_blas_thread

if TYPE_CHECKING:
    from lambda_core.shaft.shaft_report import ShaftReport
    from lambda_core.system.machine import Machine
    from lambda_core.system.resolve_machine import Source
    from lambda_core.views.chart import ViewData


@one_blas_thread()
def shaft(
    source: Source | Machine, overrides: Iterable[str] = (), *, announce: Callable[[str], None] | None = None
) -> ShaftReport:
    """Solve a shaft in its bearings: reactions, displacements, lives, deflection, critical speeds.

    Parameters
    ----------
    source : str, Path, mapping, ShaftCase or Machine
        File, plain tables as they stand in one, a case, or what :func:`check_shaft` returned.
    overrides : iterable of str
        Changes ``path=value``.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    ShaftReport
        Numbers in the units of their names.

    Raises
    ------
    CaseError, SolverError
        With a sentence about the case, or about why there is no equilibrium.
    """
    from lambda_core.shaft.shaft_equilibrium import solve_shaft
    from lambda_core.shaft.shaft_report import report_of
    from lambda_core.system.machine import Machine
    from lambda_core.system.resolve_machine import check_shaft

    model = source if isinstance(source, Machine) else check_shaft(source, overrides)
    return report_of(model, solve_shaft(model, announce))


def shaft_pictures(model: Machine, report: ShaftReport) -> list[ViewData]:
    """Return what there is to see of a shaft: itself with deflection and bending moment, its whirl over speed.

    Parameters
    ----------
    model : Machine
        From :func:`check_shaft`.
    report : ShaftReport
        From :func:`shaft`.

    Returns
    -------
    list of ViewData
    """
    from lambda_core.shaft.shaft_charts import pictures

    return pictures(model, report)


def describe_shaft(model: Machine) -> str:
    """Return what a resolved shaft is, in lines for people: bearings, loads, mass, assumptions.

    Parameters
    ----------
    model : Machine
        From :func:`check_shaft`.

    Returns
    -------
    str
    """
    from lambda_core.shaft.shaft_text import model_text

    return model_text(model)


def init_shaft(name: str, path: str | Path | None = None, overwrite: bool = False) -> Path:
    """Write a commented case of a shaft in two bearings with a gear, to start from.

    Parameters
    ----------
    name : str
        Letters, digits, dot, dash and underscore.
    path : path-like, optional
        Default: NAME.toml in the working directory.
    overwrite : bool
        Replace a file that stands there.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    UsageError
        When the file exists or cannot be written.
    CaseError
        When `name` cannot be a case's name.
    """
    import tomllib

    from lambda_core.case.case_writer import save_text
    from lambda_core.case.shaft_io import validate_shaft
    from lambda_core.domain.files import check_new
    from lambda_core.system.machine_templates import geared_shaft

    target = Path(path) if path is not None else Path(f"{name}.toml")
    text = geared_shaft(name)
    validate_shaft(tomllib.loads(text), f'new shaft "{name}"')
    save_text(text, check_new(target, overwrite))
    return target


def is_shaft_file(source: str | Path) -> bool:
    """Tell whether a file holds a shaft in bearings, not one bearing; False where there is no readable file.

    Parameters
    ----------
    source : str or Path
        File, or the name of a built-in case.

    Returns
    -------
    bool
    """
    from lambda_core.case.case_io import is_shaft, shaft_tables
    from lambda_core.domain.errors import LambdaError

    try:
        return is_shaft(shaft_tables(source))
    except LambdaError:
        return False
