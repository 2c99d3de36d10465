"""Objects of classes of the workspace, and values as their declared type makes them."""

PUB = "pub_ = create_publisher<std_msgs::msg::String>({}, 1);"
HELPER = """
struct Names { Names() : out("made") {} explicit Names(const std::string & t) : out(t) {} std::string out; };
"""


def test_a_declaration_constructs_what_is_held_by_value(node_of):
    body = 'Names one; Names two{"given"}; Names * none;\n' + "".join(
        PUB.format(f"{one}.out") for one in ("one", "two")
    )
    facts = node_of(body + PUB.format("none->out"), before=HELPER)
    assert [one.name.known for one in facts.endpoints] == ["made", "given", None]


def test_a_member_that_no_constructor_sets_is_not_known(node_of):
    (one,) = node_of(PUB.format("topic_"), members="std::string topic_;").endpoints
    assert one.name.holes[0].reason == "topic_, which is not set"


def test_the_constructor_that_takes_so_many_arguments_is_meant(node_of):
    facts = node_of(PUB.format("held_.out"), members='Names held_ = Names("of a member");', before=HELPER)
    assert [one.name.known for one in facts.endpoints] == ["of a member"]
