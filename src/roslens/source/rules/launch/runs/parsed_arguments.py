"""Rule ``launch.parsed_arguments``: a script that ends on the words which a launch file puts on its command line."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from posixpath import basename

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.python_tree import python_tree

_ID = "launch.parsed_arguments"
_READS = re.compile(rb"argv|parse_args")
_TAKES_AWAY = re.compile(rb"myargv|remove_ros_args|parse_known_args|REMAINDER|sys\.argv\s*=|parse_known_intermixed")
_SWALLOWS = re.compile(rb"nargs\s*=\s*['\"][*+]")
"""Arguments without an option that take any number of words, those of roslaunch too."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each call in a script that a launch file starts and that refuses the words for ROS."""
    if len(view.ros) != 1:
        return
    (generation,) = view.ros
    started = dict(_started(view, generation))
    if not started:
        return
    for file in view.of_language(Language.PYTHON, roles=(Role.OWN,)):
        content = view.read(file.path)
        places = [place for program, place in started.items() if _is_program(program, file.path, view)]
        if places and _READS.search(content) and not _TAKES_AWAY.search(content):
            yield from _refusing(content, file.path, places[0], generation)


def _started(view: PackageView, generation: int) -> Iterator[tuple[str, str]]:
    """Yield the programs of the package that its launch files start, each with the place."""
    name = view.package.name
    if generation == 1:
        elements = ((file, one) for file in view.launch for one, _ in file.elements if one.tag == "node")
        for file, element in elements:
            if element.attributes.get("pkg") == name:
                yield element.attributes.get("type", ""), f"{file.path}:{file.line(element)}"
    for node in (node for run in view.launch_runs for node in run.launch.nodes):
        if node.package.known == name and node.executable.known:
            yield node.executable.known, f"{node.evidence.path}:{node.evidence.line}"


def _is_program(program: str, path: str, view: PackageView) -> bool:
    """Return whether a file is what is run under the name of a program."""
    if basename(path) == program or (basename(path) == f"{program}.py" and not view.setup.programs):
        return True
    entries = (one.entry.partition(":")[0] for one in view.setup.programs if one.name == program)
    return any(path.endswith(f"{entry.replace('.', '/')}.py") for entry in entries)


def _refusing(content: bytes, path: str, place: str, generation: int) -> Iterator[Hit]:
    tree = python_tree(content)
    if tree is None:
        return
    names = {one.name for node in ast.walk(tree) if isinstance(node, ast.Import) for one in node.names}
    names |= {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module}
    added = "__name:= and __log:=" if generation == 1 else "--ros-args"
    expected = "rospy.myargv()[1:]" if generation == 1 else "rclpy.utilities.remove_ros_args()[1:]"
    for node in (one for one in ast.walk(tree) if isinstance(one, ast.expr)):
        if _is_parsing(node, names, content, generation):
            message = (
                f"parse_args() ends the program: {place} starts it, which adds {added} to its words; expected "
                f"parse_args({expected}) or parse_known_args()"
            )
            yield Hit(_ID, message, node.lineno, node.col_offset + 1, context="parse_args", path=path)
        elif generation == 1 and _is_counting(node):
            message = (
                f"{ast.unparse(node)}: {place} starts the program, which adds {added} to sys.argv; expected "
                "rospy.myargv()"
            )
            yield Hit(
                _ID,
                message,
                node.lineno,
                node.col_offset + 1,
                context="sys.argv",
                path=path,
                certainty=Certainty.LIKELY,
            )


def _is_parsing(node: ast.AST, names: set[str], content: bytes, generation: int) -> bool:
    """Return whether a call reads all words of the command line and ends the program on those that it does not know."""
    match node:
        case ast.Call(func=ast.Attribute(attr="parse_args"), args=given, keywords=[]) if len(given) < 2:
            # optparse takes words without a dash for what they are.
            refuses = "argparse" in names and not (generation == 1 and _SWALLOWS.search(content))
            refuses = refuses or ("optparse" in names and generation == 2)
            return refuses and (not given or ast.unparse(given[0]) in ("sys.argv", "sys.argv[1:]"))
    return False


def _is_counting(node: ast.AST) -> bool:
    """Return whether the number of words is compared with one that it has to be."""
    match node:
        case ast.Compare(left=ast.Call(func=ast.Name(id="len"), args=[given]), ops=[ast.NotEq()]):
            return ast.unparse(given) in ("sys.argv", "sys.argv[1:]", "argv")
    return False


RULE = PackageRule(
    id=_ID,
    title="Script that ends on the words of the launch file",
    finds="A script of the package that a launch file starts and that reads its command line with `argparse` (in ROS 2 "
    "also with `optparse`) as a whole: `parse_args()`, `parse_args(sys.argv[1:])`; in ROS 1 also one that compares the "
    "number of words with `!=`. roslaunch adds `__name:=` and `__log:=`, launch of ROS 2 adds `--ros-args`.",
    why="The script prints its usage and ends: started by hand it runs, started by the launch file it does not.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("launch", "python"),
    bad="options = parser.parse_args()",
    good="options = parser.parse_args(rclpy.utilities.remove_ros_args()[1:])",
    found=found,
)
