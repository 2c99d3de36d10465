"""A table of changes made from two revisions of a repository."""

import subprocess

import pytest
import tomli
from distribution_changes.__main__ import table
from distribution_changes.deprecations import marked
from distribution_changes.revision import Revision

LIBRARY = '<library path="{0}"><class {1} base_class_type="{0}::Base"/></library>'
OLD = {
    "arm/include/arm/driver.h": "#ifndef A\n#define A\n#warning use driver.hpp\n#include <arm/driver.hpp>\n#endif\n",
    "arm/include/arm/driver.hpp": "#pragma once\nclass Driver {};\n",
    "arm/include/arm/old.hpp": "#pragma once\nclass Old {};\n",
    "arm/include/arm/late.h": "#pragma once\nclass Late {};\n",
    "arm/test/include/arm/fixture.h": "class Fixture {};\n",
    "arm/arm/__init__.py": "",
    "arm/arm/grip.py": "",
    "arm/plugins.xml": LIBRARY.format("arm", 'name="arm/Grip" type="arm::Grip"'),
    "leg/package.xml": "<package/>",
    "leg/plugins.xml": LIBRARY.format("leg", 'name="leg/Leg" type="leg::Leg"'),
    "leg/src/leg_parameters.yaml": "leg:\n  force: {type: double}\n  speed:\n    most: {type: double}\n",
}
NEW = {
    "arm/include/arm/driver.hpp": '#pragma once\nclass [[deprecated("use Motor")]] Driver {};\n',
    "arm/include/arm/late.h": '#pragma once\n#pragma message("late.h is deprecated")\n#include "arm/late.hpp"\n',
    "arm/include/arm/late.hpp": "#pragma once\nclass Late {};\n",
    "arm/arm/__init__.py": "",
    "arm/plugins.xml": LIBRARY.format("arm", 'type="arm::Grip"'),
    "leg/package.xml": "<package/>",
    "leg/plugins.xml": OLD["leg/plugins.xml"],
    "leg/src/leg_parameters.yaml": "leg:\n  speed:\n    least: {type: double}\n",
}


@pytest.fixture
def revisions(tmp_path):
    def git(*words):
        identity = ("-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false")
        subprocess.run(["git", *identity, "-C", str(tmp_path), *words], check=True, capture_output=True)

    git("init", "-q")
    for name, files in (("old", OLD), ("new", NEW)):
        git("rm", "-rq", "--ignore-unmatch", ".")
        for path, text in files.items():
            (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / path).write_text(text)
        git("add", "-A")
        git("commit", "-qm", name)
        git("branch", name)
    return [Revision(tmp_path, "humble", "old"), Revision(tmp_path, "jazzy", "new")]


def test_what_is_gone_is_a_row(revisions):
    read = tomli.loads("\n".join(table("arm/arm", revisions)))
    assert read["about"]["source"].startswith("arm/arm: humble ")
    assert read["header"] == {
        "arm/driver.h": {"deprecated": "humble", "removed": "jazzy", "instead": "arm/driver.hpp", "alike": True},
        "arm/late.h": {"deprecated": "jazzy", "instead": "arm/late.hpp", "since": "jazzy", "alike": True},
        "arm/old.hpp": {"removed": "jazzy"},
    }
    assert read["module"] == {"arm.grip": {"removed": "jazzy"}}
    assert read["plugin"] == {"arm/Grip": {"removed": "jazzy", "instead": "arm::Grip", "alike": True}}


def test_parameters_belong_to_the_one_plugin_of_a_package(revisions):
    read = tomli.loads("\n".join(table("leg/leg", revisions)))
    assert read["parameter"] == {
        "leg/Leg:force": {"removed": "jazzy"},
        "leg/Leg:speed.most": {"removed": "jazzy"},
    }


def test_marks_in_code_are_for_a_person(revisions):
    (line,) = [one for one in marked(revisions[1]) if "Motor" in one]
    assert line == "arm/include/arm/driver.hpp: Driver (use Motor)"
