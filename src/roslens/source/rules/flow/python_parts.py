"""Parts of the syntax of Python that say what a function takes: parameters, decorators, literal containers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from tree_sitter import Node

from roslens.source.rules.file_view import FileView

CONTAINERS = ("list", "tuple", "dictionary", "set")
_HARMLESS = frozenset({"staticmethod", "classmethod", "override", "typing.override", "typing_extensions.override"})


def items_of(node: Node) -> Sequence[Node]:
    """Return the values that a literal list, tuple, set or dictionary holds."""
    if node.type not in CONTAINERS:
        return ()
    values = (one.child_by_field_name("value") if one.type == "pair" else one for one in node.named_children)
    return [one for one in values if one is not None]


def parameter_names(function: Node) -> Iterator[Node]:
    """Yield the names of the parameters of a function."""
    listed = function.child_by_field_name("parameters")
    for one in listed.named_children if listed is not None else ():
        name = one if one.type == "identifier" else one.child_by_field_name("name")
        name = name or next((each for each in one.named_children if each.type == "identifier"), None)
        if name is not None:
            yield name


def _decorators(function: Node, view: FileView) -> Mapping[str, Node]:
    around = function.parent
    if around is None or around.type != "decorated_definition":
        return {}
    return {view.text(one).removeprefix("@"): one for one in around.children if one.type == "decorator"}


def has_decorator(function: Node, decorator: str, view: FileView) -> bool:
    """Tell whether a function has a decorator, written like that."""
    return decorator in _decorators(function, view)


def is_plain(function: Node, view: FileView) -> bool:
    """Tell whether no decorator changes what the function takes and returns."""
    return _decorators(function, view).keys() <= _HARMLESS
