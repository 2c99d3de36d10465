"""Paths in launch files in Python: ``os.path``, ``pathlib`` and ``glob``, on the texts that paths are here.

A path of a package is the folder that its source is in: what is installed below ``share`` keeps its place there.
"""

from __future__ import annotations

from collections.abc import Callable

from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.launch_python.launch_action import text
from roslens.source.extract.launch_python.launch_values import Plain, as_value
from roslens.source.extract.symbolic.text import Text, said, unknown

CONSTANTS = {
    **dict.fromkeys(("os.sep", "os.path.sep", "posixpath.sep"), "/"),
    **dict.fromkeys(("os.pardir", "os.path.pardir"), ".."),
    **dict.fromkeys(("os.curdir", "os.path.curdir"), "."),
    "os.extsep": ".",
    "os.linesep": "\n",
    "os.pathsep": ":",
}
"""What modules of the standard library have, on Linux."""
_MOST_PARENTS = 20


def member_of_path(of: Text | Deferred, name: str) -> Plain:
    """Return a member of a path; None where a path has none of that name."""
    if name == "parent":
        return parent(of)
    if name == "parents":
        found = [parent(of)]
        for _ in range(_MOST_PARENTS):
            found.append(parent(found[-1]))
        return found
    part = _PARTS.get(name)
    match of:
        case _ if part is None:
            return None
        case Deferred():
            return Unknown(f"{name} of a path")
    return _of_last(of, part)


def path_method(of: Plain, name: str, positional: list[Plain]) -> Plain:
    """Return what a method of a path returns; None where a path has none of that name, or nothing is known of it."""
    match name, positional:
        case (("as_posix" | "resolve" | "absolute" | "expanduser" | "__str__" | "__fspath__"), _):
            return of
        case "joinpath", _:
            return join(of, *positional)
        case "with_name", [str(given)]:
            return join(parent(of), given)
        case "with_suffix", [str(given)]:
            return _replaced_end(of, lambda last: f"{_stem(last)}{given}")
        case "with_stem", [str(given)]:
            return _replaced_end(of, lambda last: f"{given}{_suffix(last)}")
        case "is_absolute", []:
            # Packages and the launch file are at absolute places of whatever machine runs it.
            return None
    return None


def join(*values: Plain) -> Deferred:
    """Return paths one below the other, as ``os.path.join`` has them."""
    return Deferred("path", tuple(as_value(one) for one in values))


def parent(value: Plain) -> Plain:
    """Return the folder of a path.

    Raises:
        ValueError: it is no path.
    """
    match value:
        case Deferred() if value.kind == "file":
            return Deferred("folder")
        case Deferred():
            return Deferred("path", (value, ".."))
        case str():
            return value.rpartition("/")[0]
        case Text():
            if "/" in value.tail:
                return Text.of(*value.before, value.tail.rpartition("/")[0])
            return Text.of(value, "/..") if value.known is None else Text.of(value.known.rpartition("/")[0])
    raise ValueError


def base_name(value: Plain) -> Plain:
    """Return the last part of a path.

    Raises:
        ValueError: it is no path.
    """
    return _of_last(_text(value), lambda last: last)


def split_path(value: Plain) -> Plain:
    """Return a path without its last part, and that.

    Raises:
        ValueError: it is no path.
    """
    return [parent(value), base_name(value)]


def split_ending(value: Plain) -> Plain:
    """Return a path without the ending of its last part, and that.

    Raises:
        ValueError: it is no path.
    """
    path = _text(value)
    ending = _of_last(path, _suffix)
    if ending.known is None:
        return [unknown(said("a part of ", path)), ending]
    return [Text.of(*path.before, path.tail.removesuffix(ending.known)), ending]


def _text(value: Plain) -> Text:
    match value:
        case str():
            return Text.of(value)
        case Text():
            return value
    raise ValueError


def _of_last(path: Text, part: Callable[[str], str]) -> Text:
    """Return a part of the last part of a path."""
    last = path.tail.rstrip("/")
    return Text.of(part(last.rpartition("/")[2])) if "/" in last or path.known else unknown(said("a part of ", path))


def _replaced_end(of: Plain, change: Callable[[str], str]) -> Plain:
    match of:
        case str() | Text():
            last = _of_last(_text(of), lambda one: one).known
            return None if last is None else join(parent(of), change(last))
    return None


def _suffix(last: str) -> str:
    stem, dot, suffix = last.rpartition(".")
    return f"{dot}{suffix}" if stem and suffix else ""


def _stem(last: str) -> str:
    return last.removesuffix(_suffix(last)) if _suffix(last) else last


_PARTS: dict[str, Callable[[str], str]] = {
    "name": lambda last: last,
    "stem": _stem,
    "suffix": _suffix,
}
PATHS: dict[str, Callable[..., Plain]] = {
    "os.path.join": join,
    "os.path.dirname": parent,
    "os.path.basename": base_name,
    "os.path.split": split_path,
    "os.path.splitext": split_ending,
    **dict.fromkeys(("pathlib.Path", "pathlib.PurePath", "pathlib.PosixPath", "pathlib.PurePosixPath"), join),
    **dict.fromkeys(
        ("os.path.abspath", "os.path.realpath", "os.path.normpath", "os.path.expanduser", "os.path.expandvars",
         "os.fspath", "os.fsdecode"),
        lambda value, *_rest, **_named: text(as_value(value)),
    ),
}  # fmt: skip
"""Functions that make paths of paths, by whole names."""
