"""Test that the test command repeats failed tests alone."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import textwrap
from pathlib import Path

SECOND_TRY = Path(__file__).parents[1] / "second_try.py"
TESTS = {
    "test_flaky.py": """
        import os
        from pathlib import Path
        def test_fails_the_first_time():
            path = Path("was-here")
            is_second = path.exists()
            path.touch()
            assert is_second
            assert "PYTEST_XDIST_WORKER" not in os.environ
        """,
    "test_wrong.py": """
        import pytest
        @pytest.mark.parametrize("word", ["a b", "c::d[e]"])
        def test_fails_always(word):
            assert word == "a"
        """,
    "test_right.py": """
        import pytest
        def test_passes():
            pass
        def test_is_left_out():
            pytest.skip("not here")
        """,
    "test_broken.py": "import a_module_that_is_not_there",
    "test_x_ends.py": """
        import os
        from pathlib import Path
        def test_ends_its_process_the_first_time():
            path = Path("ended")
            if not path.exists():
                path.touch()
                os._exit(3)
        """,
    "test_untidy.py": """
        from pathlib import Path
        import pytest
        @pytest.fixture
        def untidy():
            yield
            path = Path("tidied")
            is_second = path.exists()
            path.touch()
            assert is_second
        def test_fails_at_its_end_the_first_time(untidy):
            pass
        """,
}


def run(folder: Path, *names: str, **environment: str) -> tuple[int, str]:
    """Run some tests in xdist.

    Return exit code and output.
    """
    for name in names:
        (folder / name).write_text(textwrap.dedent(TESTS[name]))
    (folder / "pytest.ini").write_text("[pytest]\naddopts = -p no:asyncio -p no:hypothesispytest\n")
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTEST", "CI"))}
    command = [sys.executable, str(SECOND_TRY), "-n", "1", "--dist", "loadfile", "--no-loadscope-reorder"]
    done = subprocess.run(
        command, cwd=folder, env=kept | environment, capture_output=True, text=True, check=False, timeout=300
    )
    return done.returncode, done.stdout


def last(output: str) -> str:
    """Return the closing line."""
    return output.strip().splitlines()[-1]


def test_what_passes_alone_is_flaky_and_no_failure(tmp_path: Path) -> None:
    code, output = run(tmp_path, "test_flaky.py", "test_untidy.py", "test_right.py", CI="true")
    assert code == 0, output
    assert "FLAKY test_flaky.py::test_fails_the_first_time (passes alone)" in output
    assert "FLAKY test_untidy.py::test_fails_at_its_end_the_first_time (passes alone)" in output
    assert "1 passed, 1 skipped, 2 flaky in" in last(output)
    assert "1 failed, 2 passed, 1 skipped, 1 error in" in output  # the first run's own closing line
    assert "slowest tests" in output
    assert "seconds by folder" in output
    kept = json.loads((tmp_path / ".pytest_cache" / "v" / "lambda-bearing" / "durations").read_text())
    assert {name.partition("::")[0] for name in kept} == {"test_flaky.py", "test_untidy.py", "test_right.py"}
    assert len(kept) == 4


def test_nothing_that_is_wrong_is_lost(tmp_path: Path) -> None:
    """Report double failures, collection errors and lost processes.

    Each is next to a flaky test.
    """
    code, output = run(tmp_path, "test_flaky.py", "test_wrong.py", "test_broken.py", "test_x_ends.py", "test_right.py")
    assert code == 1, output
    assert "FAILED test_wrong.py::test_fails_always[a b] (alone too)" in output
    assert "FAILED test_wrong.py::test_fails_always[c::d[e]] (alone too)" in output
    assert "FLAKY test_flaky.py::test_fails_the_first_time (passes alone)" in output
    assert "CRASHED test_x_ends.py::test_ends_its_process_the_first_time (ended its process; passes alone)" in output
    assert "ERROR test_broken.py (not collected)" in output
    assert "a_module_that_is_not_there" in output
    assert "3 failed, 1 passed, 1 skipped, 1 error, 1 flaky in" in last(output)


def test_what_only_cannot_be_collected_fails_the_command(tmp_path: Path) -> None:
    code, output = run(tmp_path, "test_broken.py", "test_right.py")
    assert code != 0
    assert "1 error in" in last(output)


def test_many_failures_are_not_tried_again(tmp_path: Path) -> None:
    (tmp_path / "test_many.py").write_text(
        "import pytest\n@pytest.mark.parametrize('n', range(40))\ndef test_n(n):\n    assert n < 0\n"
    )
    code, output = run(tmp_path)
    assert code == 1
    assert "once more" not in output
    assert "40 failed in" in last(output)
