"""Projects of ROS whose packages other repositories often carry as copies, with the names of these packages.

The index of ROS has every name once: where two packages of a project lie in a repository that is not its own, or the
only package of one, they are copies, or what somebody made of them. One of several alone may have its name by chance.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Set

_PROJECTS = {
    "navigation2": "costmap_queue dwb_core dwb_critics dwb_msgs dwb_plugins nav2_amcl nav2_behavior_tree nav2_behaviors"
    " nav2_bringup nav2_bt_navigator nav2_collision_monitor nav2_common nav2_constrained_smoother nav2_controller"
    " nav2_core nav2_costmap_2d nav2_dwb_controller nav2_graceful_controller nav2_lifecycle_manager nav2_loopback_sim"
    " nav2_map_server nav2_mppi_controller nav2_msgs nav2_navfn_planner nav2_planner nav2_recoveries"
    " nav2_regulated_pure_pursuit_controller nav2_rotation_shim_controller nav2_route nav2_rviz_plugins"
    " nav2_simple_commander nav2_smac_planner nav2_smoother nav2_system_tests nav2_theta_star_planner nav2_util"
    " nav2_velocity_smoother nav2_voxel_grid nav2_waypoint_follower nav_2d_msgs nav_2d_utils navigation2"
    " opennav_docking opennav_docking_bt opennav_docking_core",
    "navigation": "amcl base_local_planner carrot_planner clear_costmap_recovery costmap_2d dwa_local_planner"
    " fake_localization global_planner map_server move_base move_slow_and_clear nav_core navfn navigation"
    " rotate_recovery robot_pose_ekf",
    "moveit2": "chomp_motion_planner moveit_configs_utils moveit_core moveit_hybrid_planning moveit_kinematics"
    " moveit_planners moveit_planners_chomp moveit_planners_ompl moveit_py moveit_ros moveit_ros_move_group"
    " moveit_ros_occupancy_map_monitor moveit_ros_perception moveit_ros_planning moveit_ros_planning_interface"
    " moveit_ros_robot_interaction moveit_ros_visualization moveit_ros_warehouse moveit_servo moveit_setup_assistant"
    " moveit_simple_controller_manager pilz_industrial_motion_planner",
    "moveit_task_constructor": "moveit_task_constructor_capabilities moveit_task_constructor_core"
    " moveit_task_constructor_demo moveit_task_constructor_msgs moveit_task_constructor_visualization",
    "ros2_control": "controller_interface controller_manager controller_manager_msgs hardware_interface joint_limits"
    " ros2_control transmission_interface",
    "gazebo_ros_pkgs": "gazebo_dev gazebo_msgs gazebo_plugins gazebo_ros gazebo_ros_control gazebo_ros_pkgs",
    "gazebo_ros2_control": "gazebo_ros2_control gazebo_ros2_control_demos",
    "gz_ros2_control": "gz_ros2_control gz_ros2_control_demos ign_ros2_control ign_ros2_control_demos",
    "ros_gz": "ros_gz ros_gz_bridge ros_gz_image ros_gz_interfaces ros_gz_sim ros_gz_sim_demos",
    "slam_toolbox": "slam_toolbox",
    "slam_gmapping": "gmapping slam_gmapping",
    "openslam_gmapping": "openslam_gmapping",
    "hector_slam": "hector_compressed_map_transport hector_geotiff hector_imu_attitude_to_tf hector_imu_tools"
    " hector_map_server hector_map_tools hector_mapping hector_marker_drawing hector_nav_msgs hector_slam"
    " hector_slam_launch hector_trajectory_server hector_geotiff_plugins hector_geotiff_launch",
    "cartographer_ros": "cartographer_ros cartographer_ros_msgs cartographer_rviz",
    "rtabmap_ros": "rtabmap_conversions rtabmap_demos rtabmap_launch rtabmap_msgs rtabmap_odom rtabmap_ros rtabmap_slam"
    " rtabmap_sync rtabmap_util rtabmap_viz",
    "robot_localization": "robot_localization",
    "teb_local_planner": "teb_local_planner teb_msgs",
    "costmap_converter": "costmap_converter costmap_converter_msgs",
    "m-explore": "explore_lite multirobot_map_merge map_merge",
    "frontier_exploration": "frontier_exploration",
    "rrt_exploration": "rrt_exploration",
    "turtlebot3": "turtlebot3_bringup turtlebot3_cartographer turtlebot3_description turtlebot3_example"
    " turtlebot3_navigation turtlebot3_navigation2 turtlebot3_node turtlebot3_slam turtlebot3_teleop turtlebot3",
    "turtlebot3_msgs": "turtlebot3_msgs",
    "turtlebot3_simulations": "turtlebot3_fake turtlebot3_fake_node turtlebot3_gazebo turtlebot3_simulations",
    "turtlebot3_manipulation": "turtlebot3_manipulation turtlebot3_manipulation_bringup"
    " turtlebot3_manipulation_description turtlebot3_manipulation_hardware turtlebot3_manipulation_moveit_config",
    "dynamixel-workbench": "dynamixel_workbench dynamixel_workbench_controllers dynamixel_workbench_msgs"
    " dynamixel_workbench_operators dynamixel_workbench_toolbox",
    "dynamixelsdk": "dynamixel_sdk dynamixel_sdk_custom_interfaces dynamixel_sdk_examples",
    "rplidar_ros": "rplidar_ros",
    "sllidar_ros2": "sllidar_ros2",
    "ydlidar_ros_driver": "ydlidar_ros_driver ydlidar_ros",
    "ydlidar_ros2_driver": "ydlidar_ros2_driver",
    "ldlidar_stl_ros2": "ldlidar_stl_ros2",
    "lslidar_ros": "lslidar_driver lslidar_msgs",
    "hls_lfcd_lds_driver": "hls_lfcd_lds_driver",
    "ld08_driver": "ld08_driver",
    "urg_node": "urg_node",
    "sick_scan": "sick_scan sick_scan2 sick_scan_xd",
    "velodyne": "velodyne velodyne_driver velodyne_laserscan velodyne_msgs velodyne_pointcloud",
    "velodyne_simulator": "velodyne_description velodyne_gazebo_plugins velodyne_simulator",
    "livox_ros_driver": "livox_ros_driver",
    "livox_ros_driver2": "livox_ros_driver2",
    "ros2_livox_simulation": "ros2_livox_simulation livox_laser_simulation",
    "lio-sam": "lio_sam",
    "lego-loam": "lego_loam cloud_msgs",
    "a-loam": "aloam_velodyne",
    "fast_lio": "fast_lio",
    "point_lio": "point_lio",
    "vins-fusion": "vins camera_models loop_fusion global_fusion",
    "laser_filters": "laser_filters",
    "scan_tools": "laser_scan_matcher laser_ortho_projector laser_scan_sparsifier laser_scan_splitter"
    " polar_scan_matcher"
    " scan_tools scan_to_cloud_converter ncd_parser",
    "rf2o_laser_odometry": "rf2o_laser_odometry",
    "ira_laser_tools": "ira_laser_tools",
    "realsense-ros": "realsense2_camera realsense2_camera_msgs realsense2_description realsense_gazebo_plugin",
    "ros_astra_camera": "astra_camera astra_camera_msgs astra_launch",
    "orbbecsdk_ros2": "orbbec_camera orbbec_camera_msgs orbbec_description",
    "zed-ros2-wrapper": "zed_components zed_interfaces zed_ros2 zed_wrapper",
    "iai_kinect2": "iai_kinect2 kinect2_bridge kinect2_calibration kinect2_registration kinect2_viewer",
    "usb_cam": "usb_cam",
    "libuvc_ros": "libuvc_camera libuvc_ros",
    "image_common": "camera_calibration_parsers camera_info_manager image_common image_transport polled_camera",
    "image_pipeline": "camera_calibration depth_image_proc image_pipeline image_proc image_publisher image_rotate"
    " image_view stereo_image_proc",
    "vision_opencv": "cv_bridge image_geometry opencv_tests vision_opencv",
    "darknet_ros": "darknet_ros darknet_ros_msgs",
    "aruco_ros": "aruco aruco_msgs aruco_ros",
    "apriltag_ros": "apriltag_ros apriltag_msgs",
    "ar_track_alvar": "ar_track_alvar ar_track_alvar_msgs",
    "find_object_2d": "find_object_2d",
    "web_video_server": "web_video_server",
    "rosbridge_suite": "rosapi rosapi_msgs rosbridge_library rosbridge_msgs rosbridge_server rosbridge_suite",
    "rosserial": "rosserial rosserial_arduino rosserial_client rosserial_msgs rosserial_python rosserial_server",
    "joystick_drivers": "joy joystick_drivers ps3joy spacenav_node wiimote joy_linux sdl2_vendor",
    "teleop_twist_keyboard": "teleop_twist_keyboard",
    "teleop_twist_joy": "teleop_twist_joy",
    "twist_mux": "twist_mux twist_mux_msgs",
    "imu_tools": "imu_complementary_filter imu_filter_madgwick imu_tools rviz_imu_plugin",
    "nmea_navsat_driver": "nmea_navsat_driver",
    "mavros": "libmavconn mavros mavros_extras mavros_msgs",
    "px4_msgs": "px4_msgs",
    "universal_robot": "ur_description ur_e_description ur_gazebo ur_kinematics ur10_moveit_config ur3_moveit_config"
    " ur5_moveit_config ur10e_moveit_config ur3e_moveit_config ur5e_moveit_config ur_msgs universal_robots",
    "universal_robots_ros2_driver": "ur ur_bringup ur_calibration ur_controllers ur_dashboard_msgs ur_moveit_config"
    " ur_robot_driver",
    "ur_modern_driver": "ur_modern_driver",
    "robotiq": "robotiq_2f_140_gripper_visualization robotiq_2f_85_gripper_visualization robotiq_3f_gripper_control"
    " robotiq_ft_sensor robotiq_modbus_rtu robotiq_ethercat",
    "franka_ros": "franka_control franka_description franka_gripper franka_hw franka_msgs franka_ros franka_gazebo"
    " franka_visualization franka_example_controllers",
    "roboticsgroup_gazebo_plugins": "roboticsgroup_gazebo_plugins roboticsgroup_upatras_gazebo_plugins",
    "gazebo-pkgs": "gazebo_grasp_plugin gazebo_test_tools gazebo_version_helpers gazebo_world_plugin_loader",
    "gazebo_ros_link_attacher": "gazebo_ros_link_attacher",
    "gazebo_mimic": "gazebo_mimic",
    "trac_ik": "trac_ik trac_ik_kinematics_plugin trac_ik_lib trac_ik_python trac_ik_examples",
    "octomap_mapping": "octomap_mapping octomap_server",
    "grid_map": "grid_map grid_map_core grid_map_costmap_2d grid_map_cv grid_map_demos grid_map_filters grid_map_loader"
    " grid_map_msgs grid_map_octomap grid_map_pcl grid_map_ros grid_map_rviz_plugin grid_map_sdf"
    " grid_map_visualization",
    "spatio_temporal_voxel_layer": "spatio_temporal_voxel_layer",
    "pointcloud_to_laserscan": "pointcloud_to_laserscan",
    "depthimage_to_laserscan": "depthimage_to_laserscan",
    "perception_pcl": "pcl_conversions pcl_ros perception_pcl",
    "behaviortree.cpp": "behaviortree_cpp behaviortree_cpp_v3",
    "jackal": "jackal_control jackal_description jackal_msgs jackal_navigation jackal_tutorials",
    "husky": "husky_base husky_bringup husky_control husky_description husky_desktop husky_gazebo husky_msgs"
    " husky_navigation husky_robot husky_simulator husky_viz",
    "kobuki": "kobuki kobuki_auto_docking kobuki_bumper2pc kobuki_capabilities kobuki_controller_tutorial"
    " kobuki_description kobuki_keyop kobuki_node kobuki_random_walker kobuki_rapps kobuki_safety_controller"
    " kobuki_testsuite",
    "yocs_msgs": "yocs_msgs",
    "aws-robomaker-small-house-world": "aws_robomaker_small_house_world",
    "aws-robomaker-small-warehouse-world": "aws_robomaker_small_warehouse_world",
}  # fmt: skip

PROJECT_OF = {package: project for project, packages in _PROJECTS.items() for package in packages.split()}
"""Name of the repository that a package is published from, in lower case, by the name of the package."""
_ALONE = frozenset(packages for packages in _PROJECTS.values() if " " not in packages)


def published_elsewhere(names: Iterable[str], homes: Set[str]) -> Mapping[str, str]:
    """Return those of the packages of a workspace that are of projects of others, with the project of each.

    Args:
        names: of the packages.
        homes: names that the repository of the workspace has, in lower case.
    """
    known = {name: PROJECT_OF[name] for name in names if name in PROJECT_OF and PROJECT_OF[name] not in homes}
    counts = Counter(known.values())
    return {name: project for name, project in known.items() if counts[project] > 1 or name in _ALONE}
