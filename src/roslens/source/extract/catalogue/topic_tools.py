"""What the tools of topic_tools and rostopic make of topics, by the words of their command lines or their parameters.

Of ROS 1 after ros/ros_comm (tools/topic_tools, tools/rostopic), of ROS 2 after ros-tooling/topic_tools. A tool that
passes messages on takes their type from the first one, and publishes only from then on.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence

from roslens.model.graph import Role
from roslens.model.qos import Qos
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, Sure
from roslens.source.extract.parameters.assemble_parameters import Values
from roslens.source.extract.symbolic.reason import OfParameter
from roslens.source.extract.symbolic.text import Hole, Text, Written, unknown
from roslens.source.extract.symbolic.text_lists import listed

_ROS1, _ROS2 = "ros/ros_comm: tools/topic_tools", "ros-tooling/topic_tools: topic_tools"
_ROSTOPIC = "ros/ros_comm: tools/rostopic"
_CLI = "ros2/ros2cli: {}"
_HOW = "known for this tool; differs between releases"
_ANY = unknown("its type is that of its input")
_COMES = "a message on {} has been received"
_COMMANDS = ("select", "add", "list", "delete")
_WITH_VALUE = frozenset(
    {"-r", "--rate", "-f", "--file", "-i", "--import", "-p", "--print", "-t", "--times", "-w", "-n", "--node-name",
     "--wait-matching-subscriptions", "--max-wait-time-secs", "--keep-alive", "--qos-profile", "--qos-depth",
     "--qos-history", "--qos-reliability", "--qos-durability", "--spin-time"}
)  # fmt: skip
_OPTION = re.compile(r"--|-[A-Za-z]|-1\Z")
_NONE = "__none"

Words = Sequence[Text]


def made_by_tool(package: str, tool: str, generation: str, words: Words, values: Values) -> Iterator[EndpointFact]:
    """Yield what a tool makes.

    Args:
        package: that has it.
        tool: executable, or class of a component.
        generation: ``ros1`` or ``ros2``.
        words: of its command line, those for ROS itself left out.
        values: of its parameters.
    """
    if generation == "ros1":
        by_words = (_WORDS if package == "topic_tools" else _OF_ROSTOPIC if package == "rostopic" else {}).get(tool)
        yield from by_words(words) if by_words else ()
    elif package in _COMMAND_LINE:
        yield from _by_command(package, tool, words)
    elif package == "topic_tools" or tool.startswith("topic_tools::"):
        name = tool.removeprefix("topic_tools::").removesuffix("Node").lower() if "::" in tool else tool
        by_words = _CONVERSIONS.get(name)
        yield from by_words(words) if by_words else _by_parameters(name, values)


def _end(
    role: Role, name: Text, kind: Text | str, source: str, *conditions: str, queue: int = -1, latched: bool = False
) -> EndpointFact:
    type_ = Text.of(kind) if isinstance(kind, str) else kind
    topic = role in (Role.PUBLISHER, Role.SUBSCRIPTION)
    qos = Qos() if topic and not source.startswith("ros/") else None
    why = "it is that of its input" if qos is not None else ""
    evidence = Evidence(source, 0, 0, _HOW, Sure.LIKELY)
    return EndpointFact(
        role, name, type_, evidence, conditions=tuple(map(Written, conditions)), qos=qos, qos_unknown=why,
        queue=queue, latched=latched,
    )  # fmt: skip


def _word(words: Words, place: int) -> Text:
    return words[place] if place < len(words) else Text((Hole(f"argument {place + 1} of its command line"),))


def _passed_on(ending: str, first: int, others: Callable[[Words], int]) -> Callable[[Words], Iterator[EndpointFact]]:
    """Return what a tool makes that passes one topic on; ``others`` counts the words before the one for the other."""

    def made(words: Words) -> Iterator[EndpointFact]:
        source, place = _word(words, first), others(words)
        target = words[place] if place < len(words) else Text.of(source, ending)
        yield _end(Role.SUBSCRIPTION, source, _ANY, _ROS1, queue=10)
        yield _end(Role.PUBLISHER, target, _ANY, _ROS1, _COMES.format(source), queue=10)

    return made


def _of_throttle(words: Words) -> int:
    return 4 if words and words[0].known == "bytes" else 3


def _mux(words: Words) -> Iterator[EndpointFact]:
    target = _word(words, 0)
    for one in words[1:] or [_word(words, 1)]:
        yield _end(Role.SUBSCRIPTION, one, _ANY, _ROS1, queue=10)
    yield _end(Role.PUBLISHER, target, _ANY, _ROS1, _COMES.format("the selected topic"), queue=10)
    yield _end(Role.SERVICE_SERVER, Text.of(target, "_select"), "topic_tools/MuxSelect", _ROS1)
    yield from _commands("mux", "Mux")


def _demux(words: Words) -> Iterator[EndpointFact]:
    source = _word(words, 0)
    yield _end(Role.SUBSCRIPTION, source, _ANY, _ROS1, queue=10)
    for number, one in enumerate(words[1:] or [_word(words, 1)]):
        selected = () if not number else ("it is selected",)
        yield _end(Role.PUBLISHER, one, _ANY, _ROS1, _COMES.format(source), *selected, queue=10)
    yield from _commands("demux", "Demux")


def _commands(space: str, kind: str) -> Iterator[EndpointFact]:
    yield _end(Role.PUBLISHER, Text.of(f"{space}/selected"), "std_msgs/String", _ROS1, queue=1, latched=True)
    for one in _COMMANDS:
        yield _end(Role.SERVICE_SERVER, Text.of(f"{space}/{one}"), f"topic_tools/{kind}{one.capitalize()}", _ROS1)


def _converted(source: str) -> Callable[[Words], Iterator[EndpointFact]]:
    def made(words: Words) -> Iterator[EndpointFact]:
        plain = _positional(words)
        given, target, kind = (_word(plain, place) for place in range(3))
        topic = given.known
        # What stands behind the topic may be a field of its messages: it ends where a topic does that is there.
        asked = "the requested topic, or a field of it"
        reason = f"{topic}, or the topic that has it as a field" if topic else asked
        starts = "its input exists when it starts"
        named = kind if source != _ROS2 else _of_ros2(kind)
        yield _end(Role.SUBSCRIPTION, unknown(reason), _ANY, source, starts)
        yield _end(Role.PUBLISHER, target, named, source, starts, latched="--latch" in [one.known for one in words])

    return made


def _of_ros2(kind: Text) -> Text:
    known = kind.known
    return Text.of(known.replace("/", "/msg/")) if known and known.count("/") == 1 else kind


def _positional(words: Words) -> list[Text]:
    """Return the words that are no options and no values of options."""
    found: list[Text] = []
    skip = False
    for one in words:
        known = one.known or ""
        if skip:
            skip = False
        elif known in _WITH_VALUE:
            skip = True
        elif not _OPTION.match(known):
            found.append(one)
    return found


def _rostopic(words: Words) -> Iterator[EndpointFact]:
    verb = words[0].known if words else None
    plain = _positional(words[1:])
    if verb == "pub":
        yield _end(Role.PUBLISHER, _word(plain, 0), _word(plain, 1), _ROSTOPIC, latched=_is_latched(words), queue=100)
    elif verb in ("echo", "hz", "bw", "delay"):
        for one in plain[:1]:
            yield _end(Role.SUBSCRIPTION, one, _ANY, _ROSTOPIC)


def _by_command(package: str, verb: str, words: Words) -> Iterator[EndpointFact]:
    """Yield what a command of ros2 makes: ``ros2 topic pub /name package/msg/Type``."""
    plain, source = _positional(words), _CLI.format(package)
    role = _COMMAND_LINE[package].get(verb)
    if role is not None:
        kind = _ANY if role is Role.SUBSCRIPTION else _word(plain, 1)
        yield _end(role, _word(plain, 0), kind, source)


def _is_latched(words: Words) -> bool:
    """Whether ``rostopic pub`` keeps its message: it does unless it publishes at a rate (``_rostopic_cmd_pub``)."""
    known = [one.known for one in words]
    return not any(one is not None and one.startswith(("-r", "--rate")) for one in known)


def _by_parameters(tool: str, values: Values) -> Iterator[EndpointFact]:
    """Yield what a tool of ROS 2 makes: it waits until somebody publishes what it takes."""
    if tool in ("relay", "throttle", "drop", "delay"):
        source = _value("input_topic", values) or Text((Hole(OfParameter("input_topic"), "input_topic"),))
        target = _value("output_topic", values) or Text.of(source, f"_{tool}")
        yield from _waiting(source, target)
    elif tool in ("mux", "demux"):
        if tool == "mux":
            source = _value("initial_topic", values) or _first("input_topics", values)
            target, selected = _value("output_topic", values) or Text.of("~/selected"), source
        else:
            target = _value("initial_topic", values) or _first("output_topics", values)
            source, selected = _value("input_topic", values) or Text.of("~/input"), target
        if selected.known != _NONE:
            yield from _waiting(source, target)
        for one in _COMMANDS:
            kind = f"topic_tools_interfaces/srv/{tool.capitalize()}{one.capitalize()}"
            yield _end(Role.SERVICE_SERVER, Text.of(f"~/{one}"), kind, _ROS2)


def _waiting(source: Text, target: Text) -> Iterator[EndpointFact]:
    condition = f"{source} is published"
    yield _end(Role.SUBSCRIPTION, source, _ANY, _ROS2, condition)
    yield _end(Role.PUBLISHER, target, _ANY, _ROS2, condition)


def _value(name: str, values: Values) -> Text | None:
    setting = values.value(Text.of(name))
    return None if setting is None or not setting.value.parts else setting.value


def _first(name: str, values: Values) -> Text:
    setting = values.value(Text.of(name))
    known = None if setting is None else setting.value.known
    items = listed(known) if known and known.startswith("[") else []
    return Text.of(items[0]) if items else unknown(f"the first of parameter {name}")


_WORDS: dict[str, Callable[[Words], Iterator[EndpointFact]]] = {
    "relay": _passed_on("_relay", 0, lambda _words: 1),
    "throttle": _passed_on("_throttle", 1, _of_throttle),
    "drop": _passed_on("_drop", 0, lambda _words: 3),
    "mux": _mux,
    "demux": _demux,
    "transform": _converted(_ROS1),
    "relay_field": _converted(_ROS1),
}
_COMMAND_LINE = {
    "ros2topic": {"pub": Role.PUBLISHER, **dict.fromkeys(("echo", "hz", "bw", "delay"), Role.SUBSCRIPTION)},
    "ros2service": {"call": Role.SERVICE_CLIENT},
    "ros2action": {"send_goal": Role.ACTION_CLIENT},
}
_OF_ROSTOPIC = {"rostopic": _rostopic}
_CONVERSIONS = {"transform": _converted(_ROS2), "relay_field": _converted(_ROS2)}
