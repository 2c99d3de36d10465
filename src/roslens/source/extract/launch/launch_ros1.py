"""ROS 1 launch files: what roslaunch would start and set, without starting anything.

Follows wiki.ros.org/roslaunch/XML. What roslaunch refuses and what cannot be known here is unresolved, with the reason;
everything else of the file is still read.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from functools import partial

import msgspec

from roslens.model.configuration import Standing
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Argument, Fault, Launch, Launched, Remap, Setting, Unresolved
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.facts.resolve_name import absolute, tidy
from roslens.source.extract.launch.gazebo_plugins import with_plugins
from roslens.source.extract.launch.launch_budget import within_budget
from roslens.source.extract.launch.launch_failures import Failures
from roslens.source.extract.launch.launch_reasons import standing_of, why_unread
from roslens.source.extract.launch.ros1_doubt import Doubt, only_if, setting_if
from roslens.source.extract.launch.ros1_names import private, remap_also, without_end
from roslens.source.extract.launch.ros1_nodelet import as_nodelet
from roslens.source.extract.launch.ros1_settings import Reading, boolean, of_param, of_rosparam
from roslens.source.extract.launch.ros1_space import Given, Space
from roslens.source.extract.launch.ros1_substitution import (
    Scope,
    SubstitutionError,
    fault_of,
    needed,
    substitute,
    truth,
)
from roslens.source.extract.launch.ros1_words import words_of
from roslens.source.extract.launch.ros_controllers import with_controllers
from roslens.source.extract.symbolic.reason import RandomEnd
from roslens.source.extract.symbolic.text import Not, Text, Written, unknown
from roslens.source.workspace.elements import UNREAD, Document, Element, read_elements

MOST_FILES = 200
MOST_DEPTH = 30
"""Files that include each other deeper than this include themselves."""
_LEGAL = re.compile(r"[~/A-Za-z][\w/]*")
_IGNORED = frozenset({"env", "machine", "master"})
_STARTING = frozenset({"include", "group", "node"})


def evaluate_ros1(
    path: str, files: Files, arguments: Mapping[str, str] | None = None, environment: Mapping[str, str] | None = None
) -> Launch:
    """Return what a launch file comes to.

    Args:
        path: of the file in the workspace.
        files: that may be read.
        arguments: given on the command line, by name.
        environment: variables that are known.
    """
    whole = _Whole(files, environment or {})
    given = {name: Text.of(value) for name, value in (arguments or {}).items()}
    follow = partial(whole.file, path, Given(given, outer=True), Space(Text.of("/")), Evidence(path, 0), [])
    within_budget(whole.miss, whole.failures, path, Evidence(path, 0), follow)
    launch = Launch(
        "ros1", tuple(whole.overridden()), tuple(whole.settings), tuple(whole.arguments), tuple(whole.included),
        tuple(whole.unresolved), whole.failures.failed, cut=whole.failures.is_cut,
    )  # fmt: skip
    return with_controllers(with_plugins(launch, files, environment or {}), files)


class _Whole:
    """Collects what all files together come to."""

    def __init__(self, files: Files, environment: Mapping[str, str]) -> None:
        self.files = files
        self.environment = environment
        self.failures = Failures()
        self.nodes: list[Launched] = []
        self.set_before: list[int] = []
        self.settings: list[Setting] = []
        self.arguments: list[Argument] = []
        self.included: list[str] = []
        self.unresolved: list[Unresolved] = []
        self._open: dict[str, Mapping[str, Text]] = {}
        self._read = 0

    def file(
        self, path: str, given: Given, space: Space, evidence: Evidence, remaps: list[Remap]
    ) -> tuple[Setting, ...]:
        """Evaluate a file with the arguments that it is given; return the parameters that later nodes get."""
        if path in self._open:
            reason = f"it includes itself: {' > '.join([*self._open, path])}"
            cycle = Fault.CYCLE if self._open[path] == given.arguments else None  # else a condition may end it
            self.miss(path, evidence, reason, opens=True, fault=cycle)
            return space.private
        if len(self._open) >= MOST_DEPTH or self._read >= MOST_FILES:
            self.miss(path, evidence, f"more than {MOST_FILES} files, or {MOST_DEPTH} levels of includes", opens=True)
            return space.private
        content = self.files.content(path)
        if content is None:
            self.miss(path, evidence, "there is no such file in the workspace", opens=True, fault=Fault.MISSING_FILE)
            return space.private
        self._read += 1
        read = partial(read_elements, content)
        document = within_budget(self.miss, self.failures, path, evidence, read, len(content)) or UNREAD
        for fault in document.faults:
            place = Evidence(path, *document.place(fault.offset))
            self.miss(fault.what, place, f"expected {fault.expected or 'readable XML'}", opens=True)
        root = document.root
        if root is None:
            return space.private
        if root.tag != "launch":
            place = Evidence(path, *document.place(root.start))
            self.miss(f"<{root.tag}>", place, "expected <launch> as the outermost element", opens=True)
            return space.private
        self._open[path] = given.arguments
        file = _File(self, path, document, given)
        private = file.children(root, space, remaps)
        if not (given.outer or given.every):
            for name in sorted(given.arguments.keys() - file.declared):
                self.miss(name, evidence, f"the include gives an argument that {path} does not declare")
        del self._open[path]
        return private

    def overridden(self) -> Iterator[Launched]:
        """Yield the nodes with the parameters of theirs that are set outside after them, which hold over their own."""
        for node, before in zip(self.nodes, self.set_before, strict=True):
            own = absolute(node.namespace, node.name).pattern + "/"
            later = [one for one in self.settings[before:] if one.name.pattern.startswith(own)]
            yield msgspec.structs.replace(node, settings=(*node.settings, *later)) if later else node

    def miss(
        self,
        text: str,
        evidence: Evidence,
        reason: str,
        *,
        opens: bool = False,
        fault: Fault | None = None,
        standing: Standing = Standing.UNDECIDABLE,
    ) -> None:
        """Note what could not be evaluated, whether it may start further nodes, and why it is certain to fail."""
        standing = standing if fault is None else self.failures.report(fault, text, reason, evidence)
        self.unresolved.append(Unresolved(text, evidence, reason, opens, standing=standing))


class _File:
    """One launch file on its way."""

    def __init__(self, whole: _Whole, path: str, document: Document, given: Given) -> None:
        self._whole = whole
        self._path = path
        self._document = document
        self._given = given.arguments
        self._outer = given.outer
        self._all_given = given.every
        self.declared: set[str] = set()
        # Arguments of the command line, and all those of who includes it, are seen without a declaration.
        self._known: dict[str, Text] = dict(given.arguments)
        self._in_scope(self._known)

    def _in_scope(self, known: dict[str, Text]) -> None:
        """Let these be the arguments that are known from here on."""
        self._known = known
        self._scope = Scope(self._whole.files, self._path.rpartition("/")[0], known, self._whole.environment)
        self._reading = Reading(self._scope, self._path, self._place, self._miss)

    def children(self, element: Element, space: Space, remaps: list[Remap]) -> tuple[Setting, ...]:
        """Evaluate what is in an element; ``remaps`` grows, as they hold from where they stand on."""
        for child in element.elements():
            inner = self._if(child, space)
            if inner is None:
                continue
            self._whole.failures.is_open = bool(inner.conditions)
            method = _TAGS.get(child.tag)
            if method is None:
                if child.tag not in _IGNORED:
                    self._miss(child, f"<{child.tag}>", "not an element of roslaunch")
                continue
            try:
                space = msgspec.structs.replace(space, private=method(self, child, inner, remaps))
            except SubstitutionError as error:
                is_starting = child.tag in _STARTING
                self._miss(child, child.written()[:80], str(error), opens=is_starting, fault=fault_of(error))
        return space.private

    def arg(self, element: Element, space: Space, _remaps: list[Remap]) -> tuple[Setting, ...]:
        """Declare an argument."""
        name = substitute(needed(element, "name"), self._scope).pattern
        default = element.attributes.get("default")
        value = element.attributes.get("value")
        if default is not None and value is not None:
            self._miss(element, name, "the argument has a value and a default; expected one of them")
        if name in self.declared and not self._all_given:
            self._miss(element, name, "the argument is declared before")
        self.declared.add(name)
        if self._outer and value is None:
            text = None if default is None else substitute(default, self._scope)
            self._whole.arguments.append(Argument(name, self._place(element), text, element.attributes.get("doc", "")))
        found = self._value(element, name, value, default)
        self._known[name] = only_if(space.own, found, self._known.get(name))
        return space.private

    def _value(self, element: Element, name: str, value: str | None, default: str | None) -> Text:
        """Return the value of an argument: the fixed one, else the one that is given, else the default."""
        given, before = self._given.get(name), self._known.get(name)
        if value is not None:
            found = substitute(value, self._scope)
            if given is not None and not self._all_given:
                self._miss(element, name, f"the argument has a fixed value here, but is given {given}")
            return found
        if given is not None:
            return given
        if default is not None:
            return before if before is not None and self._all_given else substitute(default, self._scope)
        if before is None:
            self._miss(element, name, "the argument is required, but not given")
        return before or unknown(f"argument {name}, which is not given")

    def group(self, element: Element, space: Space, remaps: list[Remap]) -> tuple[Setting, ...]:
        """Evaluate a group: what it sets holds inside it, and what it declares too."""
        inner = msgspec.structs.replace(space, namespace=self._namespace(element, space))
        known, declared = self._known, self.declared
        self.declared = set(declared)
        self._in_scope(dict(known))
        self.children(element, inner, list(remaps))
        self.declared = declared
        self._in_scope(known)
        return space.private

    def include(self, element: Element, space: Space, remaps: list[Remap]) -> tuple[Setting, ...]:
        """Evaluate another file with the arguments it is given."""
        whole = substitute(element.attributes.get("pass_all_args", "false"), self._scope)
        every = whole.known is not None and boolean(whole.known, "pass_all_args")
        given = dict(self._known) if every else {}
        for child in element.elements():
            inside = self._if(child, space) if child.tag == "arg" else None
            if inside is None:
                continue
            name = substitute(needed(child, "name"), self._scope).pattern
            written = child.attributes.get("value", child.attributes.get("default"))
            if written is None:
                self._miss(child, name, "an argument of an include has no value")
            elif "value" in child.attributes or name not in given:
                found = substitute(written, self._scope)
                given[name] = only_if(inside.own, found, given.get(name))
        file = substitute(needed(element, "file"), self._scope)
        if file.known is None or file.known.startswith("/"):
            self._whole.miss(str(file), self._place(element), why_unread(file), opens=True, standing=standing_of(file))
            return space.private
        path = joined("", file.known)
        self._whole.included += [path] if path not in self._whole.included else []
        inner = msgspec.structs.replace(space, namespace=self._namespace(element, space))
        after = self._whole.file(path, Given(given, every=every), inner, self._place(element), list(remaps))
        # roslaunch keeps them in one list, which both files have where there was anything in it before.
        return after if space.private else space.private

    def remap(self, element: Element, space: Space, remaps: list[Remap]) -> tuple[Setting, ...]:
        """Remap for all nodes that follow in this scope."""
        remap_also(remaps, self._remap(element, space))
        return space.private

    def param(self, element: Element, space: Space, _remaps: list[Remap]) -> tuple[Setting, ...]:
        """Set a parameter outside of nodes."""
        return self._set(of_param(element, self._reading), space)

    def rosparam(self, element: Element, space: Space, _remaps: list[Remap]) -> tuple[Setting, ...]:
        """Set parameters of a file outside of nodes."""
        return self._set(of_rosparam(element, self._reading), space)

    def node(self, element: Element, space: Space, remaps: list[Remap]) -> tuple[Setting, ...]:
        """Start a node."""
        given = element.attributes.get
        written = given("name") or (needed(element, "test-name") if element.tag == "test" else needed(element, "name"))
        name = substitute(written, self._scope)
        if "/" in name.pattern:
            self._miss(element, str(name), "the name of a node has a `/`; expected a namespace as ns=…")
        inner_remaps, own = self._inside(element, space, remaps)
        launched = Launched(
            package=substitute(needed(element, "pkg"), self._scope),
            executable=substitute(needed(element, "type"), self._scope),
            evidence=self._place(element),
            name=name,
            namespace=self._namespace(element, space),
            settings=tuple(private(one) for one in own),
            remaps=tuple(inner_remaps),
            arguments=words_of(substitute(given("args", ""), self._scope)),
            conditions=space.conditions,
            kind="test" if element.tag == "test" else "node",
            machine=given("machine", ""),
            anonymous=any(isinstance(hole.reason, RandomEnd) for hole in name.holes),
        )
        self._whole.nodes.append(as_nodelet(launched))
        self._whole.set_before.append(len(self._whole.settings))
        return space.private

    def _inside(self, element: Element, space: Space, remaps: list[Remap]) -> tuple[list[Remap], list[Setting]]:
        """Return remappings and parameters of a node: files first, then what is set outside of it, then ``<param>``."""
        inner_remaps, files, own = list(remaps), list[Setting](), list[Setting]()
        for child in element.elements():
            inside = self._if(child, space)
            if inside is None:
                continue
            if child.tag == "remap":
                remap_also(inner_remaps, self._remap(child, inside))
            elif child.tag == "param":
                own += [setting_if(inside.own, one) for one in of_param(child, self._reading)]
            elif child.tag == "rosparam":
                found = [setting_if(inside.own, one) for one in of_rosparam(child, self._reading)]
                everywhere = [one for one in found if one.name.pattern.startswith("/")]
                self._whole.settings += everywhere
                files += [one for one in found if one not in everywhere]
            elif child.tag != "env":
                self._miss(child, f"<{child.tag}>", "not an element of a node")
        return inner_remaps, [*files, *space.private, *own]

    def _decided(self, element: Element, attribute: str, written: str) -> tuple[bool | None, bool | None]:
        """Return whether a condition holds, None where that is open, and whether it usually does then."""
        try:
            text = substitute(written, self._scope)
            holds = truth(text)
            return holds, truth(Text.of(text.usual)) if holds is None and text.usual is not None else None
        except SubstitutionError as error:
            fault = None if fault_of(error) is None else Fault.EXPRESSION
            self._miss(element, f'{attribute}="{written}"', str(error), fault=fault)
            return None, None

    def _if(self, element: Element, space: Space) -> Space | None:
        """Return the space inside an element; None where a condition says that it is not there."""
        space = msgspec.structs.replace(space, own=()) if space.own else space
        if "if" in element.attributes and "unless" in element.attributes:
            self._miss(element, element.written()[:80], "both `if` and `unless` are given; expected one of them")
        for attribute, wanted in (("if", True), ("unless", False)):
            written = element.attributes.get(attribute)
            if written is None:
                continue
            holds, usual = self._decided(element, attribute, written)
            if holds is None:
                condition = Written(written) if wanted else Not(Written(written))
                own = (*space.own, Doubt(condition, None if usual is None else usual is wanted))
                space = msgspec.structs.replace(
                    space, own=own, around=(*space.around, own[-1]), conditions=(*space.conditions, own[-1].condition)
                )
            elif holds is not wanted:
                return None
        return space

    def _namespace(self, element: Element, space: Space) -> Text:
        given = substitute(element.attributes.get("ns", ""), self._scope)
        if not given.parts:
            if "ns" in element.attributes:
                self._miss(element, element.written()[:80], "its namespace is empty; expected a name, or no ns=…")
            return space.namespace
        absolute = given.is_global
        top = space.namespace.parts == ("/",)
        before: Text | str = "" if absolute else "/" if top else Text.of(space.namespace, "/")
        return without_end(Text.of(before, given))

    def _remap(self, element: Element, space: Space) -> Remap:
        source = substitute(needed(element, "from"), self._scope)
        target = only_if(space.own, substitute(needed(element, "to"), self._scope), None)
        for one in (source, target):
            if one.known is not None and not _LEGAL.fullmatch(one.known):
                raise SubstitutionError(f"{one.known!r} is not a valid ROS name; expected letters, digits, `_` and `/`")
        return Remap(tidy(source), tidy(target), self._place(element))

    def _set(self, found: list[Setting], space: Space) -> tuple[Setting, ...]:
        private = list(space.private)
        for one in found:
            if one.name.head.startswith("~"):
                private.append(setting_if(space.own, one))
                continue
            sure = setting_if(space.around, one)
            if not one.name.is_global:
                before = "/" if space.namespace.parts == ("/",) else Text.of(space.namespace, "/")
                sure = msgspec.structs.replace(sure, name=Text.of(before, one.name))
            self._whole.settings.append(sure)
        return tuple(private)

    def _place(self, element: Element) -> Evidence:
        return Evidence(self._path, *self._document.place(element.start))

    def _miss(
        self, element: Element, text: str, reason: str, *, opens: bool = False, fault: Fault | None = None
    ) -> None:
        self._whole.miss(text, self._place(element), reason, opens=opens, fault=fault)


_TAGS: dict[str, Callable[[_File, Element, Space, list[Remap]], tuple[Setting, ...]]] = {
    "arg": _File.arg,
    "group": _File.group,
    "include": _File.include,
    "remap": _File.remap,
    "param": _File.param,
    "rosparam": _File.rosparam,
    "node": _File.node,
    "test": _File.node,
}
