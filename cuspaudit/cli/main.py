"""The way into the command line, and the only way out of it: one line, one exit code.

Nothing heavy is imported here, so that an interruption while the commands load ends as
quietly as one later.
"""

from __future__ import annotations

import os
import signal
import sys
from types import FrameType
from typing import NoReturn

import cuspaudit.runtime.waiting  # noqa: F401 - it counts from here
from cuspaudit.cli.exit_codes import BAD_INPUT, INTERRUPTED, UNFORESEEN

__all__ = ["main"]


def main() -> NoReturn:
    """Run the command line and end the process; nobody sees a traceback unasked.

    ``--debug`` may stand anywhere; it adds the traceback of an error that nobody
    foresaw. Such an error exits 4, never 1, which means cuspidal.
    """
    arguments = [word for word in sys.argv[1:] if word != "--debug"]
    interrupted = _interruption()
    try:
        code = _run(arguments, debug=len(arguments) < len(sys.argv) - 1)
    except KeyboardInterrupt:
        code = INTERRUPTED
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the rest is quick
    if interrupted or code == INTERRUPTED:
        _say("interrupted; what was finished is kept, and no file is half written")
        code = INTERRUPTED
    sys.exit(code)


def _interruption() -> list[int]:
    """A list that is no longer empty once this process was interrupted.

    Libraries swallow a KeyboardInterrupt now and then, or turn it into another error;
    the list forgets none. Processes begun by this one end without a word.
    """
    met: list[int] = []
    own = os.getpid()

    def interrupt(number: int, frame: FrameType | None) -> None:
        if os.getpid() != own:
            os._exit(INTERRUPTED)
        met.append(number)
        raise KeyboardInterrupt

    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, interrupt)
    return met


def _run(arguments: list[str], debug: bool) -> int:
    """The exit code of the command that ``arguments`` name."""
    from cuspaudit.errors import CuspauditError, unforeseen

    try:
        from cuspaudit.cli.app import app_for

        app_for(arguments)(arguments)
    except SystemExit as end:
        return _code(end)
    except CuspauditError as error:
        _say(str(error))
        return BAD_INPUT
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BAD_INPUT
    except Exception as error:  # the last door: whatever it is, it is one line
        if debug:
            import traceback

            traceback.print_exc()
        if isinstance(error, ImportError) and not _is_ours(error):
            _say(f"a library cannot be loaded: {error}; install cuspaudit again by pip")
            return BAD_INPUT
        _say(unforeseen(error) + ("" if debug else "; --debug shows the traceback"))
        return UNFORESEEN
    return 0


def _code(end: SystemExit) -> int:
    """The exit code; a text instead of one is an error's."""
    if end.code is None or isinstance(end.code, int):
        return end.code or 0
    _say(end.code)
    return UNFORESEEN


def _is_ours(error: ImportError) -> bool:
    return error.name is not None and error.name.partition(".")[0] == "cuspaudit"


def _say(text: str) -> None:
    print(f"cuspaudit: {' '.join(text.split())}", file=sys.stderr)
