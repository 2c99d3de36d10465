"""Native rules on one parsed file: those that some package may want, with one query and a search for each anchor.

Which of them count for the package of the file is asked later: what they find is kept by content.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache, cached_property
from itertools import compress, islice
from operator import attrgetter

import msgspec
from tree_sitter import Language, Node, Query, QueryCursor

from roslens.model.failure import Failure
from roslens.source.rules.code_pattern import WORD_BYTES
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.python.unreadable import without_what_never_runs
from roslens.source.rules.rule import TESTS, TESTS_HINTS, TOOL, FileRule
from roslens.source.rules.switched_off import switched_off
from roslens.source.rules.table import file_rules
from roslens.source.syntax.query.asked_nodes import patterns_of, taken_from

DEEPEST = 60_000
"""A query counts levels in 16 bits and never ends when they run over: it must not look deeper."""

MOST_HITS = 200
"""Of one rule in one file; a file with more is generated, or breaks it on every line."""

_OF_A_TEMPLATE = re.compile(rb"^[ \t]*\{%-? ?\w", re.MULTILINE)
"""A line of Jinja outside of texts: what a template is filled with makes a program of it, here it is none."""


_Concern = tuple[tuple[str, ...], bool]
"""What a rule wants mentioned, and whether it spares tests."""


class Matched(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """What the native rules found in a file, and which of them failed; of its file neither says the name."""

    hits: tuple[Hit, ...] = ()
    failures: tuple[Failure, ...] = ()


class _Plan:
    """The rules of a syntax, and how they are arranged for files of which different things are known."""

    def __init__(self, syntax: str, language: Language, wanted: frozenset[str] | None) -> None:
        self.rules = tuple(rule for rule in file_rules(syntax) if wanted is None or rule.id in wanted)
        self.mentions = {one: tuple(part.encode() for part in one) for one in {rule.mentions for rule in self.rules}}
        self.parts = tuple(sorted({part for parts in self.mentions.values() for part in parts}))
        self.known_concerns: dict[tuple[bool, ...], frozenset[_Concern]] = {}
        self.concerns = {(rule.mentions, rule.spares_tests) for rule in self.rules}
        self.kinds = frozenset(kind for rule in self.rules for kind in (*rule.kinds, *rule.gathers))
        self._arrangements: dict[frozenset[_Concern], _Arrangement] = {}
        self._language = language

    @cached_property
    def query(self) -> Query:
        """Of the types and shapes of nodes that rules ask for."""
        query: Query = Query(self._language, patterns_of(self.kinds))
        return query

    def arranged(self, concerns: frozenset[_Concern]) -> _Arrangement:
        """Return the rules that concern a file; there are few different answers."""
        found = self._arrangements.get(concerns)
        if found is None:
            rules = [one for one in self.rules if (one.mentions, one.spares_tests) in concerns]
            found = self._arrangements[concerns] = _Arrangement(rules)
        return found


class _Arrangement:
    """Rules by what makes them look."""

    def __init__(self, rules: Sequence[FileRule]) -> None:
        self.whole = tuple((rule, frozenset(word.encode() for word in rule.words)) for rule in rules if rule.whole)
        self.anchored = tuple((rule, *_anchor(text)) for rule in rules for text in rule.anchors)
        self.by_word: Mapping[bytes, list[int]] = defaultdict(list)
        for index, (_, _, words) in enumerate(self.anchored):
            self.by_word[min(words, default=b"")].append(index)
        self.anchor_words = frozenset(self.by_word) - {b""}
        self.quoted = tuple((rule, part.encode()) for rule in rules for part in rule.quoted)
        by_kind: dict[str, list[FileRule]] = defaultdict(list)
        for rule in rules:
            for kind in rule.kinds:
                by_kind[kind].append(rule)
        self.by_kind = by_kind


@cache
def _plan(syntax: str, wanted: frozenset[str] | None) -> _Plan:
    if syntax == "cpp":
        import tree_sitter_cpp

        return _Plan(syntax, Language(tree_sitter_cpp.language()), wanted)
    import tree_sitter_python

    return _Plan(syntax, Language(tree_sitter_python.language()), wanted)


def kinds_asked(syntax: str, wanted: frozenset[str] | None = None) -> frozenset[str]:
    """Return the types and shapes of nodes that rules ask for in files of a syntax; ``wanted`` as in ``match_file``."""
    return _plan(syntax, wanted).kinds


def match_file(view: FileView, wanted: frozenset[str] | None = None) -> Matched:
    """Return what native rules find in a file, in order of lines, then of rules.

    A rule that raises is a failure; what the others find stands.

    Args:
        view: the file.
        wanted: ids of the rules that look at it; all for None.
    """
    plan = _plan(view.syntax, wanted)
    if view.syntax == "python" and _OF_A_TEMPLATE.search(view.code):
        return Matched()
    found: list[Hit] = []
    broken: dict[str, Failure] = {}
    asked = _Asked(view, found, broken)
    _find_nodes(plan, view)
    for rule, nodes in _lookouts(plan.arranged(_concerns(plan, view)), view):
        asked.ask(rule, nodes)
    if view.syntax == "cpp" and (off := switched_off(view.code)):
        found = [hit for hit in found if not any(hit.line in lines for lines in off)]
    if view.syntax == "python":
        found = without_what_never_runs(found, view)
    found.sort(key=_order)
    return Matched(tuple(_once(found)), tuple(broken[one] for one in sorted(broken)))


def _once(hits: Iterable[Hit]) -> Iterator[Hit]:
    """Yield sorted hits, each once: two anchors of one rule may lead to one place."""
    alike: list[Hit] = []
    for hit in hits:
        if alike and alike[-1].line != hit.line:
            alike.clear()
        if hit not in alike:
            alike.append(hit)
            yield hit


def _concerns(plan: _Plan, view: FileView) -> frozenset[_Concern]:
    """Return which pairs of what rules want mentioned and whether they spare tests a file satisfies."""
    content = view.content
    is_test = any(hint in content for hint in TESTS_HINTS) and any(one in content for one in TESTS)
    # What many rules ask for is looked for once.
    present = (is_test, *[part in content for part in plan.parts])
    found = plan.known_concerns.get(present)
    if found is None:
        there = frozenset(compress(plan.parts, present[1:]))
        found = plan.known_concerns[present] = frozenset(
            (parts, spares_tests)
            for parts, spares_tests in plan.concerns
            if (not parts or not there.isdisjoint(plan.mentions[parts])) and not (spares_tests and is_test)
        )
    return found


def _lookouts(rules: _Arrangement, view: FileView) -> Iterator[tuple[FileRule, Iterator[Node] | Sequence[Node]]]:
    """Yield the rules that concern a file with the nodes that they look at."""
    known = view.words
    for rule, asked_words in rules.whole:
        if not asked_words or not asked_words.isdisjoint(known):
            yield rule, (view.root,)
    present = (b"", *(known & rules.anchor_words))
    for index in sorted(one for word in present for one in rules.by_word.get(word, ())):
        rule, anchor, words = rules.anchored[index]
        if words <= known and (len(words) == 1 or anchor in view.code):
            yield rule, _anchored(view, anchor)
    for rule, part in rules.quoted:
        if part in view.content:
            yield rule, _quoted(view, part)
    yield from _of_kinds(rules.by_kind, view)


def _of_kinds(by_kind: Mapping[str, Sequence[FileRule]], view: FileView) -> Iterator[tuple[FileRule, Sequence[Node]]]:
    """Yield the rules on kinds of nodes that a file has, with these nodes."""
    for kind, nodes in view.of_kinds.items():
        if not nodes or kind not in by_kind:
            continue
        if len(nodes) > MOST_HITS:
            # A query tells them in no order, and of a rule that finds too much the first are kept.
            nodes = sorted(nodes, key=_START)
        for rule in by_kind[kind]:
            yield rule, nodes


def _find_nodes(plan: _Plan, view: FileView) -> None:
    """Find the nodes of the types and shapes that rules ask for, unless all of them were found with the metrics."""
    if plan.kinds <= view.of_kinds.keys():
        return
    cursor = QueryCursor(plan.query)
    cursor.set_max_start_depth(DEEPEST)
    view.of_kinds = taken_from(cursor.captures(view.root), plan.kinds)


class _Asked:
    """Asks rules about nodes and keeps what they say."""

    def __init__(self, view: FileView, found: list[Hit], broken: dict[str, Failure]) -> None:
        self._view = view
        self._found = found
        self._broken = broken

    def ask(self, rule: FileRule, nodes: Iterator[Node] | Sequence[Node]) -> None:
        """Ask a rule about nodes until it has found :data:`MOST_HITS`."""
        # Most nodes lead to nothing: what is done for each of them is most of what rules cost.
        kept, found, view = self._found, rule.found, self._view
        extend, room = kept.extend, len(kept) + MOST_HITS
        try:
            if rule.found_among is not None:
                among = nodes if isinstance(nodes, Sequence) else list(nodes)
                extend(islice(rule.found_among(among, view), MOST_HITS))
                return
            for node in nodes:
                extend(found(node, view))
                if len(kept) >= room:
                    del kept[room:]
                    return
        except Exception as error:  # noqa: BLE001 - a rule that breaks must not lose what the others find
            self._broken.setdefault(rule.id, _broken(rule, error))


_START = attrgetter("start_byte")


def _anchor(text: str) -> tuple[bytes, frozenset[bytes]]:
    """Return an anchor with the words that a file with it has; where it begins or ends within one, none is known."""
    return text.encode(), frozenset(word.encode() for word in re.findall(r"\w+", text))


def _anchored(view: FileView, anchor: bytes) -> Iterator[Node]:
    """Yield the nodes at which an anchor stands as whole words."""
    code = view.code
    before, after, length = anchor[0] in WORD_BYTES, anchor[-1] in WORD_BYTES, len(anchor)
    node_at = view.root.descendant_for_byte_range
    at = code.find(anchor)
    while at >= 0:
        end = at + length
        if not (
            (before and at and code[at - 1] in WORD_BYTES) or (after and end < len(code) and code[end] in WORD_BYTES)
        ):
            node = node_at(at, end)
            if node is not None:
                yield node
        at = code.find(anchor, end)


def _quoted(view: FileView, part: bytes) -> Iterator[Node]:
    """Yield the nodes of strings in which a text stands."""
    at = view.source.find(part)
    while at >= 0:
        node = view.node_at(at, at + len(part))
        if node is not None and "string" in node.type:
            yield node
        at = view.source.find(part, at + len(part))


def _order(hit: Hit) -> tuple[int, int, str, str]:
    return (hit.line, hit.column, hit.rule, hit.message)


def _broken(rule: FileRule, error: Exception) -> Failure:
    import traceback

    return Failure(
        tool=TOOL,
        what=f"rule {rule.id} failed: {type(error).__name__}: {error}",
        expected="findings of this rule, or none",
        advice="Please report it with the file: this is a bug in roslens",
        detail="".join(traceback.format_exception(error)),
        partial=True,
    )
