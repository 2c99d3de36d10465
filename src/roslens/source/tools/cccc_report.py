"""The results of cccc for one file, read from the XML files that it writes.

``cccc.xml`` holds the sums of the file. Beside it stands one file for each *module*: a class, a namespace or a
type that the source defines or only mentions; ``anonymous.xml`` has the functions outside classes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.intake.bounded_file import MOST_DOCUMENT_BYTES, read_bounded

if TYPE_CHECKING:
    from lxml.etree import _Element

_CONTROL = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
SUMMARY = "cccc.xml"


class CcccError(Exception):
    """The report is not there or not what cccc writes."""


class CcccFunction(msgspec.Struct, frozen=True, order=True):
    """A function: the module it is in, its name with parameters, the line of its definition, its complexity."""

    module: str
    name: str
    line: int
    complexity: int


class CcccModule(msgspec.Struct, frozen=True, order=True):
    """A class, a namespace or a type that is mentioned; ``line`` of its definition, 0 without one."""

    name: str
    line: int
    cbo: int
    noc: int
    wmc: int
    dit: int
    mac: int


class CcccFile(msgspec.Struct, frozen=True):
    """Everything that is read of a file, sorted."""

    loc: int
    comment_lines: int
    modules: tuple[CcccModule, ...] = ()
    functions: tuple[CcccFunction, ...] = ()


def read_report(folder: Path) -> CcccFile:
    """Read the folder that cccc wrote about one file.

    Raises:
        CcccError: a file is missing, is no XML, or lacks a value; the message names it.
    """
    if not (folder / SUMMARY).is_file():
        raise CcccError(f"it wrote no {SUMMARY}")
    project = _child(_parsed(folder / SUMMARY), "project_summary", SUMMARY)
    loc = _value(project, "lines_of_code", SUMMARY)
    comment_lines = _value(project, "lines_of_comment", SUMMARY)
    modules: list[CcccModule] = []
    functions: list[CcccFunction] = []
    for path in sorted(folder.glob("*.xml")):
        if path.name != SUMMARY:
            module, members = _module(path)
            modules.append(module)
            functions.extend(members)
    return CcccFile(loc, comment_lines, tuple(sorted(modules)), tuple(sorted(functions)))


def _module(path: Path) -> tuple[CcccModule, list[CcccFunction]]:
    root = _parsed(path)
    summary = _child(root, "module_summary", path.name)
    name = root.findtext("structural_detail/module/name") or path.stem
    module = CcccModule(
        name=name,
        line=_line(root.find("module_detail/source_reference")),
        cbo=_value(summary, "coupling_between_objects", path.name),
        noc=_value(summary, "number_of_children", path.name),
        wmc=_value(summary, "weighted_methods_per_class_unity", path.name),
        dit=_value(summary, "depth_of_inheritance_tree", path.name),
        mac=_value(summary, "weighted_methods_per_class_visibility", path.name),
    )
    return module, list(_functions(root, name, path.name))


def _functions(root: _Element, module: str, file: str) -> Iterator[CcccFunction]:
    for function in root.iterfind("procedural_detail/member_function"):
        complexity = _value(function, "McCabes_cyclomatic_complexity", file)
        if line := _line_of(function):
            yield CcccFunction(module, function.findtext("name") or "", line, complexity)


def _line_of(function: _Element) -> int:
    """Return the line of the definition, else of the first place where cccc saw it; 0 without any."""
    lines = {
        extent.findtext("description"): _line(extent.find("source_reference")) for extent in function.iterfind("extent")
    }
    return lines.get("definition") or next(iter(lines.values()), 0)


def _parsed(path: Path) -> _Element:
    """Parse XML whose texts cccc copied from the source as they were: any encoding, any character."""
    from lxml import etree

    text = _CONTROL.sub("\N{REPLACEMENT CHARACTER}", read_bounded(path, MOST_DOCUMENT_BYTES).decode("utf-8", "replace"))
    parser = etree.XMLParser(resolve_entities=False, no_network=True)
    try:
        return etree.fromstring(text.encode(), parser)
    except etree.XMLSyntaxError as error:
        raise CcccError(f"its {path.name} is not XML: {error}") from None


def _child(element: _Element, tag: str, file: str) -> _Element:
    child = element.find(tag)
    if child is None:
        raise CcccError(f"its {file} has no <{tag}> in <{element.tag}>")
    return child


def _value(element: _Element, tag: str, file: str) -> int:
    text = _child(element, tag, file).get("value", "")
    try:
        return int(text)
    except ValueError:
        raise CcccError(f"its {file} has {text!r} for <{tag}>") from None


def _line(reference: _Element | None) -> int:
    text = reference.get("line", "") if reference is not None else ""
    return int(text) if text.isdecimal() else 0
