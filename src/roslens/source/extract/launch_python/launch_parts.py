"""Parts of what launch files make: conditions, changes of files of parameters, remappings, names of containers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from roslens.source.extract.domain.abstract_value import Named, Unknown
from roslens.source.extract.launch_python.deferred import Deferred, Value
from roslens.source.extract.launch_python.launch_action import Condition, FileChange
from roslens.source.extract.launch_python.launch_values import Made, as_value, plain, shown


def type_of(found: Any) -> str:
    """Return the name of a type that is given to a parameter."""
    return found.name.rpartition(".")[2] if isinstance(found, Named) else ""


def changes_of(made: Made) -> Iterator[FileChange]:
    """Yield what is done to a file of parameters, in the order in which it is done."""
    if made.name == "ReplaceString":
        given = made.named.get("condition")
        held = Condition("true") if given is None else condition_of(given)
        pairs = _texts(made.argument(1, "replacements"))
        yield FileChange("replace", pairs, condition=held.value, wanted=held.wanted)
    elif made.name == "RewrittenYaml":
        numbers = made.argument(5, "convert_types") is True
        yield FileChange("names", _texts(made.argument(1, "param_rewrites")), numbers=numbers)
        yield FileChange("values", _texts(made.argument(4, "value_rewrites")), numbers=numbers)
        root = made.argument(2, "root_key")
        if root is not None:
            yield FileChange("root", value=as_value(root))
    elif made.named.get("allow_substs") not in (None, False):
        yield FileChange("substitutes")


def _texts(found: Any) -> tuple[tuple[str, Value], ...]:
    return tuple((shown(key), as_value(value)) for key, value in found.items()) if isinstance(found, dict) else ()


def condition_of(found: Any) -> Condition:
    """Return when an action is visited, by its argument ``condition``."""
    match found:
        case Made() if found.name in ("IfCondition", "UnlessCondition"):
            return Condition(as_value(found.argument(0, "predicate_expression")), found.name == "IfCondition")
        case Made() if found.name.startswith("LaunchConfiguration"):
            name = Deferred("configuration", (as_value(found.argument(0, "launch_configuration_name")),))
            value = Deferred("equals", (name, as_value(found.argument(1, "expected_value"))))
            return Condition(value, found.name == "LaunchConfigurationEquals")
    return Condition(as_value(found if not isinstance(found, Made) else Unknown(f"a {found.name}")))


def name_of(container: Made) -> Value:
    """Return the name of a container that is meant by the object."""
    namespace, name = plain(container.named.get("namespace")), plain(container.named.get("name"))
    if namespace in (None, ""):
        return as_value(name)
    return Deferred("text", (as_value(namespace), "/", as_value(name)))


def pairs_of(remaps: Any) -> Iterator[tuple[Value, Value]]:
    """Yield the pairs of names of remappings."""
    for pair in remaps if isinstance(remaps, list | tuple) else ():
        if isinstance(pair, list | tuple) and len(pair) == 2:
            yield as_value(pair[0]), as_value(pair[1])
