"""Endpoints in one line each, as hints of ``roslens.toml`` and the catalogue write them.

A line is ``name type quality if condition``; the last two may be missing. The quality of service is ``sensor_data``,
``latched`` (transient local, one message), ``tf``, ``tf_static``, ``default`` or the depth of a reliable one; in ROS 1
it is ``latched`` or the size of the queue. ``{parameter=default}`` in a name is what a parameter says, ``{1}`` the
first word of the command line. ``*`` is a type that only runs can tell. A condition ``parameter is set``,
``parameter=default is true`` or ``parameter=default is false`` is decided by what the node is given.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from roslens.model.errors import UsageError
from roslens.model.graph import Role
from roslens.model.qos import Qos
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence
from roslens.source.extract.symbolic.reason import OfParameter
from roslens.source.extract.symbolic.text import Condition, Hole, IsSet, IsTrue, Not, Text, Written, unknown
from roslens.source.settings import NodeHint

_RELIABLE = ("reliable", "volatile", "keep_last")
_QUALITIES = {
    "default": Qos(*_RELIABLE, 10),
    "sensor_data": Qos("best_effort", "volatile", "keep_last", 5),
    "latched": Qos("reliable", "transient_local", "keep_last", 1),
    "tf": Qos(*_RELIABLE, 100),
    "tf_static": Qos("reliable", "transient_local", "keep_last", 1),
    "unknown": Qos(),
}
ROLES = {
    "publishes": Role.PUBLISHER,
    "subscribes": Role.SUBSCRIPTION,
    "serves": Role.SERVICE_SERVER,
    "calls": Role.SERVICE_CLIENT,
    "serves_actions": Role.ACTION_SERVER,
    "calls_actions": Role.ACTION_CLIENT,
}
_PIECES = re.compile(r"\{([^{}=]+)(?:=([^{}]*))?\}")
_TYPE = re.compile(r"[A-Za-z]\w*(?:/(?:msg|srv|action))?/[A-Za-z]\w*|\*")
_IS_SET = " is set"
_IS_TRUE = re.compile(r"([\w.]+)(?:=(true|false))? is (true|false)")
_EXPECTED = 'a text "name package/msg/Type", with "latched", "sensor_data" or a depth after it where it is known'


def endpoint_of(line: str, role: Role, generation: str, evidence: Evidence, words: Sequence[Text] = ()) -> EndpointFact:
    """Return the endpoint that a line tells.

    Args:
        line: ``name type quality if condition``; the last two may be missing.
        role: of the endpoint.
        generation: ``ros1`` or ``ros2``.
        evidence: where the line stands.
        words: of the command line of the node.

    Raises:
        UsageError: the line tells no endpoint.
    """
    name, kind, quality, condition = _parted(line)
    number = quality.isdecimal()
    topic = role in (Role.PUBLISHER, Role.SUBSCRIPTION)
    qos = None
    if generation == "ros2" and topic:
        qos = Qos(*_RELIABLE, int(quality)) if number else _QUALITIES[quality or "unknown"]
    stated = _condition(condition) if condition else None
    return EndpointFact(
        role,
        text_of(name, words),
        unknown("its type is that of its input") if kind == "*" else Text.of(kind),
        evidence,
        qos=qos,
        qos_unknown="" if qos is None or qos.reliability else "it is not stated",
        queue=int(quality) if generation == "ros1" and number else -1,
        latched=generation == "ros1" and quality == "latched",
        conditions=(stated,) if stated is not None else (),
        asked=((stated, stated),) if stated is not None and _IS_TRUE.fullmatch(condition) else (),
    )


def _parted(line: str) -> tuple[str, str, str, str]:
    """Return the name, type, quality and condition of a line; the last two are empty where they are missing.

    Raises:
        UsageError: the line tells no endpoint.
    """
    stated, _, condition = line.partition(" if ")
    name, kind, quality, *more = [*stated.split(), "", "", ""]
    if not _TYPE.fullmatch(kind) or any(more):
        raise UsageError(f'"{line}"', expected=_EXPECTED)
    if quality and not quality.isdecimal() and quality not in _QUALITIES:
        raise UsageError(f'"{quality}" in "{line}"', expected=f"a depth or one of {', '.join(sorted(_QUALITIES))}")
    return name, kind, quality, condition.strip()


def _condition(written: str) -> Condition:
    """Return a condition of a line; that a parameter is set, or its value, is what decides it."""
    if match := _IS_TRUE.fullmatch(written):
        holds = IsTrue(Text.of(Hole(OfParameter(match[1]), match[1], match[2])))
        return holds if match[3] == "true" else Not(holds)
    name, ending, rest = written.partition(_IS_SET)
    return IsSet(Text.of(name)) if ending and not rest else Written(written)


def text_of(written: str, words: Sequence[Text] = ()) -> Text:
    """Return a text in which ``{parameter=default}`` and ``{1}`` are what decides them."""
    parts: list[str | Hole | Text] = []
    at = 0
    for match in _PIECES.finditer(written):
        parts.append(written[at : match.start()])
        parts.append(_hole(match[1], match[2], words))
        at = match.end()
    return Text.of(*parts, written[at:])


def _hole(name: str, default: str | None, words: Sequence[Text]) -> Hole | Text:
    if not name.isdecimal():
        return Hole(OfParameter(name), name, default)
    place = int(name) - 1
    if place < len(words):
        return words[place]
    return Hole(f"argument {name} of its command line", default=default)


def hinted(hint: NodeHint, generation: str, path: str, node: str) -> Iterator[EndpointFact]:
    """Yield the endpoints that a hint adds to a node.

    Raises:
        UsageError: a line tells no endpoint.
    """
    evidence = Evidence(path, 0, how=f'[graph.hints."{node}"]')
    for key, role in ROLES.items():
        for line in getattr(hint, key):
            try:
                yield endpoint_of(line, role, generation, evidence)
            except UsageError as error:
                raise UsageError(f'{error.what} in [graph.hints."{node}"]', expected=error.expected) from error


def hint_of(hints: Mapping[str, NodeHint], node: str, package: str, executable: str) -> tuple[str, NodeHint] | None:
    """Return the hint for a node: by its name, else by package and executable."""
    for key in (node, f"{package}/{executable}"):
        if key in hints:
            return key, hints[key]
    return None
