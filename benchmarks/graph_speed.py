"""The figures of docs/costs.md on the speed of the computation graph.

    python benchmarks/graph_speed.py CORPUS

CORPUS is a folder with clones; its figures are of ros_comm 845f746, navigation 9ad6441 and
navigation2 a3a9704. Their C and C++ files and manifests are copied to a temporary folder; there run in
turn, each as a whole process of its own with one job: metrics alone, metrics and the facts of all nodes
with the same parse, facts alone, and facts again with everything in the cache. Then a configuration of
60 nodes of 20 packages is assembled: by a new process without a cache, by one with it, and again in the same process.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path

from measure import in_turn, middle, ratio
from source_speed import copied

NODES = 60
PER_PACKAGE = 3


def work(what: str, root: Path) -> None:
    """Do one piece of work in this process."""
    from roslens.source.extract.workspace.extraction import extract
    from roslens.source.pipeline import Clock, analyse
    from roslens.source.settings import SourceSettings
    from roslens.store.cache import Cache
    from roslens.store.runs import Store

    folder, now, settings = root / ".roslens", time.time(), SourceSettings()
    with Cache.open(folder / "cache.sqlite") as cache:
        if what != "facts":
            with Store.open(folder / "store.sqlite") as store:
                clock = Clock("", now)
                programs = what == "both"
                analyse([root], settings, store=store, cache=cache, clock=clock, base=root, jobs=1, programs=programs)
        if what != "metrics":
            extract([root], settings, cache=cache, now_s=now, jobs=1)


def made(root: Path) -> str:
    """Write a workspace whose launch file starts 60 nodes; return the path of the file."""
    lines = ["from launch import LaunchDescription", "from launch_ros.actions import Node"]
    lines += [
        "from launch.substitutions import PathJoinSubstitution",
        "from launch_ros.substitutions import FindPackageShare",
    ]
    lines += [
        "",
        "def generate_launch_description():",
        "    params = PathJoinSubstitution([FindPackageShare('p0'), 'config', 'all.yaml'])",
    ]
    lines += ["    return LaunchDescription(["]
    values = []
    for number in range(NODES):
        package, name = f"p{number // PER_PACKAGE}", f"node_{number}"
        folder = root / package
        (folder / "src").mkdir(parents=True, exist_ok=True)
        (folder / "src" / f"{name}.cpp").write_text(_CODE.replace("NUMBER", str(number)))
        (folder / "package.xml").write_text(_MANIFEST.format(package))
        with (folder / "CMakeLists.txt").open("a") as file:
            file.write(f"add_executable({name} src/{name}.cpp)\ninstall(TARGETS {name} DESTINATION lib/{package})\n")
        lines.append(
            f"        Node(package='{package}', executable='{name}', name='{name}', namespace='robot_{number % 6}',"
            f" parameters=[params], remappings=[('in', '/out_{number - 1}')]),"
        )
        values += [f"/**/{name}:", "  ros__parameters:", "    topic: changed"]
        values += [f"    value_{place}: {place}.5" for place in range(20)]
    (root / "p0" / "config").mkdir()
    (root / "p0" / "config" / "all.yaml").write_text("\n".join(values) + "\n")
    with (root / "p0" / "CMakeLists.txt").open("a") as file:
        file.write("install(DIRECTORY launch config DESTINATION share/p0)\n")
    (root / "p0" / "launch").mkdir()
    launch = root / "p0" / "launch" / "all.launch.py"
    launch.write_text("\n".join([*lines, "    ])", ""]))
    return launch.relative_to(root).as_posix()


_MANIFEST = """<package format="3"><name>{}</name><version>1.0.0</version><depend>rclcpp</depend>
<export><build_type>ament_cmake</build_type></export></package>
"""
_CODE = """#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"
class NodeNUMBER : public rclcpp::Node {
public:
  NodeNUMBER() : rclcpp::Node("node") {
    const std::string topic = declare_parameter<std::string>("topic", "out_NUMBER");
    for (int i = 0; i < 20; ++i) values_.push_back(declare_parameter("value_" + std::to_string(i), 1.0));
    publisher_ = create_publisher<std_msgs::msg::String>("/" + topic, rclcpp::QoS(10).reliable());
    subscription_ = create_subscription<std_msgs::msg::String>("in", 10, [this](std_msgs::msg::String::SharedPtr m) {
      publisher_->publish(*m);
    });
    service_ = create_service<std_srvs::srv::Trigger>("~/reset", std::bind(&NodeNUMBER::reset, this, _1, _2));
    timer_ = create_wall_timer(std::chrono::milliseconds(100), std::bind(&NodeNUMBER::tick, this));
  }
  void tick() { publisher_->publish(std_msgs::msg::String()); }
  void reset(Request::SharedPtr, Response::SharedPtr) { values_.clear(); }
};
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<NodeNUMBER>());
}
"""


def assembling(root: Path, launch: str, rounds: int) -> tuple[list[float], int, int]:
    """Return the CPU seconds of each time, and how many nodes and endpoints there are."""
    from roslens.source.extract.configuration.assemble import assemble
    from roslens.source.extract.configuration.assemble_units import KnownUnits
    from roslens.source.extract.facts.files import FolderFiles
    from roslens.source.extract.launch.launch_ros2 import evaluate_ros2
    from roslens.source.extract.workspace.extraction import extract
    from roslens.source.settings import SourceSettings
    from roslens.store.cache import Cache

    took, nodes, endpoints = [], 0, 0
    for _ in range(rounds):
        begun = time.process_time()
        with Cache.open(root / ".roslens" / "cache.sqlite") as cache:
            found = extract([root], SourceSettings(), cache=cache, now_s=time.time(), jobs=1)
        files = FolderFiles(root, {package.name: package.path for package in found.packages})
        units = KnownUnits({name: build.targets for name, build in found.builds.items()}, found.nodes)
        made = assemble(evaluate_ros2(launch, files), units, title=launch, files=files)
        took.append(time.process_time() - begun)
        nodes, endpoints = len(made.nodes), sum(len(node.endpoints) for node in made.nodes)
    return took, nodes, endpoints


def facts(corpus: Path, scratch: Path, rounds: int) -> None:
    """Compare facts with metrics and print a table."""
    root = scratch / "ws"
    files = copied(corpus, root)
    own = [sys.executable, __file__, "--work"]
    commands = {
        "metrics alone": [*own, "metrics", str(root)],
        "metrics and facts": [*own, "both", str(root)],
        "facts alone": [*own, "facts", str(root)],
        "facts again": [*own, "facts", str(root)],
    }

    def forget() -> None:
        shutil.rmtree(root / ".roslens", ignore_errors=True)

    costs = in_turn(commands, rounds, dict.fromkeys(list(commands)[:3], forget))
    lines = sum(file.read_bytes().count(b"\n") for file in files)
    print(f"{len(files)} files, {lines} lines; medians of {rounds} rounds\n")
    print("| run | CPU s | wall s | peak MB | by metrics alone |")
    print("| --- | --- | --- | --- | --- |")
    for name, runs in costs.items():
        cpu, wall, peak = (middle([cost[index] for cost in runs]) for index in range(3))
        print(f"| {name} | {cpu:.2f} | {wall:.2f} | {peak:.0f} | {ratio(costs, name, 'metrics alone'):.2f} |")


def configuration(scratch: Path, rounds: int) -> None:
    """Assemble a configuration and print how long it took."""
    root = scratch / "made"
    launch = made(root)
    from measure import run

    command = [sys.executable, __file__, "--assemble", str(root), launch]
    cold = []
    for _ in range(rounds):
        shutil.rmtree(root / ".roslens", ignore_errors=True)
        cold.append(run(command))
    # Time stamps younger than two seconds are not trusted, and rightly so.
    time.sleep(2.5)
    work("facts", root)
    kept = [run(command) for _ in range(rounds)]
    took, nodes, endpoints = assembling(root, launch, rounds + 1)
    print(f"\n{nodes} nodes, {endpoints} endpoints")
    for what, costs in (("nothing is kept", cold), ("the facts are kept", kept)):
        wall_s, cpu_s = (middle([cost[index] for cost in costs]) for index in (1, 0))
        print(f"a new process, {what}: {wall_s:.2f} s, {cpu_s:.2f} CPU s")
    print(f"again in one process: {statistics.median(took[1:]) * 1000:.0f} CPU ms")


def main() -> int:
    """Measure and print, or do what a measurement asks a process of its own to do."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("corpus", type=Path, nargs="?")
    arguments.add_argument("--rounds", type=int, default=3)
    arguments.add_argument("--work", nargs=2, help=argparse.SUPPRESS)
    arguments.add_argument("--assemble", nargs=2, help=argparse.SUPPRESS)
    options = arguments.parse_args()
    if options.work:
        work(options.work[0], Path(options.work[1]))
        return 0
    if options.assemble:
        assembling(Path(options.assemble[0]), options.assemble[1], 1)
        return 0
    with tempfile.TemporaryDirectory(prefix="roslens-bench-") as scratch:
        if options.corpus:
            facts(options.corpus, Path(scratch), options.rounds)
        configuration(Path(scratch), options.rounds)
    return 0


if __name__ == "__main__":
    sys.exit(main())
