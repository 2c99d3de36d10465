"""The test bed: hosts in network namespaces, links with faults, and a robot on three hosts. See docs/testbed.md."""
