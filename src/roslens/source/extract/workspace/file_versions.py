"""For which version of ROS each file is, where a workspace has code for both: by the interface of ROS that it uses.

What does not say so itself is for the version of what it includes, else for that whose targets it is a part of, whose
name it bears, or for which those files are that include it. What then is of neither belongs to both.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence

from roslens.source.extract.facts.node_facts import Target
from roslens.source.extract.ir.program import Program
from roslens.source.extract.ir.ros_switch import VERSIONS
from roslens.source.extract.symbols.included_files import HEADERS, Needs, included_files, inverted

_ROS1 = re.compile(
    r"(?:ros/\w+\.h|nodelet/.*|actionlib/.*|dynamic_reconfigure/server\.h|tf/(?:transform_|tf)\w+\.h"
    r"|(?:\w+_msgs|std_srvs)/[A-Z]\w*\.h|rospy(?:\..*)?)$"
)
_ROS2 = re.compile(r"(?:rclcpp\w*/.*|rcl/.*|rmw/.*|ament_index_cpp/.*|\w+/(?:msg|srv|action)/.*\.hpp|rclpy(?:\..*)?)$")
_NAMED = re.compile(r"(?:^|[_./-])ros_?([12])(?=[_./-]|$)", re.IGNORECASE)


def spoken(program: Program) -> set[str]:
    """Return the versions of ROS whose interface a file uses whatever it is compiled for."""
    if program.variants:
        one, other = (_spoken(program.variants[version].includes) for version in VERSIONS)
        return one & other
    return _spoken(program.includes)


def _spoken(includes: Iterable[tuple[str, int]]) -> set[str]:
    names = [name.strip('<>"') for name, _ in includes]
    found = {"ros1"} if any(_ROS1.match(name) for name in names) else set[str]()
    return found | {"ros2"} if any(_ROS2.match(name) for name in names) else found


def file_versions(
    programs: Mapping[str, Program],
    owners: Mapping[str, str],
    needs: Needs,
    versions: Mapping[str, Sequence[str]],
    folders: Mapping[str, str],
    targets: Iterable[Target],
) -> dict[str, str]:
    """Return ``ros1`` or ``ros2`` for each file that is for one version alone; nothing where all are for the same.

    Args:
        programs: of the workspace, by path.
        owners: id of the package of each file.
        needs: ids of the packages that each package depends on.
        versions: for which each package is built, by id.
        folders: of packages, by id.
        targets: that builds make, each with its versions.
    """
    said = {path: spoken(program) for path, program in programs.items()}
    found = {path: only for path, versions_ in said.items() if (only := _only(versions_))}
    switched = {path for path, program in programs.items() if program.variants}
    if len({*found.values()}) < 2 and not switched:
        return {}
    built = _built(targets)
    edges = included_files(programs, owners, needs)
    for path in sorted(edges.keys() - found.keys() - switched):
        if heard := _only(_heard(path, edges, said)):
            found[path] = heard
    silent = [path for path in programs if path not in found and path not in switched]
    for path in silent:
        owner = owners.get(path, "")
        if version := _only(versions.get(owner, ())) or built.get(path) or _named(path, folders.get(owner, "")):
            found[path] = version
    _headers(found, programs, edges, switched)
    mostly = max(VERSIONS, key=list(found.values()).count)
    for path in programs:
        if not versions.get(owners.get(path, ""), ()) and path not in switched:
            found.setdefault(path, mostly)
    return found


def _only(versions: Collection[str]) -> str:
    """Return the version where there is one alone; empty where there are none or several."""
    return next(iter(versions)) if len(versions) == 1 else ""


def _heard(path: str, edges: Mapping[str, Collection[str]], said: Mapping[str, set[str]]) -> set[str]:
    """Return the versions that the nearest of the files say which a file includes."""
    seen, near = {path}, [path]
    while near:
        near = [one for path in near for one in edges.get(path, ()) if one not in seen]
        seen.update(near)
        if heard := set[str]().union(*(said[one] for one in near)):
            return heard
    return set()


def _built(targets: Iterable[Target]) -> dict[str, str]:
    """Return the version of sources whose targets are all for one."""
    found: dict[str, set[str]] = {}
    for one in targets:
        for path in one.sources:
            found.setdefault(path, set()).update(one.versions or VERSIONS)
    return {path: only for path, versions in found.items() if (only := _only(versions))}


def _named(path: str, folder: str) -> str:
    inside = path.removeprefix(f"{folder}/") if folder not in ("", ".") else path
    named = {f"ros{one}" for one in _NAMED.findall(inside)}
    return _only(named)


def _headers(
    found: dict[str, str], programs: Mapping[str, Program], edges: Mapping[str, Collection[str]], switched: set[str]
) -> None:
    """Add headers that are included by files of one version alone."""
    including = inverted(edges)
    waiting = [path for path in programs if path.endswith(HEADERS) and path not in found and path not in switched]
    changed = True
    while changed:
        changed = False
        for path in waiting:
            by = {found.get(one, "") for one in including.get(path, ())}
            if path not in found and len(by) == 1 and "" not in by:
                found[path] = by.pop()
                changed = True
