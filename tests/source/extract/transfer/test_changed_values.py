import pytest


def cpp(main_of, body):
    return [str(one.name) for one in main_of(f"{body}\nnh.advertise<std_msgs::String>(t, 1);").endpoints]


def python(units, body):
    inside = "\n    ".join(body.split("\n"))
    text = f"""
import rospy
from std_msgs.msg import String
if __name__ == '__main__':
    rospy.init_node('a')
    {inside}
    rospy.Publisher(t, String)
"""
    (facts,) = units(a_py=text)
    return [str(one.name) for one in facts.endpoints]


@pytest.mark.parametrize(
    ("body", "name"),
    [
        ('std::string t("map"); t.append("_raw");', "map_raw"),
        ('std::string t; t.append("a").append("b");', "ab"),
        ('std::string t = "in"; t.push_back(\'k\');', "ink"),
        ('std::string t = "in"; t.insert(0, "be");', "bein"),
        ('std::string t = "in"; t.replace(0, 1, "o");', "on"),
        ('std::string t = "inner"; t.erase(2);', "in"),
        ('std::string t = "inner"; t.erase(1, 3);', "ir"),
        ('std::string t = "in"; t.assign("out");', "out"),
        ('std::string t = "in"; t.clear(); t += "z";', "z"),
        ('std::string t = "in/"; t.pop_back();', "in"),
        ('std::string t = "inner"; t.resize(2);', "in"),
        ('std::string t = "in", u = "out"; t.swap(u);', "out"),
        ('std::string t = "in"; t[0] = \'o\';', "on"),
        ('std::string t = "in"; t.insert(t.begin(), \'x\');', "{in, which insert() changed}"),
        ('std::string t = "in"; t.erase(f());', "{in, which erase() changed}"),
        ('std::string t = "a.b"; t.replace(t.find("."), 1, "_");', "a_b"),
        ('QString t = "a.b"; t.replace(".", "/");', "a/b"),
        ("std::string t(3, 'q');", "qqq"),
        ('std::string u("abcdef"); std::string t(u, 1, 2);', "bc"),
        ('std::string t("abc", 2);', "{a part of abc}"),
    ],
)  # fmt: skip
def test_texts_of_cpp_are_changed_in_place(main_of, body, name):
    assert cpp(main_of, body) == [name]


def test_a_text_that_one_way_changes_is_one_or_the_other(main_of):
    assert cpp(main_of, 'std::string t = "in"; if (f()) t.append("side");') == ["{inside if f(), else in}"]


def test_a_list_that_a_parameter_is_has_no_sign_behind_it(main_of):
    body = 'std::vector<std::string> t; nh.getParam("names", t); t.push_back("more");'
    (name,) = cpp(main_of, body)
    assert name.startswith("{")


@pytest.mark.parametrize(
    ("body", "name"),
    [
        ("l = ['a', 'b']\nl[0] = 'c'\nt = l[0]", "c"),
        ("l = ['a']\nl.insert(0, 'first')\nt = l[0]", "first"),
        ("l = ['a']\nl.extend(['b'])\nt = l[-1]", "b"),
        ("l = ['a', 'b']\nu = l.pop()\nt = l[-1] + u", "ab"),
        ("l = ['a', 'b']\nl.reverse()\nt = l[0]", "b"),
        ("l = ['b', 'a']\nl.sort()\nt = l[0]", "a"),
        ("l = ['a', 'b']\nl.remove('a')\nt = l[0]", "b"),
        ("l = ['a', 'b']\ndel l[0]\nt = l[0]", "b"),
        ("l = ['a', 'b']\nl[f()] = 'c'\nt = l[0]", "{an item of a list that was changed}"),
        ("l = ['a', 'b']\nl.sort(key=f)\nt = l[0]", "{an item of a list that sort() changed}"),
        ("d = {'k': 'v'}\nd.update({'k': 'u'})\nt = d['k']", "u"),
        ("d = {'k': 'v'}\nd.update(k='u')\nt = d['k']", "u"),
        ("d = {'k': 'v'}\nd.update(f())\nt = d['k']", "{an item of a dictionary that update() changed}"),
        ("d = {'k': 'v'}\nd.pop('k')\nt = d.get('k', 'none')", "none"),
        ("d = {'k': 'v'}\ndel d['k']\nt = d.get('k', 'none')", "none"),
        ("d = {}\nt = d.setdefault('k', 'v')", "v"),
        ("d = {'k': 'v'}\nd.clear()\nt = d.get('k', 'none')", "none"),
        ("t = 'x' + str(3 << 1)", "x{`(3 << 1)`}"),
    ],
)
def test_lists_and_tables_are_changed_in_place(units, body, name):
    (found,) = python(units, body)
    assert found == name or (name.startswith("x{") and found.startswith("x{"))


def test_an_item_that_one_way_changes_is_one_or_the_other(units):
    assert python(units, "d = {'k': 'v'}\nif f():\n    d['k'] = 'u'\nt = d['k']") == ["{u if f(), else v}"]
    (found,) = python(units, "l = ['a', 'b']\nif f():\n    l.pop()\nt = l[0]")
    assert found.startswith("{an item of a list")


@pytest.mark.parametrize(
    ("body", "names"),
    [
        ('P p; if (f()) p.topic = "b"; nh.advertise<std_msgs::String>(p.topic, 1);', ["{b if f(), else a}"]),
        ('if (f()) { P p; p.topic = "b"; nh.advertise<std_msgs::String>(p.topic, 1); }', ["b"]),
        ('P p; p.topic = "b"; nh.advertise<std_msgs::String>(p.topic, 1);', ["b"]),
    ],
)
def test_a_member_that_one_way_sets_is_one_or_the_other(main_of, body, names):
    found = main_of(body, 'struct P { std::string topic; P() : topic("a") {} };').endpoints
    assert [str(one.name) for one in found] == names
