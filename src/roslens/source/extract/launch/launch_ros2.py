"""ROS 2 launch files: what they would start and set, without executing them.

Actions of XML, YAML and Python files are visited as the launch service would (design.ros2.org/articles/roslaunch.html),
with launch configurations, namespaces, parameters and remappings that are scoped by groups. Both ways of an unknown
condition are followed, and what is started there keeps the condition.
"""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from roslens.model.errors import DocumentError
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Argument, Launch, Launched, Remap, Setting, Unresolved
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch.bridge_files import with_bridges
from roslens.source.extract.launch.launch_parameter_files import ParameterFiles
from roslens.source.extract.launch_python.deferred import Scope, Value, resolve, truth
from roslens.source.extract.launch_python.launch_action import Action, Condition, Parameter
from roslens.source.extract.launch_python.turns import turns_over, turns_up_to
from roslens.source.extract.parameters.ros2_values import type_in_launch
from roslens.source.extract.symbolic.text import Conditions, Not, Text, Written, unknown

MOST_FILES = 200
MOST_DEPTH = 30
MOST_ACTIONS = 20_000
_STARTED = frozenset({"node", "lifecycle", "container", "process"})


class _Space(msgspec.Struct):
    """What holds for the actions that follow, besides launch configurations."""

    namespace: Text = Text(("/",))
    settings: tuple[Setting, ...] = ()
    remaps: tuple[Remap, ...] = ()
    conditions: Conditions = ()


def evaluate_ros2(
    path: str, files: Files, arguments: Mapping[str, str] | None = None, environment: Mapping[str, str] | None = None
) -> Launch:
    """Return what a launch file comes to.

    Args:
        path: of the file in the workspace.
        files: that may be read.
        arguments: given on the command line, by name.
        environment: variables that are known.
    """
    given = {name: Text.of(value) for name, value in (arguments or {}).items()}
    whole = _Whole(files, environment or {})
    whole.file(path, given, _Space(), Evidence(path, 0), outer=True)
    return Launch(
        "ros2", tuple(whole.nodes), (), tuple(whole.arguments), tuple(whole.included), tuple(whole.unresolved)
    )


def actions_of(path: str, content: bytes, files: Files | None = None) -> tuple[Action, ...]:
    """Return the actions of a launch file by its name: Python, YAML, else XML.

    Raises:
        DocumentError: it cannot be read at all.
    """
    if path.endswith(".py"):
        from roslens.source.extract.launch_python.launch_python import python_actions

        return python_actions(path, content, files)
    from roslens.source.extract.launch.launch_markup import xml_actions, yaml_actions

    return (yaml_actions if path.endswith((".yaml", ".yml")) else xml_actions)(path, content)


class _Whole:
    """Visits actions and collects what they come to."""

    def __init__(self, files: Files, environment: Mapping[str, str]) -> None:
        self.files = files
        self.nodes: list[Launched] = []
        self.arguments: list[Argument] = []
        self.included: list[str] = []
        self.unresolved: list[Unresolved] = []
        self._environment = environment
        self._assigned: set[str] = set()
        self._open: list[str] = []
        self._rewritten_files: list[tuple[Text, ...]] = []
        self._read = self._visited = 0
        self._parameter_files = ParameterFiles(files)

    def file(
        self, path: str, configurations: dict[str, Text], space: _Space, evidence: Evidence, *, outer: bool = False
    ) -> None:
        """Visit the actions of a file."""
        if path in self._open:
            self.miss(path, evidence, f"it includes itself: {' > '.join([*self._open, path])}", opens=True)
            return
        if len(self._open) >= MOST_DEPTH or self._read >= MOST_FILES:
            self.miss(path, evidence, f"more than {MOST_FILES} files, or {MOST_DEPTH} levels of includes", opens=True)
            return
        content = self.files.content(path)
        if content is None:
            self.miss(path, evidence, "there is no such file in the workspace", opens=True)
            return
        self._read += 1
        try:
            actions = actions_of(path, content, self.files)
        except DocumentError as error:
            self.miss(path, *_place_and_reason(error, path, evidence), opens=True)
            return
        self._open.append(path)
        scope = Scope(
            self.files, configurations, self._environment, path, self._assigned, rewritten=self._rewritten_files
        )
        if outer:
            self._declare(actions, msgspec.structs.replace(scope, configurations=dict(configurations)))
        self._all(actions, scope, space)
        self._open.pop()

    def miss(self, text: str, evidence: Evidence, reason: str, *, opens: bool = False) -> None:
        """Note what could not be evaluated, once for each place, and whether it may start further nodes."""
        found = Unresolved(text, evidence, reason, opens)
        if found not in self.unresolved[-50:]:
            self.unresolved.append(found)

    def _declare(self, actions: tuple[Action, ...], scope: Scope) -> None:
        """Note the arguments of the outermost file; a default may be made of arguments declared before it."""
        for action in actions:
            if action.kind == "set":
                name = str(resolve(action.values["name"], scope))
                scope.configurations[name] = resolve(action.values["value"], scope)
            elif action.kind == "argument":
                name = str(resolve(action.values["name"], scope))
                written = action.values.get("default")
                default = None if written is None else resolve(written, scope)
                held = unknown(f"argument {name}, which is not given") if default is None else default
                scope.configurations.setdefault(name, held)
                choices = action.values.get("choices", "")
                self.arguments.append(
                    Argument(
                        name,
                        action.evidence,
                        default,
                        str(resolve(action.values.get("description", ""), scope)),
                        tuple(one for one in str(choices).split("\n") if one) if isinstance(choices, str) else (),
                    )
                )
            elif action.kind in ("group", "sequence"):
                self._declare(action.children, scope)

    def _all(self, actions: tuple[Action, ...], scope: Scope, space: _Space) -> None:
        for action in actions:
            self._visited += 1
            if self._visited > MOST_ACTIONS:
                self.miss(action.kind, action.evidence, f"more than {MOST_ACTIONS:,} actions", opens=True)
                return
            condition = self._condition(action, scope)
            if condition is not None:
                inner = msgspec.structs.replace(space, conditions=(*space.conditions, *condition))
                self._visit(action, scope, space, inner)

    def _condition(self, action: Action, scope: Scope) -> Conditions | None:
        """Return conditions that stay open; None where the action is not visited."""
        condition = action.condition
        if condition is None:
            return ()
        value = resolve(condition.value, scope)
        try:
            holds = truth(value)
        except ValueError as error:
            self.miss(str(_written(condition)), action.evidence, str(error))
            holds = None
        if holds is None:
            return (_written(condition),)
        return () if holds is condition.wanted else None

    def _visit(self, action: Action, scope: Scope, space: _Space, inner: _Space) -> None:
        """Visit one action; ``space`` is what it may change for those after it, ``inner`` what holds for it."""
        if action.kind in _STARTED:
            self._start(action, scope, inner)
        elif action.kind == "load":
            self._load(action.children, resolve(action.values.get("target", ""), scope), scope, inner)
        elif action.kind == "include":
            self._include(action, scope, inner)
            _keep(inner, space)
        elif action.kind == "group":
            self._group(action, scope, space, inner)
        elif action.kind == "sequence":
            self._sequence(action.children, action.note, scope, inner)
            _keep(inner, space)
        elif action.kind == "call" and action.make is not None:
            self._sequence(action.make(scope), action.note, scope, inner)
            _keep(inner, space)
        elif action.kind == "loop":
            self._loop(action, scope, inner)
            _keep(inner, space)
        elif action.kind == "unknown":
            self.miss(str(resolve(action.values.get("text", ""), scope)), action.evidence, action.note, opens=True)
        else:
            self._change(action, scope, space)

    def _change(self, action: Action, scope: Scope, space: _Space) -> None:
        """Change what holds for the actions after this one."""
        values = action.values
        if action.kind == "argument":
            name = str(resolve(values["name"], scope))
            if name in scope.configurations:
                return
            if "default" in values:
                scope.configurations[name] = resolve(values["default"], scope)
            else:
                scope.configurations[name] = unknown(f"argument {name}, which is not given")
                self.miss(name, action.evidence, "the argument is required, but not given")
        elif action.kind == "set":
            scope.configurations[str(resolve(values["name"], scope))] = resolve(values["value"], scope)
        elif action.kind == "unset":
            scope.configurations.pop(str(resolve(values["name"], scope)), None)
        elif action.kind == "environment":
            scope.assigned.add(resolve(values["name"], scope).known or "*")
        elif action.kind == "namespace":
            space.namespace = within(space.namespace, resolve(values["namespace"], scope))
        elif action.kind == "parameter":
            space.settings = (*space.settings, *self._settings(action.parameters, scope))
        elif action.kind == "remap":
            space.remaps = (*space.remaps, *_remaps(action, scope))

    def _group(self, action: Action, scope: Scope, space: _Space, inner: _Space) -> None:
        if action.scoped:
            scope = msgspec.structs.replace(scope, configurations=dict(scope.configurations))
            for one in action.parameters:
                name = resolve(one.name, scope).known
                if name is not None:
                    scope.configurations[name] = resolve(one.value, scope)
            self._all(action.children, scope, msgspec.structs.replace(inner))
            return
        self._all(action.children, scope, inner)
        _keep(inner, space)

    def _sequence(self, children: tuple[Action, ...], note: str, scope: Scope, inner: _Space) -> None:
        if note:
            inner.conditions = (*inner.conditions, Written(note))
        self._all(children, scope, inner)

    def _loop(self, action: Action, scope: Scope, inner: _Space) -> None:
        """Visit the children once a turn."""
        over = resolve(action.values["over"], scope)
        name = resolve(action.values["name"], scope).known if "name" in action.values else None
        turns = turns_over(over) if name is None else turns_up_to(over, name)
        if turns is None:
            self.miss(
                f"a loop over {over}", action.evidence, "it is unknown how often it starts its actions", opens=True
            )
        for turn in turns or ():
            found = {**scope.turns, **{name: Text.of(str(value)) for name, value in turn.items()}}
            self._all(action.children, msgspec.structs.replace(scope, turns=found), inner)

    def _include(self, action: Action, scope: Scope, inner: _Space) -> None:
        file = resolve(action.values["file"], scope)
        if file.known is None:
            self.miss(str(file), action.evidence, str(file.holes[0].reason), opens=True)
            return
        path = _place(file.known)
        # An included file sees what is set around it, and what it sets stays set after it.
        for child in action.children:
            scope.configurations[str(resolve(child.values["name"], scope))] = resolve(child.values["value"], scope)
        if path not in self.included:
            self.included.append(path)
        self.file(path, scope.configurations, inner, action.evidence)

    def _start(self, action: Action, scope: Scope, inner: _Space) -> None:
        values = action.values
        launched = Launched(
            package=resolve(values.get("package", ""), scope),
            executable=resolve(values.get("executable", ""), scope),
            evidence=action.evidence,
            name=resolve(values.get("name", ""), scope),
            namespace=within(inner.namespace, resolve(values.get("namespace", ""), scope)),
            settings=(*inner.settings, *self._settings(action.parameters, scope)),
            remaps=(*inner.remaps, *_remaps(action, scope)),
            arguments=tuple(resolve(one, scope) for one in action.words),
            conditions=inner.conditions,
            kind=action.kind,
        )
        self.nodes.append(with_bridges(launched, self.files))
        if action.kind == "container":
            self._load(action.children, full_name(launched), scope, inner)

    def _load(self, components: tuple[Action, ...], container: Text, scope: Scope, inner: _Space) -> None:
        for one in components:
            conditions = self._condition(one, scope)
            if conditions is None:
                continue
            if one.kind == "sequence":
                held = (*inner.conditions, *((Written(one.note),) if one.note else ()))
                self._load(one.children, container, scope, msgspec.structs.replace(inner, conditions=held))
                continue
            if one.kind == "unknown":
                self.miss(str(resolve(one.values.get("text", ""), scope)), one.evidence, one.note, opens=True)
                continue
            values = one.values
            self.nodes.append(
                Launched(
                    package=resolve(values.get("package", ""), scope),
                    executable=Text(),
                    evidence=one.evidence,
                    name=resolve(values.get("name", ""), scope),
                    namespace=within(inner.namespace, resolve(values.get("namespace", ""), scope)),
                    plugin=resolve(values.get("plugin", ""), scope),
                    container=container,
                    settings=(*inner.settings, *self._settings(one.parameters, scope)),
                    remaps=(*inner.remaps, *_remaps(one, scope)),
                    conditions=(*inner.conditions, *conditions),
                    kind="component",
                )
            )

    def _settings(self, parameters: tuple[Parameter, ...], scope: Scope) -> list[Setting]:
        found: list[Setting] = []
        for one in parameters:
            if one.file is None:
                value = resolve(one.value, scope)
                kind = one.type or (type_in_launch(value.known) if value.known is not None else "")
                found.append(Setting(resolve(one.name, scope), value, one.evidence, kind))
                continue
            file, changes = self._parameter_files.of_copy(resolve(one.file, scope), one.changes, scope)
            if file.known is None:
                self.miss(str(file), one.evidence, str(file.holes[0].reason))
                continue
            path = _place(file.known)
            try:
                settings = self._parameter_files.settings(path, changes, scope)
            except DocumentError as error:
                self.miss(error.what, one.evidence, f"{error.where}: expected {error.expected}")
                continue
            if settings is None:
                self.miss(path, one.evidence, "there is no such file in the workspace")
            found += settings or []
        return found


def _place(path: str) -> str:
    """Return a path without detours; one from the root of the machine stays one."""
    return f"{'/' * path.startswith('/')}{joined('', path)}"


def _place_and_reason(error: DocumentError, path: str, evidence: Evidence) -> tuple[Evidence, str]:
    """Return where to look for what cannot be read, and why: in the file, or where another one includes it."""
    reason = f"{error.what}; expected {error.expected}"
    if evidence.line:
        return evidence, f"{error.where}: {reason}"
    line, _, column = error.where.removeprefix(f"{path}:").partition(":")
    return Evidence(path, int(line), int(column)) if line.isdigit() and column.isdigit() else evidence, reason


def _keep(inner: _Space, space: _Space) -> None:
    """Let what was set within hold after it."""
    space.namespace, space.settings, space.remaps = inner.namespace, inner.settings, inner.remaps


def _remaps(action: Action, scope: Scope) -> list[Remap]:
    return [Remap(resolve(source, scope), resolve(target, scope), action.evidence) for source, target in action.remaps]


def _written(condition: Condition) -> Written | Not:
    text = Written(condition.written or _shown(condition.value))
    return text if condition.wanted else Not(text)


def _shown(value: Value) -> str:
    match value:
        case str() | Text():
            return str(value)
    inside = ", ".join(_shown(part) for part in value.parts)
    return inside if value.kind in ("configuration", "text", "unknown") else f"{value.kind}({inside})"


def within(namespace: Text, name: Text) -> Text:
    """Return a namespace below another one, or itself where it begins with ``/``."""
    if not name.parts:
        return namespace
    is_global = name.is_global
    if len(name.parts) > 1 and name.tail.endswith("/"):
        name = Text((*name.parts[:-1], name.tail.rstrip("/")))
    elif len(name.parts) == 1 and len(name.head) > 1:
        name = Text.of(name.head.rstrip("/"))
    if is_global:
        return name
    return Text.of("/", name) if namespace.parts == ("/",) else Text.of(namespace, "/", name)


def full_name(launched: Launched) -> Text:
    """Return the resolved name of a node that was given one."""
    return within(launched.namespace, launched.name) if launched.name.parts else Text()
