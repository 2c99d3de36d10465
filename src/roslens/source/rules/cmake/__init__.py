"""Rules on CMakeLists.txt: what breaks a build, an installation or another machine."""
