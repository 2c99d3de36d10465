from roslens.model.configuration import Origin
from roslens.model.finding import Severity
from roslens.source.rules.graph.global_name import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, node


def findings(*nodes):
    return list(found(configuration(*nodes), Surroundings()))


def test_a_global_name_in_code_is_a_note_once_a_place():
    (one,) = findings(
        node("/a", end("pub", "/scan", line=3)), node("/b", end("pub", "/scan", line=3, path="src/a.cpp"))
    )
    assert one.severity is Severity.NOTE
    assert one.message == (
        "/a (src/a.cpp:3) publishes the topic `/scan`, a global name. Write `scan` and remap or push a namespace in "
        "the launch file."
    )


def test_all_places_of_a_file_that_name_one_thing_are_one_finding():
    lines = range(3, 11)
    (one,) = findings(node("/a", *(end("pub", "/scan", line=line) for line in lines)))
    assert one.line == 3
    assert "`/scan`, a global name, as /a (src/a.cpp:4), /a (src/a.cpp:5)" in one.message
    assert "/a (src/a.cpp:8) and 2 more places do. Write `scan`" in one.message
    (first, other) = findings(node("/a", end("pub", "/scan", line=3), end("sub", "/scan", line=4, path="src/b.cpp")))
    assert (first.path, other.path) == ("src/a.cpp", "src/b.cpp")
    assert "as /" not in first.message


def test_relative_shared_and_foreign_names_are_none():
    assert not findings(
        node(
            "/a",
            end("pub", "/scan", given="scan"),
            end("pub", "/tf"),
            end("sub", "/clock"),
            end("pub", "/out", origin=Origin.CATALOGUE),
            end("pub", "/imp", origin=Origin.IMPLICIT),
        )
    )
