import pytest

from roslens.source.extract.symbolic.condition import as_written

BEFORE = "#include <nodelet/loader.h>"


def loads(facts):
    return [
        (str(one.name), str(one.type), [(str(a), str(b)) for a, b in one.remaps], as_written(one.conditions))
        for one in facts.loads
    ]


def test_what_a_program_loads_with_the_remappings_of_that_time(main_of):
    body = """
nodelet::Loader manager(false);
nodelet::M_string remappings;
nodelet::V_string my_argv;
manager.load(ros::this_node::getName() + "_one", "pkg/one", remappings, my_argv);
remappings["image"] = ros::names::resolve("image_color");
manager.load("two", "pkg/two", remappings, my_argv);
"""
    facts = main_of(body, BEFORE)
    assert loads(facts) == [
        ("{full name of the node}_one", "pkg/one", [], ()),
        ("two", "pkg/two", [("image", "image_color")], ()),
    ]
    assert facts.endpoints == ()


@pytest.mark.parametrize("declared", ["std::map<std::string, std::string> m;", "ros::M_string m;"])
def test_a_pointer_to_a_loader_and_other_maps(main_of, declared):
    body = f'boost::shared_ptr<nodelet::Loader> l(new nodelet::Loader(false)); {declared} m["a"] = "b";'
    facts = main_of(body + 'std::vector<std::string> v; l->load("n", "p/T", m, v);', BEFORE)
    assert loads(facts) == [("n", "p/T", [("a", "b")], ())]


def test_what_may_be_remapped_is_unknown(main_of):
    body = 'nodelet::Loader l(false); nodelet::M_string m; if (argc > 2) m["a"] = "b"; l.load("n", "p/T", m, {});'
    assert loads(main_of(body, BEFORE))[0][2] == [("a", "{b if argc > 2}")]
    assert loads(main_of('nodelet::Loader l(false); l.load("n", "p/T", given(), {});', BEFORE))[0][2] == [
        ("{remappings of the nodelet}", "{remappings of the nodelet}")
    ]


def test_what_is_loaded_under_a_condition(main_of):
    body = 'bool on; nh.getParam("on", on); nodelet::Loader l(false); ros::M_string m;'
    body += 'if (on) { l.load("n", "p/T", m, {}); }'
    assert loads(main_of(body, BEFORE))[0][3] == ("on",)


@pytest.mark.parametrize(
    ("given", "services"),
    [
        ("", ["~/list", "~/load_nodelet", "~/unload_nodelet"]),
        ("(false)", []),
        ('(ros::NodeHandle("/m"))', ["/m/list", "/m/load_nodelet", "/m/unload_nodelet"]),
    ],
)
def test_a_loader_may_have_the_services_of_a_manager(main_of, given, services):
    facts = main_of(f"nodelet::Loader l{given};", BEFORE)
    assert [str(one.name) for one in facts.endpoints] == services


def test_a_loader_of_which_nobody_knows(main_of):
    facts = main_of('bool api; nh.getParam("api", api); nodelet::Loader l(api);', BEFORE)
    assert facts.endpoints == ()
    assert [reason for _, reason in facts.unresolved] == [
        "whether this loader of nodelets has the services of a manager depends on {parameter api}"
    ]
