"""Run a command; turn errors into messages and exit codes.

stdout carries data, stderr carries talk. Exit codes: 0 ok, 1 bug, 2 usage, 3 invalid case,
4 solver failed, 5 partial result, 130 interrupted.
"""

from __future__ import annotations

import atexit
import gc
import inspect
import os
import sys
from collections.abc import Callable, Sequence
from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup

from lambda_cli.commands import Entry, entries, guarded, invoked
from lambda_cli.interrupt import second_signal_ends
from lambda_cli.plugin_option import with_plugin_option
from lambda_core.domain.errors import CaseError, LambdaError, UsageError
from lambda_core.domain.files import system_refusal
from lambda_core.domain.late_collection import postpone_collection
from lambda_core.domain.plugin_errors import PluginError, failures_so_far
from lambda_core.domain.printable import printable

PROGRAM = "lambda-bearing"
INTERRUPTED = 130
DEBUG_VARIABLE = "LAMBDA_BEARING_DEBUG"
# The core computes with one thread of a linear algebra library: here the others are not even started.
for _threads in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_threads, "1")
# An interpreter that ends looks for cycles among all that was imported and compiled: half a second for nothing.
atexit.register(gc.freeze)
postpone_collection(gc.freeze)  # it finds nothing to drop in what is imported


class LazyGroup(TyperGroup):
    """Group that imports only the called command.

    It knows the names and help of all its commands.
    """

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self._entries = entries()
        for entry in self._entries.values():
            self.add_command(TyperCommand(entry.name, help=entry.help, rich_help_panel=entry.panel))

    def get_help_option(self, ctx: Any) -> Any:
        """Return the option --help, which takes no value."""
        return _switch(super().get_help_option(ctx))

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[str | None, Any, list[str]]:
        """Find the command by name and load it."""
        name, command, rest = super().resolve_command(ctx, args)
        entry = self._entries.get(name or "")
        return name, _command(entry) if entry else command, rest


def _command(entry: Entry) -> Any:
    """Return the loaded command.

    A function becomes a command, a typer application a group.
    """
    with guarded(entry):
        loaded = entry.load()
        if not isinstance(loaded, typer.Typer):
            application = typer.Typer(add_completion=False)
            application.command(entry.name)(loaded)
            loaded = application
        command: Any = typer.main.get_command(loaded)
    command.name = entry.name
    if entry.distribution:
        command.invoke = invoked(command.invoke, entry)
    with_plugin_option(command)
    _for_reading(command)
    return command


def _for_reading(command: Any) -> None:
    """Let the terminal break the lines of a help.

    Breaks of the source are ignored; a switch takes no value, and its help shows none.
    """
    paragraphs = inspect.cleandoc(command.help or "").split("\n\n")
    command.help = "\n\n".join(" ".join(paragraph.split()) for paragraph in paragraphs)
    for parameter in command.params:
        if getattr(parameter, "is_flag", False) and parameter.metavar is None:
            parameter.metavar = ""
    asked = command.get_help_option
    command.get_help_option = lambda context: _switch(asked(context))
    for other in getattr(command, "commands", {}).values():
        _for_reading(other)


def _switch(option: Any) -> Any:
    """Return an option without a word for its value."""
    if option is not None:
        option.metavar = ""
    return option


application = typer.Typer(cls=LazyGroup, name=PROGRAM, no_args_is_help=True)


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(f"{PROGRAM} {version(PROGRAM)}")
        raise typer.Exit


@application.callback()
def _program(
    version: Annotated[
        bool,
        typer.Option("--version", metavar="", callback=_version, is_eager=True, help="Print the version and stop."),
    ] = False,
    no_plugin: Annotated[
        list[str] | None, typer.Option("--no-plugin", metavar="NAME", help="Switch a plugin off for this call.")
    ] = None,
) -> None:
    """Simulate rolling bearings and shafts: friction, lives, films, temperatures, currents.

    Start with: lambda-bearing run 6319-cp10-1500
    """
    if no_plugin:
        from lambda_core.api import switch_off

        switch_off(no_plugin)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program and return its exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        Command line without the program's name; default: that of the process.
    """
    os.environ.setdefault("PYTHONSAFEPATH", "1")  # processes started from here import nothing from where they stand
    with second_signal_ends(INTERRUPTED) as is_signalled:
        return _main(arguments, is_signalled)


def _main(arguments: Sequence[str] | None, is_signalled: Callable[[], bool]) -> int:
    try:
        failed = len(failures_so_far())
        outcome = application(args=arguments, prog_name=PROGRAM, standalone_mode=False)
        if outcome == INTERRUPTED:  # what typer makes of Ctrl+C
            _say("interrupted")
        ended = outcome if isinstance(outcome, int) else 0
        return ended or (PluginError.exit_code if failures_so_far()[failed:] else 0)
    except LambdaError as error:
        _say(error.on_command_line or str(error))
        return error.exit_code
    except (KeyboardInterrupt, typer.Abort):
        _say("interrupted")
        return INTERRUPTED
    except BrokenPipeError:
        # The reader (a pager, head) has gone: nothing more to say, not even at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except RecursionError:
        _say("the input is nested too deeply")
        return CaseError.exit_code
    except OSError as error:
        why = system_refusal(error)
        if not why:
            return _bug(error)
        _say(why)
        return UsageError.exit_code
    except Exception as error:
        if isinstance(code := getattr(error, "exit_code", None), int) and hasattr(error, "format_message"):
            _say_usage(error)
            return code
        if is_signalled():  # an interruption that a library turned into an error of its own
            _say("interrupted")
            return INTERRUPTED
        return _bug(error)


def _say(text: str) -> None:
    print(printable(text), file=sys.stderr)


def _say_usage(error: Any) -> None:
    """Print a usage error with the usage line."""
    context = getattr(error, "ctx", None)
    if context is not None:
        _say(context.get_usage())
        _say(f"Try '{context.command_path} --help' for help.")
    message = error.format_message()
    if message:
        _say(f"Error: {message}")
    if context is not None and context.info_name == "compare" and "unexpected extra argument" in message:
        from lambda_cli.compare import SIDE_BY_SIDE

        _say(SIDE_BY_SIDE)


def _bug(error: Exception) -> int:
    if os.environ.get(DEBUG_VARIABLE):
        import traceback

        traceback.print_exc()
    else:
        text = " ".join(str(error).split())
        _say(f"{PROGRAM} has a bug: {type(error).__name__}: {text}")
        _say(f"Set {DEBUG_VARIABLE}=1 to see where, and please report it with the command and the case file.")
    return LambdaError.exit_code
