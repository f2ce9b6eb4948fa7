"""Test that type checkers and users see the same API."""

from __future__ import annotations

import ast
import inspect

from lambda_core import api


def test_types_and_names_agree() -> None:
    """Compare the API's names with those for type checkers."""
    tree = ast.parse(inspect.getsource(api))
    blocks = [node.body for node in tree.body if isinstance(node, ast.If)]
    lines = [line for block in blocks for line in block if isinstance(line, ast.ImportFrom)]
    seen = {alias.name: line.module for line in lines for alias in line.names}
    assert seen == api._HOME
    assert len(blocks) == 2
    assert all(getattr(api, name) is not None for name in seen)
