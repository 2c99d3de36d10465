"""Rule ``cpp.delete_form``: memory that is freed in another form than it was taken."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import cast

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, function_around, whole_name
from roslens.source.rules.cpp_class import has_token
from roslens.source.rules.file_view import FileView, all_above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_NEW = re.compile(rb"(?<![\w\x80-\xff])([\w\x80-\xff]+)\s*(?:=|\()\s*new\b(?=([^;]*))")

_TAKEN = re.compile(
    rb"(?<![\w\x80-\xff])([\w\x80-\xff]+)\s*=\s*(?:\([^()=;]*\)\s*|\w+_cast\s*<[^;()=]*>\s*)?\(?\s*"
    rb"(?:std\s*::\s*|::)?(malloc|calloc|realloc|strdup)\s*\("
)
"""What a function of C takes from the heap, and the name that gets it."""
_TAKES = frozenset((b"malloc", b"calloc", b"realloc", b"strdup"))
_POINTER_TO_VOID = re.compile(rb"\bvoid\s*(?:const\s*)?\*\s*(?:const\s+)?(\w+)\s*[=;,){(]")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield what is given back in another form than the file takes it, and only takes it."""
    if node.type == "delete_expression":
        yield from _deleted(node, view)
    else:
        yield from _freed(node, view)


def _freed(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a ``free`` of what ``new`` makes."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or len(given) != 1 or view.text(whole_name(node)) not in ("free", "std::free", "::free"):
        return
    made, taken = _gets(given[0], view)
    if made and not taken:
        form = "delete[]" if b"[" in _made(made[0][2]) else "delete"
        name = view.text(given[0])
        message = f"`{view.short(call)}`, but `{name}` is made by `new`; expected `{form} {name}`"
        yield view.hit("cpp.delete_form", call, message)


def _gets(operand: Node, view: FileView) -> tuple[Sequence[re.Match[bytes]], Sequence[re.Match[bytes]]]:
    """Return where an operand gets what ``new`` makes, and what functions of C take from the heap."""
    word = re.split(r"->|\.|::", view.text(operand))[-1].encode()
    made = _by_name(_NEW, view).get(word, ()) if b"new" in view.words else ()
    taken = _by_name(_TAKEN, view).get(word, ()) if view.words & _TAKES else ()
    function = function_around(operand)
    if operand.type == "identifier" and function is not None and _is_declared_in(function, word, view):
        start, end = function.start_byte, function.end_byte
        made = [match for match in made if start <= match.start() < end]
        taken = [match for match in taken if start <= match.start() < end]
    return made, taken


def _deleted(node: Node, view: FileView) -> Iterator[Hit]:
    operand = node.named_children[-1] if node.named_child_count else None
    if operand is None or operand.type not in ("identifier", "field_expression"):
        return
    name = view.text(operand)
    word = re.split(r"->|\.|::", name)[-1].encode()
    gets, taken = _gets(operand, view)
    if taken and not gets:
        taker = taken[0][2].decode()
        message = f"`{view.text(node)}`, but `{name}` is taken by `{taker}`; expected `free({name})`"
        yield view.hit("cpp.delete_form", node, message)
    forms = {b"[" in _made(match[2]) for match in gets}
    is_array = has_token(node, "[")
    # Where an argument of a template is an array, `new T` makes one.
    if forms != {not is_array} or (is_array and any(_is_dependent(match, view) for match in gets)):
        return
    made = f"`{view.text(node)}`, but `{name}` is made by `new{'' if is_array else '[]'}`"
    form = "delete" if is_array else "delete[]"
    if _is_void(word, view):
        expected = f"a pointer to the type that was made, and `{form}` of it: `void` does not tell what is freed"
    else:
        expected = f"`{form} {name}`"
    yield view.hit("cpp.delete_form", node, f"{made}; expected {expected}")


def _by_name(pattern: re.Pattern[bytes], view: FileView) -> Mapping[bytes, Sequence[re.Match[bytes]]]:
    """Return where the file takes from the heap by a pattern, by the name that gets it."""
    found = view.kept.get(pattern)
    if found is None:
        taken: dict[bytes, list[re.Match[bytes]]] = {}
        for match in pattern.finditer(view.code):
            taken.setdefault(match[1], []).append(match)
        found = view.kept[pattern] = taken
    return cast("Mapping[bytes, Sequence[re.Match[bytes]]]", found)


def _is_void(name: bytes, view: FileView) -> bool:
    """Return whether a file declares a pointer to void of a name."""
    return name in view.names(_POINTER_TO_VOID)


def _is_dependent(made: re.Match[bytes], view: FileView) -> bool:
    """Return whether the type that ``new`` makes depends on a parameter of a template around it."""
    kind = _made(made[2])
    words = set(re.findall(rb"\w+", kind))
    if b"typename" in words:
        return True
    node = view.node_at(made.end(1), made.end())
    templates = (one for one in all_above(node) if one.type == "template_declaration") if node is not None else ()
    return any(
        not words.isdisjoint(re.findall(rb"\w+", view.code[listed.start_byte : listed.end_byte]))
        for one in templates
        if (listed := one.child_by_field_name("parameters")) is not None
    )


def _is_declared_in(function: Node, name: bytes, view: FileView) -> bool:
    """Return whether a function has a pointer of its own of a name, whatever others do with one of that name."""
    declared = re.compile(rb"\w\s*\*+\s*(?:const\s+)?%s\s*[=;,{(]" % re.escape(name))
    return declared.search(view.code, function.start_byte, function.end_byte) is not None


def _made(text: bytes) -> bytes:
    """Return what stands before the arguments of a constructor."""
    placed = text.lstrip()
    if placed.startswith(b"("):
        placed = placed.partition(b")")[2]
    return re.split(rb"[({]", placed)[0].replace(b"[]>", b"")


RULE = FileRule(
    id="cpp.delete_form",
    title="Memory that is given back in another form than it was taken",
    finds="`delete p` where the file has `p = new T[…]`, or `delete[] p` where it has `p = new T`, "
    "either of them where it has `p = malloc(…)`, and `free(p)` where it has `p = new T`. Use the form "
    "that belongs to it, or `std::vector`. A `new T` whose type is a parameter of a template is left out: with an "
    "array for `T` it makes one.",
    why="The heap is damaged; the node ends somewhere else, long after.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "hicpp 5.3.3",
        "autosar-cpp14 A18-5-3",
        "clang-tidy clang-analyzer-unix.MismatchedDeallocator",
    ),
    bad="void f() { char* p = new char[3]; delete p; }\n",
    good="void f() { char* p = new char[3]; delete[] p; }\n",
    syntax="cpp",
    kinds=("delete_expression",),
    anchors=("free",),
    found=found,
)
