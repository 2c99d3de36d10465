"""Files of parameters that launch files of ROS 2 give to nodes, with what is put into them before a node reads them.

launch_ros replaces substitutions in a file (``allow_substs``); ``RewrittenYaml`` and ``ReplaceString`` of nav2_common
change values, and what all nodes of the file are below. What is put in and not known stands as a hole where it is.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from functools import lru_cache

import msgspec

from roslens.intake.file_budget import file_budget
from roslens.model.errors import DocumentError
from roslens.source.extract.facts.files import Files
from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.launch.substitution_text import parse
from roslens.source.extract.launch_python.deferred import Scope, resolve, truth
from roslens.source.extract.launch_python.file_changes import read_changes
from roslens.source.extract.launch_python.launch_action import FileChange
from roslens.source.extract.parameters.parameter_file import ros2_parameters
from roslens.source.extract.parameters.ros2_values import type_when_written
from roslens.source.extract.symbolic.reason import RewrittenFile
from roslens.source.extract.symbolic.text import Hole, Text

MOST_KEPT_BYTES = 200_000
"""Of files whose parameters are known when another launch file gives them to its nodes."""
_ROS = "ros__parameters"
_UNKNOWN = b""
_HOLE = re.compile("\ue000([0-9]+)\ue001")
"""Stands in the text of a file for what is not known."""


class ParameterFiles:
    """Reads files of parameters, each once."""

    def __init__(self, files: Files) -> None:
        """Read from ``files``."""
        self._files = files
        self._read: dict[tuple[str, bytes], list[Setting] | DocumentError] = {}
        self._rewritten: dict[object, list[Setting]] = {}

    def settings(self, path: str, changes: Iterable[FileChange], scope: Scope) -> list[Setting] | None:
        """Return the parameters of a file, changes made in their order; None where there is no such file.

        Raises:
            DocumentError: ROS 2 refuses the file.
        """
        content = self._files.content(path)
        if content is None:
            return None
        holes: list[Hole] = []
        rest = list(changes)
        while rest and rest[0].kind in _IN_TEXT:
            content = _IN_TEXT[rest[0].kind](content, rest[0], scope, holes)
            rest.pop(0)
        found = self._parsed(path, content)
        if holes:
            found = [_with_holes(one, holes) for one in found]
        # All nodes of a launch file are given the same file with the same changes, as a rule.
        source: object = None if holes else (path, content)
        for change in rest:
            if change.kind in _IN_TEXT:
                found, source = [_substituted(one, change, scope) for one in found], None
            elif change.kind == "root":
                found, source = _below(found, resolve(change.value, scope)), None
            elif change.kind == "keys":
                found, source = _renamed(found, change, scope), None
            else:
                pairs = tuple((resolve(key, scope), resolve(value, scope)) for key, value in change.pairs)
                source = None if source is None else (source, change.kind, change.numbers, pairs)
                found = self._changed(source, found, change, pairs)
        return found

    def _changed(
        self, source: object, settings: list[Setting], change: FileChange, pairs: tuple[tuple[Text, Text], ...]
    ) -> list[Setting]:
        """Return rewritten parameters; ``source`` tells which these are, None where that is not known."""
        found = None if source is None else self._rewritten.get(source)
        if found is None:
            found = _rewritten(settings, change, pairs)
            if source is not None:
                self._rewritten[source] = found
        return found

    def of_copy(self, path: Text, changes: Iterable[FileChange], scope: Scope) -> tuple[Text, tuple[FileChange, ...]]:
        """Return the file that a path leads to, with all that is done to it: the path may be that of a changed copy."""
        found = tuple(changes)
        match path.parts:
            case (Hole(reason=RewrittenFile(number=number)),):
                of, *texts = scope.rewritten[number]
                return self.of_copy(of, (*read_changes(tuple(texts)), *found), scope)
        return path, found

    def _parsed(self, path: str, content: bytes) -> list[Setting]:
        known = self._read.get((path, content))
        if known is None:
            try:
                with file_budget(path, size=len(content)):
                    known = (
                        _parsed(content, path) if len(content) <= MOST_KEPT_BYTES else ros2_parameters(content, path)
                    )
            except DocumentError as error:
                known = error
            self._read[path, content] = known
        if isinstance(known, DocumentError):
            raise known
        return known


@lru_cache(16)
def _parsed(content: bytes, path: str) -> list[Setting]:
    return ros2_parameters(content, path)


def _replaced(content: bytes, change: FileChange, scope: Scope, holes: list[Hole]) -> bytes:
    if not _holds(change, scope):
        return content
    text = content.decode("utf-8", "surrogateescape")
    for written, value in change.pairs:
        key = resolve(written, scope).known
        if key is None:
            # Anything may be replaced: nothing in the file is known.
            return _UNKNOWN
        if key and key in text:
            text = text.replace(key, _written(resolve(value, scope), holes))
    return text.encode("utf-8", "surrogateescape")


def _holds(change: FileChange, scope: Scope) -> bool:
    """Whether a change is made; where that is unknown the file is taken as it stands."""
    try:
        return truth(resolve(change.condition, scope)) is change.wanted
    except ValueError:
        return False


def _substitutions(content: bytes, _change: FileChange, scope: Scope, holes: list[Hole]) -> bytes:
    if b"$(" not in content:
        return content
    found = resolve(parse(content.decode("utf-8", "surrogateescape")), scope)
    if len(found.parts) == 1 and found.holes:
        # Not even where a substitution ends is known.
        return content
    return _written(found, holes).encode("utf-8", "surrogateescape")


def _written(text: Text, holes: list[Hole]) -> str:
    pieces = []
    for part in text.parts:
        match part:
            case str():
                pieces.append(part)
            case _:
                pieces.append(f"\ue000{len(holes)}\ue001")
                holes.append(part)
    return "".join(pieces)


_IN_TEXT: dict[str, Callable[[bytes, FileChange, Scope, list[Hole]], bytes]] = {
    "replace": _replaced,
    "substitutes": _substitutions,
}


def _with_holes(setting: Setting, holes: list[Hole]) -> Setting:
    """Return a parameter with holes where something stands for them; what type it has then nobody knows."""
    value = _unfolded(setting.value, holes)
    name = _unfolded(setting.name, holes)
    kind = setting.type if value is setting.value else ""
    return msgspec.structs.replace(setting, name=name, value=value, type=kind, node=_HOLE.sub("*", setting.node))


def _unfolded(text: Text, holes: list[Hole]) -> Text:
    known = text.known
    if known is None or "\ue000" not in known:
        return text
    parts: list[str | Hole] = []
    for place, piece in enumerate(_HOLE.split(known)):
        parts.append(holes[int(piece)] if place % 2 else piece)
    return Text.of(*parts)


def _substituted(setting: Setting, change: FileChange, scope: Scope) -> Setting:
    known = setting.value.known or ""
    if change.kind != "substitutes" or "$(" not in known:
        return setting
    value = resolve(parse(known), scope)
    if setting.type.endswith("_array") and value.known is not None:
        # The items of a list stay texts, as a rule.
        return msgspec.structs.replace(setting, value=value)
    return _set(setting, value, numbers=True)


def _below(settings: list[Setting], root: Text) -> list[Setting]:
    if root.known is None:
        # It may be any namespace, or none.
        return [msgspec.structs.replace(one, node=f"/**{one.node}") for one in settings]
    known = root.known.strip("/")
    return [msgspec.structs.replace(one, node=f"/{known}{one.node}") for one in settings] if known else settings


def _rewritten(settings: list[Setting], change: FileChange, pairs: tuple[tuple[Text, Text], ...]) -> list[Setting]:
    """Return parameters with other values: by name or path of them (``names``), or by what they were (``values``)."""
    known = {key.known: value for key, value in pairs if key.known is not None}
    open_ = next((value for key, value in pairs if key.known is None), None)
    if not pairs:
        return settings
    has_paths = any(f".{_ROS}." in key for key in known)
    found = []
    for one in settings:
        if change.kind == "values":
            value = known.get(one.value.known or "")
        else:
            value = _value_by_name(one, known, has_paths=has_paths)
        # What is replaced by an unknown name may be any of them.
        value = open_ if value is None and open_ is not None else value
        found.append(one if value is None else _set(one, value, numbers=change.numbers))
    return [*found, *_added(settings, known, change)] if has_paths and change.kind != "values" else found


def _path(setting: Setting) -> str:
    """Return the path of a parameter in its file."""
    return ".".join([*setting.node.strip("/").split("/"), _ROS, setting.name.known or ""])


def _value_by_name(setting: Setting, known: dict[str, Text], *, has_paths: bool) -> Text | None:
    """Return what a value becomes: by its path in the file, which counts more, or its own name."""
    name = setting.name.known or ""
    found = known.get(_path(setting)) if has_paths else None
    return known.get(name, known.get(name.rpartition(".")[2])) if found is None else found


def _added(settings: list[Setting], known: dict[str, Text], change: FileChange) -> list[Setting]:
    """Return the parameters of paths that the file does not have: they are added to it."""
    there = set(map(_path, settings))
    found: list[Setting] = []
    for path, value in known.items():
        node, separator, name = path.partition(f".{_ROS}.")
        if separator and path not in there and settings:
            empty = Setting(Text.of(name), Text(), settings[0].evidence, "", f"/{node.replace('.', '/')}")
            found.append(_set(empty, value, numbers=change.numbers))
    return found


def _renamed(settings: list[Setting], change: FileChange, scope: Scope) -> list[Setting]:
    """Return parameters with other keys in their paths, of nodes too."""
    pairs = {resolve(key, scope).known: resolve(value, scope) for key, value in change.pairs}
    return [_with_keys(one, pairs) for one in settings] if pairs else settings


def _with_keys(setting: Setting, pairs: dict[str | None, Text]) -> Setting:
    node = "/".join(_key(piece, pairs).pattern for piece in setting.node.split("/"))
    pieces = (setting.name.known or "").split(".")
    name = Text.of(*(part for place, piece in enumerate(pieces) for part in (("." * bool(place)), _key(piece, pairs))))
    return msgspec.structs.replace(setting, node=node, name=name if setting.name.known is not None else setting.name)


def _key(piece: str, pairs: dict[str | None, Text]) -> Text:
    found = pairs.get(piece)
    if found is None and None in pairs and piece:
        return pairs[None]
    return Text.of(piece) if found is None else found


def _set(setting: Setting, value: Text, *, numbers: bool) -> Setting:
    known = value.known
    kind = "" if known is None else type_when_written(known, numbers=numbers)
    return msgspec.structs.replace(setting, value=value, type=kind)
