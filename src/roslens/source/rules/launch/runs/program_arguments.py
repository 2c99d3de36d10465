"""Rule ``launch.program_arguments``: words that a well-known program refuses."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.gazebo_types import refused_pair
from roslens.source.rules.views.launch_places import keyword_place

if TYPE_CHECKING:
    from roslens.source.extract.facts.launched import Launched

_Words = Sequence[str | None]
_NEGATIVE = re.compile(r"-\d|-\.\d")
_SPAWNER_FLAGS = frozenset({
    "-h", "--help", "--load-only", "--inactive", "--unload-on-kill", "--activate-as-group", "--stopped", "-s", "-u",
    "--switch-asap", "--no-switch-asap", "--load_only",
})  # fmt: skip
_SPAWNER_VALUES = frozenset({
    "-c", "--controller-manager", "-p", "--param-file", "-n", "--namespace", "-t", "--controller-type",
    "--controller-manager-timeout", "--switch-timeout", "--service-call-timeout", "--controller-ros-args",
    "--timeout", "--strictness", "--controller",
})  # fmt: skip
"""Options of the spawner, of all distributions from Foxy on, that take one value at least."""
_SPAWN_ENTITY_FLAGS = frozenset({"-h", "--help", "-stdin", "-unpause", "-b", "-package_to_model"})
_SPAWN_ENTITY_VALUES = frozenset({
    "-entity", "-file", "-topic", "-database", "-reference_frame", "-gazebo_namespace", "-robot_namespace", "-timeout",
    "-x", "-y", "-z", "-R", "-P", "-Y", "-spawn_service_timeout", "-wait", "-param",
})  # fmt: skip


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each start of a well-known program whose words are known and refused, once for each place."""
    said: set[tuple[str, int]] = set()
    for run in view.launch_runs:
        if not any(package.encode() in run.content for package, _ in _PROGRAMS):
            continue
        for node in run.launch.nodes:
            at = node.evidence
            check = _PROGRAMS.get((node.package.known or "", node.executable.known or ""))
            if check is None or at.path not in view.by_path or (at.path, at.line) in said:
                continue
            if told := check(_own([one.known for one in node.arguments]), node):
                said.add((at.path, at.line))
                reason, certainty = told
                message = f"{node.executable.known} refuses {reason}"
                line, column = keyword_place(view, at, "arguments")
                yield Hit(
                    "launch.program_arguments", message, line, column, context=reason, path=at.path,
                    certainty=certainty,
                )  # fmt: skip


def _own(words: _Words) -> list[str | None]:
    """Return the words before those for rcl."""
    return list(words[: words.index("--ros-args")] if "--ros-args" in words else words)


_Told = tuple[str, Certainty | None] | None


def _bridge(words: _Words, node: Launched) -> _Told:
    # What a file says is looked at in the file.
    from_file = any(one.name.known == "config_file" for one in node.settings)
    for word in words if not from_file else ():
        if word is not None and (reason := _refused_bridge(word)):
            return reason
    return None


def _refused_bridge(word: str) -> _Told:
    """Return why parameter_bridge of ros_gz_bridge refuses a word, as its ``main`` does."""
    expected = "expected `/topic@ROS_TYPE[GZ_TYPE` (or `]`, `@`), without blanks"
    name, at, types = word.partition("@")
    if not name or not at:
        return f"{word!r}, which has no name before an `@`; {expected}", None
    if word != word.strip() or " " in word:
        return f"{word!r}, which has a blank: the name or type is another one; {expected}", Certainty.LIKELY
    if "/srv/" in types:
        return (
            (f"{word!r}: services go one way; expected `@` between the types", None) if set("[]") & set(types) else None
        )
    match = re.match(r"([^\[\]@]*)([\[\]@])(.*)", types)
    if match is None:
        return f"{word!r}, which has one type only; {expected}", None
    ros, _, gazebo = match.groups()
    if not ros or not gazebo:
        return f"{word!r}, in which a type is missing; {expected}", None
    reason = refused_pair(ros, gazebo.partition("@")[0])
    return (f"{word!r}: {reason}", Certainty.LIKELY) if reason else None


def _spawner(words: _Words, _node: Launched) -> _Told:
    return _of_options(words, _SPAWNER_FLAGS, _SPAWNER_VALUES, needs="the name of a controller")


def _spawn_entity(words: _Words, _node: Launched) -> _Told:
    told = _of_options(words, _SPAWN_ENTITY_FLAGS, _SPAWN_ENTITY_VALUES)
    if told is not None or None in words or {"-h", "--help"} & set(words):
        return told
    if not {"-file", "-topic", "-database", "-stdin", "-param"} & set(words):
        return "these words: nothing says what to spawn; expected -topic, -file or -database", None
    return ("these words: the entity has no name; expected -entity NAME", None) if "-entity" not in words else None


def _of_options(words: _Words, flags: frozenset[str], values: frozenset[str], *, needs: str = "") -> _Told:
    """Return the first word of an option that is none, as argparse does, or what is missing."""
    has_names = False
    given = iter(words)
    for word in given:
        if word is None:
            return None
        if word in values:
            if next(given, "") == "":
                return f"{word!r} without a value; expected one behind it", None
        elif not word.startswith("-") or _NEGATIVE.match(word):
            has_names = True
        elif word not in flags and word.partition("=")[0] not in values:
            return _unknown_option(word, flags | values)
    is_complete = has_names or not needs or bool({"-h", "--help", "--controller"} & set(words))
    return None if is_complete else (f"these words: they lack {needs}", None)


def _unknown_option(word: str, options: frozenset[str]) -> _Told:
    option = word.split(" ", 1)[0]
    if option != word and option in options:
        return f"{word!r}, one word with blanks in it; expected {option!r} and its value as two words", None
    return f"{word!r}; it is no option of it", Certainty.LIKELY


_PROGRAMS: dict[tuple[str, str], Callable[[_Words, Launched], _Told]] = {
    ("ros_gz_bridge", "parameter_bridge"): _bridge,
    ("ros_ign_bridge", "parameter_bridge"): _bridge,
    ("controller_manager", "spawner"): _spawner,
    ("controller_manager", "spawner.py"): _spawner,
    ("gazebo_ros", "spawn_entity.py"): _spawn_entity,
}

RULE = PackageRule(
    id="launch.program_arguments",
    title="Words that a well-known program refuses",
    finds="A launch file of ROS 2 that starts `parameter_bridge` of ros_gz_bridge, `spawner` of controller_manager or "
    "`spawn_entity.py` of gazebo_ros with words that these do not take: a bridge without its two types or with a "
    "message that does not exist, an option that is none, an option and its value in one word, a value or a name that "
    "is missing. Launch files are evaluated with the defaults of their arguments; unknown words are let be.",
    why="The program ends at once, or goes on without what was asked: no controller, no robot in the simulation, no "
    "topic across the bridge.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    bad='<node pkg="ros_gz_bridge" exec="parameter_bridge" args="/clock@rosgraph_msgs/msg/Clock"/>',
    good='<node pkg="ros_gz_bridge" exec="parameter_bridge" args="/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock"/>',
    found=found,
)
