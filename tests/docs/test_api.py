"""The door: what type checkers see in it, and what it hands out, are the same."""

from __future__ import annotations

import ast
import inspect

from lambda_core import api


def test_types_and_names_agree() -> None:
    """The imports for type checkers name the same modules as the table of the names that are looked up."""
    tree = ast.parse(inspect.getsource(api))
    block = next(node for node in tree.body if isinstance(node, ast.If))
    seen = {alias.name: line.module for line in block.body if isinstance(line, ast.ImportFrom) for alias in line.names}
    assert seen == {name: f"lambda_core.{room}" for name, room in api._HOME.items()}
    assert all(getattr(api, name) is not None for name in seen)
