from glob import glob

from setuptools import setup

package_name = "arm_ros2"

setup(
    name=package_name,
    version="1.0.0",
    packages=[package_name],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + package_name]),
        ("share/" + package_name, ["package.xml"]),
        ("share/" + package_name + "/launch", glob("launch/*")),
        ("share/" + package_name + "/config", glob("config/*")),
    ],
    install_requires=["setuptools"],
    entry_points={
        "console_scripts": [
            "arm = arm_ros2.arm:main",
            "gripper = arm_ros2.gripper:main",
            "commander = arm_ros2.commander:main",
        ]
    },
)
