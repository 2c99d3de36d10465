"""The first folder on the path of Python programs that look at a workspace: its ``sitecustomize`` guards imports."""
