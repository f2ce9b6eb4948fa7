"""Define the option ``--plugin FILE.py`` of every command."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from lambda_core.domain.processes import command_line

_HELP = "Also use the laws of this file; may be repeated."


_taken: list[str] = []  # files that this command was given


def take_plugins(files: list[str] | None) -> None:
    """Take the named files into use before the command begins."""
    if files:
        _taken.extend(files)
        from lambda_core.api import use_plugin

        for file in files:
            use_plugin(file)


def taken_options() -> str:
    """Return the options of the named plugin files.

    They serve a command that goes on with its work.
    """
    return "".join(f" {command_line(['--plugin', file])}" for file in dict.fromkeys(_taken))


def _with_option(
    plugin: Annotated[
        list[str] | None,
        typer.Option("--plugin", metavar="FILE", help=_HELP, callback=take_plugins, is_eager=True),
    ] = None,
) -> None:
    """Have the option and nothing else."""


def with_plugin_option(command: Any) -> None:
    """Give the option to a command or group.

    In a group, every command gets it.
    """
    below = getattr(command, "commands", None)
    if below is not None:
        for other in below.values():
            with_plugin_option(other)
    elif not any("--plugin" in parameter.opts for parameter in command.params):
        pattern = typer.Typer(add_completion=False)
        pattern.command()(_with_option)
        option = next(each for each in typer.main.get_command(pattern).params if "--plugin" in each.opts)
        option.expose_value = False
        command.params.append(option)


def named_plugin(name: str) -> str:
    """Return the name of a plugin.

    Naming a file takes it into use.
    """
    if not name.endswith(".py"):
        return name
    take_plugins([name])
    return Path(name).name
