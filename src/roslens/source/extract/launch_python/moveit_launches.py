"""What the launch files of MoveIt start that ``moveit_configs_utils`` generates (``moveit_configs_utils/launches.py``).

A launch file of a package of configuration is one call of these; what parameters they give is put together from files
of the package by code that is not followed.
"""

from __future__ import annotations

from collections.abc import Callable

from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml
from roslens.source.extract.domain.abstract_value import Names, Obj, Unknown, Value
from roslens.source.extract.domain.kinds import known_text
from roslens.source.extract.facts.files import Files
from roslens.source.extract.launch_python.deferred import Deferred, Scope, resolve
from roslens.source.extract.launch_python.launch_values import Made
from roslens.source.extract.symbolic.text import Text

Make = Callable[[str, list[Value], Names], Made]
"""Makes an object of a class of launch at the place of the call."""
_MODULE = "moveit_configs_utils."
_CONFIGS = "moveit_configs_utils.MoveItConfigs"
_PATH = "package_path"
_PARAMETERS = Unknown("parameters that moveit_configs_utils puts together")
_NODES = {
    "generate_rsp_launch": ("robot_state_publisher", "robot_state_publisher"),
    "generate_moveit_rviz_launch": ("rviz2", "rviz2"),
    "generate_setup_assistant_launch": ("moveit_setup_assistant", "moveit_setup_assistant"),
    "generate_move_group_launch": ("moveit_ros_move_group", "move_group"),
    "generate_warehouse_db_launch": ("warehouse_ros_mongo", "mongo_wrapper_ros.py"),
}
_OTHERS = frozenset({"generate_demo_launch", "generate_spawn_controllers_launch",
                     "generate_static_virtual_joint_tfs_launch"})  # fmt: skip
_JOINTS = "static_virtual_joint_tfs"
_BROADCASTER = "joint_state_broadcaster"


def is_of_moveit(name: str) -> bool:
    """Return whether a function or class is one of ``moveit_configs_utils`` that is known."""
    last = name.rpartition(".")[2]
    return name.startswith(_MODULE) and (last == "MoveItConfigsBuilder" or last in _NODES or last in _OTHERS)


def is_configs(value: Value) -> bool:
    """Return whether a value is a configuration of MoveIt, or what builds one."""
    match value:
        case Obj(type=kind):
            return kind == _CONFIGS
    return False


def method_of_configs(of: Obj, name: str) -> Value:
    """Return what a method of a configuration returns: most set a part of it."""
    return _PARAMETERS if name == "to_dict" else of


def member_of_configs(of: Obj, name: str) -> Value:
    """Return a part of a configuration: its package, or parameters."""
    return of.fields.get(name, _PARAMETERS)


def made_by_moveit(name: str, arguments: list[Value], keywords: Names, make: Make, files: Files | None) -> Value:
    """Return a configuration of MoveIt, or the description that a function generates."""
    last = name.rpartition(".")[2]
    if last == "MoveItConfigsBuilder":
        return _configs(arguments, keywords, files)
    match arguments[0] if arguments else keywords.get("moveit_config"):
        case Obj(fields={"package_path": Text() as path}):
            folder = path
        case _:
            folder = Text()
    if last in _NODES:
        package, program = _NODES[last]
        actions = [_node(make, package, program, parameters=[_PARAMETERS])]
    elif last == "generate_spawn_controllers_launch":
        actions = _spawners(make, folder, files)
    elif last == "generate_demo_launch":
        match arguments[1] if len(arguments) > 1 else keywords.get("launch_package_path"):
            case Text() as given:
                actions = _demo(make, folder, given, files)
            case _:
                actions = _demo(make, folder, folder, files)
    else:
        actions = [Unknown("virtual joints that the SRDF of the robot names")]
    return make("LaunchDescription", [actions], {})


def _configs(arguments: list[Value], keywords: Names, files: Files | None) -> Value:
    """Return a configuration: it is in a package that is named, or called like the robot."""
    robot = known_text(arguments[0] if arguments else keywords.get("robot_name"))
    package = known_text(keywords.get("package_name")) or (f"{robot}_moveit_config" if robot else None)
    if package is None or files is None:
        return Obj(_CONFIGS)
    return Obj(_CONFIGS, None, {_PATH: resolve(Deferred("share", (package,)), Scope(files, {}, {}, ""))})


def _node(make: Make, package: str, program: str, **more: Value) -> Value:
    return make("Node", [], {"package": Text.of(package), "executable": Text.of(program), **more})


def _spawners(make: Make, folder: Text, files: Files | None) -> list[Value]:
    """Return the spawners of the controllers that the file of controllers names, and of the broadcaster."""
    names = _controllers(folder, files)
    found: list[Value] = [
        _node(make, "controller_manager", "spawner", arguments=[Text.of(one)]) for one in [*(names or []), _BROADCASTER]
    ]
    return found if names is not None else [*found, Unknown("controllers that the configuration of MoveIt names")]


def _controllers(folder: Text, files: Files | None) -> list[str] | None:
    known = folder.known
    content = files.content(f"{known}/config/moveit_controllers.yaml") if files is not None and known else None
    try:
        match load_yaml(content) if content is not None else None:
            case {"moveit_simple_controller_manager": {"controller_names": list(names)}}:
                return [str(one) for one in names]
    except (UnsafeYamlError, RecursionError):
        pass
    return None


def _file(name: str) -> str:
    return f"/launch/{name}.launch.py"


def _demo(make: Make, folder: Text, launches: Text, files: Files | None) -> list[Value]:
    """Return what a demonstration starts: the other launch files of the package, and simulated joints."""

    def included(name: str, **more: Value) -> Value:
        return make("IncludeLaunchDescription", [Text.of(launches, _file(name))], more)

    def wanted(argument: str) -> Made:
        return make("IfCondition", [Deferred("configuration", (argument,))], {})

    def declared(argument: str, default: str) -> Made:
        return make("DeclareLaunchArgument", [Text.of(argument)], {"default_value": Text.of(default)})

    joints = Text.of(launches, _file(_JOINTS)).known
    has_joints = files is not None and joints is not None and files.content(joints) is not None
    return [
        declared("db", "false"),
        declared("debug", "false"),
        declared("use_rviz", "true"),
        *([included(_JOINTS)] if has_joints else []),
        included("rsp"),
        included("move_group"),
        included("moveit_rviz", condition=wanted("use_rviz")),
        included("warehouse_db", condition=wanted("db")),
        _node(
            make,
            "controller_manager",
            "ros2_control_node",
            parameters=[Text.of(folder, "/config/ros2_controllers.yaml")],
            remappings=[[Text.of("/controller_manager/robot_description"), Text.of("/robot_description")]],
        ),
        included("spawn_controllers"),
    ]
