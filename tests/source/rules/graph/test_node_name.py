from roslens.model.configuration import Proof
from roslens.model.finding import Severity
from roslens.model.weight.consequence import Consequence
from roslens.source.rules.graph.node_name import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, launched, node


def findings(*nodes, **more):
    return list(found(configuration(*nodes, **more), Surroundings()))


def test_two_nodes_of_one_name_are_told_with_both_places():
    (one,) = findings(node("/a", line=3), node("/a", line=7), generation="ros1")
    assert (one.severity, one.line) == (Severity.ERROR, 7)
    assert one.message == (
        "robot/a (launch/robot.launch.xml:3) and robot/a (launch/robot.launch.xml:7) are both called /a: roslaunch "
        "refuses robot.launch.xml and starts nothing of it. Give one of them another name or namespace."
    )
    assert one.consequence is Consequence.STOPS_START
    (one,) = findings(node("/a", line=3), node("/a", line=7))
    assert one.severity is Severity.WARNING


def test_the_same_file_included_twice_starts_it_twice():
    assert len(findings(node("/a"), node("/a"))) == 1


def test_random_ends_opposite_conditions_and_nodes_of_one_process_are_none():
    assert not findings(node("/a", anonymous=True), node("/a", line=2, anonymous=True))
    assert not findings(node("/a", conditions=("$(var sim)",)), node("/a", line=2, conditions=("not $(var sim)",)))
    assert not findings(node("/a", unit="A"), node("/a", unit="B"), generation="ros1")
    assert not findings(node("/a*", resolved=False), node("/a*", line=2, resolved=False))


def test_a_condition_lowers_it():
    (one,) = findings(node("/a", conditions=("debug",)), node("/a", line=2), generation="ros1")
    assert one.severity is Severity.WARNING
    assert "only if `debug`" in one.message


def test_a_name_that_only_code_which_is_unknown_gives_is_no_name():
    guessed = [node("/spawner", known=False, proof=launched(line, sure="likely")) for line in (3, 7)]
    assert not findings(*guessed)
    assert findings(*(node("/spawner", known=False, line=line) for line in (3, 7)))


def test_nodes_that_one_program_makes_are_none_and_programs_that_end_a_note():
    units = [node("/px4flow", unit="main", defined=Proof("src/main.cpp", line)) for line in (3, 7, 7, 7)]
    assert not findings(*units, generation="ros1")
    assert len(findings(*units, *units, generation="ros1")) == 1
    spawners = [node("/create", package="ros_gz_sim", executable="create", line=line) for line in (3, 7)]
    assert [one.severity for one in findings(*spawners)] == [Severity.NOTE]
    assert [one.severity for one in findings(*spawners, generation="ros1")] == [Severity.ERROR]


def two(**more):
    """The two nodes of one program, as a launch file names them."""
    return [node("/plan", executable="plan", line=7, defined=Proof("src/plan.cpp", line), **more) for line in (6, 9)]


def test_one_name_for_two_nodes_of_a_program_is_a_warning_in_ros2():
    (one,) = findings(*two())
    assert (one.severity, one.line) == (Severity.WARNING, 7)
    assert one.message == (
        "robot/plan makes two nodes (src/plan.cpp:6 and src/plan.cpp:9), and the name given here renames both to "
        "/plan: they cannot be distinguished. Leave the name away, or give it to one of them (`NODE:__node:=NAME` in "
        "ros_arguments)."
    )
    assert not findings(*two(), generation="ros1")


def test_nodes_of_a_program_that_no_launch_file_names_or_that_exclude_each_other_are_none():
    assert not findings(*two(proof=Proof("CMakeLists.txt", 8)))
    assert not findings(*two(container="/container"))
    first = node("/plan", executable="plan", line=7, defined=Proof("src/plan.cpp", 6), conditions=("sim",))
    second = node("/plan", executable="plan", line=7, defined=Proof("src/plan.cpp", 9), conditions=("not sim",))
    assert not findings(first, second)
