"""Calls that a Python launch file makes: the substitutions of launch, paths, and a little of Python itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.launch_python.launch_action import text
from roslens.source.extract.launch_python.launch_file_reads import Opened
from roslens.source.extract.launch_python.python_value import Bound, Closure, Dotted, Made, Unknown, as_value
from roslens.source.extract.symbolic.python_expression import evaluate
from roslens.source.extract.symbolic.text import Text

_LONGEST = 10_000
_ACTIONS = frozenset(
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


def known_name(name: str) -> Any:
    """Return what a name means that the file does not define."""
    return Dotted(name) if name in _FUNCTIONS or name == "open" else Unknown(f"the name {name}")


def call_known(
    function: Dotted, positional: list[Any], named: dict[str, Any], evidence: Evidence, notes: tuple[str, ...]
) -> Any:
    """Return what a call of something imported makes."""
    last = function.last
    if last in _ACTIONS:
        return Made(last, evidence, list(positional), dict(named), notes)
    if last in _SOURCES:
        return as_value(positional[0] if positional else next(iter(named.values()), None))
    substitution = _SUBSTITUTIONS.get(last)
    if substitution is not None:
        # Names of what is substituted come before their defaults, in whichever order they are given.
        last_ones = sorted(named.items(), key=lambda one: one[0] in _DEFAULTS)
        return substitution([*positional, *(value for _, value in last_ones)])
    if last in _PARTS:
        return _of_parts(last, [*positional, *named.values()])
    known = _FUNCTIONS.get(function.name) or _PATHS.get(last)
    if known is None:
        return Unknown(f"result of {function.name}()")
    try:
        return known(*positional, **named)
    except (TypeError, ValueError, ArithmeticError, LookupError, AttributeError):
        return Unknown(f"result of {function.name}()")


def call_method(bound: Bound, positional: list[Any], named: dict[str, Any], written: str) -> Any:
    """Return what a method of a value returns."""
    of, name = bound.of, bound.name
    match of:
        case dict():
            return _of_dictionary(of, name, positional)
        case Opened() if name in ("read", "read_text"):
            return of
        case str() if name == "join" and positional and isinstance(positional[0], list):
            pieces = [piece for one in positional[0] for piece in (of, as_value(one))][1:]
            return text(*pieces) if pieces else ""
        case str() if name == "format":
            return _formatted(of, positional, named)
        case str() if name in _METHODS and all(isinstance(one, str | int) for one in positional):
            found = getattr(of, name)(*positional)
            return found if not isinstance(found, str) or len(found) <= _LONGEST else Unknown("a text that is too long")
        case list() if name == "copy":
            return list(of)
        case str() | Deferred() | Text() if name in ("as_posix", "resolve", "absolute", "expanduser"):
            return of
        case str() | Deferred() | Text() if name == "joinpath":
            return Deferred("path", (as_value(of), *map(as_value, positional)))
    return Unknown(f"result of {written}()")


def _of_dictionary(of: dict[Any, Any], name: str, positional: list[Any]) -> Any:
    if name == "items":
        return [[key, value] for key, value in of.items()]
    if name == "keys":
        return list(of)
    if name == "values":
        return list(of.values())
    if name == "update" and positional and isinstance(positional[0], dict):
        of.update(positional[0])
        return None
    if name == "copy":
        return dict(of)
    if name in ("get", "pop") and positional and isinstance(positional[0], str | int):
        return of.get(positional[0], positional[1] if len(positional) > 1 else None)
    return Unknown(f"result of {name}() of a dictionary")


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
            if isinstance(one, Unknown | Deferred | Text | Made | Closure):
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


def _enumerate(items: list[Any], start: int = 0) -> list[list[Any]]:
    return [[start + index, one] for index, one in enumerate(items)]


def _zip(*items: list[Any]) -> list[list[Any]]:
    return [list(one) for one in zip(*items, strict=False)]


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
    "enumerate": _enumerate,
    "zip": _zip,
    "list": lambda value=(): list(value),
    "tuple": lambda value=(): list(value),
    "set": lambda value=(): list(value),
    "dict": lambda *values, **named: {**(dict(values[0]) if values else {}), **named},
    "sorted": _plain(sorted),
    "reversed": lambda value: list(reversed(value)),
    "min": _plain(min),
    "max": _plain(max),
    "abs": _plain(abs),
    "any": _plain(any),
    "all": _plain(all),
    "eval": _evaluated,
    **dict.fromkeys(("print", "os.remove", "os.makedirs", "os.unlink", "os.mkdir"), _nothing),
}
