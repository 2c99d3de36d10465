"""Commands of CMake that set variables, read files and look for things; those that make targets are elsewhere."""

from __future__ import annotations

import re
import shlex
from contextlib import suppress
from functools import lru_cache
from posixpath import basename, dirname

from roslens.source.extract.builds.cmake_arguments import ARGUMENTS
from roslens.source.extract.builds.cmake_evaluation import BUILD, SOURCE, Call, Evaluation, Handler
from roslens.source.extract.builds.cmake_files import FILE
from roslens.source.extract.builds.cmake_lists import LIST
from roslens.source.extract.builds.cmake_math import MATH
from roslens.source.extract.builds.cmake_paths import PATHS
from roslens.source.extract.builds.cmake_scope import Scope
from roslens.source.extract.builds.cmake_signals import ReturnedError
from roslens.source.extract.builds.cmake_syntax import Argument, Body, Command, Script, parse_cmake
from roslens.source.extract.builds.cmake_texts import STRING
from roslens.source.extract.builds.cmake_value import hole, is_unknown, items_of, made_by
from roslens.source.extract.facts.files import joined


def _set(run: Evaluation, call: Call) -> None:
    if not call.arguments:
        return
    name, *values = call.arguments
    if name.startswith("ENV{"):
        run.variables.environment[name[4:-1]] = "".join(values[:1])
        return
    if "CACHE" in values:
        at = values.index("CACHE")
        if "FORCE" in values[at:] or "INTERNAL" in values[at:]:
            run.variables.cache[name] = ";".join(values[:at])
            run.variables.open.discard(name)
        else:
            run.variables.cache.setdefault(name, ";".join(values[:at]))
            run.variables.open.add(name)
        return
    parent = bool(values) and values[-1] == "PARENT_SCOPE"
    if parent:
        values = values[:-1]
    _assign(run, name, ";".join(values) if values else None, parent=parent)


def _assign(run: Evaluation, name: str, value: str | None, *, parent: bool) -> None:
    run.limits.spend(len(value or ""))
    if not parent:
        run.variables.set(name, value)
    elif run.variables.scope.parent is not None:
        # Here it stays what it was.
        known, before = run.variables.scope.get(name)
        run.variables.set(name, before if known or not run.variables.is_foreign(name) else run.variables.get(name))
        if len(run.variables.scope.layers) > 1:
            # Whether this branch is taken is unknown, and the other scope does not know of branches.
            value = run.variables.either("".join(run.conditions[-1:]))(
                name, [value, run.variables.scope.parent.get(name)[1]]
            )
        run.variables.scope.parent.set(name, value)


def _unset(run: Evaluation, call: Call) -> None:
    if not call.arguments:
        return
    name = call.arguments[0]
    if "CACHE" in call.arguments[1:]:
        run.variables.cache.pop(name, None)
    else:
        _assign(run, name, None, parent="PARENT_SCOPE" in call.arguments[1:])


def _option(run: Evaluation, call: Call) -> None:
    if call.arguments:
        name = call.arguments[0]
        if not run.variables.scope.get(name)[0]:
            run.variables.cache.setdefault(name, call.arguments[2] if len(call.arguments) > 2 else "OFF")
            run.variables.open.add(name)


def _project(run: Evaluation, call: Call) -> None:
    if not call.arguments:
        return
    name = call.arguments[0]
    for prefix in ("PROJECT", name):
        run.variables.set(f"{prefix}_SOURCE_DIR", run.absolute(run.where))
        run.variables.set(f"{prefix}_BINARY_DIR", f"{BUILD}/{run.where}")
    run.variables.set("PROJECT_NAME", name)
    run.variables.set("CMAKE_PROJECT_NAME", name)
    if "VERSION" in call.arguments[:-1]:
        version = call.arguments[call.arguments.index("VERSION") + 1]
        run.variables.set("PROJECT_VERSION", version)
        run.variables.set(f"{name}_VERSION", version)
    for variable, value in destinations_of(name).items():
        run.variables.set(variable, value)


def destinations_of(package: str) -> dict[str, str]:
    """Return where catkin and GNUInstallDirs install things of a package."""
    share = f"share/{package}"
    return {
        "CATKIN_PACKAGE_BIN_DESTINATION": f"lib/{package}",
        "CATKIN_PACKAGE_LIB_DESTINATION": "lib",
        "CATKIN_PACKAGE_INCLUDE_DESTINATION": f"include/{package}",
        "CATKIN_PACKAGE_SHARE_DESTINATION": share,
        "CATKIN_PACKAGE_ETC_DESTINATION": f"etc/{package}",
        "CATKIN_GLOBAL_BIN_DESTINATION": "bin",
        "CATKIN_GLOBAL_LIB_DESTINATION": "lib",
        "CATKIN_GLOBAL_LIBEXEC_DESTINATION": "lib",
        "CATKIN_GLOBAL_INCLUDE_DESTINATION": "include",
        "CATKIN_GLOBAL_SHARE_DESTINATION": "share",
        "CATKIN_GLOBAL_ETC_DESTINATION": "etc",
        "CATKIN_DEVEL_PREFIX": f"{BUILD}/devel",
        "CMAKE_INSTALL_BINDIR": "bin",
        "CMAKE_INSTALL_LIBDIR": "lib",
        "CMAKE_INSTALL_LIBEXECDIR": "libexec",
        "CMAKE_INSTALL_INCLUDEDIR": "include",
        "CMAKE_INSTALL_DATAROOTDIR": "share",
        "CMAKE_INSTALL_DATADIR": "share",
    }


def _find_package(run: Evaluation, call: Call) -> None:
    if not call.arguments:
        return
    name, *rest = call.arguments
    names = [name]
    for keyword in ("COMPONENTS", "OPTIONAL_COMPONENTS", "REQUIRED"):
        if keyword in rest:
            names.extend(value for value in rest[rest.index(keyword) + 1 :] if value not in _FIND_WORDS)
    for one in dict.fromkeys(names):
        if is_unknown(one):
            continue
        run.variables.prefixes.update((one, one.upper()))
        if one == name:
            version = _ros_of(one)
            if "REQUIRED" in rest or (version and version == run.variables.environment.get("ROS_VERSION")):
                run.variables.set(f"{one}_FOUND", "1")
            elif version:
                run.variables.set(f"{one}_FOUND", "0")
        load_extras(run, one)


def _ros_of(package: str) -> str:
    """Return the version of ROS that alone has a package; empty of all others."""
    return "1" if package in ("catkin", "roscpp") else "2" if package.startswith(("ament_cmake", "rclcpp")) else ""


_FIND_WORDS = frozenset(
    {"COMPONENTS", "OPTIONAL_COMPONENTS", "REQUIRED", "QUIET", "EXACT", "CONFIG", "MODULE", "NO_MODULE"}
)


def load_extras(run: Evaluation, package: str) -> None:
    """Run the CMake files that a package of the workspace gives to those that find it."""
    if package in run.loaded:
        return
    run.loaded.add(package)
    folder = run.files.package(package)
    if folder is None or joined("", folder) == run.folder:
        return
    folder = joined("", folder)
    cmake = f"{folder}/cmake" if folder else "cmake"
    content = run.files.content(joined(folder, "CMakeLists.txt"))
    run.variables.set(f"{package}_DIR", run.absolute(cmake))
    if content is None or b"_EXTRAS" not in content:
        return
    for written in _extras(content):
        path, script = _source_of(run, (folder, cmake), written)
        if script is not None:
            run.run_file(path, parse_cmake(script), shown_in=run.absolute(cmake))


@lru_cache(maxsize=256)
def _extras(content: bytes) -> tuple[str, ...]:
    found: list[str] = []
    for command in _commands(parse_cmake(content).body):
        if command.name in ("ament_package", "catkin_package"):
            found.extend(_after(command.arguments, ("CONFIG_EXTRAS", "CFG_EXTRAS", "CONFIG_EXTRAS_POST")))
    return tuple(found)


def _commands(body: Body) -> list[Command]:
    found: list[Command] = []
    waiting = list(body)
    while waiting:
        one = waiting.pop(0)
        match one:
            case Command():
                found.append(one)
            case _:
                waiting[:0] = [inner for _, part in one.branches for inner in part]
    return found


def _after(arguments: tuple[Argument, ...], keywords: tuple[str, ...]) -> list[str]:
    found: list[str] = []
    taking = False
    for argument in arguments:
        value = argument.literal or ""
        if value in keywords:
            taking = True
        elif value.isupper() and "." not in value:
            taking = False
        elif taking and value:
            found.append(value)
    return found


def _source_of(run: Evaluation, folders: tuple[str, ...], name: str) -> tuple[str, bytes | None]:
    """Return the file from which a CMake file is made that is installed, without what empy would replace."""
    for folder in folders:
        for end in ("", ".in", ".em", ".installspace.in"):
            path = joined(folder, name + end)
            content = run.files.content(path)
            if content is not None:
                return path, re.sub(rb"(?m)^@\[.*$", b"", content) if end or name.endswith(".em") else content
    return "", None


def _included(run: Evaluation, name: str) -> tuple[str | None, bytes | None]:
    """Return the path and content of a file, or of what it is made of where it is generated."""
    path = run.relative(name)
    if path is None or (content := run.files.content(path)) is not None:
        return path, None if path is None else content
    return _source_of(run, (dirname(path), dirname(dirname(path))), basename(path))


def _include_module(run: Evaluation, name: str) -> bool:
    """Run a module of the workspace; return whether there is one of that name."""
    for folder in items_of(run.variables.get("CMAKE_MODULE_PATH") or ""):
        found = run.relative(f"{folder}/{name}.cmake")
        script = run.script(found) if found else None
        if found and script:
            run.run_file(found, script)
            return True
    return False


def _include(run: Evaluation, call: Call) -> None:
    if not call.arguments:
        return
    name = call.arguments[0]
    if is_unknown(name):
        run.fail(name, call.evidence, f"it includes a file that is unknown: {name}")
        return
    if "/" not in name and not name.endswith(".cmake"):
        if _include_module(run, name):
            return
        if run.relative(name) not in run.listing:
            run.variables.prefixes.add(name)
            return
    path, content = _included(run, name)
    if path and content is not None:
        run.run_file(path, parse_cmake(content), shown_in=dirname(name) if name.startswith(SOURCE) else "")
    elif "OPTIONAL" not in call.arguments:
        run.fail(name.replace(f"{SOURCE}/", ""), call.evidence, "the included file is not in the workspace")


def _add_subdirectory(run: Evaluation, call: Call) -> None:
    if not call.arguments:
        return
    folder = run.relative(call.arguments[0])
    path = None if folder is None else joined(folder, "CMakeLists.txt")
    script = run.script(path) if path in run.listing else None
    if folder is None or path is None or script is None:
        what = f'"{path}" is not among the files of the package' if path else "the folder is unknown"
        run.fail(call.arguments[0].replace(f"{SOURCE}/", ""), call.evidence, what)
        return
    if run.seen(path, tuple(run.conditions)):
        run.fail(call.arguments[0].replace(f"{SOURCE}/", ""), call.evidence, "the folder is added twice")
        return
    run_folder(run, folder, path, script)


def run_folder(run: Evaluation, folder: str, path: str, script: Script) -> None:
    """Run a CMakeLists.txt in a scope of its own."""
    before = run.variables.scope, run.where
    run.variables.scope, run.where = Scope(run.variables.scope), folder
    run.variables.set("CMAKE_CURRENT_SOURCE_DIR", run.absolute(folder))
    run.variables.set("CMAKE_CURRENT_BINARY_DIR", f"{BUILD}/{folder}")
    try:
        run.run_file(path, script)
    finally:
        run.variables.scope, run.where = before


def _message(_run: Evaluation, call: Call) -> None:
    if call.arguments and call.arguments[0] == "FATAL_ERROR" and _run.conditions:
        raise ReturnedError("stop")


def _language(run: Evaluation, call: Call) -> None:
    if len(call.arguments) < 2:
        return
    form, *rest = call.arguments
    if form not in ("CALL", "EVAL") or is_unknown("".join(rest[:1] if form == "CALL" else rest)):
        run.fail(f"cmake_language({form})", call.evidence, "its command, or when it runs, is unknown")
        if form not in ("CALL", "EVAL", "DEFER"):
            run.variables.set(rest[-1], hole(f"cmake_language({form})"))
        return
    if form == "EVAL":
        run.run_within(call.command, parse_cmake("".join(rest[1:]).encode()).body)
        return
    arguments = tuple(Argument(value, "bracket", (value,), value) for value in rest[1:])
    run.run_within(call.command, (Command(rest[0].lower(), arguments, call.command.line, call.command.column),))


def _separate_arguments(run: Evaluation, call: Call) -> None:
    """Make a list of what is written as in a shell."""
    if not call.arguments:
        return
    name, *rest = call.arguments
    if not rest:
        run.variables.set(name, (run.variables.get(name) or "").replace(" ", ";"))
        return
    text = rest[-1]
    found = hole("separate_arguments()")
    if rest[0] in ("UNIX_COMMAND", "NATIVE_COMMAND") and len(rest) == 2 and not is_unknown(text):
        with suppress(ValueError):
            found = ";".join(piece.replace(";", "\\;") for piece in shlex.split(text))
    run.variables.set(name, found)


def _found(position: int) -> Handler:
    """Return a handler of a command that sets a variable to what only the build knows."""

    def handler(run: Evaluation, call: Call) -> None:
        if len(call.arguments) > position and not run.variables.scope.get(call.arguments[position])[0]:
            run.variables.foreign.add(call.arguments[position])

    return handler


def _asked(position: int) -> Handler:
    """Return a handler of a command that asks for a property."""

    def handler(run: Evaluation, call: Call) -> None:
        if len(call.arguments) > position:
            run.variables.set(call.arguments[position], hole(f"the result of {call.command.name}()"))

    return handler


def _packages(run: Evaluation, call: Call) -> None:
    if call.arguments:
        run.variables.prefixes.add(call.arguments[0])


def _generated(run: Evaluation, call: Call) -> None:
    """Commands whose first argument names the list of files that they make."""
    if call.arguments:
        run.variables.set(call.arguments[0], made_by(call.command.name))


COMMANDS: dict[str, Handler] = {
    "set": _set, "unset": _unset, "option": _option, "project": _project, "find_package": _find_package,
    "include": _include, "add_subdirectory": _add_subdirectory, "message": _message,
    "pkg_check_modules": _packages, "pkg_search_module": _packages,
    **dict.fromkeys(("find_library", "find_path", "find_file", "find_program", "try_compile", "try_run"), _found(0)),
    **dict.fromkeys(("check_include_file", "check_include_file_cxx", "check_include_files", "check_cxx_compiler_flag",
                     "check_c_compiler_flag", "check_cxx_source_compiles", "check_c_source_compiles",
                     "check_type_size"), _found(1)),
    **dict.fromkeys(("check_symbol_exists", "check_cxx_symbol_exists", "check_library_exists"), _found(2)),
    "check_function_exists": _found(1),
    **dict.fromkeys(("get_directory_property", "get_property", "get_target_property", "get_source_file_property",
                     "get_cmake_property", "get_test_property", "execute_process"), _asked(0)),
    **dict.fromkeys(("qt_wrap_cpp", "qt_wrap_ui", "qt5_wrap_cpp", "qt5_wrap_ui", "qt6_wrap_cpp", "qt6_wrap_ui",
                     "qt4_wrap_cpp", "qt4_wrap_ui", "qt5_add_resources", "qt4_add_resources", "qt_add_resources"),
                    _generated),
    "cmake_language": _language, "separate_arguments": _separate_arguments,
    **LIST, **STRING, **PATHS, **ARGUMENTS, **MATH, **FILE,
}  # fmt: skip

IGNORED = frozenset({
    "add_compile_definitions", "add_compile_options", "add_custom_command", "add_custom_target", "add_definitions",
    "add_dependencies", "add_launch_test", "add_link_options", "add_ros_test", "add_rostest", "add_test",
    "ament_add_nose_test", "ament_add_pytest_test", "ament_add_ros_isolated_pytest_test",
    "ament_add_ros_isolated_test", "ament_add_test", "ament_auto_add_gtest", "ament_auto_find_build_dependencies",
    "ament_auto_find_test_dependencies", "ament_clang_format", "ament_clang_tidy", "ament_copyright",
    "ament_cppcheck", "ament_cpplint", "ament_environment_hooks", "ament_export_definitions",
    "ament_export_dependencies", "ament_export_include_directories", "ament_export_interfaces",
    "ament_export_libraries", "ament_export_link_flags", "ament_export_targets", "ament_find_gmock",
    "ament_find_gtest", "ament_flake8", "ament_index_register_resource", "ament_lint_auto_find_test_dependencies",
    "ament_lint_cmake", "ament_mypy", "ament_package", "ament_pep257", "ament_register_extension",
    "ament_uncrustify", "ament_xmllint", "catkin_add_env_hooks", "catkin_add_nosetests", "catkin_download",
    "catkin_download_test_data", "catkin_metapackage", "catkin_package_xml", "catkin_run_tests_target",
    "cmake_minimum_required", "cmake_policy", "configure_file", "configure_package_config_file", "enable_language",
    "enable_testing", "export", "find_package_handle_standard_args", "generate_dynamic_reconfigure_options",
    "generate_messages", "include_directories",
    "include_external_msproject", "include_guard", "link_directories", "link_libraries", "mark_as_advanced",
    "remove_definitions", "rosidl_export_typesupport_targets", "rosidl_get_typesupport_target",
    "rosidl_target_interfaces", "roslaunch_add_file_check", "roslint_add_test", "roslint_cpp", "roslint_custom",
    "roslint_python", "set_directory_properties", "set_source_files_properties",
    "set_tests_properties", "site_name", "source_group", "subdirs", "target_compile_definitions",
    "target_compile_features", "target_compile_options", "target_include_directories", "target_link_directories",
    "target_link_options", "target_precompile_headers", "use_c99", "variable_watch",
    "write_basic_package_version_file", "write_file",
})  # fmt: skip
"""Commands that decide nothing about which source ends in which program."""
