"""Only flags that shape what code means are taken from a workspace."""

import pytest

from roslens.source.tools.compiling.compile_flags import allowed_flags, compiler_of


@pytest.mark.parametrize(
    "flags",
    [
        "-I/opt/ros/include -I include -isystem /usr/include/eigen3 -iquote . -idirafter x",
        "-DNAME -DNAME=1 -D NAME=2 -UNAME -U NAME -include config.h -imacros m.h",
        "-std=c++17 -std=gnu++2a -std=c11 -x c++ -xc -ansi -pedantic",
        "-fno-rtti -frtti -fno-exceptions -fexceptions -fPIC -fvisibility=hidden -fvisibility-inlines-hidden",
        "-O2 -O -Ofast -Wall -Wextra -Wno-unused-parameter -Werror=return-type -Wformat=2 -w",
        "-m64 -march=armv8-a -mavx2",
        "-pthread -nostdinc++ -stdlib=libc++ --sysroot=/opt/arm --sysroot /opt/arm --target=aarch64-linux-gnu",
        "-ftemplate-depth=1024 -fopenmp",
    ],
)
def test_flags_of_builds_are_kept(flags):
    assert list(allowed_flags(flags.split())) == flags.split()


@pytest.mark.parametrize(
    "flags",
    [
        "-fplugin=./evil.so", "-fpass-plugin=evil.so", "-Xclang -load -Xclang ./evil.so", "-load ./evil.so",
        "@response",
        "-B ./tools", "-B./tools", "-specs=evil.specs", "--specs=x", "--config ./x.cfg", "--config=./x.cfg",
        "--amdgpu-arch-tool=./tool.sh", "--nvptx-arch-tool=./tool.sh", "--offload-arch-tool=./tool.sh",
        "--offload-arch=native", "-fopenmp-targets=amdgcn-amd-amdhsa", "-fopenmp=libomp", "-x hip", "-x cuda", "-xhip",
        "--target=amdgcn-amd-amdhsa", "-fuse-ld=./tool.sh", "--ld-path=./tool.sh", "-no-integrated-as",
        "-fno-integrated-as",
        "-Wp,-MD,file", "-Wl,-plugin,x", "-Wa,-x", "-MD -MF file", "-MMD", "-o file", "-c",
        "--serialize-diagnostics file",
        "-Xclang -header-include-file -Xclang file", "-save-stats=obj", "-save-temps", "-ftime-trace=file",
        "-fmodules-cache-path=dir", "-fprofile-generate=dir", "-fcrash-diagnostics-dir=dir", "-gcc-toolchain x",
        "--gcc-install-dir=x", "-ccc-gcc-name x", "-resource-dir x", "-working-directory x", "-mllvm -load=x",
        "-Xlinker x",
        "-D @response", "-I -fplugin=./evil.so", "--driver-mode=cl", "other.cpp", "-I", "-include", "-isysroot",
    ],
)  # fmt: skip
def test_every_other_is_left_out(flags):
    assert list(allowed_flags(flags.split())) == []


@pytest.mark.parametrize(
    ("program", "file", "compiler"),
    [
        ("./evil/clang++", "/a.cpp", "clang++"),
        ("/usr/bin/cc", "/a.c", "clang"),
        ("/usr/bin/c++", "/a.h", "clang++"),
        ("", "/a.cc", "clang++"),
    ],
)
def test_a_compiler_is_a_name_and_no_path(program, file, compiler):
    assert compiler_of(program, file) == compiler
