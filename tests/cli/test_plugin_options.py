"""Test that resume commands name the plugin files."""

from __future__ import annotations

import pytest
from lambda_cli import plugin_option


def test_the_way_to_go_on_names_the_plugin_files(monkeypatch: pytest.MonkeyPatch) -> None:
    taken: list[str] = []
    monkeypatch.setattr(plugin_option, "_taken", [])
    monkeypatch.setattr("lambda_core.api.use_plugin", taken.append)
    assert plugin_option.taken_options() == ""
    plugin_option.take_plugins(["my laws.py", "other.py"])
    plugin_option.take_plugins(["other.py"])
    assert plugin_option.taken_options() == " --plugin 'my laws.py' --plugin other.py"
    assert taken == ["my laws.py", "other.py", "other.py"]
