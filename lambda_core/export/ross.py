"""Convert a shaft in bearings to a rotor of ROSS.

ROSS has z along the shaft: its x is our y, its y our z, its z our x; rotations likewise. Its bearing elements know
radial and axial forces alone; moments and what couples them to forces are added to the rotor's matrices.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.analysis.rotor.vibration import bearing_damping, housed_damping, housed_stiffness
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.domain.errors import UsageError
from lambda_core.formulas.elastic.beam import NODE, NODES
from lambda_core.formulas.elastic.body import ElasticBody
from lambda_core.model.machine_model import GROUND, SHAFT, MachineModel
from lambda_core.solver.drivers.compiled_laws import Announce
from lambda_core.solver.drivers.machine_statics import solve_machine

if TYPE_CHECKING:
    from lambda_core.solver.drivers.machine_statics import MachineState

# Ours: x, y, z, tilt_y, tilt_z; theirs: x, y, z, alpha, beta, theta about their axes.
_THEIRS = (2, 0, 1, 3, 4)
_OURS = (1, 2, 0, 4, 5, 3)  # of six, in their order


@one_blas_thread()
def ross_rotor(model: MachineModel, state: MachineState | None = None, announce: Announce = None) -> Any:
    """Return the machine at its operating point as ``ross.Rotor``.

    Parameters
    ----------
    model : MachineModel
        From :func:`check`.
    state : MachineState, optional
        Its equilibrium; default: it is solved.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    ross.Rotor

    Raises
    ------
    UsageError
        When ROSS is not installed, or the shaft has what ROSS has no word for.
    """
    try:
        import ross
    except ImportError:
        raise UsageError("the package ross-rotordynamics is not installed: pip install ross-rotordynamics") from None
    if not model.body.elements:
        raise UsageError("an imported shaft has no sections, and a rotor of ROSS needs them")
    if any(SHAFT in (s.place.body, s.to) and GROUND not in (s.place.body, s.to) for s in model.springs):
        raise UsageError("ROSS has no springs between the shaft and other bodies: remove them")
    if model.links or model.hold is not None:
        raise UsageError("ROSS has no supports of the shaft and no connections by laws: remove them")
    found = state if state is not None else solve_machine(model, announce)
    body = model.body
    shaft = [_piece(ross, body, node) for node in range(body.positions.size - 1)]
    discs = [
        ross.DiskElement(n=body.node(disc.position), m=disc.mass, Id=disc.transverse_inertia, Ip=disc.polar_inertia)
        for disc in body.discs
    ]
    nodes = [body.node(bearing.position) for bearing in model.bearings]
    stiffness = [_stiffness(k) for k in housed_stiffness(model, found)]
    own = bearing_damping(model, [ring.equilibrium() for ring in found.rings])
    damping = [c[np.ix_(_OURS, _OURS)] for c in housed_damping(model, found, own)]
    bearings = [_forces(ross, *each) for each in zip(nodes, stiffness, damping, strict=True)]
    rotor = ross.Rotor(shaft, discs, bearings)
    for node, k, c in zip(nodes, stiffness, damping, strict=True):
        block = np.ix_(*2 * [np.arange(NODE * node, NODE * (node + 1))])
        rotor.K0[block] += _rest(k)
        rotor.C0[block] += _rest(c)
    for spring in (s for s in model.springs if SHAFT in (s.place.body, s.to)):
        rows = np.arange(NODE) + NODE * body.node(spring.place.point[0])
        for matrix, values in ((rotor.K0, spring.stiffness), (rotor.C0, spring.damping)):
            matrix[np.ix_(rows, rows)] += values[np.ix_(_OURS, _OURS)]
    return rotor


def _piece(ross: Any, body: ElasticBody, node: int) -> Any:
    """Return a piece of shaft as ROSS element.

    It is between a node and the next one.
    """
    section = body.elements[node // (NODES - 1)]
    own = section.material
    material = ross.Material(name="shaft", rho=own.density, E=own.youngs_modulus, G_s=own.shear_modulus)
    length = float(body.positions[node + 1] - body.positions[node])
    return ross.ShaftElement(L=length, idl=section.bore, odl=section.outside_diameter, material=material, n=node)


def _stiffness(stiffness: FloatArray) -> FloatArray:
    """Return the matrix of a bearing for ROSS.

    Rows and columns have the order of ROSS; the matrix has shape (6, 6).
    """
    matrix = np.zeros((NODE, NODE))
    matrix[np.ix_(_THEIRS, _THEIRS)] = 0.5 * (stiffness + stiffness.T)
    return matrix


def _rest(matrix: FloatArray) -> FloatArray:
    """Return what of a matrix their bearing elements cannot say."""
    rest = matrix.copy()
    rest[:2, :2] = 0.0
    rest[2, 2] = 0.0
    return rest


def _forces(ross: Any, node: int, stiffness: FloatArray, damping: FloatArray) -> Any:
    """Return a bearing element with what theirs can say."""
    (kxx, kxy), (kyx, kyy) = stiffness[:2, :2].tolist()
    (cxx, cxy), (cyx, cyy) = damping[:2, :2].tolist()
    return ross.BearingElement(
        n=node, kxx=kxx, kxy=kxy, kyx=kyx, kyy=kyy, kzz=float(stiffness[2, 2]), cxx=cxx, cxy=cxy, cyx=cyx, cyy=cyy,
        czz=float(damping[2, 2]),
    )  # fmt: skip
