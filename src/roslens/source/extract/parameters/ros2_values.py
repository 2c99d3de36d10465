"""The type that ROS 2 gives a value of a parameter: in files and on command lines rcl, in launch files launch_ros.

rcl (rcl_yaml_param_parser, parse.c, get_value) asks the C library: ``017`` and ``0x1F`` are integers, ``08``, ``1e3``
and ``infinity`` are doubles, ``1_000`` is text; ``y`` and ``off`` are truth values. launch_ros asks PyYAML first and
writes what that says to a file that rcl reads: what is text to PyYAML and needs no quotes is what rcl makes of it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from roslens.judge.documents.yaml_tree import Items, Node, Scalar, Table, read_tree
from roslens.model.errors import DocumentError

LIST = "list"
"""The type of a list whose items do not determine it."""
_TRUTHS = frozenset(
    word
    for pair in (("y", "n"), ("yes", "no"), ("true", "false"), ("on", "off"))
    for one in pair
    for word in (one, one.capitalize(), one.upper())
)
_WHOLE = re.compile(r"[-+]?(?:0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)")
_REAL = re.compile(
    r"[-+]?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
    r"|0[xX](?:[0-9a-fA-F]+\.?[0-9a-fA-F]*|\.[0-9a-fA-F]+)(?:[pP][-+]?[0-9]+)?"
    r"|[iI][nN][fF](?:[iI][nN][iI][tT][yY])?|[nN][aA][nN])"
)
_WORDS = frozenset(
    {".nan", ".NaN", ".NAN", *(f"{sign}.{word}" for sign in ("", "-", "+") for word in ("inf", "Inf", "INF"))}
)
_MOST = 2**63


def type_in_rcl(text: str) -> str:
    """Return the type that rcl gives a plain text: ``bool``, ``int``, ``double`` or ``string``."""
    if text in _TRUTHS:
        return "bool"
    if _WHOLE.fullmatch(text) and -_MOST <= _whole(text) < _MOST:
        return "int"
    if text in _WORDS or (_REAL.fullmatch(text) and _has_room(text)):
        return "double"
    return "string"


def _whole(text: str) -> int:
    digits = text.lstrip("+-")
    base = 16 if digits[:2].lower() == "0x" else 8 if digits[0] == "0" else 10
    return int(digits, base) * (-1 if text[0] == "-" else 1)


def _has_room(text: str) -> bool:
    """Whether a number fits a double, by the limits of the C library."""
    try:
        number = float(text) if "x" not in text.lower() else float.fromhex(text)
    except (OverflowError, ValueError):
        return False
    return abs(number) != float("inf") or "n" in text.lower()


def type_in_launch(text: str) -> str:
    """Return the type that launch_ros gives the text of a value; empty of what it refuses."""
    return _type_of_text(text, _first_in_yaml) if text else "string"


def type_on_line(text: str) -> str:
    """Return the type that rcl gives a value on a command line; empty of what it refuses."""
    return _type_of_text(text, type_in_rcl)


def type_of_list(types: Sequence[str]) -> str:
    """Return the type of a list that a launch file in Python gives: numbers become doubles, other mixtures texts."""
    known = set(types)
    if not known or not known <= {"bool", "int", "double", "string"}:
        return LIST
    return (
        f"{known.pop()}_array" if len(known) == 1 else "double_array" if known == {"int", "double"} else "string_array"
    )


def type_when_written(text: str, *, numbers: bool) -> str:
    """Return the type of a text that RewrittenYaml puts into a file: ``numbers`` become such, true and false do always.

    PyYAML writes what it would take for something else in quotes.
    """
    from roslens.source.extract.parameters.ros1_values import type_in_yaml

    if text.lower() in ("true", "false"):
        return "bool"
    for kind in (("double" if "." in text else "int"),) if numbers else ():
        try:
            float(text) if kind == "double" else int(text)
        except ValueError:
            break
        return kind
    return type_in_rcl(text) if text and type_in_yaml(text) == "string" else "string"


def _type_of_text(text: str, of_text: Callable[[str], str]) -> str:
    try:
        root = read_tree(text.encode("utf-8", "replace"), "a value").root
    except DocumentError:
        return ""
    return of_text(text.strip()) if root is None else _type(root, of_text)


def _first_in_yaml(text: str) -> str:
    from roslens.source.extract.parameters.ros1_values import type_in_yaml

    known = type_in_yaml(text)
    return type_in_rcl(text) if known == "string" else known


def type_in_file(node: Node) -> str:
    """Return the type that rcl gives a value in a file; ``list`` for a list of unknown type."""
    return _type(node, type_in_rcl)


def _type(node: Node, of_text: Callable[[str], str]) -> str:
    match node:
        case Scalar():
            return of_text(node.text) if node.plain else "string"
        case Table():
            return "map"
    kinds = {_type(one, of_text) for one in node.nodes}
    (kind,) = kinds if len(kinds) == 1 else (LIST,)
    return f"{kind}_array" if kind in ("bool", "int", "double", "string") else LIST


def is_mixed(node: Node) -> bool:
    """Whether a list has values of different types, so that rcl refuses the file; what is substituted may be any."""
    match node:
        case Items(nodes=nodes):
            texts = [one for one in nodes if isinstance(one, Scalar)]
            mixed = len(texts) == len(nodes) and len({type_in_file(one) for one in texts}) > 1
            return mixed and not any("$(" in one.text for one in texts)
    return False
