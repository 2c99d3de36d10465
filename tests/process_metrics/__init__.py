"""Process metrics against git's own answers: the commands that their declarations name, asked one by one."""
