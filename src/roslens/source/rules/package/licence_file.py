"""Rule ``package.licence_file``: the file that a licence names is not there."""

from __future__ import annotations

from collections.abc import Iterator
from posixpath import normpath

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.workspace.placeholder import has_placeholder


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each licence whose file does not exist."""
    for one in view.package.licenses:
        where = one.location
        if not one.file or where is None or has_placeholder(one.file):
            continue
        path = normpath(view.path(one.file))
        if not path.startswith("../") and not view.exists(path):
            message = f"licence {one.name!r} is said to be in {one.file!r}, which does not exist"
            yield Hit("package.licence_file", message, where.line, where.column, context=one.file, path=where.path)


RULE = PackageRule(
    id="package.licence_file",
    title="Licence file that does not exist",
    finds="A `<license file=…>` whose file is not there, seen from the folder of package.xml.",
    why="Tools that release and ship software copy the text of the licence from there (REP-149), and end without it.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest",),
    bad='<license file="LICENCE.txt">BSD-3-Clause</license>',
    good='<license file="LICENSE">BSD-3-Clause</license>',
    found=found,
)
