-- Runs share what did not change. A unit is the result of one package under a key of everything that shaped it; a
-- run is a header and a list of units. A run has its row only when it is complete.

CREATE TABLE unit (
    id INTEGER PRIMARY KEY,
    key TEXT UNIQUE,          -- NULL: what belongs to the workspace of one run
    package TEXT NOT NULL,    -- id of the package, '' for the workspace
    manifest TEXT,            -- the package as its manifest declares it, JSON
    summary TEXT              -- what overviews show, JSON
);
CREATE INDEX unit_package ON unit (package);

CREATE TABLE tag_set (
    id INTEGER PRIMARY KEY,
    tags TEXT NOT NULL UNIQUE         -- JSON array
);

CREATE TABLE file (
    unit INTEGER NOT NULL REFERENCES unit ON DELETE CASCADE,
    position INTEGER NOT NULL,
    path TEXT NOT NULL,
    language TEXT NOT NULL,
    role TEXT NOT NULL,
    size INTEGER NOT NULL,            -- bytes
    content_hash TEXT NOT NULL,
    PRIMARY KEY (unit, position)
) WITHOUT ROWID;
CREATE INDEX file_path ON file (path);

CREATE TABLE entity (
    unit INTEGER NOT NULL REFERENCES unit ON DELETE CASCADE,
    position INTEGER NOT NULL,
    id TEXT NOT NULL,
    kind TEXT NOT NULL,
    name TEXT NOT NULL,
    path TEXT NOT NULL,
    line INTEGER NOT NULL,
    end_line INTEGER NOT NULL,
    parent TEXT NOT NULL,
    approximate INTEGER NOT NULL,     -- 1: a part of it could not be parsed
    PRIMARY KEY (unit, position)
) WITHOUT ROWID;
CREATE INDEX entity_path ON entity (path);

-- Measurements by column: the entities of a kind stand together in a unit, and a row here holds one quantity of all of
-- them. The view `measurements` has a row per value.
CREATE TABLE measured (
    unit INTEGER NOT NULL REFERENCES unit ON DELETE CASCADE,
    kind TEXT NOT NULL,
    quantity TEXT NOT NULL,
    first INTEGER NOT NULL,           -- position of the first entity of the kind
    "values" TEXT NOT NULL,           -- JSON array: a number per entity, null where it has none
    PRIMARY KEY (unit, kind, quantity)
) WITHOUT ROWID;

CREATE TABLE finding (
    unit INTEGER NOT NULL REFERENCES unit ON DELETE CASCADE,
    position INTEGER NOT NULL,
    rule TEXT NOT NULL,
    severity TEXT NOT NULL,
    message TEXT NOT NULL,
    path TEXT NOT NULL,
    line INTEGER NOT NULL,
    "column" INTEGER NOT NULL,
    end_line INTEGER NOT NULL,
    end_column INTEGER NOT NULL,
    entity TEXT NOT NULL,
    tag_set INTEGER NOT NULL REFERENCES tag_set,
    tool TEXT NOT NULL,
    fingerprint TEXT NOT NULL,
    quantity TEXT NOT NULL,
    value,                            -- NULL where no quality model made the finding
    bound,
    model TEXT NOT NULL,
    gated INTEGER NOT NULL,           -- 1: counts for --fail-on
    PRIMARY KEY (unit, position)
) WITHOUT ROWID;
CREATE INDEX finding_rule ON finding (unit, rule);
CREATE INDEX finding_path ON finding (path);

CREATE TABLE failure (
    unit INTEGER NOT NULL REFERENCES unit ON DELETE CASCADE,
    position INTEGER NOT NULL,
    tool TEXT NOT NULL,
    what TEXT NOT NULL,
    expected TEXT NOT NULL,
    advice TEXT NOT NULL,
    location TEXT,                    -- JSON: path, line, column, end_line, end_column
    entity TEXT NOT NULL,
    package TEXT NOT NULL,
    partial INTEGER NOT NULL,         -- 1: the rest of the entity was analysed
    detail TEXT NOT NULL,
    PRIMARY KEY (unit, position)
) WITHOUT ROWID;

-- The rules and quantities of a run; most runs share one.
CREATE TABLE vocabulary (
    id INTEGER PRIMARY KEY,
    digest TEXT NOT NULL UNIQUE,
    rules TEXT NOT NULL,              -- JSON array
    quantities TEXT NOT NULL          -- JSON array
);

CREATE TABLE run (
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    key TEXT NOT NULL,
    root TEXT NOT NULL,
    paths TEXT NOT NULL,              -- JSON array
    started TEXT NOT NULL,            -- UTC, ISO 8601
    seconds REAL NOT NULL,
    "commit" TEXT NOT NULL,
    tools TEXT NOT NULL,              -- JSON object: name to version
    configuration TEXT NOT NULL,      -- JSON object: the options that shape the result
    models TEXT NOT NULL,             -- JSON array
    vocabulary INTEGER NOT NULL REFERENCES vocabulary,
    workspace INTEGER NOT NULL REFERENCES unit,
    packages INTEGER NOT NULL,
    files INTEGER NOT NULL,
    entities INTEGER NOT NULL,
    findings INTEGER NOT NULL,
    failures INTEGER NOT NULL
);
CREATE INDEX run_key ON run (key);
CREATE INDEX run_vocabulary ON run (vocabulary);
CREATE INDEX run_workspace ON run (workspace);

CREATE TABLE run_unit (
    run INTEGER NOT NULL REFERENCES run ON DELETE CASCADE,
    position INTEGER NOT NULL,        -- packages by id, the workspace last
    unit INTEGER NOT NULL REFERENCES unit,
    PRIMARY KEY (run, position)
) WITHOUT ROWID;
CREATE INDEX run_unit_unit ON run_unit (unit);

-- Quantities of a package that need all packages of the run.
CREATE TABLE package_value (
    run INTEGER NOT NULL REFERENCES run ON DELETE CASCADE,
    package TEXT NOT NULL,
    quantity TEXT NOT NULL,
    value NOT NULL,
    PRIMARY KEY (run, package, quantity)
) WITHOUT ROWID;

-- Who writes, or wrote last; believed only while the write lock is held.
CREATE TABLE writer (
    only INTEGER PRIMARY KEY CHECK (only = 1),
    pid INTEGER NOT NULL,
    started TEXT NOT NULL
);

-- For people with a SQLite shell: the words of the JSON report, each with its run. CROSS JOIN keeps the order of the
-- tables; the planner's own choice is ten times slower.

CREATE VIEW packages AS
SELECT run_unit.run AS run,
       unit.package AS id,
       json_extract(unit.summary, '$.name') AS name,
       json_extract(unit.summary, '$.path') AS path,
       coalesce(json_extract(unit.summary, '$.version'), '') AS version,
       coalesce(json_extract(unit.summary, '$.build_type'), '') AS build_type,
       coalesce(json_extract(unit.summary, '$.dependencies'), '[]') AS dependencies
FROM run_unit JOIN unit ON unit.id = run_unit.unit
WHERE unit.package <> '';

CREATE VIEW files AS
SELECT run_unit.run AS run, unit.package AS package, file.path, file.language, file.role, file.size, file.content_hash
FROM run_unit JOIN unit ON unit.id = run_unit.unit JOIN file ON file.unit = unit.id;

CREATE VIEW entities AS
SELECT run_unit.run AS run, unit.package AS package, entity.id, entity.kind, entity.name, entity.path, entity.line,
       entity.end_line, entity.parent, entity.approximate
FROM run_unit JOIN unit ON unit.id = run_unit.unit JOIN entity ON entity.unit = unit.id;

CREATE VIEW measurements AS
SELECT run_unit.run AS run, unit.package AS package, entity.id AS entity, measured.quantity AS quantity,
       number.value AS value
FROM run_unit
CROSS JOIN unit ON unit.id = run_unit.unit
CROSS JOIN measured ON measured.unit = unit.id
CROSS JOIN json_each(measured."values") AS number
CROSS JOIN entity ON entity.unit = unit.id AND entity.position = measured.first + number.key
WHERE number.value IS NOT NULL
UNION ALL
SELECT run, package, 'package:' || package, quantity, value FROM package_value;

CREATE VIEW findings AS
SELECT run_unit.run AS run, unit.package AS package, finding.rule, finding.severity, finding.message, finding.path,
       finding.line, finding."column", finding.end_line, finding.end_column, finding.entity, tag_set.tags AS tags,
       finding.tool, finding.fingerprint, finding.quantity, finding.value, finding.bound, finding.model, finding.gated
FROM run_unit
JOIN unit ON unit.id = run_unit.unit
JOIN finding ON finding.unit = unit.id
JOIN tag_set ON tag_set.id = finding.tag_set;

CREATE VIEW failures AS
SELECT run_unit.run AS run, failure.package, failure.tool, failure.what, failure.expected, failure.advice,
       json_extract(failure.location, '$.path') AS path, json_extract(failure.location, '$.line') AS line,
       failure.entity, failure.partial, failure.detail
FROM run_unit JOIN failure ON failure.unit = run_unit.unit;

CREATE VIEW rules AS
SELECT run.id AS run, json_extract(rule.value, '$.id') AS id, json_extract(rule.value, '$.title') AS title,
       coalesce(json_extract(rule.value, '$.severity'), 'warning') AS severity,
       coalesce(json_extract(rule.value, '$.tags'), '[]') AS tags,
       coalesce(json_extract(rule.value, '$.tool'), '') AS tool
FROM run JOIN vocabulary ON vocabulary.id = run.vocabulary JOIN json_each(vocabulary.rules) AS rule;
