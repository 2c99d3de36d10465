"""The role of a package: driver, library or application, and what it is more precisely; each with its reasons.

The three roles are those of the 2016 study, whose authors gave one to each of 180 packages by hand. Each mark of a
package (role_marks.py) speaks for and against each role with a fixed weight; the largest sum decides. Weights are those
of a multinomial logistic regression over the 180 packages, drawn to what the marks mean (`python benchmarks/roles.py`,
which also says how well it holds for packages of repositories that the weights were not made from).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from pathlib import Path

import msgspec

from roslens.model.entity import EntityKind
from roslens.model.result import PackageResult, PackageSummary
from roslens.source.study.role_graph import Spoken, spoken_by_package
from roslens.source.study.role_marks import RoleFacts, counts_of, has_code, marks_of, parts, words
from roslens.store.read import RunView

ROLES = ("driver", "library", "application")
KINDS = ("description", "interfaces", "bringup", "tooling", "simulation", "metapackage")
_BIAS = "bias"
_TOOLING = frozenset({"rqt", "rviz", "lint", "cmake", "plotter", "viewer", "visualizer", "visualization", "gui", "cli"})
_SIMULATION = frozenset({"gazebo", "gz", "ign", "sim", "simulation", "simulator", "simulations", "webots", "stage"})


class RoleDecision(msgspec.Struct, frozen=True):
    """A role, a kind (one of :data:`KINDS`, or nothing) and why; ``margin`` is how far the next role is behind.

    Reasons come strongest first: for the kind, then marks that speak for the role.
    """

    role: str
    kind: str
    margin: float
    reasons: tuple[str, ...]

    @property
    def shown(self) -> str:
        """The kind where there is one, else the role."""
        return self.kind or self.role


def decide(facts: RoleFacts) -> RoleDecision:
    """Return the role of a package."""
    marks = marks_of(facts)
    sums = scores(marks, weights())
    ordered = sorted(ROLES, key=lambda role: (-sums[role], ROLES.index(role)))
    role = ordered[0]
    speaking = sorted(marks, key=lambda mark: (-_speaks(mark, role), mark))
    kind, why = _kind(facts)
    reasons = tuple(dict.fromkeys(marks[mark] for mark in speaking if _speaks(mark, role) > 0))
    shown = (*((why,) if why else ()), *(reasons or (f"no evidence of another role than {role}",)))
    return RoleDecision(role, kind, round(sums[role] - sums[ordered[1]], 3), shown)


def scores(marks: Mapping[str, str], given: Mapping[str, Mapping[str, float]]) -> dict[str, float]:
    """Return the sum of weights for each role."""
    return {role: sum(given[mark][role] for mark in (*marks, _BIAS)) for role in ROLES}


@lru_cache(maxsize=1)
def weights() -> Mapping[str, Mapping[str, float]]:
    """Return the weight of each mark for each role."""
    path = Path(__file__).with_name("role_weights.json")
    return msgspec.json.decode(path.read_bytes(), type=dict[str, dict[str, float]])


def facts_of(result: PackageResult, spoken: Spoken | None = None) -> RoleFacts:
    """Return what is looked at of an analysed package.

    Args:
        result: of the package; its values and findings are not needed.
        spoken: by its nodes, where that is known.
    """
    nodes = any(one.kind is EntityKind.FUNCTION and one.name.partition("(")[0] == "main" for one in result.entities)
    repository = result.package.repository.rpartition("/")[2]
    return RoleFacts(result.package, result.files, repository, nodes, spoken, result.includes)


class RolesInRuns:
    """Determines the roles of packages of runs; the graphs of a run are read once."""

    def __init__(self) -> None:
        """Know nothing yet."""
        self._spoken: dict[int, tuple[RunView, dict[str, Spoken]]] = {}

    def __call__(self, view: RunView, summary: PackageSummary) -> str:
        """Return the kind or role of a package of a run."""
        found = self.decision(view, summary.id)
        return found.shown if found else ""

    def decision(self, view: RunView, package: str) -> RoleDecision | None:
        """Return the role of a package of a run with its reasons; None where the run has no such package."""
        result = view.outline(package)
        return decide(facts_of(result, self._said(view).get(result.package.name))) if result else None

    def _said(self, view: RunView) -> dict[str, Spoken]:
        # The view is held, so that its number stays its own.
        if id(view) not in self._spoken:
            graphs = (one.configuration for one in view.configurations())
            self._spoken[id(view)] = (view, spoken_by_package(graphs))
        return self._spoken[id(view)][1]


def _speaks(mark: str, role: str) -> float:
    of = weights()[mark]
    return of[role] - sum(of[other] for other in ROLES if other != role) / 2


def _kind(facts: RoleFacts) -> tuple[str, str]:
    checks: tuple[Callable[[RoleFacts], tuple[str, str]], ...] = (_metapackage, _simulation, _without_code, _tooling)
    return next((found for check in checks if (found := check(facts))[0]), ("", ""))


def _metapackage(facts: RoleFacts) -> tuple[str, str]:
    return ("metapackage", "declares that it is a metapackage") if facts.package.metapackage else ("", "")


def _simulation(facts: RoleFacts) -> tuple[str, str]:
    if named := next((one for one in parts(facts.package.name) if one in _SIMULATION), ""):
        return "simulation", f'"{named}" in its name'
    needs = {one.name for one in facts.package.dependencies if one.active and one.kind != "test"}
    if has_code(facts) or not (needed := min(needs & words().simulators, default="")):
        return "", ""
    return "simulation", f'no code, and "{needed}" among its dependencies'


def _without_code(facts: RoleFacts) -> tuple[str, str]:
    if has_code(facts):
        return "", ""
    counts = counts_of(facts)
    last = (parts(facts.package.name) or [""])[-1]
    if counts["interfaces"]:
        return "interfaces", f"{counts['interfaces']} definitions of interfaces and no code"
    if counts["descriptions"] or last in {"description", "urdf", "meshes"}:
        return "description", f"{counts['descriptions']} descriptions of a robot and no code"
    if counts["launches"] or last in {"bringup", "launch", "config"}:
        return "bringup", f"{counts['launches']} launch files and no code"
    return "", ""


def _tooling(facts: RoleFacts) -> tuple[str, str]:
    named = next((one for one in parts(facts.package.name) if one in _TOOLING), "")
    return ("tooling", f'"{named}" in its name') if named else ("", "")
