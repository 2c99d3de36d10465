from __future__ import annotations

import pytest

from roslens.source.metrics.class_model.class_names import ClassNames
from roslens.source.metrics.class_model.class_use import called_classes, used_classes

CPP = ClassNames(["nav::Grid", "nav::Planner", "nav::Planner::Node"], "::")


@pytest.mark.parametrize(
    ("written", "classes"),
    [
        ("Grid", {"nav::Grid"}),
        ("::nav::Grid", {"nav::Grid"}),
        ("GridPtr", {"nav::Grid"}),
        ("Grid::SharedPtr", {"nav::Grid"}),
        ("Grid::Mode", {"nav::Grid"}),
        ("Planner::Node", {"nav::Planner::Node"}),
        ("Node", {"nav::Planner::Node"}),
        ("ros::NodeHandle", {"ros::NodeHandle"}),
        ("ros::NodeHandle ::ros::NodeHandle", {"ros::NodeHandle"}),
        ("nav_msgs::Path nav_msgs::Path::ConstPtr nav_msgs::PathConstPtr nav_msgs::PathPtr", {"nav_msgs::Path"}),
        ("srv::SetMap::Request::SharedPtr srv::SetMap::Response", {"srv::SetMap"}),
        ("NodeHandle ros::NodeHandle", {"ros::NodeHandle"}),
        ("geometry::Pose tf::Pose", {"geometry::Pose", "tf::Pose"}),
        ("QWidget", {"QWidget"}),
        ("std::vector uint8_t T boost::shared_ptr std::vector::iterator string", set()),
        ("Ptr ::Ptr :: LayerPtr NodeT ActionT cloud mutex_ LIMIT M_PI iterator T K1", set()),
        ("costmap::Grid2D::mutex_t pcl::uint8_t", {"costmap::Grid2D"}),
        ("WallDuration QString Vector3", {"WallDuration", "QString", "Vector3"}),
    ],
)
def test_names_of_cpp_mean_classes(written, classes):
    assert used_classes(written.split(), "nav::Planner", CPP, "cpp") == classes


@pytest.mark.parametrize(
    ("written", "classes"),
    [
        ("Grid", {"nav.grid.Grid"}),
        ("grid.Grid", {"nav.grid.Grid"}),
        ("rospy.Publisher Publisher", {"rospy.Publisher"}),
        ("SetMap.Request SetMap.Response srv.SetMap", {"srv.SetMap"}),
        ("int List typing.Any ValueError", set()),
        ("Thread", {"Thread"}),
    ],
)
def test_names_of_python_mean_classes(written, classes):
    known = ClassNames(["nav.grid.Grid", "nav.planner.Planner"], ".")
    assert used_classes(written.split(), "nav.planner.Planner", known, "python") == classes


@pytest.mark.parametrize(
    ("syntax", "calls", "found"),
    [
        ("cpp", ["Clock::now", "free", "util::helper"], {"Clock"}),
        ("cpp", ["n::Clock::now", "ros::Time::now", "Eigen::umeyama", "std::chrono::steady_clock::now"],
         {"n::Clock", "ros::Time"}),
        ("python", ["Clock.now", "rospy.Time.now", "rospy.spin", "free"], {"Clock", "rospy.Time"}),
    ],
)  # fmt: skip
def test_classes_whose_static_functions_are_called(syntax, calls, found):
    separator = "::" if syntax == "cpp" else "."
    known = ClassNames([f"n{separator}Clock"], separator)
    assert called_classes(calls, f"n{separator}User", known, syntax) == found
