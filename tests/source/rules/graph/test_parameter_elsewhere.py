from roslens.model.configuration import Proof
from roslens.model.finding import Severity
from roslens.source.rules.graph.parameters.parameter_elsewhere import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, node, parameter


def reads(*names):
    return tuple(parameter(name, access="read", proof=Proof("src/a.cpp", line)) for line, name in enumerate(names, 4))


def findings(*nodes, generation="ros1"):
    return list(found(configuration(*nodes, generation=generation), Surroundings()))


def test_code_that_was_copied_reads_what_is_of_another_node():
    (one,) = findings(
        node("/rule", parameters=reads("/navi/size", "/navi/latch")), node("/navi", parameters=reads("/navi/size"))
    )
    assert (one.severity, one.path, one.line) == (Severity.NOTE, "src/a.cpp", 4)
    assert one.message == (
        "/rule (src/a.cpp:4) reads `/navi/size` and 1 more, private to /navi, which reads it too. Read `~size` if it "
        "is meant to be its own."
    )


def test_what_the_other_node_does_not_read_is_a_note():
    (one,) = findings(node("/rule", parameters=reads("/navi/size")), node("/navi"))
    assert one.severity is Severity.NOTE


def test_own_shared_and_unknown_parameters_are_none():
    assert not findings(node("/rule", parameters=reads("/rule/size", "/size", "/other/size")), node("/navi"))
    assert not findings(node("/navi/rule", parameters=reads("/navi/size")), node("/navi"))
    assert not findings(node("/rule", parameters=reads("/navi/size")), node("/navi"), generation="ros2")
