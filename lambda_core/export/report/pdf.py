"""Print a page as PDF by a browser or WeasyPrint."""

from __future__ import annotations

import os
import shutil
import subprocess
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from lambda_core.domain.errors import UsageError
from lambda_core.domain.files import check_target

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "microsoft-edge", "chrome")
_PATIENCE = 180.0  # [s] of a browser that starts on a busy machine
_QUIET = ("--headless", "--disable-gpu", "--disable-extensions", "--no-first-run", "--no-pdf-header-footer")


def check_printer() -> None:
    """Report early that no PDF can be printed.

    The check comes before the work.

    Raises
    ------
    UsageError
        With what to install.
    """
    if _browser() is None and find_spec("weasyprint") is None:
        raise UsageError(
            f"a PDF needs a browser on PATH ({', '.join(BROWSERS[:3])}) or WeasyPrint, and neither is here: "
            'pip install "lambda-bearing[pdf]", or write .html and print that from any browser'
        )


def write_pdf(text: str, path: Path) -> Path:
    """Print a self-contained page into a PDF file.

    Raises
    ------
    UsageError
        When there is nothing to print with, it fails, or the file cannot be written.
    """
    check_printer()
    browser = _browser()
    try:
        check_target(path)
        with TemporaryDirectory(prefix="lambda-bearing-") as folder:
            printed = Path(folder) / "page.pdf"
            if browser is not None:
                _by_browser(browser, text, Path(folder), printed)
            else:
                import_module("weasyprint").HTML(string=text).write_pdf(printed)
            shutil.copyfile(printed, path)
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror}") from None
    return path


def _browser() -> str | None:
    return next(filter(None, map(shutil.which, BROWSERS)), None)


def _by_browser(browser: str, text: str, folder: Path, printed: Path) -> None:
    page = folder / "page.html"
    page.write_text(text, encoding="utf-8")
    is_root = hasattr(os, "geteuid") and os.geteuid() == 0  # whom browsers give no sandbox
    options = [*_QUIET, *(["--no-sandbox"] if is_root else []), f"--user-data-dir={folder / 'profile'}"]
    command = [browser, *options, f"--print-to-pdf={printed}", page.as_uri()]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=_PATIENCE, check=False)
    except subprocess.TimeoutExpired:
        raise UsageError(f"{browser} did not print within {_PATIENCE:.0f} s: write .html and print that") from None
    if not printed.is_file():
        said = done.stderr.strip().splitlines()
        raise UsageError(f"{browser} printed nothing: {said[-1] if said else f'exit code {done.returncode}'}")
