"""What the build of a package makes for each version of ROS, as one: each target with its versions."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from roslens.source.extract.builds.targets import Build
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence, Target, TargetKind


def joined_builds(builds: Sequence[tuple[str, Build]]) -> Build:
    """Return builds for versions of ROS as one: what is made alike for both stands there once.

    Args:
        builds: each with its version, ``ros1`` or ``ros2``.
    """
    found: dict[Target, tuple[str, ...]] = {}
    several = len({version for version, _ in builds}) > 1
    left_out = _nodelets(builds) if several else frozenset[Evidence]()
    unresolved: dict[str, tuple[Unresolved, ...]] = {}
    for version, build in builds:
        missed = [one for one in build.unresolved if version == "ros1" or one.evidence not in left_out]
        unresolved[version] = (*unresolved.get(version, ()), *missed)
        for target in build.targets:
            if version == "ros2" and several and target.kind is TargetKind.NODELET:
                continue
            known = found.get(target, ())
            found[target] = known if version in known else (*known, version)
    every = [build for _, build in builds]
    return Build(
        tuple(msgspec.structs.replace(one, versions=versions) for one, versions in found.items()),
        tuple(dict.fromkeys(one for missed in unresolved.values() for one in missed)),
        tuple(dict.fromkeys(one for build in every for one in build.interfaces)),
        tuple(dict.fromkeys(one for build in every for one in build.installed)),
        tuple(dict.fromkeys(one for build in every for one in build.parameters)),
        unresolved if several else {},
    )


def _nodelets(builds: Sequence[tuple[str, Build]]) -> frozenset[Evidence]:
    """Return where nodelets are described: ROS 2 has none."""
    targets = (target for _, build in builds for target in build.targets)
    return frozenset(one.evidence for one in targets if one.kind is TargetKind.NODELET)
