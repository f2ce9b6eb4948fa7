"""Define the state of a run in its file."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any, Literal

from lambda_core.domain.printable import printable
from lambda_core.domain.processes import exists, started


@dataclass(frozen=True)
class Rows:
    """Number of valid rows in the datasets.

    Samples and running integrals; of an electric circuit its own samples and discharges; by name of the bearing the
    boundaries of cage revolutions, and the events.
    """

    samples: int = 0
    records: int = 0
    circuit: int = 0
    discharges: int = 0
    revolutions: Mapping[str, int] = field(default_factory=dict)
    events: Mapping[str, int] = field(default_factory=dict)

    @staticmethod
    def read(fields: Mapping[str, Any]) -> Rows:
        """Return rows from plain data; ValueError where that is none."""
        counts = {name: fields[name] for name in ("samples", "records", "circuit", "discharges")}
        each = {name: {str(key): n for key, n in fields[name].items()} for name in ("revolutions", "events")}
        if not all(type(n) is int and n >= 0 for group in (counts, *each.values()) for n in group.values()):
            raise ValueError("its counts of rows are not numbers")
        return Rows(**counts, revolutions=each["revolutions"], events=each["events"])


State = Literal["running", "finished", "stopped", "interrupted", "failed"]


@dataclass(frozen=True)
class Status:
    """State of a run.

    Attributes
    ----------
    state : str
        ``running``; ``finished``: the planned end was reached; ``stopped``: at the limit of
        wall time; ``interrupted``: by a person, the system or a full disk; ``failed``: the solver gave up.
    message : str
        A sentence, when there is something to say.
    rows : Rows
        What is completely on disk.
    wall : float
        Wall time of the integration, all sessions together, without set-up [s].
    statistics : dict of str to float
        Counters of the solver, all sessions together.
    process : dict of str to str
        Which process writes: host, pid, start.
    faults : tuple of str
        What plugins that only look on did wrong, one sentence each.
    modes : tuple of tuples of 2 floats
        Frequency [Hz] and damping ratio of the modes of the rings at the end of the last session.
    """

    state: State = "running"
    message: str = ""
    rows: Rows = Rows()
    wall: float = 0.0
    statistics: dict[str, float] = field(default_factory=dict)
    process: dict[str, str] = field(default_factory=dict)
    faults: tuple[str, ...] = ()
    modes: tuple[tuple[float, float], ...] = ()

    def to_bytes(self, size: int) -> bytes:
        """Return JSON of at most `size` bytes.

        An overlong message is cut.
        """
        data = json.dumps(asdict(self)).encode()
        if len(data) > size:
            kept = max(len(self.message) - (len(data) - size) - 3, 0)
            data = json.dumps(asdict(replace(self, message=self.message[:kept] + "..."))).encode()
        return data

    @staticmethod
    def from_bytes(data: bytes) -> Status:
        """Read what `to_bytes` wrote; ValueError when it is not that."""
        try:
            fields = json.loads(data)
            fields["statistics"] = {printable(name): count for name, count in fields["statistics"].items()}
            fields["message"] = printable(str(fields["message"]))
            fields["faults"] = tuple(printable(str(fault)) for fault in fields.get("faults", ()))
            fields["modes"] = tuple((float(f), float(damping)) for f, damping in fields.get("modes", ()))
            return Status(**{**fields, "rows": Rows.read(fields["rows"])})
        except (KeyError, TypeError, AttributeError) as error:
            raise ValueError(str(error)) from None

    def alive(self) -> bool:
        """Tell whether the writing process is at work.

        It sees only processes of this host.
        """
        if self.state != "running" or self.process.get("host") != socket.gethostname():
            return False
        pid = int(self.process["pid"])
        return started(pid) == self.process["start"] and exists(pid)


def this_process() -> dict[str, str]:
    """Return what identifies this process on this host."""
    return process_identity(os.getpid())


def process_identity(pid: int) -> dict[str, str]:
    """Return what identifies a process on this host."""
    return {"host": socket.gethostname(), "pid": str(pid), "start": started(pid)}
