from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.graph.timing.waits import waits
from roslens.source.settings import MacroSettings

PYTHON = b"""\
import rclpy
class Driver(Node):
    def on_goal(self, message):
        self.client.call(Load.Request())
    def on_scan(self, message):
        future = self.client.call_async(Load.Request())
        rclpy.spin_until_future_complete(self, future)
    def on_map(self, message):
        self.client.call_async(Load.Request())
    def other(self):
        self.call(1, 2)
"""
CPP = b"""\
#include <rclcpp/rclcpp.hpp>
void Driver::on_goal(const Goal & goal) {
  auto future = client_->async_send_request(request);
  future.get();
}
void Driver::on_scan(const Scan & scan) {
  auto future = client_->async_send_request(request);
  rclcpp::spin_until_future_complete(node, future);
}
void Driver::on_map(const Map & map) {
  auto future = client_->async_send_request(request);
  future.wait_for(1s);
}
"""


def found(content, language, path):
    programs = {path: parse_file(content, language, MacroSettings()).program()}
    return [(one.function, one.proof.line, one.how) for one in waits(programs)]


def test_python_calls_and_spins():
    assert found(PYTHON, Language.PYTHON, "a.py") == [
        ("Driver.on_goal", 4, "call()"),
        ("Driver.on_scan", 6, "call_async() and spin_until_future_complete()"),
    ]


def test_cpp_takes_the_future_or_spins():
    assert found(CPP, Language.CPP, "a.cpp") == [
        ("Driver.on_goal", 3, "async_send_request() and get()"),
        ("Driver.on_scan", 7, "async_send_request() and spin_until_future_complete()"),
    ]
