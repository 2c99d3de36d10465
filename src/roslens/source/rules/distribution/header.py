"""Rule ``distribution.header``: a header that a distribution of ROS renamed or removed."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.distributions.read_changes import Kind, changes_of
from roslens.source.rules.distribution.row_hit import is_chosen, row_message
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield an include of a header of the tables."""
    path = node.child_by_field_name("path")
    if path is None:
        return
    written = view.text(path).strip('<>"')
    changes = changes_of(Kind.HEADER).get(written, ())
    if not changes or is_chosen(node, view):
        return
    start = path.start_byte + 1
    for change in changes:
        edits = view.edits((start, start + len(written), change.instead)) if change.alike else ()
        hit = view.hit("distribution.header", node, row_message(change, written), edits=edits)
        yield msgspec.structs.replace(hit, change=change.key)


RULE = FileRule(
    id="distribution.header",
    title="Header that the distribution renamed or removed",
    finds="An include of a header that a distribution of ROS deprecated or does not have any more, by a dated table. "
    "For which distributions a package is built, `distro` in roslens.toml or `--distro` says; otherwise files of "
    "continuous integration, containers and `.repos` do. What is gone there does not build; what is deprecated there, "
    "or gone in a later distribution where none is known, is a note. An include that the preprocessor chooses is left "
    "out.",
    why="The build ends with «No such file or directory», in that distribution only.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("distribution", "build"),
    fix="Writes the new header where it takes the old one's place as it is, and every distribution that is built for "
    "has it.",
    bad="#include <cv_bridge/cv_bridge.h>\n",
    good="#include <cv_bridge/cv_bridge.hpp>\n",
    syntax="cpp",
    kinds=("preproc_include",),
    found=found,
)
