"""Rules on launch files and files of parameters that launch, roslaunch or rcl refuse, so that nothing starts."""
