"""5, 6 and 7: dependencies, platforms, vulnerabilities."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from roslens.model.requirement import Item
from roslens.source.evidence.answer import met, not_known, not_met
from roslens.source.evidence.package_folder import PackageFolder
from roslens.source.evidence.version import declared

_RUN = ("depend", "exec", "run", "build_export")
_SHOWN = 8


def surroundings(folder: PackageFolder, claimed: Mapping[str, int], own: int) -> Iterator[Item]:
    """Yield what is known of what is around the package.

    Args:
        folder: of the package.
        claimed: levels that declarations of packages in the workspace claim, by name; 0 for none.
        own: level that the package claims.
    """
    yield _dependencies(folder, claimed, own)
    yield declared(folder, "5.ii", r"optional.*dependenc", "optional dependencies")
    yield declared(folder, "5.iii", r"(non-ros|direct runtime non).*dependenc", "dependencies outside of ROS")
    platforms = folder.says(r"tier 1|tier-1|REP[- ]?2000", folder.declaration)
    if platforms:
        yield met("6.i", "the declaration states it; nothing was built", platforms)
    else:
        yield not_known("6.i", "no declaration names platforms, and nothing was built")
    security = folder.find("SECURITY.md") or folder.security()
    reported = folder.says(r"REP[- ]?2006|vulnerability disclosure", folder.declaration)
    place = folder.location(security) if security else reported
    untold = not_met("7.i", "no SECURITY file, and no declaration that refers to REP-2006")
    yield met("7.i", "the repository describes how to report one", place) if place else untold


def _dependencies(folder: PackageFolder, claimed: Mapping[str, int], own: int) -> Item:
    needed = folder.needs(*_RUN)
    if not needed:
        return met("5.i", "it needs no other package at run time", folder.package.manifest)
    here = [name for name in needed if name in claimed]
    worse = [name for name in here if own and (claimed[name] == 0 or claimed[name] > own)]
    if worse:
        shown = ", ".join(f"{name} ({claimed[name] or 'none'})" for name in worse[:_SHOWN])
        return not_met("5.i", f"it claims level {own}, and dependencies in the workspace claim a lower level: {shown}")
    outside = [name for name in needed if name not in claimed]
    if outside:
        more = f" and {len(outside) - _SHOWN} more" if len(outside) > _SHOWN else ""
        return not_known("5.i", f"not in this workspace: {', '.join(outside[:_SHOWN])}{more}")
    if not own:
        return not_known("5.i", "the package claims no level to compare its dependencies with")
    return met("5.i", f"all {len(here)} are in this workspace and claim level {own} or better")
