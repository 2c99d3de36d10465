"""What calls in a launch file in Python mean: substitutions of launch, paths, and a little of Python itself.

In come plain values (``launch_values.plain``), and plain values go out.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from roslens.source.extract.domain.abstract_value import Callable as Function
from roslens.source.extract.domain.abstract_value import Unknown
from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.launch_python.launch_action import text
from roslens.source.extract.launch_python.launch_file_reads import Opened
from roslens.source.extract.launch_python.launch_values import Either, Made, as_value
from roslens.source.extract.symbolic.python_expression import evaluate
from roslens.source.extract.symbolic.text import Text

_LONGEST = 10_000
ACTIONS = frozenset(
    {"DeclareLaunchArgument", "SetLaunchConfiguration", "UnsetLaunchConfiguration", "IncludeLaunchDescription",
     "GroupAction", "PushRosNamespace", "PushROSNamespace", "SetParameter", "SetParametersFromFile", "SetUseSimTime",
     "SetRemap", "Node", "LifecycleNode", "ComposableNodeContainer", "ComposableNode", "LoadComposableNodes",
     "ExecuteProcess", "ExecuteLocal", "TimerAction", "RosTimer", "RegisterEventHandler", "OnProcessExit",
     "OnProcessStart", "OnProcessIO", "OnShutdown", "OnExecutionComplete", "OnStateTransition", "OpaqueFunction",
     "LaunchDescription", "LogInfo", "SetEnvironmentVariable", "AppendEnvironmentVariable", "UnsetEnvironmentVariable",
     "ResetEnvironment", "PushEnvironment", "PopEnvironment", "Shutdown", "EmitEvent", "ResetLaunchConfigurations",
     "PushLaunchConfigurations", "PopLaunchConfigurations", "SetROSLogDir", "UnregisterEventHandler",
     "IfCondition", "UnlessCondition", "LaunchConfigurationEquals", "LaunchConfigurationNotEquals",
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
    "StringJoinSubstitution": "text",
}
_SOURCES = frozenset(
    {"PythonLaunchDescriptionSource", "AnyLaunchDescriptionSource", "FrontendLaunchDescriptionSource",
     "XMLLaunchDescriptionSource", "YAMLLaunchDescriptionSource", "LaunchDescriptionSource"}
)  # fmt: skip
_DEFAULTS = frozenset({"default", "default_value"})
_SPREAD = frozenset({"path"})
_METHODS = frozenset(
    {"lower", "upper", "strip", "lstrip", "rstrip", "split", "startswith", "endswith", "replace", "title",
     "capitalize", "isdigit"}
)  # fmt: skip


def is_known(name: str) -> bool:
    """Return whether it is known what calling something by its whole name gives, but for what is made."""
    last = name.rpartition(".")[2]
    return any(last in one for one in (_SOURCES, _SUBSTITUTIONS, _PARTS, _PATHS)) or name in _FUNCTIONS


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
            found = getattr(of, name)(*positional)
            return (
                found if not isinstance(found, str) or len(found) <= _LONGEST else Unknown("a string that is too long")
            )
        case str() | Deferred() | Text() if name in ("as_posix", "resolve", "absolute", "expanduser"):
            return of
        case str() | Deferred() | Text() if name == "joinpath":
            return Deferred("path", (as_value(of), *map(as_value, positional)))
    return Unknown(f"result of {written}()")


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


def _configuration(values: list[Any]) -> Deferred:
    return Deferred("configuration", tuple(as_value(one) for one in values[:2] if one is not None))


def _environment(*values: Any) -> Deferred:
    return Deferred("environment", tuple(as_value(one) for one in values[:2] if one is not None))


def _join(*values: Any) -> Deferred:
    return Deferred("path", tuple(as_value(one) for one in values))


def _folder(value: Any) -> Any:
    match value:
        case Deferred() if value.kind == "file":
            return Deferred("folder")
        case Deferred() if value.kind == "folder":
            return Deferred("path", (value, ".."))
        case str():
            return value.rpartition("/")[0]
        case Deferred():
            return Deferred("path", (value, ".."))
    raise ValueError


def _same(value: Any, *_rest: Any, **_named: Any) -> Any:
    return value


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


def _nothing(*_values: Any, **_named: Any) -> None:
    return None


def _evaluated(expression: str) -> Any:
    return evaluate(expression)


def _range(*values: int) -> list[int]:
    return list(range(*values)[:_LONGEST])


_SUBSTITUTIONS: dict[str, Callable[[list[Any]], Any]] = {
    "LaunchConfiguration": _configuration,
    "LaunchConfigAsBool": _configuration,
    "EnvironmentVariable": lambda values: _environment(*values),
    "OptionalEnvironmentVariable": lambda values: _environment(*values),
    "TextSubstitution": lambda values: as_value(values[0] if values else ""),
    "ThisLaunchFileDir": lambda _values: Deferred("folder"),
    "ThisLaunchFile": lambda _values: Deferred("file"),
    "FindExecutable": lambda values: Unknown(f"path of the program {values[0] if values else ''}"),
    "ExecutableInPackage": lambda _values: Unknown("path of a program"),
    "FileContent": lambda values: Unknown(f"content of {values[0] if values else ''}"),
}
_PATHS: dict[str, Callable[..., Any]] = {
    "get_package_share_directory": _package,
    "get_package_share_path": _package,
    "get_package_prefix": lambda name: Deferred("prefix", (as_value(name),)),
}
_FUNCTIONS: dict[str, Callable[..., Any]] = {
    "os.path.join": _join,
    "os.path.dirname": _folder,
    "os.path.abspath": _same,
    "os.path.realpath": _same,
    "os.path.normpath": _same,
    "os.path.expanduser": _same,
    "os.getenv": _environment,
    "os.environ.get": _environment,
    "pathlib.Path": _join,
    "str": _as_text,
    "int": _plain(int),
    "float": _plain(float),
    "bool": _plain(bool),
    "len": lambda value: len(value) if isinstance(value, list | dict | str) else _plain(len)(value),
    "range": _plain(_range),
    "dict": lambda *values, **named: {**(dict(values[0]) if values else {}), **named},
    "sorted": _plain(sorted),
    "min": _plain(min),
    "max": _plain(max),
    "abs": _plain(abs),
    "any": _plain(any),
    "all": _plain(all),
    "eval": _evaluated,
    **dict.fromkeys(("print", "os.remove", "os.makedirs", "os.unlink", "os.mkdir"), _nothing),
}
