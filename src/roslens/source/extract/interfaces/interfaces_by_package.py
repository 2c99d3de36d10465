"""Which interfaces a package has, by the files of the workspace and by what is known of standard packages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from roslens.source.extract.interfaces.standard_interfaces import STANDARD

_OF_ACTION = ("Action", "Goal", "Result", "Feedback", "ActionGoal", "ActionResult", "ActionFeedback")
"""What genaction makes messages of."""


class InterfacesByPackage:
    """The names of interfaces by package and kind."""

    def __init__(self, owners: Mapping[str, str]) -> None:
        """Take the files of the workspace, each with the id of its package."""
        self._names: dict[tuple[str, str], set[str]] = {}
        for path, owner in owners.items():
            stem, _, kind = path.rpartition("/")[2].rpartition(".")
            if kind not in ("msg", "srv", "action"):
                continue
            package = owner.partition("@")[0]
            self._names.setdefault((package, kind), set()).add(stem)
            if kind == "action":
                self._names.setdefault((package, "msg"), set()).update(f"{stem}{end}" for end in _OF_ACTION)

    def of_modules(self, name: str, modules: Sequence[str]) -> str:
        """Return which of several modules of Python that are imported whole has an interface; empty where it is open.

        Args:
            name: of the interface.
            modules: ``package.kind``, in order; what a later one has counts.
        """
        known = [(module, self._of(module)) for module in dict.fromkeys(modules)]
        certain = [module for module, names in known if names is not None and name in names]
        if certain:
            return certain[-1]
        perhaps = [module for module, names in known if names is None]
        return perhaps[0] if len(perhaps) == 1 else ""

    def _of(self, module: str) -> frozenset[str] | set[str] | None:
        package, _, kind = module.rpartition(".")
        found = self._names.get((package, kind))
        return STANDARD.get((package, kind)) if found is None else found
