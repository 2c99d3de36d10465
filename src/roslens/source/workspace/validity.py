"""Requirements of REP-127, REP-140 and REP-149 on a manifest, tag by tag.

The requirements are those that ``catkin_pkg`` enforces, so that what passes here builds, and a dependency without a
name is one more.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from roslens.source.workspace.elements import Element


class Fault(NamedTuple):
    """A mistake in a manifest.

    Attributes:
        kind: one of those below.
        element: that contains it.
        what: what was found (quoted).
        expected: instead.
        advice: what to do.
        other: for a duplicate, the tag of the equivalent element.
    """

    kind: str
    element: Element
    what: str
    expected: str
    advice: str
    other: str = ""


FORMAT, NAMELESS = "format", "nameless"
REQUIRED, NAME, VERSION, EMAIL, TAG = "required", "name", "version", "email", "tag"
DEPENDENCY, ON_ITSELF, DOUBLED = "dependency", "on itself", "doubled"

LOSING = frozenset({FORMAT, NAMELESS})
"""Kinds of faults because of which not all of a manifest was understood; the others are mistakes in its content."""

CONSTRAINTS = ("version_lt", "version_lte", "version_eq", "version_gte", "version_gt")

_FORMAT_1 = ("build_depend", "buildtool_depend", "run_depend", "test_depend", "conflict", "replace")
_FORMAT_2 = (
    "build_depend",
    "build_export_depend",
    "buildtool_depend",
    "buildtool_export_depend",
    "conflict",
    "depend",
    "doc_depend",
    "exec_depend",
    "replace",
    "test_depend",
)

DEPENDENCY_TAGS = frozenset((*_FORMAT_1, *_FORMAT_2, "group_depend"))

_MAXIMUM_EMAIL = 320  # RFC 3696: 64 + 1 + 255
_EMAIL = re.compile(r"[-a-zA-Z0-9_%+]+(\.[-a-zA-Z0-9_%+]+)*@[-a-zA-Z0-9%]+(\.[-a-zA-Z0-9%]+)*\.[a-zA-Z]{2,}$", re.ASCII)
_NAME = re.compile(r"[a-zA-Z0-9][a-zA-Z0-9_-]*$", re.ASCII)
_VERSION = re.compile(r"[0-9]+\.[0-9]+\.[0-9]+$", re.ASCII)


def faults_of(root: Element, *, complete: bool = True) -> Iterator[Fault]:
    """Yield what is wrong with a ``<package>`` element, in no particular order.

    Args:
        root: the element.
        complete: false where the rest of the document could not be read, so that a missing tag is no fault.
    """
    form = root.attributes.get("format", "1").strip()
    if form not in ("1", "2", "3"):
        yield Fault(FORMAT, root, f'the format is "{form}"', "1, 2 or 3", 'Write <package format="3">.')
        form = "3"
    parts: dict[str, list[Element]] = {}
    for element in root.elements():
        parts.setdefault(element.tag, []).append(element)
    yield from _required(root, parts, complete=complete)
    yield from _texts(parts)
    yield from _people(parts)
    yield from _tags(root, int(form))
    yield from _relations(root, parts, int(form))


def _required(root: Element, parts: dict[str, list[Element]], *, complete: bool) -> Iterator[Fault]:
    for tag in ("name", "version", "description", "maintainer", "license"):
        if tag not in parts and complete:
            advice = "Add it; the folder names the package until then." if tag == "name" else "Add it."
            yield Fault(
                NAMELESS if tag == "name" else REQUIRED, root, f"the manifest has no <{tag}>", f"<{tag}>", advice
            )
    for tag in ("name", "version", "description", "export"):
        for element in parts.get(tag, [])[1:]:
            yield Fault(REQUIRED, element, f"<{tag}> occurs more than once", f"one <{tag}>", "Remove one of them.")


def _texts(parts: dict[str, list[Element]]) -> Iterator[Fault]:
    for element in parts.get("name", ())[:1]:
        yield from _name_faults(element)
    for element in parts.get("version", ())[:1]:
        yield from _version_faults(element)
    for element in parts.get("description", ())[:1]:
        if not element.markup():
            yield Fault(
                REQUIRED, element, "the description is empty", "a short description of the package", "Write one."
            )
    for element in parts.get("license", ()):
        if not element.text():
            yield Fault(REQUIRED, element, "the licence is empty", "a name like Apache-2.0", "Name the licence.")


def _name_faults(element: Element) -> Iterator[Fault]:
    if not _NAME.match(element.text()):
        expected = "lower-case letters, digits, underscores and dashes, a letter first"
        kind = NAME if element.text() else NAMELESS
        yield Fault(kind, element, f'the name is "{_short(element.text())}"', expected, "Rename the package.")


def _version_faults(element: Element) -> Iterator[Fault]:
    compatibility = element.attributes.get("compatibility")
    for text in (element.text(), *([] if compatibility is None else [compatibility])):
        if not _VERSION.match(text):
            yield Fault(VERSION, element, f'the version is "{_short(text)}"', "three numbers like 1.2.3", "Correct it.")


def _people(parts: dict[str, list[Element]]) -> Iterator[Fault]:
    for element in (*parts.get("maintainer", ()), *parts.get("author", ())):
        email = element.attributes.get("email")
        name = _short(element.text())
        if email and (len(email) > _MAXIMUM_EMAIL or not _EMAIL.match(email)):
            what = f'the e-mail address of "{name}" is "{_short(email)}"'
            yield Fault(EMAIL, element, what, "an address like name@example.org", "Correct it.")
        elif email == "" or (email is None and element.tag == "maintainer"):
            what = f'the {element.tag} "{name}" has no e-mail address'
            yield Fault(EMAIL, element, what, f'<{element.tag} email="name@example.org">', "Add the address.")


def _tags(root: Element, form: int) -> Iterator[Fault]:
    known = _known(form)
    yield from _attributes(root, ("format",))
    for element in root.elements():
        if element.tag not in known:
            expected, advice = _instead(element.tag, form)
            yield Fault(TAG, element, f"<{element.tag}> is not a tag of format {form}", expected, advice)
            continue
        yield from _attributes(element, known[element.tag])
        if element.tag not in ("description", "export"):
            for child in element.elements():
                yield Fault(
                    TAG, child, f"<{child.tag}> is nested in <{element.tag}>", "text only", "Move or remove it."
                )


def _attributes(element: Element, known: tuple[str, ...]) -> Iterator[Fault]:
    for name in element.attributes:
        if name not in known and name != "xmlns" and ":" not in name:
            expected = ", ".join(known) or "no attributes"
            if name == "condition":
                expected = "conditions in manifests of format 3 only"
            yield Fault(TAG, element, f'<{element.tag}> has the attribute "{name}"', expected, "Remove or correct it.")


def _known(form: int) -> dict[str, tuple[str, ...]]:
    """Return the tags of a format with the attributes each may have."""
    constraints = (*CONSTRAINTS, "condition") if form == 3 else CONSTRAINTS
    known: dict[str, tuple[str, ...]] = {
        "name": (),
        "version": ("compatibility",),
        "description": (),
        "maintainer": ("email",),
        "license": ("file",) if form == 3 else (),
        "url": ("type",),
        "author": ("email",),
        "export": (),
    }
    known.update(dict.fromkeys(_FORMAT_1 if form == 1 else _FORMAT_2, constraints))
    if form == 3:
        known["group_depend"] = known["member_of_group"] = ("condition",)
    return known


def _instead(tag: str, form: int) -> tuple[str, str]:
    if tag == "run_depend":
        return "<exec_depend>", "Rename it."
    if tag in ("exec_depend", "depend") and form == 1:
        return "<run_depend> (and <build_depend>)", 'Rename it, or write <package format="3">.'
    if tag in DEPENDENCY_TAGS or tag == "member_of_group":
        return "a tag of that format", 'Write <package format="3">, which has it.'
    return "a tag of REP-149", "Move it below <export> or remove it."


def _relations(root: Element, parts: dict[str, list[Element]], form: int) -> Iterator[Fault]:
    names = {element.text() for element in parts.get("name", ())[:1]}
    groups = {element.text() for element in parts.get("member_of_group", ())}
    for element in root.elements():
        tag = element.tag
        if tag not in DEPENDENCY_TAGS:
            continue
        text = element.text()
        if not text:
            yield Fault(
                DEPENDENCY,
                element,
                f"<{tag}> is empty",
                "the name of a package",
                "Name the package or remove the tag.",
            )
        elif tag == "group_depend":
            if text in groups and form == 3:
                what = f'the package depends on the group "{text}" and is a member of it'
                yield Fault(DEPENDENCY, element, what, "one of them", "Remove <group_depend> or <member_of_group>.")
        elif text in names and tag not in ("conflict", "replace"):
            yield Fault(
                ON_ITSELF,
                element,
                f'the package depends on itself by <{tag}> "{_short(text)}"',
                "another package",
                "Remove it.",
            )
    yield from _redundant(parts, form)


def _redundant(parts: dict[str, list[Element]], form: int) -> Iterator[Fault]:
    """Yield general dependencies that duplicate a specific or an earlier general one."""
    general = "test_depend" if form == 1 else "depend"
    specific = ("build_depend", "run_depend") if form == 1 else ("build_depend", "build_export_depend", "exec_depend")
    if general not in parts:
        return
    named = {_declared(element): tag for tag in specific for element in parts.get(tag, ())}
    for element in parts.get(general, ()):
        if other := named.get(_declared(element)):
            text = _short(element.text())
            what = f'<{general}> "{text}" duplicates <{other}>'
            advice = f"Remove the <{other if form > 1 else general}>."
            yield Fault(DOUBLED, element, what, "each dependency once", advice, other)
        elif form > 1:
            named[_declared(element)] = general


def _declared(element: Element) -> tuple[str | None, ...]:
    return (element.text(), *(element.attributes.get(key) for key in (*CONSTRAINTS, "condition")))


def _short(text: str) -> str:
    return text if len(text) <= 80 else text[:79] + "…"
