"""Rule ``package.resource_marker``: an ament_python package that the index of packages does not know."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_FILES = ("setup.py", "setup.cfg", "pyproject.toml")
_NAMED = re.compile(rb"resource/([A-Za-z]\w*)")
_INDEX = b"resource_index"


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the setup.py that installs no marker, and the marker that does not exist."""
    if view.package.build_type != "ament_python" or view.setup_call is None:
        return
    texts = {view.path(name): view.read(view.path(name)) for name in _FILES if name in view.listing}
    if any(keyword.arg is None for keyword in view.setup_call.keywords):
        # What `**` hands over may be anything.
        return
    marker = f"resource/{view.package.name}"
    if not any(_INDEX in text for text in texts.values()):
        message = f"no marker for the index of packages is installed; expected data_files with {marker!r}"
        # colcon makes it then, and warns that it will no longer.
        at = view.setup_call.lineno
        path = view.path("setup.py")
        yield Hit("package.resource_marker", message, at, context="data_files", path=path, certainty=Certainty.LIKELY)
        return
    naming = next((path for path, text in texts.items() if b"resource/" in text), None)
    if any(
        view.exists(view.path(f"resource/{name.decode()}")) for text in texts.values() for name in _NAMED.findall(text)
    ):
        # Another name is named and is there, which is another mistake.
        return
    if naming is not None and not view.exists(view.path(marker)):
        message = f"{marker!r} does not exist; expected an empty file of that name"
        line = texts[naming].partition(b"resource/")[0].count(b"\n") + 1
        yield Hit("package.resource_marker", message, line, context=marker, path=naming)


RULE = PackageRule(
    id="package.resource_marker",
    title="Python package that the index of packages does not know",
    finds="An `ament_python` package whose setup.py does not install `resource/PACKAGE` to "
    "`share/ament_index/resource_index/packages` (a warning), or that does not have that file (an error).",
    why="`ros2 run`, launch files and `get_package_share_directory` find packages by this file. Where setup.py does "
    "not install it, colcon makes it by itself, warns at each build, and says that it will do so no longer; "
    "other builds make none, and the package is not found. Where setup.py names a file that is not there, the build "
    "ends.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("python", "install"),
    bad='data_files=[("share/arm_teleop", ["package.xml"])]',
    good='data_files=[\n    ("share/ament_index/resource_index/packages", ["resource/arm_teleop"]),\n    '
    '("share/arm_teleop", ["package.xml"]),\n]',
    found=found,
)
