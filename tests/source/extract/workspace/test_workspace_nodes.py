"""All nodes of a workspace with what is in none of them; the second time from the cache."""

import pytest

from roslens.source.extract.units import isolated_units
from roslens.source.extract.workspace.workspace_nodes import workspace_nodes
from roslens.source.extract.workspace.workspace_parts import WorkspaceParts
from roslens.source.inventory import take_inventory
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import find_workspace
from roslens.store.cache import Cache

FILES = {
    "package.xml": '<package format="2"><name>eye</name><version>1.0.0</version><description>d</description>'
    "<maintainer email='a@example.org'>a</maintainer><license>MIT</license><depend>rospy</depend></package>",
    "setup.py": "from setuptools import setup\nsetup(name='eye', packages=['eye'],"
    " entry_points={'console_scripts': ['look = eye.look:begin']})\n",
    "eye/look.py": "import rospy\nfrom std_msgs.msg import String\ndef begin():\n    rospy.init_node('eye')\n"
    "def end():\n    rospy.Publisher('gone', String, queue_size=1)\n",
    "eye/odd.cpp": "int odd( { ;\n",
}


@pytest.fixture
def workspace(tmp_path):
    for path, text in FILES.items():
        place = tmp_path / "eye" / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    return tmp_path


def parts(root, cache):
    settings = SourceSettings()
    found = find_workspace([root], settings.workspace)
    return WorkspaceParts(found, take_inventory(found, settings.workspace, {}), settings, cache=cache, jobs=1)


def test_nodes_and_what_is_in_none(workspace, tmp_path, monkeypatch):
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        found = workspace_nodes(parts(workspace, cache))
    assert [(one.unit, str(one.name)) for one in found.nodes] == [("begin", "eye"), ("end", "")]
    assert found.without_endpoint == ()
    assert {one.evidence.path for one in found.unresolved} == {"eye/eye/odd.cpp"}
    assert found.failures == ()
    monkeypatch.setattr(isolated_units, "units_of", None)
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        assert workspace_nodes(parts(workspace, cache)) == found
