"""What calls in a launch file in Python mean: substitutions of launch, paths, and a little of Python itself.

In come plain values (``launch_values.plain``), and plain values go out.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from roslens.source.extract.domain.abstract_value import Callable as Function
from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.launch_python.launch_action import text
from roslens.source.extract.launch_python.launch_paths import PATHS, path_method
from roslens.source.extract.launch_python.launch_values import Either, Made, Opened, as_value, shown
from roslens.source.extract.symbolic.python_expression import evaluate
from roslens.source.extract.symbolic.text import Text

_LONGEST = 10_000
_WIDEST = 200
ACTIONS = frozenset(
    {"DeclareLaunchArgument", "SetLaunchConfiguration", "UnsetLaunchConfiguration", "IncludeLaunchDescription",
     "GroupAction", "PushRosNamespace", "PushROSNamespace", "SetParameter", "SetParametersFromFile", "SetUseSimTime",
     "SetRemap", "Node", "LifecycleNode", "ComposableNodeContainer", "ComposableNode", "LoadComposableNodes",
     "ExecuteProcess", "ExecuteLocal", "TimerAction", "RosTimer", "RegisterEventHandler", "OnProcessExit",
     "OnProcessStart", "OnProcessIO", "OnShutdown", "OnExecutionComplete", "OnStateTransition", "OpaqueFunction",
     "LaunchDescription", "LogInfo", "Log", "LogDebug", "LogWarning", "LogError", "SetEnvironmentVariable",
     "AppendEnvironmentVariable", "UnsetEnvironmentVariable", "ResetEnvironment", "PushEnvironment", "PopEnvironment",
     "Shutdown", "EmitEvent", "ResetLaunchConfigurations", "PushLaunchConfigurations", "PopLaunchConfigurations",
     "SetROSLogDir", "UnregisterEventHandler", "IfCondition", "UnlessCondition", "LaunchConfigurationEquals",
     "LaunchConfigurationNotEquals", "ForEach", "ForLoop", "DeclareBooleanLaunchArgument", "ComposableLifecycleNode",
     "ParameterValue", "ParameterFile", "RewrittenYaml", "ReplaceString", "ReadyToTest"}
)  # fmt: skip
_PARTS = {
    "PathJoinSubstitution": "path",
    "PythonExpression": "python",
    "Command": "command",
    "NotSubstitution": "not",
    "AndSubstitution": "and",
    "OrSubstitution": "or",
    "AllSubstitution": "and",
    "AnySubstitution": "or",
    "EqualsSubstitution": "equals",
    "NotEqualsSubstitution": "unequal",
    "IfElseSubstitution": "if",
    "FindPackageShare": "share",
    "FindPackagePrefix": "prefix",
    "FindPackage": "prefix",
    "AnonName": "anonymous",
    "PathSubstitution": "path",
}
_SOURCES = frozenset(
    {"PythonLaunchDescriptionSource", "AnyLaunchDescriptionSource", "FrontendLaunchDescriptionSource",
     "XMLLaunchDescriptionSource", "YAMLLaunchDescriptionSource", "LaunchDescriptionSource"}
)  # fmt: skip
_AT_ONCE = frozenset({"get_package_share_directory", "get_package_share_path", "get_package_prefix"})
_DEFAULTS = frozenset({"default", "default_value"})
_SPREAD = frozenset({"path"})
_METHODS = frozenset(
    {"lower", "upper", "strip", "lstrip", "rstrip", "split", "rsplit", "startswith", "endswith", "replace", "title",
     "capitalize", "isdigit", "removeprefix", "removesuffix", "partition", "rpartition", "splitlines", "zfill",
     "ljust", "rjust", "center", "swapcase", "count", "find", "rfind", "index", "isalpha", "isalnum", "isnumeric"}
)  # fmt: skip


def is_known(name: str) -> bool:
    """Return whether it is known what calling something by its whole name gives, but for what is made."""
    last = name.rpartition(".")[2]
    return any(last in one for one in (_SOURCES, _SUBSTITUTIONS, _PARTS, _PATHS)) or name in _FUNCTIONS


def is_at_once(name: str) -> bool:
    """Return whether a function gives a text when the file is read, rather than a substitution."""
    return name in PATHS or name.rpartition(".")[2] in _AT_ONCE


def call_known(name: str, positional: list[Any], named: dict[str, Any]) -> Any:
    """Return what a call of something that is known gives."""
    last = name.rpartition(".")[2]
    if last in _SOURCES:
        return as_value(positional[0] if positional else next(iter(named.values()), None))
    substitution = _SUBSTITUTIONS.get(last)
    if substitution is not None:
        # Names of what is substituted come before their defaults, in whichever order they are given.
        last_ones = sorted(named.items(), key=lambda one: one[0] in _DEFAULTS)
        return substitution([*positional, *(value for _, value in last_ones)])
    if last in _PARTS:
        return _of_parts(last, [*positional, *named.values()])
    known = _FUNCTIONS.get(name) or _PATHS.get(last)
    if known is None:
        return Unknown(f"result of {name}()")
    try:
        return known(*positional, **named)
    except (TypeError, ValueError, ArithmeticError, LookupError, AttributeError):
        return Unknown(f"result of {name}()")


def call_method(of: Any, name: str, positional: list[Any], named: dict[str, Any], written: str) -> Any:
    """Return what a method of a text, a substitution, a table or an open file returns."""
    match of:
        case Opened() if name in ("read", "read_text"):
            return of
        case str() if name == "join" and positional and isinstance(positional[0], list):
            pieces = [piece for one in positional[0] for piece in (of, as_value(one))][1:]
            return text(*pieces) if pieces else ""
        case str() if name == "format":
            return _formatted(of, positional, named)
        case str() if name in _METHODS and all(isinstance(one, str | int) for one in positional):
            return _of_text(of, name, positional, named, written)
        case str() | Deferred() | Text() if (path := path_method(of, name, positional)) is not None:
            return path
    return Unknown(f"result of {written}()")


def _of_text(of: str, name: str, positional: list[Any], named: dict[str, Any], written: str) -> Any:
    """Return what a method of a text returns that is known; unknown where Python raises an error."""
    try:
        found = getattr(of, name)(*positional, **named)
    except (TypeError, ValueError, OverflowError):
        return Unknown(f"result of {written}()")
    if isinstance(found, tuple):
        return list(found)
    return found if not isinstance(found, str) or len(found) <= _LONGEST else Unknown("a string that is too long")


def _formatted(pattern: str, positional: list[Any], named: dict[str, Any]) -> Any:
    pieces = pattern.replace("{{", "\0").replace("}}", "\1").split("{")
    parts: list[Any] = [pieces[0]]
    for index, piece in enumerate(pieces[1:]):
        field, closed, rest = piece.partition("}")
        if not closed or (field and not (field.isidentifier() or field.isdigit())):
            return Unknown(f"the format {pattern!r}")
        key = int(field) if field.isdigit() else field or index
        if isinstance(key, int) and key < len(positional):
            parts.append(as_value(positional[key]))
        elif key in named:
            parts.append(as_value(named[str(key)]))
        else:
            return Unknown(f"the format {pattern!r}")
        parts.append(rest)
    return text(*(one.replace("\0", "{").replace("\1", "}") if isinstance(one, str) else one for one in parts))


def _of_parts(last: str, values: list[Any]) -> Deferred:
    kind = _PARTS[last]
    first = values[0] if values else []
    if len(values) == 1 and isinstance(first, list) and (kind in _SPREAD or last.startswith(("All", "Any"))):
        values = first
    elif kind in ("python", "command", "text", "share", "prefix", "anonymous"):
        values = [first]
    return Deferred(kind, tuple(as_value(one) for one in values))


def _joined(values: list[Any], delimiter: Any = "") -> Any:
    """Return what ``StringJoinSubstitution`` makes of its components."""
    components = values if isinstance(values, list) else [values]
    return Deferred("join", (as_value(delimiter), *map(as_value, components)))


def _configuration(values: list[Any]) -> Deferred:
    return Deferred("configuration", tuple(as_value(one) for one in values[:2] if one is not None))


def _environment(*values: Any) -> Deferred:
    return Deferred("environment", tuple(as_value(one) for one in values[:2] if one is not None))


def _package(name: Any) -> Deferred:
    return Deferred("share", (as_value(name),))


def _as_text(value: Any = "") -> Any:
    return as_value(value)


def _plain(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that takes nothing that is unknown."""

    def call(*values: Any, **named: Any) -> Any:
        for one in [*values, *named.values()]:
            if isinstance(one, Unknown | Deferred | Text | Made | Either | Function):
                raise TypeError
        found = function(*values, **named)
        return list(found) if not isinstance(found, str | int | float | bool | dict | None) else found

    return call


def _renamed(named: dict[str, Any]) -> dict[str, Any]:
    return {"values" if name == "substitutions" else name: value for name, value in named.items()}


def _nothing(*_values: Any, **_named: Any) -> None:
    return None


def _evaluated(expression: str) -> Any:
    return evaluate(expression)


def _laid_out(value: Any, layout: str = "") -> str:
    """Return a value as an f-string lays it out.

    Raises:
        ValueError: it would be very wide.
    """
    if any(int(width) > _WIDEST for width in re.findall(r"\d+", layout)):
        raise ValueError
    return format(value, layout)


def _range(*values: int) -> list[int]:
    return list(range(*values)[:_LONGEST])


_SUBSTITUTIONS: dict[str, Callable[[list[Any]], Any]] = {
    "LaunchConfiguration": _configuration,
    "LaunchConfigAsBool": _configuration,
    "EnvironmentVariable": lambda values: _environment(*values),
    "OptionalEnvironmentVariable": lambda values: _environment(*values),
    "TextSubstitution": lambda values: Deferred("text", (as_value(values[0] if values else ""),)),
    "ThisLaunchFileDir": lambda _values: Deferred("folder"),
    "ThisLaunchFile": lambda _values: Deferred("file"),
    "FindExecutable": lambda values: Unknown(f"path of the program {values[0] if values else ''}"),
    "ExecutableInPackage": lambda _values: Unknown("path of a program"),
    "FileContent": lambda values: Deferred("content", (as_value(values[0]),)) if values else Unknown("no file"),
    "LaunchLogDir": lambda _values: Unknown("folder of the logs of this start"),
    "AmentIndexResource": lambda _values: Unknown("path of a resource of the index of packages"),
    "Parameter": lambda values: Unknown(f"value of the global parameter {shown(values[0]) if values else ''}"),
    "LocalSubstitution": lambda values: Unknown(f"{shown(values[0]) if values else ''} of the event"),
    **dict.fromkeys(
        ("ForEachVar", "ForLoopIndex"), lambda values: Deferred("turn", tuple(as_value(one) for one in values[:2]))
    ),
}
_PATHS: dict[str, Callable[..., Any]] = {
    "get_package_share_directory": _package,
    "get_package_share_path": _package,
    "get_package_prefix": lambda name: Deferred("prefix", (as_value(name),)),
    "StringJoinSubstitution": lambda *values, **named: _joined(*values, **_renamed(named)),
}
_FUNCTIONS: dict[str, Callable[..., Any]] = {
    **PATHS,
    "os.getenv": _environment,
    "os.environ.get": _environment,
    "str": _as_text,
    "str.join": lambda delimiter, values: _joined(values, delimiter),
    "launch.utilities.perform_substitutions": lambda _context, values: as_value(values),
    "launch.utilities.normalize_to_list_of_substitutions": lambda value: value,
    "launch.utilities.normalize_to_list_of_substitutions_impl.normalize_to_list_of_substitutions": lambda value: value,
    "int": _plain(int),
    "float": _plain(float),
    "bool": _plain(bool),
    "len": lambda value: len(value) if isinstance(value, list | dict | str) else _plain(len)(value),
    "range": _plain(_range),
    "dict": lambda *values, **named: {**(dict(values[0]) if values else {}), **named},
    "abs": _plain(abs),
    "round": _plain(round),
    "format": _plain(_laid_out),
    "repr": _plain(repr),
    **{f"str.{name}": _plain(getattr(str, name)) for name in sorted(_METHODS)},
    "eval": _evaluated,
    **dict.fromkeys(("print", "os.remove", "os.makedirs", "os.unlink", "os.mkdir"), _nothing),
}
