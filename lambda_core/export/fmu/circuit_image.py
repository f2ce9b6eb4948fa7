"""The circuit of a bearing in its library: films, the network around them, and the discharges through them.

A step of the host is a stretch of the integration that a run takes: the contacts at both ends, the source a straight
line between. The host is the source; that of the case is left out.
"""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.circuit_bearing import of_model
from lambda_core.analysis.electric.circuit_integrator import compiled
from lambda_core.analysis.electric.simulation import network_of
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError
from lambda_core.laws.jit.machine_code import Pointer
from lambda_core.laws.jit.portable import Entry

if TYPE_CHECKING:
    from lambda_core.case.electric import Film
    from lambda_core.export.fmu.image import Image
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.solver.drivers.compiled_laws import Announce

_ROOM = 1024  # contacts that may break down within one step of the host
# What the host gives of the source, and where it stood last: voltage [V], its rate [V/s], from when on [s]. What a step
# has done: voltage of the bearing at its end, the least and the largest on the way [V], mean currents from the source
# and through arcs, and the largest through one [A].
NUMBERS = (
    "given", "rate", "since", "last", "voltage", "lowest", "highest", "current", "arc_current", "peak",
)  # fmt: skip
# Arguments of the integrator that are no arrays: places among `words` and `sizes`, behind which `machine` stands.
_WORDS = ("first", "seed", "substeps")
_SIZES = ("machine",)


@dataclass(frozen=True)
class Circuit:
    """What the image of a bearing with a circuit holds in addition to its motion.

    Attributes
    ----------
    arguments : dict of str to arrays
        Of the compiled integrator, by the names of its arguments, in its order; None: among `words` and `sizes`.
    numbers, sizes : float64[:]
    words : int64[:]
    rate : float64[:, :, :], shape (2, Z, 2)
        Patches rolled over per second at both ends of a step.
    film : Film
        Options of the case.
    """

    arguments: dict[str, Any]
    numbers: FloatArray
    sizes: FloatArray
    words: Any
    rate: FloatArray
    film: Film

    def sections(self) -> Iterator[tuple[str, Any, Any]]:
        """Yield what belongs into the image."""
        from lambda_core.analysis.electric.compiled.array_types import array1, array3, iarray1
        from lambda_core.analysis.electric.compiled.switching import integrate_sig

        yield from (("circuit_numbers", array1, self.numbers), ("circuit_sizes", array1, self.sizes))
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


def circuit(model: BearingModel, contacts: int, announce: Announce = None) -> Circuit | None:
    """Return the circuit of a model, uncharged; None where its case has none.

    Parameters
    ----------
    contacts : int
        How many a sample has.

    Raises
    ------
    UsageError
        When a ball touches a ring at more than one place.
    """
    if model.electric is None:
        return None
    balls = model.geometry.balls
    if contacts != 2 * balls:
        raise UsageError("the circuit of four-point contacts is not exported: leave [electric] out of the case")
    bearing = of_model(model)
    options = bearing.options
    network = network_of([bearing], [balls], announce)
    arguments = network.held() | {
        "rest_t": np.zeros(0), "rest_v": np.zeros(0),  # it begins with what the source charges
        "source_t": np.zeros(2), "source_v": np.zeros(2), "t": np.zeros(2),
        "tables": L.Tables(*np.zeros((len(L.Tables._fields), 2, balls, 2))),
        "extremes": np.zeros((1, 2, 2)), "events": np.zeros((_ROOM, L.N_EVENT)),
        "trace": np.zeros((0, L.N_TRACE + 2)), "window": np.array([np.inf, -np.inf]),
    }  # fmt: skip
    from lambda_core.analysis.electric.compiled.switching import integrate

    return Circuit(
        arguments={name: arguments.get(name) for name in inspect.signature(integrate).parameters},
        numbers=np.zeros(len(NUMBERS)),
        sizes=np.array(network.circuit.constants()),
        words=np.array([1, options.seed, network.substeps], dtype=np.int64),
        rate=np.zeros((2, balls, 2)),
        film=options.film,
    )
