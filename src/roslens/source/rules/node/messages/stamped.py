"""Messages of the standard packages whose data mean something at a time and in a frame only: those with a header."""

from __future__ import annotations

STAMPED = frozenset(
    (
        *("AccelStamped", "InertiaStamped", "PointStamped", "PolygonStamped", "PoseArray", "PoseStamped"),
        *("PoseWithCovarianceStamped", "QuaternionStamped", "TransformStamped", "TwistStamped"),
        *("TwistWithCovarianceStamped", "Vector3Stamped", "WrenchStamped"),
        *("GridCells", "OccupancyGrid", "Odometry", "Path"),
        *(
            "BatteryState",
            "CameraInfo",
            "CompressedImage",
            "FluidPressure",
            "Illuminance",
            "Image",
            "Imu",
            "JointState",
        ),
        *("Joy", "LaserScan", "MagneticField", "MultiDOFJointState", "MultiEchoLaserScan", "NavSatFix", "PointCloud"),
        *("PointCloud2", "Range", "RelativeHumidity", "Temperature", "TimeReference"),
        *("Marker", "ImageMarker", "InteractiveMarker"),
        *("DiagnosticArray", "DisparityImage"),
    )
)
"""Of geometry_msgs, nav_msgs, sensor_msgs, visualization_msgs, diagnostic_msgs, stereo_msgs."""

COMMANDS = frozenset(("JointState", "Odometry", "TwistStamped"))
"""Those that are sent as set points as well, to controllers and simulators that read no header."""

FAST = frozenset(
    (
        *("Image", "CompressedImage", "CameraInfo", "LaserScan", "PointCloud", "PointCloud2", "Imu", "JointState"),
        *(
            "Odometry",
            "Twist",
            "TwistStamped",
            "NavSatFix",
            "MagneticField",
            "Range",
            "Clock",
            "TFMessage",
            "WheelTicks",
        ),
    )
)
"""Messages that come ten times a second and more."""

SELDOM = frozenset(("PoseArray", "Path", "MarkerArray", "OccupancyGrid", "Octomap", "OctomapWithPose", "PlanningScene"))
"""Large, but sent now and then."""

LARGE = frozenset(
    (
        *("Image", "CompressedImage", "PointCloud", "PointCloud2", "LaserScan", "OccupancyGrid", "Path", "MarkerArray"),
        *(
            "DisparityImage",
            "MultiEchoLaserScan",
            "MultiArray",
            "PoseArray",
            "OctomapWithPose",
            "Octomap",
            "PlanningScene",
        ),
    )
)
"""Messages of which one has kilobytes to megabytes."""
