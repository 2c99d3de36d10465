"""A build whose reading broke, as a failure."""

from __future__ import annotations

from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.source import Package


def broken_build(package: Package, error: Exception) -> Failure:
    """Return what is said of a package whose build an error kept from being read."""
    import traceback

    return Failure(
        tool="graph",
        what=f"{type(error).__name__}: {error}",
        expected="a build whose targets can be read",
        advice="Please report it with the package: this is a bug in roslens",
        entity=str(EntityId(EntityKind.PACKAGE, package.id)),
        package=package.id,
        partial=True,
        detail="".join(traceback.format_exception(error)),
    )
