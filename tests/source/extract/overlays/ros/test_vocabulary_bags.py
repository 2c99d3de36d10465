import pytest

BAG = """
namespace rosbag {
class Bag {
public:
  explicit Bag(const std::string & filename) { open(filename); }
  void open(const std::string & name) { ros::NodeHandle n; pub_ = n.advertise<std_msgs::String>("inside", 1); }
  ros::Publisher pub_;
};
}
"""


@pytest.mark.parametrize("made", ['rosbag::Bag bag("a.bag");', "rosbag::Bag bag; bag.open(name);", "Recorder r;"])
def test_what_a_bag_does_inside_is_not_what_a_node_does(main_of, made: str):
    before = BAG + "struct Recorder { rosbag::Bag bag_; };\n"
    facts = main_of(f'{made} ros::NodeHandle n; auto pub = n.advertise<std_msgs::String>("own", 1);', before)
    assert [str(one.name) for one in facts.endpoints] == ["own"]


def test_another_class_of_that_name_is_followed(main_of):
    facts = main_of('Bag bag("a.bag");', BAG.replace("namespace rosbag {", "").rstrip()[:-1])
    assert [str(one.name) for one in facts.endpoints] == ["inside"]
