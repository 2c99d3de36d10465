"""Functions that were evaluated, and calls by names of ROS that functions of the workspace answer."""

from __future__ import annotations

from roslens.source.extract.makes_endpoints import MAKE


class Reached(set[tuple[str, int]]):
    """Functions that were evaluated, by file and line.

    Attributes:
        passed_on: places of calls that are named as what makes an endpoint and call a function of the workspace: what
            they make stands there.
    """

    def __init__(self) -> None:
        """Begin with nothing."""
        super().__init__()
        self.passed_on: set[tuple[str, int]] = set()

    def follow(self, function: tuple[str, int], name: str, site: tuple[str, int]) -> None:
        """Add a function by its place and name, and the place of the call that leads to it."""
        self.add(function)
        if name in MAKE:
            self.passed_on.add(site)

    def add_all(self, other: Reached) -> None:
        """Add what another evaluation reached."""
        self |= other
        self.passed_on |= other.passed_on
