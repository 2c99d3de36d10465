"""Functions of one name in several files: linkage decides which is meant, and nothing else does."""

import pytest

from roslens.cli.graph.graph_source import GraphSource
from roslens.source.settings import SourceSettings

MANIFEST = """<package format="2"><name>{name}</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.org">a</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend>
<depend>roscpp</depend>{needs}</package>"""
CMAKE = "project({name})\nfind_package(catkin REQUIRED roscpp)\ncatkin_package()\n{rest}\n"
HEAD = "#include <ros/ros.h>\n#include <std_msgs/String.h>\n"
MAIN = 'int main(int argc, char ** argv) {{ ros::init(argc, argv, "{name}"); ros::NodeHandle nh; setup(nh); }}\n'
SETUP = """{before}void setup(ros::NodeHandle & nh) {{
  {more}static auto p = nh.advertise<std_msgs::String>("{topic}", 1); }}
"""
MORE = """void more(ros::NodeHandle & nh, std::string name) {
  static auto p = nh.advertise<std_msgs::String>(name, 1); }
"""


def setup(topic, before="", more=""):
    return SETUP.format(topic=topic, before=before, more=more)


@pytest.fixture
def graph(tmp_path):
    """Return the endpoints that the command shows of each node, name and how sure; and what is unresolved of nodes."""

    def make(packages, needs=()):
        for name, (build, files) in packages.items():
            folder = tmp_path / name
            depends = "".join(f"<depend>{need}</depend>" for package, need in needs if package == name)
            all_files = {"package.xml": MANIFEST.format(name=name, needs=depends), **files}
            if build is not None:
                all_files["CMakeLists.txt"] = CMAKE.format(name=name, rest=build)
            for path, text in all_files.items():
                (folder / path).parent.mkdir(parents=True, exist_ok=True)
                (folder / path).write_text(text)
        with GraphSource(str(tmp_path), SourceSettings(), "roslens.toml", {}) as source:
            (configuration,) = source.packages(list(packages))
        ends = {
            node.name: sorted((one.endpoint.name, one.proof.sure) for one in node.endpoints if not one.implicit)
            for node in configuration.nodes
            if node.defined is not None and node.kind == "node"
        }
        return ends, [one for one in configuration.unresolved if one.node]

    return make


def program(name, source, *, build=None):
    return (f"add_executable({name} src/{name}.cpp)" if build is None else build, {f"src/{name}.cpp": HEAD + source})


LONGER = "int one = f(); int two = f(one); g(one, two); "


@pytest.mark.parametrize("before", ["", "static "])
def test_two_packages_mean_their_own(graph, before):
    alpha = program("alpha", setup("alpha_one", before, LONGER) + MAIN.format(name="alpha"))
    beta = program("beta", setup("beta_one", before) + MAIN.format(name="beta"))
    ends, unresolved = graph({"alpha": alpha, "beta": beta})
    assert ends == {"/alpha": [("/alpha_one", "certain")], "/beta": [("/beta_one", "certain")]}
    assert unresolved == []


def test_a_namespace_without_name_is_seen_by_its_own_file_only(graph):
    hidden = "namespace {\n" + setup("alpha_one", "", LONGER) + "}\n"
    alpha = program("alpha", hidden + MAIN.format(name="alpha"))
    beta = program("beta", "void setup(ros::NodeHandle & nh);\n" + MAIN.format(name="beta"))
    ends, unresolved = graph({"alpha": alpha, "beta": beta}, [("beta", "alpha")])
    assert ends == {"/alpha": [("/alpha_one", "certain")], "/beta": []}
    (one,) = unresolved
    assert (one.node, one.proof.place) == ("/beta", "beta/src/beta.cpp:4")
    assert "alpha/src/alpha.cpp:4" in one.reason


def test_another_package_that_nothing_names_is_no_answer(graph):
    alpha = program("alpha", setup("alpha_one") + MAIN.format(name="alpha"))
    beta = program("beta", "void setup(ros::NodeHandle & nh);\n" + MAIN.format(name="beta"))
    ends, unresolved = graph({"alpha": alpha, "beta": beta})
    assert ends["/beta"] == []
    assert len(unresolved) == 1


def test_two_programs_of_a_package(graph):
    files = {
        "src/one.cpp": HEAD + "void setup(ros::NodeHandle & nh);\n" + MAIN.format(name="one"),
        "src/two.cpp": HEAD + "void setup(ros::NodeHandle & nh);\n" + MAIN.format(name="two"),
        "src/setup_one.cpp": HEAD + setup("of_one", "", LONGER),
        "src/setup_two.cpp": HEAD + setup("of_two"),
    }
    build = "add_executable(one src/one.cpp src/setup_one.cpp)\nadd_executable(two src/two.cpp src/setup_two.cpp)"
    ends, unresolved = graph({"pkg": (build, files)})
    assert ends == {"/one": [("/of_one", "certain")], "/two": [("/of_two", "certain")]}
    assert unresolved == []


def test_a_file_that_two_programs_share_means_what_each_links(graph):
    shared = HEAD + "void setup(ros::NodeHandle & nh);\nvoid start() { ros::NodeHandle nh; setup(nh); }\n"
    main = HEAD + 'void start();\nint main(int argc, char ** argv) {{ ros::init(argc, argv, "{name}"); start(); }}\n'
    files = {
        "src/shared.cpp": shared,
        "src/one.cpp": main.format(name="one"),
        "src/two.cpp": main.format(name="two"),
        "src/setup_one.cpp": HEAD + setup("of_one", "", LONGER),
        "src/setup_two.cpp": HEAD + setup("of_two"),
    }
    build = "\n".join(
        f"add_executable({one} src/{one}.cpp src/setup_{one}.cpp src/shared.cpp)" for one in ("one", "two")
    )
    ends, _ = graph({"pkg": (build, files)})
    assert ends == {"/one": [("/of_one", "certain")], "/two": [("/of_two", "certain")]}


def test_two_sources_of_one_program_that_both_define_it_are_no_answer(graph):
    files = {
        "src/one.cpp": HEAD + "void setup(ros::NodeHandle & nh);\n" + MAIN.format(name="one"),
        "src/a.cpp": HEAD + setup("of_a", "", LONGER),
        "src/b.cpp": HEAD + setup("of_b"),
    }
    ends, unresolved = graph({"pkg": ("add_executable(one src/one.cpp src/a.cpp src/b.cpp)", files)})
    assert ends == {"/one": []}
    assert ["pkg/src/a.cpp:3" in one.reason and "pkg/src/b.cpp:3" in one.reason for one in unresolved] == [True]


def test_the_header_that_is_included_decides(graph):
    main = HEAD + '#include "{name}/setup.h"\n' + MAIN.format(name="{name}")
    packages = {
        name: (
            f"add_executable({name} src/{name}.cpp)",
            {
                f"src/{name}.cpp": main.replace("{name}", name).replace("{{", "{").replace("}}", "}"),
                f"include/{name}/setup.h": HEAD + setup(f"{name}_one", "inline ", LONGER * (name == "alpha")),
            },
        )
        for name in ("alpha", "beta")
    }
    ends, unresolved = graph(packages)
    assert ends == {"/alpha": [("/alpha_one", "certain")], "/beta": [("/beta_one", "certain")]}
    assert unresolved == []


def test_the_library_of_a_package_that_is_needed(graph):
    library = {
        "include/tools/setup.h": "#include <ros/ros.h>\nvoid setup(ros::NodeHandle & nh);\n",
        "src/setup.cpp": HEAD + '#include "tools/setup.h"\n' + setup("of_tools"),
    }
    other = program("other", setup("of_other", "", LONGER) + MAIN.format(name="other"))
    user = program("user", '#include "tools/setup.h"\n' + MAIN.format(name="user"))
    packages = {"tools": ("add_library(tools src/setup.cpp)", library), "other": other, "user": user}
    ends, _ = graph(packages, [("user", "tools")])
    assert ends == {"/other": [("/of_other", "certain")], "/user": [("/of_tools", "certain")]}


def test_constants_macros_and_defaults_of_another_package(graph):
    alpha = {
        "include/alpha/names.h": '#define TOPIC "alpha_macro"\nconst std::string NAME = "alpha_name";\n'
        'void more(ros::NodeHandle & nh, std::string name = "alpha_default");\n',
        "src/alpha.cpp": HEAD + '#include "alpha/names.h"\n'
        f"{MORE}"
        'int main(int argc, char ** argv) { ros::init(argc, argv, "alpha"); ros::NodeHandle nh; more(nh); }\n',
    }
    beta = {
        "include/beta/names.h": 'void more(ros::NodeHandle & nh, std::string name = "beta_default");\n',
        "src/beta.cpp": HEAD + '#include "beta/names.h"\n#include <outer/names.h>\n'
        f"{MORE}"
        'int main(int argc, char ** argv) { ros::init(argc, argv, "beta"); ros::NodeHandle nh; more(nh);\n'
        "  auto a = nh.advertise<std_msgs::String>(TOPIC, 1); auto b = nh.advertise<std_msgs::String>(NAME, 1); }\n",
    }
    packages = {
        name: (f"add_executable({name} src/{name}.cpp)", files) for name, files in (("alpha", alpha), ("beta", beta))
    }
    ends, _ = graph(packages)
    assert ends["/alpha"] == [("/alpha_default", "certain")]
    assert ("/beta_default", "certain") in ends["/beta"]
    assert not [name for name, _ in ends["/beta"] if "alpha" in name]


ROBOT = """class Robot {{ public:
  explicit Robot(ros::NodeHandle & nh) {{ pub_ = nh.advertise<std_msgs::String>("{name}_robot", 1); }}
  ros::Publisher pub_; }};
"""


def test_a_class_of_packages_that_nothing_names_is_none(graph):
    main = (
        'int main(int argc, char ** argv) {{ ros::init(argc, argv, "{name}"); ros::NodeHandle nh; Robot robot(nh); }}'
    )
    packages = {
        name: (
            f"add_executable({name} src/{name}.cpp)",
            {
                f"src/{name}.cpp": HEAD + '#include "robot.h"\n' + main.format(name=name),
                "src/robot.h": HEAD + ROBOT.format(name=name),
            },
        )
        for name in ("alpha", "beta")
    }
    packages["gamma"] = program("gamma", "#include <outer/robots.h>\n" + main.format(name="gamma"))
    ends, _ = graph(packages)
    assert ends == {
        "/alpha": [("/alpha_robot", "certain")],
        "/beta": [("/beta_robot", "certain")],
        "/gamma": [],
    }


SCRIPT = "#!/usr/bin/env python\nimport rospy\nfrom helpers import setup\nrospy.init_node('{name}')\nsetup()\n"
HELPERS = """import rospy
from std_msgs.msg import String
def setup():
    rospy.Publisher('{topic}', String, queue_size=1)
"""
INSTALL = "catkin_install_python(PROGRAMS {} DESTINATION ${{CATKIN_PACKAGE_BIN_DESTINATION}})"


def test_modules_of_python_mean_those_beside_them(graph):
    packages = {
        name: (
            INSTALL.format(f"scripts/{name}.py"),
            {f"scripts/{name}.py": SCRIPT.format(name=name), "scripts/helpers.py": HELPERS.format(topic=f"{name}_one")},
        )
        for name in ("alpha", "beta")
    }
    ends, _ = graph(packages)
    assert ends == {"/alpha": [("/alpha_one", "certain")], "/beta": [("/beta_one", "certain")]}


def test_a_module_of_another_package_that_nothing_names_is_none(graph):
    alpha = {"scripts/alpha.py": SCRIPT.format(name="alpha"), "scripts/helpers.py": HELPERS.format(topic="alpha_one")}
    beta = {"scripts/beta.py": SCRIPT.format(name="beta")}
    ends, _ = graph(
        {"alpha": (INSTALL.format("scripts/alpha.py"), alpha), "beta": (INSTALL.format("scripts/beta.py"), beta)}
    )
    assert ends == {"/alpha": [("/alpha_one", "certain")], "/beta": []}


def test_of_two_modules_beside_others_none_is_meant(graph):
    files = {
        "nodes/alpha.py": SCRIPT.format(name="alpha"),
        "one/helpers.py": HELPERS.format(topic="one"),
        "two/helpers.py": HELPERS.format(topic="two"),
    }
    ends, _ = graph({"alpha": (INSTALL.format("nodes/alpha.py"), files)})
    assert ends == {"/alpha": []}
