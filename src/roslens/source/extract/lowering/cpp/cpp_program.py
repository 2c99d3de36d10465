"""A C++ file as a small program: from the tree of the one parse, without another.

Of functions that name no interface of ROS only calls stay that may lead to one, see
:mod:`~roslens.source.extract.lowering.cpp.cpp_slicing`; without any they have no body.
"""

from __future__ import annotations

import msgspec
from tree_sitter import Tree

from roslens.source.extract.ir.program import Program
from roslens.source.extract.ir.ros_switch import VERSIONS, has_switch
from roslens.source.extract.lowering.cpp.cpp_definitions import Definitions
from roslens.source.extract.lowering.cpp.cpp_flags import unsettled
from roslens.source.extract.lowering.cpp.cpp_lowered import Lowered
from roslens.source.extract.lowering.cpp.cpp_macros import registrations
from roslens.source.syntax.cpp_names import text_of
from roslens.source.syntax.cpp_repair import repaired
from roslens.source.syntax.macro.macros import MacroPreset
from roslens.source.syntax.query.cpp_query import fault_nodes, parse_tree

_LONGEST_QUOTE = 60


def lower_cpp(source: bytes, tree: Tree, content: bytes | None = None) -> Program:
    """Return the program of a C or C++ file; never fails, what is not understood is noted in ``incomplete``.

    Args:
        source: the text that was parsed, its macros blanked.
        tree: its tree.
        content: the file as it is, of the same length: macros that register classes are blanked in ``source``.
    """
    whole = _lowered(source, tree, content)
    if not has_switch(source):
        return whole
    variants = {version: _lowered(source, tree, content, version) for version in VERSIONS}
    return whole if variants["ros1"] == variants["ros2"] else msgspec.structs.replace(whole, variants=variants)


def _lowered(source: bytes, tree: Tree, content: bytes | None, version: str = "") -> Program:
    lowered = Lowered(source, version)
    root = tree.root_node
    definitions = Definitions(lowered)
    definitions.add(root.named_children, lowered.body)
    definitions.end()
    if lowered.left_out and lowered.body:
        lowered.body = unsettled(lowered.body, source, lowered.left_out)
    lowered.body += registrations(source if content is None else content, tree)
    if root.has_error:
        for node in fault_nodes(tree):
            text = f"{node.type} is missing" if node.is_missing else _quoted(lowered.text(node))
            lowered.incomplete.add((node.start_point.row + 1, text))
    return lowered.program()


def program_of_cpp(content: bytes, macros: MacroPreset) -> Program:
    """Parse a C or C++ file by itself and return its program; never fails.

    Args:
        content: the bytes of the file.
        macros: what to blank before the parse.
    """
    source = macros.blank(content)
    tree = parse_tree(source)
    if tree.root_node.has_error:
        source, tree = repaired(source, tree, macros)
    return lower_cpp(source, tree, content)


def _quoted(text: bytes) -> str:
    return " ".join(text_of(text[:_LONGEST_QUOTE]).split())
