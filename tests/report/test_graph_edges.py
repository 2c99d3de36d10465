from roslens.report.graph.graph_edges import namespace_of, things_of


def test_nodes_and_things_are_joined(graph):
    drawn, lines = things_of(graph)
    assert [(one.kind, one.name) for one in drawn if one.kind != "topic"] == [
        ("action", "/go"),
        ("node", "/listener"),
        ("node", "/ns/talker"),
        ("service", "/reset"),
    ]
    ways = {(one.node, one.thing): (one.out, one.resolved, one.conditional, one.likely) for one in lines}
    assert ways["/listener", "/chatter"] == (False, True, False, True)
    assert ways["/listener", "/go"] == (True, True, False, False)
    assert ways["/ns/talker", "/reset"] == (False, True, True, False)
    assert ways["/ns/talker", "/in/* of /ns/talker"] == (True, False, False, False)


def test_namespaces():
    assert [namespace_of(name) for name in ("/a", "/a/b", "/a/b/c")] == ["/", "/a", "/a/b"]
