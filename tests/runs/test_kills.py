"""Test kill -9 at random moments, on the real engine.

Every file is readable, every continuation the undisturbed run.
"""

from __future__ import annotations

import random
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from real_run import CASE, CHANGES

from lambda_core import api

if TYPE_CHECKING:
    from warm import Started, Warm

HERE = Path(__file__).parent
KILLS = 5  # of one run and its continuations, in the long test
LONGEST = 0.3  # from the first sign of life in the file to the kill [s]; the whole run takes longer
EARLY = 0.1  # share of processes that are killed before it, while they start

Series = dict[str, np.ndarray]


def growing(path: Path) -> Series:
    """Return everything that a run appends to."""
    result = api.result(path)
    found = {channel.name: result[channel.name] for channel in result.channels}
    for kind, table in (("circuit", result.circuit()), ("discharges", result.discharges())):
        found |= {f"{kind}/{name}": values for name, values in table.items()}
    return found | {"integrals": result.integrals(), "revolutions": result.revolutions()}


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Series:
    path = tmp_path_factory.mktemp("undisturbed") / "r.h5"
    api.run(CASE, CHANGES, out=path)
    return growing(path)


def start(warm: Warm, verb: str, path: Path) -> Started:
    """Start a process and wait.

    Until it is about to begin.
    """
    process = warm.start((HERE / "real_run.py").read_text(encoding="utf-8"), verb, str(path))
    assert process.stdout.readline() == "ready\n", process.communicate()[1]
    return process


def wait_for_life(path: Path, process: Started) -> None:
    """Wait until the process has the file.

    Or has ended.
    """
    while process.poll() is None:
        if path.exists():
            status = api.result(path).status()
            if status.alive() and status.process["pid"] == str(process.pid):
                return
        time.sleep(0.01)


def wait_for_samples(path: Path, process: Started) -> None:
    """Wait until there is something to lose."""
    while not path.exists() or api.result(path).status().rows.samples < 2:
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)


def is_beginning_of(found: Series, complete: Series) -> None:
    """Check a killed run's remains.

    They are the beginning of the undisturbed one, bit for bit.
    """
    for name in set(found) - {"integrals"}:  # the last record may stand between two of the grid
        values = found[name]
        assert values.tobytes() == complete[name][: len(values)].tobytes(), name
    assert found["integrals"][:-1].tobytes() == complete["integrals"][: len(found["integrals"]) - 1].tobytes()


def kill_and_resume(warm: Warm, path: Path, chance: random.Random, complete: Series) -> tuple[int, int]:
    """Kill a run and its continuations.

    Look at what each leaves, let the last one finish.

    Returns the number of kills, and of those that struck between the first sample and the end.
    """
    verb, kills, midway = "run", 0, 0
    for _ in range(KILLS):
        process = start(warm, verb, path)
        if kills == 0:
            wait_for_samples(path, process)
        elif chance.random() > EARLY:
            wait_for_life(path, process)
        time.sleep(chance.uniform(0.0, LONGEST))
        process.kill()
        process.communicate()
        kills += 1
        if path.exists():  # from its first moment on
            verb = "resume"
            is_beginning_of(growing(path), complete)
            status = api.result(path).status()
            if status.state == "finished":
                break
            midway += status.rows.samples > 1
    if verb == "run" or api.result(path).status().state != "finished":
        process = start(warm, verb, path)
        _, errors = process.communicate()
        assert process.returncode == 0, errors
    found = growing(path)
    for name, values in complete.items():
        assert found[name].tobytes() == values.tobytes(), name
    assert api.summary(path).state == "finished"
    return kills, midway


@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_a_hundred_kills(warm: Warm, tmp_path: Path, undisturbed: Series) -> None:
    counts, seed = np.zeros(2, dtype=int), 1000
    while counts[0] < 100:
        counts += kill_and_resume(warm, tmp_path / f"{seed}.h5", random.Random(seed), undisturbed)
        seed += 1
    assert counts[1] >= 50, counts  # the others struck before the first sample, or after the end
    print(f"{counts[0]} kills, {counts[1]} of them between the first sample and the end")
