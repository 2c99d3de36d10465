from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.python.python_program import program_of_python


def index(files):
    return indexed({path: program_of_python(text.encode()) for path, text in files.items()})


def test_a_package_hands_on_what_its_modules_define():
    files = {
        "p/src/p/__init__.py": "from p.deep import *\nfrom .near import Near\nfrom p import gone\n",
        "p/src/p/near.py": "class Near:\n    pass\n",
        "p/src/p/deep/__init__.py": "from p.deep.far import make\n",
        "p/src/p/deep/far.py": "def make():\n    pass\n",
        "p/scripts/a.py": "from p import Near, gone, make\nimport p\n",
    }
    found = index(files)
    assert found.class_of("Near", "p/scripts/a.py", "").path == "p/src/p/near.py"
    assert found.class_of("p.Near", "p/scripts/a.py", "").path == "p/src/p/near.py"
    assert [one.path for one in found.functions_of("make", "p/scripts/a.py", "")] == ["p/src/p/deep/far.py"]
    assert found.class_of("gone", "p/scripts/a.py", "") is None


def test_what_a_package_defines_itself_comes_first():
    files = {
        "p/__init__.py": "from .near import X\nclass X:\n    pass\n",
        "p/near.py": "class X:\n    pass\n",
        "a.py": "from p import X\n",
    }
    assert index(files).class_of("X", "a.py", "").path == "p/__init__.py"


def test_packages_that_hand_on_to_each_other_end():
    files = {"a/__init__.py": "from b import X\n", "b/__init__.py": "from a import X\n", "c.py": "from a import X\n"}
    assert index(files).class_of("X", "c.py", "") is None


def test_the_nearer_of_two_modules_of_one_name_is_meant():
    one = "class A:\n    pass\n"
    files = {"p/src/used/m.py": one, "q/src/used/m.py": one, "q/scripts/a.py": "from used.m import A\n"}
    assert index(files).class_of("A", "q/scripts/a.py", "").path == "q/src/used/m.py"


def test_a_constant_that_a_package_hands_on():
    files = {
        "p/__init__.py": "from .names import TOPIC\n",
        "p/names.py": 'TOPIC = "scan"\n',
        "a.py": "from p import TOPIC\n",
    }
    assert index(files).constant("TOPIC", "a.py", "")[0] == "p/names.py"
