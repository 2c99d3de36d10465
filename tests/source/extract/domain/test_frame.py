from roslens.source.extract.domain.abstract_value import Made, NodeBuilder, Obj, Unknown
from roslens.source.extract.domain.frame import Frame, join
from roslens.source.extract.symbolic.reason import OfParameter
from roslens.source.extract.symbolic.text import Text, Written, unknown


def joined(before, value):
    names = {"a": before}
    join(names, {"a": value}, Written("x > 1"))
    return names["a"]


def test_what_is_the_same_stays():
    assert joined(Text.of("a"), Text.of("a")) == Text.of("a")
    assert joined(3, 3) == 3


def test_texts_are_one_or_the_other():
    text = joined(Text.of("no"), Text.of("yes"))
    assert (str(text), text.usual, text.known) == ("{yes if x > 1, else no}", None, None)


def test_a_parameter_stays_the_one_that_decides():
    text = joined(Text(), unknown(OfParameter("t"), parameter="t", default="x"))
    assert text.holes[0].parameter == "t"


def test_numbers_and_what_is_unknown():
    assert isinstance(joined(False, True), Unknown)
    assert isinstance(joined(True, Unknown("why")), Unknown)
    assert str(joined(Text.of("a"), Unknown("why"))) == "{{why} if x > 1, else a}"
    assert joined(Unknown("why"), Text.of("a")).known is None


def test_what_was_made_under_a_condition_is_not_there_for_sure():
    made = Made(NodeBuilder("A", "a", 1, "ros2"), 0)
    assert joined(None, made).certain is False
    assert made.certain


def test_results_under_conditions():
    frame = Frame("a.cpp", "f")
    frame.give(Text.of("a"), [Written("x")])
    frame.give(Text.of("b"))
    assert frame.returned
    assert frame.result.known is None
    once = Frame("a.cpp", "f")
    once.give(Text.of("a"))
    assert once.result == Text.of("a")


def test_members_are_part_of_a_snapshot():
    thing = Obj("A", None, {"a": 1})
    frame = Frame("a.cpp", "f", thing, {"b": 2})
    before = frame.snapshot()
    thing.fields["a"], frame.names["b"] = 3, 4
    frame.restore(before)
    assert (thing.fields, frame.names) == ({"a": 1}, {"b": 2})


def test_what_is_left_over_goes_to_parameters_with_stars(units):
    text = """
import rospy
from std_msgs.msg import String
def topic(*args):
    return '/' + '/'.join(('robot',) + args)
def make(name, *rest, **options):
    rospy.Publisher(name + rest[0] + options['end'], String)
def only(name, *rest, end='_default'):
    rospy.Publisher(name + end, String)
if __name__ == '__main__':
    rospy.init_node('a')
    rospy.Publisher(topic('mission', 'list'), String)
    make('b', '_c', end='_d')
    only('e', 'f', 'g')
"""
    (facts,) = units(a_py=text)
    assert sorted(str(one.name) for one in facts.endpoints) == ["/robot/mission/list", "b_c_d", "e_default"]
