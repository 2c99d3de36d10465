"""Each way to wait is found with its time; what is no fixed wait is not."""

import pytest
from roslens_plugin_waits.find_waits import find_waits


@pytest.mark.parametrize(
    ("code", "seconds"),
    [
        ("ros::Duration(0.5).sleep();", 0.5),
        ("ros::WallDuration( 2 ).sleep();", 2.0),
        ("rclcpp::sleep_for(200ms);", 0.2),
        ("std::this_thread::sleep_for(std::chrono::milliseconds(250));", 0.25),
        ("std::this_thread::sleep_for(std::chrono::seconds{3});", 3.0),
        ("usleep(500000);", 0.5),
        ("sleep(1);", 1.0),
    ],
)
def test_cpp(code, seconds):
    (wait,) = find_waits(f"\n  {code}\n", "cpp")
    assert (wait.line, wait.column) == (2, 3 if "::sleep_for" not in code else code.index("sleep_for") + 3)
    assert wait.seconds == pytest.approx(seconds)


@pytest.mark.parametrize("code", ["rate.sleep();", "sleep(period);", "// sleep(1);", "my_sleep(1);", "timer->sleep(1);"])
def test_no_fixed_wait_in_cpp(code):
    assert not list(find_waits(code, "cpp"))


def test_python():
    source = "import time\ntime.sleep(.5)\nrospy.sleep(2)  # time.sleep(9)\nself.rate.sleep()\ntime.sleep(period)\n"
    assert [(wait.line, wait.seconds) for wait in find_waits(source, "python")] == [(2, 0.5), (3, 2.0)]
