import pytest

from roslens.source.inventory import take_inventory
from roslens.source.parsed_file import parse_file
from roslens.source.rules.package_view import PackageView
from roslens.source.settings import MacroSettings, WorkspaceSettings
from roslens.source.workspace.find import find_workspace


@pytest.fixture
def package_view():
    """The only package in a folder, as rules see it."""

    def view(folder):
        workspace = find_workspace([folder], WorkspaceSettings())
        (found,) = [one for one in workspace.packages if one.package.manifest.path]
        inventory = take_inventory(workspace, WorkspaceSettings(), {})
        files = inventory.files[found.package.id]
        facts = {
            file.path: parse_file((folder / file.path).read_bytes(), file.language, MacroSettings()).facts()
            for file in files
            if file.language.parsed_as
        }
        others = inventory.others[found.package.id]
        return PackageView(found.package, workspace.root, files, facts, others=others)

    return view
