"""Parameters that generate_parameter_library declares: its YAML, from which a build makes a ``ParamListener``."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec

from roslens.judge.documents.yaml_tree import Node, Place, Scalar, Table, Tree, read_tree
from roslens.model.errors import DocumentError
from roslens.source.extract.facts.node_facts import Evidence, Terms
from roslens.source.extract.parameters.parameter_file import written

MAP = "__map_"
"""Begins a part of a name that stands for each item of a list which another parameter is."""
_FIXED = re.compile(r"(\w+?)_fixed_(\d+)")
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_TRUE = frozenset({"true", "yes", "on", "y"})


class Declaration(msgspec.Struct, frozen=True):
    """A parameter that is declared: its name with ``__map_`` parts as written, and what is said of it.

    ``validators`` are the functions that check its value, without ``<>``, each where it is named.
    """

    name: str
    type: str
    evidence: Evidence
    default: str | None = None
    range: str = ""
    description: str = ""
    terms: Terms = Terms()
    validators: dict[str, Evidence] = {}


class ParameterLibrary(msgspec.Struct, frozen=True):
    """What a build makes of one file.

    Attributes:
        target: name of the library or module, and of its header.
        namespace: that the ``ParamListener`` is in.
        package: that builds it.
        path: of the file.
        python: whether a module of Python is made, else a header of C++.
        declarations: in order.
        unread: why the file could not be read; empty where it could.
    """

    target: str
    namespace: str
    package: str
    path: str
    python: bool
    declarations: tuple[Declaration, ...] = ()
    unread: str = ""


def parameter_library(target: str, package: str, path: str, content: bytes | None, *, python: bool) -> ParameterLibrary:
    """Return what a build makes of a file; never raises for what is in it.

    Args:
        target: name of the library or module.
        package: that builds it.
        path: of the file.
        content: of the file; None where there is none.
        python: whether a module of Python is made.
    """
    if content is None:
        return ParameterLibrary(target, "", package, path, python, unread=f"{path} cannot be read")
    try:
        namespace, found = declarations_of(content, path)
    except DocumentError as error:
        return ParameterLibrary(target, "", package, path, python, unread=f"{path}: {error.what}")
    return ParameterLibrary(target, namespace, package, path, python, found)


def declarations_of(content: bytes, path: str) -> tuple[str, tuple[Declaration, ...]]:
    """Return the namespace that a file declares parameters in, and these.

    Raises:
        DocumentError: it is no YAML that can be read, or has not one outermost key.
    """
    # The generator reads with PyYAML, which takes the last of two keys of one name.
    tree = read_tree(content, path, last_counts=True)
    match tree.root:
        case Table(nodes=nodes, keys=keys) if len(nodes) == 1:
            ((namespace, inner),) = nodes.items()
            return namespace, tuple(_declared(inner, (), tree, keys[namespace]))
    raise DocumentError(
        "not one outermost key",
        where=tree.location(Place(1, 0)),
        expected="one key, the namespace of the parameters",
        advice="generate_parameter_library rejects the file; put all parameters below one key",
    )


def _declared(node: Node, names: tuple[str, ...], tree: Tree, place: Place) -> Iterator[Declaration]:
    """Yield the parameters below a node; a table whose first value is one holds others (parse_yaml.py, parse_dict)."""
    match node:
        case Table(nodes=nodes) if nodes:
            first = next(iter(nodes.values()))
        case _:
            return
    kind_node = nodes.get("type")
    match first, kind_node:
        case Table(), _:
            for key, inner in nodes.items():
                yield from _declared(inner, (*names, key), tree, node.keys[key])
        case _, Scalar(text=kind) if names and kind != "none":
            yield _declaration(node, ".".join(names), kind, tree, place)


def _declaration(node: Table, name: str, written_type: str, tree: Tree, place: Place) -> Declaration:
    location = tree.location(place)
    fixed = _FIXED.fullmatch(written_type)
    kind = fixed[1] if fixed else written_type
    default = node.nodes.get("default_value")
    described, more = _text(node.nodes.get("description")), _text(node.nodes.get("additional_constraints"))
    validation = node.nodes.get("validation")
    checks = dict(_checks(validation))
    constraints = [one for name, values in checks.items() if (one := _words(name, values))]
    constraints += [f"at most {fixed[2]} {'characters' if kind == 'string' else 'items'}"] if fixed else []
    allowed = checks.get("one_of", ())
    return Declaration(
        name,
        kind,
        Evidence(location.path, location.line, location.column),
        None if default is None or _is_empty(default) else written(default),
        _range(checks),
        " ".join(described.split()),
        Terms(
            read_only=node.texts.get("read_only", "").lower() in _TRUE,
            allowed=tuple(allowed),
            constraints=tuple(one for one in (*constraints, more) if one),
        ),
        _places(validation, tree),
    )


def _text(node: Node | None) -> str:
    match node:
        case Scalar(empty=False, text=text):
            return text
    return ""


def _is_empty(node: Node) -> bool:
    match node:
        case Scalar():
            return node.empty
    return False


def _checks(validation: Node | None) -> Iterator[tuple[str, list[str]]]:
    """Yield the functions that check a value, and what they are given, one list in another one flattened."""
    match validation:
        case Table(nodes=nodes):
            for name, node in nodes.items():
                flat = [two for one in node.each for two in one.each]
                yield name.replace("<>", ""), [written(one) for one in flat if not _is_empty(one)]


def _places(validation: Node | None, tree: Tree) -> dict[str, Evidence]:
    """Return where each function that checks a value is named."""
    match validation:
        case Table(keys=keys):
            named = ((name.replace("<>", ""), tree.location(place)) for name, place in keys.items())
            return {name: Evidence(at.path, at.line, at.column) for name, at in named}
    return {}


def _range(checks: dict[str, list[str]]) -> str:
    ends = {"gt": ">", "gt_eq": "", "lt": "<", "lt_eq": ""}
    found = {name: sign + checks[name][0] for name, sign in ends.items() if _numbers(checks.get(name), 1)}
    if _numbers(bounds := checks.get("bounds"), 2) and bounds:
        return f"{bounds[0]}..{bounds[1]}"
    least, greatest = found.get("gt", found.get("gt_eq", "")), found.get("lt", found.get("lt_eq", ""))
    return f"{least}..{greatest}" if least or greatest else ""


def _numbers(values: list[str] | None, count: int) -> bool:
    return values is not None and len(values) == count and all(_NUMBER.fullmatch(one) for one in values)


def _words(name: str, values: list[str]) -> str:
    """Return what a function checks in words; empty of what range and values say."""
    if name in ("bounds", "gt", "gt_eq", "lt", "lt_eq", "one_of"):
        return "" if name == "one_of" or _range({name: values}) else f"{name} {', '.join(values)}".strip()
    text = _WORDS.get(name)
    if text is None:
        return f"checked by {name}" if "::" in name or "." in name else f"{name} {', '.join(values)}".strip()
    return text.format(", ".join(values), "..".join(values))


_WORDS = {
    "fixed_size": "size {0}",
    "size_gt": "size above {0}",
    "size_lt": "size below {0}",
    "not_empty": "not empty",
    "unique": "no duplicate items",
    "subset_of": "items among {0}",
    "element_bounds": "items in {1}",
    "lower_element_bounds": "items in {0}..",
    "upper_element_bounds": "items in ..{0}",
}
