"""Reads reference documents: what is expected of a live system, in YAML, with what they include."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from roslens.intake.is_there import is_file
from roslens.judge.documents.document import Section, parse_document, read_document
from roslens.judge.patterns.pattern import REGULAR_EXPRESSION, Pattern
from roslens.judge.reading.read_common_keys import constraint_id, read_defaults, reading, slug, visible
from roslens.judge.reading.read_constraints import read_constraints
from roslens.judge.reading.read_reactions import read_reactions
from roslens.judge.reference.expectation import Reference
from roslens.judge.reference.merge_references import merge_references
from roslens.judge.reference.name_scope import join, put_under
from roslens.judge.reference.reference_document import Declared, Defaults, ReferenceDocument, Scope
from roslens.judge.reference.reference_keys import DEFAULT_KEYS, DOCUMENT_KIND, REFERENCE_KEYS
from roslens.model.errors import DocumentError
from roslens.model.quantity import Quantity

_NAME = re.compile(r"[a-z][a-z0-9_-]*\Z")


class GivenText(msgspec.Struct, frozen=True):
    """A document that is at hand and in no file, such as a parameter.

    ``shown`` is what messages call it; ``folder`` is what its includes are relative to.
    """

    shown: str
    content: bytes
    folder: str = "."


Source = Path | GivenText


def load_reference(
    sources: Iterable[Source], known: Mapping[str, Quantity], touched: set[Path] | None = None
) -> Reference:
    """Return what documents expect together.

    What is included comes first, then the document that includes it, then the next one given.

    Args:
        sources: files, or texts at hand.
        known: the signals, by key.
        touched: takes every file that is read, and those that were looked for and are not there.

    Raises:
        DocumentError: a document is wrong, or two contradict each other.
    """
    merged = merge_references(read_references(sources, known, touched))
    if merged.contradictions:
        raise merged.contradictions[0].error()
    return merged.reference


def read_references(
    sources: Iterable[Source], known: Mapping[str, Quantity], touched: set[Path] | None = None
) -> tuple[ReferenceDocument, ...]:
    """Read documents and what they include, in order of precedence; what is included twice is read once.

    ``touched`` takes every file that is read, and those that were looked for and are not there.

    Raises:
        DocumentError: a document is wrong, includes itself, or has the name of another.
    """
    reader = _Reader(known, set() if touched is None else touched)
    for source in sources:
        reader.read(source, "", ())
    return tuple(reader.documents)


class _Reader:
    """Reads each document once for each namespace it is in."""

    def __init__(self, known: Mapping[str, Quantity], touched: set[Path]) -> None:
        self._touched = touched
        self.documents: list[ReferenceDocument] = []
        self._known = known
        self._read: set[tuple[str, str]] = set()
        self._paths: dict[str, str] = {}

    def read(self, source: Source, outer: str, line: Sequence[str]) -> None:
        """Read a document that is included into namespace ``outer`` by those in ``line``."""
        if isinstance(source, Path):
            self._touched.add(source)
            document, folder, path = read_document(source, DOCUMENT_KIND, REFERENCE_KEYS), source.parent, _real(source)
        else:
            document = parse_document(source.content, DOCUMENT_KIND, REFERENCE_KEYS, shown=source.shown)
            folder, path = Path(source.folder), f"text {source.shown}"
        if (path, outer) in self._read:
            return
        self._read.add((path, outer))
        name = self._name(document, path)
        namespace = _namespace(document, outer)
        for text in document.texts("include"):
            included = Path(os.path.normpath(folder / text))
            self._touched.add(included)
            if _real(included) in (*line, path):
                raise document.fault(
                    "include", f"{text!r} includes itself", expected="documents that do not include this"
                )
            if not is_file(included):
                raise document.fault("include", f"no file {text!r}", expected=f"a path relative to {str(folder)!r}")
            self.read(included, namespace, (*line, path))
        scope = Scope(
            document=name,
            known=self._known,
            namespace=namespace,
            prefix=slug(outer) if outer else "",
            defaults=read_defaults(document.section("defaults", "table of defaults", DEFAULT_KEYS), Defaults()),
        )
        title = visible(document, "title", document.text("title", name))
        shown = str(source) if isinstance(source, Path) else source.shown
        own = distinct(read_constraints(document, scope), name)
        self.documents.append(ReferenceDocument(name, title, shown, own, read_reactions(document, scope)))

    def _name(self, document: Section, path: str) -> str:
        if (kind := document.text("kind")) != DOCUMENT_KIND:
            raise document.fault("kind", f"kind is {kind!r}", expected=repr(DOCUMENT_KIND))
        document.text("text", "")
        name = document.text("name")
        if not _NAME.match(name) or len(name) > 60:
            expected = "up to 60 small letters, digits, `-` and `_`, a letter first"
            raise document.fault("name", f"name is {name[:80]!r}", expected=expected)
        other = self._paths.setdefault(name, path)
        if other != path:
            advice = "Rename one: ids begin with the name"
            raise document.fault("name", f"a second document named {name!r}", expected=f"one ({other})", advice=advice)
        return name


def distinct(constraints: Iterable[Declared], document: str) -> tuple[Declared, ...]:
    """Return the constraints of a document with ids of their own.

    Names by default get ``~2``, ``~3``… where they are the same.

    Raises:
        DocumentError: two have the same id that is given.
    """
    seen: dict[tuple[str, str], Declared] = {}
    found = []
    for one in constraints:
        name, number = one.name, 1
        while (name, one.aspect) in seen:
            other = seen[name, one.aspect]
            if one.given:
                raise DocumentError(
                    f"a second constraint with id {one.constraint.details.id!r}",
                    where=one.place,
                    expected=f"one (the first is at {other.place})",
                    advice="Give it another `id`",
                )
            number += 1
            name = f"{one.name}~{number}"
        if number > 1:
            details = msgspec.structs.replace(one.constraint.details, id=constraint_id(document, name, one.aspect))
            constraint = msgspec.structs.replace(one.constraint, details=details)
            one = msgspec.structs.replace(one, name=name, constraint=constraint)
        seen[name, one.aspect] = one
        found.append(one)
    return tuple(found)


def _namespace(document: Section, outer: str) -> str:
    own = document.text("namespace", "")
    if own.startswith(REGULAR_EXPRESSION):
        raise document.fault(
            "namespace", f"namespace is {own[:60]!r}", expected="a name or a pattern such as `/robot*`"
        )
    if own:
        reading(document, "namespace", lambda: Pattern.parse(own))
    namespace = join(outer, own)
    return put_under("", namespace) if namespace else ""


def _real(path: Path) -> str:
    return str(path.resolve())
