"""Nodes that nearly every robot runs and whose source is in few workspaces: what they publish, subscribe and call.

Facts are taken from the public source that each entry names. Releases differ, so none of them is certain.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from importlib import resources
from typing import Any

import msgspec

from roslens.judge.documents.yaml_tree import Items, Node, Table, Tree, read_tree
from roslens.model.configuration import Origin
from roslens.model.errors import DocumentError, UsageError
from roslens.source.extract.catalogue.catalogue_bridge import bridged
from roslens.source.extract.catalogue.hints import ROLES, endpoint_of, text_of
from roslens.source.extract.facts.launched import Launched
from roslens.source.extract.facts.meant import Meant
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, NodeFacts, ParameterFact, Sure
from roslens.source.extract.symbolic.reason import RandomEnd
from roslens.source.extract.symbolic.text import Hole, Text

_FOLDER = "catalogue"
RECONFIGURES = (
    ("publishes", "parameter_descriptions dynamic_reconfigure/ConfigDescription latched"),
    ("publishes", "parameter_updates dynamic_reconfigure/Config latched"),
    ("serves", "set_parameters dynamic_reconfigure/Reconfigure"),
)
"""What a server of dynamic_reconfigure makes in its namespace, by key and line."""
_HOW = "known for this node; differs between releases"


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A node of the catalogue.

    Attributes:
        package: that has it.
        generation: ``ros1`` or ``ros2``.
        source: where its facts can be read: repository and path.
        executables: by which it is started.
        classes: by which it is loaded, as component or nodelet.
        name: that it gives itself; empty where it gives none.
        random_end: whether it puts a random end behind that name, so that several run beside each other.
        kind: ``node``, ``lifecycle`` or ``container``.
        bridge: whether the words of its command line name what it publishes and subscribes (``parameter_bridge``).
        parameters: with default: ``name: value``.
        reconfigures: what stands before the names of servers of dynamic_reconfigure, ``~`` or ``~namespace/``.
    """

    package: str
    generation: str
    source: str
    executables: tuple[str, ...] = ()
    classes: tuple[str, ...] = ()
    name: str = ""
    random_end: bool = False
    kind: str = "node"
    bridge: bool = False
    publishes: tuple[str, ...] = ()
    subscribes: tuple[str, ...] = ()
    serves: tuple[str, ...] = ()
    calls: tuple[str, ...] = ()
    serves_actions: tuple[str, ...] = ()
    calls_actions: tuple[str, ...] = ()
    parameters: dict[str, str] = {}
    reconfigures: tuple[str, ...] = ()


class _File(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    nodes: tuple[Entry, ...]


def known_node(launched: Launched, generation: str, words: Sequence[Text]) -> Meant | None:
    """Return what is known of a node that is started; None where the catalogue has none of its name."""
    package, executable, plugin = launched.package.known, launched.executable.known, launched.plugin.known
    entries = _by_name()
    found = (
        entries.get((generation, "", plugin)) if plugin else entries.get((generation, package or "", executable or ""))
    )
    return None if found is None else Meant((facts_of(found, words),), origin=Origin.CATALOGUE)


def facts_of(entry: Entry, words: Sequence[Text] = ()) -> NodeFacts:
    """Return an entry as facts.

    Args:
        entry: of the catalogue.
        words: on the command line of the node, those for ROS itself left out.

    Raises:
        UsageError: a line of the entry tells no endpoint.
    """
    evidence = Evidence(entry.source, 0, 0, _HOW, Sure.LIKELY)
    endpoints: list[EndpointFact] = []
    for key, role in ROLES.items():
        endpoints += [endpoint_of(line, role, entry.generation, evidence, words) for line in getattr(entry, key)]
    for before in entry.reconfigures:
        for key, line in RECONFIGURES:
            endpoints.append(endpoint_of(before + line, ROLES[key], entry.generation, evidence, words))
    if entry.bridge:
        endpoints += bridged(words, evidence)
    parameters = [
        ParameterFact(Text.of(name), evidence, "declared", default=Text.of(value) if value else None)
        for name, value in entry.parameters.items()
    ]
    unit = entry.classes[0] if entry.classes else entry.executables[0] if entry.executables else ""
    name = Text.of(entry.name, "_", Hole(RandomEnd())) if entry.random_end else text_of(entry.name)
    return NodeFacts(
        unit, entry.source, 0, entry.generation, entry.kind, name, endpoints=tuple(endpoints),
        parameters=tuple(parameters),
    )  # fmt: skip


@cache
def entries() -> tuple[Entry, ...]:
    """Return the catalogue that comes with roslens."""
    folder = resources.files("roslens.source.extract").joinpath(_FOLDER)
    files = sorted((one for one in folder.iterdir() if one.name.endswith(".yaml")), key=lambda one: one.name)
    return tuple(entry for file in files for entry in read_catalogue(file.read_bytes(), file.name))


@cache
def _by_name() -> Mapping[tuple[str, str, str], Entry]:
    found: dict[tuple[str, str, str], Entry] = {}
    for entry in entries():
        for name in entry.executables:
            found.setdefault((entry.generation, entry.package, name), entry)
        for name in entry.classes:
            found.setdefault((entry.generation, "", name), entry)
    return found


def read_catalogue(content: bytes, shown: str) -> tuple[Entry, ...]:
    """Read a document of the catalogue.

    Args:
        content: of the file.
        shown: its name in messages.

    Raises:
        DocumentError: it is no YAML, a key or value is not valid, or a line tells no endpoint.
    """
    tree = read_tree(content, shown)
    try:
        read = msgspec.convert(plain_value(tree.root), _File, strict=False)
    except msgspec.ValidationError as error:
        what, _, path = str(error).partition(" - at ")
        raise DocumentError(
            what, where=_place(tree, path.strip("`")), expected="nodes, each with package, generation and source"
        ) from error
    for number, entry in enumerate(read.nodes):
        try:
            facts_of(entry)
        except UsageError as error:
            where = _place(tree, f"$.nodes[{number}]")
            raise DocumentError(error.what, where=where, expected=error.expected) from error
    return read.nodes


def plain_value(node: Node | None) -> Any:
    """Return a document as lists, dictionaries and texts."""
    match node:
        case Items():
            return [plain_value(one) for one in node.nodes]
        case Table():
            return {key: plain_value(one) for key, one in node.nodes.items()}
    return None if node is None else node.text


def _place(tree: Tree, path: str) -> Any:
    """Return where the node is that msgspec names, as ``$.nodes[3].source``; as near as it goes."""
    node = tree.root
    for piece in path.replace("[", ".[").split(".")[1:]:
        inner: Node | None = None
        match node:
            case Table():
                inner = node.nodes.get(piece)
            case Items() if piece.strip("[]").isdecimal():
                inner = node.nodes[int(piece.strip("[]"))]
        if inner is None:
            break
        node = inner
    return tree.shown if node is None else tree.location(node.place)
