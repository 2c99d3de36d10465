"""Modules as one classic script."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from roslens.dashboard.render import WEB
from roslens.dashboard.script_bundle import ENTRIES, bundle, inline

MAIN = """import {
  add,
  one as first,
} from "./deep/sum.js";
import { two } from "./two.js";
const hidden = 5;
console.log(add(first, two), hidden);
"""
SUM = """import { two } from "../two.js";
const hidden = 7;
export const one = 1;
export function add(a, b) {
  return a + b + hidden - two;
}
"""
NODE = shutil.which("node")


def read_web(path: str) -> str:
    return (WEB / path).read_text(encoding="utf-8")


def test_every_module_is_there_once_and_after_those_it_needs() -> None:
    script = bundle(ENTRIES, read_web)
    names = [path.relative_to(WEB).as_posix() for path in WEB.rglob("*.js") if path.name != "theme.js"]
    assert [name for name in names if script.count(f'modules["{name}"] = ') != 1] == []
    assert (
        script.index('modules["dom.js"] = ')
        < script.index('modules["chips.js"] = ')
        < script.index('modules["main.js"] = ')
        < script.index('modules["package_graph.js"] = ')
    )


@pytest.mark.parametrize(
    "line",
    [
        'import all from "./b.js";',
        'import * as b from "./b.js";',
        "export default 1;",
        "export { a };",
        'const b = import("./b.js");',
    ],
)
def test_other_forms_are_refused(line: str) -> None:
    with pytest.raises(ValueError, match="expected named imports and exports"):
        bundle(["a.js"], {"a.js": line, "b.js": ""}.__getitem__)


def test_modules_that_import_each_other_are_refused() -> None:
    texts = {"a.js": 'import { b } from "./b.js";\n', "b.js": 'import { a } from "./a.js";\n'}
    with pytest.raises(ValueError, match="imports itself by way of"):
        bundle(["a.js"], texts.__getitem__)


def test_nothing_ends_the_element() -> None:
    assert "</" not in inline('const a = "</script><!-- </SCRIPT>";').replace("</div", "")


@pytest.mark.skipif(NODE is None, reason="needs node")
def test_the_script_does_what_the_modules_do(tmp_path: Path) -> None:
    texts = {"main.js": MAIN, "deep/sum.js": SUM, "two.js": "export const two = 2;\n"}
    script = tmp_path / "all.js"
    script.write_text(bundle(["main.js"], texts.__getitem__), encoding="utf-8")
    done = subprocess.run([str(NODE), str(script)], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["8", "5"]
