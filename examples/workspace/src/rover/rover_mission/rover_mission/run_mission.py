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

"""``run_mission FILE``: send a mission to the rover, show how it goes, write a report."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from rover_msgs.action import FollowMission
from rover_msgs.msg import Waypoint as WaypointMessage

from rover_mission.mission_file import Mission, MissionError, load_mission
from rover_mission.report import Report

SERVER_PATIENCE_S = 5.0


class MissionClient(Node):
    """Sends one mission and follows it to its end."""

    def __init__(self, mission: Mission, report: Report) -> None:
        super().__init__("mission_client")
        self._mission = mission
        self._report = report
        self._client = ActionClient(self, FollowMission, "follow_mission")
        self.done = False
        self.succeeded = False

    def start(self) -> bool:
        """Send the mission; return whether the rover is there to take it."""
        if not self._client.wait_for_server(timeout_sec=SERVER_PATIENCE_S):
            self.get_logger().error("no rover answers on follow_mission")
            return False
        goal = FollowMission.Goal()
        goal.frame_id = self._mission.frame
        goal.loop = self._mission.loop
        goal.waypoints = [self._message(number) for number in range(len(self._mission.waypoints))]
        self._report.start(self._now())
        sent = self._client.send_goal_async(goal, feedback_callback=self._on_feedback)
        sent.add_done_callback(self._on_answer)
        return True

    def _message(self, number: int) -> WaypointMessage:
        waypoint = self._mission.waypoints[number]
        message = WaypointMessage()
        message.name = waypoint.name
        message.position.x = waypoint.x
        message.position.y = waypoint.y
        message.tolerance_m = waypoint.tolerance_m
        message.hold_s = waypoint.hold_s
        message.mode = WaypointMessage.STOP if waypoint.hold_s > 0.0 else WaypointMessage.PASS
        return message

    def _on_feedback(self, message: Any) -> None:
        reached = message.feedback.next
        if self._report.reached(reached, self._now()):
            left = message.feedback.remaining_m
            self.get_logger().info(f"{reached} of {len(self._mission.waypoints)} reached, {left:.1f} m to go")

    def _on_answer(self, future: Any) -> None:
        handle = future.result()
        if not handle.accepted:
            self.get_logger().error("the rover refused the mission")
            self.done = True
            return
        handle.get_result_async().add_done_callback(self._on_result)

    def _on_result(self, future: Any) -> None:
        result = future.result().result
        self.succeeded = not result.reason
        self._report.finish(self._now(), result.reached, result.reason)
        self.done = True

    def _now(self) -> float:
        return self.get_clock().now().nanoseconds / 1e9


def main() -> int:
    """Run one mission; return 0 when every waypoint was reached."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mission", type=Path)
    parser.add_argument("--report", type=Path, help="write a CSV file with the times at the waypoints")
    options = parser.parse_args(rclpy.utilities.remove_ros_args(sys.argv)[1:])
    try:
        mission = load_mission(options.mission)
    except MissionError as error:
        print(error, file=sys.stderr)
        return 2
    report = Report([waypoint.name for waypoint in mission.waypoints])
    rclpy.init()
    client = MissionClient(mission, report)
    try:
        if client.start():
            while rclpy.ok() and not client.done:
                rclpy.spin_once(client, timeout_sec=0.2)
    except KeyboardInterrupt:
        client.get_logger().warning("left the rover to itself")
    finally:
        client.destroy_node()
        rclpy.try_shutdown()
    if options.report:
        options.report.write_text(report.as_csv(), encoding="utf-8")
    return 0 if client.succeeded else 1


if __name__ == "__main__":
    sys.exit(main())
