"""Put the circuit of all bearings into their library.

A step of the host is a stretch of the integration that a run takes: the contacts at both ends, the source a straight
line between. The host is the source; that of the case is left out.
"""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
from lambda_core.analysis.electric.circuit_integrator import compiled
from lambda_core.analysis.electric.simulation import network_of
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError
from lambda_core.laws.jit.machine_code import Pointer
from lambda_core.laws.jit.portable import Entry
from lambda_core.model.bearing_model import BearingModel

if TYPE_CHECKING:
    from lambda_core.case.electric import Film
    from lambda_core.export.fmu.image import Image
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.solver.drivers.assembly import BearingSpan
    from lambda_core.solver.drivers.compiled_laws import Announce

_ROOM = 1024  # contacts that may break down within one step of the host
# What the host gives of the source, and where it stood last: voltage [V], its rate [V/s], from when on [s]; what a step
# has done: the mean current from the source [A], and the voltage of the shaft at its end [V].
NUMBERS = ("given", "rate", "since", "last", "current", "shaft")
# What a step has done to a bearing: voltage at its end, the least and the largest on the way [V], mean current through
# arcs, and the largest through one [A].
OF_A_BEARING = ("voltage", "lowest", "highest", "arc_current", "peak")
# Arguments of the integrator that are no arrays: places among `words` and `sizes`, behind which `machine` stands.
_WORDS = ("first", "seed", "substeps")
_SIZES = ("machine",)


class FilmPart(NamedTuple):
    """The films of a bearing among those of the circuit.

    Attributes
    ----------
    first, balls : int
        Of its balls among those of all bearings.
    node : int
        Of its outer ring where it is insulated, otherwise 0.
    film : Film
        Options of the case.
    """

    first: int
    balls: int
    node: int
    film: Film


@dataclass(frozen=True)
class Circuit:
    """Circuit in the image of bearings.

    The image holds it in addition to their motion.

    Attributes
    ----------
    arguments : dict of str to arrays
        Of the compiled integrator, by the names of its arguments, in its order; None: among `words` and `sizes`.
    numbers, sizes : float64[:]
    answers : float64[:, :], shape (bearings, 5)
        See :data:`OF_A_BEARING`.
    words : int64[:]
    rate : float64[:, :, :], shape (2, Z, 2)
        Patches rolled over per second at both ends of a step.
    films : tuple of FilmPart
        Of each bearing.
    """

    arguments: dict[str, Any]
    numbers: FloatArray
    answers: FloatArray
    sizes: FloatArray
    words: Any
    rate: FloatArray
    films: tuple[FilmPart, ...]

    def sections(self) -> Iterator[tuple[str, Any, Any]]:
        """Yield what belongs into the image."""
        from lambda_core.analysis.electric.compiled.array_types import array1, array2, array3, iarray1
        from lambda_core.analysis.electric.compiled.switching import integrate_sig

        yield from (("circuit_numbers", array1, self.numbers), ("circuit_sizes", array1, self.sizes))
        yield "circuit_answers", array2, self.answers
        yield from (("circuit_words", iarray1, self.words), ("circuit_rate", array3, self.rate))
        for (name, value), kind in zip(self.arguments.items(), integrate_sig.args, strict=True):
            if value is not None:
                yield f"circuit_{name}", kind, value

    def entry(self, image: Image) -> Entry:
        """Return the function of the library that integrates further."""
        from lambda_core.analysis.electric.compiled.switching import integrate_sig

        at = {name: image.place(self.words, k) for k, name in enumerate(_WORDS)}
        at |= {name: image.place(self.sizes, k) for k, name in enumerate(_SIZES)}
        places = (at[n] if v is None else image.sections[f"circuit_{n}"] for n, v in self.arguments.items())
        return Entry("lb_integrate_circuit", Pointer(compiled(None), integrate_sig), tuple(places))

    def place(self, image: Image, name: str) -> int:
        """Return the place of one of :data:`NUMBERS`."""
        return image.place(self.numbers, NUMBERS.index(name))

    def answer(self, image: Image, bearing: int, name: str) -> int:
        """Return the place of one of :data:`OF_A_BEARING`."""
        return image.place(self.answers, bearing * len(OF_A_BEARING) + OF_A_BEARING.index(name))


def circuit(
    model: BearingModel | MachineModel, spans: Sequence[BearingSpan], contacts: int, announce: Announce = None
) -> Circuit | None:
    """Return the uncharged circuit of a bearing or machine.

    None where its case has none.

    Parameters
    ----------
    spans : sequence of BearingSpan
        Where each bearing stands.
    contacts : int
        How many a sample has.

    Raises
    ------
    UsageError
        When a bearing has rollers, or a ball touches a ring at more than one place.
    """
    if model.electric is None:
        return None
    balls = sum(span.balls for span in spans)
    bearings = circuit_bearings(model)
    what = (
        "rollers" if any(one.of_lines for one in bearings) else "four-point contacts" if contacts != 2 * balls else ""
    )
    if what:
        raise UsageError(f"the circuit of {what} is not exported: leave [electric] out of the case")
    options = bearings[0].options
    network = network_of(bearings, [span.balls for span in spans], announce)
    nodes = network.held()["wiring"].ring
    arguments = network.held() | {
        "rest_t": np.zeros(0), "rest_v": np.zeros(0),  # it begins with what the source charges
        "source_t": np.zeros(2), "source_v": np.zeros(2), "t": np.zeros(2),
        "tables": L.Tables(*np.zeros((len(L.Tables._fields), 2, balls, 2))),
        "extremes": np.zeros((1, len(bearings) + 1, 2)), "events": np.zeros((_ROOM, L.N_EVENT)),
        "trace": np.zeros((0, L.N_TRACE + 2)), "window": np.array([np.inf, -np.inf]),
    }  # fmt: skip
    from lambda_core.analysis.electric.compiled.switching import integrate

    return Circuit(
        arguments={name: arguments.get(name) for name in inspect.signature(integrate).parameters},
        numbers=np.zeros(len(NUMBERS)),
        answers=np.zeros((len(bearings), len(OF_A_BEARING))),
        sizes=np.array(network.circuit.constants()),
        words=np.array([1, options.seed, network.substeps], dtype=np.int64),
        rate=np.zeros((2, balls, 2)),
        films=tuple(
            FilmPart(span.first_ball, span.balls, max(int(node), 0), one.options.film)
            for one, span, node in zip(bearings, spans, nodes, strict=False)  # a last node is the shaft's
        ),
    )
