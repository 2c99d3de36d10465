from glob import glob

from setuptools import setup

package_name = "demo_robot"

setup(
    name=package_name,
    version="0.1.0",
    packages=[package_name],
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        (f"share/{package_name}/launch", glob("launch/*.launch.py")),
    ],
    install_requires=["setuptools"],
    entry_points={
        "console_scripts": [
            "lidar = demo_robot.lidar:main",
            "odometry = demo_robot.odometry:main",
            "planner = demo_robot.planner:main",
        ],
    },
)
