"""Rule ``package.boilerplate``: a manifest that still says what a template wrote."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.source import Location
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each part of the manifest that begins with ``TODO``, or is what ``catkin_create_pkg`` wrote."""
    package = view.package
    parts = [
        ("description", package.description, package.manifest),
        *(("license", one.name, one.location) for one in package.licenses),
        *(("maintainer", one.email or one.name, one.location) for one in package.maintainers),
    ]
    for part, text, location in parts:
        if _is_of_template(text, package.name):
            yield _hit(part, text, location or package.manifest)


def _is_of_template(text: str, name: str) -> bool:
    squeezed = " ".join(text.split())
    return squeezed.upper().startswith("TODO") or squeezed == f"The {name} package" or squeezed.endswith("@todo.todo")


def _hit(part: str, text: str, location: Location) -> Hit:
    message = f"{part} is {text!r}, as a template wrote it; expected what holds for this package"
    # Nothing is lost by a description that says nothing, and who asks for an address is asked for it once.
    milder = None if part == "license" else Consequence.STYLE
    return Hit(
        "package.boilerplate",
        message,
        location.line,
        location.column,
        context=part,
        path=location.path,
        consequence=milder,
    )


RULE = PackageRule(
    id="package.boilerplate",
    title="Manifest as a template wrote it",
    finds="A description, licence or maintainer in package.xml that still says what `ros2 pkg create` or "
    "`catkin_create_pkg` wrote. Say what holds for this package. A licence is a warning, the others are notes.",
    why="Without a licence the package may not be used, and without a maintainer there is no contact for its faults.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    bad="<license>TODO: License declaration</license>",
    good="<license>Apache-2.0</license>",
    found=found,
)
