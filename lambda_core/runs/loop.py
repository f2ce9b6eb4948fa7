"""Run an engine until it converges or ends.

The running integrals are recorded 40 times per nominal cage revolution, at the ends of the
first steps past a fixed grid of times. Neither records nor samples depend on when the
file is flushed, so a resumed run writes what an uninterrupted one would have written.
"""

from __future__ import annotations

import glob
import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from lambda_core.domain.errors import UsageError
from lambda_core.domain.inline_laws import digest_of
from lambda_core.domain.processes import locked
from lambda_core.laws.kernels import cache_folder
from lambda_core.model.bearing_model import BearingModel
from lambda_core.results import hdf5
from lambda_core.results.checkpoint import Position
from lambda_core.results.convergence import are_converged_by
from lambda_core.results.opening import BeingWrittenError
from lambda_core.results.provenance import Provenance
from lambda_core.results.reader import Result
from lambda_core.results.row_sums import check_rows
from lambda_core.results.run_status import Rows, Status, this_process
from lambda_core.results.writer import ResultWriter
from lambda_core.runs.progress import Report
from lambda_core.runs.run_engine import RunEngine
from lambda_core.runs.session import Attachments, Known, Last, Session, records_of


class NothingLeftError(UsageError):
    """Run that has come to its end.

    It cannot go on.
    """


def run(
    engine: RunEngine,
    provenance: Provenance,
    path: Path,
    *,
    overwrite: bool = False,
    report: Report | None = None,
    attached: Attachments | None = None,
    began: float | None = None,
) -> Result:
    """Simulate from the start until the end.

    It writes a new result file.

    Parameters
    ----------
    engine : RunEngine
        At t = 0.
    provenance : Provenance
        The models and the keys of the code that `engine` runs.
    path : pathlib.Path
        Where the result goes; must not exist unless `overwrite` is set.
    report : callable, optional
        Called with a :class:`Progress` some ten times a second.
    attached : Attachments, optional
        The electric circuit, observers and events of the run.
    began : float, optional
        When its preparation began, which the limit of wall time counts from, of ``time.perf_counter``; default: now.

    Returns
    -------
    Result
        Also when the run was stopped early (its ``status`` says so).

    Raises
    ------
    SolverError
        When the engine cannot go on; the file keeps what there is.
    PartialResultError
        When the disk takes no more; the file keeps what there is.
    """
    attached = attached or Attachments.of(provenance, None)
    channels = attached.channels(engine)
    writer = ResultWriter.create(path, provenance, channels, Status(process=this_process()), overwrite=overwrite)
    return _begun(engine, provenance, writer, report, attached, began).drive()


def _begun(
    engine: RunEngine,
    provenance: Provenance,
    writer: ResultWriter,
    report: Report | None,
    attached: Attachments,
    began: float | None,
) -> Session:
    """Return the first stretch of a run."""
    start = records_of(engine)
    known = {name: [row] for name, row in start.items()}
    writer.add_record(start, known)
    position = Position(0, Rows(), 0.0)
    return Session(engine, _models(provenance), writer, known, start, position, report, attached, began)


def resume(
    engine: RunEngine,
    provenance: Provenance,
    path: Path,
    *,
    report: Report | None = None,
    attached: Attachments | None = None,
    began: float | None = None,
) -> Result:
    """Continue a run from its last checkpoint.

    The run was killed, stopped or finished.

    Parameters and errors as for :func:`run`; `engine` is new and its models' `solver` says
    when to end.

    Raises
    ------
    BeingWrittenError
        When the run is still going on.
    NothingLeftError
        When it has nothing left to do.
    UsageError
        When the disk has no room to go on.
    """
    with locked(_lock_of(path)):  # of two that resume one file at the same moment, the second finds the first at work
        session = _reopened(engine, provenance, path, report, attached, began)
    return session.drive()


def _lock_of(path: Path) -> Path:
    """Return the lock file of a result.

    A process holds it while it takes a result over.
    """
    return cache_folder().parent / "locks" / f"{digest_of(os.fsencode(path.resolve()))}.lock"


def _reopened(
    engine: RunEngine,
    provenance: Provenance,
    path: Path,
    report: Report | None,
    attached: Attachments | None,
    began: float | None,
) -> Session:
    """Return the next stretch of a run.

    Its file is open for this process.
    """
    result = Result(path)
    status = result.status()
    if status.alive():
        raise BeingWrittenError(path, status.process["pid"])
    hdf5.sweep(path.absolute().parent, glob.escape(path.name))
    checkpoint = result.checkpoint()
    attached = attached or Attachments.of(provenance, None)
    if checkpoint is None:  # killed before the first one: the beginning is as good
        writer = ResultWriter.continued(path, Status(process=this_process()), Rows())
        return _begun(engine, provenance, writer, report, attached, began)
    position = checkpoint.position
    check_rows(path, position)
    engine.restore(checkpoint.state)
    records, known = {}, {}
    for name, own in result.bearings.items():
        records[name] = own.integrals()[: position.rows.records]
        known[name] = list(own.revolutions()[: position.rows.revolutions.get(name, 0)])
    last = {name: rows[-1] for name, rows in records.items()}
    if status.state == "finished" and not _left_to_do(_models(provenance), engine.time, known, last):
        raise NothingLeftError(f"{path} is finished: nothing is left to do; a longer --duration continues it")
    status = replace(status, state="running", message="", rows=position.rows, process=this_process())
    attached.catch_up(result, position.rows)
    writer = ResultWriter.continued(path, status, position.summed)
    session = Session(engine, _models(provenance), writer, known, last, position, report, attached, began)
    # Convergence is looked at where a revolution ends: a run that was killed right behind that has nothing left to do.
    if any(len(rows) > 1 and known[name][-1][0] > rows[-2][0] for name, rows in records.items()):
        session.judge()
    return session


def _models(provenance: Provenance) -> dict[str, BearingModel]:
    return {name: origin.model for name, origin in provenance.bearings.items()}


def _left_to_do(models: Mapping[str, BearingModel], now: float, known: Known, last: Last) -> bool:
    solvers = [model.solver for model in models.values()]
    if solvers[0].duration > 0.0:
        return now < solvers[0].duration
    end = max(solver.max_duration for solver in solvers)
    return now < end and not are_converged_by(solvers, list(known.values()), list(last.values()))
