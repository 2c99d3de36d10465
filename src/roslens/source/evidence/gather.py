"""Everything that is known of a package against REP-2004."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from roslens.model.requirement import Evidence
from roslens.source.evidence.changes import Change, changes
from roslens.source.evidence.documentation import claimed_level, documentation
from roslens.source.evidence.package_folder import PackageFolder
from roslens.source.evidence.requirements import REQUIREMENTS
from roslens.source.evidence.surroundings import surroundings
from roslens.source.evidence.testing import testing
from roslens.source.evidence.version import version


def gather(folder: PackageFolder, log: Sequence[Change] | None, claimed: Mapping[str, int]) -> Evidence:
    """Return the evidence on a package, an item for each requirement in the order of REP-2004.

    Args:
        folder: of the package.
        log: newest changes of its repository, None where there is no history.
        claimed: levels that declarations of packages in the workspace claim, by name.
    """
    own = claimed_level(folder)
    found = [
        *version(folder),
        *changes(folder, log),
        *documentation(folder),
        *testing(folder),
        *surroundings(folder, claimed, own),
    ]
    order = {one.number: place for place, one in enumerate(REQUIREMENTS)}
    items = sorted(found, key=lambda item: order[item.requirement.number])
    return Evidence(folder.package.name, folder.package.version, own, tuple(items))
