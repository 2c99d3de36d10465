import pytest

from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.text import IsTrue, Not

PUB = "pub_ = create_publisher<std_msgs::msg::String>({}, 1);"


def test_both_ways_of_an_unknown_condition(node_of):
    body = "if (ask()) {\n" + PUB.format('"a"') + "\n} else {\n" + PUB.format('"b"') + "\n}"
    facts = node_of(body)
    assert [(str(one.name), as_written(one.conditions)) for one in facts.endpoints] == [
        ("a", ("ask()",)),
        ("b", ("not ask()",)),
    ]


def test_what_is_known_is_followed_alone(node_of):
    body = "bool yes = true;\nif (yes) {" + PUB.format('"a"') + "} else {" + PUB.format('"b"') + "}"
    (one,) = node_of(body).endpoints
    assert (one.name.known, as_written(one.conditions)) == ("a", ())


def test_one_text_or_another(node_of):
    body = 'std::string t = "a";\nif (ask()) { t = "b"; }\n' + PUB.format("t")
    (one,) = node_of(body).endpoints
    assert (one.name.known, one.name.usual, one.evidence.sure.value) == (None, None, "possible")
    (choice,) = one.name.holes[0].choice
    assert (str(choice.condition), str(choice.then), str(choice.otherwise)) == ("ask()", "b", "a")


def test_nothing_is_one_of_two_texts(node_of):
    body = 'std::string t;\nif (ask()) { t = "robot/"; }\n' + PUB.format('t + "scan"')
    (one,) = node_of(body).endpoints
    assert str(one.name) == "{robot/ if ask(), else nothing}scan"


def test_what_a_parameter_decides_is_kept(node_of):
    body = 'bool p = declare_parameter("p", true); auto m = declare_parameter<std::string>("m", "x");\n'
    body += 'std::string t = "a"; if (p && m != "x") { t = "b"; }\n' + PUB.format("t")
    (one,) = node_of(body).endpoints
    (test,) = one.name.holes[0].choice[0].test
    assert [type(inner) for inner in test.of] == [IsTrue, Not]


def test_a_value_that_is_read_or_written(node_of):
    members = 'std::string which() { if (ask()) { return read(); } return "b"; }'
    (one,) = node_of(PUB.format("which()"), members).endpoints
    assert one.name.known is None
    (one,) = node_of(PUB.format('ask() ? read() : "b"')).endpoints
    assert one.name.known is None


def test_a_function_that_returns_this_or_that(node_of):
    members = 'std::string which() { if (ask()) { return "a"; } return "b"; }'
    (one,) = node_of(PUB.format("which()"), members).endpoints
    assert one.name.known is None
    assert one.evidence.sure.value != "certain"


def test_what_may_not_have_happened_because_of_an_exception(node_of):
    body = "bool set = false;\ntry { read(); set = true; } catch (const std::exception & e) { log(e); }\n"
    body += "if (set) {" + PUB.format('"a"') + "} else {" + PUB.format('"b"') + "}"
    assert [str(one.name) for one in node_of(body).endpoints] == ["a", "b"]


def test_loops_over_what_is_known_and_over_a_parameter(node_of):
    body = 'for (const std::string & one : {"a", "b"}) {' + PUB.format("one") + "}\n"
    body += 'auto names = declare_parameter<std::vector<std::string>>("names");\n'
    body += "for (const auto & name : names) {" + PUB.format('"~/" + name') + "}"
    facts = node_of(body)
    assert [str(one.name) for one in facts.endpoints] == ["a", "b", "~/{each of parameter names}"]
    assert facts.endpoints[2].name.holes[0].parameter == "names"


def test_variables_outside_of_functions(main_of):
    before = "std::string g_topic;\nros::NodeHandle * g_node;\nros::Publisher pub;\n"
    before += "void make() { pub = g_node->advertise<std_msgs::String>(g_topic, 1); }"
    facts = main_of('ros::NodeHandle p("~"); g_node = &p; g_topic = "out"; make();', before)
    assert [str(one.name) for one in facts.endpoints] == ["~/out"]


def test_members_are_initialised_with_one_value(units):
    text = """
#include <ros/ros.h>
#include <std_msgs/String.h>
class Helper { public: Helper(const std::string & t) { ros::NodeHandle n; pub_ = n.advertise<std_msgs::String>(t, 1); }
  ros::Publisher pub_; };
class A { public: A() : private_("~"), helper_("helped") { pub_ = private_.advertise<std_msgs::String>("own", 1); }
  ros::NodeHandle private_; Helper helper_; ros::Publisher pub_; };
int main(int argc, char ** argv) { ros::init(argc, argv, "a"); A a; }
"""
    facts = next(one for one in units(a_cpp=text) if one.unit == "main")
    assert [str(one.name) for one in facts.endpoints] == ["helped", "~/own"]


def test_what_follows_a_way_out_that_a_parameter_decides_keeps_the_condition(node_of):
    facts = node_of(
        'bool on = declare_parameter("on", true); bool other = read();\n'
        'create_publisher<std_msgs::msg::String>("before", 1);\n'
        "if (!on) { return; }\n"
        'create_publisher<std_msgs::msg::String>("after", 1);\n'
        'if (other) { create_publisher<std_msgs::msg::String>("inside", 1); }\n'
        "if (other) { return; }\n"
        'create_publisher<std_msgs::msg::String>("last", 1);'
    )
    assert [(str(one.name), as_written(one.conditions)) for one in facts.endpoints] == [
        ("before", ()),
        ("after", ("on",)),
        ("inside", ("on", "other")),
        ("last", ("on",)),
    ]


def test_a_way_out_in_a_function_says_nothing_of_what_calls_it(node_of):
    facts = node_of(
        'bool on = declare_parameter("on", true); start(on);\ncreate_publisher<std_msgs::msg::String>("out", 1);',
        "void start(bool on) { if (!on) { return; } throw_if(on);"
        ' create_publisher<std_msgs::msg::String>("started", 1); }\n'
        "bool check(bool on) { if (!on) { return false; } return true; }",
    )
    assert [(str(one.name), as_written(one.conditions)) for one in facts.endpoints] == [
        ("started", ("on",)),
        ("out", ()),
    ]


def test_a_failure_is_no_way_out(node_of):
    facts = node_of(
        'bool on = declare_parameter("on", true); start(on);',
        "bool start(bool on) { if (!on) { return false; }"
        ' create_publisher<std_msgs::msg::String>("started", 1); return true; }',
    )
    assert [(str(one.name), as_written(one.conditions)) for one in facts.endpoints] == [("started", ())]


def test_a_base_is_meant_by_its_name_whatever_else_is_named_like_it(units):
    tree = "namespace tree { struct Node { Node(const char * key); }; }\n"
    text = (
        "#include <rclcpp/rclcpp.hpp>\n"
        'class A : public rclcpp::Node { public: A() : Node("named") {'
        ' create_publisher<std_msgs::msg::String>("a", 1); } };'
    )
    assert [one.name.known for one in units(a_cpp=text, tree_hpp=tree)] == ["named"]


def test_an_object_that_a_function_keeps_is_the_same_in_each_call(main_of):
    before = "struct Names { std::string topic; };\nNames & names() { static Names n; return n; }\n"
    made = "auto pub = nh.advertise<std_msgs::String>(names().topic, 1);"
    facts = main_of(f'ros::NodeHandle nh; names().topic = "kept"; {made}', before)
    assert [str(one.name) for one in facts.endpoints] == ["kept"]
    facts = main_of(f'ros::NodeHandle nh; names().topic = "kept"; {made}', before.replace("static ", ""))
    assert [one.name.known for one in facts.endpoints] == [None]


def test_what_a_kept_object_makes_is_made_by_each_call_that_may_be_the_first(main_of):
    before = 'struct Out { Out() { ros::NodeHandle n; pub = n.advertise<std_msgs::String>("out", 1); }\n'
    before += "  ros::Publisher pub; };\nvoid log() { static Out * out = new Out(); }\n"
    facts = main_of("if (ask()) { log(); } log();", before)
    assert [as_written(one.conditions) for one in facts.endpoints] == [()]


@pytest.mark.parametrize(
    "members",
    [
        "bool which() { if (ask()) { return compute(); } return false; }",
        "bool which() { if (ask()) { return false; } return compute(); }",
        "int which() { if (ask()) { return 0; } else { return compute(); } }",
        "bool which() { if (ask()) { return true; } if (tell()) { return compute(); } return true; }",
    ],
)
def test_a_function_that_may_return_what_is_unknown_decides_nothing(node_of, members: str):
    facts = node_of("if (which()) {" + PUB.format('"a"') + "} else {" + PUB.format('"b"') + "}", members)
    assert [(str(one.name), as_written(one.conditions)) for one in facts.endpoints] == [
        ("a", ("which()",)),
        ("b", ("not which()",)),
    ]


def test_handlers_see_what_was_set_before_the_exception(node_of):
    body = 'std::string a = "a"; try { a = "b"; read(); } catch (...) {' + PUB.format("a") + "}" + PUB.format("a")
    both = "{b if no exception, else a}"
    assert [str(one.name) for one in node_of(body).endpoints] == [both, both]


def test_a_member_that_a_function_sets_which_only_computes_decides_nothing(node_of):
    computes = (
        "double x = 1.5; for (int k = 0; k < 3; ++k) { x += k * 0.25; } if (x > 9.5) { x = x / 2.0; } x = x * x + 1.0;"
    )
    members = "void compute() { " + computes + " flag = true; } bool flag = false;"
    (one,) = node_of("compute(); if (flag) {" + PUB.format('"a"') + "}", members).endpoints
    assert as_written(one.conditions) == ("flag",)
