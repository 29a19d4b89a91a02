"""The command line: every command hangs here, and every error ends here as one line."""

import logging
import os
import signal
import sys
import warnings
from io import TextIOWrapper
from threading import Event
from types import FrameType
from typing import Annotated

import typer

from fieldnav import __version__
from fieldnav.__main__ import ENDING, INTERRUPTED
from fieldnav.cli.bench import bench
from fieldnav.cli.check import check
from fieldnav.cli.console import FAILED, drop, print_error
from fieldnav.cli.count import count
from fieldnav.cli.ctl import ctl
from fieldnav.cli.detect import detect
from fieldnav.cli.diagram import diagram
from fieldnav.cli.log.app import log
from fieldnav.cli.profiles import profiles
from fieldnav.cli.replay import replay
from fieldnav.cli.run import run as drive
from fieldnav.cli.simulate import simulate
from fieldnav.errors import FieldnavError

QUIET = {"OPENCV_LOG_LEVEL": "SILENT", "OPENCV_FFMPEG_LOGLEVEL": "-8"}
"""What OpenCV reads when it is loaded; -8 is FFmpeg's "quiet"."""
OK = 0
"""Exit status of what is done."""

UsageError: type[Exception] = typer.BadParameter.__mro__[2]
"""What typer raises for a wrong option; its own name is private in some versions of typer."""

app = typer.Typer(
    name="fieldnav",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _print_version(wanted: bool) -> None:
    if wanted:
        print(f"fieldnav {__version__}")
        raise typer.Exit


@app.callback()
def fieldnav(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Drive a four-wheel-steer robot through a row-crop field, by sight alone.

    Begin with: fieldnav simulate demo
    """


app.command()(simulate)
app.command("run")(drive)
app.add_typer(ctl)
app.command()(detect)
app.command()(count)
app.command()(check)
app.add_typer(log)
app.command()(replay)
app.add_typer(bench)
app.add_typer(profiles)
app.command()(diagram)


def run(arguments: list[str] | None = None) -> int:
    """Run a command; returns the exit status and never lets an error through as a traceback."""
    try:
        status = app(arguments, prog_name="fieldnav", standalone_mode=False)
        sys.stdout.flush()
    except FieldnavError as error:
        print_error(str(error))
        return FAILED
    except (KeyboardInterrupt, typer.Abort):
        status = INTERRUPTED  # some versions of typer return it instead
    except (BrokenPipeError, SystemExit) as left:
        # The reader has gone, as `head` does; typer makes an exit of it when a command hears of it first.
        if isinstance(left, SystemExit) and not isinstance(left.__context__, BrokenPipeError):
            raise
        drop(sys.stdout)
        return OK
    except OSError as error:
        # A disk that is full while a command prints; whatever else is written says so where it is written.
        drop(sys.stdout)
        print_error(f"{error.filename or 'standard output'}: cannot be written: {error.strerror or error}")
        return FAILED
    except UsageError as error:
        if line := _usage(error):
            print_error(line)
        return FAILED
    if status == INTERRUPTED:
        print_error("interrupted")
    return status if isinstance(status, int) else OK


def _fill_closed_streams() -> None:
    """Give a stream that the caller has closed something to fail at, or nobody's ear to talk to.

    Else the next file that is opened takes its number, and what is printed goes into it.
    """
    if sys.stdout is None:
        sys.stdout = open(os.devnull, encoding="utf-8")  # noqa: SIM115 - whatever is printed fails
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115 - for as long as the process lives


def _usage(error: Exception) -> str:
    """A usage error and the way to the command's help; empty when that help has been shown already."""
    message = error.format_message() if hasattr(error, "format_message") else str(error)
    message = str(message).replace("Value error, ", "")  # pydantic's prefix
    if not message:
        return ""
    context = getattr(error, "ctx", None)
    path = context.command_path if context else "fieldnav"
    return f"{message.rstrip('.')}; see {path} --help"


def main() -> None:
    """Run the command of this process's own arguments, and exit."""
    _fill_closed_streams()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # a file's name may hold what the terminal cannot show
            stream.reconfigure(errors="backslashreplace")
    _quieten_libraries()
    signalled = _raising_signals()
    try:
        status = run()
    except (Exception, KeyboardInterrupt):  # a library may have made another error of the interruption
        if not signalled.is_set():
            raise
        print_error("interrupted")
        status = INTERRUPTED
    finally:
        try:
            sys.stdout.flush()
        except OSError:  # what is the matter has been said
            drop(sys.stdout)
        for number in ENDING:  # what is left to do is the interpreter's, whose words nobody understands
            if signal.getsignal(number) is not signal.SIG_IGN:
                signal.signal(number, signal.SIG_DFL)
    sys.exit(status)


def _quieten_libraries() -> None:
    """Keep other people's words off standard error: what a person should know, fieldnav says.

    Matplotlib complains of a cache that it cannot write and of letters that its font has not, OpenCV and
    FFmpeg of files. What the user has asked for by the environment or by -W is left as it is.
    """
    if not sys.warnoptions:
        warnings.simplefilter("ignore")
    logging.getLogger().addHandler(logging.NullHandler())
    for name, level in QUIET.items():
        os.environ.setdefault(name, level)


def _raising_signals() -> Event:
    """Let every signal that ends a program do what Ctrl-C does; gives an event that the first one sets."""
    signalled = Event()

    def interrupt(number: int, frame: FrameType | None) -> None:
        signalled.set()
        raise KeyboardInterrupt

    for number in ENDING:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, interrupt)
    return signalled
