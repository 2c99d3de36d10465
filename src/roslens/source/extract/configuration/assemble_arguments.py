"""What the command line of a node says of names and parameters."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.facts.resolve_name import Rule, rule
from roslens.source.extract.parameters.parameter_file import type_of_text
from roslens.source.extract.parameters.ros2_values import type_on_line
from roslens.source.extract.symbolic.text import Text

_REMAP = frozenset({"-r", "--remap"})
_PARAMETER = frozenset({"-p", "--param"})
_FILE = "--params-file"
_FLAGS = _REMAP | _PARAMETER | {_FILE, "--log-level", "--log-config-file", "-e", "--enclave"}
"""All that have a value after them."""


class CommandLine(msgspec.Struct, frozen=True):
    """Remappings, parameters, files of parameters, and what is left for the program itself."""

    rules: tuple[Rule, ...] = ()
    settings: tuple[Setting, ...] = ()
    files: tuple[Text, ...] = ()
    rest: tuple[Text, ...] = ()


def command_line(words: Sequence[Text], generation: str, evidence: Evidence) -> CommandLine:
    """Take the words of a command line apart."""
    return _ros1(words, evidence) if generation == "ros1" else _ros2(words, evidence)


def split_once(text: Text, separator: str) -> tuple[Text, Text] | None:
    """Return what is before and after a separator; None where it is not in the known parts."""
    for place, part in enumerate(text.parts):
        if isinstance(part, str) and separator in part:
            before, _, after = part.partition(separator)
            return Text.of(*text.parts[:place], before), Text.of(after, *text.parts[place + 1 :])
    return None


def _ros1(words: Sequence[Text], evidence: Evidence) -> CommandLine:
    rules, settings, rest = [], [], []
    for word in words:
        pair = split_once(word, ":=")
        if pair is None:
            rest.append(word)
            continue
        source, target = pair
        first = source.head
        match first:
            case str() if first.startswith("_") and not first.startswith("__"):
                settings.append(_setting(Text.of("~" + first[1:], *source.parts[1:]), target, evidence))
            case _:
                rules.append(Rule(source, target, evidence))
    return CommandLine(tuple(rules), tuple(settings), (), tuple(rest))


def _ros2(words: Sequence[Text], evidence: Evidence) -> CommandLine:
    rules: list[Rule] = []
    settings: list[Setting] = []
    files: list[Text] = []
    rest: list[Text] = []
    for flag, word in _flagged(words):
        pair = split_once(word, ":=")
        if not flag:
            rest.append(word)
        elif flag == _FILE:
            files.append(word)
        elif pair and flag in _REMAP:
            rules.append(rule(*pair, evidence))
        elif pair and flag in _PARAMETER:
            settings.append(_typed(_of_node(*pair, evidence)))
    return CommandLine(tuple(rules), tuple(settings), tuple(files), tuple(rest))


def _flagged(words: Sequence[Text]) -> Iterator[tuple[str, Text]]:
    """Yield words with the flag of ROS that each belongs to; it is empty for those of the program itself."""
    of_ros, flag = False, ""
    for word in words:
        known = word.known
        if known == "--ros-args":
            of_ros, flag = True, ""
        elif of_ros and known == "--":
            of_ros, flag = False, ""
        elif of_ros and not flag and known in _FLAGS:
            flag = known
        elif flag or not of_ros:
            yield flag, word
            flag = ""


def _of_node(name: Text, value: Text, evidence: Evidence) -> Setting:
    node, colon, own = name.head.partition(":")
    if not colon:
        return _setting(name, value, evidence)
    pattern = node if node.startswith("/") else f"/**/{node}"
    return msgspec.structs.replace(_setting(Text.of(own, *name.parts[1:]), value, evidence), node=pattern)


def _typed(setting: Setting) -> Setting:
    """Return a parameter of ROS 2 as rcl types it."""
    known = setting.value.known
    return setting if known is None else msgspec.structs.replace(setting, type=type_on_line(known))


def _setting(name: Text, value: Text, evidence: Evidence) -> Setting:
    return Setting(name, value, evidence, kind_of_value(value))


def kind_of_value(value: Text) -> str:
    """Return the type of a parameter by its value as text; empty where that is unknown."""
    return type_of_text(value.known) if value.known is not None else ""
