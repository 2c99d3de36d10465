import pytest

from roslens.source.extract.launched import Launched
from roslens.source.extract.node_facts import Evidence
from roslens.source.extract.ros1_nodelet import as_nodelet
from roslens.source.extract.text import Text


def started(program, *words):
    package, executable = program.split("/")
    return Launched(Text.of(package), Text.of(executable), Evidence("a", 1), arguments=tuple(map(Text.of, words)))


@pytest.mark.parametrize(
    ("node", "kind", "plugin", "container"),
    [
        (started("nodelet/nodelet", "manager"), "container", "", ""),
        (started("nodelet/nodelet", "load", "a/B", "m", "--no-bond"), "nodelet", "a/B", "m"),
        (started("nodelet/nodelet", "standalone", "a/B"), "nodelet", "a/B", ""),
        (started("nodelet/nodelet", "load", "a/B"), "node", "", ""),
        (started("nodelet/nodelet"), "node", "", ""),
        (started("other/nodelet", "load", "a/B", "m"), "node", "", ""),
    ],
)
def test_what_is_loaded(node, kind, plugin, container):
    found = as_nodelet(node)
    assert (found.kind, str(found.plugin), str(found.container)) == (kind, plugin, container)
