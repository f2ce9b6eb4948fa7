"""Add bearings of an invented maker.

With an oil, a comparison method, a view and a command.
"""

from pathlib import Path

from lambda_core.plugins import hookimpl


@hookimpl
def lambda_data(register):
    register(Path(__file__).parent / "rows")


@hookimpl
def lambda_methods(register):
    from northwind_bearings.method import STRIBECK

    register(STRIBECK)


@hookimpl
def lambda_views(register):
    from northwind_bearings.view import LOAD_SHARE

    register(LOAD_SHARE)
