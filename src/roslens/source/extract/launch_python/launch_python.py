"""ROS 2 launch files in Python as actions: what ``generate_launch_description`` returns, without executing it."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Callable, Iterator
from typing import Any

import msgspec

from roslens.model.errors import DocumentError
from roslens.model.source import Location
from roslens.source.extract.facts.files import Files
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch_python.deferred import Deferred, Scope, Value
from roslens.source.extract.launch_python.launch_action import Action, Condition, FileChange, Parameter
from roslens.source.extract.launch_python.launch_modules import Modules
from roslens.source.extract.launch_python.python_interpreter import Interpreter
from roslens.source.extract.launch_python.python_value import (
    PARAMETER_FILES,
    Closure,
    Either,
    Made,
    Unknown,
    as_value,
    shown,
)
from roslens.source.extract.launch_python.python_weight import TooLongError
from roslens.source.extract.parameters.ros2_values import type_of_list
from roslens.source.extract.symbolic.text import Text

_ENTRY = "generate_launch_description"
_TYPES = {"str": "string", "int": "int", "float": "double", "bool": "bool"}


def python_actions(path: str, content: bytes, files: Files | None = None) -> tuple[Action, ...]:
    """Return the actions of a launch file in Python; modules are found among the files.

    Raises:
        DocumentError: it is no Python, or has no ``generate_launch_description``.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what Python thinks of the style of a file is not told here
            tree = ast.parse(content)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        where = Location(path, getattr(error, "lineno", 0) or 1, getattr(error, "offset", 0) or 1)
        what = getattr(error, "msg", "") or f"{error}"
        raise DocumentError(what, where=where, expected="Python that can be parsed") from None
    try:
        interpreter = Interpreter(path, tree, Modules(files, _defined))
        entry = interpreter.function(_ENTRY)
        if entry is None:
            raise DocumentError(
                f"no function {_ENTRY}", where=Location(path, 1, 1), expected="a launch file that defines it"
            )
        returned = interpreter.call(entry, [], {})
    except (TooLongError, RecursionError):
        return (Action("unknown", Evidence(path, 1), {"text": _ENTRY}, note="it takes too many steps"),)
    if returned is None:
        returned = Unknown(f"{_ENTRY} returns nothing")
    return tuple(_Conversion(interpreter).all(returned, Evidence(path, entry.node.lineno)))


def _defined(path: str, tree: ast.Module, modules: Modules) -> dict[str, Any]:
    """Return what a module that a launch file imports defines."""
    return Interpreter(path, tree, modules).defined


class _Conversion:
    """Makes actions of the objects that a file made."""

    def __init__(self, interpreter: Interpreter) -> None:
        self._interpreter = interpreter

    def all(self, found: Any, around: Evidence) -> Iterator[Action]:
        """Yield the actions of a list, of nested lists, of a description or of a single object."""
        if isinstance(found, list | tuple):
            for one in found:
                yield from self.all(one, around)
        elif isinstance(found, Made):
            yield from self._made(found)
        elif isinstance(found, Either):
            for note, value in ((found.note, found.one), (f"not {found.note}", found.other)):
                children = tuple(self.all(value, around))
                if children:
                    yield Action("sequence", around, children=children, note=note)
        elif isinstance(found, Unknown):
            yield Action("unknown", around, {"text": found.reason}, note="it is not known what it starts")
        elif found is not None:
            yield Action("unknown", around, {"text": shown(found)[:60]}, note="it is no action")

    def _made(self, made: Made) -> Iterator[Action]:
        if made.name in ("LaunchDescription", "_noted"):
            for one in [*made.positional, *made.named.values()]:
                children = tuple(self.all(one, made.evidence))
                if made.name == "_noted" and children:
                    yield Action("sequence", made.evidence, children=children, note=" and ".join(made.notes))
                else:
                    yield from children
            return
        maker = _MAKERS.get(made.name)
        if maker is None:
            yield Action("unknown", made.evidence, {"text": made.name}, note="no action that is known here")
            return
        action = maker(self, made)
        condition = made.named.get("condition")
        if condition is not None:
            action = msgspec.structs.replace(action, condition=_condition(condition))
        if made.notes:
            action = Action("sequence", made.evidence, children=(action,), note=" and ".join(made.notes))
        yield action

    def argument(self, made: Made) -> Action:
        values: dict[str, Value] = {"name": as_value(made.argument(0, "name"))}
        default = made.argument(1, "default_value")
        if default is not None:
            values["default"] = as_value(default)
        values["description"] = as_value(made.named.get("description"))
        choices = made.named.get("choices")
        if isinstance(choices, list) and all(isinstance(one, str) for one in choices):
            values["choices"] = "\n".join(choices)
        return Action("argument", made.evidence, values)

    def setting(self, made: Made) -> Action:
        values = {"name": as_value(made.argument(0, "name")), "value": as_value(made.argument(1, "value"))}
        return Action("set", made.evidence, values)

    def unsetting(self, made: Made) -> Action:
        return Action("unset", made.evidence, {"name": as_value(made.argument(0, "name"))})

    def include(self, made: Made) -> Action:
        given = made.named.get("launch_arguments")
        pairs = list(given.items()) if isinstance(given, dict) else given if isinstance(given, list) else []
        children = [
            Action("set", made.evidence, {"name": as_value(pair[0]), "value": as_value(pair[1])})
            for pair in pairs
            if isinstance(pair, list | tuple) and len(pair) == 2
        ]
        source = made.argument(0, "launch_description_source")
        if isinstance(source, Made):
            return Action("sequence", made.evidence, children=(*children, *self.all(source, made.evidence)))
        return Action("include", made.evidence, {"file": as_value(source)}, tuple(children))

    def group(self, made: Made) -> Action:
        scoped = made.named.get("scoped", True) is not False
        given = made.named.get("launch_configurations")
        pairs = given.items() if isinstance(given, dict) else ()
        settings = tuple(Parameter(made.evidence, as_value(name), as_value(value)) for name, value in pairs)
        children = tuple(self.all(made.argument(0, "actions"), made.evidence))
        return Action("group", made.evidence, children=children, scoped=scoped, parameters=settings)

    def namespace(self, made: Made) -> Action:
        return Action("namespace", made.evidence, {"namespace": as_value(made.argument(0, "namespace"))})

    def parameter(self, made: Made) -> Action:
        one = self._parameter(made.argument(0, "name"), made.argument(1, "value"), made.evidence)
        return Action("parameter", made.evidence, parameters=tuple(one))

    def parameter_file(self, made: Made) -> Action:
        return Action("parameter", made.evidence, parameters=tuple(self._given([made.argument(0, "filename")], made)))

    def use_sim_time(self, made: Made) -> Action:
        one = Parameter(made.evidence, "use_sim_time", as_value(made.argument(0, "value")), "bool")
        return Action("parameter", made.evidence, parameters=(one,))

    def remap(self, made: Made) -> Action:
        pair = (as_value(made.argument(0, "src")), as_value(made.argument(1, "dst")))
        return Action("remap", made.evidence, remaps=(pair,))

    def node(self, made: Made) -> Action:
        kind = _NODES[made.name]
        names = {"package": "package", "executable": "executable", "node_executable": "executable", "name": "name",
                 "node_name": "name", "namespace": "namespace", "node_namespace": "namespace", "plugin": "plugin",
                 "node_plugin": "plugin", "target_container": "target"}  # fmt: skip
        values = {
            known: as_value(value)
            for name, known in names.items()
            if (value := made.named.get(name)) is not None and not isinstance(value, Made)
        }
        target = made.argument(1, "target_container")
        if isinstance(target, Made):
            values["target"] = _within(target)
        components = made.argument(0, "composable_node_descriptions") if kind in ("container", "load") else None
        arguments = made.named.get("arguments")
        remaps = made.named.get("remappings") or made.named.get("remapping_rules")
        return Action(
            kind,
            made.evidence,
            values,
            tuple(self.all(components, made.evidence)),
            parameters=tuple(self._given(made.named.get("parameters"), made)),
            remaps=tuple(_pairs(remaps)),
            words=tuple(as_value(one) for one in arguments) if isinstance(arguments, list) else (),
        )

    def process(self, made: Made) -> Action:
        command = made.argument(0, "cmd")
        words = tuple(as_value(one) for one in command) if isinstance(command, list) else (as_value(command),)
        return Action("process", made.evidence, {"executable": words[0] if words else ""}, words=words[1:])

    def sequence(self, made: Made) -> Action:
        children = tuple(self.all(made.argument(1, "actions"), made.evidence))
        return Action("sequence", made.evidence, children=children)

    def handler(self, made: Made) -> Action:
        return Action(
            "sequence", made.evidence, children=tuple(self.all(made.argument(0, "event_handler"), made.evidence))
        )

    def event(self, made: Made) -> Action:
        children: list[Action] = []
        for name in ("on_exit", "on_start", "on_completion", "on_shutdown", "on_stdout", "on_stderr", "entities"):
            value = made.named.get(name)
            if value is not None and not isinstance(value, Closure | Unknown):
                children += self.all(value, made.evidence)
        return Action("sequence", made.evidence, children=tuple(children), note=_EVENTS.get(made.name, made.name))

    def function(self, made: Made) -> Action:
        function = made.argument(0, "function")
        given, named = made.named.get("args") or [], made.named.get("kwargs") or {}

        def make(scope: Scope) -> tuple[Action, ...]:
            if not isinstance(function, Closure):
                reason = "it calls a function that is not in this file"
                return (Action("unknown", made.evidence, {"text": "OpaqueFunction"}, note=reason),)
            try:
                context = Unknown("the launch context")
                returned = self._interpreter.call(function, [context, *given], dict(named), scope)
            except (TooLongError, RecursionError):
                return (Action("unknown", made.evidence, {"text": "OpaqueFunction"}, note="it takes too many steps"),)
            return tuple(self.all(returned, made.evidence))

        return Action("call", made.evidence, make=make)

    def environment(self, made: Made) -> Action:
        return Action("environment", made.evidence, {"name": as_value(made.argument(0, "name") or "*")})

    def nothing(self, made: Made) -> Action:
        return Action("nothing", made.evidence)

    def _given(self, parameters: Any, made: Made) -> Iterator[Parameter]:
        if isinstance(parameters, Unknown | Either):
            yield Parameter(made.evidence, file=as_value(parameters))
            return
        for one in parameters if isinstance(parameters, list | tuple) else [parameters]:
            if isinstance(one, dict):
                for name, value in one.items():
                    yield from self._parameter(name, value, made.evidence)
            elif isinstance(one, list):
                yield from self._given(one, made)
            elif isinstance(one, Made) and one.name in PARAMETER_FILES:
                yield self._file(one, made.evidence)
            elif one is not None:
                yield Parameter(made.evidence, file=as_value(one))

    def _file(self, made: Made, evidence: Evidence) -> Parameter:
        source = made.argument(0, "param_file", "source_file")
        inner = self._file(source, evidence) if isinstance(source, Made) and source.name in PARAMETER_FILES else None
        file = as_value(source) if inner is None else inner.file
        return Parameter(evidence, file=file, changes=(*(inner.changes if inner else ()), *_changes(made)))

    def _parameter(self, name: Any, value: Any, evidence: Evidence) -> Iterator[Parameter]:
        if isinstance(value, dict):
            for inner, one in value.items():
                yield from self._parameter(f"{shown(name)}.{shown(inner)}", one, evidence)
            return
        kind = ""
        if isinstance(value, Made) and value.name == "ParameterValue":
            kind = _TYPES.get(shown_type(value.named.get("value_type")), "")
            value = value.argument(0, "value")
        match value:
            case list() if not any(isinstance(one, Deferred | Text | Made) for one in value):
                kind = kind or type_of_list([_TYPES.get(type(one).__name__, "") for one in value])
                yield Parameter(evidence, as_value(name), f"[{', '.join(shown(one) for one in value)}]", kind)
                return
            case bool() | int() | float() | str():
                kind = kind or _TYPES[type(value).__name__]
        yield Parameter(evidence, as_value(name), as_value(value), kind)


def shown_type(found: Any) -> str:
    """Return the name of a type that is given to a parameter."""
    return getattr(found, "last", "") or (found.reason.rpartition(" ")[2] if isinstance(found, Unknown) else "")


def _changes(made: Made) -> Iterator[FileChange]:
    """Yield what is done to a file of parameters, in the order in which it is done."""
    if made.name == "ReplaceString":
        given = made.named.get("condition")
        held = Condition("true") if given is None else _condition(given)
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


def _condition(found: Any) -> Condition:
    match found:
        case Made() if found.name in ("IfCondition", "UnlessCondition"):
            return Condition(as_value(found.argument(0, "predicate_expression")), found.name == "IfCondition")
        case Made() if found.name.startswith("LaunchConfiguration"):
            name = Deferred("configuration", (as_value(found.argument(0, "launch_configuration_name")),))
            value = Deferred("equals", (name, as_value(found.argument(1, "expected_value"))))
            return Condition(value, found.name == "LaunchConfigurationEquals")
    return Condition(as_value(found if not isinstance(found, Made) else Unknown(f"a {found.name}")))


def _within(container: Made) -> Value:
    """Return the name of a container that is meant by the object."""
    namespace, name = container.named.get("namespace"), container.named.get("name")
    if namespace in (None, ""):
        return as_value(name)
    return Deferred("text", (as_value(namespace), "/", as_value(name)))


def _pairs(remaps: Any) -> Iterator[tuple[Value, Value]]:
    for pair in remaps if isinstance(remaps, list | tuple) else ():
        if isinstance(pair, list | tuple) and len(pair) == 2:
            yield as_value(pair[0]), as_value(pair[1])


_NODES = {
    "Node": "node",
    "LifecycleNode": "lifecycle",
    "ComposableNodeContainer": "container",
    "ComposableNode": "component",
    "LoadComposableNodes": "load",
}
_EVENTS = {
    "OnProcessExit": "when a process ends",
    "OnProcessStart": "when a process starts",
    "OnProcessIO": "when a process writes",
    "OnShutdown": "at shutdown",
    "OnExecutionComplete": "when an action is complete",
    "OnStateTransition": "when a node changes its state",
}
_MAKERS: dict[str, Callable[[_Conversion, Made], Action]] = {
    "DeclareLaunchArgument": _Conversion.argument,
    "SetLaunchConfiguration": _Conversion.setting,
    "UnsetLaunchConfiguration": _Conversion.unsetting,
    "IncludeLaunchDescription": _Conversion.include,
    "GroupAction": _Conversion.group,
    "PushRosNamespace": _Conversion.namespace,
    "PushROSNamespace": _Conversion.namespace,
    "SetParameter": _Conversion.parameter,
    "SetParametersFromFile": _Conversion.parameter_file,
    "SetUseSimTime": _Conversion.use_sim_time,
    "SetRemap": _Conversion.remap,
    "ExecuteProcess": _Conversion.process,
    "ExecuteLocal": _Conversion.process,
    "TimerAction": _Conversion.sequence,
    "RosTimer": _Conversion.sequence,
    "RegisterEventHandler": _Conversion.handler,
    "OpaqueFunction": _Conversion.function,
    **dict.fromkeys(_NODES, _Conversion.node),
    **dict.fromkeys(_EVENTS, _Conversion.event),
    **dict.fromkeys(
        ("SetEnvironmentVariable", "AppendEnvironmentVariable", "UnsetEnvironmentVariable", "ResetEnvironment",
         "PopEnvironment"),
        _Conversion.environment,
    ),
    **dict.fromkeys(
        ("LogInfo", "PushEnvironment", "Shutdown", "EmitEvent", "ResetLaunchConfigurations", "PushLaunchConfigurations",
         "PopLaunchConfigurations", "SetROSLogDir", "UnregisterEventHandler",
         "ReadyToTest"),
        _Conversion.nothing,
    ),
}  # fmt: skip
