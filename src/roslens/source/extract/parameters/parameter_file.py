"""Files of parameters: YAML that ``rosparam load`` or ``--params-file`` reads, flattened to names and texts."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import msgspec

from roslens.judge.documents.yaml_tree import Items, Node, Scalar, Table, Tree, read_parameter_trees, read_tree
from roslens.model.errors import DocumentError
from roslens.source.extract.facts.launched import Setting
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.parameters.ros1_values import angle, type_in_yaml
from roslens.source.extract.parameters.ros2_values import is_mixed, type_in_file
from roslens.source.extract.symbolic.text import Text

_ROS2 = "ros__parameters"


def ros1_parameters(content: bytes, path: str, line: int = 0) -> list[Setting]:
    """Return the parameters of a file of ROS 1, names joined by ``/`` without one in front.

    Args:
        content: of the file, or of a ``rosparam`` element.
        path: of the file, for evidence.
        line: before the first line of the text.

    Raises:
        DocumentError: it is no YAML that can be read.
    """
    # rosparam reads with PyYAML, which takes the last of two keys of one name.
    tree = read_tree(content, path, last_counts=True)
    if tree.root is None:
        return []
    found = []
    for names, node in _leaves(tree.root, ()):
        match names, node:
            case (_, *_), Table():
                # What is empty sets nothing.
                pass
            case _:
                found.append(_ros1(names, node, _setting(names, "/", node, tree, line)))
    return found


def _ros1(names: tuple[str, ...], node: Node, setting: Setting) -> Setting:
    """Return a parameter as rosparam types it; a name that begins with ``/`` is one of its own."""
    first = max((place for place, one in enumerate(names) if one.startswith("/")), default=0)
    match node:
        case Scalar(text=text, plain=True):
            turned = angle(text)
        case _:
            turned = None
    return msgspec.structs.replace(
        setting,
        name=Text.of("/".join(names[first:])) if first else setting.name,
        type=type_of(node, type_in_yaml),
        value=setting.value if turned is None else Text.of(repr(turned)),
    )


def ros2_parameters(content: bytes, path: str) -> list[Setting]:
    """Return the parameters of a file of ROS 2, names joined by ``.``, each with the pattern of nodes it is for.

    Raises:
        DocumentError: it is no YAML that can be read, a table that is not ``node: {ros__parameters: …}``, or has a list
            of values of different types.
    """
    return [one for tree in read_parameter_trees(content, path) for one in _of_document(tree)]


def _of_document(tree: Tree) -> Iterator[Setting]:
    """Yield the parameters of a document."""
    if tree.root is None:
        return
    for nodes, table in _of_nodes(tree.root, (), tree):
        pattern = "/" + "/".join(piece.strip("/") for piece in nodes if piece.strip("/"))
        for names, node in _leaves(table, ()):
            match node:
                case Table():
                    # What is empty sets nothing.
                    continue
            if not names or is_mixed(node):
                raise _refused(
                    node, tree, "a list of values of different types" if names else "not a table of parameters"
                )
            setting = _setting(names, ".", node, tree, 0, pattern)
            yield msgspec.structs.replace(setting, type=type_in_file(node))


def _refused(node: Node, tree: Tree, what: str) -> DocumentError:
    match node:
        case Items():
            expected = "values of one type, such as [1.0, 2.5] or ['1', 'a']"
        case _:
            expected = "ros__parameters: {name: value}"
    return DocumentError(
        f"{what}: {written(node)}" if written(node) else what,
        where=tree.location(node.place),
        expected=expected,
        advice="ROS 2 rejects the whole file, and the node does not start",
    )


def _of_nodes(node: Node, above: tuple[str, ...], tree: Tree) -> Iterator[tuple[tuple[str, ...], Node]]:
    match node:
        case Table(nodes=nodes):
            pass
        case _:
            raise DocumentError(
                "a value outside of ros__parameters",
                where=tree.location(node.place),
                expected="node: {ros__parameters: {name: value}}",
                advice="ROS 2 rejects the whole file; indent the parameters below ros__parameters",
            )
    for key, inner in nodes.items():
        if key == _ROS2:
            yield above, inner
        else:
            yield from _of_nodes(inner, (*above, key), tree)


def _leaves(node: Node, above: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Node]]:
    match node:
        case Table() if node.nodes:
            merged = node.nodes.get("<<")
            # What a table has itself holds over what is merged into it, and of several the first one.
            for one in reversed(merged.each) if merged is not None else ():
                match one:
                    case Table():
                        yield from _leaves(one, above)
            for key, inner in node.nodes.items():
                if key != "<<":
                    yield from _leaves(inner, (*above, key))
        case _:
            yield above, node


def _setting(names: tuple[str, ...], separator: str, node: Node, tree: Tree, line: int, pattern: str = "") -> Setting:
    place = tree.location(node.place)
    evidence = Evidence(place.path, line + place.line, place.column)
    return Setting(Text.of(separator.join(names)), Text.of(written(node)), evidence, type_of(node), pattern)


def written(node: Node) -> str:
    """Return a node as YAML in one line."""
    match node:
        case Scalar():
            return node.text
        case Items():
            return f"[{', '.join(written(one) for one in node.nodes)}]"
    return f"{{{', '.join(f'{key}: {written(one)}' for key, one in node.nodes.items())}}}"


def type_of(node: Node, of_text: Callable[[str], str] | None = None) -> str:
    """Return the type that YAML gives a value; ``of_text`` returns that of plain ones."""
    match node:
        case Items():
            kinds = {type_of(one, of_text) for one in node.nodes}
            if kinds == {"int", "double"}:
                return "double_array"
            return f"{kinds.pop()}_array" if len(kinds) == 1 else "list"
        case Table():
            return "map"
    return (of_text or type_of_text)(node.text) if node.plain else "string"


def type_of_text(text: str) -> str:
    """Return the type that YAML gives a plain text: ``bool``, ``int``, ``double`` or ``string``."""
    if text.lower() in ("true", "false", "yes", "no", "on", "off"):
        return "bool"
    for kind, convert in (("int", lambda one: int(one, 0)), ("double", float)):
        try:
            convert(text)
        except ValueError:
            continue
        return kind
    return "double" if text.lower() in (".inf", "-.inf", ".nan") else "string"
