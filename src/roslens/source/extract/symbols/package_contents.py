"""What the files of a package have in common: what they include, what they vote for, which messages they adapt."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property

from roslens.source.extract.ir.program import Call, Evaluate, Name, Program

_CUSTOM = Name("RCLCPP_USING_CUSTOM_TYPE_AS_ROS_MESSAGE_TYPE")


class PackageContents:
    """Programs by their packages."""

    def __init__(self, programs: Mapping[str, Program], packages: Mapping[str, str]) -> None:
        """Ask about programs by path; what has no package is in that of its first folder."""
        self._programs, self._packages = programs, packages
        self._votes: dict[str, int] = {}
        self._included: dict[str, set[str]] = {}

    def package_of(self, path: str) -> str:
        """Return the package that a file belongs to."""
        return self._packages.get(path) or path.partition("/")[0]

    @cached_property
    def headers(self) -> frozenset[str]:
        """All that is included anywhere, without brackets."""
        return frozenset(name.strip('<>"') for one in self._programs.values() for name, _line in one.includes)

    def votes(self, path: str, vote: Callable[[Program], int]) -> int:
        """Return what the files of a package vote for together, those of the workspace where they are undecided."""
        if not self._votes:
            for other, program in self._programs.items():
                vote_ = vote(program)
                for name in (self.package_of(other), ""):
                    self._votes[name] = self._votes.get(name, 0) + vote_
        return self._votes.get(self.package_of(path), 0) or self._votes.get("", 0)

    def includes(self, header: str, path: str) -> bool:
        """Return whether any file of the package of a file includes a header."""
        package = self.package_of(path)
        if package not in self._included:
            self._included[package] = {
                name.strip('<>"')
                for other, program in self._programs.items()
                if self.package_of(other) == package
                for name, _ in program.includes
            }
        return header in self._included[package]

    @cached_property
    def adapted(self) -> Mapping[str, str]:
        """The messages that classes are registered to stand for."""
        found: dict[str, str] = {}
        for program in self._programs.values():
            for one in program.body:
                match one:
                    case Evaluate(expression=Call() as call) if call.function == _CUSTOM and len(call.arguments) == 2:
                        custom, message = (getattr(two, "name", "") for two in call.arguments)
                        found[custom] = message.replace(".", "::")
        return found
