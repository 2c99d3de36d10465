"""Rule ``launch.unset_configuration``: a launch configuration is used that nothing declares or sets."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.facts.launched import Fault
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_outcome import Outcome
from roslens.source.workspace.command_texts import command_texts

_PARTS = re.compile(r"(?:^|/)(?:include|includes|common|components?|modules?|utils?)(?:/|$)|\.include\.", re.IGNORECASE)
"""In paths of launch files that are there to be included."""
_DECLARED = re.compile(
    r"DeclareLaunchArgument\(\s*(?:name\s*=\s*)?['\"]([\w./-]+)|<(?:arg|let)\s[^>]*name=['\"]([\w./-]+)"
)


_MOST_NAMES = 4
"""Of one message."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each first use of launch configurations that are set nowhere before it, those of one call together."""
    told: set[tuple[str, str]] = set()
    together: dict[tuple[object, ...], list[Outcome]] = {}
    for one in view.outcome.failures:
        failed = one.failed
        if failed.fault is not Fault.NOT_SET or one.is_included or failed.evidence.path not in view.by_path:
            continue
        if (failed.evidence.path, failed.text) not in told:
            told.add((failed.evidence.path, failed.text))
            cause = (failed.evidence, one.source.path, _where(one), _certainty(one, view))
            together.setdefault(cause, []).append(one)
    for several in together.values():
        yield _hit(several, view)


def _where(one: Outcome) -> str:
    """Return where the file that is started declares a name, if it does."""
    if one.failed.text in one.declared:
        return "; declared further down, and launch goes from the first action to the last"
    if one.failed.text in _written(one):
        return f"; {one.source.path} has a declaration, but generate_launch_description does not return it"
    return ""


def _written(one: Outcome) -> set[str]:
    text = one.source.content.decode("utf-8", "replace")
    return {name for pair in _DECLARED.findall(text) for name in pair if name}


def _hit(several: list[Outcome], view: PackageView) -> Hit:
    one, *others = several
    failed = one.failed
    near = get_close_matches(failed.text, _written(one), 1, 0.75) if not others else []
    advice = _where(one) or (f"; did you mean {near[0]!r}?" if near else "")
    started = "" if failed.evidence.path == one.source.path else f" when {one.source.path} is started"
    names = [repr(each.failed.text) for each in several]
    listed = ", ".join(names[:_MOST_NAMES]) + f" and {len(names) - _MOST_NAMES} more" * (len(names) > _MOST_NAMES)
    if others:
        message = (
            f"launch configurations {listed} are used and nothing declares or sets them before{started}; expected "
            f"arguments or values of these names{advice}"
        )
    else:
        message = (
            f"launch configuration {listed} is used and nothing declares or sets it before{started}; expected "
            f"an argument or value of that name{advice}"
        )
    return Hit(
        "launch.unset_configuration",
        message,
        failed.evidence.line,
        failed.evidence.column,
        context=failed.text,
        path=failed.evidence.path,
        certainty=_certainty(one, view),
    )


def _certainty(one: Outcome, view: PackageView) -> Certainty | None:
    if _PARTS.search(one.source.path) or _is_given(one.failed.text, view):
        return Certainty.HEURISTIC
    # What is declared and not returned may be for files that take parts of this one.
    is_part = one.failed.text not in one.declared and one.failed.text in _written(one)
    return Certainty.LIKELY if one.failed.open or is_part else None


def _is_given(name: str, view: PackageView) -> bool:
    """Return whether a script or text gives an argument by that name on a command line."""
    inside = (view.path(one) for one in view.listing)
    given = re.compile(rb"[\s\"'`]%s:=" % re.escape(name.encode()))
    return any(given.search(view.read(path)) for path in command_texts(view.root, view.folder, inside))


RULE = PackageRule(
    id="launch.unset_configuration",
    title="Launch configuration that nothing sets",
    finds="`LaunchConfiguration('name')` or `$(var name)` in a launch file of ROS 2 where, if the file is started, no "
    "argument of that name is declared and nothing sets it before. A default of the substitution is one. Files that "
    "other launch files name are judged with these. It is a warning where a condition decides whether it is reached, "
    "or the file declares it in what it does not return, and a note in folders of files that are there to be included, "
    "and where a script or README gives it by `name:=`. Behind an include of a file that is not in the workspace "
    "nothing is reported.",
    why='launch ends with "launch configuration does not exist": nothing starts, or not on the day that the branch is '
    "taken.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    bad='<launch>\n  <arg name="robot_ns" default="rover"/>\n  <node pkg="base" exec="drive" '
    'namespace="$(var robot_namespace)"/>\n</launch>',
    good='<launch>\n  <arg name="robot_namespace" default="rover"/>\n  <node pkg="base" exec="drive" '
    'namespace="$(var robot_namespace)"/>\n</launch>',
    found=found,
)
