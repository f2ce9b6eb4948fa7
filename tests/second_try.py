"""Run pytest, then what failed once more, alone.

``python tests/second_try.py [arguments of pytest]``

A test that passes alone is a race to be mended and no result that is wrong: it is named FLAKY above the last line, and
the command does not fail for it. What fails again, cannot be collected or ends its process fails the command.
How long each test took is kept in pytest's cache, from which tests/conftest.py puts the longest files first.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import pytest

ALONE = "--alone"  # PATH NODE...: the second process, which writes the tests that passed to PATH
DURATIONS = "lambda-bearing/durations"  # in pytest's cache: node -> seconds of set-up, call and end
MOST = 30  # that fail together are no race
SHOWN = 25
# A process that ends in a test ends the session: xdist would begin the test again in a new process, and wait for ever
# where that is the only one left.
NO_OTHER = "--max-worker-restart=0"


class Record:
    """Record of each test's outcome.

    With its time: a plugin of the process that reports.
    """

    def __init__(self) -> None:
        self.outcomes: dict[str, str] = {}
        self.seconds: dict[str, float] = {}
        self.uncollected: list[str] = []
        self.crashed: set[str] = set()

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        """Keep what could not be collected."""
        if report.failed:
            self.uncollected.append(report.nodeid)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Keep the worst outcome of a test.

        And the time of all its parts.
        """
        name = report.nodeid
        self.seconds[name] = self.seconds.get(name, 0.0) + report.duration
        if report.when not in ("setup", "call", "teardown"):  # xdist: the process is gone
            self.crashed.add(name)
        if not report.passed and self.outcomes.get(name) != "failed":
            self.outcomes[name] = report.outcome
        self.outcomes.setdefault(name, report.outcome)

    def of(self, outcome: str) -> list[str]:
        """Return the tests that came out so."""
        return [name for name, found in self.outcomes.items() if found == outcome]

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Keep the times for the next run."""
        cache = getattr(session.config, "cache", None)
        if cache is not None:
            known = cache.get(DURATIONS, {})
            cache.set(DURATIONS, known | {name: round(took, 2) for name, took in self.seconds.items()})

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Show in CI where the time went."""
        if os.environ.get("CI") != "true" or not self.seconds:
            return
        folders: Counter[str] = Counter()
        for name, took in self.seconds.items():
            folders[name.partition("::")[0].rpartition("/")[0]] += took
        terminalreporter.section("seconds by folder")
        for folder, took in folders.most_common():
            terminalreporter.write_line(f"{took:8.1f}  {folder}")
        terminalreporter.section(f"the {SHOWN} slowest tests [s]")
        for name, took in Counter(self.seconds).most_common(SHOWN):
            terminalreporter.write_line(f"{took:8.1f}  {name}")


def passed_alone(names: list[str]) -> set[str]:
    """Run tests alone in one process.

    Return those that pass.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "passed.json"
        # With -m nothing that the first run chose is left out.
        command = [sys.executable, __file__, ALONE, str(path), "-m", "", *names]
        subprocess.run(command, check=False, stdin=subprocess.DEVNULL)
        return set(json.loads(path.read_text())) if path.exists() else set()


def again(record: Record, start: float) -> int:
    """Try failed tests once more.

    Report the outcome; return the exit code.
    """
    failed = record.of("failed")
    print(f"\n== once more, alone: {len(failed)} that failed", flush=True)
    passed = passed_alone(failed)
    flaky = [name for name in failed if name in passed and name not in record.crashed]
    print()
    for name in failed:
        if name in record.crashed:
            print(f"CRASHED {name} (ended its process; {'passes' if name in passed else 'fails'} alone)")
        else:
            print(f"FLAKY {name} (passes alone)" if name in passed else f"FAILED {name} (alone too)")
    for name in record.uncollected:
        print(f"ERROR {name} (not collected)")
    counts = {
        "failed": len(failed) - len(flaky),
        "passed": len(record.of("passed")),
        "skipped": len(record.of("skipped")),
        "error": len(record.uncollected),
        "flaky": len(flaky),
    }
    said = ", ".join(f"{count} {what}" for what, count in counts.items() if count)
    print(f" {said} in {time.monotonic() - start:.2f}s ".center(80, "="), flush=True)
    return int(counts["failed"] + counts["error"] > 0)


def main(arguments: list[str]) -> int:
    """Run pytest with a second try.

    As ``python -m pytest`` does: return its exit code, or that of the second try.
    """
    sys.path[0] = str(Path.cwd())
    record, start = Record(), time.monotonic()
    if arguments[:1] == [ALONE]:
        code = pytest.main(arguments[2:], plugins=[record])
        Path(arguments[1]).write_text(json.dumps(record.of("passed")))
        return code
    code = pytest.main([NO_OTHER, *arguments], plugins=[record])
    if code == pytest.ExitCode.TESTS_FAILED and 0 < len(record.of("failed")) <= MOST:
        return again(record, start)
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
