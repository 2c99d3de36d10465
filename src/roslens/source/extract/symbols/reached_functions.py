"""Functions that were evaluated, and calls by names of ROS that functions of the workspace answer."""

from __future__ import annotations


class Reached(set[tuple[str, int]]):
    """Functions that were evaluated, by file and line.

    Attributes:
        passed_on: places of calls that are named as what makes an endpoint and call a function of the workspace, and
            whether that was seen to make one.
    """

    def __init__(self) -> None:
        """Begin with nothing."""
        super().__init__()
        self.passed_on: dict[tuple[str, int], bool] = {}

    def pass_on(self, site: tuple[str, int], *, makes: bool) -> None:
        """Note a call that is named as what makes an endpoint and calls a function of the workspace."""
        self.passed_on[site] = makes or self.passed_on.get(site, False)

    def add_all(self, other: Reached) -> None:
        """Add what another evaluation reached."""
        self |= other
        for site, makes in other.passed_on.items():
            self.pass_on(site, makes=makes)
