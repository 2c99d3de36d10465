"""CPython as the judge of what is evaluated without running it: programs are made up, run with stubs, and compared."""
