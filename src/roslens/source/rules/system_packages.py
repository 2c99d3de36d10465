"""What CMake and sources call libraries, and what package.xml calls them: rosdep's keys, and names that need none.

Sources: the keys of rosdep (base.yaml, python.yaml of the ROS index), and the modules that CMake brings.
"""

from __future__ import annotations

import re
from functools import lru_cache

NEEDS_NO_KEY = frozenset({
    "Threads", "OpenMP", "PkgConfig", "PythonInterp", "PythonLibs", "Python", "Python2", "Python3", "CUDA",
    "CUDAToolkit", "CUDNN", "TENSORRT", "Doxygen", "Git", "MPI", "X11", "OpenGL", "GLUT", "Sanitizers", "CPack",
    "ExternalProject", "BLAS", "LAPACK", "UnixCommands", "Perl", "Java", "Matlab", "ament_cmake", "catkin",
})  # fmt: skip
"""Modules of CMake, compilers and what distributions bring; no key is expected."""

KEYS = {
    "Boost": ("boost", "libboost"),
    "Eigen3": ("eigen",),
    "Eigen": ("eigen",),
    "EIGEN": ("eigen",),
    "PCL": ("pcl", "libpcl"),
    "OpenCV": ("opencv", "cv_bridge", "vision_opencv"),
    "yaml-cpp": ("yaml-cpp", "yaml_cpp", "libyaml-cpp"),
    "YAML_CPP": ("yaml-cpp", "yaml_cpp", "libyaml-cpp"),
    "TinyXML": ("tinyxml",),
    "TinyXML2": ("tinyxml2",),
    "Qt5": ("qt5", "libqt5", "qtbase5", "libqt5-", "rviz", "rqt", "python_qt_binding", "python-qt5"),
    "Qt5Widgets": ("qt5", "libqt5", "qtbase5", "rviz", "rqt"),
    "Qt5Core": ("qt5", "libqt5", "qtbase5", "rviz", "rqt"),
    "gazebo": ("gazebo",),
    "GAZEBO": ("gazebo",),
    "SDL": ("sdl",),
    "SDL2": ("sdl2", "libsdl2"),
    "CURL": ("curl", "libcurl"),
    "GTest": ("gtest", "ament_cmake_gtest", "rosunit"),
    "Ceres": ("ceres", "libceres"),
    "GTSAM": ("gtsam",),
    "Protobuf": ("protobuf", "libprotobuf"),
    "SQLite3": ("sqlite3", "libsqlite3"),
    "ZLIB": ("zlib",),
    "BZip2": ("bzip2",),
    "LibXml2": ("libxml2",),
    "OpenSSL": ("libssl", "openssl"),
    "nlohmann_json": ("nlohmann-json",),
    "GeographicLib": ("geographiclib",),
    "ompl": ("ompl",),
    "octomap": ("octomap", "liboctomap"),
    "fcl": ("fcl", "libfcl"),
    "assimp": ("assimp",),
    "ASSIMP": ("assimp",),
    "Bullet": ("bullet",),
    "CGAL": ("cgal", "libcgal"),
    "realsense2": ("librealsense2",),
    "fmt": ("fmt", "libfmt"),
    "spdlog": ("spdlog", "libspdlog"),
    "glog": ("glog", "libgoogle-glog", "google-glog"),
    "Glog": ("glog", "libgoogle-glog", "google-glog"),
    "gflags": ("gflags", "libgflags"),
    "TBB": ("tbb", "libtbb"),
    "jsoncpp": ("jsoncpp", "libjsoncpp"),
    "GSL": ("gsl", "libgsl"),
    "FLANN": ("flann", "libflann"),
    "NLopt": ("nlopt", "libnlopt"),
    "Poco": ("poco", "libpoco"),
    "pybind11": ("pybind11", "python3-pybind11"),
    "CLI11": ("cli11",),
    "ZeroMQ": ("zmq", "libzmq", "cppzmq", "zeromq"),
    "cppzmq": ("cppzmq", "zmq", "libzmq"),
}
"""By the name for ``find_package``: beginnings of the keys that stand for it, without regard to case and ``-``."""

KEY_OF = {
    "Boost": "boost", "Eigen3": "eigen", "Eigen": "eigen", "EIGEN": "eigen", "PCL": "libpcl-all-dev",
    "OpenCV": "libopencv-dev", "yaml-cpp": "yaml-cpp", "YAML_CPP": "yaml-cpp", "TinyXML": "tinyxml",
    "TinyXML2": "tinyxml2", "Qt5": "qtbase5-dev", "Qt5Widgets": "libqt5-widgets", "Qt5Core": "libqt5-core",
    "SDL2": "sdl2", "CURL": "curl", "Ceres": "libceres-dev", "Protobuf": "protobuf-dev", "SQLite3": "libsqlite3-dev",
    "ZLIB": "zlib", "BZip2": "bzip2", "LibXml2": "libxml2", "OpenSSL": "libssl-dev",
    "nlohmann_json": "nlohmann-json-dev", "GeographicLib": "geographiclib", "octomap": "liboctomap-dev",
    "fcl": "libfcl-dev", "assimp": "assimp-dev", "ASSIMP": "assimp-dev", "Bullet": "bullet", "CGAL": "libcgal-dev",
    "fmt": "fmt", "spdlog": "spdlog", "glog": "libgoogle-glog-dev", "Glog": "libgoogle-glog-dev",
    "gflags": "libgflags-dev", "TBB": "tbb", "jsoncpp": "libjsoncpp-dev", "FLANN": "libflann-dev", "GSL": "gsl",
    "pybind11": "pybind11-dev",
}  # fmt: skip
"""The key of rosdep that declares a library, by the name for ``find_package``, where it has another name."""

OF_THE_CORE = frozenset({
    "ackermann_msgs", "actionlib", "actionlib_msgs", "ament_cmake_auto", "ament_cmake_python", "ament_cmake_ros",
    "ament_index_cpp", "ament_index_python", "angles", "behaviortree_cpp", "bond", "bondcpp", "builtin_interfaces",
    "camera_calibration_parsers", "camera_info_manager", "catkin", "class_loader", "controller_interface",
    "controller_manager", "costmap_2d", "cv_bridge", "diagnostic_msgs", "diagnostic_updater", "dynamic_reconfigure",
    "eigen_conversions", "filters", "gazebo_msgs", "gazebo_plugins", "gazebo_ros", "geographic_msgs", "geometry_msgs",
    "hardware_interface", "image_geometry", "image_transport", "interactive_markers", "joint_limits_interface",
    "joint_trajectory_controller", "joy", "kdl_parser", "laser_geometry", "launch", "launch_ros", "lifecycle_msgs",
    "map_msgs", "message_filters", "message_generation", "message_runtime", "move_base_msgs", "moveit_core",
    "moveit_msgs", "moveit_ros_planning_interface", "nav2_common", "nav2_core", "nav2_costmap_2d", "nav2_msgs",
    "nav2_util", "nav_core", "nav_msgs", "nodelet", "octomap_msgs", "octomap_ros", "pcl_conversions", "pcl_msgs",
    "pcl_ros", "pluginlib", "rcl", "rcl_interfaces", "rclcpp", "rclcpp_action", "rclcpp_components",
    "rclcpp_lifecycle", "rclpy", "rcpputils", "rcutils", "realtime_tools", "resource_retriever",
    "robot_state_publisher", "rosbag", "rosbag2_cpp", "rosbag2_py", "rosconsole", "roscpp", "rosgraph_msgs",
    "rosidl_default_generators", "rosidl_default_runtime", "roslib", "rospy", "rostest", "rviz", "rviz_common",
    "rviz_rendering", "sensor_msgs", "shape_msgs", "std_msgs", "std_srvs", "stereo_msgs", "tf", "tf2", "tf2_eigen",
    "tf2_geometry_msgs", "tf2_kdl", "tf2_msgs", "tf2_ros", "tf2_sensor_msgs", "tf_conversions", "tf_transformations",
    "topic_tools", "trajectory_msgs", "transmission_interface", "unique_identifier_msgs", "urdf", "vision_msgs",
    "visualization_msgs",
})  # fmt: skip
"""Packages of ROS that headers, modules and ``find_package`` name like themselves."""

HEADERS = {
    "roscpp": ("ros/",),
    "rosconsole": ("ros/console.h", "ros/assert.h", "ros/ros.h"),
    "rostime": ("ros/time.h", "ros/duration.h", "ros/rate.h", "ros/ros.h"),
    "roscpp_serialization": ("ros/",),
    "roscpp_traits": ("ros/",),
    "cpp_common": ("ros/",),
    "roslib": ("ros/package.h", "roslib"),
    "orocos_kdl": ("kdl/",),
    "kdl": ("kdl/",),
    "behaviortree_cpp": ("behaviortree_cpp", "behaviortree_cpp_v3"),
    "eigen3_cmake_module": ("Eigen",),
    "urdfdom_headers": ("urdf_model", "urdf_"),
    "image_geometry": ("image_geometry",),
    "pcl_ros": ("pcl", "pcl_ros"),
    "python_orocos_kdl": ("PyKDL",),
    "rosbag_storage": ("rosbag/",),
    "rclcpp_components": ("rclcpp_components_",),
    "rosidl_default_generators": ("rosidl_generate",),
    "tf2_bullet": ("LinearMath/",),
    "opencv2": ("opencv",),
}
"""By package: beginnings of the headers that it brings, where they differ from its name."""

BROUGHT_BY = {
    "navigation2": r"nav2_\w+|dwb_\w+|opennav_docking",
    "nav2_bringup": r"nav2_\w+|dwb_\w+|opennav_docking",
    "navigation": r"amcl|map_server|move_base|costmap_2d|\w+_local_planner|global_planner|navfn|fake_localization",
    "moveit": r"moveit_\w+|pilz_\w+",
    "moveit_planners": r"moveit_planners_\w+|pilz_\w+",
    "moveit_plugins": r"moveit_simple_controller_manager|moveit_ros_control_interface",
    "moveit_ros_move_group": r"moveit_kinematics",
    "controller_manager": r"hardware_interface|controller_interface",
    "gazebo_ros_pkgs": r"gazebo_\w+",
    "ros_gz": r"ros_gz_\w+",
    "ros_control": r"controller_\w+|hardware_interface|transmission_interface",
    "ros_controllers": r"\w+_controllers?",
    "ros2_control": r"controller_\w+|hardware_interface|transmission_interface|ros2controlcli",
    "ros2_controllers": r"\w+_(?:controllers?|broadcaster)",
    "position_controllers": r"forward_command_controller",
    "velocity_controllers": r"forward_command_controller",
    "effort_controllers": r"forward_command_controller",
    "image_pipeline": r"image_\w+|depth_image_proc|stereo_image_proc",
    "image_common": r"image_transport|camera_\w+",
    "perception_pcl": r"pcl_\w+",
    "tf2_ros_py": r"tf2_ros",
    "robot_model": r"urdf|kdl_parser|joint_state_publisher",
    "diagnostics": r"diagnostic_\w+|self_test",
    "desktop": r"rviz2?|rqt\w*|robot_state_publisher|joint_state_publisher\w*|tf2_ros|\w+_msgs",
    "ros_base": r"rosbag|tf2?_ros|tf|robot_state_publisher|nodelet|dynamic_reconfigure|actionlib",
}
"""By metapackage, as declared: what a launch file or an import may use because of it."""

_MESSAGES = re.compile(r"[a-z]\w*_(?:msgs|srvs|interfaces|actions)$")
_NAME = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)+$")


def is_ros_package(name: str) -> bool:
    """Return whether a name is certainly one of a package of ROS."""
    return name in OF_THE_CORE or _MESSAGES.match(name) is not None


def looks_like_ros_package(name: str) -> bool:
    """Return whether a name is written as those of packages of ROS are, and not as those of libraries."""
    return is_ros_package(name) or _NAME.match(name) is not None


@lru_cache(maxsize=1 << 14)
def stands_for(key: str, name: str) -> bool:
    """Return whether a declared dependency is what ``find_package`` or an import calls ``name``."""
    declared, wanted = _plain(key), _plain(name)
    if declared == wanted:
        return True
    if any(declared.startswith(_plain(begin)) for begin in KEYS.get(name, ())):
        return True
    if name in KEYS and any(_plain(begin) in declared for begin in KEYS[name]):
        return True
    return _bare(declared) == _bare(wanted)


def brings(key: str, name: str) -> bool:
    """Return whether a declared dependency is a metapackage that has ``name`` in it."""
    pattern = BROUGHT_BY.get(key)
    return pattern is not None and re.fullmatch(pattern, name) is not None


def _plain(name: str) -> str:
    return name.lower().replace("-", "_")


def _bare(name: str) -> str:
    for begin in ("lib", "python3_", "python_"):
        name = name.removeprefix(begin)
    for end in ("_dev", "_vendor", "_cmake_module"):
        name = name.removesuffix(end)
    return name.rstrip("0123456789")
