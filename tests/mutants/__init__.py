"""Mutation testing: source is changed in one place, and tests that still pass have not looked there.

An own driver, for what others leave out is what matters here: mutmut changes functions alone, no bounds and policies of
a module, nothing that is decorated; cosmic-ray starts a run of tests anew for each mutant, and changes the files that
one works on. Here each mutant is a file in a copy of the repository, so that processes which a test starts have it too,
and a process that has imported all but roslens is forked for each.
"""
