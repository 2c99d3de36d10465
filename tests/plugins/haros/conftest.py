"""A workspace for HAROS plug-ins."""

from collections.abc import Callable
from pathlib import Path

import msgspec
import pytest

from roslens.model.source import Dependency, Location
from roslens.plugins.points import PackageInput, WorkspaceInput


@pytest.fixture
def make_workspace(make_package: Callable[..., PackageInput], tmp_path: Path) -> Callable[..., WorkspaceInput]:
    """Return a function that makes a workspace of the package ``pack``, which depends on ``lib``."""

    def make(*files: str, artifacts: str = "") -> WorkspaceInput:
        pack = make_package(
            {"package.xml": "<package/>\n", **dict.fromkeys(files, "one\n\ntwo\n")}, "pack", repository="repo"
        )
        dependencies = (Dependency("lib", "depend", Location("pack/package.xml")),)
        package = msgspec.structs.replace(pack.package, dependencies=dependencies)
        lib = make_package({"package.xml": "<package/>\n"}, "lib")
        return WorkspaceInput(str(tmp_path), (msgspec.structs.replace(pack, package=package), lib), artifacts=artifacts)

    return make
