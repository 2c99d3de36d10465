"""What a file has for others by its names: what it defines, includes and imports, without what functions do.

As long as the outlines of all files of a workspace are the same, a name means the same at every place in them. A line
that moves, or another body of a function, changes no outline.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

import msgspec

from roslens.source.extract.ir.program import Call, Class, Evaluate, Function, Name, Program
from roslens.source.extract.transfer.class_attributes import set_on_classes
from roslens.source.keys import analyser_version, key_of
from roslens.store.cache import Cache

_NONE = msgspec.msgpack.encode({})


def outline_key(program: Program) -> str:
    """Return a key of all that a symbol table knows of a file without handing it out."""
    python = program.language == "python"
    return key_of(
        program.language,
        [_class(one, python=python) for one in program.classes],
        [_function(one) for one in program.functions if one.name != "lambda"],
        any(one.body for one in program.functions if one.name == "lambda"),
        [(name, value is None if python else value) for name, value in program.variables()],
        [] if python else [_called(one) for one in program.body if isinstance(one, Evaluate)],
        program.macros,
        list(program.imports.items()),
        program.using,
        [header for header, _line in program.includes],
        [msgspec.structs.replace(one, line=0) for one in program.declarations],
        sorted(set_on_classes(program)) if program.dialect.modules_run else [],
    )


class Outline(NamedTuple):
    """What is known of a program without reading it: a key of its content, and one of its outline."""

    content: str
    outline: str


class Readable(NamedTuple):
    """Programs by path with keys of their content, and whether the next run would find the same."""

    programs: Mapping[str, tuple[str, Program]]
    lasting: bool


_decode = msgspec.msgpack.Decoder(dict[str, Outline]).decode


def known_outlines(
    keys: Mapping[str, str], version: str, cache: Cache, read: Callable[[], Readable]
) -> dict[str, Outline]:
    """Return the outlines of programs by path; those that the cache does not know are made and kept.

    Args:
        keys: of programs, by path.
        version: of ROS for which they are.
        cache: what earlier runs learned.
        read: returns the programs; called where one is not known.
    """
    place = f"graph:outlines:{key_of(analyser_version(), version)}"
    try:
        known = _decode(cache.get((place,)).get(place, _NONE))
    except msgspec.DecodeError:
        known = {}  # What a damaged cache holds is made again.
    if known.keys() >= set(keys.values()):
        return {path: known[key] for path, key in keys.items()}
    readable = read()
    if not readable.lasting:
        # A file that changed meanwhile has another content than its key says.
        return {path: Outline(content, outline_key(one)) for path, (content, one) in readable.programs.items()}
    found = {
        path: known.get(keys[path]) or Outline(content, outline_key(program))
        for path, (content, program) in readable.programs.items()
    }
    cache.replace({place: msgspec.msgpack.encode({keys[path]: one for path, one in found.items()})})
    return found


def _class(one: Class, *, python: bool) -> tuple[object, ...]:
    fields = [(field.name, field.type, field.value is None if python else field.value) for field in one.fields]
    return one.qualified_name, one.bases, fields, one.templates, one.base_templates


def _function(one: Function) -> tuple[object, ...]:
    parameters = len(one.parameters)
    kind = (one.local, one.hands, one.specialised, one.templates)
    return one.qualified_name, one.name, one.class_name, parameters, bool(one.body), bool(one.initialisers), kind


def _called(one: Evaluate) -> object:
    """Return a call outside of functions, as that of a macro that registers a class, without its place."""
    match one.expression:
        case Call(function=Name(name=name), arguments=arguments):
            return name, [getattr(argument, "name", "") for argument in arguments]
    return ""
