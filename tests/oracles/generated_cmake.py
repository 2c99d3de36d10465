"""Writes CMake projects by chance, to be read by roslens and configured by CMake: both must come to the same.

A project is a folder of small files. ``tell(label values...)`` is a command that both sides give a meaning to: it
notes values. The generator knows nothing of what CMake does but enough to write what it accepts: where a command would
refuse an empty list, the list is filled first. The same seed writes the same project.
"""

from __future__ import annotations

from collections.abc import Callable

from oracles.generated_cmake_language import Language

FILES = (
    "src/one.cpp",
    "src/two.cpp",
    "src/three.cpp",
    "src/deep/four.cpp",
    "src/deep/five.cpp",
    "src/main.cpp",
    "top.cpp",
    "src/two.hpp",
    "sub/inner.cpp",
    "sub/other.cpp",
    "scripts/run.py",
    "scripts/tool",
    "scripts/more.sh",
    "launch/a.launch",
    "launch/b.launch",
    "config/p.yaml",
    "config/deep/q.yaml",
)
"""What every project has beside its CMake files."""
SOURCES = tuple(path for path in FILES if path.endswith(".cpp") and not path.startswith("sub/"))
_EXECUTABLE_WORDS = ("", "", "EXCLUDE_FROM_ALL", "WIN32")
_TOP = "${CMAKE_CURRENT_SOURCE_DIR}/top.cpp"
_INNER = ("", "other.cpp", "../top.cpp", "${CMAKE_SOURCE_DIR}/top.cpp")


class Project(Language):
    """Writes the CMake files of one project into :attr:`files`."""

    def __init__(self, seed: int, statements: int = 30) -> None:
        """Write; ``statements`` is about how many commands there are at the top."""
        super().__init__(seed)
        self.files: dict[str, str] = {}
        self._write(statements)

    # Targets

    def _source(self) -> str:
        return self.chance.choice(
            (
                self.chance.choice(SOURCES),
                self.chance.choice(SOURCES),
                "${CMAKE_CURRENT_SOURCE_DIR}/src/one.cpp",
                "${files}",
                '"${files}"',
                "$<1:src/two.cpp>",
                "$<0:src/two.cpp>",
                "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/src/three.cpp>",
                "${CMAKE_CURRENT_SOURCE_DIR}/src/two.hpp",
                "${some}",
                "${CMAKE_CURRENT_SOURCE_DIR}/src/../top.cpp",
                "${CMAKE_CURRENT_SOURCE_DIR}/./top.cpp",
                "$<$<BOOL:ON>:src/three.cpp>",
                "$<$<BOOL:>:src/three.cpp>",
            )
        )

    def _some_sources(self) -> str:
        return " ".join(["src/main.cpp", *(self._source() for _ in range(self.chance.randint(0, 3)))])

    def _target(self) -> None:
        files = " ".join(self.chance.sample(SOURCES, self.chance.randint(1, 2)))
        self._say(f"set(files {files})")
        self._say(
            self.chance.choice(
                (
                    "file(GLOB some src/t*.cpp)",
                    "file(GLOB_RECURSE some src/*.cpp)",
                    "set(some)",
                    "aux_source_directory(src some)",
                    'list(TRANSFORM files REPLACE "one" "two" OUTPUT_VARIABLE some)',
                )
            )
        )
        kind = self.chance.choice(
            ("EXE", "EXE", "", "STATIC", "SHARED", "MODULE", "OBJECT", "INTERFACE", "ALIAS", "IMPORTED", "LOOP")
        )
        name = self._fresh("t" if kind == "EXE" else "lib_")
        if kind == "EXE":
            self._say(f"add_executable({name} {self.chance.choice(_EXECUTABLE_WORDS)} {self._some_sources()})")
        elif kind == "INTERFACE":
            self._say(f"add_library({name} INTERFACE)")
        elif kind == "ALIAS":
            real = [one for one, form in self._targets.items() if form not in ("ALIAS", "IMPORTED")]
            if not real:
                return
            self._say(f"add_library(own::{name} ALIAS {self._real_library(real)})" if self._real_library(real) else "")
            return
        elif kind == "IMPORTED":
            self._say(f"add_library({name} {self.chance.choice(('SHARED', 'UNKNOWN', 'INTERFACE'))} IMPORTED)")
        elif kind == "LOOP":
            self._say(f"foreach(each one two)\n  add_executable({name}_${{each}} src/${{each}}.cpp)\nendforeach()")
            self._targets[f"{name}_one"] = self._targets[f"{name}_two"] = "EXE"
            return
        else:
            self._say(
                f"add_library({name} {kind} {self.chance.choice(('', '', 'EXCLUDE_FROM_ALL'))} {self._some_sources()})"
            )
        self._targets[name] = kind
        self._about(name, kind)

    def _real_library(self, names: list[str]) -> str:
        return next((one for one in names if self._targets[one] not in ("EXE", "ALIAS", "IMPORTED")), "")

    def _about(self, name: str, kind: str) -> None:
        if kind == "IMPORTED":
            return
        scope = "INTERFACE" if kind == "INTERFACE" else self.chance.choice(("PRIVATE", "PUBLIC", "INTERFACE"))
        if self.chance.random() < 0.4:
            self._say(f"target_sources({name} {scope} {self._source() if scope == 'PRIVATE' else _TOP})")
        libraries = [
            one
            for one, form in self._targets.items()
            if form in ("", "STATIC", "SHARED", "INTERFACE", "OBJECT") and one != name
        ]
        if libraries and self.chance.random() < 0.6:
            link = " ".join(self.chance.sample(libraries, min(len(libraries), self.chance.randint(1, 2))))
            form = scope if kind == "INTERFACE" else self.chance.choice(("PRIVATE", "PUBLIC", "", "LINK_PUBLIC"))
            self._say(f"target_link_libraries({name} {form} {link} m)")
        change = f"set_target_properties({name} PROPERTIES"
        if kind in ("EXE", "SHARED", "", "STATIC") and self.chance.random() < 0.4:
            self._say(
                self.chance.choice(
                    (
                        f"{change} OUTPUT_NAME out_{name})",
                        f'{change} PREFIX "" VERSION 1.2)',
                        f"set_property(TARGET {name} PROPERTY OUTPUT_NAME out_{name})",
                        f"{change} RUNTIME_OUTPUT_NAME r_{name} LIBRARY_OUTPUT_NAME l_{name})",
                        f"set_property(TARGET {name} APPEND PROPERTY SOURCES top.cpp)",
                        f"{change} RUNTIME_OUTPUT_DIRECTORY bin LIBRARY_OUTPUT_DIRECTORY x)",
                    )
                )
            )
        libraries_to, to = "LIBRARY DESTINATION lib ARCHIVE DESTINATION lib", "DESTINATION"
        place = " LIBRARY DESTINATION lib" if kind == "MODULE" else ""
        if kind not in ("OBJECT", "IMPORTED") and self.chance.random() < 0.6:
            self._say(
                self.chance.choice(
                    (
                        f"install(TARGETS {name} DESTINATION lib/p)",
                        f"install(TARGETS {name}{place})",
                        f"install(TARGETS {name} RUNTIME DESTINATION lib/${{PROJECT_NAME}} {libraries_to})",
                        f"install(TARGETS {name} EXPORT ex_{name} {libraries_to} RUNTIME {to} bin INCLUDES {to} inc)",
                        f"install(TARGETS {name} RUNTIME DESTINATION ${{CMAKE_INSTALL_PREFIX}}/lib/p {libraries_to})",
                        f"install(TARGETS {name} OPTIONAL COMPONENT c DESTINATION libexec)",
                    )
                )
            )

    def _install(self) -> None:
        self._say(
            self.chance.choice(
                (
                    "install(PROGRAMS scripts/run.py scripts/tool DESTINATION lib/${PROJECT_NAME})",
                    "install(PROGRAMS scripts/run.py DESTINATION lib/p RENAME runner)",
                    "install(DIRECTORY launch DESTINATION share/p)",
                    "install(DIRECTORY launch/ DESTINATION share/p/launch)",
                    "install(DIRECTORY launch config DESTINATION share/${PROJECT_NAME}/)",
                    "install(FILES launch/a.launch config/p.yaml DESTINATION share/p)",
                    "install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/top.cpp TYPE DATA)",
                    'install(DIRECTORY config/ DESTINATION share/p/config FILES_MATCHING PATTERN "*.yaml")',
                    'install(DIRECTORY config DESTINATION share/p PATTERN "deep" EXCLUDE)',
                    "install(DIRECTORY scripts/ DESTINATION lib/p USE_SOURCE_PERMISSIONS)",
                    "file(GLOB scr scripts/*)\ninstall(PROGRAMS ${scr} DESTINATION lib/p)",
                    "install(FILES scripts/tool DESTINATION lib/p PERMISSIONS OWNER_READ OWNER_EXECUTE)",
                    "install(PROGRAMS scripts/tool TYPE BIN)",
                    "install(FILES config/p.yaml TYPE SYSCONF)",
                    "foreach(dir launch config)\n  install(DIRECTORY ${dir}/ DESTINATION share/p/${dir})\nendforeach()",
                    "install(FILES launch/a.launch DESTINATION share/p OPTIONAL RENAME c.launch)",
                )
            )
        )

    # Files

    def _write(self, statements: int) -> None:
        self._say("cmake_minimum_required(VERSION 3.25)")
        self._say(f"project(p {self.chance.choice(('', 'VERSION 1.2.3 '))}LANGUAGES CXX)")
        for name in "abcdef":
            self._say(f"set({name} {self._quoted()})")
        self._say("set(pointer a)")
        for name in ("l1", "l2", "l3"):
            self._say(f"set({name} {self._several()})")
        self._tell(
            '"${PROJECT_NAME}|${PROJECT_VERSION}|${p_VERSION}|${CMAKE_PROJECT_NAME}"', '"${CMAKE_CURRENT_LIST_FILE}"'
        )
        extra: list[Callable[[], None]] = [self._include, self._subfolder]
        extra += [self._target] * self.chance.randint(0, 6) + [self._install] * self.chance.randint(0, 2)
        todo: list[Callable[[], None]] = [self._statement] * statements + extra
        self.chance.shuffle(todo)
        for one in todo:
            one()
        for name in (*"abcdef", "l1", "l2", "l3", "pointer"):
            self._tell(f'"${{{name}}}"')
        self.files["CMakeLists.txt"] = "\n".join(self._lines) + "\n"
        for path in FILES:
            self.files.setdefault(path, _CONTENT.get(path, ""))

    def _elsewhere(self, path: str, count: int) -> None:
        before = self._lines, self._indent
        self._lines, self._indent = [], 0
        self._tell(
            '"${CMAKE_CURRENT_LIST_DIR}|${CMAKE_CURRENT_SOURCE_DIR}|${PROJECT_SOURCE_DIR}"',
            '"${CMAKE_CURRENT_BINARY_DIR}"',
        )
        for _ in range(count):
            self._statement()
        if path.startswith("sub/"):
            name = self._fresh("s")
            self._say(f"add_executable({name} inner.cpp {self.chance.choice(_INNER)})")
            self._targets[name] = "EXE"
            self._say(f"set({self._variable()} {self._several()} PARENT_SCOPE)")
            self._say(f"target_sources({name} PRIVATE ../src/two.cpp)")
        if self.chance.random() < 0.3:
            self._say(f"if({self._condition()})\n  return()\nendif()")
            self._tell("after return")
        self.files[path] = "\n".join(self._lines) + "\n"
        self._lines, self._indent = before

    def _include(self) -> None:
        path = f"cmake/{self._fresh('part')}.cmake"
        self._elsewhere(path, 4)
        how = self.chance.choice(
            (path, f"${{CMAKE_CURRENT_LIST_DIR}}/{path}", f"{path} OPTIONAL RESULT_VARIABLE found")
        )
        if self.chance.random() < 0.3:
            self._say("list(APPEND CMAKE_MODULE_PATH ${PROJECT_SOURCE_DIR}/cmake)")
            how = path[len("cmake/") : -len(".cmake")]
        self._say(f"include({how})")
        self._tell('"${a}"', '"${CMAKE_CURRENT_LIST_FILE}"')

    def _subfolder(self) -> None:
        self._elsewhere("sub/CMakeLists.txt", 4)
        self._say("add_subdirectory(sub)")
        self._tell('"${a}"', '"${l1}"')


_CONTENT = {"config/p.yaml": "first: 1\nsecond: two\n", "src/main.cpp": "int main() {}\n"}
