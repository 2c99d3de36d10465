"""Paths of CMake as texts: ``get_filename_component()``, ``cmake_path()`` and ``aux_source_directory()``."""

from __future__ import annotations

import re
from collections.abc import Callable
from posixpath import basename, dirname, isabs, join, normpath, splitext

from roslens.source.extract.builds.cmake_evaluation import Call, Evaluation, Handler
from roslens.source.extract.builds.cmake_value import hole, is_unknown


def _filename_component(run: Evaluation, call: Call) -> None:
    if len(call.arguments) < 3:
        return
    variable, path, mode, *rest = call.arguments
    if "CACHE" in rest and run.variables.kept(variable):
        return
    if is_unknown(path):
        run.variables.set(variable, path)
        return
    if mode in ("ABSOLUTE", "REALPATH"):
        base = rest[rest.index("BASE_DIR") + 1] if "BASE_DIR" in rest[:-1] else run.absolute(run.where)
        run.variables.set(
            variable, hole(f"{mode} of {path}") if is_unknown(base) else _normal(join(base, path)).rstrip("/") or "/"
        )
        return
    plain = path.rstrip("/") or path
    name = basename(path)
    stem, dot, extension = name.partition(".")
    last, last_extension = _parted(name)
    simple = {
        "NAME": name, "NAME_WE": stem, "EXT": dot + extension, "LAST_EXT": last_extension, "NAME_WLE": last,
        "DIRECTORY": dirname(plain), "PATH": dirname(plain),
    }  # fmt: skip
    run.variables.set(variable, simple.get(mode, hole(f"{mode} of {path}")))


def _parted(name: str) -> tuple[str, str]:
    at = name.rfind(".")
    return (name, "") if at < 0 else (name[:at], name[at:])


def _normal(path: str) -> str:
    """Return a path without ``.``, ``..`` and slashes that are double; a slash at its end is kept."""
    if not path:
        return ""
    found = normpath(path)
    found = "/" + found.lstrip("/") if found.startswith("/") else found
    ends = path.endswith(("/", "/.", "/..")) or path in (".", "..")
    return f"{found}/" if ends and found not in ("/", ".", "..") and not found.endswith("/..") else found


_GETS: dict[str, Callable[[str], str]] = {
    "FILENAME": basename,
    "STEM": lambda path: _stem(basename(path)),
    "EXTENSION": lambda path: "" if basename(path) == ".." else basename(path)[len(_stem(basename(path))) :],
    "STEM LAST_ONLY": lambda path: _last_stem(basename(path)),
    "EXTENSION LAST_ONLY": lambda path: basename(path)[len(_last_stem(basename(path))) :],
    "PARENT_PATH": dirname,
    "ROOT_NAME": lambda _path: "",
    "ROOT_DIRECTORY": lambda path: "/" if path.startswith("/") else "",
    "ROOT_PATH": lambda path: "/" if path.startswith("/") else "",
    "RELATIVE_PART": lambda path: path.lstrip("/"),
}
_CHANGED: dict[str, Callable[[str, list[str]], str]] = {
    "APPEND": lambda path, rest: re.sub("/+", "/", join(path, *rest)),
    "APPEND_STRING": lambda path, rest: path + "".join(rest),
    "REMOVE_FILENAME": lambda path, _rest: path[: len(path) - len(basename(path))],
    "REPLACE_FILENAME": lambda path, rest: (dirname(path) and join(dirname(path), rest[0])) or rest[0],
    "NORMAL_PATH": lambda path, _rest: _normal(path),
}


def _stem(name: str) -> str:
    """Return a name up to its first dot, not counting one at its beginning."""
    return name[:at] if (at := name.find(".", 1)) > 0 else name


def _last_stem(name: str) -> str:
    """Return a name up to its last dot, not counting one at its beginning."""
    return name[:at] if (at := name.rfind(".")) > 0 and name != ".." else name


def _path(run: Evaluation, call: Call) -> None:
    if len(call.arguments) < 2:
        return
    action, name, *rest = call.arguments
    if action == "SET":
        _set(run, name, rest)
        return
    value = run.variables.get(name) or ""
    if action == "GET" or action.startswith(("HAS_", "IS_")):
        _asked(run, action, value, rest)
        return
    out = name
    if "OUTPUT_VARIABLE" in rest[:-1]:
        at = rest.index("OUTPUT_VARIABLE")
        out, rest = rest[at + 1], [*rest[:at], *rest[at + 2 :]]
    elif action in ("COMPARE", "CONVERT", "NATIVE_PATH", "HASH") and rest:
        out = rest[-1]
    if action == "ABSOLUTE_PATH" and not rest and "//" not in value:
        run.variables.set(out, value if is_unknown(value) else join(run.absolute(run.where), value))
    elif action in _CHANGED and not is_unknown(value + "".join(rest)) and ";" not in value and value != "//":
        run.variables.set(out, _CHANGED[action](value, rest))
    else:
        run.variables.set(out, hole(f"cmake_path({action})"))


def _set(run: Evaluation, name: str, rest: list[str]) -> None:
    value = rest[-1] if rest else ""
    run.variables.set(name, _normal(value) if "NORMALIZE" in rest[:-1] and not is_unknown(value) else value)


def _asked(run: Evaluation, action: str, value: str, rest: list[str]) -> None:
    """Set a variable to a part of a path, or to whether it has that part."""
    if not rest:
        return
    *words, out = rest
    found = hole(f"cmake_path({action})")
    part = _GETS.get(" ".join(words) if action == "GET" else action.removeprefix("HAS_"))
    if is_unknown(value):
        pass
    elif action in ("IS_ABSOLUTE", "IS_RELATIVE"):
        found = "ON" if isabs(value) is (action == "IS_ABSOLUTE") else "OFF"
    elif part is not None:
        found = part(value)
        if action != "GET":
            found = "ON" if found else "OFF"
    run.variables.set(out, found)


def _sources_in(run: Evaluation, call: Call) -> None:
    """Sources of a folder, as ``aux_source_directory()`` lists them."""
    if len(call.arguments) < 2:
        return
    given, variable = call.arguments[:2]
    folder = run.relative(given)
    if folder is None:
        run.variables.set(variable, hole(f"aux_source_directory() of {given}"))
        return
    prefix = f"{folder}/" if folder else ""
    names = sorted(
        path[len(prefix) :]
        for path in run.listing
        if path.startswith(prefix) and "/" not in path[len(prefix) :] and splitext(path)[1] in _SOURCES
    )
    before = run.variables.kept(variable)
    run.variables.set(
        variable, ";".join([*([before] if before else []), *(f"{given.rstrip('/')}/{name}" for name in names)])
    )


_SOURCES = frozenset({".c", ".C", ".c++", ".cc", ".cpp", ".cxx", ".m", ".M", ".mm", ".cu"})

PATHS: dict[str, Handler] = {
    "get_filename_component": _filename_component,
    "cmake_path": _path,
    "aux_source_directory": _sources_in,
}
