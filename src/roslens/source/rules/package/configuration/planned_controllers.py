"""Rule ``package.planned_controllers``: a controller that MoveIt leaves out of those that execute its plans."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from roslens.judge.documents.yaml_tree import Items, Node, Scalar, Table, read_tree
from roslens.model.errors import DocumentError
from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_ID = "package.planned_controllers"
_MANAGER, _NAMES, _LIST = "moveit_simple_controller_manager", "controller_names", "controller_list"
_NEEDED = ("action_ns", "type", "joints")
"""What ``MoveItSimpleControllerManager::initialize`` of MoveIt 2 asks for of each controller that it is named."""
_NEEDED_ROS1 = ("name", "joints")

_Told = tuple[Node, str]


def found(view: PackageView) -> Iterator[Hit]:
    """Yield what is missing of each controller in a file for MoveIt, and names that two of them have."""
    for file in view.of_language(Language.YAML, roles=(Role.OWN,)):
        content = view.read(file.path)
        if _MANAGER.encode() not in content and _LIST.encode() not in content:
            continue
        try:
            tree = read_tree(content, file.path, last_counts=True)
        except DocumentError:
            continue
        for node, message in _in(tree.root):
            place = tree.location(node.place)
            yield Hit(_ID, message, place.line, place.column, context=message, path=file.path)


def _in(root: Node | None) -> Iterator[_Told]:
    waiting = [root]
    while waiting:
        match waiting.pop():
            case Table(nodes=nodes):
                match nodes.get(_MANAGER):
                    case Table(nodes=held):
                        yield from _named(held)
                match nodes.get(_LIST):
                    case Items(nodes=several):
                        yield from _listed(several)
                waiting.extend(nodes.values())


def _named(nodes: Mapping[str, Node]) -> Iterator[_Told]:
    """Yield the controllers of a file for MoveIt 2 that lack something; those that stand nowhere may be elsewhere."""
    match nodes.get(_NAMES):
        case Items(nodes=names):
            pass
        case _:
            return
    for one in names:
        match one, nodes.get(one.text) if isinstance(one, Scalar) else None:
            case Scalar(text=name), Table(nodes=held) as table:
                missing = [key for key in _NEEDED if key not in held]
                if missing:
                    listed = " and ".join(missing)
                    message = (
                        f"controller {name!r} has no {listed}: MoveIt leaves it out; expected {_expected(missing)}"
                    )
                    yield table, message


def _expected(missing: list[str]) -> str:
    if missing == ["action_ns"]:
        return "`action_ns: follow_joint_trajectory`, or the end of the name of its action"
    return f"a value of {' and '.join(missing)}"


def _listed(several: tuple[Node, ...]) -> Iterator[_Told]:
    """Yield the controllers of a list of ROS 1 that lack something, or have the name of one before."""
    entries = [one for one in several if isinstance(one, Table) and ("joints" in one.nodes or "type" in one.nodes)]
    for one in entries:
        for key in _NEEDED_ROS1:
            if key not in one.nodes:
                yield one, f"a controller of the list has no {key}: MoveIt leaves it out; expected one"
    named = [node for one in entries if isinstance(node := one.nodes.get("name"), Scalar)]
    for at, name in enumerate(named):
        if any(name.text == before.text for before in named[:at]):
            what = f"two controllers have the same name {name.text!r}: the last one takes their place"
            yield name, f"{what}; expected a name of its own for each"


RULE = PackageRule(
    id=_ID,
    title="Controller that MoveIt does not use",
    finds="In the file of controllers for MoveIt: one of `controller_names` without `action_ns`, `type` or `joints`; "
    "in a `controller_list` of ROS 1 an entry without `name` or `joints`, and two entries of one name, of which the "
    "last one is kept.",
    why="MoveIt writes one line and goes on without the controller: plans are made, and «Unable to identify any set of "
    "controllers that can actuate the specified joints» ends their execution.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("configuration",),
    bad="moveit_simple_controller_manager:\n  controller_names: [arm]\n  arm:\n    type: FollowJointTrajectory\n"
    "    joints: [shoulder]",
    good="moveit_simple_controller_manager:\n  controller_names: [arm]\n  arm:\n    type: FollowJointTrajectory\n"
    "    action_ns: follow_joint_trajectory\n    joints: [shoulder]",
    found=found,
)
