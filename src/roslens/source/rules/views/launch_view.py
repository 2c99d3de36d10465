"""Launch files in XML as rules see them: elements with their lines, and what is substituted in them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from roslens.intake.file_budget import file_budget
from roslens.model.source import Language, Role
from roslens.source.rules.hit import Hit
from roslens.source.rules.views.package_files import PackageFiles

if TYPE_CHECKING:
    from roslens.source.workspace.elements import Element

ROS_1_ARGUMENT = re.compile(r"\$\(arg\s+([\w/-]+)\s*\)")
ROS_2_ARGUMENT = re.compile(r"\$\(var\s+['\"]?([\w/-]+)['\"]?\s*\)")


class LaunchXml:
    """A launch file in XML.

    Attributes:
        path: below the workspace.
        text: as it is.
        is_test: it starts tests.
    """

    def __init__(self, package: PackageFiles, path: str, *, is_test: bool) -> None:
        """Read a file; one that is broken has the elements before the fault."""
        from roslens.source.workspace.elements import read_elements

        content = package.read(path)
        self.path = path
        self.is_test = is_test
        self.text = content.decode("utf-8", "replace")
        with file_budget(path, size=len(content)):
            self._document = read_elements(content)

    @property
    def broken(self) -> bool:
        """Whether not all of it could be read."""
        return bool(self._document.faults) or self._document.root is None

    @property
    def root(self) -> Element | None:
        """The outermost element, as far as it could be read."""
        return self._document.root

    @cached_property
    def elements(self) -> tuple[tuple[Element, str], ...]:
        """All elements in order, each with the tag of the one around it."""
        return tuple(self._below())

    def _below(self) -> Iterator[tuple[Element, str]]:
        root = self._document.root
        waiting = [] if root is None else [(root, "")]
        while waiting:
            element, around = waiting.pop()
            yield element, around
            waiting.extend((child, element.tag) for child in reversed(element.elements()))

    @cached_property
    def left_out(self) -> frozenset[int]:
        """Where the elements begin that a condition written out leaves out (`if="0"`), with those inside of them."""
        return frozenset(element.start for element, is_out in self._conditional() if is_out)

    def _conditional(self) -> Iterator[tuple[Element, bool]]:
        waiting = [] if self._document.root is None else [(self._document.root, False)]
        while waiting:
            element, around = waiting.pop()
            is_out = around or _never_is(element)
            yield element, is_out
            waiting.extend((child, is_out) for child in element.elements())

    @cached_property
    def written(self) -> str:
        """All attributes and texts, without comments."""
        parts = [value for element, _ in self.elements for value in (*element.attributes.values(), element.text())]
        return "\n".join(parts)

    def line(self, element: Element) -> int:
        """Return the line of an element."""
        return self._document.place(element.start)[0]

    def hit(self, rule: str, element: Element, message: str, context: str) -> Hit:
        """Return a hit at an element."""
        line, column = self._document.place(element.start)
        return Hit(rule, message, line, column, context=context, path=self.path)


def _never_is(element: Element) -> bool:
    """Whether the condition of an element is written out and false."""
    wanted, refused = (element.attributes.get(one, "").strip().lower() for one in ("if", "unless"))
    return wanted in ("0", "false") or refused in ("1", "true")


def launch_files(package: PackageFiles) -> tuple[LaunchXml, ...]:
    """Return the launch files in XML of a package."""
    files = package.of_language(Language.LAUNCH_XML, roles=(Role.OWN, Role.TEST))
    return tuple(LaunchXml(package, file.path, is_test=file.role is Role.TEST) for file in files)
