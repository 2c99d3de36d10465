"""Rule ``node.parameter_unset``: a parameter that is declared with a type alone, and that nothing sets."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

if TYPE_CHECKING:
    from roslens.source.extract.facts.launched import Launched

_DECLARED = re.compile(rb"\bdeclare_parameter\s*<\s*([\w:<>, ]+?)\s*>\s*\(\s*\"([\w./]+)\"\s*\)", re.DOTALL)
_TYPED = re.compile(
    rb"\bdeclare_parameter\s*\(\s*['\"]([\w./]+)['\"]\s*,\s*(?:rclcpp::(?:ParameterType::)?PARAMETER_\w+"
    rb"|(?:rclpy\.)?(?:parameter\.)?Parameter\.Type\.\w+)\s*\)"
)
_COMMENT = re.compile(rb"//[^\n]*|/\*.*?\*/|^\s*#[^\n]*", re.DOTALL | re.MULTILINE)
_CAUGHT = re.compile(rb"\btry\s*[:{]|\bhas_parameter\b|\bautomatically_declare_parameters_from_overrides\b")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each declaration with a type alone in the source of a program that a launch file starts without a value."""
    for node, path in _started(view):
        content = view.read(path)
        if b"declare_parameter" not in content or _CAUGHT.search(content):
            continue
        given = {one.name.known for one in node.settings}
        text = _COMMENT.sub(lambda match: re.sub(rb"[^\n]", b" ", match[0]), content)
        for parameter, start, ends_at_once in _declarations(text):
            if None not in given and parameter.decode() not in given and (ends_at_once or _is_read(parameter, text)):
                yield _hit(parameter.decode(), (path, text.count(b"\n", 0, start) + 1), node, ends_at_once=ends_at_once)


def _started(view: PackageView) -> Iterator[tuple[Launched, str]]:
    """Yield starts of programs of the package with each of their sources, where all is known of their parameters."""
    sources = _sources(view)
    said: set[str] = set()
    whole = [run.launch for run in view.launch_runs if not run.launch.unresolved]
    for node in (node for launch in whole for node in launch.nodes):
        if node.package.known != view.package.name or node.conditions:
            continue
        for path in sources.get(node.executable.known or "", ()):
            if path in view.by_path and path not in said:
                said.add(path)
                yield node, path


def _sources(view: PackageView) -> dict[str, list[str]]:
    """Return the sources of each program: of an executable, of the library of a component, of an entry point."""
    made = {one.words[0]: one for one in view.cmake.named("add_executable", "add_library") if one.words}
    for one in view.cmake.named("rclcpp_components_register_node"):
        if "EXECUTABLE" in one.words[:-1] and one.words[0] in made:
            made[one.words[one.words.index("EXECUTABLE") + 1]] = made[one.words[0]]
    found = {
        name: [path for word in one.words[1:] if (path := view.cmake.inside(word, one)) is not None]
        for name, one in made.items()
    }
    for program in view.setup.programs:
        module = program.entry.partition(":")[0]
        found.setdefault(program.name, []).append(view.path(f"{module.replace('.', '/')}.py"))
    return found


def _declarations(text: bytes) -> Iterator[tuple[bytes, int, bool]]:
    """Yield names that are declared, where, and whether the declaration itself fails: rclcpp asks for a value there."""
    for match in _DECLARED.finditer(text):
        yield match[2], match.start(), True
    for match in _TYPED.finditer(text):
        yield match[1], match.start(), False


def _is_read(parameter: bytes, text: bytes) -> bool:
    """Return whether a file reads a value that has to be there: `get_parameter` into a variable need not find one."""
    return re.search(rb"\bget_parameter\s*\(\s*['\"]%b['\"]\s*\)" % re.escape(parameter), text) is not None


def _hit(parameter: str, place: tuple[str, int], node: Launched, *, ends_at_once: bool) -> Hit:
    how = "the declaration throws" if ends_at_once else "reading it throws"
    at = node.evidence
    message = (
        f"parameter {parameter!r} is declared with a type alone, and {at.path}:{at.line}, which starts the program, "
        f"does not set it: {how}; expected a default, or a value there"
    )
    return Hit("node.parameter_unset", message, place[1], context=parameter, path=place[0])


RULE = PackageRule(
    id="node.parameter_unset",
    title="Parameter without a value",
    finds="A parameter that is declared with a type and no default (`declare_parameter<double>(name)`, "
    "`declare_parameter(name, PARAMETER_DOUBLE)`, `Parameter.Type.DOUBLE`), and read by `get_parameter(name)` where "
    "the declaration does not read it, in a source of a program that a launch file of the package starts without a "
    "value for it. Files that catch exceptions or ask `has_parameter`, and starts whose parameters are not all known, "
    "are left out.",
    why="Since Humble such a parameter has to be given: the node ends with an exception when it is started.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("parameters",),
    bad='gain_ = declare_parameter<double>("gain");',
    good='gain_ = declare_parameter<double>("gain", 1.0);',
    found=found,
)
