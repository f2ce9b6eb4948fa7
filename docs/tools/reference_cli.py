"""Write the command reference from the commands."""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum
from typing import Any

import tables as md
from lambda_cli.commands import entries
from lambda_cli.main import PROGRAM, application
from lambda_cli.main import _command as load
from typer.main import get_command

_INTRODUCTION = f"""# Command reference

This page lists every command and option of `{PROGRAM}`, for users of the command line and authors of scripts.
`{PROGRAM} COMMAND --help` prints the same. Data go to standard output, everything else to standard error, so that
`--json` and redirection give clean data. [Exit codes](../errors.md#exit-codes) tell how a command ended.

```console
$ {PROGRAM} quasistatic 6208-axial-1300 --set "operation.speed=3000 rpm"
...
power loss       80 W ...
...
```
"""
_SHELL = ("--install-completion", "--show-completion")


def cli_page() -> str:
    """Return the whole page."""
    lines = [_INTRODUCTION, "## Before any command", ""]
    lines += [f"`{PROGRAM} [OPTIONS] COMMAND [ARGS]...`", "", *_parameters(get_command(application))]
    for entry in entries().values():
        if entry.panel == "Commands":
            for path, command in _commands(entry.name, load(entry)):
                lines += _section(path, command)
    return md.page(lines)


def _commands(path: str, command: Any) -> Iterator[tuple[str, Any]]:
    """Yield a command and those below it."""
    yield path, command
    for name, child in getattr(command, "commands", {}).items():
        yield from _commands(f"{path} {name}", child)


def _section(path: str, command: Any) -> list[str]:
    arguments = [p for p in command.params if p.param_type_name == "argument"]
    words = " ".join(_shown(p) for p in arguments)
    rest = "COMMAND ..." if getattr(command, "commands", None) else f"[OPTIONS] {words}".rstrip()
    level = "##" if " " not in path else "###"
    told = "\n\n".join(" ".join(part.split()) for part in (command.help or "").split("\n\n"))
    return [f"{level} `{path}`", "", f"`{PROGRAM} {path} {rest}`", "", told, "", *_parameters(command)]


def _shown(argument: Any) -> str:
    name = str(argument.metavar or argument.name.upper()).strip("[].")
    name = f"{name}..." if argument.nargs == -1 else name
    return name if argument.required else f"[{name}]"


def _parameters(command: Any) -> list[str]:
    rows = []
    for parameter in command.params:
        if parameter.param_type_name == "argument":
            rows.append([md.code(_shown(parameter)), "", md.cell(parameter.help or "")])
        elif not set(parameter.opts) & {"--help", *_SHELL}:
            rows.append([_flags(parameter), _default(parameter), md.cell(parameter.help or "")])
    return md.table(("argument or option", "default", "meaning"), rows) if rows else []


def _flags(option: Any) -> str:
    names = ", ".join(md.code(name) for name in (*option.opts, *option.secondary_opts))
    if option.is_flag or option.count:
        return names
    kind = option.type_descriptor.annotation
    if option.metavar is None and isinstance(kind, type) and issubclass(kind, Enum):
        return f"{names} {' or '.join(str(choice.value) for choice in kind)}"
    return f"{names} {md.cell(option.metavar or option.name.upper())}"


def _default(option: Any) -> str:
    value = option.default
    if value in (None, "", False, ()) or callable(value) or option.is_flag:
        return ""
    return md.code(str(getattr(value, "value", value)))
