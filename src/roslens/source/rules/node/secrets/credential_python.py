"""Rule ``node.credential_python``: a password or key in the source, in Python and launch files in it."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.secrets.credential import NAMES, secrets_of
from roslens.source.rules.rule import FileRule


def found(_node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each place of a file that looks like a key, or gives a password a literal value."""
    return secrets_of(view, "node.credential_python")


RULE = FileRule(
    id="node.credential_python",
    title="Password or key in the source (Python)",
    finds="A variable or argument named as a password, secret or key that is given a literal value, or the beginning "
    "of a known "
    "kind of key; in launch files too. Read it from the environment, and change it: it is in the history. A literal "
    "value by itself is a note: it may be what the vendor publishes for every device.",
    why="Every clone and every robot has it, and whoever reads the repository can log in to all of them.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("security",),
    clauses=("cwe 798",),
    bad="client.login(user, password='r0bot-4711')\n",
    good="client.login(user, password=os.environ['ARM_PASSWORD'])\n",
    syntax="python",
    whole=True,
    mentions=NAMES,
    spares_tests=True,
    found=found,
)
