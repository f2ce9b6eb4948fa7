"""Bundle state vector, tables and workspaces.

The state vector y is float64, shape (states of rolling elements + n_active + states of contacts,):

* row by row, element by element, ROW.size states each from ROW.first_state on: a records.BALL (x, radius, azimuth,
  velocity, spin), or a records.ROLLER, which begins with the same.
* from SYSTEM.tail on the free entries of the *shared* state, shape (12 bodies,), one records.BODY_STATE per body: inner
  ring, outer ring, cage.
* the rest: what contacts keep by laws of the role contact_state, raceway by raceway, ball by ball; mostly nothing.
"""

from __future__ import annotations

from collections import namedtuple
from typing import Any, NamedTuple

import numpy as np

from lambda_core.laws.jit.words import FUNCTION, Array, by_reference
from lambda_core.solver import records as R

# Places in the state vector, for what goes through states one by one: integrator, Jacobian, tolerances.
NB = R.floats_of(R.BALL)
NR = R.floats_of(R.ROLLER)
NS = R.floats_of(R.BODY_STATE)
BX, BR, BPSI, BVX, BVR, BVT, BWX, BWR, BWT = range(NB)
RTILT, RSKEW = range(NB, NR)  # of a roller, behind what it has as a ball has
SX, SY, SZ, SAY, SAZ, STHETA, SVX, SVY, SVZ, SWY, SWZ, SSIGMA = range(NS)
NQ = len(R.DRIVERS)

ARRAY1, ARRAY2, ARRAY3, ARRAY4 = (Array(np.dtype(np.float64), dimensions) for dimensions in range(1, 5))
INTEGERS, INTEGERS2 = (Array(np.dtype(np.int64), dimensions) for dimensions in (1, 2))

ELEMENTS = {NB: R.BALL, NR: R.ROLLER}  # records of rolling elements by their number of states

# Pointers to the kernels of one ball-raceway force element, by role.
RacewayLaws: Any = namedtuple("RacewayLaws", R.RACEWAY_ROLES)  # type: ignore[misc] # its fields are the roles


class RollerCode(NamedTuple):
    """Pointers to the code of roller rows.

    The code is in lambda_core.solver.row_code.
    """

    evaluate: Any
    jacobian: Any
    energy: Any
    observe: Any
    shares: Any


@by_reference(INTEGERS2)
class Laws(NamedTuple):
    """All kernels of the model.

    Tables of their addresses, read with raceway_laws, guide_law, drag_law, and so on.
    """

    raceways: Any  # int64 (sets of laws, roles of a raceway contact)
    guides: Any  # int64 (laws, 1): of pockets, of balls with each other, of lands
    drag: Any  # int64 (laws, 1)
    links: Any  # int64 (laws, 1): of force elements between bodies
    times: Any  # int64 (laws, 1): of loads and motions over time


class Losses(NamedTuple):
    """Losses of raceway contacts by mechanism.

    Each array has one entry per raceway [W].
    """

    sliding: Any
    spin: Any
    boundary: Any
    rolling: Any
    hysteresis: Any
    damping: Any


# Powers, and their running integrals: Losses of every raceway, then records.RUNNING, which begins with losses too.
MECHANISMS = len(Losses._fields)
RUNNING_SIZE = R.floats_of(R.RUNNING)
NOT_LOST = RUNNING_SIZE - 4  # powers at the end that are no losses of bearings
NOT_DISSIPATED = NOT_LOST - 1  # that are not dissipated: losses, and what dampers to the ground take


def power_count(bundle: Bundle) -> int:
    """Return how many powers the raceways of a bundle have."""
    return MECHANISMS * int(bundle.raceways.size) + RUNNING_SIZE


class Grid(NamedTuple):
    """Cells on the unit ellipse.

    Each array has one entry per cell.
    """

    across: Any  # place across rolling over a
    along: Any  # place along rolling over b
    pressure: Any  # mean over p_max
    area: Any  # over a b
    width_across: Any  # over a
    width_along: Any  # over b


class Cells(NamedTuple):
    """Values of the contacts' cells.

    Each array has one entry per cell, contact by contact.

    Pressure and what follows depends on the kinematics alone.
    """

    ln_eta_inlet: Any  # logarithm of the viscosity at the inlet's temperature [ln(Pa s)]
    shear_inlet: Any  # shear stress there; in the end the film's share of it [Pa]
    temperature: Any  # of the film [K]
    ln_eta: Any  # at the film's temperature
    shear: Any  # stress of film and asperities [Pa]
    friction: Any  # coefficient of the asperities; in the end their share of the shear stress [Pa]
    density: Any  # [kg/m3]
    inlet: Any  # inlet's temperature [K]
    film: Any  # film of the contact [m]
    pressure: Any  # [Pa]
    slip: Any  # speed, with its spread inside the cell [m/s]
    inverse_slip: Any  # [s/m]
    slip_t: Any  # velocity of the ball over the ring along rolling [m/s]
    slip_s: Any  # and across


CELL_ROWS = len(Cells._fields)
LINE_ROWS, SLICE_ROWS = 4, 16
GUARD = 8  # cells behind each row, which nobody writes, a line of cache: what stands first there shows an index too far
RESULTS = 6  # rows that laws write


@by_reference(
    ARRAY1,
    system=Array(R.SYSTEM),
    bodies=Array(R.BODY),
    rows=Array(R.ROW),
    raceways=Array(R.RACEWAY),
    waves=Array(R.WAVE),
    lands=Array(R.LAND),
    links=Array(R.LINK),
    tied=INTEGERS,
    tie_stiffness=ARRAY2,
    tie_damping=ARRAY2,
    slots=Array(R.SLOT),
    laws=Laws,
    wrench=FUNCTION,
    tangent=FUNCTION,
    grid=ARRAY2,
    terms=Array(R.TERM),
    active=INTEGERS,
    inputs=Array(R.INPUTS),
    signals=Array(R.SIGNAL),
    cells=ARRAY2,
    scratch=Array(R.SCRATCH),
    bodies_now=Array(R.BODY_STATE),
    ground=Array(R.BODY_STATE),
    body_rates=Array(R.BODY_STATE),
    body_wrenches=Array(R.WRENCH),
    contact_wrenches=Array(R.WRENCH),
    ball_wrenches=Array(R.WRENCH),
    bypassed=INTEGERS,
    bearing_powers=Array(R.RUNNING),
    state_slopes=ARRAY2,
    state_pivots=INTEGERS,
    rollers=INTEGERS2,
    lines=ARRAY3,
    slices=ARRAY2,
    line_cells=ARRAY2,
)
class Bundle(NamedTuple):
    """Everything that the compiled code works on, in one argument."""

    system: Any  # SYSTEM, shape (1,)
    bodies: Any  # BODY (bodies,)
    rows: Any  # ROW (rows,)
    raceways: Any  # RACEWAY (raceways,)
    waves: Any  # WAVE (waves of elastic rings,): mostly none
    lands: Any  # LAND (stations,)
    links: Any  # LINK (force elements between bodies,)
    tied: Any  # int64 (n,): entries of the shared state that elastic structures tie together; mostly none
    tie_stiffness: Any  # (n, n): of shafts and housings between them [N/m, N, N m]
    tie_damping: Any  # (n, n), or (0, 0) where nothing is damped [N s/m, N s, N m s]
    tie_rest: Any  # (n,): where they are without force
    tie_moves: Any  # (n,): how far they are from there
    tie_rates: Any  # (n,) or (0,): and how fast they change, where something is damped
    slots: Any  # SLOT (places where laws read states of contacts,)
    state_steps: Any  # (states of contacts,): for differences
    laws: Any  # Laws
    wrench: Any  # pointer: wrench of one raceway contact
    tangent: Any  # pointer: its derivative
    par: Any  # float64: parameters of all kernels, one after another
    grid: Any  # (6, cells): rows of Grid
    terms: Any  # TERM (n,)
    table: Any  # knots and spline coefficients
    active: Any  # int64 (n_active,): free entries of the shared state
    inputs: Any  # INPUTS (bodies,)
    signals: Any  # SIGNAL (12 bodies,): the same memory
    cells: Any  # (CELL_ROWS, cells of contacts + GUARD): rows of Cells
    scratch: Any  # SCRATCH (1,)
    shared: Any  # (12 bodies,) the whole shared state
    bodies_now: Any  # BODY_STATE (bodies,): the same memory
    ground: Any  # BODY_STATE (1,): at rest
    shared_rates: Any  # (12 bodies,) its time derivative
    body_rates: Any  # BODY_STATE (bodies,): the same memory
    body_wrenches: Any  # WRENCH (bodies,) of all contacts
    contact_wrenches: Any  # WRENCH (bodies,): the share of raceways, pockets and lands, where bearings are several
    ball_wrenches: Any  # WRENCH (Z,)
    bypassed: Any  # int64 (bearings,): 1 where forces of the last evaluation stand
    bearing_powers: Any  # RUNNING (bearings,): what pockets, lands, drag and weights of each have of the powers
    states: Any  # (states of contacts,)
    state_rates: Any  # (states of contacts,) their time derivatives
    state_slopes: Any  # (states of contacts, most of one contact): of the rates with the states of the same contact
    state_pivots: Any  # int64 (most of one contact,)
    rollers: Any  # int64 (1, codes): addresses of RollerCode; without rollers (0, codes)
    lines: Any  # (line raceways, LINE_ROWS, slices): place along the line, width, drop of both profiles, reduced radius
    slices: Any  # (SLICE_ROWS, slices): workspace of a line contact
    line_cells: Any  # (CELL_ROWS, cells of a line contact + GUARD): rows of Cells


def elements_in(bundle: Bundle, states: Any) -> Any:
    """Return the rolling elements in state vectors.

    The bearing is alone. The result is a view of shape (..., elements) of vectors of shape (..., size).
    """
    kind = ELEMENTS[int(bundle.rows["size"][0])]
    return states[..., : int(bundle.system["tail"][0])].view(kind)


def named_balls(y: Any, row: Any) -> Any:
    """Return the balls of a row by name.

    They are a view of a state vector: a table of records.BALL.
    """
    return y[row.first_state : row.first_state + NB * row.balls].view(R.BALL)


def named_cells(block: Any, first: int, count: int, width: int) -> Cells:
    """Return the rows of Bundle.cells by name.

    They are those of contacts from the first-th on, with `width` cells each.
    """
    a, b = first * width, (first + count) * width
    return Cells(
        block[0][a:b], block[1][a:b], block[2][a:b], block[3][a:b], block[4][a:b], block[5][a:b], block[6][a:b],
        block[7][a:b], block[8][a:b], block[9][a:b], block[10][a:b], block[11][a:b], block[12][a:b], block[13][a:b],
    )  # fmt: skip
