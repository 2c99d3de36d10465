"""ROS 2 launch files in XML and YAML as actions: elements and their attributes are the same in both.

The elements are those of ``launch_xml``, ``launch_yaml`` and ``launch_ros`` (docs.ros.org).
"""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from roslens.judge.documents.yaml_tree import Items, Node, Scalar, Table, Tree, read_tree
from roslens.model.errors import DocumentError
from roslens.model.source import Location
from roslens.source.extract.facts.files import Files
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch.substitution_text import parse, words
from roslens.source.extract.launch_python.deferred import Value
from roslens.source.extract.launch_python.known_actions import KnownActions
from roslens.source.extract.launch_python.launch_action import Action, Condition, FileChange, Parameter
from roslens.source.extract.parameters.parameter_file import written as yaml_written
from roslens.source.workspace.elements import Document, Element, read_elements

_KNOWN = KnownActions()


class Entity(msgspec.Struct, frozen=True):
    """An element of either format."""

    kind: str
    evidence: Evidence
    attributes: dict[str, str]
    children: tuple[Entity, ...] = ()

    def all(self, kind: str) -> list[Entity]:
        """Return the children of a kind."""
        return [child for child in self.children if child.kind == kind]

    def value(self, *names: str) -> Value:
        """Return an attribute by the first of its names that is there, as a text with substitutions."""
        return parse(next((self.attributes[name] for name in names if name in self.attributes), ""))


def actions_of(path: str, content: bytes, files: Files | None = None) -> tuple[Action, ...]:
    """Return the actions of a launch file by its name: Python, YAML, else XML.

    Raises:
        DocumentError: it cannot be read at all.
    """
    return _KNOWN.of(path, content, files, lambda noted: _read(path, content, noted))


def _read(path: str, content: bytes, files: Files | None) -> tuple[Action, ...]:
    if path.endswith(".py"):
        from roslens.source.extract.launch_python.launch_python import python_actions

        return python_actions(path, content, files)
    return (yaml_actions if path.endswith((".yaml", ".yml")) else xml_actions)(path, content)


def xml_actions(path: str, content: bytes) -> tuple[Action, ...]:
    """Return the actions of an XML file.

    Raises:
        DocumentError: it is no XML, or its outermost element is no ``launch``.
    """
    document = read_elements(content)
    root = document.root
    if root is None or root.tag != "launch":
        fault = document.faults[0] if document.faults else None
        where = Location(path, *document.place(fault.offset if fault else root.start if root else 0))
        found = fault.what if fault else f"<{root.tag}>" if root else "nothing"
        raise DocumentError(found, where=where, expected="<launch> as the outermost element")
    faults = [
        Action(
            "unknown", Evidence(path, *document.place(one.offset)), {"text": one.what}, note=f"expected {one.expected}"
        )
        for one in document.faults
    ]
    return (*_actions([_xml_entity(path, document, child) for child in root.elements()]), *faults)


def yaml_actions(path: str, content: bytes) -> tuple[Action, ...]:
    """Return the actions of a YAML file.

    Raises:
        DocumentError: it is no YAML, or has no list ``launch``.
    """
    tree = read_tree(content, path)
    match tree.root:
        case Table(nodes={"launch": Items() as inner}):
            return tuple(_actions(_yaml_entities(path, tree, inner)))
    raise DocumentError("no list `launch`", where=Location(path, 1, 1), expected="launch: with a list of actions")


def read_entities(path: str, content: bytes) -> tuple[Entity, ...]:
    """Return the outermost elements of a launch file in XML or YAML, by its name; in XML those before a fault.

    Raises:
        DocumentError: it is no YAML.
    """
    if not path.endswith((".yaml", ".yml")):
        document = read_elements(content)
        children = document.root.elements() if document.root is not None else ()
        return tuple(_xml_entity(path, document, child) for child in children)
    tree = read_tree(content, path)
    match tree.root:
        case Table(nodes={"launch": Items() as inner}):
            return tuple(_yaml_entities(path, tree, inner))
    return ()


def _xml_entity(path: str, document: Document, element: Element) -> Entity:
    return Entity(
        element.tag,
        Evidence(path, *document.place(element.start)),
        element.attributes,
        tuple(_xml_entity(path, document, child) for child in element.elements()),
    )


def _yaml_entities(path: str, tree: Tree, node: Node) -> list[Entity]:
    match node:
        case Items(nodes=items):
            return [one for inner in items for one in _yaml_entities(path, tree, inner)]
        case Table(nodes=parts):
            return [_yaml_entity(path, tree, kind, inner) for kind, inner in parts.items()]
    return []


def _yaml_entity(path: str, tree: Tree, kind: str, node: Node) -> Entity:
    place = tree.location(node.place)
    evidence = Evidence(path, place.line, place.column)
    attributes: dict[str, str] = {}
    children: list[Entity] = []
    match node:
        case Items():
            children = _yaml_entities(path, tree, node)
        case Table():
            for key, inner in node.nodes.items():
                match inner:
                    case Scalar():
                        attributes[key] = inner.text
                    case Items() if not any(isinstance(one, Table) for one in inner.nodes):
                        attributes[key] = yaml_written(inner)
                    case _ if key == "children":
                        children += _yaml_entities(path, tree, inner)
                    case _:
                        children += [_yaml_entity(path, tree, key, one) for one in inner.each]
        case _:
            attributes["value"] = node.text
    return Entity(kind, evidence, attributes, tuple(children))


def _actions(entities: list[Entity] | tuple[Entity, ...]) -> list[Action]:
    return [msgspec.structs.replace(_action(one), condition=_condition(one)) for one in entities]


def _action(entity: Entity) -> Action:
    make = _MAKERS.get(entity.kind.replace("-", "_"))
    if make is None:
        note = "an unsupported element"
        return Action("unknown", entity.evidence, {"text": f"<{entity.kind}>"}, note=note)
    return make(entity)


def _condition(entity: Entity) -> Condition | None:
    for name, wanted in (("if", True), ("unless", False)):
        if name in entity.attributes:
            return Condition(entity.value(name), wanted, entity.attributes[name])
    return None


def _argument(entity: Entity) -> Action:
    values = {"name": entity.value("name"), "description": entity.value("description")}
    if "default" in entity.attributes:
        values["default"] = entity.value("default")
    choices = [one.attributes.get("value", "") for one in entity.all("choice")]
    return Action("argument", entity.evidence, values | ({"choices": "\n".join(choices)} if choices else {}))


def _set(entity: Entity) -> Action:
    return Action("set", entity.evidence, {"name": entity.value("name"), "value": entity.value("value")})


def _include(entity: Entity) -> Action:
    given = [one for kind in ("arg", "let") for one in entity.all(kind)]
    return Action("include", entity.evidence, {"file": entity.value("file")}, tuple(_set(one) for one in given))


def _group(entity: Entity) -> Action:
    scoped = entity.attributes.get("scoped", "true").lower() in ("true", "1", "yes")
    return Action("group", entity.evidence, children=tuple(_actions(entity.children)), scoped=scoped)


def _namespace(entity: Entity) -> Action:
    return Action("namespace", entity.evidence, {"namespace": entity.value("namespace", "ns", "value")})


def _set_parameter(entity: Entity) -> Action:
    one = Parameter(entity.evidence, entity.value("name"), entity.value("value"))
    return Action("parameter", entity.evidence, parameters=(one,))


def _set_parameters(entity: Entity) -> Action:
    one = Parameter(entity.evidence, file=entity.value("filename"))
    return Action("parameter", entity.evidence, parameters=(one,))


def _use_sim_time(entity: Entity) -> Action:
    one = Parameter(entity.evidence, "use_sim_time", entity.value("value"), "bool")
    return Action("parameter", entity.evidence, parameters=(one,))


def _set_remap(entity: Entity) -> Action:
    return Action("remap", entity.evidence, remaps=((entity.value("from"), entity.value("to")),))


def _node(kind: str) -> Callable[[Entity], Action]:
    def make(entity: Entity) -> Action:
        values = {
            name: entity.value(*written)
            for name, written in (
                ("package", ("pkg",)),
                ("executable", ("exec", "executable")),
                ("name", ("name",)),
                ("namespace", ("namespace", "ns")),
                ("plugin", ("plugin",)),
                ("target", ("target",)),
            )
            if any(one in entity.attributes for one in written)
        }
        return Action(
            kind,
            entity.evidence,
            values,
            tuple(_actions([one for one in entity.children if one.kind.startswith("composable_")])),
            parameters=tuple(one for param in entity.all("param") for one in _parameters(param, "")),
            remaps=tuple((one.value("from"), one.value("to")) for one in entity.all("remap")),
            words=words(entity.attributes.get("args", "")),
        )

    return make


def _parameters(entity: Entity, above: str) -> list[Parameter]:
    if "from" in entity.attributes:
        allowed = entity.attributes.get("allow_substs", "").lower() in ("true", "1", "yes", "on")
        return [Parameter(entity.evidence, file=entity.value("from"), changes=(FileChange("substitutes"),) * allowed)]
    name = f"{above}.{entity.attributes.get('name', '')}" if above else entity.attributes.get("name", "")
    if entity.children:
        return [one for child in entity.all("param") for one in _parameters(child, name)]
    kind = {"str": "string", "int": "int", "float": "double", "bool": "bool"}.get(entity.attributes.get("type", ""), "")
    return [Parameter(entity.evidence, parse(name), entity.value("value"), kind)]


def _executable(entity: Entity) -> Action:
    return Action("process", entity.evidence, {"executable": entity.value("cmd")})


def _timer(entity: Entity) -> Action:
    return Action("sequence", entity.evidence, children=tuple(_actions(entity.children)))


def _for_each(entity: Entity) -> Action:
    return Action("loop", entity.evidence, {"over": entity.value("values", "iter")}, tuple(_actions(entity.children)))


def _for(entity: Entity) -> Action:
    values = {"over": entity.value("len"), "name": entity.value("name")}
    return Action("loop", entity.evidence, values, tuple(_actions(entity.children)))


def _environment(entity: Entity) -> Action:
    return Action("environment", entity.evidence, {"name": entity.value("name") if entity.attributes else "*"})


def _nothing(entity: Entity) -> Action:
    return Action("nothing", entity.evidence)


_MAKERS: dict[str, Callable[[Entity], Action]] = {
    "arg": _argument,
    "let": _set,
    "include": _include,
    "group": _group,
    "push_ros_namespace": _namespace,
    "push_namespace": _namespace,
    "set_parameter": _set_parameter,
    "set_parameters_from_file": _set_parameters,
    "set_use_sim_time": _use_sim_time,
    "set_remap": _set_remap,
    "node": _node("node"),
    "lifecycle_node": _node("lifecycle"),
    "node_container": _node("container"),
    "composable_node": _node("component"),
    "composable_lifecycle_node": _node("component"),
    "load_composable_node": _node("load"),
    "executable": _executable,
    "timer": _timer,
    "for_each": _for_each,
    "for": _for,
    "ros_timer": _timer,
    "set_env": _environment,
    "unset_env": _environment,
    "append_env": _environment,
    "pop_environment": _environment,
} | dict.fromkeys(
    ("env", "log", "log_info", "log_debug", "log_warning", "log_error", "shutdown", "reset", "push_environment",
     "lifecycle_transition", "set_ros_log_dir", "choice"),
    _nothing,
)  # fmt: skip
