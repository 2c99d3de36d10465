import pytest

from roslens.source.distributions.target import targets_of
from roslens.source.inventory import take_inventory
from roslens.source.parsed_file import parse_file
from roslens.source.rules.package_view import PackageView
from roslens.source.settings import MacroSettings, WorkspaceSettings
from roslens.source.workspace.find import find_workspace
from roslens.source.workspace.surroundings import surroundings_of


@pytest.fixture
def package_view():
    """The only package in a folder, or the one of a name, as rules see it."""

    def view(folder, name="", distro=""):
        workspace = find_workspace([folder], WorkspaceSettings())
        (found,) = [one for one in workspace.packages if one.package.manifest.path and name in ("", one.package.name)]
        inventory = take_inventory(workspace, WorkspaceSettings(), {})
        packages = [one.package for one in workspace.packages]
        around = surroundings_of(packages, inventory.files, targets_of(folder, packages, distro))
        files = inventory.files[found.package.id]
        facts = {
            file.path: parse_file((folder / file.path).read_bytes(), file.language, MacroSettings()).facts()
            for file in files
            if file.language.parsed_as
        }
        others = inventory.others[found.package.id]
        return PackageView(found.package, workspace.root, files, facts, others=others, around=around[found.package.id])

    return view
