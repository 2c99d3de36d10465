"""Classes of Python that are imported from where they were imported themselves, from source to fan-in."""

import pytest

from roslens.model.source import Language, SourceFile
from roslens.source.metrics.class_model.join_classes import join_classes
from roslens.source.metrics.class_model.reexports import Reexports
from roslens.source.syntax.python import parse_python

MODULES = {
    "r.robot": [".arm", ".left"],
    "r.robot.arm": [],
    "r.robot.left": [".left_arm"],
    "r.robot.left.left_arm": [],
    "r.robot.other": [],
    "r.scripts.run": ["robot"],
    "r.scripts.direct": ["robot.other"],
}
ARMS = ("r.robot.arm.Arm", "r.robot.other.Arm")


@pytest.mark.parametrize(
    ("name", "module", "candidates", "found"),
    [
        ("Arm", "r.scripts.run", ARMS, "r.robot.arm.Arm"),
        ("robot.Arm", "r.scripts.run", ARMS, "r.robot.arm.Arm"),
        ("Arm", "r.scripts.direct", ARMS, "r.robot.other.Arm"),
        ("robot.other.Arm", "r.scripts.direct", ARMS, "r.robot.other.Arm"),
        ("Arm", "r.robot", ARMS, "r.robot.arm.Arm"),
        ("Hand", "r.scripts.run", ("r.robot.left.left_arm.Hand",), "r.robot.left.left_arm.Hand"),
        ("Arm", "r.robot.arm", ("r.robot.other.Arm",), None),
        ("Arm", "r.scripts.run", ("r.robot.arm.Arm", "r.robot.left.left_arm.Arm"), None),
        ("numpy.Arm", "r.scripts.run", ARMS, None),
        ("Arm", "nowhere", ARMS, None),
        ("Arm", "r.scripts.run", (), None),
    ],
)
def test_which_class_is_meant(name, module, candidates, found):
    packages = {"r.robot", "r.robot.left"}
    assert Reexports(MODULES, packages).find(name, module, candidates) == found


def joined(**files):
    made = []
    for name, text in files.items():
        path = f"{name.replace('__', '/').replace('INIT', '__init__')}.py"
        made.append((SourceFile(path, Language.PYTHON), parse_python(text.encode())))
    return join_classes(made).classes


@pytest.mark.parametrize("used", ["from robot import Arm\nclass User:\n    def go(self):\n        Arm()\n",
                                  "import robot\nclass User:\n    def go(self):\n        robot.Arm()\n",
                                  "import robot\nclass User(robot.Arm):\n    pass\n"])  # fmt: skip
def test_who_uses_a_class_through_its_package(used):
    classes = joined(
        r__robot__INIT="from .arm import Arm\n",
        r__robot__arm="class Arm:\n    pass\n",
        r__robot__other="class Arm:\n    pass\n",
        r__scripts__run=used,
    )
    assert classes[1, 0].clients == {"r.scripts.run.User"}
    assert classes[2, 0].clients == frozenset()
    assert classes[3, 0].suppliers == {"r.robot.arm.Arm"}
