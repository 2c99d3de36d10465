"""What a stranger may have made is read by what bounds it; every other read of a whole file has its reason here."""

import ast
from pathlib import Path

SOURCE = Path(__file__).parents[2] / "src" / "roslens"

OWN = {
    "cli/commands/lsp.py": "its own pipes",
    "intake/user_folder.py": "files of the user's own folder",
    "cli/workplace/trust.py": "the user's own list, and plug-ins by pieces",
    "judge/quality/field.py": "comes with roslens",
    "dashboard/computation/to_svg.py": "comes with roslens",
    "dashboard/export.py": "comes with roslens, and the mark of a folder that roslens wrote",
    "dashboard/single_file.py": "comes with roslens",
    "source/rules/field/precision.py": "comes with roslens",
    "source/rules/field/rates.py": "comes with roslens",
    "source/rules/signatures/read_markup.py": "comes with roslens",
    "source/rules/signatures/read_messages.py": "comes with roslens",
    "source/distributions/known_distributions.py": "comes with roslens",
    "source/distributions/read_changes.py": "comes with roslens",
    "source/rules/signatures/read_signatures.py": "comes with roslens",
    "source/measure/role_includes.py": "comes with roslens",
    "source/study/role.py": "comes with roslens",
    "source/study/role_marks.py": "comes with roslens",
    "source/rules/published/standards.py": "comes with roslens",
    "source/tools/witnesses.py": "comes with roslens",
    "live/adapters/bag/source.py": "reads a recording piece by piece, never beyond its end",
    "live/adapters/bag/files/unpacked_file.py": "unpacks a recording piece by piece, up to a bound",
    "live/agent/last_log.py": "the last 4 KB of a log",
    "live/adapters/ros1/wire/definition.py": "comes with roslens",
    "live/adapters/ros1/place.py": "of the kernel",
    "live/adapters/ros2/local_process.py": "of the kernel",
    "live/agent/key_file.py": "the user's own key",
    "cli/react/sole_reactor.py": "of the kernel",
    "children/exit_status.py": "of the kernel",
    "children/plugin_sandbox.py": "of packages that the user installed",
    "children/sandbox.py": "what roslens itself wrote",
    "live/agent/allow_list.py": "the user's own file, up to a bound",
    "plugins/hashed_modules.py": "of plug-ins that the user trusts",
    "live/agent/process_record.py": "of the kernel, up to a bound",
    "live/agent/ros_environments.py": "of the kernel, up to a bound",
    "live/agent/processes.py": "of the kernel",
    "live/inside/host_counters.py": "of the kernel",
    "live/inside/path/sitecustomize.py": "the module of that name that the user has",
    "live/inside/counter_file.py": "maps a file that roslens made",
    "plugins/haros/declared.py": "comes with roslens, or is a plug-in that the user trusts",
    "plugins/haros/notes.py": "what roslens' own worker wrote, line by line",
    "plugins/installed.py": "of packages that the user installed",
    "plugins/member.py": "of plug-ins that the user trusts",
    "plugins/process.py": "seeks to the last megabyte",
    "plugins/worker.py": "its own pipes",
    "source/extract/catalogue/catalogue.py": "comes with roslens",
    "source/extract/catalogue/catalogue_plugins.py": "comes with roslens",
    "source/extract/launch/gazebo_plugins.py": "comes with roslens",
    "source/extract/launch/ros_controllers.py": "comes with roslens",
    "source/keys.py": "comes with roslens",
    "source/syntax/macro/macros.py": "comes with roslens",
    "source/tools/checks/tool_checks.py": "comes with roslens",
    "store/migrate.py": "comes with roslens",
    "store/postgres/migrate.py": "comes with roslens",
}
_WHOLE = {"read_bytes", "read_text"}
_OPENS = {"open", "fdopen"}


def reads(text: str) -> list[int]:
    """Return the lines in which a whole file may be read."""
    found = []
    perhaps = any(word in text for word in ("read_bytes", "read_text", "open("))
    for node in ast.walk(ast.parse(text)) if perhaps else ():
        if not isinstance(node, ast.Call):
            continue
        name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        modes = [one.value for one in node.args if isinstance(one, ast.Constant) and isinstance(one.value, str)]
        if name in _WHOLE or (name in _OPENS and any(set(mode) <= set("rb+t") for mode in modes)):
            found.append(node.lineno)
    return found


def test_it_sees_what_it_looks_for():
    text = "p.read_bytes()\np.read_text()\np.open('rb')\nopen(p, 'rb')\np.open('w')\nStore.open(p)\nos.open(p, 1)\n"
    assert reads(text) == [1, 2, 3, 4]


def test_every_read_of_a_whole_file_is_bounded_or_has_a_reason():
    found = {
        path.relative_to(SOURCE).as_posix(): lines
        for path in sorted(SOURCE.rglob("*.py"))
        if (lines := reads(path.read_text("utf-8")))
    }
    assert not {path: lines for path, lines in found.items() if path not in OWN}, (
        "take intake/bounded_file, or give a reason"
    )
    assert not OWN.keys() - found.keys(), "reasons of reads that are no more"
