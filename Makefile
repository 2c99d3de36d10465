# The commands to learn: demo, demo-live, demo-ros2, test, nightly, quick, lint, docs, site, accuracy, lock, bench, testbed,
# fuzz, mutants, lowest.
PYTHON ?= python3
WS ?= build/demo
PORT ?= 8080
BIN := .venv/bin

# What a run of tests imports is compiled once and kept: to compile it each time takes longer than most tests.
export PYTHONDONTWRITEBYTECODE =

# What a change is tested with. What reads clones of public code is where $ROSLENS_CORPORA says where they are.
EVERYDAY := not nightly$(if $(ROSLENS_CORPORA),, and not corpora)
# Where tests stand that want the machine for themselves; to look through all others for them takes ten seconds.
ALONE := tests/scenarios tests/testbed

.PHONY: demo site tour demo-live demo-ros2 testbed test nightly slow faults quick lint style types rewritten parts docs known-mistakes graph-findings recall reports accuracy same-facts fuzz mutants lowest lock lock-ros2 bench sites clean

# Analyse the example robot and what a change of it brings, write its report, serve it beside a recording of the robot in
# which something goes wrong. Another workspace, without a recording: make demo WS=~/robot_ws
demo: .venv/stamp
	$(if $(filter build/demo,$(WS)),sh examples/change.sh $(WS))
	$(BIN)/roslens check $(WS) $(if $(filter build/demo,$(WS)),--baseline HEAD) --fail-on never || [ $$? -eq 3 ]
	$(BIN)/roslens report $(WS) -o roslens-report
	$(if $(filter build/demo,$(WS)),$(BIN)/python examples/recording/record.py build/rover_drive)
	$(BIN)/roslens serve $(WS) --port $(PORT) $(if $(filter build/demo,$(WS)),--bag build/rover_drive --reference examples/recording/rover.yaml)

# The pictures of docs/tour.md, in build/tour, of what `make demo` serves; dark and narrow too: make tour LOOKS=--every. Every
# kind of page of what is served already: PYTHONPATH=tests python -m tour URL FOLDER --every --screens
tour: .venv/stamp
	sh examples/change.sh build/demo
	$(BIN)/roslens check build/demo --fail-on never --quiet || [ $$? -eq 3 ]
	$(BIN)/python examples/recording/record.py build/rover_drive
	$(BIN)/roslens serve build/demo --port 8099 --bag build/rover_drive --reference examples/recording/rover.yaml & \
	server=$$!; trap "kill $$server" EXIT; until curl -sf -o /dev/null http://127.0.0.1:8099/; do kill -0 $$server || exit 1; sleep 0.3; done; \
	PYTHONPATH=tests $(BIN)/python -m tour http://127.0.0.1:8099 build/tour $(LOOKS)

# Watch a recording of a small robot that breaks three times.
demo-live: .venv/stamp
	mkdir -p build
	$(BIN)/python examples/robot/record.py build/robot.bag
	$(BIN)/roslens watch --bag build/robot.bag --reference examples/robot/rover.yaml --fail-on never

# Start the nodes of the small robot with the ROS 2 wheels, and watch them until Ctrl-C.
demo-ros2: .venv/stamp
	sh .ci/ros2
	ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST sh examples/robot/watch_ros2.sh $(BIN)/roslens build/ros2/bin/python

# Three hosts on this machine with a robot on them that helps itself, until Ctrl-C; says how to look into them and break
# them, and what is done about it. As root. ARGS=--no-reactions leaves it alone.
testbed: .venv/stamp
	PYTHONPATH=tests $(BIN)/python -m testbed $(ARGS)

test: export ROSLENS_SAME_EXAMPLES = 1
test: parts
	$(MAKE) --no-print-directory -j 2 --output-sync=target types style rewritten
	$(BIN)/pytest -n auto --dist worksteal -m "$(EVERYDAY) and not slow"
	$(BIN)/pytest -m "$(EVERYDAY) and slow and not table" $(ALONE)

# What `make test` leaves out: random searches that are wide and new each time, further variants of real robots, every
# fault of the table, and what reads clones below $ROSLENS_CORPORA. Hours on two processors; whole only as root.
nightly: parts lint
	sh .ci/ros-source ros-geometry ros-image-pipeline ros-robot-state-publisher
	ROSLENS_NIGHTLY=1 $(BIN)/pytest -n auto --dist worksteal -m "not slow"
	$(BIN)/pytest -m slow $(ALONE)
	$(MAKE) mutants ARGS="--seed $$(date +%j)"

# Speed, size and whole robots alone; wants an otherwise idle machine.
slow: parts lint
	$(BIN)/pytest -m "$(EVERYDAY) and slow and not table" $(ALONE)

# Every fault of docs/faults.md, injected into real robots on three hosts; wants an otherwise idle machine, and root.
faults: parts lint
	$(BIN)/pytest -m table $(ALONE)

# An answer in two minutes: no real tools, no browser, no pages, no whole runs, no recorded systems, nothing slow, and fewer examples.
quick: lint
	ROSLENS_QUICK=1 $(BIN)/pytest -n auto -m "not slow and not heavy and not real and not browser and not nightly" \
		--ignore=tests/scenarios --ignore=tests/native --ignore=tests/cli --ignore=tests/dashboard --ignore=tests/plugins/haros --ignore=tests/accuracy

# Test modules with their assertions rewritten are kept: each of the workers would do that for all of them. What cannot be
# collected is reported by the run itself.
rewritten: .venv/stamp
	$(BIN)/pytest --collect-only -qq -m "$(EVERYDAY)" > /dev/null || true

lint: style types

style: .venv/stamp
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/lint-imports

# The stubs of numpy for Python 3.12 and newer cannot be read as Python 3.10, which is checked wherever it can be.
types: .venv/stamp
	$(BIN)/mypy --python-version $$($(BIN)/python -c 'import sys; print("3.%d" % (sys.version_info[1] if sys.version_info >= (3, 12) else 10))')

parts:
	sh .ci/parts

# Write the pages in docs/reference that come from declarations.
docs: .venv/stamp
	$(BIN)/python -m roslens.cli.reference docs/reference

# Build the site of docs/ in build/site, from mkdocs.yml; a link that leads nowhere fails it. Open build/site/index.html.
site: build/mkdocs/bin/mkdocs
	NO_MKDOCS_2_WARNING=1 $< build --strict --quiet

build/mkdocs/bin/mkdocs:
	$(PYTHON) -m venv build/mkdocs
	build/mkdocs/bin/python -m pip install --quiet "mkdocs-material>=9.5,<10"

# Write docs/known_mistakes.md from its tables.
known-mistakes: .venv/stamp
	PYTHONPATH=tests $(BIN)/python -m known_mistakes

# Write docs/accuracy_of_graph_rules.md from the judged samples; `python -m graph_findings sample` draws one.
graph-findings: .venv/stamp
	PYTHONPATH=tests $(BIN)/python -m graph_findings page

# Write docs/recall_of_rules.md: CORPORA="FOLDER…" names clones with the real files that mistakes are planted into.
recall: .venv/stamp
	PYTHONPATH=tests $(BIN)/python -m planted $(CORPORA)

# Score the rebuilt reports of mistakes and write docs/reports.md. ARGS="--round second --keep" keeps a table of a round;
# ARGS="CASE…" only prints what is said of some.
reports: .venv/stamp
	PYTHONPATH=tests $(BIN)/python -m reports $(ARGS)

# ARGS=--page writes the page only, of what is recorded and judged.
# Run nodes, compare their graph with what source says of it, and write docs/accuracy.md. What cannot run here keeps the
# graph that was recorded: clones of public code are looked for in $ROSLENS_CORPORA, a Python with launch_ros in
# $ROSLENS_ROS2_PYTHON, see CONTRIBUTING.md.
accuracy: parts
	sh .ci/ros-source ros-geometry ros-image-pipeline ros-robot-state-publisher
	PYTHONPATH=tests $(BIN)/python -m accuracy $(ARGS)

# Compare what revision BASE and the working tree say of the repositories in tests/same_facts/repositories.repos, from
# clones below $ROSLENS_CORPORA. A redesign changes nothing. What a revision said is kept: only a new one is asked again.
same-facts: .venv/stamp
	PYTHONPATH=tests $(BIN)/python -m same_facts $(BASE) $(ARGS)

# Try mutated files of every kind that is read, and keep what fails in tests/fixtures/fuzz. ARGS="cpp --minutes 30"
fuzz: .venv/stamp
	PYTHONPATH=tests $(BIN)/python -m fuzz $(ARGS)

# Change source in one place and see whether tests notice: docs/mutants.md. ARGS="window --each 0" for all of a part.
mutants: .venv/stamp
	PYTHONPATH=tests $(BIN)/python -m mutants $(ARGS)

# The quick tests with the lowest version of each dependency that pyproject.toml permits: make lowest PYTHONS="3.10 3.13".
lowest:
	sh .ci/lowest $(PYTHONS)

lock:
	$(BIN)/python -m pip install --quiet uv
	$(BIN)/uv pip compile pyproject.toml --group dev --universal --python-version 3.10 --generate-hashes \
		--no-emit-index-url --no-header --no-annotate -o requirements.lock

# The wheels of ROS 2 that tests talk to; .ci/ros2 installs them in build/ros2.
lock-ros2:
	$(BIN)/python -m pip install --quiet uv
	$(BIN)/uv pip compile --group ros2 --universal --python-version 3.10 --generate-hashes \
		--no-emit-index-url --no-header --no-annotate -o requirements-ros2.lock

# docs/endpoint_sites.md; CLONES is a folder with clones of any repositories, and CORPUS, which may be left out, one with
# those in tests/fixtures/extract.
sites: .venv/stamp
	PYTHONPATH=tests $(BIN)/python -m endpoint_sites $(CLONES) docs/endpoint_sites.md $(CORPUS)

# Figures of the README; CORPUS is a folder with clones of ros_comm, navigation and navigation2.
bench: .venv/stamp
	$(BIN)/python benchmarks/source_speed.py $(CORPUS)
	$(BIN)/python benchmarks/rules_speed.py $(CORPUS) $(if $(CPPLINT),--cpplint "$(CPPLINT)")
	$(if $(TOOLS),$(BIN)/python benchmarks/tools_speed.py $(CORPUS) --tools $(TOOLS))

clean:
	rm -rf .venv roslens-report .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache

.venv/stamp: pyproject.toml requirements.lock hatch_build.py $(wildcard native/*.[ch])
	PYTHON="$(PYTHON)" sh .ci/venv
	touch $@
