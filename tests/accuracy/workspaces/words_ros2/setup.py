from glob import glob

from setuptools import setup

package_name = "words_ros2"

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
            "relay = words_ros2.relay:main",
            "record = words_ros2.record:main",
            "sources = words_ros2.sources:main",
            "count = words_ros2.count:main",
        ]
    },
)
