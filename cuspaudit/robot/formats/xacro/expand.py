"""A xacro file expanded to URDF, without ROS and without trusting the file.

The expansion is that of xacro, by xacrodoc, in a process of its own with a time limit.
There expressions are looked at before they are evaluated (`expressions`), files are
read in the folder of the file and in the packages that were named, and nowhere else;
nothing is written, no program is started and no socket is opened.
"""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from cuspaudit.errors import CuspauditError, InvalidRobotError, UnableError
from cuspaudit.robot.formats.xacro.expressions import refusal
from cuspaudit.robot.place import Place, listing, quoted
from cuspaudit.runtime.clock import Progress
from cuspaudit.runtime.own_process import run_in_own_process

__all__ = ["expanded"]

_SECONDS = 20.0
_BY_HAND = "expand it first: xacro FILE > robot.urdf"
_ADVICE = {
    "PackageNotFoundError": "name its folder by --package NAME=DIR",
    "ArgException": "give the argument by --xacro-arg NAME=VALUE",
}
_REFUSED = (
    *("socket.", "subprocess.", "os.system", "os.exec", "os.posix_spawn", "os.fork"),
    *("os.spawn", "os.remove", "os.rename", "os.mkdir", "os.rmdir", "os.link"),
    *("os.symlink", "os.truncate", "os.chmod", "os.chown", "os.putenv", "shutil."),
    *("ctypes.", "pty.", "webbrowser.", "urllib.", "http.", "ftplib.", "smtplib."),
)


def expanded(
    path: Path, packages: Mapping[str, str], arguments: Mapping[str, str]
) -> str:
    """The URDF that a xacro file expands to.

    Args:
        path: the file.
        packages: name to folder, for ``$(find NAME)``.
        arguments: name to text, for ``$(arg NAME)``; the file must ask for each.

    Raises:
        InvalidRobotError: xacrodoc is not installed, the file is not there, or it does
            not expand as it stands.
    """
    place = Place(str(path))
    if not path.is_file():
        raise place.error("no such file", "give a readable file")
    if importlib.util.find_spec("xacrodoc") is None:
        expected = f"pip install 'cuspaudit[xacro]', or {_BY_HAND}"
        raise place.error("a xacro file", expected)
    for name, folder in packages.items():
        if not Path(folder).is_dir():
            found = f"no folder {quoted(folder)} for the package {quoted(name)}"
            raise place.error(found, "give --package NAME=DIR with a folder")
    work = partial(_expand, path.resolve(), dict(packages), dict(arguments), place)
    try:
        text: str = run_in_own_process(work, timeout=_SECONDS)
    except UnableError:
        found = f"its expansion took more than {_SECONDS:g} s, or died"
        raise place.error(found, _BY_HAND) from None
    return text


class _Asked(dict[str, str]):
    """Arguments that remember which of them the file asked for."""

    def __init__(self, given: Mapping[str, str]) -> None:
        super().__init__(given)
        self.asked: set[object] = set()

    def __contains__(self, name: object) -> bool:
        self.asked.add(name)
        return super().__contains__(name)

    def __getitem__(self, name: str) -> str:
        self.asked.add(name)
        return super().__getitem__(name)


def _expand(
    path: Path,
    packages: Mapping[str, str],
    arguments: Mapping[str, str],
    place: Place,
    progress: Progress,
) -> str:
    """The expansion, in the child."""
    import xacro
    import xacrodoc
    import xacrodoc.packages
    from xacro import substitution_args

    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)
    trusted = xacro.safe_eval

    def safe_eval(text: str, *scopes: Any) -> Any:
        why = refusal(text)
        if why is not None:
            raise _RefusedError(f"the expression {quoted(text)} holds {why}")
        return trusted(text, *scopes)

    def no_eval(text: str, context: Any) -> str:
        raise _RefusedError(f"$(eval {text[:40]}) is not evaluated")

    xacro.safe_eval = safe_eval
    substitution_args._eval = no_eval
    xacrodoc.packages.update_package_cache(
        {name: str(Path(folder).resolve()) for name, folder in packages.items()}
    )
    folders = [path.parent, *(Path(folder).resolve() for folder in packages.values())]
    sys.addaudithook(partial(_audit, [str(folder) for folder in folders]))
    given = _Asked(arguments)
    try:
        read = partial(xacrodoc.XacroDoc.from_file, walk_up=False, subargs=given)
        found: str = read(path).to_urdf_string()
    except CuspauditError:
        raise
    except BaseException as error:
        raise _told(error, place) from None
    _check_asked(given, arguments, place)
    return found


def _check_asked(given: _Asked, arguments: Mapping[str, str], place: Place) -> None:
    """Check that the file asks for each argument.

    Raises:
        InvalidRobotError: for one it does not.
    """
    other = [name for name in arguments if name not in given.asked]
    if other:
        names = sorted(str(name) for name in given.asked)
        expected = f"it asks for {listing(names)}" if names else "leave it out"
        raise place.error(f"no argument is named {quoted(other[0])}", expected)


class _RefusedError(Exception):
    """What the file wants is not done."""


def _audit(folders: Sequence[str], event: str, arguments: tuple[Any, ...]) -> None:
    """Stop what an expansion has no business with."""
    if event == "open":
        name, mode, flags = arguments
        if isinstance(name, int):
            return
        writes = bool(set(str(mode or "")) & set("wax+"))
        if isinstance(flags, int) and flags & (os.O_WRONLY | os.O_RDWR):
            writes = True
        where = os.path.realpath(os.fspath(name))
        roots = [*map(os.path.realpath, folders), *_python()]
        inside = any(where == root or where.startswith(root + os.sep) for root in roots)
        if writes or not inside:
            raise _RefusedError(
                f"it opens {quoted(str(where))}, outside the folders given"
            )
    elif event.startswith(_REFUSED):
        raise _RefusedError(f"it asks for {event}")


def _python() -> list[str]:
    """Where Python and its packages are, whose modules an import opens."""
    return [os.path.realpath(place) for place in {sys.prefix, sys.base_prefix}]


def _told(error: BaseException, place: Place) -> InvalidRobotError:
    """The error in one line: what stopped it first, and what to do."""
    chain = [error]
    while True:
        last = chain[-1]
        cause = getattr(last, "exc", None) or last.__cause__ or last.__context__
        if cause is None or cause in chain:
            break
        chain.append(cause)
    own = [each for each in chain if isinstance(each, _RefusedError)]
    text = " ".join(str((own or chain)[-1]).split())[:200]
    unset = [each for each in chain if type(each).__name__ == "ArgException"]
    if unset:
        text = f"the argument {quoted(str(unset[0]))} has no value"
    kinds = {type(each).__name__ for each in chain}
    for kind, expected in _ADVICE.items():
        if kind in kinds:
            return place.error(text or kind, expected)
    return place.error(text or type(error).__name__, _BY_HAND)
