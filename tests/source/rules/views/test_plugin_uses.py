import pytest

from roslens.source.rules.views.plugin_uses import plugins_named

MANIFEST = """<package format="3"><name>arm</name><depend>{}</depend></package>"""


@pytest.fixture
def named(tmp_path, package_view):
    """The package and the type of each plug-in that a file names."""

    def look(text, path="config/arm.yaml", depends="rclcpp"):
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
        (tmp_path / "package.xml").write_text(MANIFEST.format(depends))
        return [one[:2] for one in plugins_named(package_view(tmp_path))]

    return look


@pytest.mark.parametrize(
    ("line", "package"),
    [
        ("type: joint_trajectory_controller/JointTrajectoryController", "joint_trajectory_controller"),
        ('plugin: "nav2_navfn_planner::NavfnPlanner"  # fast', "nav2_navfn_planner"),
        ("- kdl_kinematics_plugin/KDLKinematicsPlugin", "moveit_kinematics"),
        ("plugins: [dwb_core::DWBLocalPlanner, 'nav2_smac_planner/SmacPlanner2D']", "dwb_core"),
        ("type: position_controllers/JointTrajectoryController", "joint_trajectory_controller"),
        ("type: position_controllers/GripperActionController", "gripper_controllers"),
    ],
)
def test_a_value_that_is_the_type_of_a_known_plug_in_is_found(named, line, package):
    assert named(f"a:\n  {line}\n")[0][0] == package


@pytest.mark.parametrize(
    "line",
    [
        "# type: joint_trajectory_controller/JointTrajectoryController",
        "type: own_controllers/Arm",
        "topic: joint_trajectory_controller/joint_trajectory",
        "file: nav2_smac_planner/Readme.txt",
        "text: see nav2_smac_planner/SmacPlanner2D for more",
        "type: mock_components/GenericSystem",
    ],
)
def test_what_is_no_such_type_is_not(named, line):
    assert not named(f"a:\n  {line}\n")


def test_ros_1_has_another_package_for_grippers(named):
    (one,) = named("type: effort_controllers/GripperActionController\n", depends="roscpp")
    assert one == ("gripper_action_controller", "effort_controllers/GripperActionController")


@pytest.mark.parametrize(("folder", "amount"), [("urdf", 1), ("examples", 0)])
def test_a_robot_description_names_its_hardware(named, folder, amount):
    hardware = "<hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>"
    text = f"<robot><ros2_control>{hardware}</ros2_control></robot>"
    expected = [("gz_ros2_control", "gz_ros2_control/GazeboSimSystem")]
    assert named(text, f"{folder}/arm.urdf.xacro") == expected[:amount]
