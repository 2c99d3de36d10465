"""Rule ``cmake.warnings_as_errors``: ``-Werror`` for whoever builds the package."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_ERROR = re.compile(r"(?<![\w-])-Werror(?![\w=-])")
_SWITCH = re.compile(r"werror|ci\b|strict|develop|error", re.IGNORECASE)
_COMMANDS = ("add_definitions", "add_compile_options", "set", "target_compile_options", "list", "string")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each command that adds ``-Werror`` without asking anybody."""
    for one in view.cmake.named(*_COMMANDS):
        written = " ".join(argument.written for argument in one.command.arguments)
        if not _ERROR.search(written) or one.for_tests or any(_SWITCH.search(each) for each in one.conditions):
            continue
        message = "-Werror for everybody who builds this; expected it in continuous integration, or behind an option"
        yield one.hit("cmake.warnings_as_errors", message)


RULE = PackageRule(
    id="cmake.warnings_as_errors",
    title="Warnings are errors for everybody",
    finds="`-Werror` among the flags of a package, without an option that turns it off. Pass it where you want it: "
    "`colcon build --cmake-args -DCMAKE_CXX_FLAGS=-Werror`.",
    why="The next compiler, or the next release of a header, warns about something else, and the package no longer "
    "builds on the robot although nothing in it changed.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("build",),
    bad="add_compile_options(-Wall -Wextra -Werror)",
    good="add_compile_options(-Wall -Wextra)",
    found=found,
)
