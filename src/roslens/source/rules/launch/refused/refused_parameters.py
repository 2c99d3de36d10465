"""Rule ``launch.refused_parameters``: a file of parameters that rcl refuses."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.facts.refusal import Refusal
from roslens.source.extract.parameters.rcl_refusal import judged
from roslens.source.extract.parameters.rcl_refusal import refusal as refused
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_sources import is_template, refusal_hit

_ID = "launch.refused_parameters"
_KEY = re.compile(rb"""^[^#\n]*\bros__parameters['"]?[ \t]*:""", re.MULTILINE)
_YAML = (".yaml", ".yml")
_LOADED = re.compile(rb"\bRewrittenYaml\b|\bReplaceString\b|\byaml\.(?:safe_)?load\b|\bload_yaml\b|YAML::LoadFile")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first fault of each file of parameters for ROS 2."""
    for file in view.of_language(Language.YAML, roles=(Role.OWN,)):
        content = view.read(file.path)
        if _KEY.search(content):
            refusal, reason = judged(content)
            if reason:
                message = f"{reason}: whether rcl takes the file is not judged; expected fewer in one file"
                yield Hit(_ID, message, 1, 1, path=file.path, certainty=Certainty.HEURISTIC)
            if refusal is not None and not is_template(content):
                certainty = Certainty.HEURISTIC if refusal.taken_elsewhere and _is_loaded(view) else None
                yield refusal_hit(_ID, file.path, refusal, _message(refusal), certainty)
    yield from _of_given(view)


def _of_given(view: PackageView) -> Iterator[Hit]:
    """Yield the first fault of each file that a node is given as it is and that has no ``ros__parameters``."""
    told: set[str] = set()
    for use in view.outcome.raw_files:
        if use.path in told or use.path not in view.by_path or view.by_path[use.path].role is not Role.OWN:
            continue
        told.add(use.path)
        content = view.read(use.path)
        refusal = None if _KEY.search(content) or not use.path.endswith(_YAML) else refused(content)
        if refusal is not None and not is_template(content):
            message = f"{_message(refusal)} ({use.evidence.path}:{use.evidence.line} gives the file to a node)"
            yield refusal_hit(_ID, use.path, refusal, message)


def _is_loaded(view: PackageView) -> bool:
    """Return whether something in the package reads YAML itself, and passes on what rcl would not take."""
    sources = view.of_language(Language.PYTHON, Language.LAUNCH_PYTHON, Language.CPP)
    return any(_LOADED.search(view.read(one.path)) for one in sources)


def _message(refusal: Refusal) -> str:
    return f"{refusal.what}: rcl refuses the whole file, and the node does not start; expected {refusal.expected}"


RULE = PackageRule(
    id="launch.refused_parameters",
    title="File of parameters that rcl refuses",
    finds="A YAML file with `ros__parameters`, or that a launch file gives to a node as it is, that "
    "`rcl_yaml_param_parser` does not take: no YAML, a value outside of `ros__parameters`, a key without a value, a "
    "list of values of different types or of lists, an alias, a wrong name of a node. It is a note where PyYAML takes "
    "it and the package reads YAML itself, as `RewrittenYaml` does. Templates and tests are left out, and what is "
    "nested too deeply or too large to be "
    "followed is a note.",
    why="The node that is given the file ends with an exception before it does anything.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch", "parameters"),
    bad="drive:\n  ros__parameters:\n    gains: [1, 0.5]",
    good="drive:\n  ros__parameters:\n    gains: [1.0, 0.5]",
    found=found,
)
