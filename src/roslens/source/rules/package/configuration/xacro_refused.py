"""Rule ``package.xacro_refused``: a description that xacro ends with an error instead of expanding it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches

import msgspec

from roslens.model.source import Language, Role, SourceFile
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.workspace.elements import Document, Element, read_elements

_ID = "package.xacro_refused"
_BUILT_IN = frozenset({
    "macro", "include", "property", "arg", "if", "unless", "insert_block", "call", "element", "attribute", "once",
    "grep", "block", "interface",
})  # fmt: skip
"""Elements of xacro itself, and of versions of it that are gone."""
_INCLUDE = re.compile(rb"""<(?:xacro:)?include\s[^<>]*?filename\s*=\s*["']([^"']+)["']""")
_PARAMETERS = re.compile(r"^[\w*:=.|^\s/-]*$")
"""Parameters of a macro with defaults that have neither quotes nor expressions."""
_PREFIX = "xacro:"


class _Macro(msgspec.Struct, frozen=True):
    """What a macro takes; the blocks below its calls are not among these."""

    needed: frozenset[str]
    optional: frozenset[str]


def found(view: PackageView) -> Iterator[Hit]:
    """Yield what is wrong in each file of xacro, and in each call of a macro of the package."""
    documents: list[tuple[SourceFile, Document]] = []
    for file in view.of_language(Language.XACRO, Language.URDF, roles=(Role.OWN,)):
        content = view.read(file.path)
        if b"xacro" not in content or not content.strip():
            continue
        document = read_elements(content)
        fault = _fault(content, document)
        if fault is not None:
            line, column = document.place(fault[1])
            yield Hit(_ID, fault[0], line, column, context=fault[0], path=file.path)
        elif document.root is not None:
            documents.append((file, document))
    yield from _in_calls(documents, view)


def _in_calls(documents: Sequence[tuple[SourceFile, Document]], view: PackageView) -> Iterator[Hit]:
    """Yield what is wrong in each call of a macro."""
    macros = _macros(document for _, document in documents)
    if macros is None:
        return
    is_whole = _is_whole(view)
    for file, document in documents:
        for one in _below(document.root):
            message = _of_call(one, macros, is_whole=is_whole)
            if message:
                line, column = document.place(one.start)
                yield Hit(_ID, message, line, column, context=message, path=file.path)


def _fault(content: bytes, document: Document) -> tuple[str, int] | None:
    """Return why a file is no XML with its place; None where it is some."""
    for fault in document.faults:
        if document.root is not None and document.root.tag == "robot" and not _is_template(content):
            return (
                f"{fault.what}: this is not well-formed XML, which xacro refuses; expected {fault.expected}",
                fault.offset,
            )
    used = next((one for one in _below(document.root) if one.tag.startswith(_PREFIX)), None)
    if used is None or b"xmlns:xacro" in content or _is_template(content):
        return None
    what = "the prefix `xacro:` is not declared, which xacro refuses"
    return f'{what}; expected `xmlns:xacro="http://www.ros.org/wiki/xacro"` in <robot>', used.start


def _is_template(content: bytes) -> bool:
    """Return whether another program fills a file in first."""
    return b"{%" in content or b"{{" in content or b"@(" in content or b"<%" in content


def _below(root: Element | None) -> Iterator[Element]:
    waiting = [root] if root is not None else []
    while waiting:
        one = waiting.pop()
        yield one
        waiting.extend(reversed(one.elements()))


def _macros(documents: Iterator[Document]) -> Mapping[str, _Macro | None] | None:
    """Return the macros of the package by name, None for what is not certain; None where a name is computed."""
    found: dict[str, _Macro | None] = {}
    for document in documents:
        for one in _below(document.root):
            if one.tag not in ("macro", f"{_PREFIX}macro"):
                continue
            name = one.attributes.get("name", "").removeprefix(_PREFIX)
            if "$" in name or not name:
                return None
            found[name] = None if name in found else _macro(one.attributes.get("params", ""))
    return found


def _macro(parameters: str) -> _Macro | None:
    if not _PARAMETERS.match(parameters):
        return None
    words = [one for one in parameters.split() if not one.startswith("*")]
    names = [(re.split(r":?=", one)[0], "=" in one) for one in words]
    needed = frozenset(name for name, has_default in names if not has_default)
    return _Macro(needed, frozenset(name for name, has_default in names if has_default))


def _is_whole(view: PackageView) -> bool:
    """Return whether the macros of the package are all that its descriptions can call."""
    names = {one.rpartition("/")[2] for one in view.listing}
    for file in view.of_language(Language.XACRO, Language.URDF):
        for match in _INCLUDE.finditer(view.read(file.path)):
            path = match[1].decode("utf-8", "replace")
            other = re.search(r"\$\(find(?:-pkg-share)?\s+([^)]*)\)|package://([^/]+)/", path)
            package = ((other[1] or other[2]) if other is not None else view.package.name).strip()
            name = path.rpartition("/")[2]
            if package != view.package.name or "$" in name or name not in names:
                return False
    return True


def _of_call(one: Element, macros: Mapping[str, _Macro | None], *, is_whole: bool) -> str:
    """Return what is wrong with a call of a macro; empty where nothing is."""
    name = one.tag.removeprefix(_PREFIX)
    if name == one.tag or name in _BUILT_IN:
        return ""
    if name not in macros:
        near = get_close_matches(name, sorted(macros), 1)
        expected = f"<xacro:{near[0]}>" if near else "a macro of this name, or the file that has it included"
        return (
            f"no file of this package defines a macro `{name}`: xacro ends there; expected {expected}"
            if is_whole
            else ""
        )
    macro = macros[name]
    return _of_arguments(name, one, macro) if macro is not None else ""


def _of_arguments(name: str, one: Element, macro: _Macro) -> str:
    """Return what is wrong with what a macro is given; empty where nothing is."""
    given = one.attributes.keys() - {"xmlns:xacro"}
    missing = sorted(macro.needed - given)
    if missing:
        return f"macro `{name}` is called without `{missing[0]}`, which has no default: xacro ends there; expected it"
    unknown = sorted(given - macro.needed - macro.optional)
    if unknown:
        near = get_close_matches(unknown[0], sorted(macro.needed | macro.optional), 1)
        expected = f"`{near[0]}`" if near else ", ".join(f"`{each}`" for each in sorted(macro.needed | macro.optional))
        return f"macro `{name}` has no parameter `{unknown[0]}`: xacro ends there; expected {expected or 'none'}"
    return ""


RULE = PackageRule(
    id=_ID,
    title="Description that xacro refuses",
    finds="A file of xacro that is no well-formed XML or does not declare the prefix `xacro:`; a call of a macro "
    "without a parameter that has no default, or with one that the macro does not have; and, where a package includes "
    "no files of others, a call of a macro that none of its files defines.",
    why="xacro ends with an error, so that there is no robot description: robot_state_publisher, controllers and the "
    "simulation do not start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("urdf",),
    bad='<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="wheel" params="name y"/>'
    '<xacro:wheel name="left"/></robot>',
    good='<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="wheel" params="name y:=0"/>'
    '<xacro:wheel name="left"/></robot>',
    found=found,
)
