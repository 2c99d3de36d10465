import msgspec

from roslens.report.graph.to_dot import to_dot


def test_namespaces_are_boxes_and_lines_have_styles(graph):
    text = to_dot(graph)
    assert '  subgraph "cluster /ns" {' in text
    assert '"node /ns/talker" [label="/ns/talker", shape=ellipse, style=dashed];' in text
    assert '"topic /in/* of /ns/talker" [label="/in/* of /ns/talker", shape=box, style=dotted];' in text
    assert '"node /ns/talker" -> "topic /chatter";' in text
    assert '"topic /chatter" -> "node /listener";' in text
    assert '"service /reset" -> "node /ns/talker" [style=dashed];' in text
    assert text.count("{") == text.count("}")


def test_quotes_are_escaped(graph):
    assert to_dot(msgspec.structs.replace(graph, title='a"b\\')).startswith('digraph "a\\"b\\\\" {')
