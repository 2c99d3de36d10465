"""Descriptions of plug-ins (pluginlib, nodelet, rqt): which class is loaded from which library by which name."""

from __future__ import annotations

import re
from posixpath import basename

import msgspec

from roslens.source.extract.facts.files import joined
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.workspace.elements import Document, Element, read_elements

_VALUE = re.compile(rb"""=\s*(?:"[^"]*"|'[^']*')""")
_DECLARATION = re.compile(rb"\A\s*<\?xml[^>]*\?>")


class PluginClass(msgspec.Struct, frozen=True):
    """A class in a description.

    Attributes:
        name: by which it is loaded.
        type: the class, ``ns::Class`` or ``module.Class``.
        parent: class that it implements.
        library: name of the library without ``lib``; a folder for Python.
        evidence: where the description says so.
    """

    name: str
    type: str
    parent: str
    library: str
    evidence: Evidence


class Described(msgspec.Struct, frozen=True):
    """A description that a manifest exports: the file, and the condition of REP-149 under which it does."""

    path: str
    evidence: Evidence
    condition: str = ""


def read_plugins(content: bytes, path: str) -> tuple[tuple[PluginClass, ...], tuple[Unresolved, ...]]:
    """Return the classes of a description, and what of it could not be read.

    Args:
        content: of the file.
        path: of the file, for evidence.
    """
    document = _document(content)
    classes: list[PluginClass] = []
    failed = [Unresolved(fault.what, _place(document, fault.offset, path), "invalid XML") for fault in document.faults]
    root = document.root
    libraries = [] if root is None else [root] if root.tag == "library" else _below(root, "library")
    for library in libraries:
        name = library_name(library.attributes.get("path", ""))
        for element in _below(library, "class"):
            evidence = _place(document, element.start, path)
            kind = element.attributes.get("type", "")
            loaded = element.attributes.get("name", "") or kind
            if not loaded:
                failed.append(Unresolved("<class>", evidence, 'a class has neither "type" nor "name"'))
                continue
            parent = element.attributes.get("base_class_type", "")
            classes.append(PluginClass(loaded, kind, parent, name, evidence))
    return tuple(classes), tuple(failed)


def _document(content: bytes) -> Document:
    """Return a description; several libraries may stand one after the other without an element around them.

    pluginlib reads them so (class_loader_imp.hpp), although no document of XML may have more than one root; nor does it
    mind a ``<`` in the value of an attribute, such as a base class with parameters.
    """
    document = read_elements(content)
    if document.faults and b"<" in b"".join(_VALUE.findall(content)):
        content = _VALUE.sub(lambda value: value[0].replace(b"<", b"&lt;"), content)
        document = read_elements(content)
    if not document.faults or document.root is None or document.root.tag != "library":
        return document
    # The declaration gives its place to the element, so that what follows keeps its line.
    whole = read_elements(b"<class_libraries>" + _DECLARATION.sub(b"", content, count=1) + b"</class_libraries>")
    return document if whole.faults else whole


def exported_descriptions(content: bytes, path: str) -> tuple[Described, ...]:
    """Return the descriptions of plug-ins that a package.xml exports; ``path`` is that of the manifest."""
    document = read_elements(content)
    found: list[Described] = []
    folder = path.rpartition("/")[0]
    for export in [] if document.root is None else _below(document.root, "export"):
        for element in export.elements():
            plugin = element.attributes.get("plugin")
            if plugin is not None:
                target = joined(folder, plugin.replace("${prefix}", "."))
                evidence = _place(document, element.start, path)
                found.append(Described(target, evidence, element.attributes.get("condition", "")))
    return tuple(found)


def library_name(path: str) -> str:
    """Return the name of a library from its path: ``lib/libfoo`` and ``foo`` are ``foo``."""
    name = basename(path.rstrip("/"))
    name = name.removesuffix(".so")
    return name.removeprefix("lib") if len(name) > len("lib") else name


def _below(element: Element, tag: str) -> list[Element]:
    return [child for child in element.elements() if child.tag == tag]


def _place(document: Document, offset: int, path: str) -> Evidence:
    line, column = document.place(offset)
    return Evidence(path, line, column)
