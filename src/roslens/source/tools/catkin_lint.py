"""The tool ``catkin_lint``: manifests and CMakeLists.txt of catkin packages."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import PurePosixPath

from roslens.model.source import Language, SourceFile
from roslens.plugins.points import Option
from roslens.source.tools.running.run_tool import Ended
from roslens.source.tools.tool import READ_ROLES, Reading, Request, Tool, ToolFinding, own_paths
from roslens.source.tools.xml_output import number, xml_root

_LEVELS = ("error", "warning", "notice")
SEARCHED = "ROS_PACKAGE_PATH"


class CatkinLint(Tool):
    """Packages of ROS 1, all in one call."""

    name = "catkin_lint"
    program = "catkin_lint"
    text = "Manifests and CMake of catkin packages: what is missing, unused or in the wrong order."
    get = "pip install 'roslens[tools]', apt install catkin-lint, or pip install catkin_lint"
    languages = ("manifest",)
    oldest = (1, 6)
    settings_files = (".catkin_lint",)
    whole_packages = True
    parallel = False
    at_once = 2000
    options = (
        Option("level", "int", "0 for errors, 1 for warnings, too, 2 for all.", 2),
        Option("ignore", "list", "Problems that are not reported.", []),
    )

    def reads(self, file: SourceFile) -> bool:
        """Return whether a file is the manifest of a package."""
        return file.language is Language.MANIFEST and file.role in READ_ROLES

    def shapes(self, file: SourceFile) -> bool:
        """Return whether the package is built by it; which others there are counts through their names."""
        return file.language in (Language.CMAKE, Language.MANIFEST) or file.role in READ_ROLES

    def words(self, request: Request) -> list[str]:
        """Return the call, which does not use the network."""
        searched = os.environ.get(SEARCHED, "")
        return [
            request.program,
            *(["--package-path", searched] if searched and not request.own_settings else []),
            "--offline",
            "--quiet",
            "--xml",
            f"-W{request.options['level']}",
            *(word for name in request.options["ignore"] for word in ("--ignore", name)),
            *(f"./{PurePosixPath(path).parent}" for path in own_paths(request)),
        ]

    def variables(self, request: Request) -> Mapping[str, str]:
        """Return where it looks for settings: they can name modules whose code it runs.

        It takes them from each folder of ``ROS_PACKAGE_PATH``, which is the workspace where that is built; packages it
        takes as well from ``--package-path``.
        """
        return {} if request.own_settings else {SEARCHED: request.scratch}

    def read(self, ended: Ended, request: Request) -> Reading:
        """Read the XML of standard output, which names packages and files in them."""
        if not ended.stdout.strip() and b"no packages to check" in ended.stderr:
            return Reading()
        root = xml_root(ended.stdout.strip(), "catkin_lint")
        folders = request.packages
        found = []
        for problem in root:
            if problem.tag not in _LEVELS:
                continue
            package = problem.findtext("location/package") or ""
            file = problem.findtext("location/file") or "package.xml"
            if package not in folders:
                continue
            path = str(PurePosixPath(folders[package], file))
            line = number(problem.findtext("location/line"))
            check, text = problem.findtext("id") or "", problem.findtext("text") or ""
            found.append(ToolFinding(path, line, 0, check.lower(), text, level=str(problem.tag)))
        return Reading(tuple(found))


plugin = CatkinLint()
