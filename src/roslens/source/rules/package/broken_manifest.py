"""Rule ``package.broken_manifest``: a manifest that no XML parser reads."""

from __future__ import annotations

from collections.abc import Iterator
from xml.parsers import expat

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the place from which on the manifest cannot be read; a template may still become a manifest."""
    from roslens.source.workspace.elements import read_elements
    from roslens.source.workspace.placeholder import has_placeholder

    path = view.package.manifest.path
    content = view.read(path) if path else b""
    if not content or not _is_refused(content) or has_placeholder(content.decode("utf-8", "replace")):
        return
    document = read_elements(content)
    for fault in document.faults[:1]:
        line, column = document.place(fault.offset)
        message = f"{fault.what}; expected {fault.expected}: no tool builds this package"
        yield Hit("package.broken_manifest", message, line, column, context=fault.what, path=path)


def _is_refused(content: bytes) -> bool:
    """Return whether the parser that ``catkin_pkg`` reads manifests with (expat, by minidom) refuses a document."""
    try:
        expat.ParserCreate(namespace_separator=" ").Parse(content, True)
    except (expat.ExpatError, LookupError, ValueError):
        return True
    return False


RULE = PackageRule(
    id="package.broken_manifest",
    title="Manifest that is no XML",
    finds="A package.xml that is not well-formed: an element that is not closed, a bare `&` or `<`, bytes of another "
    "encoding than the one it declares.",
    why="catkin_pkg, which catkin, colcon, bloom and rosdep read manifests with, refuses the file: the package is "
    "left out of the build, or the build ends.",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    bad="<description>Reads & sends scans</description>",
    good="<description>Reads &amp; sends scans</description>",
    found=found,
)
