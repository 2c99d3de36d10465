"""Units of a workspace, on small programs, and on navigation2 against a table labelled by reading its source.

``ROSLENS_CORPORA`` may name a folder with a checkout of navigation2. Each row of the table is a call site: its type,
its name as a pattern with ``*`` for what is unknown, and what decides the unknown part: a parameter, the port of a
behaviour tree, the ``caller`` of a helper, or a ``message`` that arrives, which nobody can know from source.
"""

import csv
import os
from collections import Counter
from pathlib import Path

import pytest

from roslens.source.extract.cpp_program import program_of_cpp
from roslens.source.extract.python_program import program_of_python
from roslens.source.extract.workspace_index import Index
from roslens.source.extract.workspace_units import facts_of_workspace, makes_endpoints, unreached
from roslens.source.syntax.macros import load_macros

TABLE = Path(__file__).parents[2] / "fixtures" / "extract" / "navigation2" / "endpoints.csv"
LEFT_OUT = ("test", "tests", "nav2_system_tests")
MACROS = load_macros()
HELPERS = "caller"
RUN_TIME = "message"


def facts_of(*files):
    programs = {}
    for path, text in files:
        lower = program_of_python if path.endswith(".py") else lambda content: program_of_cpp(content, MACROS)
        programs[path] = lower(text.encode())
    return facts_of_workspace(Index(programs))


NODE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Talker : public rclcpp::Node {
public:
  Talker() : Node("talker") { pub_ = create_publisher<std_msgs::msg::String>("chatter", 10); }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;
};
"""
LOADED = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Listener {
public:
  void start(rclcpp::Node::SharedPtr node) {
    sub_ = node->create_subscription<std_msgs::msg::String>("heard", 10, [](std_msgs::msg::String::SharedPtr) {});
  }
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr sub_;
};
"""
TREE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Ask : public BT::SyncActionNode {
public:
  Ask(const std::string & name, const std::string & topic, const BT::NodeConfiguration & conf)
  : BT::SyncActionNode(name, conf)
  {
    auto node = config().blackboard->get<rclcpp::Node::SharedPtr>("node");
    pub_ = node->create_publisher<std_msgs::msg::String>(topic, 1);
  }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;
};
BT_REGISTER_NODES(factory)
{
  BT::NodeBuilder builder = [](const std::string & name, const BT::NodeConfiguration & config)
    { return std::make_unique<Ask>(name, "asked", config); };
  factory.registerBuilder<Ask>("Ask", builder);
}
"""


def test_a_node_and_a_class_that_nobody_makes():
    found = facts_of(("p/talker.cpp", NODE), ("p/listener.cpp", LOADED))
    told = [(one.unit, one.kind, [str(end.name) for end in one.endpoints]) for one in found]
    assert told == [("Listener", "plugin", ["heard"]), ("Talker", "node", ["chatter"])]


def test_a_class_that_a_node_makes_is_no_unit_of_its_own():
    using = NODE.replace("};", "  Listener listener_;\n};").replace("{ pub_ =", "{ listener_.start(this); pub_ =")
    found = facts_of(("p/talker.cpp", LOADED + using))
    assert [(one.unit, [str(end.name) for end in one.endpoints]) for one in found] == [("Talker", ["heard", "chatter"])]


def test_nodes_of_behaviour_trees_are_made_as_they_are_registered():
    (found,) = facts_of(("p/ask.cpp", TREE))
    assert (found.unit, found.kind, found.generation) == ("Ask", "plugin", "ros2")
    assert [str(one.name) for one in found.endpoints] == ["asked"]


def test_what_is_reached_is_not_unreached():
    index = Index({"p/listener.cpp": program_of_cpp(LOADED.encode(), MACROS)})
    (only,) = unreached(index, set())
    start = next(one for one in index.programs["p/listener.cpp"].functions if one.name == "start")
    assert only.what.name == "Listener"
    assert makes_endpoints(start)
    assert list(unreached(index, {("p/listener.cpp", start.line)})) == []


@pytest.fixture(scope="module")
def navigation2():
    corpora = os.environ.get("ROSLENS_CORPORA", "")
    root = Path(corpora) / "navigation2"
    if not corpora or not root.is_dir():
        pytest.skip("ROSLENS_CORPORA names no folder with navigation2")
    programs = {}
    for path in sorted(root.rglob("*.[ch]pp")):
        name = path.relative_to(root).as_posix()
        if not set(LEFT_OUT) & set(name.split("/")):
            programs[name] = program_of_cpp(path.read_bytes(), MACROS)
    made = {}
    for facts in facts_of_workspace(Index(programs)):
        for one in facts.endpoints:
            for place in (one.evidence, *one.through):
                made.setdefault((place.path, one.role.value), []).append((place.line, one))
    return made


def rows():
    with TABLE.open() as file:
        return list(csv.DictReader(file))


def is_named(row, name):
    """Whether a name is the one in the table, or tells what decides it."""
    if not row["decides"]:
        return name.known == row["name"]
    if row["decides"] == HELPERS:
        return name.known is not None or any(hole.parameter for hole in name.holes) or name.usual is not None
    told = [text for hole in name.holes for text in (hole.parameter, hole.reason)]
    return any(row["decides"] == text or row["decides"] in text for text in told)


@pytest.mark.slow
def test_call_sites_of_navigation2(navigation2):
    counts = Counter()
    missed, wrong = [], []
    for row in rows():
        place = f"{row['path']}:{row['line']}"
        near = navigation2.get((row["path"], row["role"]), [])
        least = min((abs(line - int(row["line"])) for line, _ in near), default=99)
        found = [one for line, one in near if abs(line - int(row["line"])) == least <= 2]
        typed = [one for one in found if (one.type.known == row["type"] if row["type"] != "*" else one.type.known)]
        named = [one for one in found if is_named(row, one.name)]
        for what, given in (("sites", True), ("found", found), ("typed", typed), ("named", named)):
            counts[row["role"], what] += bool(given)
            counts["all", what] += bool(given)
        counts["all", "run time"] += row["decides"] == RUN_TIME
        if not typed or not named:
            missed.append(f"{place} {row['name']} {row['decides']}: {[str(one.name) for one in found][:2]}")
        # What is called certain has to be as the table says, however much else is missed.
        sure = [one for one in found if one.evidence.sure.value == "certain"]
        wrong += [
            f"{place} is not {one.name} for sure"
            for one in sure
            if row["decides"] != HELPERS and not is_named(row, one.name)
        ]
    assert counts["all", "sites"] == len(rows()) == 202
    assert counts["all", "found"] >= 0.98 * 202, missed
    assert counts["all", "typed"] >= 0.97 * 202, missed
    assert counts["all", "named"] >= 0.92 * 202, missed
    assert counts["all", "run time"] == 8
    assert not wrong
