"""ROS 2 launch files: what they would start and set, without executing them.

Actions of XML, YAML and Python files are visited as the launch service would (design.ros2.org/articles/roslaunch.html),
with launch configurations, namespaces, parameters and remappings that are scoped by groups. Both ways of an unknown
condition are followed, and what is started there keeps the condition.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

import msgspec

from roslens.model.configuration import Standing
from roslens.model.errors import DocumentError
from roslens.source.extract.facts.files import Files
from roslens.source.extract.facts.launched import Argument, Fault, Launch, Launched, Setting, Unresolved
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch.bridge_files import with_bridges
from roslens.source.extract.launch.launch_budget import within_budget
from roslens.source.extract.launch.launch_failures import Failures
from roslens.source.extract.launch.launch_markup import actions_of
from roslens.source.extract.launch.launch_parameter_files import ParameterFiles
from roslens.source.extract.launch.launch_reasons import place_and_reason, place_of, standing_of, written_condition
from roslens.source.extract.launch.ros2_names import full_name, within
from roslens.source.extract.launch.ros2_space import Space, keep, remaps_of
from roslens.source.extract.launch_python.deferred import Scope, Value, condition_holds, resolve
from roslens.source.extract.launch_python.launch_action import Action, Parameter
from roslens.source.extract.launch_python.shared_values import SharedValues
from roslens.source.extract.launch_python.turns import turns_over, turns_up_to
from roslens.source.extract.parameters.ros2_values import type_in_launch
from roslens.source.extract.symbolic.text import Conditions, Text, Written, unknown

MOST_FILES = 200
MOST_DEPTH = 30
MOST_ACTIONS = 20_000
_STARTED = frozenset({"node", "lifecycle", "container", "process"})


def evaluate_ros2(
    path: str,
    files: Files,
    arguments: Mapping[str, str] | None = None,
    environment: Mapping[str, str] | None = None,
    *,
    any_arguments: bool = False,
) -> Launch:
    """Return what a launch file comes to.

    Args:
        path: of the file in the workspace.
        files: that may be read.
        arguments: given on the command line, by name.
        environment: variables that are known.
        any_arguments: whether defaults are left open, so that every way that arguments may choose is followed.
    """
    given = {name: Text.of(value) for name, value in (arguments or {}).items()}
    whole = _Whole(files, environment or {}, any_arguments=any_arguments)
    place = Evidence(path, 0)
    within_budget(whole.miss, whole.failures, path, place, partial(whole.file, path, given, Space(), place, outer=True))
    return Launch(
        "ros2", tuple(whole.nodes), (), tuple(whole.arguments), tuple(whole.included), tuple(whole.unresolved),
        whole.failures.failed, whole.failures.raw_files, whole.shared.found, cut=whole.failures.is_cut,
    )  # fmt: skip


class _Whole:
    """Visits actions and collects what they come to."""

    def __init__(self, files: Files, environment: Mapping[str, str], *, any_arguments: bool = False) -> None:
        self.files = files
        self.failures = Failures()
        self.shared = SharedValues()
        self._any_arguments = any_arguments
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
        self, path: str, configurations: dict[str, Text], space: Space, evidence: Evidence, *, outer: bool = False
    ) -> None:
        """Visit the actions of a file."""
        if path in self._open:
            self.end(Fault.CYCLE, path, f"it includes itself: {' > '.join([*self._open, path])}", evidence)
            return
        if len(self._open) >= MOST_DEPTH or self._read >= MOST_FILES:
            self.miss(path, evidence, f"more than {MOST_FILES} files, or {MOST_DEPTH} levels of includes", opens=True)
            return
        content = self.files.content(path)
        if content is None:
            self.end(Fault.MISSING_FILE, path, "there is no such file in the workspace", evidence)
            return
        self._read += 1
        read = partial(actions_of, path, content, self.files)
        try:
            actions = within_budget(self.miss, self.failures, path, evidence, read, len(content)) or ()
        except DocumentError as error:
            place, reason = place_and_reason(error, path, evidence)
            self.end(Fault.UNREADABLE, path, reason, place)
            return
        self._open.append(path)
        self.failures.enter(evidence)
        scope = Scope(
            self.files,
            configurations,
            self._environment,
            path,
            self._assigned,
            rewritten=self._rewritten_files,
            report=self.failures.report,
        )
        if outer:
            self._declare(actions, msgspec.structs.replace(scope, configurations=dict(configurations), report=None))
        self._all(actions, scope, space)
        self.failures.leave()
        self._open.pop()

    def end(self, fault: Fault, text: str, reason: str, evidence: Evidence) -> None:
        """Note that the launch ends with a file that cannot be followed."""
        standing = self.failures.report(fault, text, reason, evidence)
        self.miss(text, evidence, reason, opens=True, standing=standing)

    def miss(
        self,
        text: str,
        evidence: Evidence,
        reason: str,
        *,
        opens: bool = False,
        standing: Standing = Standing.UNDECIDABLE,
    ) -> None:
        """Note what could not be evaluated, once for each place, and whether it may start further nodes."""
        self.failures.is_opaque = self.failures.is_opaque or opens
        found = Unresolved(text, evidence, reason, opens, standing=standing)
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
                scope.configurations.setdefault(name, self._held(name, default))
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

    def _held(self, name: str, default: Text | None) -> Text:
        """Return what an argument of the outermost file is, which is not given."""
        is_open = default is None or self._any_arguments
        return unknown(f"argument {name}, which is not given") if is_open or default is None else default

    def _all(self, actions: tuple[Action, ...], scope: Scope, space: Space) -> None:
        for action in actions:
            self._visited += 1
            if self._visited > MOST_ACTIONS:
                self.miss(action.kind, action.evidence, f"more than {MOST_ACTIONS:,} actions", opens=True)
                return
            self.failures.at, self.failures.is_open = action.evidence, bool(space.conditions)
            condition = self._condition(action, scope)
            if condition is not None:
                inner = msgspec.structs.replace(space, conditions=(*space.conditions, *condition))
                self.failures.is_open = bool(inner.conditions)
                self._visit(action, scope, space, inner)

    def _condition(self, action: Action, scope: Scope) -> Conditions | None:
        """Return conditions that stay open; None where the action is not visited."""
        condition = action.condition
        if condition is None:
            return ()
        value = resolve(condition.value, scope)
        try:
            holds = condition_holds(value)
        except ValueError as error:
            standing = self.failures.report(Fault.EXPRESSION, str(written_condition(condition)), str(error))
            self.miss(str(written_condition(condition)), action.evidence, str(error), standing=standing)
            holds = None
        if holds is None:
            return (written_condition(condition),)
        return () if holds is condition.wanted else None

    def _visit(self, action: Action, scope: Scope, space: Space, inner: Space) -> None:
        """Visit one action; ``space`` is what it may change for those after it, ``inner`` what holds for it."""
        if action.kind in _STARTED:
            self._start(action, scope, inner)
        elif action.kind == "load":
            self._load(action.children, resolve(action.values.get("target", ""), scope), scope, inner)
        elif action.kind == "include":
            self._include(action, scope, inner)
            keep(inner, space)
        elif action.kind == "group":
            self._group(action, scope, space, inner)
        elif action.kind == "sequence":
            self._sequence(action.children, action.note, scope, inner)
            keep(inner, space)
        elif action.kind == "call" and action.make is not None:
            self._sequence(action.make(scope), action.note, scope, inner)
            keep(inner, space)
        elif action.kind == "loop":
            self._loop(action, scope, inner)
            keep(inner, space)
        elif action.kind == "unknown":
            self.miss(str(resolve(action.values.get("text", ""), scope)), action.evidence, action.note, opens=True)
        else:
            self._change(action, scope, space)

    def _change(self, action: Action, scope: Scope, space: Space) -> None:
        """Change what holds for the actions after this one."""
        values = action.values
        if action.kind == "argument":
            self._argument(action, scope)
        elif action.kind == "set":
            written = resolve(values["name"], scope)
            self.failures.is_opaque = self.failures.is_opaque or written.known is None
            scope.configurations[str(written)] = resolve(values["value"], scope)
        elif action.kind == "unset":
            scope.configurations.pop(str(resolve(values["name"], scope)), None)
        elif action.kind == "environment":
            scope.assigned.add(resolve(values["name"], scope).known or "*")
        elif action.kind == "namespace":
            space.namespace = within(space.namespace, resolve(values["namespace"], scope))
        elif action.kind == "parameter":
            space.settings = (*space.settings, *self._settings(action.parameters, scope))
        elif action.kind == "remap":
            space.remaps = (*space.remaps, *remaps_of(action, scope))

    def _argument(self, action: Action, scope: Scope) -> None:
        name = str(resolve(action.values["name"], scope))
        written = action.values.get("default")
        if (value := scope.configurations.get(name)) is not None:
            default = None if written is None else resolve(written, msgspec.structs.replace(scope, report=None))
            self.shared.meet(name, value, default, action.evidence, self.failures.include, tuple(self._open))
            return
        default = None if written is None else resolve(written, scope)
        if default is None:
            self.miss(name, action.evidence, "the argument is required, but not given")
        is_outer = len(self._open) == 1
        held = self._held(name, default) if is_outer or default is None else default
        scope.configurations[name] = held
        if not is_outer:
            self.shared.leave(name, held, action.evidence, tuple(self._open))

    def _group(self, action: Action, scope: Scope, space: Space, inner: Space) -> None:
        if action.scoped:
            scope = msgspec.structs.replace(scope, configurations=dict(scope.configurations))
            for one in action.parameters:
                name = resolve(one.name, scope).known
                if name is not None:
                    scope.configurations[name] = resolve(one.value, scope)
            self._all(action.children, scope, msgspec.structs.replace(inner))
            return
        self._all(action.children, scope, inner)
        keep(inner, space)

    def _sequence(self, children: tuple[Action, ...], note: str, scope: Scope, inner: Space) -> None:
        if note:
            inner.conditions = (*inner.conditions, Written(note))
        self._all(children, scope, inner)

    def _loop(self, action: Action, scope: Scope, inner: Space) -> None:
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

    def _include(self, action: Action, scope: Scope, inner: Space) -> None:
        file = resolve(action.values["file"], scope)
        if file.known is None or file.known.startswith("/"):
            reason = file.holes[0].reason if file.holes else "an absolute path"
            self.miss(str(file), action.evidence, str(reason), opens=True, standing=standing_of(file))
            return
        path = place_of(file.known)
        # An included file sees what is set around it, and what it sets stays set after it.
        for child in action.children:
            name, value = str(resolve(child.values["name"], scope)), resolve(child.values["value"], scope)
            self.shared.give(scope.configurations, name, value, child.evidence, (*self._open, path))
        if path not in self.included:
            self.included.append(path)
        self.file(path, scope.configurations, inner, action.evidence)

    def _start(self, action: Action, scope: Scope, inner: Space) -> None:
        values = action.values
        launched = Launched(
            package=resolve(values.get("package", ""), scope),
            executable=resolve(values.get("executable", ""), scope),
            evidence=action.evidence,
            name=resolve(values.get("name", ""), scope),
            namespace=within(inner.namespace, resolve(values.get("namespace", ""), scope)),
            settings=(*inner.settings, *self._settings(action.parameters, scope, is_raw=True)),
            remaps=(*inner.remaps, *remaps_of(action, scope)),
            arguments=tuple(resolve(one, scope) for one in action.words),
            conditions=inner.conditions,
            kind=action.kind,
        )
        self.nodes.append(with_bridges(launched, self.files))
        if action.kind == "container":
            self._load(action.children, full_name(launched), scope, inner)

    def _load(self, components: tuple[Action, ...], container: Text, scope: Scope, inner: Space) -> None:
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
                    remaps=(*inner.remaps, *remaps_of(one, scope)),
                    conditions=(*inner.conditions, *conditions),
                    kind="component",
                )
            )

    def _settings(self, parameters: tuple[Parameter, ...], scope: Scope, *, is_raw: bool = False) -> list[Setting]:
        found: list[Setting] = []
        for one in parameters:
            self.failures.at = one.evidence
            if one.file is None:
                value = resolve(one.value, scope)
                kind = one.type or (type_in_launch(value.known) if value.known is not None else "")
                found.append(Setting(resolve(one.name, scope), value, one.evidence, kind))
            else:
                found += self._of_file(one, one.file, scope, is_raw=is_raw)
        return found

    def _of_file(self, one: Parameter, written: Value, scope: Scope, *, is_raw: bool) -> list[Setting]:
        file, changes = self._parameter_files.of_copy(resolve(written, scope), one.changes, scope)
        if file.known is None or file.known.startswith("/"):
            reason = file.holes[0].reason if file.holes else "an absolute path"
            self.miss(str(file), one.evidence, str(reason), standing=standing_of(file))
            return []
        path = place_of(file.known)
        if is_raw and not changes:
            self.failures.given(path, one.evidence)
        try:
            settings = self._parameter_files.settings(path, changes, scope)
        except DocumentError as error:
            reason = f"{error.where}: expected {error.expected}"
            standing = self.failures.report(Fault.PARAMETERS, error.what, reason, one.evidence)
            self.miss(error.what, one.evidence, reason, standing=standing)
            return []
        if settings is None:
            reason = "there is no such file in the workspace"
            standing = self.failures.report(Fault.MISSING_FILE, path, reason, one.evidence)
            self.miss(path, one.evidence, reason, standing=standing)
        return settings or []
