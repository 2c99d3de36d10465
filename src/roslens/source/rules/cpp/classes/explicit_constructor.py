"""Rule ``cpp.explicit_constructor``: a constructor that is a conversion as well."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import bases_of, class_name, has_token, members_of, parameters_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each constructor of a class that one argument is enough for."""
    name = class_name(node, view)
    for member in members_of(node, view):
        if member.name != name or member.declarator is None or member.is_deleted:
            continue
        if has_token(member.node, "explicit_function_specifier") or member.access == "private":
            continue
        parameters = parameters_of(member.declarator)
        if not parameters or any(one.type == "parameter_declaration" for one in parameters[1:]):
            continue
        kind = parameters[0].child_by_field_name("type")
        text = view.text(kind)
        is_same = text.partition("<")[0].rpartition("::")[2] == name
        if is_same or "initializer_list" in text or parameters[0].type.startswith("variadic"):
            continue
        at = member.declarator.start_byte
        yield view.hit(
            "cpp.explicit_constructor",
            member.declarator,
            f"constructor `{view.short(member.declarator)}` converts; expected `explicit`",
            edits=view.edits((at, at, "explicit ")) if _is_entity(node, view) else (),
        )


def _is_entity(cls: Node, view: FileView) -> bool:
    """Return whether nobody gives something else where an object of a class is expected.

    A class with a base or virtual functions is no value; of one that is, a caller elsewhere may rely on the conversion.
    """
    return bool(bases_of(cls, view)) or any(one.is_virtual for one in members_of(cls, view))


RULE = FileRule(
    id="cpp.explicit_constructor",
    title="Constructor that converts silently",
    finds="A constructor that can be called with one argument and is not `explicit`; copying, moving and "
    "`std::initializer_list` are let be. Add `explicit`.",
    why="A number or a handle that turns into an object by itself hides mistakes in units and ownership: "
    "`move(0.5)` compiles where `move(Meters(0.5))` was meant.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/explicit",
        "hicpp 12.1.1",
        "misra-cpp-2008 12-1-3",
        "misra-cpp-2023 15.1.3",
        "autosar-cpp14 A12-1-4",
        "paper2016 explicit_constructors",
        "clang-tidy google-explicit-constructor",
    ),
    fix="Adds `explicit` where the class has a base or virtual functions. A class that is a value may be made of "
    "something else by a caller in another file, and is left.",
    bad="struct Speed {\n  Speed(double v);\n};\n",
    good="struct Speed {\n  explicit Speed(double v);\n};\n",
    syntax="cpp",
    kinds=("class_specifier", "struct_specifier"),
    found=found,
)
