"""What people call a program, by the words it was started with."""

from __future__ import annotations

import re

_INTERPRETER = re.compile(r"(python|pypy|ruby|perl|node|bash|sh|dash)[0-9.]*")


def command_name(command: str) -> str:
    """Return the name of a program: of a script that of the script, of a module that of the module; else empty."""
    words = command.split()
    if not words:
        return ""
    program = _last(words[0])
    if _INTERPRETER.fullmatch(program) is None:
        return program
    rest = iter(words[1:])
    for word in rest:
        if word == "-m":
            return next(rest, program)
        if word == "-c":
            return f"{program} -c"
        if not word.startswith("-"):
            return _last(word)
    return program


def _last(path: str) -> str:
    return path.rstrip("/").rpartition("/")[2]
