"""Test that packages are found as they come and go."""

from __future__ import annotations

import os
from importlib import metadata
from pathlib import Path

import pytest

from lambda_core.domain import installed as subject
from lambda_core.domain.installed import PLUGINS, installed


def declare(site: Path, name: str, now: int) -> None:
    """Install a package with a plugin at a time [s]."""
    record = site / f"{name}-1.0.dist-info"
    record.mkdir()
    (record / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n", encoding="utf-8")
    (record / "entry_points.txt").write_text(f"[{PLUGINS}]\nmain = {name}\n", encoding="utf-8")
    os.utime(site, (now, now))


def test_a_package_that_comes_later_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(tmp_path))
    declare(tmp_path, "first", 1000)
    assert "first 1.0" in [source.distribution for source in installed(PLUGINS)]
    declare(tmp_path, "second", 2000)
    assert {"first 1.0", "second 1.0"} <= {source.distribution for source in installed(PLUGINS)}


def test_packages_are_read_once_while_nothing_changes(monkeypatch: pytest.MonkeyPatch) -> None:
    found, read = installed(PLUGINS), list[str]()
    monkeypatch.setattr(
        subject, "entry_points", lambda *, group: read.append(group) or metadata.entry_points(group=group)
    )
    assert installed(PLUGINS) == found
    assert not read
