"""The edit that links the targets of packages where CMake has no ``ament_target_dependencies`` any more.

The plain form of ``target_link_libraries`` is written where no keyword stood, as ament_cmake called it: CMake refuses
both forms for one target. Sources of the names: what the packages export by ``ament_export_targets``; packages of
interfaces set ``${NAME_TARGETS}`` (release notes of Kilted, ament/ament_cmake#572).
"""

from __future__ import annotations

import re

from roslens.model.edit import Edit, edit_at

COMMAND = "ament_target_dependencies"
_CALL = re.compile(rb"ament_target_dependencies(\s*\()([^()#\"]*)\)", re.IGNORECASE)
_KEYWORDS = frozenset({"PUBLIC", "INTERFACE", "PRIVATE"})
_LIKE_THEMSELVES = """
    ament_index_cpp angles camera_info_manager class_loader controller_interface controller_manager cv_bridge
    diagnostic_updater hardware_interface image_geometry image_transport kdl_parser laser_geometry message_filters
    pluginlib rclcpp rclcpp_action rclcpp_lifecycle rcpputils rcutils realtime_tools rosbag2_cpp tf2 tf2_eigen
    tf2_geometry_msgs tf2_kdl tf2_ros tf2_sensor_msgs urdf
"""
_TARGETS = {
    **{name: f"{name}::{name}" for name in _LIKE_THEMSELVES.split()},
    "rclcpp_components": "rclcpp_components::component",
    "Eigen3": "Eigen3::Eigen",
}
_INTERFACES = re.compile(r"[a-z]\w*_(?:msgs|srvs|interfaces|actions)$")


def linked(content: bytes, line: int, path: str) -> Edit | None:
    """Return the edit of a call that begins on a line; None where the targets of a package are not known.

    Args:
        content: of the file.
        line: of the name of the command, 1-based.
        path: of the file.
    """
    start = 0
    for _ in range(line - 1):
        start = content.find(b"\n", start) + 1
    call = _CALL.search(content, start)
    if call is None or b"\n" in content[start : call.start()]:
        return None
    words = call[2].decode("utf-8", "replace")
    target, *named = words.split() or [""]
    targets = {one: _target(one) for one in named}
    if not target or "$" in "".join(named) or not all(targets.values()):
        return None
    written = re.sub(r"\S+", lambda word: _replaced(word, words, targets), words)
    return edit_at(content, *call.span(), f"target_link_libraries{call[1].decode()}{written})", path)


def _replaced(word: re.Match[str], words: str, targets: dict[str, str]) -> str:
    """Return what stands in the place of a word; the first one is the target itself."""
    return word[0] if not words[: word.start()].strip() else targets[word[0]]


def _target(name: str) -> str:
    if name in _KEYWORDS:
        return name
    return _TARGETS.get(name) or (f"${{{name}_TARGETS}}" if _INTERFACES.match(name) else "")
