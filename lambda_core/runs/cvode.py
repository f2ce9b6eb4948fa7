"""Integrate the same equations with SUNDIALS CVODE.

Right-hand side and Jacobian are those that our own BDF works on, compiled; steps, orders, error control, Newton
iteration and linear algebra are CVODE's (Hindmarsh et al. 2005, ACM Trans. Math. Softw. 31, 363). Needs the extra
``sundials``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.dynamics import MotionStart
from lambda_core.solver.drivers.equilibrium import fault_sentence
from lambda_core.solver.drivers.right_hand_side import Handle

ENERGY = 1e-2  # [J], angle [rad] or displacement times time [m s]: scale of the integrals, times the tolerance
_STEPS = 10_000_000  # at most, between two outputs


@dataclass(frozen=True)
class CvodeRun:
    """A trajectory and what CVODE did for it.

    Attributes
    ----------
    times : float64[:], shape (n,)
        Output times [s].
    states : float64[:, :], shape (n, size)
        State vectors (layout in lambda_core.solver.layout).
    integrals : float64[:, :], shape (n, powers)
        Running integrals from the first time on, integrated along with the states.
    evaluations, jacobians : int
        Calls of the right-hand side and of the Jacobian.
    """

    times: FloatArray
    states: FloatArray
    integrals: FloatArray
    evaluations: int
    jacobians: int

    def dissipated(self) -> FloatArray:
        """Return the dissipated energy of friction [J].

        It counts from the first time; the array has shape (n,).
        """
        lost: FloatArray = self.integrals[:, : self.integrals.shape[1] - L.NOT_LOST].sum(axis=1)
        return lost


def integrate(
    begin: MotionStart,
    times: FloatArray,
    tolerance: float,
    *,
    max_order: int = 2,
    own_jacobian: bool = False,
) -> CvodeRun:
    """Integrate a bearing or machine with CVODE's BDF.

    The integration starts from the equilibrium.

    Parameters
    ----------
    begin : MotionStart
        Where the run starts. The workspaces of its context are used: not for two runs at once.
    times : float64[:], shape (n,)
        Output times, increasing; the first is 0 [s].
    tolerance : float
        Multiplies the absolute scales of the states, as `solver.tolerance` does.
    max_order : int
        Highest order of the BDF; beyond 2 lightly damped contacts sit in its unstable wedge.
    own_jacobian : bool
        Let CVODE difference the right-hand side for itself instead of giving it ours.

    Raises
    ------
    UsageError
        When scikit-sundae is not installed.
    SolverError
        When a kernel refuses, or CVODE gives up.
    """
    try:
        from sksundae.cvode import CVODE
    except ImportError:
        raise UsageError('CVODE comes with the extra "sundials": pip install "lambda-bearing[sundials]"') from None
    context = begin.context
    handle, size = Handle(context), context.size

    def right_hand_side(t: float, y: FloatArray, out: FloatArray) -> int:
        return 0 if handle.slope_and_rates(t, y, out) == 1 else 1  # 1: CVODE tries a shorter step

    def jacobian(t: float, y: FloatArray, _: FloatArray, out: FloatArray) -> int:
        # Nothing depends on the integrals, and Newton's method needs no slopes of theirs to find them.
        return 0 if handle.jacobian(t, y, out) == 1 else 1

    powers = L.power_count(context.bundle)
    solver = CVODE(
        right_hand_side,
        method="BDF",
        rtol=0.0,  # errors are controlled on absolute scales, as in our integrator
        atol=tolerance * np.concatenate([context.scale, np.full(powers, ENERGY)]),
        max_order=max_order,
        max_step=begin.longest_step,
        max_num_steps=_STEPS,
        **({} if own_jacobian else {"jacfn": jacobian}),
    )
    found = solver.solve(times, np.concatenate([begin.state, np.zeros(powers)]))
    if not found.success:
        fault = context.bundle.scratch[0].fault.role >= 0
        reason = fault_sentence(context, float(found.t[-1])) if fault else found.message
        raise SolverError(f"CVODE gave up at t = {found.t[-1]:.6g} s: {reason}")
    return CvodeRun(found.t, found.y[:, :size], found.y[:, size:], int(found.nfev), int(found.njev))
