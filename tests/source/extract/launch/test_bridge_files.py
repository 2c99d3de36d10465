import pytest

from roslens.source.extract.facts.launched import Launched, Setting
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch.bridge_files import with_bridges
from roslens.source.extract.symbolic.text import Text, unknown

PLACE = Evidence("launch/a.launch.py", 3)
FILE = b"""\
- ros_topic_name: cmd_vel
  gz_topic_name: /model/cmd_vel
  ros_type_name: geometry_msgs/msg/Twist
  gz_type_name: gz.msgs.Twist
  direction: ROS_TO_GZ
- {gz_topic_name: /scan, ros_type_name: sensor_msgs/msg/LaserScan, gz_type_name: gz.msgs.LaserScan,
   direction: GZ_TO_ROS}
- {topic_name: both, ros_type_name: std_msgs/msg/Bool, gz_type_name: gz.msgs.Boolean}
- {topic_name: other, ros_type_name: std_msgs/msg/Bool, gz_type_name: gz.msgs.Boolean, direction: UP}
- {topic_name: typeless}
- text
"""


class Files:
    def __init__(self, content):
        self.held = content

    def package(self, name):
        return None

    def content(self, path):
        return self.held if path == "config/bridge.yaml" else None


def words(content=FILE, package="ros_gz_bridge", value="config/bridge.yaml"):
    setting = Setting(Text.of("config_file"), Text.of(value) if isinstance(value, str) else value, PLACE)
    known = (Text.of("/a@std_msgs/msg/Bool@gz.msgs.Boolean"),)
    launched = Launched(Text.of(package), Text.of("parameter_bridge"), PLACE, settings=(setting,), arguments=known)
    return [str(one) for one in with_bridges(launched, Files(content)).arguments[1:]]


def test_each_entry_is_a_bridge():
    assert words() == [
        "cmd_vel@geometry_msgs/msg/Twist]gz.msgs.Twist",
        "/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan",
        "both@std_msgs/msg/Bool@gz.msgs.Boolean",
    ]


@pytest.mark.parametrize("content", [b"a: 1\n", b"[\n", b"", b"\xff"])
def test_a_file_that_lists_nothing_bridges_nothing(content):
    assert words(content) == []


def test_other_packages_and_files_that_are_not_known_bridge_nothing():
    assert words(package="other") == []
    assert words(value="gone.yaml") == []
    assert words(value=unknown("argument config")) == []
