"""Rule ``package.list_length``: a list of another length than the program that reads it takes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

import msgspec

from roslens.judge.documents.yaml_tree import Items, Node, Scalar, Table, read_parameter_trees
from roslens.model.errors import DocumentError
from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_ID = "package.list_length"


class _Row(msgspec.Struct, frozen=True):
    """What is known of a list.

    Attributes:
        key: of the list.
        beside: a key of the same table, so that it is that program's; ``{0}`` is the first group of ``key``.
        lengths: that are taken.
        effect: of another length.
    """

    key: re.Pattern[str]
    beside: str
    lengths: tuple[int, ...]
    effect: str


_IGNORED = "robot_localization warns and does not use it as it is meant"
_ROWS = (
    _Row(re.compile(r"((?:odom|pose|twist|imu)\d+)_config"), "{0}", (15,), _IGNORED),
    _Row(re.compile("initial_state"), r"(?:odom|pose|twist|imu)0_config", (15,), _IGNORED),
    _Row(
        re.compile("process_noise_covariance|initial_estimate_covariance"),
        "(?:odom|pose|twist|imu)0_config",
        (225, 15),
        "robot_localization ends, or does not use it",
    ),
    _Row(
        re.compile("(?:pose|twist)_covariance_diagonal"),
        "wheel_separation|wheel_radius|wheelbase|front_wheel_radius|left_wheel(?:_names)?|kinematics",
        (6,),
        "the controller reads six values",
    ),
    _Row(
        re.compile("max_velocity|min_velocity|max_accel|max_decel|deadband_velocity"),
        "smoothing_frequency",
        (3, 6),
        "nav2_velocity_smoother takes x, y and theta, and refuses to start",
    ),
)
"""Lists of a fixed length. Sources: ``RosFilter::loadUpdateConfig`` and ``loadParams`` of robot_localization,
``set_odom_publish`` and ``on_configure`` of the odometry of ros_controllers and ros2_controllers,
``VelocitySmoother::on_configure`` of navigation2."""
_HINT = re.compile(rb"_config|_covariance_diagonal|smoothing_frequency|cols")
_MATRIX = ("rows", "cols", "data")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each list of a length that its reader does not take, at its first value."""
    for file in view.of_language(Language.YAML, roles=(Role.OWN,)):
        content = view.read(file.path)
        if _HINT.search(content) is None:
            continue
        try:
            trees = read_parameter_trees(content, file.path)
        except DocumentError:
            continue
        for tree in trees:
            for key, node, message, certainty in _lists(tree.root):
                line = tree.location(node.place).line
                yield Hit(_ID, message, line, context=key, path=file.path, certainty=certainty)


def _lists(root: Node | None) -> Iterator[tuple[str, Items, str, Certainty | None]]:
    waiting = [root]
    while waiting:
        node = waiting.pop()
        match node:
            case Table(nodes=nodes):
                yield from _of_table(nodes)
                waiting.extend(nodes.values())
            case Items(nodes=several):
                waiting.extend(several)


def _of_table(nodes: Mapping[str, Node]) -> Iterator[tuple[str, Items, str, Certainty | None]]:
    for key, node in nodes.items():
        match node:
            case Items(nodes=items) if items and all(isinstance(one, Scalar) for one in items):
                row = next((one for one in _ROWS if _is_meant(one, key, nodes)), None)
                if row is not None and len(items) not in row.lengths:
                    taken = " or ".join(map(str, row.lengths))
                    message = f"{key} has {_counted(len(items))}: {row.effect}; expected {taken}"
                    yield key, node, message, None
    match [nodes.get(one) for one in _MATRIX]:
        case [Scalar(text=rows), Scalar(text=columns), Items(nodes=items) as node]:
            if rows.isdecimal() and columns.isdecimal() and int(rows) * int(columns) != len(items):
                expected = f"{rows} * {columns} = {int(rows) * int(columns)}"
                yield "data", node, f"data of a matrix has {_counted(len(items))}; expected {expected}", None


def _is_meant(row: _Row, key: str, nodes: Mapping[str, Node]) -> bool:
    match = row.key.fullmatch(key)
    if match is None:
        return False
    beside = re.compile(row.beside.format(*map(re.escape, match.groups())))
    return any(beside.fullmatch(one) for one in nodes)


def _counted(count: int) -> str:
    return f"{count} entr{'y' if count == 1 else 'ies'}"


RULE = PackageRule(
    id=_ID,
    title="List of the wrong length",
    finds="A list in a parameter file that has another number of entries than its reader takes: the 15 of each "
    "`odom0_config`, `imu0_config` … of robot_localization and its matrices, the 6 of `pose_covariance_diagonal` and "
    "`twist_covariance_diagonal` of the odometry of wheel controllers, the limits of nav2_velocity_smoother, and "
    "`data` of a matrix with `rows` and `cols`, as in the calibration of a camera.",
    why="The list is ignored with a warning, its reader reads behind its end, or the node does not start.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("configuration", "parameters"),
    bad="twist_covariance_diagonal: [0.001, 0.001, 0.01]",
    good="twist_covariance_diagonal: [0.001, 0.001, 0.001, 0.001, 0.001, 0.01]",
    found=found,
)
