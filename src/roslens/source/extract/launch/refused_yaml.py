"""Launch files in YAML that launch_yaml cannot take: no YAML, or not a list of actions below ``launch``.

launch_yaml (parser.py, entity.py) loads the file with PyYAML and asks for a table of one key, whose value is a list of
tables of one key each.
"""

from __future__ import annotations

from roslens.judge.documents.yaml_tree import Items, Node, Place, Scalar, Table, read_tree
from roslens.model.errors import DocumentError
from roslens.source.extract.facts.refusal import Refusal
from roslens.source.extract.parameters.unreadable_yaml import TooDeepError, events, other_encoding, unreadable

MOST_BYTES = 2_000_000
_ROOT = "launch: with a list of actions"
_ACTION = "a table of one key, the action: `- node: {pkg: …, exec: …}`"


def refused_yaml(content: bytes) -> Refusal | None:
    """Return what launch_yaml refuses of a file; None where it takes it, or where that is not judged."""
    found = yaml_refusal(content)
    if found is not None or len(content) > MOST_BYTES:
        return found
    try:
        root = read_tree(content, "", last_counts=True).root
    except DocumentError:
        # It is YAML, though not such as is followed here: nested deeply, or with tags.
        return None
    match root:
        case None:
            return Refusal(1, 1, "nothing", _ROOT)
        case Table(nodes=nodes) if len(nodes) == 1 and "launch" in nodes:
            return _actions(nodes["launch"])
        case Table(nodes=nodes) if "launch" in nodes:
            other = next(one for one in nodes if one != "launch")
            return _at(root.keys[other], f"{other!r} beside 'launch'", "launch as the only key")
        case Table(nodes=nodes):
            first = next(iter(nodes), "")
            return _at(root.keys.get(first, root.place), f"{first!r} as the outermost key", _ROOT)
        case Scalar(text=text):
            return _at(root.place, f"{text[:40]!r}", _ROOT)
    return _at(root.place, "a list", _ROOT)


def yaml_refusal(content: bytes) -> Refusal | None:
    """Return where a file is no YAML; None where it is, or where it is too large to tell."""
    import yaml

    if len(content) > MOST_BYTES:
        return None
    try:
        content.decode("utf-8")
        for _ in events(content):
            pass
    except TooDeepError as error:
        # PyYAML calls itself for each level, which Python ends at 1,000.
        return Refusal(error.line, 1, str(error), "fewer levels")
    except UnicodeDecodeError as error:
        return other_encoding(error)
    except yaml.MarkedYAMLError as error:
        return unreadable(error, content)
    except yaml.YAMLError as error:
        return Refusal(1, 1, f"no YAML: {(str(error).splitlines() or [type(error).__name__])[0]}", "YAML")
    return None


def _at(place: Place, what: str, expected: str) -> Refusal:
    return Refusal(place.line, place.column + 1, what, expected)


def _actions(node: Node) -> Refusal | None:
    """Return what is wrong with a list of actions, or with a table that has one as ``children``."""
    match node:
        case Table(nodes=nodes) if "children" in nodes:
            return _actions(nodes["children"])
        case Table():
            return _at(node.place, "a table of actions", "a list: `- ` before each action")
        case Scalar():
            return _at(node.place, f"{node.text[:40]!r}" if node.text else "nothing", "a list of actions")
    for one in node.nodes:
        found = _action(one)
        if found is not None:
            return found
    return None


def _of_group(node: Node) -> Refusal | None:
    match node:
        case Items():
            return _actions(node)
    return None


def _action(node: Node) -> Refusal | None:
    match node:
        case Table(nodes=nodes) if len(nodes) == 1:
            kind, inner = next(iter(nodes.items()))
            return _of_group(inner) if kind == "group" else None
        case Table(nodes=nodes):
            keys = ", ".join(map(repr, list(nodes)[:4]))
            return _at(node.place, f"an action with {len(nodes)} keys ({keys})", _ACTION)
        case Scalar():
            return _at(node.place, f"{node.text[:40]!r} as an action", _ACTION)
    return _at(node.place, "a list as an action", _ACTION)
