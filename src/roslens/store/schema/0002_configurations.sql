-- The computation graphs that a run was asked to look at, each with what was found in it. Most runs share one.

CREATE TABLE graph (
    id INTEGER PRIMARY KEY,
    digest TEXT NOT NULL UNIQUE,
    content BLOB NOT NULL             -- JSON, compressed by zlib
);

CREATE TABLE configuration (
    run INTEGER NOT NULL REFERENCES run ON DELETE CASCADE,
    position INTEGER NOT NULL,
    name TEXT NOT NULL,
    graph INTEGER NOT NULL REFERENCES graph,
    PRIMARY KEY (run, position)
) WITHOUT ROWID;
CREATE INDEX configuration_graph ON configuration (graph);
