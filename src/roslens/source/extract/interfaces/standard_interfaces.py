"""The interfaces of packages that every robot has and whose definitions are in few workspaces, by name.

They say which of several modules has a name that is imported whole: ``from sensor_msgs.msg import *``. Names are those
of all releases of ros/common_msgs, ros/std_msgs and ros2/common_interfaces and of what ROS itself is made of.
"""

from __future__ import annotations

_NAMES = {
    ("action_msgs", "msg"): """
        GoalInfo GoalStatus GoalStatusArray""",
    ("action_msgs", "srv"): """
        CancelGoal""",
    ("actionlib_msgs", "msg"): """
        GoalID GoalStatus GoalStatusArray""",
    ("builtin_interfaces", "msg"): """
        Duration Time""",
    ("diagnostic_msgs", "msg"): """
        DiagnosticArray DiagnosticStatus KeyValue""",
    ("diagnostic_msgs", "srv"): """
        AddDiagnostics SelfTest""",
    ("geometry_msgs", "msg"): """
        Accel AccelStamped AccelWithCovariance AccelWithCovarianceStamped Inertia InertiaStamped Point Point32
        PointStamped Polygon PolygonInstance PolygonInstanceStamped PolygonStamped Pose Pose2D PoseArray
        PoseStamped PoseWithCovariance PoseWithCovarianceStamped Quaternion QuaternionStamped Transform
        TransformStamped Twist TwistStamped TwistWithCovariance TwistWithCovarianceStamped Vector3
        Vector3Stamped VelocityStamped Wrench WrenchStamped""",
    ("lifecycle_msgs", "msg"): """
        State Transition TransitionDescription TransitionEvent""",
    ("lifecycle_msgs", "srv"): """
        ChangeState GetAvailableStates GetAvailableTransitions GetState""",
    ("nav_msgs", "msg"): """
        GridCells MapMetaData OccupancyGrid Odometry Path""",
    ("nav_msgs", "srv"): """
        GetMap GetPlan LoadMap SetMap""",
    ("rcl_interfaces", "msg"): """
        FloatingPointRange IntegerRange ListParametersResult Log LoggerLevel Parameter ParameterDescriptor
        ParameterEvent ParameterEventDescriptors ParameterType ParameterValue SetLoggerLevelsResult
        SetParametersResult""",
    ("rcl_interfaces", "srv"): """
        DescribeParameters GetLoggerLevels GetParameterTypes GetParameters ListParameters SetLoggerLevels
        SetParameters SetParametersAtomically""",
    ("rosgraph_msgs", "msg"): """
        Clock Log TopicStatistics""",
    ("sensor_msgs", "msg"): """
        BatteryState CameraInfo ChannelFloat32 CompressedImage FluidPressure Illuminance Image Imu JointState
        Joy JoyFeedback JoyFeedbackArray LaserEcho LaserScan MagneticField MultiDOFJointState MultiEchoLaserScan
        NavSatFix NavSatStatus PointCloud PointCloud2 PointField Range RegionOfInterest RelativeHumidity
        Temperature TimeReference""",
    ("sensor_msgs", "srv"): """
        SetCameraInfo""",
    ("shape_msgs", "msg"): """
        Mesh MeshTriangle Plane SolidPrimitive""",
    ("std_msgs", "msg"): """
        Bool Byte ByteMultiArray Char ColorRGBA Duration Empty Float32 Float32MultiArray Float64
        Float64MultiArray Header Int16 Int16MultiArray Int32 Int32MultiArray Int64 Int64MultiArray Int8
        Int8MultiArray MultiArrayDimension MultiArrayLayout String Time UInt16 UInt16MultiArray UInt32
        UInt32MultiArray UInt64 UInt64MultiArray UInt8 UInt8MultiArray""",
    ("std_srvs", "srv"): """
        Empty SetBool Trigger""",
    ("stereo_msgs", "msg"): """
        DisparityImage""",
    ("tf", "msg"): """
        tfMessage""",
    ("tf2_msgs", "msg"): """
        TF2Error TFMessage""",
    ("tf2_msgs", "srv"): """
        FrameGraph""",
    ("trajectory_msgs", "msg"): """
        JointTrajectory JointTrajectoryPoint MultiDOFJointTrajectory MultiDOFJointTrajectoryPoint""",
    ("visualization_msgs", "msg"): """
        ImageMarker InteractiveMarker InteractiveMarkerControl InteractiveMarkerFeedback InteractiveMarkerInit
        InteractiveMarkerPose InteractiveMarkerUpdate Marker MarkerArray MenuEntry MeshFile UVCoordinate""",
    ("visualization_msgs", "srv"): """
        GetInteractiveMarkers""",
}
STANDARD = {module: frozenset(names.split()) for module, names in _NAMES.items()}
"""By package and kind (``msg``, ``srv``) the names of interfaces."""
