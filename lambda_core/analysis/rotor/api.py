"""Answer questions about a machine at its operating point."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import UsageError
from lambda_core.results.answer import answers

if TYPE_CHECKING:
    from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium
    from lambda_core.analysis.rotor.machine_modes import MachineModes
    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel


@answers
@one_blas_thread()
def machine_equilibrium(
    source: Source | MachineModel,
    overrides: Iterable[str] = (),
    *,
    band: bool = False,
    announce: Callable[[str], None] | None = None,
) -> MachineEquilibrium:
    """Solve a machine; :func:`lambda_core.api.quasistatic` for a machine of several bearings."""
    from lambda_core.analysis.rotor.machine_equilibrium import equilibrium_of
    from lambda_core.analysis.thermal.temperatures import ready_machine_of
    from lambda_core.solver.drivers.machine_statics import SharedKernels, solve_machine
    from lambda_core.solver.drivers.preload import preloads

    model, kernels = ready_machine_of(source, overrides, announce), SharedKernels(announce)
    state = solve_machine(model, announce, kernels)
    found = equilibrium_of(model, state, preload=preloads(model, kernels))
    if not band:
        return found
    from lambda_core.analysis.band.model_band import bands_or_reason

    return found.with_bands(bands_or_reason(model, state).bearings)


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
    from lambda_core.analysis.rotor.machine_modes import modes_of
    from lambda_core.analysis.thermal.temperatures import ready_machine_of
    from lambda_core.case.case_io import is_machine
    from lambda_core.solver.drivers.machine_statics import solve_machine

    if not is_machine(source):
        raise UsageError(
            "modes need a shaft, and this case has one bearing without a shaft: "
            "lambda-bearing init NAME --template geared-shaft writes a machine to start from"
        )
    model = ready_machine_of(source, overrides, announce)  # type: ignore[arg-type]
    return modes_of(model, solve_machine(model, announce))
