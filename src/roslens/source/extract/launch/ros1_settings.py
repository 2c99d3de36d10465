"""Parameters of a launch file of ROS 1: ``<param>`` and ``<rosparam>`` (wiki.ros.org/roslaunch/XML)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Protocol

import msgspec

from roslens.model.errors import DocumentError
from roslens.source.extract.facts.files import joined
from roslens.source.extract.facts.launched import Fault, Setting
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch.refused_yaml import yaml_refusal
from roslens.source.extract.launch.ros1_substitution import (
    Scope,
    SubstitutionError,
    UnknownInsideError,
    needed,
    substitute,
)
from roslens.source.extract.parameters.parameter_file import ros1_parameters
from roslens.source.extract.parameters.ros1_values import AUTO, converted, type_of_value
from roslens.source.extract.symbolic.text import Hole, Text, unknown
from roslens.source.workspace.elements import Element

_SOURCES = ("value", "textfile", "binfile", "command")
_TEXTS = frozenset({"str", "string"})
_MOST_OF_FILE = 200
"""Bytes of a ``textfile`` that are taken for a value; a longer one is a text of which no more is said."""
_COMMANDS = frozenset({"load", "dump", "delete"})


class Miss(Protocol):
    """Notes what could not be read, and why it is certain to fail."""

    def __call__(self, element: Element, text: str, reason: str, *, fault: Fault | None = None) -> None:
        """Note it at an element."""


class Reading(msgspec.Struct, frozen=True):
    """What is needed to read parameters: the scope of substitutions, the file, places in it, and where misses go."""

    scope: Scope
    path: str
    place: Callable[[Element], Evidence]
    miss: Miss


def of_param(element: Element, reading: Reading) -> list[Setting]:
    """Return what a ``<param>`` sets.

    Raises:
        SubstitutionError: roslaunch refuses it.
    """
    given = element.attributes
    name = substitute(needed(element, "name").strip(), reading.scope)
    sources = [one for one in _SOURCES if one in given]
    if len(sources) != 1:
        found = f"{' and '.join(sources)} are given" if sources else "no value is given"
        reading.miss(element, f"<param name={name}>", f"{found}; expected one of {', '.join(_SOURCES)}")
        return []
    (source,) = sources
    kind = (given.get("type") or AUTO).lower().strip()
    text = substitute(given[source], reading.scope)
    place = reading.place(element)
    if source == "value":
        return _of_value(name, _stripped(text), kind, place, reading)
    if source == "command":
        type_ = "string" if kind in _TEXTS or "xacro" in text.pattern else ""
        return [Setting(name, unknown(f"output of {text}"), place, type_, words=_split(text))]
    content = _content(text, reading) if source == "textfile" else None
    if content is not None and len(content) <= _MOST_OF_FILE:
        # roslaunch strips what stands in the launch file, not what stands in another one.
        return _of_value(name, Text.of(content.decode("utf-8", "replace")), kind, place, reading)
    type_ = "string" if content is not None or kind in _TEXTS else ""
    return [Setting(name, unknown(f"content of {text}"), place, type_, words=(Text.of("cat"), text))]


def _content(path: Text, reading: Reading) -> bytes | None:
    return None if path.known is None else reading.scope.files.content(joined("", path.known))


def _of_value(name: Text, value: Text, kind: str, place: Evidence, reading: Reading) -> list[Setting]:
    known = value.known
    if kind == "yaml":
        if known is None:
            return [Setting(name, value, place)]
        return _of_yaml(known.encode(), name, reading.path, place)
    if known is None:
        return [Setting(name, value, place, "string" if kind in _TEXTS else "" if kind == AUTO else kind)]
    try:
        type_ = type_of_value(known, kind)
    except ValueError as error:
        raise SubstitutionError(str(error)) from None
    if type_ == "bool":
        value = Text.of("true" if known.strip().lower() in ("true", "1") else "false")
    elif type_ != "string" and kind == AUTO:
        value = Text.of(str(converted(known)))
    return [Setting(name, value, place, type_)]


def of_rosparam(element: Element, reading: Reading) -> list[Setting]:
    """Return what a ``<rosparam>`` sets; what it deletes and dumps was there before, and changes nothing of that.

    roslaunch runs ``rosparam delete`` and ``rosparam dump`` before it sets any parameter (launch.py, _setup).

    Raises:
        SubstitutionError: roslaunch refuses it.
    """
    given = element.attributes
    command = substitute(given.get("command", ""), reading.scope).known or "load"
    if command not in _COMMANDS:
        raise SubstitutionError(f"{command!r} is not a command of rosparam; expected load, dump or delete")
    if command == "delete" and "file" in given:
        raise SubstitutionError('<rosparam command="delete"> has a file; expected the name of a parameter alone')
    if command != "load":
        return []
    prefix = _join(_plain(given.get("ns"), reading), _plain(given.get("param"), reading))
    place = reading.place(element)
    if "file" in given:
        read = _file_of(element, substitute(given["file"], reading.scope), reading)
        if read is None:
            return []
        path, content = read
        start = Evidence(path, 1)
    else:
        path, content, start = (
            reading.path,
            "".join(one for one in element.children if isinstance(one, str)).encode(),
            place,
        )
    if _flag(given.get("subst_value"), "subst_value", reading):
        content = _plain(content.decode("utf-8", "replace"), reading).encode()
    try:
        return _of_yaml(content, Text.of(prefix), path, start)
    except DocumentError as error:
        fault = None if yaml_refusal(content) is None else Fault.PARAMETERS
        reading.miss(element, error.what, f"{error.where}: expected {error.expected}", fault=fault)
        return []


def _file_of(element: Element, file: Text, reading: Reading) -> tuple[str, bytes] | None:
    """Return the path and content of a file; None, and it is noted why, where it cannot be read."""
    if file.known is None:
        reading.miss(element, str(file), str(file.holes[0].reason))
        return None
    content = _content(file, reading)
    if content is None:
        fault = None if file.known.startswith("/") else Fault.MISSING_FILE
        reading.miss(element, file.known, "there is no such file in the workspace", fault=fault)
        return None
    return joined("", file.known), content


def _of_yaml(content: bytes, prefix: Text, path: str, place: Evidence) -> list[Setting]:
    found = ros1_parameters(content, path, place.line - 1)
    if not prefix.parts and any(not one.name.parts for one in found):
        raise SubstitutionError("<rosparam> sets a value without a name; expected param=…, or a table")
    return [msgspec.structs.replace(one, name=_below(prefix, one.name)) for one in found]


def _flag(written: str | None, attribute: str, reading: Reading) -> bool:
    return written is not None and boolean(_plain(written, reading), attribute)


def boolean(written: str, attribute: str) -> bool:
    """Return the value of an attribute that is true or false.

    Raises:
        SubstitutionError: it is neither; here roslaunch takes no number.
    """
    if written.lower() not in ("true", "false"):
        raise SubstitutionError(f'{attribute}="{written}" is neither true nor false')
    return written.lower() == "true"


def _plain(written: str | None, reading: Reading) -> str:
    """Return a text that has to be known.

    Raises:
        UnknownInsideError: it is not.
    """
    text = substitute(written or "", reading.scope)
    if text.known is None:
        raise UnknownInsideError(text.holes[0])
    return text.known


def _join(namespace: str, name: str) -> str:
    """Return a name below another one, as rosgraph's ns_join has it: global and private ones stay."""
    if not namespace or name[:1] in ("/", "~"):
        return name
    return f"{namespace.rstrip('/')}/{name}" if name else namespace


def _below(prefix: Text, name: Text) -> Text:
    if not prefix.parts or not name.parts:
        return prefix if prefix.parts else name
    return name if name.head[:1] in ("/", "~") else Text.of(prefix, "/", name)


def _stripped(text: Text) -> Text:
    begun = Text.of(text.head.lstrip(), *text.behind)
    return Text.of(*begun.before, begun.tail.rstrip())


def _split(text: Text) -> tuple[Text, ...]:
    """Return the words of a command line; what is unknown is part of a word."""
    words = [Text()]
    for part in text.parts:
        pieces: Iterable[str | Hole]
        match part:
            case str():
                pieces = re.split(r"\s+", part)
            case _:
                pieces = (part,)
        for number, piece in enumerate(pieces):
            if number and words[-1].parts:
                words.append(Text())
            words[-1] = Text.of(words[-1], piece)
    return tuple(word for word in words if word.parts)
