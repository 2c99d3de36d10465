import pytest

from roslens.source.extract.symbolic.condition import as_written

CFG = """#!/usr/bin/env python
from dynamic_reconfigure.parameter_generator_catkin import *
gen = ParameterGenerator()
gen.add("rate", double_t, 0, "How often.", 10, 0, 100)
exit(gen.generate("made", "node", "Speed"))
"""
BEFORE = "#include <ros/ros.h>\n#include <dynamic_reconfigure/server.h>\n"
ENDS = ["parameter_descriptions", "parameter_updates", "set_parameters"]


def program(body, before=""):
    return f'{BEFORE}{before}\nint main(int argc, char ** argv) {{ ros::init(argc, argv, "a");\n{body}\n}}'


@pytest.fixture
def made(units):
    """Return the facts of a program of C++ beside a ``.cfg`` file."""

    def make(body, before="", cfg=CFG):
        return next(one for one in units(a_cpp=program(body, before), Speed_cfg=cfg) if one.unit == "main")

    return make


def parameters(facts):
    return [(str(one.name), one.access, one.type, str(one.default), one.range) for one in facts.parameters]


@pytest.mark.parametrize(
    ("body", "space"),
    [
        ("dynamic_reconfigure::Server<made::SpeedConfig> server;", "~"),
        ('dynamic_reconfigure::Server<made::SpeedConfig> server(ros::NodeHandle("~/deep"));', "~/deep"),
        ('ros::NodeHandle nh("~"); auto s = new dynamic_reconfigure::Server<made::SpeedConfig>(nh);', "~"),
        ("boost::recursive_mutex m; ros::NodeHandle nh; dynamic_reconfigure::Server<made::SpeedConfig> s(m, nh);", ""),
        # What a type is called otherwise.
        ("typedef made::SpeedConfig C; typedef dynamic_reconfigure::Server<C> S; boost::shared_ptr<S> s(new S);", "~"),
        ("using Server = dynamic_reconfigure::Server<made::SpeedConfig>; auto s = std::make_unique<Server>();", "~"),
    ],
)  # fmt: skip
def test_a_server_in_cpp(made, body, space):
    facts = made(body)
    before = f"{space}/" if space else ""
    assert [str(one.name) for one in facts.endpoints] == [before + end for end in ENDS]
    assert parameters(facts) == [(f"{before}rate", "declared", "double", "10.0", "0.0..100.0")]


def test_where_it_is_declared_and_who_writes_it(made):
    (one,) = made("dynamic_reconfigure::Server<made::SpeedConfig> server;").parameters
    assert (one.description, one.evidence.path, one.evidence.line) == ("How often.", "pkg/Speed.cfg", 4)
    assert (one.evidence.how, one.writer.path, one.writer.line, one.writer.sure.value) == (
        "written by the server of dynamic_reconfigure at pkg/a.cpp:5", "pkg/a.cpp", 5, "likely",
    )  # fmt: skip


@pytest.mark.parametrize(
    "before",
    ["#include <made/SpeedConfig.h>", "using namespace made;", "using made::SpeedConfig;"],
)
def test_a_class_without_its_namespace(made, before):
    facts = made("dynamic_reconfigure::Server<SpeedConfig> server;", before)
    assert parameters(facts) == [("~/rate", "declared", "double", "10.0", "0.0..100.0")]
    assert facts.parameters[0].evidence.sure.value == "certain"


def test_a_class_of_which_there_is_only_one_is_likely_meant(made):
    (one,) = made("dynamic_reconfigure::Server<SpeedConfig> server;").parameters
    assert one.evidence.sure.value == "likely"


@pytest.mark.parametrize("kind", ["other::SpeedConfig", "made::SlowConfig", "Whatever"])
def test_without_its_file_the_parameters_are_unknown(made, kind):
    (one,) = made(f"dynamic_reconfigure::Server<{kind}> server;").parameters
    assert one.name.pattern == "~/*"
    assert (one.access, one.evidence.line, one.evidence.sure.value) == ("declared", 5, "possible")
    assert one.evidence.how == f"no .cfg file of {kind.replace('::', '.')} was found"


def test_a_file_that_is_not_understood_may_declare_more(made):
    facts = made("dynamic_reconfigure::Server<made::SpeedConfig> s;", cfg=CFG.replace("exit", "gen.add(,)\nexit"))
    assert [one.name.pattern for one in facts.parameters] == ["~/rate", "~/*"]


def test_a_condition_is_kept(made):
    facts = made("if (argc > 1) { static dynamic_reconfigure::Server<made::SpeedConfig> server; }")
    assert [as_written(one.conditions) for one in facts.parameters] == [("argc > 1",)]


@pytest.mark.parametrize(
    ("arguments", "space"),
    [
        ("SpeedConfig, changed", "~"),
        ('SpeedConfig, changed, namespace="deep"', "~deep"),
        ('SpeedConfig, changed, "~deep/"', "~deep"),
        ('SpeedConfig, changed, namespace="/all"', "/all"),
        ("type=SpeedConfig, callback=changed", "~"),
    ],
)
def test_a_server_in_python(units, arguments, space):
    text = f"""
import rospy
from dynamic_reconfigure.server import Server
from made.cfg import SpeedConfig
def changed(config, level):
    rospy.Publisher("told", Told, queue_size=1)
    return config
rospy.init_node("a")
server = Server({arguments})
rospy.spin()
"""
    facts = next(one for one in units(a_py=text, Speed_cfg=CFG) if one.path == "pkg/a.py")
    assert [str(one.name) for one in facts.endpoints] == [*(f"{space}/{end}" for end in ENDS), "told"]
    assert parameters(facts) == [(f"{space}/rate", "declared", "double", "10.0", "0.0..100.0")]


def test_a_server_as_a_member_of_a_module(units):
    text = """
import rospy
import dynamic_reconfigure.server
import made.cfg.SpeedConfig
rospy.init_node("a")
server = dynamic_reconfigure.server.Server(made.cfg.SpeedConfig, None)
"""
    facts = next(one for one in units(a_py=text, Speed_cfg=CFG) if one.path == "pkg/a.py")
    assert [str(one.name) for one in facts.parameters] == ["~/rate"]


def test_files_of_settings_become_no_nodes(units):
    assert units(Speed_cfg=CFG) == []


def test_what_is_called_when_something_changes(made):
    body = "dynamic_reconfigure::Server<made::SpeedConfig> s; s.setCallback(boost::bind(&changed, _1, _2));"
    before = 'void changed(made::SpeedConfig & c, int) { ros::NodeHandle nh; nh.advertise<std_msgs::Bool>("t", 1); }'
    assert [str(one.name) for one in made(body, before).endpoints][3:] == ["t"]
