"""What a launch file in Python reads of other files: YAML and JSON of the workspace, and which files there are."""

from __future__ import annotations

import json
from fnmatch import fnmatchcase

from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml
from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.launch_python.deferred import Deferred, Scope, resolve
from roslens.source.extract.launch_python.launch_values import Opened, Plain, as_value
from roslens.source.extract.symbolic.text import Text

_LOADS = frozenset({"yaml.safe_load", "yaml.load", "yaml.full_load", "yaml.unsafe_load"})
_OPENS = frozenset({"open", "io.open"})
_JSON = frozenset({"json.loads", "json.load"})
_FOUND = frozenset({"os.path.exists", "os.path.isfile", "os.path.lexists"})
_GLOBS = frozenset({"glob.glob", "glob.iglob"})
_PATH_GLOBS = {"pathlib.glob": "", "pathlib.rglob": "**/"}
READS = _LOADS | _OPENS | _JSON | _GLOBS | _FOUND
PATH_READS = {"open": "open", "read_text": "open", "read_bytes": "open", "exists": "os.path.exists",
              "is_file": "os.path.isfile", "glob": "pathlib.glob", "rglob": "pathlib.rglob"}  # fmt: skip
"""What methods of paths do, as functions that read."""
_MOST_BYTES = 1_000_000


def read(function: str, positional: list[Plain], path: str, files: Files | None, scope: Scope | None) -> Plain:
    """Return what opening or loading a file gives.

    Args:
        function: one of ``READS``, or of those that ``PATH_READS`` has.
        positional: its arguments.
        path: of the launch file.
        files: of the workspace.
        scope: of the action that is visited; None while the file is read.
    """
    reason = Unknown(f"result of {function}()")
    if files is None or not positional:
        return reason
    first, *rest = positional
    if function in _LOADS or function in _JSON:
        content = _content(first, files)
        return reason if content is None or len(content) > _MOST_BYTES else _loaded(function, content, reason)
    match first:
        case str() | Text() | Deferred():
            found = resolve(as_value(first), scope or Scope(files, {}, {}, path)).known
            return reason if found is None else _of_path(function, found, rest, files)
    return reason


def _of_path(function: str, path: str, rest: list[Plain], files: Files) -> Plain:
    """Return what a function gives that is asked for a path."""
    there = files.content(path) is not None
    if function in _OPENS and there:
        return Opened(path)
    if function in _FOUND and there:
        return True
    # What is not in the workspace may be made when it is built.
    return Unknown(f"result of {function}()") if function in _OPENS | _FOUND else _matching(function, path, rest, files)


def _matching(function: str, path: str, rest: list[Plain], files: Files) -> Plain:
    """Return the files of the workspace that match a pattern, in the order of their names; that of ``glob`` is open."""
    pattern = path
    if function in _PATH_GLOBS:
        match rest:
            case [str(below), *_]:
                pattern = f"{path}/{_PATH_GLOBS[function]}{below}"
            case _:
                return Unknown(f"result of {function}()")
    folder = joined("", pattern[: _first_sign(pattern)].rpartition("/")[0])
    found = [one for one in files.listing(folder) if _matches(one.split("/"), joined("", pattern).split("/"))]
    return sorted(found) or Unknown(f"files that match {pattern}, of which the workspace has none")


def _first_sign(pattern: str) -> int:
    return next((place for place, sign in enumerate(pattern) if sign in "*?["), len(pattern))


def _matches(pieces: list[str], pattern: list[str]) -> bool:
    """Whether a path matches a pattern, in which ``**`` stands for any number of folders."""
    if not pattern or not pieces:
        return not pattern and not pieces
    if pattern[0] == "**" and len(pattern) > 1:
        return _matches(pieces, pattern[1:]) or _matches(pieces[1:], pattern)
    hidden = pieces[0].startswith(".") and not pattern[0].startswith(".")
    return not hidden and fnmatchcase(pieces[0], pattern[0]) and _matches(pieces[1:], pattern[1:])


def _content(first: Plain, files: Files) -> bytes | None:
    match first:
        case Opened():
            return files.content(first.path)
        case str():
            return first.encode()
    return None


def _loaded(function: str, content: bytes, reason: Unknown) -> Plain:
    try:
        return _plain(json.loads(content) if function in _JSON else load_yaml(content))
    except (UnsafeYamlError, RecursionError, ValueError):
        return reason


def _plain(value: Plain) -> Plain:
    match value:
        case dict():
            return {
                key if isinstance(key, str | int | float | bool) else str(key): _plain(one)
                for key, one in value.items()
            }
        case list():
            return [_plain(one) for one in value]
        case str() | int() | float() | bool() | None:
            return value
    return str(value)
