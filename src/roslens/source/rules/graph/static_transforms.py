"""Transforms that command lines of static_transform_publisher say, of both generations."""

from __future__ import annotations

from collections.abc import Iterator
from fnmatch import fnmatchcase
from itertools import pairwise

from roslens.model.configuration import Configuration
from roslens.source.extract.facts.launched import Launch, Launched
from roslens.source.extract.launch.ros2_names import full_name
from roslens.source.extract.parameters.assemble_proof import launch_proof
from roslens.source.extract.symbolic.condition import as_written, clauses_of
from roslens.source.rules.graph.surroundings import Transform

_PROGRAM = "static_transform_publisher"
_NUMBERS = (6, 7)
"""Of the position and the rotation: by three angles, or as a quaternion."""


def static_transforms(configuration: Configuration, launch: Launch) -> Iterator[Transform]:
    """Yield what is published all the time, of command lines that are known as a whole."""
    # One line of a launch file may start several, in a loop or a file that is included twice.
    names: dict[str, list[str]] = {}
    for node in configuration.nodes:
        names.setdefault(node.proof.place, []).append(node.name)
    for launched in launch.nodes:
        if launched.executable.known != _PROGRAM:
            continue
        words = [one.known for one in launched.arguments]
        proof = launch_proof(launched.evidence)
        frames = frames_of([word for word in words if word is not None]) if None not in words else None
        if frames is not None:
            yield Transform(
                _name_of(launched, names.get(proof.place, [])), *frames, proof,
                as_written(launched.conditions), clauses_of(launched.conditions),
            )  # fmt: skip


def _name_of(launched: Launched, there: list[str]) -> str:
    """Return the name of a node: of those that its line starts the one with the name that it is given there."""
    given = full_name(launched).pattern
    return next((one for one in there if fnmatchcase(one, given)), there[0] if there else launched.name.pattern)


def frames_of(words: list[str]) -> tuple[str, str] | None:
    """Return the parent and the child frame of a command line; None where it does not say both.

    ROS 2: ``--frame-id P --child-frame-id C``, or in both generations ``x y z`` with ``yaw pitch roll`` or a
    quaternion, then ``P C`` and in ROS 1 a period.
    """
    flags = dict(pairwise(words))
    if "--frame-id" in flags and "--child-frame-id" in flags:
        return flags["--frame-id"], flags["--child-frame-id"]
    count = next((place for place, word in enumerate(words) if not _is_number(word)), len(words))
    if count not in _NUMBERS or len(words) < count + 2:
        return None
    return words[count], words[count + 1]


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
