"""Commands of CMake, ament and catkin that make targets, register components and name interfaces and plug-ins."""

from __future__ import annotations

import re
from posixpath import basename, splitext

from roslens.source.extract.builds.cmake_evaluation import Call, Evaluation, Handler
from roslens.source.extract.builds.cmake_files import matching
from roslens.source.extract.builds.cmake_made import Component, Installed, Item, Made
from roslens.source.extract.builds.cmake_value import is_unknown, reason_of


class Collected:
    """What the CMake files of a package make."""

    def __init__(self) -> None:
        """Begin with nothing."""
        self.made: dict[str, list[Made]] = {}
        self.aliases: dict[str, str] = {}
        self.components: list[Component] = []
        self.installed: list[Installed] = []
        self.interfaces: list[Item] = []
        self.plugins: list[Item] = []
        self.parameters: list[tuple[str, bool, Item]] = []
        self.python_setup = False
        self.script_folder = ""
        self.automatic: list[Made] = []

    def handlers(self) -> dict[str, Handler]:
        """Return what commands do, by name."""
        return {
            "add_executable": self._executable, "add_library": self._library, "target_sources": self._sources,
            "cuda_add_executable": self._executable, "cuda_add_library": self._library,
            "qt5_add_executable": self._executable, "pybind11_add_module": self._library,
            "target_link_libraries": self._link, "ament_target_dependencies": self._link,
            "set_target_properties": self._properties, "set_property": self._property,
            "install": self._install, "catkin_install_python": self._install_python,
            "ament_python_install_package": self._python_package, "catkin_python_setup": self._python_setup,
            "rclcpp_components_register_node": self._component, "rclcpp_components_register_nodes": self._components,
            "ament_auto_add_executable": self._auto_executable, "ament_auto_add_library": self._auto_library,
            "ament_auto_package": self._auto_package,
            **dict.fromkeys(_TESTS, self._test),
            **dict.fromkeys(("add_rostest_gtest", "add_rostest_gmock"), self._rostest),
            "rosidl_generate_interfaces": self._interfaces, "add_message_files": self._ros1_interfaces,
            "add_service_files": self._ros1_interfaces, "add_action_files": self._ros1_interfaces,
            "pluginlib_export_plugin_description_file": self._plugin, "catkin_package": _nothing,
            "generate_parameter_library": self._parameters, "generate_parameter_module": self._parameters,
        }  # fmt: skip

    def _items(self, run: Evaluation, call: Call, values: list[str]) -> list[Item]:
        conditions = tuple(run.conditions)
        return [
            Item(one, run.where, call.evidence, (*conditions, *more))
            for value in values
            for one, more in _alternatives(run, value)
        ]

    def _make(self, run: Evaluation, call: Call, name: str, *, executable: bool) -> Made | None:
        if is_unknown(name):
            run.fail(f"{call.command.name}({name})", call.evidence, f"its name is unknown: {reason_of(name)}")
            return None
        made = Made(name, executable, call.evidence, tuple(dict.fromkeys(run.conditions)))
        others = self.made.get(name, [])
        if len(others) >= _MOST_OF_A_NAME or any(other.conditions == made.conditions for other in others):
            run.fail(f"{call.command.name}({name})", call.evidence, "a target of that name exists already")
            return None
        self.made.setdefault(name, []).append(made)
        run.targets.add(name)
        return made

    def _executable(self, run: Evaluation, call: Call) -> None:
        name, *rest = call.arguments or [""]
        if "ALIAS" in rest[:1]:
            self.aliases[name] = "".join(rest[1:2])
        elif name and "IMPORTED" not in rest:
            made = self._make(run, call, name, executable=True)
            if made:
                made.sources.extend(self._items(run, call, [one for one in rest if one not in _EXECUTABLE_WORDS]))

    def _library(self, run: Evaluation, call: Call) -> None:
        name, *rest = call.arguments or [""]
        if "ALIAS" in rest[:1]:
            self.aliases[name] = "".join(rest[1:2])
            run.targets.add(name)
        elif name and "IMPORTED" not in rest:
            made = self._make(run, call, name, executable=False)
            if made:
                made.form = rest[0] if rest and rest[0] in _FORMS else ""
                made.sources.extend(self._items(run, call, [one for one in rest if one not in _LIBRARY_WORDS]))

    def _test(self, run: Evaluation, call: Call) -> None:
        name, *rest = call.arguments or [""]
        made = self._make(run, call, name, executable=True) if name else None
        if made:
            made.test = True
            made.sources.extend(self._items(run, call, _without_keywords(rest)))

    def _rostest(self, run: Evaluation, call: Call) -> None:
        name, _launch, *rest = [*call.arguments, "", ""][: max(2, len(call.arguments))]
        self._test(run, Call(call.command, [name, *rest], call.evidence))

    def _named(self, name: str) -> list[Made]:
        for _ in range(5):
            if name in self.made or name not in self.aliases:
                break
            name = self.aliases[name]
        return self.made.get(name, [])

    def _sources(self, run: Evaluation, call: Call) -> None:
        groups: list[tuple[str, list[str]]] = [("", [])]
        for value in call.arguments[1:]:
            if value in _SCOPES:
                groups.append((value, []))
            else:
                groups[-1][1].append(value)
        for made in self._named(call.arguments[0] if call.arguments else ""):
            for scope, given in groups:
                items = self._items(run, call, given)
                if scope != "INTERFACE":
                    made.sources.extend(items)
                if scope in ("INTERFACE", "PUBLIC"):
                    made.given.extend(items)

    def _link(self, run: Evaluation, call: Call) -> None:
        for made in self._named(call.arguments[0] if call.arguments else ""):
            made.links.extend(self._items(run, call, [one for one in call.arguments[1:] if one not in _LINK_WORDS]))

    def _properties(self, _run: Evaluation, call: Call) -> None:
        if "PROPERTIES" in call.arguments:
            at = call.arguments.index("PROPERTIES")
            values = call.arguments[at + 1 :]
            for name in call.arguments[:at]:
                for key, value in zip(values[::2], values[1::2], strict=False):
                    self._set_property(name, key, value)

    def _property(self, run: Evaluation, call: Call) -> None:
        arguments = call.arguments
        if arguments[:1] != ["TARGET"] or "PROPERTY" not in arguments[:-1]:
            return
        at = arguments.index("PROPERTY")
        key, *values = arguments[at + 1 :]
        for name in arguments[1:at]:
            if name.startswith("APPEND"):
                continue
            if key in ("SOURCES", "LINK_LIBRARIES"):
                for made in self._named(name):
                    (made.sources if key == "SOURCES" else made.links).extend(self._items(run, call, values))
            elif values:
                self._set_property(name, key, values[0])

    def _set_property(self, name: str, key: str, value: str) -> None:
        for made in self._named(name):
            if key == made.output_property and not is_unknown(value):
                made.output, made.renamed = value, True
            elif key == "OUTPUT_NAME" and not made.renamed and not is_unknown(value):
                made.output = value

    def _install(self, run: Evaluation, call: Call) -> None:
        groups = _grouped(call.arguments, _INSTALL_WORDS)
        kind = call.arguments[0] if call.arguments else ""
        given = groups.get(kind, [])
        if kind == "TARGETS":
            self._install_targets(run, call, given)
            return
        if kind not in ("PROGRAMS", "FILES", "DIRECTORY"):
            return
        destination = "".join(groups.get("DESTINATION", [])[:1])
        if groups.get("TYPE"):
            destination = _FOLDERS.get(groups["TYPE"][0], "share")
        only = _patterns(call.arguments)
        for item in self._items(run, call, given):
            rename = "".join(groups.get("RENAME", [])[:1])
            executes = "OWNER_EXECUTE" in call.arguments
            form = "programs" if kind == "PROGRAMS" or (kind == "FILES" and executes) else kind.lower()
            self.installed.append(Installed(form, item, destination, rename, only))

    def _install_targets(self, run: Evaluation, call: Call, names: list[str]) -> None:
        places: dict[str, str] = {}
        artifact = ""
        for at, value in enumerate(call.arguments[:-1]):
            if value in _ARTIFACTS:
                artifact = value
            elif value == "DESTINATION":
                places.setdefault(artifact, call.arguments[at + 1])
        for name in names:
            for made in self._named(name):
                kinds = ("RUNTIME", "") if made.executable else ("LIBRARY", "ARCHIVE", "")
                usual = "bin" if made.executable else "lib"
                made.installed = [*made.installed, next((places[one] for one in kinds if one in places), usual)]
            if is_unknown(name):
                run.fail(f"install(TARGETS {name})", call.evidence, f"its name is unknown: {reason_of(name)}")

    def _install_python(self, run: Evaluation, call: Call) -> None:
        groups = _grouped(call.arguments, frozenset({"PROGRAMS", "DESTINATION", "OPTIONAL"}))
        destination = "".join(groups.get("DESTINATION", [])[:1])
        for item in self._items(run, call, groups.get("PROGRAMS", [])):
            self.installed.append(Installed("programs", item, destination))

    def _python_setup(self, _run: Evaluation, _call: Call) -> None:
        self.python_setup = True

    def _python_package(self, _run: Evaluation, call: Call) -> None:
        groups = _grouped(call.arguments, frozenset({"PACKAGE_DIR", "VERSION", "SETUP_CFG", "DESTINATION",
                                                     "SCRIPTS_DESTINATION", "SKIP_COMPILE"}))  # fmt: skip
        self.script_folder = "".join(groups.get("SCRIPTS_DESTINATION", [])[:1])

    def _component(self, run: Evaluation, call: Call) -> None:
        groups = _grouped(call.arguments, _COMPONENT_WORDS)
        library = "".join(groups.get("", [])[:1])
        plugin, program = ("".join(groups.get(key, [])[:1]) for key in ("PLUGIN", "EXECUTABLE"))
        self._register(run, call, library, [plugin] if plugin else [], program)
        if program and not is_unknown(program):
            run.targets.add(program)

    def _components(self, run: Evaluation, call: Call) -> None:
        # It knows no words but RESOURCE_INDEX: what stands behind PLUGIN is one of its names all the same.
        groups = _grouped(call.arguments, _COMPONENT_WORDS)
        given = groups.get("", [])
        self._register(run, call, "".join(given[:1]), [*given[1:], *groups.get("PLUGIN", [])], "")

    def _register(self, run: Evaluation, call: Call, library: str, plugins: list[str], program: str) -> None:
        for name in plugins:
            if unknown := reason_of(library) or reason_of(name) or reason_of(program):
                run.fail(f"{call.command.name}({library} {name})", call.evidence, f"a part is unknown: {unknown}")
                continue
            conditions = tuple(dict.fromkeys(run.conditions))
            self.components.append(Component(name, library, program, call.evidence, conditions))

    def _auto_library(self, run: Evaluation, call: Call) -> None:
        self._auto(run, call, executable=False)

    def _auto_executable(self, run: Evaluation, call: Call) -> None:
        self._auto(run, call, executable=True)

    def _auto(self, run: Evaluation, call: Call, *, executable: bool) -> None:
        name, *rest = call.arguments or [""]
        made = self._make(run, call, name, executable=executable) if name else None
        if made is None:
            return
        if "DIRECTORY" in rest[:-1]:
            at = rest.index("DIRECTORY")
            folder = run.relative(rest[at + 1])
            rest[at : at + 2] = []
            if folder is None:
                run.fail(name, call.evidence, "the folder of its sources is unknown")
            else:
                found = {
                    path
                    for end in ("c", "cc", "cpp", "cxx")
                    for path in matching(f"{folder}/*.{end}", run.listing, run.folders, deep=True)
                }
                rest.extend(run.absolute(path) for path in sorted(found))
        linked = "NO_TARGET_LINK_LIBRARIES" not in rest
        words = _LIBRARY_WORDS | _EXECUTABLE_WORDS | {"NO_TARGET_LINK_LIBRARIES"}
        made.form = rest[0] if rest and rest[0] in _FORMS else ""
        made.sources.extend(self._items(run, call, [one for one in rest if one not in words]))
        if linked:
            made.links.extend(self._items(run, call, [one.name for one in self.automatic if not one.executable]))
        self.automatic.append(made)

    def _auto_package(self, run: Evaluation, call: Call) -> None:
        project = run.variables.get("PROJECT_NAME") or ""
        for made in self.automatic:
            made.installed = [*made.installed, f"lib/{project}" if made.executable else "lib"]
        for item in self._items(run, call, _grouped(call.arguments, _AUTO_WORDS).get("INSTALL_TO_SHARE", [])):
            self.installed.append(Installed("directory", item, f"share/{project}"))

    def _interfaces(self, run: Evaluation, call: Call) -> None:
        given = _grouped(call.arguments, _ROSIDL_WORDS).get("", [])
        # Since Humble a file may be given as folder:file.
        self.interfaces.extend(self._items(run, call, [one.replace(":", "/") for one in given[1:]]))

    def _ros1_interfaces(self, run: Evaluation, call: Call) -> None:
        kind = {"add_message_files": "msg", "add_service_files": "srv", "add_action_files": "action"}[call.command.name]
        groups = _grouped(call.arguments, frozenset({"FILES", "DIRECTORY", "NOINSTALL", "BASE_DIR"}))
        folder = "".join(groups.get("DIRECTORY", [])[:1]) or kind
        given = groups.get("FILES")
        if given is None:
            where = run.relative(folder) or ""
            given = [
                basename(one) for one in sorted(matching(f"{where}/*.{kind}", run.listing, run.folders, deep=False))
            ]
        self.interfaces.extend(self._items(run, call, [f"{folder}/{one}" for one in given]))

    def _plugin(self, run: Evaluation, call: Call) -> None:
        self.plugins.extend(self._items(run, call, call.arguments[1:2]))

    def _parameters(self, run: Evaluation, call: Call) -> None:
        python = call.command.name.lower() == "generate_parameter_module"
        for item in self._items(run, call, call.arguments[1:2]):
            self.parameters.append((call.arguments[0], python, item))


def _nothing(_run: Evaluation, _call: Call) -> None:
    """Nothing that matters here comes of it."""


def _alternatives(run: Evaluation, value: str) -> list[tuple[str, tuple[str, ...]]]:
    """Return what a value may stand for, each with what it depends on."""
    if not is_unknown(value):
        return [(value, ())]
    for unknown, chosen in run.variables.alternatives.items():
        if unknown in value and len(chosen) <= 100:
            return [(value.replace(unknown, one), (reason_of(unknown),)) for one in chosen if not is_unknown(one)]
    return [(value, ())]


def _grouped(arguments: list[str], words: frozenset[str]) -> dict[str, list[str]]:
    """Return what follows each keyword, the first time it is there; what is before any at the empty one."""
    groups: dict[str, list[str]] = {"": []}
    current: list[str] | None = groups[""]
    for value in arguments:
        if value in words:
            current = groups.setdefault(value, []) if value not in groups else None
        elif current is not None:
            current.append(value)
    return groups


def _patterns(arguments: list[str]) -> tuple[str, ...]:
    if "FILES_MATCHING" not in arguments:
        return ()
    found: list[str] = []
    for at, value in enumerate(arguments[:-1]):
        excluded = arguments[at + 2 : at + 3] == ["EXCLUDE"]
        if value == "PATTERN" and not excluded:
            found.append(arguments[at + 1])
    return tuple(found)


def _without_keywords(values: list[str]) -> list[str]:
    """Return the sources of a test: what stands before its keywords, and what looks like a source after them."""
    found: list[str] = []
    keyword = False
    for value in values:
        if re.fullmatch(r"[A-Z_]{3,}", value):
            keyword = value not in ("SKIP_LINKING_MAIN_LIBRARIES", "SKIP_TEST", "EXCLUDE_FROM_ALL")
        elif not keyword or splitext(value)[1] in (".cpp", ".cc", ".cxx", ".c"):
            found.append(value)
    return found


_MOST_OF_A_NAME = 20
_FOLDERS = {"BIN": "bin", "SBIN": "sbin", "LIB": "lib", "INCLUDE": "include", "SYSCONF": "etc",
            "SHAREDSTATE": "com", "LOCALSTATE": "var", "RUNSTATE": "var/run"}  # fmt: skip
_TESTS = (
    "catkin_add_gtest", "catkin_add_gmock", "catkin_add_executable_with_gtest", "catkin_add_executable_with_gmock",
    "ament_add_gtest", "ament_add_gtest_executable", "ament_add_gmock", "ament_add_gmock_executable",
    "ament_auto_add_gtest", "ament_add_ros_isolated_gtest", "ament_add_ros_isolated_gmock",
    "ament_add_ros_isolated_gtest_executable", "ament_add_google_benchmark", "ament_add_catch2",
)  # fmt: skip
_FORMS = frozenset({"STATIC", "SHARED", "MODULE", "OBJECT", "INTERFACE", "UNKNOWN"})
_LIBRARY_WORDS = _FORMS | {"EXCLUDE_FROM_ALL", "NO_EXTRAS", "THIN_LTO"}
_EXECUTABLE_WORDS = frozenset({"WIN32", "MACOSX_BUNDLE", "EXCLUDE_FROM_ALL"})
_SCOPES = frozenset({"PUBLIC", "PRIVATE", "INTERFACE", "BEFORE"})
_LINK_WORDS = _SCOPES | {"LINK_PUBLIC", "LINK_PRIVATE", "LINK_INTERFACE_LIBRARIES", "debug", "optimized", "general",
                         "SYSTEM"}  # fmt: skip
_ARTIFACTS = frozenset({"ARCHIVE", "LIBRARY", "RUNTIME", "OBJECTS", "FRAMEWORK", "BUNDLE", "PRIVATE_HEADER",
                        "PUBLIC_HEADER", "RESOURCE", "INCLUDES", "FILE_SET"})  # fmt: skip
_INSTALL_WORDS = _ARTIFACTS | {
    "TARGETS", "PROGRAMS", "FILES", "DIRECTORY", "DESTINATION", "PERMISSIONS", "FILE_PERMISSIONS",
    "DIRECTORY_PERMISSIONS", "CONFIGURATIONS", "COMPONENT", "RENAME", "OPTIONAL", "EXPORT", "TYPE",
    "USE_SOURCE_PERMISSIONS", "FILES_MATCHING", "PATTERN", "REGEX", "EXCLUDE", "EXCLUDE_FROM_ALL", "MESSAGE_NEVER",
    "NAMELINK_COMPONENT", "NAMELINK_ONLY", "NAMELINK_SKIP", "RUNTIME_DEPENDENCIES",
}  # fmt: skip
_COMPONENT_WORDS = frozenset({"PLUGIN", "EXECUTABLE", "EXECUTOR", "RESOURCE_INDEX", "NO_UNDEFINED_SYMBOLS"})
_AUTO_WORDS = frozenset({"INSTALL_TO_SHARE", "INSTALL_TO_PATH", "USE_SCOPED_HEADER_INSTALL_DIR", "CONFIG_EXTRAS"})
_ROSIDL_WORDS = frozenset({"DEPENDENCIES", "LIBRARY_NAME", "SKIP_INSTALL", "SKIP_GROUP_MEMBERSHIP_CHECK",
                           "ADD_LINTER_TESTS"})  # fmt: skip
