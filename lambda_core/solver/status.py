"""Define the status codes of compiled solver functions.

A law's kernel has codes of its own (1: well, 2 and up: declared with it); the solver turns every refusal into `REFUSED`
and leaves in the fault report which law it was.
"""

from __future__ import annotations

from enum import IntEnum


class Status(IntEnum):
    """Outcome of a compiled function."""

    REFUSED = 0
    OK = 1
    NOT_CONVERGED = 2
    STEP_TOO_SMALL = 3
    BUFFER_FULL = 4
    UNFINISHED = 5
    NO_CONTACT = 6


SENTENCES = {
    Status.REFUSED: "a law refused its inputs, or its result was not finite",
    Status.OK: "done",
    Status.NOT_CONVERGED: "the iteration did not converge",
    Status.STEP_TOO_SMALL: "the time step fell below the smallest one allowed",
    Status.BUFFER_FULL: "the buffer of samples is full: take them and go on",
    Status.UNFINISHED: "the work allowed in one call is done: call again to go on",
    Status.NO_CONTACT: "the bodies do not touch",
}
