"""ROS 2 launch files in Python as actions: what ``generate_launch_description`` returns, without executing it."""

from __future__ import annotations

import ast
import warnings
from collections.abc import Callable as Function1
from collections.abc import Iterator
from typing import Any

import msgspec

from roslens.model.errors import DocumentError
from roslens.model.source import Location
from roslens.source.extract.domain.abstract_value import Callable, Named, Unknown
from roslens.source.extract.domain.guarded import Guarded
from roslens.source.extract.facts.files import Files
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch_python.deferred import Deferred, Scope, Value, resolve
from roslens.source.extract.launch_python.file_changes import condition_of, rewritten_file
from roslens.source.extract.launch_python.launch_action import Action, Parameter
from roslens.source.extract.launch_python.launch_context import context_of, keep_configurations
from roslens.source.extract.launch_python.launch_functions import Partial
from roslens.source.extract.launch_python.launch_parts import name_of, pairs_of, type_of
from roslens.source.extract.launch_python.launch_program import LaunchProgram
from roslens.source.extract.launch_python.launch_values import (
    PARAMETER_FILES,
    Either,
    Made,
    Plain,
    Visited,
    as_value,
    lifted,
    plain,
    shown,
)
from roslens.source.extract.launch_python.turns import turns_over, turns_up_to
from roslens.source.extract.parameters.ros2_values import type_of_list
from roslens.source.extract.symbolic.condition import negated
from roslens.source.extract.symbolic.text import And, Conditions, Text
from roslens.source.extract.symbolic.text import Condition as Formula
from roslens.source.extract.transfer.budget import BudgetExceededError

_ENTRY = "generate_launch_description"
_TYPES = {"str": "string", "int": "int", "float": "double", "bool": "bool"}


def python_actions(path: str, content: bytes, files: Files | None = None) -> tuple[Action, ...]:
    """Return the actions of a launch file in Python; modules are found among the files.

    Raises:
        DocumentError: it is no Python, or has no ``generate_launch_description``.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what Python thinks of the style of a file is not reported here
            ast.parse(content)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        where = Location(path, getattr(error, "lineno", 0) or 1, getattr(error, "offset", 0) or 1)
        what = getattr(error, "msg", "") or f"{error}"
        raise DocumentError(what, where=where, expected="Python that can be parsed") from None
    program = LaunchProgram(path, content, files)
    entry = program.entry(_ENTRY)
    if entry is None:
        raise DocumentError(
            f"no function {_ENTRY}", where=Location(path, 1, 1), expected="a launch file that defines it"
        )
    try:
        returned = program.run(entry, [], {})
        if returned is None:
            returned = Unknown(f"{_ENTRY} returns nothing")
        return tuple(_Conversion(program).all(returned, Evidence(path, entry.function.line)))
    except (BudgetExceededError, RecursionError):
        return (Action("unknown", Evidence(path, 1), {"text": _ENTRY}, note="it takes too many steps"),)


class _Conversion:
    """Makes actions of the objects that a file made."""

    def __init__(self, program: LaunchProgram, held: Conditions = ()) -> None:
        self._program = program
        self._held = held

    def all(self, found: Any, around: Evidence) -> Iterator[Action]:
        """Yield the actions of a list, of nested lists, of a description or of a single object."""
        if isinstance(found, list | tuple):
            for one in found:
                yield from self.all(one, around)
        elif isinstance(found, Made):
            yield from self._made(found)
        elif isinstance(found, Either):
            yield from self._under((found.condition,), found.one, around)
            yield from self._under((negated(found.condition),), found.other, around)
        elif isinstance(found, Guarded):
            yield from self._under(_parts(found.condition), found.value, around)
        elif isinstance(found, Unknown | Named):
            what = found.reason if isinstance(found, Unknown) else f"the name {found.name}"
            yield Action("unknown", around, {"text": str(what)}, note="it is unknown what it starts")
        elif found is not None:
            yield Action("unknown", around, {"text": shown(found)[:60]}, note="it is not an action")

    def _under(self, conditions: Conditions, found: Any, around: Evidence) -> Iterator[Action]:
        """Yield the actions of what is there under conditions, as far as these do not hold around it anyway."""
        fresh = tuple(one for one in conditions if one not in self._held)
        inner = _Conversion(self._program, (*self._held, *fresh))
        children = inner.all(found, around)
        yield from _noted(fresh, tuple(children), around) if fresh else children

    def _made(self, made: Made) -> Iterator[Action]:
        fresh = tuple(one for one in made.conditions if one not in self._held)
        inner = _Conversion(self._program, (*self._held, *fresh)) if fresh else self
        yield from _noted(fresh, tuple(inner.visited(Visited.of(made))), made.evidence)

    def visited(self, made: Visited) -> Iterator[Action]:
        """Yield what an object of launch is when it is visited."""
        if made.name == "LaunchDescription":
            for one in [*made.positional, *made.named.values()]:
                yield from self.all(one, made.evidence)
            return
        maker = _MAKERS.get(made.name)
        if maker is None:
            yield Action("unknown", made.evidence, {"text": made.name}, note="an unsupported action")
            return
        action = maker(self, made)
        condition = made.named.get("condition")
        if condition is not None:
            action = msgspec.structs.replace(action, condition=condition_of(condition))
        yield action

    def argument(self, made: Visited) -> Action:
        values: dict[str, Value] = {"name": as_value(made.argument(0, "name"))}
        default = made.argument(1, "default_value")
        if default is not None:
            values["default"] = as_value(default)
        values["description"] = as_value(made.named.get("description"))
        choices = made.named.get("choices")
        if isinstance(choices, list) and all(isinstance(one, str) for one in choices):
            values["choices"] = "\n".join(choices)
        return Action("argument", made.evidence, values)

    def setting(self, made: Visited) -> Action:
        values = {"name": as_value(made.argument(0, "name")), "value": as_value(made.argument(1, "value"))}
        return Action("set", made.evidence, values)

    def unsetting(self, made: Visited) -> Action:
        return Action("unset", made.evidence, {"name": as_value(made.argument(0, "name"))})

    def include(self, made: Visited) -> Action:
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

    def group(self, made: Visited) -> Action:
        scoped = made.named.get("scoped", True) is not False
        given = made.named.get("launch_configurations")
        pairs = given.items() if isinstance(given, dict) else ()
        settings = tuple(Parameter(made.evidence, as_value(name), as_value(value)) for name, value in pairs)
        children = tuple(self.all(made.argument(0, "actions"), made.evidence))
        return Action("group", made.evidence, children=children, scoped=scoped, parameters=settings)

    def namespace(self, made: Visited) -> Action:
        return Action("namespace", made.evidence, {"namespace": as_value(made.argument(0, "namespace"))})

    def parameter(self, made: Visited) -> Action:
        one = self._parameter(made.argument(0, "name"), made.argument(1, "value"), made.evidence)
        return Action("parameter", made.evidence, parameters=tuple(one))

    def parameter_file(self, made: Visited) -> Action:
        return Action("parameter", made.evidence, parameters=tuple(self._given([made.argument(0, "filename")], made)))

    def use_sim_time(self, made: Visited) -> Action:
        one = Parameter(made.evidence, "use_sim_time", as_value(made.argument(0, "value")), "bool")
        return Action("parameter", made.evidence, parameters=(one,))

    def remap(self, made: Visited) -> Action:
        pair = (as_value(made.argument(0, "src")), as_value(made.argument(1, "dst")))
        return Action("remap", made.evidence, remaps=(pair,))

    def node(self, made: Visited) -> Action:
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
            values["target"] = name_of(target)
        components = made.argument(0, "composable_node_descriptions") if kind in ("container", "load") else None
        arguments = made.named.get("arguments")
        remaps = made.named.get("remappings") or made.named.get("remapping_rules")
        return Action(
            kind,
            made.evidence,
            values,
            tuple(self.all(components, made.evidence)),
            parameters=tuple(self._given(made.named.get("parameters"), made)),
            remaps=tuple(pairs_of(remaps)),
            words=tuple(as_value(one) for one in arguments) if isinstance(arguments, list) else (),
        )

    def process(self, made: Visited) -> Action:
        command = made.argument(0, "cmd")
        words = tuple(as_value(one) for one in command) if isinstance(command, list) else (as_value(command),)
        return Action("process", made.evidence, {"executable": words[0] if words else ""}, words=words[1:])

    def sequence(self, made: Visited) -> Action:
        children = tuple(self.all(made.argument(1, "actions"), made.evidence))
        return Action("sequence", made.evidence, children=children)

    def handler(self, made: Visited) -> Action:
        return Action(
            "sequence", made.evidence, children=tuple(self.all(made.argument(0, "event_handler"), made.evidence))
        )

    def event(self, made: Visited) -> Action:
        children: list[Action] = []
        for name in ("on_exit", "on_start", "on_completion", "on_shutdown", "on_stdout", "on_stderr", "entities"):
            value = made.named.get(name)
            if value is not None and not isinstance(value, Callable | Unknown):
                children += self.all(value, made.evidence)
        return Action("sequence", made.evidence, children=tuple(children), note=_EVENTS.get(made.name, made.name))

    def function(self, made: Visited) -> Action:
        given, named = made.named.get("args") or [], made.named.get("kwargs") or {}

        def make(scope: Scope) -> tuple[Action, ...]:
            context = context_of(scope)
            arguments = [context, *map(lifted, given)]
            keywords = {one: lifted(value) for one, value in named.items()}
            found = self._called(made, made.argument(0, "function"), arguments, keywords, scope)
            keep_configurations(context, scope)
            return found

        return Action("call", made.evidence, make=make)

    def loop(self, made: Visited) -> Action:
        counts = made.name == "ForLoop"
        over = as_value(made.argument(0, "length" if counts else "input_values"))

        def make(scope: Scope) -> tuple[Action, ...]:
            value = resolve(over, scope)
            turns = turns_up_to(value, "i") if counts else turns_over(value)
            if turns is None:
                reason = f"it is unknown how often it starts what is in it: {value}"
                return (Action("unknown", made.evidence, {"text": made.name}, note=reason),)
            function = made.named.get("function")
            return tuple(
                action
                for turn in turns
                for action in self._called(made, function, [], {n: lifted(one) for n, one in turn.items()}, scope)
            )

        return Action("call", made.evidence, make=make)

    def _called(
        self, made: Visited, function: Plain, arguments: list[Plain], keywords: dict[str, Plain], scope: Scope
    ) -> tuple[Action, ...]:
        """Return the actions of what a function returns that is called when an action is visited."""
        given: list[Plain] = []
        while type(function) is Partial:
            given, keywords = [*function.arguments, *given], {**function.keywords, **keywords}
            function = function.function
        if not isinstance(function, Callable):
            reason = "it calls a function that is not in this file"
            return (Action("unknown", made.evidence, {"text": made.name}, note=reason),)
        try:
            returned = self._program.run(function, [*given, *arguments], keywords, scope)
            return tuple(self.all(returned, made.evidence))
        except (BudgetExceededError, RecursionError):
            return (Action("unknown", made.evidence, {"text": made.name}, note="it takes too many steps"),)

    def environment(self, made: Visited) -> Action:
        return Action("environment", made.evidence, {"name": as_value(made.argument(0, "name") or "*")})

    def nothing(self, made: Visited) -> Action:
        return Action("nothing", made.evidence)

    def _given(self, parameters: Any, made: Visited) -> Iterator[Parameter]:
        if isinstance(parameters, Unknown | Either):
            yield Parameter(made.evidence, file=as_value(parameters))
            return
        for given in parameters if isinstance(parameters, list | tuple) else [parameters]:
            one = plain(given)
            if isinstance(one, dict):
                for name, value in one.items():
                    yield from self._parameter(name, value, made.evidence)
            elif isinstance(one, list) and any(type(item) in _PARTS_OF_PARAMETERS for item in one):
                yield from self._given(one, made)
            elif isinstance(one, Made) and one.name in PARAMETER_FILES:
                file, changes = rewritten_file(one)
                yield Parameter(made.evidence, file=file, changes=changes)
            elif one is not None:
                yield Parameter(made.evidence, file=as_value(one))

    def _parameter(self, name: Any, value: Any, evidence: Evidence) -> Iterator[Parameter]:
        if isinstance(value, dict):
            for inner, one in value.items():
                yield from self._parameter(f"{shown(name)}.{shown(inner)}", one, evidence)
            return
        kind = ""
        if isinstance(value, Made) and value.name == "ParameterValue":
            kind = _TYPES.get(type_of(value.named.get("value_type")), "")
            value = plain(value.argument(0, "value"))
        match value:
            case list() if not any(isinstance(one, Deferred | Text | Made) for one in value):
                kind = kind or type_of_list([_TYPES.get(type(one).__name__, "") for one in value])
                yield Parameter(evidence, as_value(name), f"[{', '.join(shown(one) for one in value)}]", kind)
                return
            case bool() | int() | float() | str():
                kind = kind or _TYPES[type(value).__name__]
        yield Parameter(evidence, as_value(name), as_value(value), kind)


def _noted(conditions: Conditions, children: tuple[Action, ...], around: Evidence) -> Iterator[Action]:
    """Yield actions, as a sequence where they are there under conditions."""
    if not conditions:
        yield from children
    elif children:
        yield Action("sequence", around, children=children, note=" and ".join(map(str, conditions)))


def _parts(condition: Formula) -> Conditions:
    return condition.of if isinstance(condition, And) else (condition,)


_PARTS_OF_PARAMETERS = frozenset({dict, list, Made})
"""What a list of parameters has in it that is no part of a path."""
_NODES = {
    "Node": "node",
    "LifecycleNode": "lifecycle",
    "ComposableNodeContainer": "container",
    "ComposableNode": "component",
    "ComposableLifecycleNode": "component",
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
_MAKERS: dict[str, Function1[[_Conversion, Visited], Action]] = {
    "DeclareLaunchArgument": _Conversion.argument,
    "DeclareBooleanLaunchArgument": _Conversion.argument,
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
    "ForEach": _Conversion.loop,
    "ForLoop": _Conversion.loop,
    **dict.fromkeys(_NODES, _Conversion.node),
    **dict.fromkeys(_EVENTS, _Conversion.event),
    **dict.fromkeys(
        ("SetEnvironmentVariable", "AppendEnvironmentVariable", "UnsetEnvironmentVariable", "ResetEnvironment",
         "PopEnvironment"),
        _Conversion.environment,
    ),
    **dict.fromkeys(
        ("LogInfo", "Log", "LogDebug", "LogWarning", "LogError", "PushEnvironment", "Shutdown", "EmitEvent",
         "ResetLaunchConfigurations", "PushLaunchConfigurations", "PopLaunchConfigurations", "SetROSLogDir",
         "UnregisterEventHandler", "ReadyToTest"),
        _Conversion.nothing,
    ),
}  # fmt: skip
