"""Answer questions about a machine at its operating point."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.results.answer import answers

if TYPE_CHECKING:
    from lambda_core.analysis.rotor.machine_modes import MachineModes
    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel


@answers
@one_blas_thread()
def modes(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    *,
    announce: Callable[[str], None] | None = None,
) -> MachineModes:
    """Compute critical speeds, natural frequencies and bearing matrices.

    Parameters
    ----------
    source : str, Path, mapping, case or model
        File, plain tables as they stand in one, a case, or what :func:`check` returned. A single bearing has a rigid
        shaft with the mass of its inner ring.
    overrides : iterable of str
        Changes ``path=value``.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    MachineModes
        Bearings as stiff as at the operating point; damped by them at the speed of the case.

    Raises
    ------
    UsageError
        When there is no such case.
    CaseError, SolverError
        With a sentence about the case, or about why there is no equilibrium.
    """
    from lambda_core.analysis.rotor.machine_point import MachinePoint
    from lambda_core.analysis.thermal.temperatures import ready_machine_of
    from lambda_core.case.case_io import is_machine
    from lambda_core.model.long_form import as_machine

    if not is_machine(source):
        source, overrides = as_machine(source, overrides), ()  # type: ignore[arg-type]
    return MachinePoint(ready_machine_of(source, overrides, announce), announce).modes  # type: ignore[arg-type]
