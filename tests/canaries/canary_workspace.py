"""A workspace that starts programs by every way that a tool is known to offer, each of which leaves a file.

Each canary is what the workspace of a stranger may hold: settings of tools, modules beside the code, native libraries,
scripts, commands of a build. ``sing`` tells which of them ran.
"""

import json
import py_compile
import shutil
import subprocess
import sysconfig
from pathlib import Path

MANIFEST = """<package format="2"><name>pkg</name><version>0.0.1</version><description>d</description>
<maintainer email="a@example.org">m</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend>
</package>
"""

SHADOWED = (
    "multiprocessing", "typing_extensions", "tomllib", "tomli", "toml", "dill", "isort", "mccabe", "astroid", "pylint",
    "platformdirs", "json", "re", "struct", "socket", "pkg_resources", "setuptools", "yaml", "lxml", "catkin_pkg",
    "rosdep2", "rospkg", "cpplint", "cpplint_rules", "pycodestyle", "pydocstyle", "pyflakes", "flake8", "pep8ext",
    "misra", "cppcheckdata", "cppcheck", "y2038", "cert", "threadsafety", "naming", "sitecustomize", "usercustomize",
    "ament_flake8", "ament_lint", "concurrent", "asyncio", "ctypes", "hashlib", "xml", "encodings", "codecs",
)  # fmt: skip

SETTINGS = {
    "pylintrc": "[MAIN]\ninit-hook={python}\nload-plugins=evil_plugin\nextension-pkg-allow-list=spwd,evil_native\n",
    ".pylintrc": "[MASTER]\ninit-hook={python}\nload-plugins=evil_plugin\n",
    "setup.cfg": "[pylint.MAIN]\ninit-hook={python}\n[flake8]\nenable-extensions=X\n"
    "[flake8:local-plugins]\nextension=\n    X = evil_plugin:Plugin\npaths=.\n[pydocstyle]\nconvention=pep257\n",
    "tox.ini": "[flake8:local-plugins]\nextension=\n    X = evil_plugin:Plugin\npaths=.\n[pycodestyle]\nignore=\n",
    ".flake8": "[flake8]\n[flake8:local-plugins]\nextension=\n    X = evil_plugin:Plugin\npaths=.\n",
    "pyproject.toml": '[tool.pylint.main]\ninit-hook = """{python}"""\nload-plugins = ["evil_plugin"]\n'
    '[tool.ruff]\ncache-dir = "{here}/written_ruff"\n',
    "CPPLINT.cfg": "set noparent\nfilter=-x\n",
    ".clang-format": "BasedOnStyle: Google\n",
    ".clang-tidy": "Checks: '*'\nExtraArgs: [{gpu}]\n",
    ".catkin_lint": "[catkin_lint]\nextra_checks = evil_plugin.check os.abort\n",
    "std.cfg": '<?xml version="1.0"?><def format="2"><define name="X" value=""/></def>\n',
    "misra.json": '{{"script": "./misra.py", "python": "./tool.sh"}}\n',
    "cppcheck.cfg": '{{"addons": ["misra"]}}\n',
    "clang++.cfg": "-fplugin=./evil_native.so\n",
}

LIBRARIES = ("libm.so.6", "libz.so.1", "libdl.so.2", "libtinyxml2.so.9", "libedit.so.2", "libffi.so.8", "libxml2.so.2")
"""Of programs that are started in the workspace, where an empty entry of ``LD_LIBRARY_PATH`` means it."""

GPU = ("-fopenmp=libomp", "-fopenmp-targets=amdgcn-amd-amdhsa", "-nogpulib", "--amdgpu-arch-tool=./tool.sh")
FLAGS = (
    *GPU, "--nvptx-arch-tool=./tool.sh", "--offload-arch-tool=./tool.sh", "--offload-arch=native", "-B.",
    "-fplugin=./evil_native.so",
    "-fpass-plugin=./evil_native.so", "-specs=./x", "--config", "./clang++.cfg", "@./response", "-no-integrated-as",
    "-Xclang", "-load", "-Xclang", "./evil_native.so", "-fuse-ld=./tool.sh", "--ld-path=./tool.sh",
    "-fembed-offload-object=x",
    "-Xclang", "-header-include-file", "-Xclang", "{here}/written_header", "--serialize-diagnostics",
    "{here}/written_serial",
    "-MD", "-MF", "{here}/written_depends", "-Xclang", "-dependency-file", "-Xclang", "{here}/written_dependency",
    "-Xclang", "-dependency-dot", "-Xclang", "{here}/written_dot", "-Xclang", "-diagnostic-log-file", "-Xclang",
    "{here}/written_log", "-Xclang", "-stats-file={here}/written_stats", "-save-stats=obj",
)  # fmt: skip

NATIVE = """
#include <stdio.h>
void* PyInit_{name}(void) {{ FILE* f = fopen("{here}/native_{name}", "w"); if (f) fclose(f); return 0; }}
__attribute__((constructor)) static void begin(void) {{
  FILE* f = fopen("{here}/native_{name}", "w"); if (f) fclose(f); }}
"""


class CanaryWorkspace:
    """The workspace, at ``root``; the files that canaries leave are in ``here``, outside of it."""

    def __init__(self, folder):
        """Make it."""
        self.here = folder / "ran"
        self.root = folder / "ws"
        self.here.mkdir()
        for place in (self.root, self.root / "pkg", self.root / "pkg" / "src", self.root / "pkg" / "scripts"):
            place.mkdir(parents=True, exist_ok=True)
            self._modules(place)
        self._sources()
        for name, text in SETTINGS.items():
            gpu = ", ".join(json.dumps(word) for word in GPU)
            filled = text.format(python=self._python("settings"), here=self.here, gpu=gpu)
            for place in (self.root, self.root / "pkg"):
                (place / name).write_text(filled)
        self._database()
        self._scripts()

    def sing(self):
        """Return the names of the canaries that ran, and forget them."""
        found = sorted(path.name for path in self.here.iterdir())
        for path in self.here.iterdir():
            path.unlink() if path.is_file() else shutil.rmtree(path)
        return found

    def changed(self, before):
        """Return what is in the workspace and was not among ``before``, but for what roslens keeps."""
        return sorted(self.files() - before)

    def files(self):
        """Return the paths of all files in the workspace."""
        return {str(path) for path in self.root.rglob("*") if ".roslens" not in path.parts}

    def _python(self, name):
        return f"open({str(self.here / name)!r}, 'a').close()"

    def _modules(self, place):
        for name in (*SHADOWED, "evil_plugin"):
            (place / f"{name}.py").write_text(self._python(f"module_{name}") + "\n")
        compiler = shutil.which("gcc") or shutil.which("cc")
        suffix = sysconfig.get_config_var("EXT_SUFFIX") or ".so"
        for name in ("spwd", "evil_native"):
            if compiler is None:
                continue
            source = self.here.parent / f"{name}.c"
            built = self.here.parent / f"{name}.so"
            if not built.exists():
                source.write_text(NATIVE.format(name=name, here=self.here))
                subprocess.run([compiler, "-shared", "-fPIC", str(source), "-o", str(built)], check=True)
            shutil.copy(built, place / f"{name}.so")
            shutil.copy(built, place / f"{name}{suffix}")
            for library in LIBRARIES if name == "evil_native" else ():
                shutil.copy(built, place / library)
        compiled = place / "__pycache__"
        compiled.mkdir(exist_ok=True)
        text = self.here.parent / "compiled.py"
        text.write_text(self._python("compiled") + "\n")
        tag = py_compile.importlib.util.cache_from_source("x.py").rsplit("x.", 1)[1]
        mode = py_compile.PycInvalidationMode.UNCHECKED_HASH
        py_compile.compile(str(text), cfile=str(compiled / f"sample.{tag}"), invalidation_mode=mode)

    def _sources(self):
        package = self.root / "pkg"
        (package / "package.xml").write_text(MANIFEST)
        (package / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.0)\nproject(pkg)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
            f'execute_process(COMMAND touch "{self.here}/cmake")\n'
        )
        imports = "\n".join(f"import {name}" for name in (*SHADOWED, "spwd", "evil_native", "sample"))
        (package / "sample.py").write_text(f"{imports}\n\n\ndef f(a=[]):\n    return b\n")
        (package / "scripts" / "other.py").write_text("import sample\nimport spwd\nsample.f()\n")
        (package / "src" / "a.cpp").write_text('#include "a.h"\nint main() { int x = 1 / 0; return x; }\n')
        (package / "src" / "a.h").write_text("struct A { A(int); };\n")
        (package / "src" / "b.c").write_text("int f(void) { return 1; }\n")

    def _database(self):
        flags = [flag.format(here=self.here) for flag in FLAGS]
        entries = [
            {
                "directory": str(self.root),
                "file": f"pkg/src/{name}",
                "arguments": [f"{self.root}/clang++", *words, "-c", f"pkg/src/{name}"],
            }
            for name, words in (("a.cpp", flags), ("b.c", list(GPU)))
        ]
        (self.root / "compile_commands.json").write_text(json.dumps(entries))
        (self.root / "response").write_text("-fplugin=./evil_native.so\n")

    def _scripts(self):
        script = f'#!/bin/sh\ntouch "{self.here}/program_$(basename "$0")"\necho gfx906\n'
        for name in ("tool.sh", "clang++", "python3", "python", "git", "xmllint", "cppcheck", "ruff", "pylint", "cccc"):
            path = self.root / name
            path.write_text(script)
            path.chmod(0o755)
        (self.root / "Makefile").write_text(f"all lint:\n\ttouch {self.here}/make\n")


def text_of_settings(tools, root):
    """Return a ``roslens.toml`` that switches tools on and gives them options."""
    here = Path(root)
    return (
        f"models = ['paper2016', 'ros']\n[tools]\nuse = {json.dumps(list(tools))}\n"
        f"[tools.own]\ncommand = ['make', 'lint']\n"
        f"[options.cppcheck]\nmisra = true\n"
        f"[options.clang_tidy]\ndatabase = [{str(here / 'compile_commands.json')!r}]\n"
        "checks = ['*']\n"
    )
