"""`roslens graph` again and again in one process, as an editor does, keeps nothing of the calls before."""

import gc
import tracemalloc

from roslens.cli.main import main

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>An arm.</description>
<maintainer email="a@b.cc">A</maintainer><license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend>
<export><build_type>ament_cmake</build_type></export></package>
"""
NODE = """#include <rclcpp/rclcpp.hpp>
int main(int c, char** v) {{ rclcpp::init(c, v); auto n = rclcpp::Node::make_shared("n{0}");
  auto p = n->create_publisher<std_msgs::msg::String>("t{0}", 10); rclcpp::spin(n); }}
"""
CALLS = 6


def test_calls_of_one_process_keep_nothing(tmp_path, capsys):
    (tmp_path / "arm").mkdir()
    (tmp_path / "arm" / "package.xml").write_text(MANIFEST)
    build = ["cmake_minimum_required(VERSION 3.8)", "project(arm)"]
    size = 0
    for number in range(8):
        text = NODE.format(number) + "".join(
            f"int f{number}_{one}(int a) {{ return a + {one}; }}\n" for one in range(400)
        )
        size += len(text)
        (tmp_path / "arm" / f"a{number}.cpp").write_text(text)
        build.append(f"add_executable(a{number} a{number}.cpp)")
    (tmp_path / "arm" / "CMakeLists.txt").write_text("\n".join(build) + "\n")

    def call():
        assert main(["graph", str(tmp_path), "-q", "--no-cache"]) == 0
        assert "arm/a7.cpp" in capsys.readouterr().out

    call()
    call()
    gc.collect()
    tracemalloc.start()
    try:
        call()
        gc.collect()
        before = tracemalloc.get_traced_memory()[0]
        for _ in range(CALLS):
            call()
        gc.collect()
        kept = (tracemalloc.get_traced_memory()[0] - before) / CALLS
    finally:
        tracemalloc.stop()
    # The text of the files was kept, once in each call.
    assert kept < 0.2 * size, f"{kept:,.0f} bytes a call are kept; the files have {size:,}"
