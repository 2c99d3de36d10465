"""What is done to files of parameters before a node reads them, and how that is handed on with the path of a copy.

``RewrittenYaml`` and ``ReplaceString`` of nav2_common and ``ParameterFile`` of launch_ros make a copy of a file when
they are performed. Their path may go through launch configurations to other launch files, so what it stands for goes
along: as texts, which come to what holds where the copy is made.
"""

from __future__ import annotations

from collections.abc import Iterator

from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.launch_python.deferred import Deferred, Value
from roslens.source.extract.launch_python.launch_action import Condition, FileChange
from roslens.source.extract.launch_python.launch_values import PARAMETER_FILES, Made, Plain, as_value
from roslens.source.extract.symbolic.text import Text

_FIELDS = 6
"""Texts of a change before its pairs: kind, root, whether of numbers, condition, what it must be, count of pairs."""


def condition_of(found: Plain) -> Condition:
    """Return when an action is visited, by its argument ``condition``."""
    match found:
        case Made() if found.name in ("IfCondition", "UnlessCondition"):
            return Condition(as_value(found.argument(0, "predicate_expression")), found.name == "IfCondition")
        case Made() if found.name.startswith("LaunchConfiguration"):
            name = Deferred("optional", (as_value(found.argument(0, "launch_configuration_name")),))
            value = Deferred("equals", (name, as_value(found.argument(1, "expected_value"))))
            return Condition(value, found.name == "LaunchConfigurationEquals")
        case Made():
            return Condition(as_value(Unknown(f"a {found.name}")))
    return Condition(as_value(found))


def rewritten_file(made: Made) -> tuple[Value, tuple[FileChange, ...]]:
    """Return the file that a copy is made of, and what is done to it in order."""
    source = made.argument(0, "param_file", "source_file")
    match source:
        case Made() if source.name in PARAMETER_FILES:
            file, before = rewritten_file(source)
            return file, (*before, *_changes(made))
    return as_value(source), tuple(_changes(made))


def _changes(made: Made) -> Iterator[FileChange]:
    if made.name == "ReplaceString":
        given = made.named.get("condition")
        held = Condition("true") if given is None else condition_of(given)
        pairs = _texts(made.argument(1, "replacements"))
        yield FileChange("replace", pairs, condition=held.value, wanted=held.wanted)
    elif made.name == "RewrittenYaml":
        # Before there were value_rewrites, convert_types had their place.
        fifth = made.argument(4, "value_rewrites")
        numbers = made.argument(5, "convert_types") is True or fifth is True
        yield FileChange("names", _texts(made.argument(1, "param_rewrites")), numbers=numbers)
        yield FileChange("keys", _texts(made.argument(3, "key_rewrites")))
        yield FileChange("values", _texts(fifth), numbers=numbers)
        root = made.argument(2, "root_key")
        if root is not None:
            yield FileChange("root", value=as_value(root))
    elif made.named.get("allow_substs") not in (None, False):
        yield FileChange("substitutes")


def _texts(found: Plain) -> tuple[tuple[Value, Value], ...]:
    """Return what is replaced and by what; one that is unknown stands for all that may be replaced."""
    match found:
        case dict():
            return tuple((as_value(key), as_value(value)) for key, value in found.items())
        case None | bool():
            return ()
    return ((as_value(found), as_value(found)),)


def written_changes(changes: tuple[FileChange, ...]) -> tuple[Value, ...]:
    """Return changes as texts."""
    found: list[Value] = []
    for one in changes:
        found += [one.kind, one.value, str(one.numbers), one.condition, str(one.wanted), str(len(one.pairs))]
        found += [part for pair in one.pairs for part in pair]
    return tuple(found)


def read_changes(texts: tuple[Text, ...]) -> tuple[FileChange, ...]:
    """Return the changes that :func:`written_changes` made these texts of."""
    found = []
    while texts:
        kind, value, numbers, condition, wanted, count = texts[:_FIELDS]
        end = _FIELDS + 2 * int(str(count))
        rest = texts[_FIELDS:end]
        pairs = tuple(zip(rest[::2], rest[1::2], strict=True))
        found.append(FileChange(str(kind), pairs, value, str(numbers) == "True", condition, str(wanted) == "True"))
        texts = texts[end:]
    return tuple(found)


def stands_for(made: Made) -> Deferred:
    """Return what stands for the path of the copy."""
    file, changes = rewritten_file(made)
    return Deferred("rewritten", (file, *written_changes(changes)))
