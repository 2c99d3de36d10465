"""ROS 1 launch files: what roslaunch would start and set, without starting anything.

Follows wiki.ros.org/roslaunch/XML. What roslaunch refuses and what cannot be known here is unresolved, with the reason;
everything else of the file is still read.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping

import msgspec

from roslens.model.errors import DocumentError
from roslens.source.extract.files import Files, joined
from roslens.source.extract.gazebo_plugins import with_plugins
from roslens.source.extract.launched import Argument, Launch, Launched, Remap, Setting, Unresolved
from roslens.source.extract.node_facts import Evidence
from roslens.source.extract.parameter_file import ros1_parameters, type_of_text
from roslens.source.extract.resolve_name import absolute
from roslens.source.extract.ros1_nodelet import as_nodelet
from roslens.source.extract.ros1_substitution import Scope, SubstitutionError, UnknownInsideError, substitute, truth
from roslens.source.extract.ros_controllers import with_controllers
from roslens.source.extract.text import Text, unknown
from roslens.source.workspace.elements import Document, Element, read_elements

MOST_FILES = 200
MOST_DEPTH = 30
"""Files that include each other deeper than this include themselves."""
_TYPES = {"int": "int", "double": "double", "str": "string", "string": "string", "bool": "bool", "boolean": "bool",
          "yaml": "map"}  # fmt: skip
_IGNORED = frozenset({"env", "machine", "master"})
_STARTING = frozenset({"include", "group", "node"})


class _Space(msgspec.Struct, frozen=True):
    """What holds at a place of a file: the namespace, remappings and conditions around it."""

    namespace: Text
    conditions: tuple[str, ...] = ()
    private: tuple[Setting, ...] = ()
    """Parameters with ``~`` outside of nodes, which later nodes get."""


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
    whole.file(path, given, _Space(Text.of("/")), Evidence(path, 0), outer=True)
    launch = Launch(
        "ros1", tuple(whole.overridden()), tuple(whole.settings), tuple(whole.arguments), tuple(whole.included),
        tuple(whole.unresolved),
    )  # fmt: skip
    return with_controllers(with_plugins(launch, files, environment or {}), files)


class _Whole:
    """Collects what all files together come to."""

    def __init__(self, files: Files, environment: Mapping[str, str]) -> None:
        self.files = files
        self.environment = environment
        self.nodes: list[Launched] = []
        self.set_before: list[int] = []
        self.settings: list[Setting] = []
        self.arguments: list[Argument] = []
        self.included: list[str] = []
        self.unresolved: list[Unresolved] = []
        self._open: list[str] = []
        self._read = 0

    def file(self, path: str, given: dict[str, Text], space: _Space, evidence: Evidence, *, outer: bool) -> None:
        """Evaluate a file with the arguments that it is given."""
        if path in self._open:
            self.miss(path, evidence, f"it includes itself: {' > '.join([*self._open, path])}", opens=True)
            return
        if len(self._open) >= MOST_DEPTH or self._read >= MOST_FILES:
            self.miss(path, evidence, f"more than {MOST_FILES} files, or {MOST_DEPTH} inside each other", opens=True)
            return
        content = self.files.content(path)
        if content is None:
            self.miss(path, evidence, "there is no such file in the workspace", opens=True)
            return
        self._read += 1
        document = read_elements(content)
        for fault in document.faults:
            line, column = document.place(fault.offset)
            self.miss(
                fault.what, Evidence(path, line, column), f"expected {fault.expected or 'readable XML'}", opens=True
            )
        if document.root is None:
            return
        if document.root.tag != "launch":
            line, column = document.place(document.root.start)
            self.miss(
                f"<{document.root.tag}>",
                Evidence(path, line, column),
                "expected <launch> as the outermost element",
                opens=True,
            )
            return
        self._open.append(path)
        _File(self, path, document, given, outer=outer).children(document.root, space, [])
        self._open.pop()

    def overridden(self) -> Iterator[Launched]:
        """Yield the nodes with the parameters of theirs that are set outside after them, which hold over their own."""
        for node, before in zip(self.nodes, self.set_before, strict=True):
            own = absolute(node.namespace, node.name).pattern + "/"
            later = [one for one in self.settings[before:] if one.name.pattern.startswith(own)]
            yield msgspec.structs.replace(node, settings=(*node.settings, *later)) if later else node

    def miss(self, text: str, evidence: Evidence, reason: str, *, opens: bool = False) -> None:
        """Note what could not be evaluated, and whether it may start further nodes."""
        self.unresolved.append(Unresolved(text, evidence, reason, opens))


class _File:
    """One launch file on its way."""

    def __init__(self, whole: _Whole, path: str, document: Document, given: dict[str, Text], *, outer: bool) -> None:
        self._whole = whole
        self._path = path
        self._document = document
        self._given = given
        self._outer = outer
        # Arguments of the command line are seen without a declaration, as roslaunch has it.
        self._known: dict[str, Text] = dict(given) if outer else {}
        folder = path.rpartition("/")[0]
        self._scope = Scope(whole.files, folder, self._known, whole.environment)

    def children(self, element: Element, space: _Space, remaps: list[Remap]) -> None:
        """Evaluate what is in an element; ``remaps`` grows, as they hold from where they stand on."""
        for child in element.elements():
            inner = self._if(child, space)
            if inner is None:
                continue
            method = _TAGS.get(child.tag)
            if method is None:
                if child.tag not in _IGNORED:
                    self._miss(child, f"<{child.tag}>", "no element of roslaunch")
                continue
            try:
                space = msgspec.structs.replace(space, private=method(self, child, inner, remaps))
            except UnknownInsideError as error:
                self._miss(child, child.written()[:80], str(error), opens=child.tag in _STARTING)
            except SubstitutionError as error:
                self._miss(child, child.written()[:80], str(error), opens=child.tag in _STARTING)

    def arg(self, element: Element, space: _Space, _remaps: list[Remap]) -> tuple[Setting, ...]:
        """Declare an argument."""
        name = self._needed(element, "name")
        default = element.attributes.get("default")
        value = element.attributes.get("value")
        place = self._place(element)
        if self._outer and value is None:
            text = None if default is None else substitute(default, self._scope)
            self._whole.arguments.append(Argument(name, place, text, element.attributes.get("doc", "")))
        if value is not None:
            self._known[name] = substitute(value, self._scope)
            if name in self._given and self._given[name] != self._known[name]:
                self._miss(element, name, f"the argument has a fixed value here, but is given {self._given[name]}")
        elif name in self._given:
            self._known[name] = self._given[name]
        elif default is not None:
            self._known[name] = substitute(default, self._scope)
        else:
            self._known[name] = unknown(f"argument {name}, which is not given")
            self._miss(element, name, "the argument is required, but not given")
        return space.private

    def group(self, element: Element, space: _Space, remaps: list[Remap]) -> tuple[Setting, ...]:
        """Evaluate a group: what it sets holds inside it."""
        inner = msgspec.structs.replace(space, namespace=self._namespace(element, space))
        self.children(element, inner, list(remaps))
        return space.private

    def include(self, element: Element, space: _Space, _remaps: list[Remap]) -> tuple[Setting, ...]:
        """Evaluate another file with the arguments it is given."""
        given = dict(self._known) if element.attributes.get("pass_all_args", "") in ("true", "1") else {}
        for child in element.elements():
            if child.tag == "arg" and self._if(child, space) is not None:
                value = child.attributes.get("value", child.attributes.get("default", ""))
                given[self._needed(child, "name")] = substitute(value, self._scope)
        file = substitute(self._needed(element, "file"), self._scope)
        if file.known is None:
            self._miss(element, str(file), file.holes[0].reason, opens=True)
            return space.private
        path = joined("", file.known)
        self._whole.included += [path] if path not in self._whole.included else []
        inner = msgspec.structs.replace(space, namespace=self._namespace(element, space), private=())
        self._whole.file(path, given, inner, self._place(element), outer=False)
        return space.private

    def remap(self, element: Element, space: _Space, remaps: list[Remap]) -> tuple[Setting, ...]:
        """Remap for all nodes that follow in this scope."""
        remaps.append(self._remap(element))
        return space.private

    def param(self, element: Element, space: _Space, _remaps: list[Remap]) -> tuple[Setting, ...]:
        """Set a parameter outside of nodes."""
        found = self._param(element)
        return self._set([found] if found else [], space)

    def rosparam(self, element: Element, space: _Space, _remaps: list[Remap]) -> tuple[Setting, ...]:
        """Set parameters of a file outside of nodes."""
        return self._set(self._rosparam(element), space)

    def node(self, element: Element, space: _Space, remaps: list[Remap]) -> tuple[Setting, ...]:
        """Start a node."""
        inner_remaps = list(remaps)
        settings = list(space.private)
        for child in element.elements():
            if self._if(child, space) is None:
                continue
            if child.tag == "remap":
                inner_remaps.append(self._remap(child))
            elif child.tag == "param":
                found = self._param(child)
                settings += [found] if found else []
            elif child.tag == "rosparam":
                settings += self._rosparam(child)
        given = element.attributes.get
        name = substitute(
            given("test-name" if element.tag == "test" and not given("name") else "name", ""), self._scope
        )
        words = self._words(given("args", ""))
        launched = Launched(
            package=substitute(self._needed(element, "pkg"), self._scope),
            executable=substitute(self._needed(element, "type"), self._scope),
            evidence=self._place(element),
            name=name,
            namespace=self._namespace(element, space),
            settings=tuple(_private(one) for one in settings),
            remaps=tuple(inner_remaps),
            arguments=words,
            conditions=space.conditions,
            kind="test" if element.tag == "test" else "node",
            machine=given("machine", ""),
            anonymous=any(hole.reason == "random end" for hole in name.holes),
        )
        self._whole.nodes.append(as_nodelet(launched))
        self._whole.set_before.append(len(self._whole.settings))
        return space.private

    def _words(self, text: str) -> tuple[Text, ...]:
        """Return arguments of a command line; substitutions may hold spaces."""
        words, depth, word = [], 0, ""
        for sign in text:
            depth += (sign == "(") - (sign == ")")
            if sign.isspace() and depth <= 0:
                words += [word] if word else []
                word = ""
            else:
                word += sign
        return tuple(substitute(one, self._scope) for one in [*words, word] if one)

    def _if(self, element: Element, space: _Space) -> _Space | None:
        """Return the space inside an element; None where a condition says that it is not there."""
        for attribute, wanted in (("if", True), ("unless", False)):
            written = element.attributes.get(attribute)
            if written is None:
                continue
            try:
                holds = truth(substitute(written, self._scope))
            except SubstitutionError as error:
                self._miss(element, f'{attribute}="{written}"', str(error))
                holds = None
            if holds is None:
                condition = written if wanted else f"not {written}"
                space = msgspec.structs.replace(space, conditions=(*space.conditions, condition))
            elif holds is not wanted:
                return None
        return space

    def _namespace(self, element: Element, space: _Space) -> Text:
        given = substitute(element.attributes.get("ns", ""), self._scope)
        if not given.parts:
            return space.namespace
        first = given.parts[0]
        absolute = isinstance(first, str) and first.startswith("/")
        top = space.namespace.parts == ("/",)
        before: Text | str = "" if absolute else "/" if top else Text.of(space.namespace, "/")
        return _without_end(Text.of(before, given))

    def _remap(self, element: Element) -> Remap:
        source = substitute(self._needed(element, "from"), self._scope)
        return Remap(source, substitute(self._needed(element, "to"), self._scope), self._place(element))

    def _param(self, element: Element) -> Setting | None:
        name = substitute(self._needed(element, "name"), self._scope)
        given = element.attributes
        if "value" in given:
            value = substitute(given["value"], self._scope)
            kind = _TYPES.get(given.get("type", "auto"), "")
            if not kind and value.known is not None:
                kind = type_of_text(value.known) if value.known.lower() not in _WORDS else "string"
            return Setting(name, value, self._place(element), kind)
        for source in ("textfile", "binfile", "command"):
            if source in given:
                text = substitute(given[source], self._scope)
                hole = f"output of {text}" if source == "command" else f"content of {text}"
                words = _split(text) if source == "command" else (Text.of("cat"), text)
                return Setting(name, unknown(hole), self._place(element), "string", words=words)
        self._miss(element, f"<param name={name}>", "it has no value; expected value, textfile, binfile or command")
        return None

    def _rosparam(self, element: Element) -> list[Setting]:
        given = element.attributes
        command = given.get("command", "load")
        if command != "load":
            self._miss(element, f'<rosparam command="{command}">', "only what is loaded is followed")
            return []
        prefix = "/".join(one for one in (self._plain(given.get("ns")), self._plain(given.get("param"))) if one)
        place = self._place(element)
        if "file" in given:
            file = substitute(given["file"], self._scope)
            if file.known is None:
                self._miss(element, str(file), file.holes[0].reason)
                return []
            path, content, line = joined("", file.known), self._whole.files.content(joined("", file.known)), 0
            if content is None:
                self._miss(element, file.known, "there is no such file in the workspace")
                return []
        else:
            path, content, line = self._path, element.full_text().encode(), place.line - 1
        if given.get("subst_value") in ("true", "1", "True"):
            content = self._plain(content.decode("utf-8", "replace")).encode()
        try:
            found = ros1_parameters(content, path, line)
        except DocumentError as error:
            self._miss(element, error.what, f"{error.where}: expected {error.expected}")
            return []
        return [msgspec.structs.replace(one, name=_below(prefix, one.name)) for one in found]

    def _plain(self, written: str | None) -> str:
        """Return a text that has to be known.

        Raises:
            UnknownInsideError: it is not.
        """
        text = substitute(written or "", self._scope)
        if text.known is None:
            raise UnknownInsideError(text.holes[0])
        return text.known

    def _set(self, found: list[Setting], space: _Space) -> tuple[Setting, ...]:
        private = list(space.private)
        for one in found:
            first = one.name.parts[0] if one.name.parts else ""
            if isinstance(first, str) and first.startswith("~"):
                private.append(one)
            elif isinstance(first, str) and first.startswith("/"):
                self._whole.settings.append(one)
            else:
                before = "/" if space.namespace.parts == ("/",) else Text.of(space.namespace, "/")
                self._whole.settings.append(msgspec.structs.replace(one, name=Text.of(before, one.name)))
        return tuple(private)

    def _needed(self, element: Element, attribute: str) -> str:
        if attribute not in element.attributes:
            raise SubstitutionError(f"<{element.tag}> has no {attribute!r}; expected <{element.tag} {attribute}=…>")
        return element.attributes[attribute]

    def _place(self, element: Element) -> Evidence:
        return Evidence(self._path, *self._document.place(element.start))

    def _miss(self, element: Element, text: str, reason: str, *, opens: bool = False) -> None:
        self._whole.miss(text, self._place(element), reason, opens=opens)


_WORDS = frozenset({"yes", "no", "on", "off"})
"""What YAML, but not roslaunch, takes for true and false."""
_TAGS: dict[str, Callable[[_File, Element, _Space, list[Remap]], tuple[Setting, ...]]] = {
    "arg": _File.arg,
    "group": _File.group,
    "include": _File.include,
    "remap": _File.remap,
    "param": _File.param,
    "rosparam": _File.rosparam,
    "node": _File.node,
    "test": _File.node,
}


def _split(text: Text) -> tuple[Text, ...]:
    """Return the words of a command line; what is unknown is part of a word."""
    words = [Text()]
    for part in text.parts:
        for number, piece in enumerate(re.split(r"\s+", part) if isinstance(part, str) else (part,)):
            if number and words[-1].parts:
                words.append(Text())
            words[-1] = Text.of(words[-1], piece)
    return tuple(word for word in words if word.parts)


def _below(prefix: str, name: Text) -> Text:
    return Text.of(*(piece for piece in (prefix, "/" if prefix and name.parts else "", name) if piece != ""))


def _private(setting: Setting) -> Setting:
    """Return a parameter of a node; roslaunch takes ``/`` in front of its name for nothing."""
    first, *rest = setting.name.parts or ("",)
    if isinstance(first, str):
        return msgspec.structs.replace(setting, name=Text.of("~" + first.lstrip("~/"), *rest))
    return msgspec.structs.replace(setting, name=Text.of("~", setting.name))


def _without_end(text: Text) -> Text:
    last = text.parts[-1]
    if len(text.parts) == 1 and last == "/":
        return text
    return Text((*text.parts[:-1], last.rstrip("/"))) if isinstance(last, str) else text
