"""What rcl refuses of a file of parameters: ``rcl_yaml_param_parser`` followed event by event (parse.c, namespace.c).

rcl goes through the events of libyaml with a few flags instead of building a tree. What it refuses therefore depends on
these flags, which are kept here under their names: an alias, a key without a value, a list with values of two types, a
value outside of ``ros__parameters``, a list of lists. A refused file ends the node that it is given to.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslens.source.extract.facts.refusal import Refusal
from roslens.source.extract.parameters.ros2_values import type_in_rcl
from roslens.source.extract.parameters.unreadable_yaml import TooDeepError, events, other_encoding, place_of, unreadable

if TYPE_CHECKING:
    from yaml import AliasEvent, Event, ScalarEvent

PARAMETERS = "ros__parameters"
MOST_BYTES = 2_000_000
"""Larger files are not followed."""
_OTHERS = (b"\xff\xfe", b"\xfe\xff")
"""Marks of UTF-16, which YAML may be written in too."""
_STRING = "tag:yaml.org,2002:str"
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,254}")
_OPEN = re.compile(r"\$\(|\$\{|[<>{}@%]")
"""In a name: something is put there before rcl reads the file."""
_TABLE = "node: {ros__parameters: {name: value}}"
_VALUE = "a value, such as 0, false or '', or {} for no parameters"
_QUOTED = ("'", '"')


class _RefusedError(Exception):
    def __init__(self, refusal: Refusal) -> None:
        super().__init__(refusal.what)
        self.refusal = refusal


def refusal(content: bytes) -> Refusal | None:
    """Return why rcl refuses a file of parameters; None where it takes it, or where that is not followed."""
    return judged(content)[0]


def judged(content: bytes) -> tuple[Refusal | None, str]:
    """Return why rcl refuses a file of parameters, and why nobody here can say so; of both at most one.

    Not followed is what is larger than :data:`MOST_BYTES`, or nested too deeply.
    """
    if len(content) > MOST_BYTES:
        return None, f"{len(content):,} bytes"
    try:
        return _refusal(content), ""
    except TooDeepError:
        return None, "nested too deeply"


def _refusal(content: bytes) -> Refusal | None:
    import yaml

    reading = _Reading()
    try:
        if not content.startswith(_OTHERS):
            content.decode("utf-8")
        for event in events(content):
            reading.take(event)
    except _RefusedError as error:
        return error.refusal
    except yaml.MarkedYAMLError as error:
        return unreadable(error, content)
    except UnicodeDecodeError as error:
        return other_encoding(error)
    except yaml.YAMLError as error:
        return Refusal(1, 1, f"no YAML: {(str(error).splitlines() or [type(error).__name__])[0]}", "text in UTF-8")
    return None


class _Reading:
    """The flags of ``parse_file_events``."""

    def __init__(self) -> None:
        self._in_parameters = False
        self._is_key = True
        self._is_list = False
        self._types: list[str] = []
        self._texts: list[str] = []
        self._depth = 0
        self._nodes: list[str] = []
        self._before: list[str] = []
        self._key_text = ""
        self._below = 0
        self._is_new = False
        self._has_parameter = False

    def take(self, event: Event) -> None:
        """Follow one event.

        Raises:
            _RefusedError: rcl refuses it.
        """
        import yaml

        match event:
            case yaml.ScalarEvent():
                self.scalar(event)
            case yaml.SequenceStartEvent():
                self.list_start(event)
            case yaml.SequenceEndEvent():
                self.list_end()
            case yaml.MappingStartEvent():
                self.table_start()
            case yaml.MappingEndEvent():
                self.table_end()
            case yaml.AliasEvent():
                self.alias(event)

    def scalar(self, event: ScalarEvent) -> None:
        if self._is_key:
            self._key(event)
            self._is_key = False
            return
        if not event.value and event.style not in _QUOTED:
            expected = _VALUE if self._in_parameters else _TABLE
            raise _refused(event, f"nothing behind {self._key_text!r}", expected, taken_elsewhere=True)
        if not self._in_parameters or not self._has_parameter:
            what = f"{self._key_text[:60]!r} has the value {event.value[:60]!r} outside of {PARAMETERS}"
            raise _refused(event, what, _TABLE)
        self._value(event)
        self._is_key = not self._is_list

    def _key(self, event: ScalarEvent) -> None:
        name = event.value
        if not name:
            raise _refused(event, "an empty key", "the name of a parameter or node")
        self._key_text = name
        if self._in_parameters:
            if self._is_new:
                self._below += 1
                self._is_new = False
            self._has_parameter = True
        elif not name.startswith(PARAMETERS):
            self._nodes.append(name)
        else:
            # A second table of parameters of one node: not every release of rcl refuses it.
            self._nodes = self._nodes or self._before
            if not self._nodes:
                raise _refused(event, f"no name of a node before {PARAMETERS}", _TABLE)
            self._before = list(self._nodes)
            wrong = _wrong_name("/".join(self._nodes))
            if wrong:
                raise _refused(event, wrong, "letters, digits and `_`, with `/` between namespaces, or `/**`")
            self._nodes.pop()
            self._in_parameters, self._has_parameter = True, False

    def _value(self, event: ScalarEvent) -> None:
        if not self._is_list:
            return
        is_text = event.style in _QUOTED or event.tag == _STRING
        self._types.append("string" if is_text else type_in_rcl(event.value))
        self._texts.append(event.value)
        if self._types[-1] != self._types[0] and not any(_OPEN.search(one) for one in self._texts):
            first = f"the {_WORDS[self._types[0]]} {self._texts[0]!r}"
            raise _refused(
                event,
                f"{event.value[:60]!r} is {_ARTICLES[self._types[-1]]} in a list that begins with {first[:80]}",
                "values of one type, such as [1.0, 2.5] or ['1', 'a']",
            )

    def list_start(self, event: Event) -> None:
        if self._is_key:
            what = "a list in a list" if self._in_parameters else "a list as a key"
            raise _refused(event, what, "single values: parameters are flat lists")
        if not self._in_parameters:
            raise _refused(event, f"a list outside of {PARAMETERS}", _TABLE)
        self._is_list = True
        self._types, self._texts = [], []

    def list_end(self) -> None:
        self._is_list = False
        self._is_key = True

    def table_start(self) -> None:
        self._depth += 1
        self._is_new = self._is_key = True
        if self._in_parameters and self._depth - (len(self._nodes) + 1) == 2:
            self._is_new = False

    def table_end(self) -> None:
        if self._in_parameters:
            if self._below:
                self._below -= 1
            else:
                self._in_parameters = False
        elif self._nodes and self._depth == len(self._nodes) + 1:
            self._nodes.pop()
        self._depth -= 1

    def alias(self, event: AliasEvent) -> None:
        expected = "the values written out, as rcl takes no aliases"
        raise _refused(event, f"the alias '*{event.anchor}'", expected, taken_elsewhere=True)


_WORDS = {"bool": "truth value", "int": "integer", "double": "number", "string": "text"}
_ARTICLES = {"bool": "a truth value", "int": "an integer", "double": "a floating-point number", "string": "a text"}


def _refused(event: Event, what: str, expected: str, *, taken_elsewhere: bool = False) -> _RefusedError:
    return _RefusedError(Refusal(*place_of(event), what, expected, taken_elsewhere))


def _wrong_name(name: str) -> str:
    """Return what is wrong with the name of a node with its namespace; empty where nothing is, or that is open."""
    if _OPEN.search(name):
        return ""
    return next((f"{piece!r} in {name!r} is no name of a node" for piece in _pieces(name) if not _is_name(piece)), "")


def _pieces(name: str) -> Iterator[str]:
    yield from name.removeprefix("/").split("/")


def _is_name(piece: str) -> bool:
    return piece in ("*", "**") or _NAME.fullmatch(piece) is not None
