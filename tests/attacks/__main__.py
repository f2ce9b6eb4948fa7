"""Attack the program and count results: ``python -m tests.attacks``.

Every trial is reported by its part, seed and number, and repeats. A campaign that was stopped goes on where it was.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
from pathlib import Path

from tests.attacks import page, parts, trial
from tests.attacks.record import Record

DEFAULT_FOLDER = Path("attacks")


def main() -> int:
    """Run the requested parts.

    Return 1 when any trial failed.
    """
    parser = argparse.ArgumentParser(prog="python -m tests.attacks", description=__doc__)
    parser.add_argument(
        "parts", nargs="*", metavar="PART[:COUNT]", help=f"and how many trials; default all: {', '.join(parts.PARTS)}"
    )
    parser.add_argument("--seed", type=int, default=1, help="of every random number")
    parser.add_argument("--count", type=int, help="trials per part; default: those of a full campaign")
    parser.add_argument("--minutes", type=float, default=1e6, help="wall time after which no new trial begins")
    parser.add_argument("--workers", type=int, default=1, help="parts that run side by side")
    parser.add_argument(
        "--share", type=_share, default=(1, 1), metavar="K/N", help="every N-th trial, from the K-th on"
    )
    parser.add_argument("--folder", type=Path, default=DEFAULT_FOLDER, help="where outcomes and failures are kept")
    parser.add_argument("--again", action="store_true", help="do trials again that failed, after a mend")
    parser.add_argument("--write", action="store_true", help="write the figures into docs/reliability.md")
    options = parser.parse_args()
    asked = dict(name.partition(":")[::2] for name in options.parts)
    if unknown := [name for name in asked if name not in parts.PARTS]:
        parser.error(f"no part {unknown[0]!r}; there are {', '.join(parts.PARTS)}")
    names = list(asked or parts.PARTS)
    folder = options.folder.resolve()
    if options.again:
        for name in names:
            Record(folder, name).forget_failed()
    if options.workers > 1 and len(names) > 1:
        _side_by_side(names, options)
    else:
        os.environ["LAMBDA_BEARING_DATA"] = str(folder / "data")  # nobody's own catalogue
        trial.warm()
        deadline = time.monotonic() + 60.0 * options.minutes
        for name in names:
            part = parts.PARTS[name]
            first, step = options.share
            count = int(asked.get(name) or options.count or part.count)
            numbers = range(first - 1, count, step)
            parts.run(part, options.seed, numbers, folder, deadline)
    text = page.figures({name: Record(folder, name) for name in names})
    print(text)
    if options.write:
        page.write(text)
    return (
        0
        if all(entry.get("verdict") in trial.GOOD for name in names for entry in Record(folder, name).entries())
        else 1
    )


def _share(text: str) -> tuple[int, int]:
    """Read a share such as "2/3".

    It is the second of three processes that share the trials of a part.
    """
    first, _, step = text.partition("/")
    if not 1 <= int(first) <= int(step):
        raise ValueError(text)
    return int(first), int(step)


def _side_by_side(names: list[str], options: argparse.Namespace) -> None:
    """Run each part in its own process.

    A limited number at a time.
    """
    waiting = list(names)
    running: list[subprocess.Popen[bytes]] = []
    while waiting or running:
        while waiting and len(running) < options.workers:
            command = [sys.executable, "-m", "tests.attacks", waiting.pop(0), "--seed", str(options.seed)]
            command += ["--folder", str(options.folder), "--minutes", str(options.minutes)]
            command += [] if options.count is None else ["--count", str(options.count)]
            running.append(subprocess.Popen(command, stdout=subprocess.DEVNULL))
        running = [process for process in running if process.poll() is None]
        time.sleep(0.2)


if __name__ == "__main__":
    sys.exit(main())
