#!/bin/sh
# Starts the nodes of the small robot and watches them until Ctrl-C.
#   sh examples/robot/watch_ros2.sh [ROSLENS [PYTHON WITH RCLPY]]
set -eu
here=$(dirname "$0")
roslens=${1:-roslens}
python=${2:-python3}
export ROS_DOMAIN_ID="${ROS_DOMAIN_ID:-77}" ROSLENS_ROS2_PYTHON="$python"
nodes=
for name in odometry lidar camera planner; do
    "$roslens" run -- "$python" "$here/ros2_$name.py" >"${TMPDIR:-/tmp}/roslens-$name.log" 2>&1 &
    nodes="$nodes $!"
done
# shellcheck disable=SC2064,SC2086 # the nodes are known now, one word each
trap "kill $nodes 2>/dev/null || true" EXIT
trap : INT # Ctrl-C ends the watch, and with it this script
shift $(($# < 2 ? $# : 2))
"$roslens" watch --ros2 --reference "$here/rover.yaml" --fail-on never "$@" || [ $? -eq 3 ]
