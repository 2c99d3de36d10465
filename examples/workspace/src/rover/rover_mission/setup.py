# Copyright 2025 The roslens authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""Install the nodes of rover_mission."""

from setuptools import find_packages, setup

PACKAGE = "rover_mission"

setup(
    name=PACKAGE,
    version="1.4.0",
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        (f"share/{PACKAGE}/missions", ["missions/meadow.yaml"]),
    ],
    install_requires=["setuptools", "pyyaml"],
    zip_safe=True,
    maintainer="Mira Holt",
    maintainer_email="rover@example.org",
    description="Reads missions from files, sends them to the rover and writes down how they went.",
    license="Apache-2.0",
    entry_points={"console_scripts": ["run_mission = rover_mission.run_mission:main"]},
)
