"""What the build of a package makes: which source ends in which executable, component, nodelet, plug-in or script.

CMake files, setup.py and descriptions of plug-ins are read, never run. An executable's sources include those of the
libraries of its package that it links.
"""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from roslens.intake.file_budget import file_budget
from roslens.intake.time_budget import OverBudgetError
from roslens.source.extract.builds.cmake_blocks import BLOCKS
from roslens.source.extract.builds.cmake_commands import COMMANDS, IGNORED, run_folder
from roslens.source.extract.builds.cmake_evaluation import Evaluation
from roslens.source.extract.builds.cmake_linking import INSTALL, Linking, merged
from roslens.source.extract.builds.cmake_made import Item
from roslens.source.extract.builds.cmake_signals import ExhaustedError, ReturnedError
from roslens.source.extract.builds.cmake_targets import Collected
from roslens.source.extract.builds.plugin_xml import PluginClass, exported_descriptions, read_plugins
from roslens.source.extract.builds.python_setup_targets import module_file, read_setup, setup_targets
from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence, Generated, Sure, Target, TargetKind

_NODELET = "nodelet::Nodelet"


class Build(msgspec.Struct, frozen=True):
    """What the build of a package makes.

    Attributes:
        targets: executables, libraries, components, nodelets, plug-ins and scripts.
        unresolved: what could not be evaluated.
        interfaces: files of messages, services and actions that it generates code of.
        installed: files and folders of the workspace, each with where it is then: ``launch`` in ``share/pkg/launch``.
        parameters: files of which it generates code that declares parameters.
        unresolved_for: what could not be evaluated for each version of ROS, where it is built for several.
    """

    targets: tuple[Target, ...] = ()
    unresolved: tuple[Unresolved, ...] = ()
    interfaces: tuple[str, ...] = ()
    installed: tuple[tuple[str, str], ...] = ()
    parameters: tuple[Generated, ...] = ()
    unresolved_for: dict[str, tuple[Unresolved, ...]] = {}


def targets_of(
    package: str, folder: str, build_type: str, files: Files, listing: Iterable[str]
) -> tuple[tuple[Target, ...], tuple[Unresolved, ...]]:
    """Return the targets of a package and what could not be evaluated; see :func:`build_of`."""
    build = build_of(package, folder, build_type, files, listing)
    return build.targets, build.unresolved


def build_of(package: str, folder: str, build_type: str, files: Files, listing: Iterable[str]) -> Build:
    """Return what the build of a package makes; never raises for what is in its files.

    Args:
        package: its name.
        folder: its folder, relative to the root of the workspace.
        build_type: ``catkin``, ``ament_cmake``, ``ament_python``, ``cmake`` or another.
        files: that may be read.
        listing: the files of the package, relative to the root.
    """
    reading = _Reading(package, joined("", folder), build_type, files, frozenset(listing))
    path = joined(folder, "CMakeLists.txt")
    try:
        with file_budget(path):
            return reading.read()
    except OverBudgetError as error:
        reason = str(error) if error.subject in ("", path) else f"{error.subject}: {error}"
        return Build(unresolved=(Unresolved("CMakeLists.txt", Evidence(error.subject or path, 1), reason, opens=True),))


_KNOWN_TYPES = frozenset(("", "catkin", "ament_cmake", "ament_python", "cmake"))


class _Reading:
    def __init__(self, package: str, folder: str, build_type: str, files: Files, listing: frozenset[str]) -> None:
        self._package = package
        self._folder = folder
        self._build_type = build_type
        self._files = files
        self._listing = listing
        self._collected = Collected()
        self._run = Evaluation(folder, files, listing, {**COMMANDS, **self._collected.handlers()}, IGNORED, BLOCKS)
        self._linking = Linking(package, build_type == "catkin", self._run, self._collected)
        self._targets: list[Target] = []
        self._unresolved: list[Unresolved] = []
        self._parameters: list[Generated] = []

    def read(self) -> Build:
        cmake = joined(self._folder, "CMakeLists.txt")
        has_cmake = cmake in self._listing and self._build_type != "ament_python"
        if has_cmake:
            self._evaluate(cmake)
        self._targets.extend(self._linking.targets())
        installed = self._linking.installs()
        self._parameters = self._linking.parameters()
        if not has_cmake or self._collected.python_setup or self._collected.script_folder:
            installed.extend(self._read_setup())
        self._read_plugins()
        if self._build_type not in _KNOWN_TYPES:
            what = f"nothing is known of what the build type {self._build_type} makes"
            manifest = Evidence(joined(self._folder, "package.xml"), 1)
            self._unresolved.append(Unresolved("build_type", manifest, what))
        interfaces = self._linking.interfaces()
        return Build(
            tuple(merged(self._targets)),
            (*self._run.unresolved, *dict.fromkeys(self._unresolved)),
            tuple(interfaces),
            tuple(dict.fromkeys(installed)),
            tuple(dict.fromkeys(self._parameters)),
        )

    def _evaluate(self, path: str) -> None:
        run = self._run
        run.variables.environment["ROS_VERSION"] = "1" if self._build_type == "catkin" else "2"
        top = run.absolute(self._folder)
        for name in ("CMAKE_SOURCE_DIR", "PROJECT_SOURCE_DIR"):
            run.variables.set(name, top)
        for name in ("CMAKE_BINARY_DIR", "PROJECT_BINARY_DIR"):
            run.variables.set(name, f"/=build/{self._folder}")
        for name, value in _GIVEN.items():
            run.variables.set(name, value)
        for name in ("BUILD_TESTING", "CATKIN_ENABLE_TESTING"):
            run.variables.cache[name] = "ON"
            run.variables.open.add(name)
        script = run.script(path)
        if script is None:
            run.fail("CMakeLists.txt", Evidence(path, 1), "the file cannot be read")
            return
        try:
            run_folder(run, self._folder, path, script)
        except ExhaustedError as error:
            run.fail("CMakeLists.txt", Evidence(path, 1), f"evaluation failed: {error}")
        except (ReturnedError, RecursionError) as error:
            run.fail("CMakeLists.txt", Evidence(path, 1), f"evaluation failed: {type(error).__name__}")

    def _read_setup(self) -> list[tuple[str, str]]:
        setup = read_setup(self._folder, self._files, self._listing)
        # What catkin_python_setup() installs goes to bin, and ament_python_install_package() has its own destination.
        script_folder = self._collected.script_folder or (
            "bin" if self._collected.python_setup else setup.script_folder
        )
        targets, unresolved = setup_targets(self._package, self._folder, setup, self._listing, script_folder)
        self._targets.extend(targets)
        self._unresolved.extend(unresolved)
        for target, path in setup.parameters:
            if joined(self._folder, path) in self._listing:
                self._parameters.append(Generated(target, joined(self._folder, path), python=True))
        return [
            (joined(self._folder, path), joined(folder, path.rpartition("/")[2]))
            for folder, paths in setup.data
            for path in paths
            if joined(self._folder, path) in self._listing
        ]

    def _read_plugins(self) -> None:
        items = {path: item for item in self._collected.plugins if (path := self._linking.file(item, "a description"))}
        manifest = joined(self._folder, "package.xml")
        content = self._files.content(manifest) if manifest in self._listing else None
        exported = exported_descriptions(content, manifest) if content else ()
        for one in exported:
            if one.path not in items:
                condition = (one.condition,) if one.condition else ()
                item = Item(f"/=workspace/{one.path}", "", one.evidence, condition)
                if path := self._linking.file(item, "a description"):
                    items[path] = item
        for path, item in items.items():
            classes, unresolved = read_plugins(self._files.content(path) or b"", path)
            self._unresolved.extend(unresolved)
            self._targets.extend(self._plugin(one, item) for one in classes)

    def _plugin(self, one: PluginClass, item: Item) -> Target:
        made = self._linking.named_file(one.library)
        kind = TargetKind.NODELET if one.parent == _NODELET else TargetKind.PLUGIN
        evidence = one.evidence
        if made:
            parts = self._linking.parts(made)
            sources, installed = tuple(parts.sources), any(each.installed for each in made)
            library = made[0].name
            if not parts.certain:
                evidence = msgspec.structs.replace(evidence, sure=Sure.LIKELY)
        else:
            module = one.type.rpartition(".")[0]
            ways = dict.fromkeys(("", "src", one.library))
            found = [module_file(joined(self._folder, way), module, {}, self._listing) for way in ways if module]
            path = next(filter(None, found), None)
            sources, installed, library = (path,) if path else (), True, one.library
            if path is None:
                self._unresolved.append(
                    Unresolved(
                        one.library or one.name, evidence, "the library of a plug-in is not built by the package"
                    )
                )
        return Target(kind, self._package, one.name, sources, evidence, one.type, library, installed, item.conditions)


_GIVEN = {
    "UNIX": "1", "LINUX": "1", "CMAKE_HOST_UNIX": "1", "CMAKE_SYSTEM_NAME": "Linux", "CMAKE_HOST_SYSTEM_NAME": "Linux",
    "CMAKE_INSTALL_PREFIX": INSTALL,
}  # fmt: skip
