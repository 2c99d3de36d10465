"""Rule ``package.behavior_tree``: a behaviour tree that BehaviorTree.CPP refuses."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.workspace.elements import Document, Element, read_elements

_ID = "package.behavior_tree"
_TREE = "BehaviorTree"
_DECORATORS = frozenset(
    (
        *(
            "Decorator",
            "Inverter",
            "ForceSuccess",
            "ForceFailure",
            "Repeat",
            "RetryUntilSuccessful",
            "Timeout",
            "Delay",
        ),
        *(
            "KeepRunningUntilFailure",
            "RunOnce",
            "RateController",
            "DistanceController",
            "SpeedController",
            "SingleTrigger",
        ),
    )
)
_CONTROLS = frozenset(
    (
        *("Control", "Sequence", "SequenceStar", "SequenceWithMemory", "ReactiveSequence", "Fallback", "FallbackStar"),
        *("ReactiveFallback", "Parallel", "PipelineSequence", "RecoveryNode", "RoundRobin"),
    )
)
"""Of BehaviorTree.CPP and of Nav2."""
_DEFINED = re.compile(rb"""<BehaviorTree\b[^<>]*\bID\s*=\s*["']([^"']+)["']""")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield what BehaviorTree.CPP refuses of each tree: ``VerifyXML`` and ``loadDocImpl`` of xml_parsing.cpp."""
    contents = [(file.path, view.read(file.path)) for file in view.of_language(Language.XML, roles=(Role.OWN,))]
    trees = [(path, content) for path, content in contents if b"<BehaviorTree" in content]
    beside = {name.decode("utf-8", "replace") for _, content in trees for name in _DEFINED.findall(content)}
    for path, content in trees:
        document = read_elements(content)
        if document.root is not None and document.root.tag == "root" and not document.faults:
            yield from _Trees(path, document, beside).found()


class _Trees:
    def __init__(self, path: str, document: Document, beside: set[str]) -> None:
        self._path = path
        self._document = document
        self._beside = beside

    def found(self) -> Iterator[Hit]:
        root = self._document.root
        if root is None:
            return
        every = root.elements()
        trees = [one for one in every if one.tag == _TREE]
        includes = any(one.tag == "include" for one in every)
        names = [one.attributes.get("ID", "") for one in trees]
        main = root.attributes.get("main_tree_to_execute", "")
        if main and trees and main not in names and not includes:
            text = f"main_tree_to_execute names tree {main!r}, and this file has {', '.join(map(repr, names))}"
            yield self._hit(root, f"{text}; expected one of them", main)
        for name in sorted({one for one in names if one and names.count(one) > 1}):
            again = [one for one in trees if one.attributes.get("ID", "") == name][1]
            yield self._hit(again, f"tree {name!r} again; expected each name once", name, Certainty.LIKELY)
        for tree in trees:
            if len(tree.elements()) != 1:
                text = (
                    f"tree {tree.attributes.get('ID', '')!r} has {len(tree.elements())} children; expected exactly one"
                )
                yield self._hit(tree, text, tree.attributes.get("ID", ""))
            yield from self._nodes(tree, includes=includes)

    def _nodes(self, tree: Element, *, includes: bool) -> Iterator[Hit]:
        waiting = list(reversed(tree.elements()))
        while waiting:
            one = waiting.pop()
            waiting += reversed(one.elements())
            count = len(one.elements())
            name = one.attributes.get("ID", "")
            if one.tag in ("SubTree", "SubTreePlus") and name and name not in self._beside and not includes:
                # Programs may load trees of other packages beside this file; a name that is nearly one here is none.
                for near in get_close_matches(name, sorted(self._beside), 1, 0.92):
                    text = f"<{one.tag}> names tree {name!r}, which no file of this package has; expected {near!r}"
                    yield self._hit(one, text, name, Certainty.LIKELY)
            if one.tag in _DECORATORS and count != 1:
                yield self._hit(
                    one, f"<{one.tag}> has {count} children; expected exactly one", one.tag, Certainty.LIKELY
                )
            if one.tag in _CONTROLS and not count:
                yield self._hit(one, f"<{one.tag}> has no child; expected at least one", one.tag, Certainty.LIKELY)

    def _hit(self, element: Element, message: str, context: str, certainty: Certainty | None = None) -> Hit:
        line, column = self._document.place(element.start)
        return Hit(_ID, message, line, column, context=context, path=self._path, certainty=certainty)


RULE = PackageRule(
    id=_ID,
    title="Behaviour tree that is refused",
    finds="A file with `<BehaviorTree>` in which `main_tree_to_execute` names a tree that is not there, or a "
    "`<SubTree>` one that is there under nearly this name, a tree that is there twice or has not exactly one child, a "
    "decorator with none or several children, a control node with none. Files that include others are not asked for "
    "trees.",
    why="BehaviorTree.CPP refuses the file when it is loaded: the navigator of Nav2 does not configure, or the goal "
    "is aborted.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("configuration", "navigation"),
    bad='<root main_tree_to_execute="Main">\n'
    '  <BehaviorTree ID="Drive">\n    <AlwaysSuccess/>\n  </BehaviorTree>\n</root>',
    good='<root main_tree_to_execute="Drive">\n'
    '  <BehaviorTree ID="Drive">\n    <AlwaysSuccess/>\n  </BehaviorTree>\n</root>',
    found=found,
)
