"""1: version policy, stability of API and ABI."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.requirement import Item
from roslens.model.source import Language, Location
from roslens.source.evidence.answer import met, not_known, not_met
from roslens.source.evidence.package_folder import PackageFolder


def version(folder: PackageFolder) -> Iterator[Item]:
    """Yield what is known of version and stability."""
    yield declared(folder, "1.i", r"version(ing)? policy|semantic version|semver", "a version policy")
    given = folder.package.version
    first = given.partition(".")[0]
    if not first.isdigit():
        yield not_met("1.ii", f'the version is "{given}"', folder.package.manifest)
    else:
        yield (met if int(first) >= 1 else not_met)("1.ii", f"version {given}", folder.package.manifest)
    yield _public(folder)
    yield declared(folder, "1.iv", r"api stability", "a policy for the stability of its API")
    yield declared(folder, "1.v", r"abi stability|abi and abi stability", "a policy for the stability of its ABI")
    yield declared(folder, "1.vi", r"stability within|within a (released )?ros distribution", "what changes within one")


def declared(folder: PackageFolder, number: str, pattern: str, what: str) -> Item:
    """Return that a text of the package speaks of something, or that none does, which proves nothing."""
    contributing = folder.find("CONTRIBUTING.md", "CONTRIBUTING.rst")
    if place := folder.says(pattern, folder.declaration, contributing, folder.readme):
        return met(number, f"a text of the package mentions {what}; compliance is not checked", place)
    return not_known(number, f"no quality declaration, CONTRIBUTING or README mentions {what}")


def _public(folder: PackageFolder) -> Item:
    if headers := folder.public_headers():
        shown = f"{len(headers)} headers below include/"
        return met(
            "1.iii", shown, folder.says("public api", folder.declaration), *(Location(one.path) for one in headers[:2])
        )
    python = [one for one in folder.own(Language.PYTHON) if one.path.endswith("/__init__.py")]
    if python:
        return not_known("1.iii", f"{len(python)} Python packages; what of them is public is not declared anywhere")
    return not_known(
        "1.iii", "no public headers and no Python package: a node's API is its topics, which roslens graph shows"
    )
