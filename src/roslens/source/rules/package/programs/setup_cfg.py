"""Rule ``package.setup_cfg``: programs of a Python package are installed where nobody looks."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the setup.py of an ament_python package with programs whose folder is not set."""
    if view.package.build_type != "ament_python" or not (view.setup.programs or view.setup.scripts):
        return
    expected = f"$base/lib/{view.package.name}"
    path = view.path("setup.cfg")
    text = view.read(view.path("setup.py"))
    if "setup.cfg" not in view.listing:
        if b"install_scripts" not in text and b"data_files" in text and f"lib/{view.package.name}".encode() not in text:
            message = f"no setup.cfg; expected one that installs programs to {expected!r}"
            yield Hit("package.setup_cfg", message, 1, context="setup.cfg", path=view.path("setup.py"))
        return
    folder = view.setup.script_folder
    if not folder:
        message = f"[install] has no install_scripts; expected {expected!r}"
        yield Hit("package.setup_cfg", message, 1, context="install_scripts", path=path)
    elif folder.rstrip("/").rpartition("/")[2] != view.package.name and "lib/" in folder:
        line = view.read(path).partition(b"[install]")[0].count(b"\n") + 2
        message = f"programs are installed to {folder!r}; expected {expected!r}, where `ros2 run` looks"
        yield Hit("package.setup_cfg", message, line, context="install_scripts", path=path)


RULE = PackageRule(
    id="package.setup_cfg",
    title="Programs of a Python package not installed to lib/PACKAGE",
    finds="An `ament_python` package with `console_scripts` or `scripts` whose setup.cfg is missing, lacks "
    "`install_scripts` below `[install]`, or names the folder of another package. Expected is `$base/lib/PACKAGE`.",
    why="`ros2 run` and launch files look below `lib/PACKAGE`; setuptools installs to `bin`. The build succeeds "
    "and no node can be started.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2",),
    tags=("python", "install"),
    bad="[develop]\nscript_dir=$base/lib/arm_teleop",
    good="[develop]\nscript_dir=$base/lib/arm_teleop\n[install]\ninstall_scripts=$base/lib/arm_teleop",
    found=found,
)
