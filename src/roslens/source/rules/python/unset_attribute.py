"""Rule ``python.unset_attribute``: an attribute of ``self`` that is read, and that nothing sets."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import is_handled
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_functions import PythonClass, PythonFunctions, python_functions
from roslens.source.rules.hit import Hit
from roslens.source.rules.published.python_bases import NODE_ATTRIBUTES, THREAD_ATTRIBUTES
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_BASES: dict[str, frozenset[str]] = {
    "object": frozenset(),
    "Node": NODE_ATTRIBUTES,
    "rclpy.node.Node": NODE_ATTRIBUTES,
    "Thread": THREAD_ATTRIBUTES,
    "threading.Thread": THREAD_ATTRIBUTES,
}
"""By the base as it is written: what it brings."""
_DYNAMIC = re.compile(
    rb"\bsetattr\b|__dict__|__getattr(?:ibute)?__|__slots__|\bvars\(|metaclass\s*=|__metaclass__|\btype\(\s*['\"]|\bexec\("
)
_DEFINED = re.compile(rb"\b(?:def|class|import|as)\s+(\w+)\b")
_INDENTED = re.compile(rb"^[ \t]+(\w+(?:[ \t]*,[ \t]*\w+)*)[ \t]*(?::[^\n=]+)?(?:=(?!=)|$)", re.MULTILINE)
_WORD = re.compile(rb"\w+")
_QUOTED = re.compile(rb"['\"](\w+)['\"]")
_CALLED = re.compile(rb"(?<!class )(?<![\w.])(\w+)\s*\(")
_STORED = "stored attributes"
_PLACES = ("pattern_list", "tuple_pattern", "list_pattern", "list_splat_pattern", "tuple", "list", "expression_list")
_ASSIGNS = ("assignment", "augmented_assignment", "for_statement", "for_in_clause")
_DEEPEST = 8
_ALIKE = 0.75


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first read of each attribute that its class, whose bases are all known, cannot have."""
    functions = python_functions(view)
    if not functions.classes or _DYNAMIC.search(view.content):
        return
    known: dict[str, frozenset[str] | None] = {}
    for (of_class, name), places in _reads(functions, view).items():
        of = functions.classes[of_class]
        if of_class not in known:
            known[of_class] = _known(of, functions, view)
        brought = known[of_class]
        if brought is None or name in brought or name.startswith("__") or _may_be_set(name, view):
            continue
        if not any(is_handled(one) for one in places):
            yield _hit(name, of, places, view)


def _reads(functions: PythonFunctions, view: FileView) -> dict[tuple[str, str], list[Node]]:
    """Return where attributes of ``self`` are read or set, by class and name."""
    found: dict[tuple[str, str], list[Node]] = {}
    for attribute in view.nodes("attribute"):
        of = _class_of_read(attribute, functions)
        if of is not None:
            name = view.text(attribute.child_by_field_name("attribute"))
            found.setdefault((of.name, name), []).append(attribute)
    return found


def _hit(name: str, of: PythonClass, places: list[Node], view: FileView) -> Hit:
    near = _near(name, of)
    # A class of which the file makes no object may be for others to derive from, and these may have what it reads.
    sure = _is_made(of, view) or _plain(near) == _plain(name)
    message = _message(of.name, name, places, near)
    certainty = None if sure else Certainty.HEURISTIC
    return view.hit("python.unset_attribute", places[0], message, certainty=certainty)


def _class_of_read(attribute: Node, functions: PythonFunctions) -> PythonClass | None:
    """Return the class whose ``self`` has an attribute read, of classes whose name stands for one alone."""
    if not functions.is_self(attribute.child_by_field_name("object")):
        return None
    of = functions.class_around(attribute)
    return of if of is not None and functions.classes.get(of.name) is of else None


def _known(of: PythonClass, functions: PythonFunctions, view: FileView, depth: int = 0) -> frozenset[str] | None:
    """Return what the bases of a class bring; None where one is not known."""
    brought: set[str] = set()
    for base in of.bases:
        inherited = functions.classes.get(base)
        if inherited is not None and inherited is not of and depth < _DEEPEST:
            more = _known(inherited, functions, view, depth + 1)
        else:
            more = _BASES.get(base) if inherited is None and _is_imported(base, view) else None
        if more is None:
            return None
        brought |= more
    return frozenset(brought)


def _is_made(of: PythonClass, view: FileView) -> bool:
    """Return whether the file makes an object of a class."""
    return of.name.encode() in view.names(_CALLED)


def _is_imported(base: str, view: FileView) -> bool:
    """Return whether a base is what its name says."""
    if base == "Node":
        return re.search(rb"from\s+rclpy(?:\.node)?\s+import\b[^\n]*\bNode\b", view.code) is not None
    if base == "Thread":
        return re.search(rb"from\s+threading\s+import\b[^\n]*\bThread\b", view.code) is not None
    return True


def _may_be_set(name: str, view: FileView) -> bool:
    """Return whether anything in the file may give an object an attribute of a name, or asks whether it has it."""
    if name in _stored(view):
        return True
    word = name.encode()
    return word in view.names(_DEFINED) or word in _set_in_classes(view) or word in _quoted(view)


def _set_in_classes(view: FileView) -> frozenset[bytes]:
    """Return the names on the left of what stands indented, as attributes of a class do."""
    known = view.kept.get(_INDENTED)
    if not isinstance(known, frozenset):
        found = (name for names in view.names(_INDENTED) for name in _WORD.findall(names))
        known = view.kept[_INDENTED] = frozenset(found)
    return known


def _quoted(view: FileView) -> frozenset[bytes]:
    """Return the words that stand in quotes alone: ``setattr``, ``hasattr`` and tables name attributes so."""
    known = view.kept.get(_QUOTED)
    if not isinstance(known, frozenset):
        known = view.kept[_QUOTED] = frozenset(_QUOTED.findall(view.source))
    return known


def _stored(view: FileView) -> frozenset[str]:
    """Return the attributes that the file sets, of whatever object."""
    known = view.kept.get(_STORED)
    if not isinstance(known, frozenset):
        known = frozenset(
            view.text(one.child_by_field_name("attribute")) for one in view.nodes("attribute") if _is_stored(one)
        )
        view.kept[_STORED] = known
    return known


def _is_stored(attribute: Node) -> bool:
    """Return whether an attribute is the target of an assignment, a loop or a ``with``, or is deleted."""
    node, around = attribute, attribute.parent
    while around is not None and around.type in _PLACES:
        node, around = around, around.parent
    if around is None:
        return False
    if around.type in ("as_pattern_target", "delete_statement"):
        return True
    return around.type in _ASSIGNS and around.child_by_field_name("left") == node


def _message(of: str, name: str, places: list[Node], near: str) -> str:
    more = f", here and {len(places) - 1} times more" if len(places) > 1 else ""
    expected = f"`self.{near}`, or a value" if near else "a value in `__init__`"
    kind = "a method" if _is_called(places[0]) else "an attribute"
    return (
        f"`self.{name}`: nothing gives `{of}` such {kind}, an AttributeError where it is read{more}; "
        f"expected {expected}"
    )


def _near(name: str, of: PythonClass) -> str:
    """Return the method or attribute of a class that has almost a name; empty for none."""
    there = sorted({*of.methods, *of.attributes})
    plain = {_plain(one): one for one in there}
    return plain.get(_plain(name)) or next(iter(get_close_matches(name, there, 1, _ALIKE)), "")


def _plain(name: str) -> str:
    return name.replace("_", "").lower()


def _is_called(attribute: Node) -> bool:
    around = attribute.parent
    return around is not None and around.type == "call" and around.child_by_field_name("function") == attribute


RULE = FileRule(
    id="python.unset_attribute",
    title="Attribute or method that does not exist (Python)",
    finds="`self.name`, read or called where neither the class nor its "
    "bases, all of which are known (of the file, `rclpy.node.Node`, `threading.Thread`), have such a method or "
    "attribute and nothing in the file sets one. Files that use `setattr`, `__dict__` or `__getattr__` are left out, "
    "and so are reads whose AttributeError is caught. It is a note where the file makes no object of the class, unless "
    "the class has a name that is the same but for case and `_`.",
    why="Python raises an AttributeError when the line is reached: with the first key that is pressed, or the first "
    "message that comes.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=(),
    clauses=("pylint E1101",),
    bad="""import rclpy
class Teleop(object):
    def __init__(self):
        self.current_steer_angle_angle = 0.0
    def on_key(self):
        return self.current_steer_angle
Teleop().on_key()
""",
    good="""import rclpy
class Teleop(object):
    def __init__(self):
        self.current_steer_angle = 0.0
    def on_key(self):
        return self.current_steer_angle
Teleop().on_key()
""",
    syntax="python",
    whole=True,
    gathers=("attribute",),
    mentions=ROS_PYTHON,
    found=found,
)
