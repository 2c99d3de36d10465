"""A worker that was made ready waits for nothing but the files of a package."""

import subprocess
import sys
from pathlib import Path

EXAMPLE = Path(__file__).parents[3] / "examples" / "workspace"

MEASURED = """
import sys
from pathlib import Path
from roslens.source.measure.make_ready import make_ready
make_ready()
ready = set(sys.modules)
from roslens.source.inventory import take_inventory
from roslens.source.measure.finished_package import Finishing, finish_packed
from roslens.source.measure.package_task import package_task
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import find_workspace
import msgspec
settings = SourceSettings()
workspace = find_workspace([sys.argv[1]], settings.workspace)
files = take_inventory(workspace, settings.workspace, {}).files
looked = set(sys.modules)
pack = msgspec.msgpack.encode
for found in workspace.packages:
    task = package_task(found, files[found.package.id], (), root=workspace.root, settings=settings, kept="")
    finish_packed(pack(Finishing(settings, ())), pack(()), pack(task))
print(len(workspace.packages), *sorted(set(sys.modules) - looked - ready))
"""


def test_packages_need_no_further_modules(tmp_path):
    # In an empty folder: what it is made ready with is no file.
    words = [sys.executable, "-c", MEASURED, str(EXAMPLE)]
    packages, *further = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=True).stdout.split()
    assert int(packages) > 1
    assert [one for one in further if one.startswith("roslens.")] == []
