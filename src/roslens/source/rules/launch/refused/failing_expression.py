"""Rule ``launch.failing_expression``: an expression or condition ends the launch with an error."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.facts.launched import Fault
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_outcome import Outcome

_LONGEST = 100
_USED = re.compile(r"""\barg\(\s*['"](\w+)['"]\s*\)|\$\((?:arg|var)\s+(\w+)\)""")
_EMPTY = re.compile(r"""<arg\s[^>]*\bdefault\s*=\s*(?:""|'')[^>]*>""")
_NAME = re.compile(r"""\bname\s*=\s*["'](\w+)["']""")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each expression and condition that fails with what is known of its parts."""
    for one in view.outcome.failures:
        failed = one.failed
        if failed.fault is Fault.EXPRESSION and failed.evidence.path in view.by_path:
            yield Hit(
                "launch.failing_expression",
                f"{_shown(one)}: {failed.reason}; the launch ends here{_started(one)}",
                failed.evidence.line,
                failed.evidence.column,
                context=failed.text[:_LONGEST],
                path=failed.evidence.path,
                certainty=_certainty(one, view),
            )


def _shown(one: Outcome) -> str:
    text = " ".join(one.failed.text.split())
    return f"`{text}`" if len(text) <= _LONGEST else f"`{text[:_LONGEST].rpartition(' ')[0] or text[:_LONGEST]} …`"


def _started(one: Outcome) -> str:
    where = "" if one.failed.evidence.path == one.source.path else f" when {one.source.path} is started"
    return f"{where} with the defaults of its arguments" if one.by_default else where


def _certainty(one: Outcome, view: PackageView) -> Certainty | None:
    if one.by_default and (one.is_included or _waits_for_a_value(one, view)):
        return Certainty.HEURISTIC
    return Certainty.LIKELY if one.failed.open or one.by_default else None


def _waits_for_a_value(one: Outcome, view: PackageView) -> bool:
    """Return whether an expression uses an argument whose default is an empty text: whoever starts it gives another."""
    used = {name for pair in _USED.findall(one.failed.text) for name in pair if name}
    if not used:
        return False
    text = view.read(one.failed.evidence.path).decode("utf-8", "replace")
    return any(name in used for element in _EMPTY.findall(text) for name in _NAME.findall(element))


RULE = PackageRule(
    id="launch.failing_expression",
    title="Expression or condition that fails",
    finds="`$(eval …)` or `PythonExpression` that Python ends with an error (a name that is not defined, as `true` in "
    "ROS 2, a missing operator or quote), and an `if` or `unless` that is neither true nor false, with what is known "
    "of the arguments. It is a warning where it depends on defaults of arguments, or on a condition whether it is "
    "reached, and a note where other launch files include the file and may give others, or where the "
    "default is an empty text.",
    why="launch and roslaunch end with that error: nothing starts, or not on the day that the branch is taken.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("launch",),
    bad='<launch>\n  <group if="$(eval true and 1)">\n    <node pkg="base" exec="drive"/>\n  </group>\n</launch>',
    good='<launch>\n  <group if="$(eval \'True and 1\')">\n    <node pkg="base" exec="drive"/>\n  </group>\n</launch>',
    found=found,
)
