"""Answer questions about a machine at its operating point."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import UsageError
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
    source : str, Path, mapping, MachineCase or MachineModel
        File, plain tables as they stand in one, a case, or what :func:`check` returned.
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
        For the case of one bearing, which has no shaft that could whirl.
    CaseError, SolverError
        With a sentence about the case, or about why there is no equilibrium.
    """
    from lambda_core.analysis.rotor.machine_point import MachinePoint
    from lambda_core.analysis.thermal.temperatures import ready_machine_of
    from lambda_core.case.case_io import is_machine

    if not is_machine(source):
        raise UsageError(
            "modes need a shaft, and this case has one bearing without a shaft: "
            "lambda-bearing init NAME --from FILE --as-machine writes it on a shaft"
        )
    return MachinePoint(ready_machine_of(source, overrides, announce), announce).modes  # type: ignore[arg-type]
